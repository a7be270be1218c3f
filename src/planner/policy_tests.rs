//! The policy in a contest: each way to fail leads to a plan without it, with the reason recorded.

use std::sync::Arc;

use voltour_solver::policy::{Batch as States, Problem, QError, QFunction};
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{Options, Outcome, PolicyUse, SolverName, Unavailable, solve};

use super::tests::{closed, contest, unpacked};
use super::{Contest, Planned, Solve, plan};
use crate::policy::tests::{onnx::Onnx, policy, zeros};
use crate::policy::{Fallback, Policies, Winning, load};
use crate::store::fixture::Bench;

/// The policy finds nothing: what it was not lucky enough for.
fn finds_nothing(scenario: &Scenario, options: &Options<'_>) -> Result<Outcome, Unavailable> {
    let mut outcome = solve(scenario, &Options { policy: None, ..*options })?;
    if options.policy.is_some() {
        outcome.policy = PolicyUse::NoTour;
    }
    Ok(outcome)
}

/// Fails as it is told.
struct Told(QError);

impl QFunction for Told {
    fn values(&self, _: &States) -> Result<Vec<f32>, QError> {
        Err(self.0.clone())
    }
}

fn told(error: QError) -> Policies {
    Policies::new(|problem| Ok(policy(problem, Arc::new(Told(error.clone())))))
}

/// What is planned for one request, and its provenance.
async fn planned(
    solver: SolverName,
    solve: Solve,
    policies: Policies,
) -> (Planned, serde_json::Value) {
    let bench = Bench::new().await;
    bench.submit("s1").await;
    let batch = closed(&bench).await;
    let policies = policies.into();
    let contest = Contest { solve, policies, ..contest(&bench, solver) };
    let planned = plan(&batch, &contest).unwrap();
    assert_eq!(planned.new.stops.len(), 1, "a plan there is in any case");
    let provenance = unpacked(&planned.new.envelope)["provenance"].take();
    (planned, provenance)
}

fn failing(bytes: &[u8]) -> Policies {
    Policies::new(|problem| load("mobile.onnx", bytes, Some(problem)))
}

#[tokio::test]
async fn a_policy_that_built_the_tour_is_recorded() {
    let (planned, provenance) = planned(SolverName::Dqn, solve, zeros()).await;
    assert_eq!(planned.policy.winning, Some(Winning::Policy));
    let used = &provenance["policy"];
    assert_eq!((&used["name"], &used["problem"]), (&"mobile".into(), &"mobile".into()));
    assert_eq!(used["feature_version"], voltour_solver::policy::FEATURE_VERSION);
    assert_eq!(used["digest"].as_str().unwrap().len(), 64);
    assert_eq!(provenance["winner"], "dqn");
    assert!(provenance["fallback_reason"].is_null() && planned.policy.fallback.is_none());
}

#[tokio::test]
async fn each_way_to_fail_while_planning_is_recorded() {
    let ways = [
        (QError::NotFinite("NaN".to_owned()), Fallback::NotFinite),
        (QError::TooSlow, Fallback::TooSlow),
        (QError::Failed("broken".to_owned()), Fallback::Failed),
        (QError::WrongSize { expected: 1, found: 2 }, Fallback::Failed),
    ];
    for (error, fallback) in ways {
        for (solver, winner) in [(SolverName::Auto, "greedy"), (SolverName::Dqn, "baseline")] {
            let (planned, provenance) = planned(solver, solve, told(error.clone())).await;
            let (found, why) = planned.policy.fallback.unwrap();
            assert_eq!((found, planned.policy.winning), (fallback, None));
            let reason = provenance["fallback_reason"].as_str().unwrap();
            assert_eq!(reason, format!("policy: {fallback}: {why}"));
            assert!(reason.ends_with(&error.to_string()), "{reason}");
            assert_eq!(provenance["winner"], winner, "{reason}");
            assert_eq!(provenance["policy"]["name"], "mobile", "which one it was");
            assert_eq!(provenance["check"], serde_json::json!(["holds"]), "no tour was refused");
        }
    }
}

