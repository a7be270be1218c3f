//! The writer under what can go wrong: a command that breaks its transaction, a commit that fails, a
//! second process, the end of the service.

use std::sync::Arc;
use std::time::Duration;

use tokio::sync::Notify;

use super::task::QUEUE;
use super::{Command, Failure, Writing};
use crate::clock::{Clock, ManualClock, SystemClock, plus};
use crate::domain::Refusal;
use crate::metrics::Metrics;
use crate::store::fixture::{Bench, asks, call};
use crate::store::{Store, StoreError, Submit, Trouble};

/// Keeps the writer busy, so that what is called meanwhile is one group.
struct Dawdle;

impl Command for Dawdle {
    type Answer = ();

    async fn apply(&self, _: &mut Writing) -> Result<(), Failure> {
        tokio::time::sleep(Duration::from_millis(100)).await;
        Ok(())
    }
}

/// Writes something, then breaks its transaction.
struct Break;

impl Command for Break {
    type Answer = ();

    async fn apply(&self, w: &mut Writing) -> Result<(), Failure> {
        sqlx::query("UPDATE networks SET version = 77").execute(&mut w.conn).await?;
        sqlx::query("INSERT INTO networks (id) VALUES (NULL)").execute(&mut w.conn).await?;
        Ok(())
    }
}

/// Writes what makes the commit itself fail.
struct FailCommit;

impl Command for FailCommit {
    type Answer = ();

    async fn apply(&self, w: &mut Writing) -> Result<(), Failure> {
        sqlx::query("PRAGMA defer_foreign_keys = ON").execute(&mut w.conn).await?;
        sqlx::query("INSERT INTO trajectories VALUES ('nowhere', 's', '[]', 0)")
            .execute(&mut w.conn)
            .await?;
        Ok(())
    }
}

/// Takes two seconds, in which the wall clock is set on by an hour.
struct SetOn(Arc<ManualClock>);

impl Command for SetOn {
    type Answer = ();

    async fn apply(&self, _: &mut Writing) -> Result<(), Failure> {
        self.0.set(plus(self.0.now(), Duration::from_secs(3_600)));
        self.0.advance(Duration::from_secs(2));
        Ok(())
    }
}

#[tokio::test]
async fn a_clock_that_is_set_makes_no_transaction_longer() {
    let bench = Bench::new().await;
    let metrics = Metrics::new(bench.clock.clone(), bench.store.writer.metrics());
    bench.store.writer.call(SetOn(bench.clock.clone())).await.unwrap();
    // The answer comes when the transaction has been counted.
    let text = metrics.text().unwrap();
    assert!(text.lines().any(|line| line == "voltour_commit_time_seconds_sum 2.0"), "{text}");
}

#[tokio::test]
async fn a_command_that_breaks_its_transaction_takes_nobody_with_it() {
    let bench = Bench::new().await;
    let writer = &bench.store.writer;
    let submit = |sensor: &str| writer.call(Submit::new(call(sensor, asks(sensor))));
    let (_, first, broken, second) =
        tokio::join!(writer.call(Dawdle), submit("s1"), writer.call(Break), submit("s2"));
    assert!(matches!(broken, Err(Refusal::Internal(_) | Refusal::Unavailable(_))), "{broken:?}");
    let (first, second) = (first.unwrap(), second.unwrap());
    assert!(first.change < second.change);
    for stored in [&first, &second] {
        let read = bench.store.reads.request(stored.id).await.unwrap();
        assert_eq!(read.as_ref(), Some(stored));
    }
    let network = bench.store.reads.network(&"net".parse().unwrap()).await.unwrap().unwrap();
    assert_eq!(network.version, 1, "what the broken one wrote is gone");
}

#[tokio::test]
async fn after_a_failed_commit_nothing_is_acknowledged_until_the_database_is_verified() {
    let bench = Bench::new().await;
    let before = bench.submit("s0").await;
    let writer = &bench.store.writer;
    let submit = |sensor: &str| writer.call(Submit::new(call(sensor, asks(sensor))));
    let (_, lost, failed) =
        tokio::join!(writer.call(Dawdle), submit("s1"), writer.call(FailCommit));
    assert!(matches!(lost, Err(Refusal::Unavailable(_))), "{lost:?}");
    assert!(matches!(failed, Err(Refusal::Unavailable(_))), "{failed:?}");
    let again = submit("s1").await.unwrap();
    assert_eq!(again.change, before.change + 1);
    assert!(again.id > before.id);
    assert_eq!(bench.state(again.id).await, crate::domain::RequestState::Open);
}

/// Until the log is written back, nothing shows that the disk syncs.
#[tokio::test]
async fn a_log_that_is_in_use_is_waited_for() {
    let bench = Bench::new().await;
    let writer = &bench.store.writer;
    let mut told = bench.store.reads.trouble();
    let mut reader = bench.store.reads.pool().begin().await.unwrap();
    let count = "SELECT count(*) FROM requests";
    let _: i64 = sqlx::query_scalar(count).fetch_one(&mut *reader).await.unwrap();
    bench.submit("s0").await;
    writer.call(FailCommit).await.unwrap_err();
    told.wait_for(|told| *told == Some(Trouble::Locked)).await.unwrap();
    reader.rollback().await.unwrap();
    told.wait_for(Option::is_none).await.unwrap();
    bench.submit("s1").await;
}

