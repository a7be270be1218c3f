//! Demonstrations: optimal tours of the exact solver, told as episodes.

use rayon::prelude::*;
use voltour_solver::instance::Instance;
use voltour_solver::plan::{Plan, Status};
use voltour_solver::policy::Problem;
use voltour_solver::solvers::{Options, SolverName, solve_compiled};
use voltour_solver::stop::MaxIterations;

use super::random::{index, stream};
use super::{Play, Sample, Trajectory};

const ORDERS: u64 = 5;

/// Orders in which the stops of a tour are put in, until the insertion function builds that tour of them.
const TRIES: usize = 64;

/// How much longer than the optimum the tour that is told may be.
const TOLERANCE: f64 = 1e-6;

/// The samples of the optimal tours of those instances that the exact solver proves within so many iterations. A
/// tour that the insertion function builds in none of the orders tried is left out.
pub fn demonstrations<'a>(
    instances: &'a [Instance<'a>],
    problem: Problem,
    iterations: u64,
    seed: u64,
) -> Vec<Sample> {
    let tell = |(i, instance): (usize, &'a Instance<'a>)| {
        let stop = MaxIterations(iterations);
        let options = Options { solver: SolverName::Exact, seed, stop: &stop, policy: None };
        let plan = solve_compiled(instance, &options).ok()?.plan;
        if plan.status != Status::Optimal {
            return None;
        }
        let mut order = candidates(instance, &plan);
        let mut rng = stream(seed, ORDERS, i as u64);
        (0..TRIES).find_map(|_| {
            let trajectory = told(instance, problem, &order, plan.objective);
            (1..order.len()).rev().for_each(|i| order.swap(i, index(&mut rng, i + 1)));
            trajectory
        })
    };
    let told: Vec<Option<Trajectory>> = instances.par_iter().enumerate().map(tell).collect();
    told.iter().flatten().flat_map(|trajectory| trajectory.samples(None)).collect()
}

/// The stops of a plan, in its order.
fn candidates(instance: &Instance<'_>, plan: &Plan) -> Vec<u32> {
    let scenario = instance.scenario;
    let name = |candidate: &u32| {
        let request = instance.candidates[*candidate as usize].request;
        &scenario.sensors[scenario.requests[request].sensor].id
    };
    let of = |sensor: &String| (0..instance.len() as u32).find(|c| name(c) == sensor);
    plan.stops.iter().filter_map(|stop| of(&stop.sensor)).collect()
}

/// The episode that takes these candidates in this order, if its tour is as good as that.
fn told<'a>(
    instance: &'a Instance<'a>,
    problem: Problem,
    order: &[u32],
    objective: f64,
) -> Option<Trajectory> {
    let mut play = Play::new(instance, problem);
    let mut trajectory = Trajectory::default();
    for candidate in order {
        let state = std::sync::Arc::new(play.encode());
        let row = state.candidates.iter().position(|c| c == candidate)?;
        state.actions[row]?;
        let reward = play.act(&state, row);
        trajectory.push(state, row as u32, reward);
    }
    let value = voltour_solver::tour::Value::of(instance, play.episode.state().tour());
    let off = (value.cost.abs() - objective.abs()).abs() / objective.abs().max(1.0);
    (play.episode.is_over() && value.is_feasible() && off <= TOLERANCE).then_some(trajectory)
}
