//! The cut itself, and the look at what is left.
//!
//! `VOLTOUR_POWER_TRIALS` and `VOLTOUR_POWER_SEED` say how many trials and which.

use std::env;

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use sqlx::sqlite::{SqliteConnectOptions, SqliteJournalMode};
use sqlx::{ConnectOptions, Connection};
use tempfile::TempDir;
use voltour_power_loss::Disk;

use super::history::{Acknowledged, History};
use crate::store::fixture::{Bench, spec, standing};

fn number(name: &str, default: u64) -> u64 {
    env::var(name).ok().map_or(default, |text| text.parse().expect("a whole number"))
}

/// A store at work whose power goes after so many operations: what is left, and what was acknowledged.
async fn trial(seed: u64, lies: bool) -> (TempDir, Acknowledged) {
    let mut dice = Pcg64Mcg::seed_from_u64(seed);
    let dir = tempfile::tempdir().unwrap();
    let disk = Disk::over(dir.path()).unwrap();
    // Short ones fall into the making of the database, long ones into checkpoints of its log.
    let most = [60, 400, 6_000][dice.random_range(0..3)];
    let clock = standing();
    if lies {
        disk.lie();
        disk.cut_after(2_000);
    } else {
        disk.cut_after(dice.random_range(0..most));
    }
    let mut acknowledged = Acknowledged::default();
    if let Ok(bench) = Bench::over(dir, clock).await {
        let mut history = History { bench: &bench, disk: &disk, dice, acknowledged };
        history.run().await;
        acknowledged = history.acknowledged;
        bench.store.task.ended.abort();
    }
    let left = tempfile::tempdir().unwrap();
    disk.survivors(left.path(), (!seed.is_multiple_of(4)).then_some(seed)).unwrap();
    (left, acknowledged)
}

/// The first thing acknowledged that is not there, or not as it was acknowledged.
async fn lost(bench: &Bench, acknowledged: &Acknowledged) -> Option<String> {
    let reads = &bench.store.reads;
    for (id, told) in &acknowledged.requests {
        let stored = reads.request(*id).await.unwrap();
        if !stored.is_some_and(|stored| stored.change > told.change || stored == *told) {
            return Some(format!("{told:?}"));
        }
    }
    for (id, told) in &acknowledged.departures {
        let stored = reads.departure(*id).await.unwrap();
        if !stored.is_some_and(|stored| stored.change > told.change || stored == *told) {
            return Some(format!("{told:?}"));
        }
    }
    for (id, told) in &acknowledged.tours {
        let stored = reads.tour(*id).await.unwrap();
        if !stored.is_some_and(|stored| stored.change > told.change || stored == *told) {
            return Some(format!("{told:?}"));
        }
    }
    None
}

/// The same call gets the same answer, and the store goes on.
async fn goes_on(bench: &Bench, acknowledged: &Acknowledged) {
    for (call, asked, id) in &acknowledged.submitted {
        let again = bench.try_submit(call, asked.clone()).await.unwrap();
        assert_eq!(again.id, *id);
    }
    for (call, what, visit) in &acknowledged.visited {
        assert_eq!(bench.try_visit(call, what.clone()).await.as_ref(), Ok(visit));
    }
    bench.put(spec()).await;
    bench.submit("s1").await;
    bench.tour("another", &[]).await;
}

async fn is_sound(bench: &Bench) {
    let pool = bench.store.reads.pool();
    let verdict = sqlx::query_scalar("PRAGMA integrity_check").fetch_one(pool);
    let verdict: String = verdict.await.unwrap();
    assert_eq!(verdict, "ok");
    let orphans = sqlx::query("PRAGMA foreign_key_check").fetch_all(pool).await.unwrap();
    assert!(orphans.is_empty());
}

#[tokio::test]
async fn what_was_acknowledged_outlives_the_power() {
    let first = number("VOLTOUR_POWER_SEED", 1);
    let mut counted = 0;
    for seed in first..first + number("VOLTOUR_POWER_TRIALS", 40) {
        let (left, acknowledged) = trial(seed, false).await;
        // Fresh ids must not be those of before.
        let bench = Bench::over(left, standing()).await;
        let bench = bench.unwrap_or_else(|error| panic!("VOLTOUR_POWER_SEED={seed}: {error}"));
        is_sound(&bench).await;
        assert_eq!(lost(&bench, &acknowledged).await, None, "VOLTOUR_POWER_SEED={seed}");
        bench.skip_calls();
        goes_on(&bench, &acknowledged).await;
        counted += acknowledged.submitted.len() + acknowledged.tours.len();
    }
    assert!(counted > 0, "there was nothing to lose");
}

/// The same trials on a disk that says that it has synced what it has not: the layer really loses, and the
/// trials notice.
#[tokio::test]
async fn a_disk_that_lies_about_its_syncs_loses_and_that_is_noticed() {
    let (left, acknowledged) = trial(4, true).await;
    assert!(!acknowledged.requests.is_empty());
    let bench = Bench::over(left, standing()).await.unwrap();
    assert!(lost(&bench, &acknowledged).await.is_some());
}

/// Without syncs of its own SQLite loses as much.
#[tokio::test]
async fn without_syncs_a_commit_is_lost() {
    let dir = tempfile::tempdir().unwrap();
    let disk = Disk::over(dir.path()).unwrap();
    let options = |dir: &TempDir| {
        let options = SqliteConnectOptions::new().filename(dir.path().join("db"));
        options.create_if_missing(true).journal_mode(SqliteJournalMode::Wal)
    };
    let mut conn = options(&dir).pragma("synchronous", "FULL").connect().await.unwrap();
    for sql in [
        "CREATE TABLE t (n)",
        "INSERT INTO t VALUES (1)",
        "PRAGMA synchronous = OFF",
        "INSERT INTO t VALUES (2)",
    ] {
        sqlx::query(sql).execute(&mut conn).await.unwrap();
    }
    disk.cut();
    let failed = sqlx::query("INSERT INTO t VALUES (3)").execute(&mut conn).await;
    assert!(failed.is_err(), "there is no power");
    let left = tempfile::tempdir().unwrap();
    disk.survivors(left.path(), None).unwrap();
    let mut conn = options(&left).connect().await.unwrap();
    let kept: Vec<i64> = sqlx::query_scalar("SELECT n FROM t").fetch_all(&mut conn).await.unwrap();
    assert_eq!(kept, [1]);
    conn.close().await.unwrap();
}
