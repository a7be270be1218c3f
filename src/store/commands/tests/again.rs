//! The same call again: the same answer, nothing stored twice; other content is refused.

use crate::domain::{
    CancelDeparture, NetworkSpec, NewRequest, Outcome, PutNetwork, Refusal, UpdateTrajectories,
    Withdraw,
};
use crate::store::fixture::{Bench, asks, call, leaves, report, spec};
use crate::store::{Cancel, Complete, Put, TakeBack, UpdatePaths};

fn exists<T: std::fmt::Debug>(result: Result<T, Refusal>) {
    assert!(matches!(result, Err(Refusal::AlreadyExists { .. })), "{result:?}");
}

#[tokio::test]
async fn submit() {
    let bench = Bench::new().await;
    let first = bench.try_submit("x", asks("s1")).await.unwrap();
    let change = *bench.store.writer.changes().borrow();
    assert_eq!(bench.try_submit("x", asks("s1")).await.unwrap(), first);
    assert_eq!(*bench.store.writer.changes().borrow(), change, "nothing was stored");
    exists(bench.try_submit("x", asks("s2")).await);
    // Also where the rules would refuse it by now.
    let mut without = spec();
    without.sensors.remove(1);
    bench.put(without).await;
    assert_eq!(bench.try_submit("x", asks("s1")).await.unwrap().id, first.id);
}

#[tokio::test]
async fn put() {
    let bench = Bench::new().await;
    let put = |id: &str, spec, expected_version| {
        let content = PutNetwork { network_id: "n2".parse().unwrap(), spec, expected_version };
        bench.store.writer.call(Put::new(call(id, content), 1_000).unwrap())
    };
    let first = put("a", spec(), Some(0)).await.unwrap();
    assert_eq!(first.version, 1);
    let mut next = spec();
    next.charge_level = Some(0.5);
    let aborted = put("b", next.clone(), Some(0)).await;
    assert!(matches!(aborted, Err(Refusal::Aborted(_))), "{aborted:?}");
    assert_eq!(put("b", next.clone(), Some(1)).await.unwrap().version, 2);
    assert_eq!(put("a", spec(), Some(0)).await.unwrap(), first, "as it was answered then");
    exists(put("a", next, Some(0)).await);
}

#[tokio::test]
async fn announce_and_cancel() {
    let bench = Bench::new().await;
    let first = bench.try_announce("x", leaves("c", None)).await.unwrap();
    assert_eq!(first.announced.charger_type.as_deref(), Some("cart"));
    bench.advance(1_000);
    assert_eq!(bench.try_announce("x", leaves("c", None)).await.unwrap(), first);
    exists(bench.try_announce("x", leaves("d", None)).await);
    let cancel = |reason: &str| {
        let content = CancelDeparture { departure_id: first.id, reason: reason.into() };
        bench.store.writer.call(Cancel(call("y", content)))
    };
    let cancelled = cancel("rain").await.unwrap();
    assert_eq!(cancel("rain").await.unwrap(), cancelled);
    exists(cancel("snow").await);
}

#[tokio::test]
async fn withdraw_visit_and_complete() {
    let bench = Bench::new().await;
    let (kept, back) = (bench.submit("s1").await, bench.submit("s2").await);
    let withdraw = |request_id| {
        let content = Withdraw { network_id: "net".parse().unwrap(), request_id };
        bench.store.writer.call(TakeBack(call("w", content)))
    };
    let withdrawn = withdraw(back.id).await.unwrap();
    assert_eq!(withdraw(back.id).await.unwrap(), withdrawn);
    exists(withdraw(kept.id).await);

    let tour = bench.tour("c", &["s1"]).await;
    let charged = report(tour, "s1", Outcome::Charged);
    let visit = bench.try_visit("v", charged.clone()).await.unwrap();
    assert_eq!(bench.try_visit("v", charged).await.unwrap(), visit);
    exists(bench.try_visit("v", report(tour, "s1", Outcome::Failed)).await);

    let complete = |id: &str| bench.store.writer.call(Complete(call(id, tour)));
    let completed = complete("z").await.unwrap();
    assert_eq!(complete("z").await.unwrap(), completed);
    let other = complete("other").await;
    assert!(matches!(other, Err(Refusal::FailedPrecondition(_))), "{other:?}");
}

#[tokio::test]
async fn trajectories() {
    let bench = Bench::new().await;
    let update = |id: &str, x: f64| {
        let point = crate::domain::TimedPoint {
            time: "2026-01-01T00:00:00Z".parse().unwrap(),
            position_m: [x, 0.0],
        };
        let trajectories = vec![("s1".parse().unwrap(), vec![point])];
        let content = UpdateTrajectories { network_id: "net".parse().unwrap(), trajectories };
        bench.store.writer.call(UpdatePaths(call(id, content)))
    };
    assert_eq!(update("x", 1.0).await, Ok(1));
    assert_eq!(update("x", 1.0).await, Ok(1));
    exists(update("x", 2.0).await);
    assert_eq!(update("y", 3.0).await, Ok(1));
    let batch = bench.closed(bench.announce("c").await).await;
    assert_eq!(batch.paths.len(), 1);
    bench.put(NetworkSpec { charge_level: Some(0.9), ..spec() }).await;
    let batch = bench.closed(bench.announce("d").await).await;
    assert!(batch.paths.is_empty(), "a new version knows better");
}

#[tokio::test]
async fn a_refused_call_stores_nothing_and_may_come_again() {
    let bench = Bench::new().await;
    let wrong = NewRequest { residual_j: Some(101.0), ..asks("s1") };
    let refused = bench.try_submit("x", wrong).await;
    assert!(matches!(refused, Err(Refusal::Invalid(_))), "{refused:?}");
    assert!(bench.try_submit("x", asks("s1")).await.is_ok());
}
