//! A disk that is full, read-only or cannot sync: nothing is acknowledged meanwhile, nothing is lost, and when
//! it is well again, so is the store.

use std::time::Duration;

use tempfile::TempDir;
use tokio::time::timeout;
use voltour_power_loss::{Disk, Fault};

use crate::domain::Refusal;
use crate::store::Trouble;
use crate::store::fixture::{Bench, asks, spec, standing};

struct Failing {
    bench: Bench,
    disk: Disk,
}

impl Failing {
    async fn new() -> Self {
        let dir = tempfile::tempdir().unwrap();
        let disk = Disk::over(dir.path()).unwrap();
        let bench = Bench::over(dir, standing()).await.unwrap();
        bench.put(spec()).await;
        Self { bench, disk }
    }

    /// Waits until the store says that it is in a trouble, or in none.
    async fn until(&self, trouble: Option<Trouble>) {
        let mut told = self.bench.store.reads.trouble();
        let said = told.wait_for(|told| *told == trouble);
        timeout(Duration::from_secs(30), said).await.expect("it is told").unwrap();
    }

    async fn refused(&self) -> Refusal {
        self.bench.try_submit(&self.bench.fresh(), asks("s1")).await.unwrap_err()
    }

    /// The database as a power cut would leave it now.
    async fn after_a_cut(self) -> Bench {
        self.disk.cut();
        let left: TempDir = tempfile::tempdir().unwrap();
        self.disk.survivors(left.path(), None).unwrap();
        Bench::over(left, standing()).await.unwrap()
    }
}

#[tokio::test]
async fn it_recovers_when_the_disk_does() {
    for (fault, trouble) in [
        (Fault::Full, Trouble::Full),
        (Fault::ReadOnly, Trouble::ReadOnly),
        (Fault::Unsynced, Trouble::Failing),
    ] {
        let store = Failing::new().await;
        let before = store.bench.submit("s0").await;
        store.disk.fail(Some(fault));
        let first = store.refused().await;
        assert!(first.to_string().contains(&trouble.to_string()), "{fault:?}: {first}");
        assert_eq!(matches!(first, Refusal::ResourceExhausted { .. }), fault == Fault::Full);
        // A commit that could not be synced may be there all the same.
        let is_certain = !first.to_string().contains("perhaps nothing was stored");
        assert_eq!(is_certain, fault != Fault::Unsynced, "{first}");
        store.until(Some(trouble)).await;
        // Whoever asks while it is being reopened is refused as well, and what was stored can be read.
        assert_eq!(store.refused().await, first);
        let read = store.bench.store.reads.request(before.id).await.unwrap();
        assert_eq!(read.as_ref(), Some(&before), "{fault:?}");

        store.disk.fail(None);
        store.until(None).await;
        let after = store.bench.submit("s1").await;
        assert!(after.id > before.id && after.change > before.change);
        let bench = store.after_a_cut().await;
        for request in [before, after] {
            let read = bench.store.reads.request(request.id).await.unwrap();
            assert_eq!(read, Some(request), "{fault:?}");
        }
    }
}

#[tokio::test]
async fn a_service_that_is_ended_while_its_disk_fails_says_why() {
    let store = Failing::new().await;
    store.disk.fail(Some(Fault::Full));
    store.refused().await;
    store.until(Some(Trouble::Full)).await;
    let ended = timeout(Duration::from_secs(30), store.bench.store.close()).await.unwrap();
    assert!(ended.unwrap_err().to_string().contains("full"));
}