#[tokio::test]
async fn callers_do_not_wait_until_a_lock_is_given_up() {
    let bench = Bench::new().await;
    let mut told = bench.store.reads.trouble();
    let mut other = crate::store::open::connect(&bench.path(), false).await.unwrap();
    sqlx::query("BEGIN IMMEDIATE").execute(&mut other).await.unwrap();
    bench.try_submit("a", asks("s1")).await.unwrap_err();
    told.wait_for(Option::is_some).await.unwrap();
    // It is told again after the first attempt, which waits for the lock.
    tokio::select! {
        biased;
        _ = told.changed() => panic!("the first attempt is over"),
        refused = bench.try_submit("a", asks("s1")) => assert!(refused.is_err(), "{refused:?}"),
    }
    sqlx::query("ROLLBACK").execute(&mut other).await.unwrap();
    told.wait_for(Option::is_none).await.unwrap();
    bench.try_submit("a", asks("s1")).await.unwrap();
}

#[tokio::test]
async fn a_second_process_is_refused() {
    let bench = Bench::new().await;
    let path = bench.dir.path().join("db");
    let second = Store::open(&path, Arc::new(SystemClock)).await;
    assert!(matches!(second, Err(StoreError::InUse(_))), "{second:?}");
    let bench = bench.reopened().await;
    bench.submit("s0").await;
}

#[tokio::test]
async fn the_change_goes_on_after_a_restart() {
    let bench = Bench::new().await;
    let first = bench.submit("s1").await;
    bench.tour("c", &["s1"]).await;
    let last = *bench.store.writer.changes().borrow();
    let bench = bench.reopened().await;
    assert_eq!(*bench.store.writer.changes().borrow(), last);
    assert!(first.change < last && bench.submit("s2").await.change == last + 1);
}

#[tokio::test]
async fn at_the_end_the_queue_is_still_done() {
    let bench = Bench::new().await;
    let writer = bench.store.writer.clone();
    let queued = tokio::spawn(async move {
        let submit = Submit::new(call("x", asks("s1")));
        tokio::join!(writer.call(Dawdle), writer.call(submit)).1
    });
    tokio::time::sleep(Duration::from_millis(30)).await;
    let writer = bench.store.writer.clone();
    let bench = bench.reopened().await;
    let stored = queued.await.unwrap().unwrap();
    assert_eq!(bench.state(stored.id).await, crate::domain::RequestState::Open);
    let late = writer.call(Dawdle).await;
    assert!(matches!(late, Err(Refusal::Unavailable(_))), "{late:?}");
}

/// What a crash leaves behind: the writer is gone in the middle of its work, nobody has said goodbye.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_was_acknowledged_outlives_the_writer() {
    let mut bench = Bench::new().await;
    let mut acknowledged = Vec::new();
    for round in 0..8u64 {
        let mut calls = tokio::task::JoinSet::new();
        for i in 0..200 {
            let writer = bench.store.writer.clone();
            let submit = Submit::new(call(&format!("{round}-{i}"), asks(&format!("s{}", i % 5))));
            calls.spawn(async move { writer.call(submit).await });
        }
        tokio::time::sleep(Duration::from_millis(2 + 3 * round)).await;
        bench = bench.crashed().await;
        while let Some(answer) = calls.join_next().await {
            acknowledged.extend(answer.unwrap().ok());
        }
        for request in &acknowledged {
            let stored = bench.store.reads.request(request.id).await.unwrap().unwrap();
            assert_eq!(stored.client_id, request.client_id);
        }
        let (live, _) = bench.store.reads.live_requests(&"net".parse().unwrap()).await.unwrap();
        assert!(live.len() <= 5, "one open request a sensor");
    }
    assert!(!acknowledged.is_empty());
}

/// Keeps the writer busy until it is let go.
struct Hold(Arc<Notify>);

impl Command for Hold {
    type Answer = ();

    async fn apply(&self, _: &mut Writing) -> Result<(), Failure> {
        self.0.notified().await;
        Ok(())
    }
}

#[tokio::test]
async fn a_full_queue_refuses_callers_from_outside_and_keeps_what_it_took() {
    let bench = Bench::new().await;
    let (writer, go) = (bench.store.writer.clone(), Arc::new(Notify::new()));
    let holding = writer.enqueue(Hold(go.clone())).await.unwrap();
    // Taken by the writer, which holds: the queue is empty and stays as it is.
    while writer.room() < QUEUE {
        tokio::task::yield_now().await;
    }
    let mut taken = Vec::new();
    for i in 0..QUEUE {
        let submit = Submit::new(call(&format!("c{i}"), asks("s1")));
        taken.push(writer.enqueue_soon(submit).await.expect("the last one that fits"));
    }
    let refused = writer.offer(Submit::new(call("late", asks("s2")))).await.unwrap_err();
    assert!(matches!(refused, Refusal::ResourceExhausted { .. }), "{refused:?}");
    go.notify_one();
    holding.await.unwrap();
    for answer in taken {
        answer.await.unwrap();
    }
    let (live, _) = bench.store.reads.live_requests(&"net".parse().unwrap()).await.unwrap();
    assert_eq!(live.len(), 1, "nothing of the refused one is stored: {live:?}");
    writer.offer(Submit::new(call("late", asks("s2")))).await.unwrap();
}

#[tokio::test]
async fn what_nobody_waits_for_any_more_is_not_done() {
    let bench = Bench::new().await;
    let (writer, go) = (bench.store.writer.clone(), Arc::new(Notify::new()));
    let holding = writer.enqueue(Hold(go.clone())).await.unwrap();
    let given_up = writer.enqueue(Submit::new(call("a", asks("s1")))).await.unwrap();
    let awaited = writer.enqueue(Submit::new(call("b", asks("s2")))).await.unwrap();
    drop(given_up);
    go.notify_one();
    holding.await.unwrap();
    let stored = awaited.await.unwrap();
    let (live, _) = bench.store.reads.live_requests(&"net".parse().unwrap()).await.unwrap();
    assert_eq!(live, [stored]);
}
