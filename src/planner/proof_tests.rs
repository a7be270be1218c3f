//! What a solver claims of its tour, status and bound: stored where the check accepts it, and no tour to go
//! by where it does not.

use voltour_solver::plan::{Plan, Status};
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::{
    Options, Outcome, SolverName, Unavailable, Unfinished, empty_plan, solve,
};

use super::tests::{closed, contest, unpacked};
use super::{Contest, Solve, plan};
use crate::store::StorePlan;
use crate::store::fixture::Bench;

/// Claims what it changes of the plan that the solver asked for first has found.
fn claiming(
    scenario: &Scenario,
    options: &Options<'_>,
    claim: fn(&mut Plan),
) -> Result<Outcome, Unavailable> {
    let mut outcome = solve(scenario, &Options { solver: SolverName::Greedy, ..*options })?;
    if options.solver == SolverName::Exact {
        outcome.plan.solver = "exact".to_owned();
        claim(&mut outcome.plan);
    }
    Ok(outcome)
}

fn proves(scenario: &Scenario, options: &Options<'_>) -> Result<Outcome, Unavailable> {
    claiming(scenario, options, |plan| {
        (plan.status, plan.bound) = (Status::Optimal, Some(plan.objective));
    })
}

#[tokio::test]
async fn what_is_proven_is_stored_and_recorded() {
    let bench = Bench::new().await;
    bench.submit("s1").await;
    let batch = closed(&bench).await;
    let contest = Contest { solve: proves, ..contest(&bench, SolverName::Exact) };
    let new = plan(&batch, &contest).unwrap().new;
    assert_eq!((new.status, new.bound, new.gap()), (Status::Optimal, Some(1.0), Some(0.0)));
    let envelope = unpacked(&new.envelope);
    assert_eq!(
        (&envelope["plan"]["status"], &envelope["plan"]["bound"]),
        (&"optimal".into(), &1.0.into())
    );
    let provenance = &envelope["provenance"];
    assert_eq!((&provenance["gap"], &provenance["winner"]), (&0.0.into(), &"exact".into()));
    // And in the database, where lists and tours read it.
    let (departure_id, start) = (batch.departure.id, batch.start);
    bench.store.writer.call(StorePlan { departure_id, start, plan: new }).await.unwrap();
    let tour = bench.store.reads.tour_of(departure_id).await.unwrap().unwrap();
    assert_eq!((tour.status, tour.bound, tour.gap), (Status::Optimal, Some(1.0), Some(0.0)));
}

#[tokio::test]
async fn a_proof_that_the_check_refuses_gives_way_to_the_next() {
    let bench = Bench::new().await;
    bench.submit("s1").await;
    bench.submit("s2").await;
    let batch = closed(&bench).await;
    let liars: [(Solve, &str); 4] = [
        // Two are served: nothing can be bounded by one.
        (|s, o| claiming(s, o, |plan| plan.bound = Some(1.0)), "bound"),
        (|s, o| claiming(s, o, |plan| plan.bound = Some(f64::NAN)), "bound"),
        (|s, o| claiming(s, o, |plan| plan.status = Status::Optimal), "bound"),
        (|s, o| claiming(s, o, |plan| plan.status = Status::Infeasible), "status"),
    ];
    for (solve, refused) in liars {
        let contest = Contest { solve, ..contest(&bench, SolverName::Exact) };
        let new = plan(&batch, &contest).unwrap().new;
        assert_eq!((new.status, new.bound, new.stops.len()), (Status::Feasible, None, 2));
        let provenance = &unpacked(&new.envelope)["provenance"];
        let reason = provenance["fallback_reason"].as_str().unwrap();
        assert!(reason.starts_with("exact: ") && reason.contains(refused), "{reason}");
        assert_eq!(provenance["asked"], "exact");
        assert_ne!(provenance["winner"], "exact");
    }
}

/// Has no tour to show where it is asked for, since it came to no end.
fn does_not_finish(scenario: &Scenario, options: &Options<'_>) -> Result<Outcome, Unavailable> {
    let mut outcome = solve(scenario, &Options { solver: SolverName::Greedy, ..*options })?;
    if options.solver == SolverName::App {
        outcome.plan = empty_plan(scenario);
        outcome.unfinished = Some(Unfinished::Memory);
    }
    Ok(outcome)
}

#[tokio::test]
async fn an_algorithm_that_does_not_finish_gives_way_to_the_next() {
    let bench = Bench::new().await;
    bench.submit("s1").await;
    let batch = closed(&bench).await;
    let contest = Contest { solve: does_not_finish, ..contest(&bench, SolverName::App) };
    let new = plan(&batch, &contest).unwrap().new;
    assert_eq!(new.stops.len(), 1);
    let provenance = &unpacked(&new.envelope)["provenance"];
    assert!(provenance["fallback_reason"].as_str().unwrap().contains("did not finish"));
}
