//! The explainer over a real database: what it explains, what it leaves alone, and what it gives up.

use std::time::Duration;

use tokio_util::sync::CancellationToken;
use voltour_solver::explain::{Explanation, explain};
use voltour_solver::plan::Plan;
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{SolverName, solve};
use voltour_solver::stop::StopRule;

use super::{Explainer, Settings};
use crate::clock::{Clock, SystemClock};
use crate::domain::PlanId;
use crate::metrics::Metrics;
use crate::planner::{Contest, plan};
use crate::policy::Policies;
use crate::store::fixture::Bench;
use crate::store::{Attempt, BeginExplanation, EndExplanation, Explained, StorePlan};

/// Plans the open requests and stores that; the plan's id.
async fn planned(bench: &Bench, charger: &str) -> PlanId {
    let batch = bench.closed(bench.announce(charger).await).await;
    let contest = Contest {
        solver: SolverName::Greedy,
        solve,
        policies: Policies::none().into(),
        seed: 0,
        budget: Duration::ZERO,
        latest: bench.clock.now(),
        clock: bench.clock.clone(),
        cancel: CancellationToken::new(),
    };
    let (departure_id, start) = (batch.departure.id, batch.start);
    let plan = plan(&batch, &contest).unwrap().new;
    bench.store.writer.call(StorePlan { departure_id, start, plan }).await.unwrap();
    bench.store.reads.departure(departure_id).await.unwrap().unwrap().plan_id.unwrap()
}

/// A plan whose documents are none.
async fn broken(bench: &Bench, charger: &str) -> PlanId {
    let tour = bench.tour(charger, &[]).await;
    bench.store.reads.tour(tour).await.unwrap().unwrap().plan_id
}

/// An explainer, and what ends it.
fn explainer(bench: &Bench) -> (Explainer, CancellationToken) {
    let (reads, writer) = (bench.store.reads.clone(), bench.store.writer.clone());
    let settings = Settings { budget: Duration::from_secs(60), seed: 0 };
    let (cancel, clock) = (CancellationToken::new(), std::sync::Arc::new(SystemClock));
    let metrics = Metrics::default();
    (Explainer::new(reads, writer, clock, settings, metrics, cancel.clone()), cancel)
}

async fn explained(bench: &Bench, id: PlanId) -> Explained {
    bench.store.reads.explanation(id).await.unwrap().unwrap()
}

/// Waits until no plan waits any more for its explanation.
async fn done(bench: &Bench) {
    for _ in 0..2_000 {
        if bench.store.reads.unexplained().await.unwrap().is_none() {
            return;
        }
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    panic!("still unexplained");
}

fn panics(_: &Scenario, _: &Plan, _: u64, _: &dyn StopRule) -> Explanation {
    panic!("a defect")
}

/// Looks at the stop rule for as long as that lets it.
fn dawdles(scenario: &Scenario, plan: &Plan, seed: u64, stop: &dyn StopRule) -> Explanation {
    while !stop.should_stop(0) {
        std::thread::sleep(Duration::from_millis(1));
    }
    Explanation { complete: false, ..explain(scenario, plan, seed, stop) }
}

#[tokio::test]
async fn plans_from_before_and_from_now_on_are_explained() {
    let bench = Bench::new().await;
    bench.submit("s1").await;
    let before = planned(&bench, "a").await;
    let (explainer, cancel) = explainer(&bench);
    let running = tokio::spawn(explainer.run());
    done(&bench).await;
    bench.submit("s2").await;
    let after = planned(&bench, "b").await;
    // Nothing but the commit of the tour wakes it.
    done(&bench).await;
    for (id, sensor) in [(before, "s1"), (after, "s2")] {
        let Explained::Document(document) = explained(&bench, id).await else { panic!("{id}") };
        let explanation: Explanation = serde_json::from_slice(&document).unwrap();
        assert_eq!(explanation.served[0].sensor, sensor);
        assert!(explanation.complete);
    }
    cancel.cancel();
    running.await.unwrap();
}

#[tokio::test]
async fn a_panic_or_an_unreadable_plan_is_given_up_at_once_and_keeps_nobody_up() {
    let bench = Bench::new().await;
    let (unreadable, panicking) = (broken(&bench, "a").await, planned(&bench, "b").await);
    let (mut explainer, cancel) = explainer(&bench);
    explainer.explain = panics;
    let running = tokio::spawn(explainer.run());
    done(&bench).await;
    cancel.cancel();
    running.await.unwrap();
    for id in [unreadable, panicking] {
        assert_eq!(explained(&bench, id).await, Explained::GivenUp);
    }
}

#[tokio::test]
async fn an_attempt_that_the_end_of_the_service_cuts_short_does_not_count() {
    let bench = Bench::new().await;
    let id = planned(&bench, "a").await;
    for _ in 0..4 {
        let (mut explainer, cancel) = explainer(&bench);
        explainer.explain = dawdles;
        let running = tokio::spawn(explainer.run());
        tokio::time::sleep(Duration::from_millis(50)).await;
        cancel.cancel();
        running.await.unwrap();
        assert_eq!(explained(&bench, id).await, Explained::NotYet);
    }
    let (explainer, cancel) = explainer(&bench);
    let running = tokio::spawn(explainer.run());
    done(&bench).await;
    cancel.cancel();
    running.await.unwrap();
    assert!(matches!(explained(&bench, id).await, Explained::Document(_)));
}

#[tokio::test]
async fn a_plan_that_kills_the_process_is_tried_three_times() {
    let mut bench = Bench::new().await;
    let id = planned(&bench, "a").await;
    for left in [true, true, true, false] {
        assert_eq!(bench.store.reads.unexplained().await.unwrap().is_some(), left);
        let begun = bench.store.writer.call(BeginExplanation { plan_id: id }).await.unwrap();
        assert_eq!(begun, left);
        bench = bench.crashed().await;
    }
    assert_eq!(explained(&bench, id).await, Explained::GivenUp);
}

#[tokio::test]
async fn what_is_explained_stays_as_it_is() {
    let bench = Bench::new().await;
    let plan_id = planned(&bench, "a").await;
    let end = |text: &[u8]| {
        let attempt = Attempt::Explained(crate::store::pack(text).unwrap());
        bench.store.writer.call(EndExplanation { plan_id, attempt })
    };
    assert!(bench.store.writer.call(BeginExplanation { plan_id }).await.unwrap());
    end(b"first").await.unwrap();
    end(b"second").await.unwrap();
    assert!(!bench.store.writer.call(BeginExplanation { plan_id }).await.unwrap());
    assert_eq!(explained(&bench, plan_id).await, Explained::Document(b"first".to_vec()));
}

#[tokio::test]
async fn the_newest_plan_comes_first_and_old_ones_are_left_alone() {
    let bench = Bench::new().await;
    let oldest = broken(&bench, "c0").await;
    let mut newest = oldest;
    for i in 1..=100 {
        newest = broken(&bench, &format!("c{i}")).await;
    }
    assert_eq!(bench.store.reads.unexplained().await.unwrap(), Some(newest));
    let (explainer, cancel) = explainer(&bench);
    let running = tokio::spawn(explainer.run());
    done(&bench).await;
    cancel.cancel();
    running.await.unwrap();
    assert_eq!(explained(&bench, oldest).await, Explained::NotYet);
    assert_eq!(explained(&bench, newest).await, Explained::GivenUp);
}