#[tokio::test]
async fn each_model_that_is_not_used_is_recorded() {
    let good = Onnx::of("mobile").bytes();
    let ways = [
        (Policies::none(), Fallback::NoModel),
        (failing(&good[..good.len() / 2]), Fallback::Damaged),
        (
            failing(&Onnx { version: "7".into(), ..Onnx::of("mobile") }.bytes()),
            Fallback::WrongVersion,
        ),
        (failing(&Onnx::of("reward").bytes()), Fallback::WrongProblem),
        (failing(&Onnx { features: 5, ..Onnx::of("mobile") }.bytes()), Fallback::WrongShape),
        (failing(&Onnx { factor: f32::NAN, ..Onnx::of("mobile") }.bytes()), Fallback::NotFinite),
    ];
    for (policies, fallback) in ways {
        for solver in [SolverName::Auto, SolverName::Dqn] {
            let error = policies.of(Problem::Mobile).unwrap_err().to_string();
            let (planned, provenance) = planned(solver, solve, policies.clone()).await;
            assert_eq!(planned.policy.fallback, Some((fallback, error.clone())));
            let reason = provenance["fallback_reason"].as_str().unwrap();
            assert_eq!(reason, format!("policy: {fallback}: {error}"));
            assert!(provenance["policy"].is_null());
            assert_ne!(provenance["winner"], "dqn");
        }
    }
}

#[tokio::test]
async fn without_a_feasible_tour_the_baseline_plans() {
    let (planned, provenance) = planned(SolverName::Dqn, finds_nothing, zeros()).await;
    assert_eq!(planned.policy.fallback.unwrap().0, Fallback::NoTour);
    assert_eq!((&provenance["asked"], &provenance["winner"]), (&"dqn".into(), &"baseline".into()));
}

#[tokio::test]
async fn who_asks_no_policy_misses_none() {
    let (planned, provenance) = planned(SolverName::Baseline, solve, Policies::none()).await;
    assert_eq!(planned.policy, super::PolicyPart::default());
    assert!(provenance["fallback_reason"].is_null() && provenance["policy"].is_null());
}

/// Claims what the check does not accept.
fn lies(scenario: &Scenario, options: &Options<'_>) -> Result<Outcome, Unavailable> {
    let mut outcome = finds_nothing(scenario, options)?;
    if options.solver == SolverName::Auto {
        outcome.plan.bound = Some(f64::NAN);
    }
    Ok(outcome)
}

#[tokio::test]
async fn both_reasons_are_told_where_there_are_two() {
    let (_, provenance) = planned(SolverName::Auto, lies, zeros()).await;
    let reason = provenance["fallback_reason"].as_str().unwrap();
    assert!(reason.starts_with("policy: no_tour: ") && reason.contains("; auto: "), "{reason}");
}

/// Takes its time: more than half of a second, on a clock on which every look takes a thousandth.
struct Dawdles(Arc<dyn crate::clock::Clock>);

impl QFunction for Dawdles {
    fn values(&self, batch: &States) -> Result<Vec<f32>, QError> {
        for _ in 0..600 {
            let _ = self.0.now();
        }
        Ok(vec![0.0; batch.mask.len()])
    }
}

#[tokio::test]
async fn a_policy_past_its_share_of_the_time_is_left() {
    let bench = Bench::new().await;
    bench.submit("s1").await;
    let batch = closed(&bench).await;
    let contest = contest(&bench, SolverName::Dqn);
    let clock = contest.clock.clone();
    let slow = Policies::new(|problem| Ok(policy(problem, Arc::new(Dawdles(clock.clone())))));
    let planned = plan(&batch, &Contest { policies: slow.into(), ..contest }).unwrap();
    assert_eq!(planned.policy.fallback.unwrap().0, Fallback::TooSlow);
    assert_eq!(planned.new.solver, "baseline");
}

#[tokio::test]
async fn the_same_batch_and_policy_give_the_same_plan() {
    let bench = Bench::new().await;
    for sensor in ["s1", "s2", "s3", "s4"] {
        bench.submit(sensor).await;
    }
    let batch = closed(&bench).await;
    let bytes = Onnx::of("mobile").bytes();
    let plans = [(); 2].map(|()| {
        let contest =
            Contest { policies: failing(&bytes).into(), ..contest(&bench, SolverName::Auto) };
        let new = plan(&batch, &contest).unwrap().new;
        unpacked(&new.envelope)["plan"]["stops"].take()
    });
    assert_eq!(plans[0], plans[1]);
    assert_eq!(plans[0].as_array().unwrap().len(), 4);
}
