//! Copies of databases that are whole, and what is refused.

use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};

use super::{backup, restore};
use crate::clock::Clock;
use crate::domain::RequestState;
use crate::store::StoreError;
use crate::store::fixture::Bench;

#[tokio::test]
async fn a_backup_holds_what_was_acknowledged_and_a_restored_one_goes_on() {
    let bench = Bench::new().await;
    bench.tour("c", &[]).await;
    let before = bench.submit("s1").await;
    let file = bench.dir.path().join("copy");
    let made = backup(&bench.path(), &file, false).await.unwrap();
    assert_eq!((made.requests, made.plans), (1, 1));
    let after = bench.submit("s2").await;
    let elsewhere = bench.dir.path().join("elsewhere");
    let restored = restore(&file, &elsewhere, false, bench.clock.now()).await.unwrap();
    assert_eq!((restored.verified, restored.aside), (made, None));
    let store = crate::store::Store::open(&elsewhere, bench.clock.clone()).await.unwrap();
    let found = store.reads.request(before.id).await.unwrap().unwrap();
    assert_eq!(found.state, RequestState::Open);
    assert_eq!(store.reads.request(after.id).await.unwrap(), None, "it came later");
}

#[tokio::test]
async fn what_is_there_is_replaced_only_on_demand_and_then_kept() {
    let bench = Bench::new().await;
    let first = bench.submit("s1").await;
    let (db, file) = (bench.path(), bench.dir.path().join("copy"));
    backup(&db, &file, false).await.unwrap();
    let again = backup(&db, &file, false).await;
    assert!(matches!(again, Err(StoreError::Exists(_))), "{again:?}");
    let itself = backup(&db, &db, true).await;
    assert!(matches!(itself, Err(StoreError::Itself(_))), "{itself:?}");
    let second = bench.submit("s2").await;
    let now = bench.clock.now();
    let in_use = restore(&file, &db, true, now).await;
    assert!(matches!(in_use, Err(StoreError::InUse(_))), "{in_use:?}");
    let clock = bench.clock.clone();
    let (dir, _, store) = bench.parts();
    store.close().await.unwrap();
    let exists = restore(&file, &db, false, now).await;
    assert!(matches!(exists, Err(StoreError::Exists(_))), "{exists:?}");
    let restored = restore(&file, &db, true, now).await.unwrap();
    let store = crate::store::Store::open(&db, clock.clone()).await.unwrap();
    assert!(store.reads.request(first.id).await.unwrap().is_some());
    assert!(store.reads.request(second.id).await.unwrap().is_none());
    store.close().await.unwrap();
    let aside = crate::store::Store::open(&restored.aside.unwrap(), clock).await.unwrap();
    assert!(aside.reads.request(second.id).await.unwrap().is_some(), "nothing is lost");
    drop(dir);
}

/// A service that crashed left its last transactions in the log alone.
#[tokio::test]
async fn a_database_is_set_aside_with_its_log() {
    let bench = Bench::new().await;
    let file = bench.dir.path().join("copy");
    backup(&bench.path(), &file, false).await.unwrap();
    let last = bench.submit("s1").await;
    let crashed = bench.dir.path().join("crashed");
    for end in ["", "-wal"] {
        let name = |base: &std::path::Path| format!("{}{end}", base.display());
        fs::copy(name(&bench.path()), name(&crashed)).unwrap();
    }
    let bare = restore(&crashed, &bench.dir.path().join("new"), false, bench.clock.now()).await;
    assert!(matches!(bare, Err(StoreError::Logged(_))), "{bare:?}");
    let restored = restore(&file, &crashed, true, bench.clock.now()).await.unwrap();
    let aside = restored.aside.unwrap();
    let store = crate::store::Store::open(&aside, bench.clock.clone()).await.unwrap();
    assert!(store.reads.request(last.id).await.unwrap().is_some());
    let store = crate::store::Store::open(&crashed, bench.clock.clone()).await.unwrap();
    assert!(store.reads.request(last.id).await.unwrap().is_none(), "no log of the former one");
}

/// The moment before the copy gets the name.
#[tokio::test]
async fn a_restore_that_is_cut_short_leaves_the_database() {
    let bench = Bench::new().await;
    let last = bench.submit("s1").await;
    let (clock, db) = (bench.clock.clone(), bench.path());
    let (dir, _, store) = bench.parts();
    store.close().await.unwrap();
    let aside = super::restore::keep_aside(&db, clock.now()).unwrap().unwrap();
    for file in [db, aside] {
        let store = crate::store::Store::open(&file, clock.clone()).await.unwrap();
        assert!(store.reads.request(last.id).await.unwrap().is_some(), "{}", file.display());
        store.close().await.unwrap();
    }
    drop(dir);
}

#[tokio::test]
async fn a_restored_database_is_its_owners_alone_whatever_the_backup_was() {
    let bench = Bench::new().await;
    let (file, target) = (bench.dir.path().join("copy"), bench.dir.path().join("new"));
    backup(&bench.path(), &file, false).await.unwrap();
    for mode in [0o444, 0o644] {
        fs::set_permissions(&file, fs::Permissions::from_mode(mode)).unwrap();
        restore(&file, &target, true, bench.clock.now()).await.unwrap();
        let restored = fs::metadata(&target).unwrap().permissions().mode() & 0o777;
        assert_eq!(restored, 0o600, "of {mode:o}");
        bench.clock.advance(std::time::Duration::from_secs(1));
    }
}

#[tokio::test]
async fn a_database_has_one_lock_and_one_place_by_whatever_name() {
    let bench = Bench::new().await;
    let kept = bench.submit("s1").await;
    let (db, link) = (bench.path(), bench.dir.path().join("link"));
    let (file, folder) = (bench.dir.path().join("copy"), bench.dir.path().join("folder"));
    backup(&db, &file, false).await.unwrap();
    symlink("db", &link).unwrap();
    symlink(bench.dir.path(), &folder).unwrap();
    for name in [link.clone(), folder.join("db"), folder.join("link")] {
        let second = crate::store::Store::open(&name, bench.clock.clone()).await;
        assert!(matches!(second, Err(StoreError::InUse(_))), "{}: {second:?}", name.display());
    }
    let now = bench.clock.now();
    let in_use = restore(&file, &link, true, now).await;
    assert!(matches!(in_use, Err(StoreError::InUse(_))), "{in_use:?}");
    let later = bench.submit("s2").await;
    let clock = bench.clock.clone();
    let (dir, _, store) = bench.parts();
    store.close().await.unwrap();
    restore(&file, &link, true, now).await.unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    let store = crate::store::Store::open(&db, clock.clone()).await.unwrap();
    assert!(store.reads.request(kept.id).await.unwrap().is_some());
    assert!(store.reads.request(later.id).await.unwrap().is_none(), "it is the backup");
    store.close().await.unwrap();
    // A link to a database that is not made yet.
    let (early, made) = (dir.path().join("early"), dir.path().join("made"));
    symlink("made", &early).unwrap();
    let store = crate::store::Store::open(&early, clock.clone()).await.unwrap();
    let second = crate::store::Store::open(&made, clock).await;
    assert!(matches!(second, Err(StoreError::InUse(_))), "{second:?}");
    store.close().await.unwrap();
}

#[tokio::test]
async fn damage_is_found_wherever_it_is_and_nothing_is_touched() {
    let bench = Bench::new().await;
    for _ in 0..300 {
        bench.submit("s1").await;
    }
    let file = bench.dir.path().join("copy");
    backup(&bench.path(), &file, false).await.unwrap();
    let whole = fs::read(&file).unwrap();
    let target = bench.dir.path().join("new");
    let page = 4096;
    let mut cases = vec![Vec::new(), b"no database".to_vec(), whole[..whole.len() / 2].to_vec()];
    for at in (0..whole.len() / page).map(|number| number * page) {
        let mut damaged = whole.clone();
        damaged[at..at + 24].fill(0xa5);
        cases.push(damaged);
    }
    for (case, bytes) in cases.into_iter().enumerate() {
        fs::write(&file, bytes).unwrap();
        let refused = restore(&file, &target, false, bench.clock.now()).await;
        let error = refused.expect_err("damage").to_string();
        assert!(error.contains("damaged") || error.contains("no database"), "{case}: {error}");
        assert!(!target.exists());
    }
}
