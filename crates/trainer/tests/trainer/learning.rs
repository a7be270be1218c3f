//! Learning is repeatable, goes on after an interruption, and learns.

use voltour_solver::instance::Instance;
use voltour_solver::policy::{Feature, Problem};
use voltour_solver::scenario::Scenario;
use voltour_trainer::dqn::{Device, Learner, Options, Pool, Targets, Training, trials, validate};
use voltour_trainer::network::Weights;
use voltour_trainer::scenarios::{Split, draw};

fn scenarios(problem: Problem, split: Split, count: u64) -> Vec<Scenario> {
    draw(problem, split, 0, count, 1).unwrap()
}

fn small(steps: u64) -> Options {
    Options {
        steps,
        width: 16,
        rounds: 2,
        episodes: 8,
        warm_up: 50,
        seed: 3,
        ..Options::defaults()
    }
}

fn trained(options: &Options, instances: &[Instance<'_>]) -> Weights {
    let pool = Pool::new(instances, Problem::Mobile).unwrap();
    let mut training = Training::new(options.clone(), pool, Device::Cpu).unwrap();
    while !training.is_over() {
        training.advance().unwrap();
    }
    training.learner.network.weights().clone()
}

#[test]
fn same_seed_same_weights() {
    let scenarios = scenarios(Problem::Mobile, Split::Training, 12);
    let instances: Vec<_> = scenarios.iter().map(Instance::new).collect();
    let plain = small(12);
    let everything = Options {
        targets: Targets::NStep,
        target_every: 4,
        rollout_states: 2,
        groups: 3,
        ..small(12)
    };
    for options in [plain, everything] {
        let weights = trained(&options, &instances);
        assert_eq!(trained(&options, &instances), weights);
        assert_ne!(trained(&Options { seed: 4, ..options }, &instances), weights);
    }
}

#[test]
fn what_is_not_seen_changes_no_value() {
    let scenarios = scenarios(Problem::Mobile, Split::Training, 6);
    let instances: Vec<_> = scenarios.iter().map(Instance::new).collect();
    let options = Options { without: vec!["slack".to_owned()], ..small(8) };
    let weights = trained(&options, &instances);
    let row =
        |feature: Feature| &weights.part(0)[feature.column() * options.width..][..options.width];
    assert!(row(Feature::Slack).iter().all(|w| *w == 0.0));
    assert!(row(Feature::Deadline).iter().all(|w| *w != 0.0));
    let unknown = Options { without: vec!["luck".to_owned()], ..options };
    assert!(unknown.checked().unwrap_err().to_string().contains("luck"));
}

#[test]
fn a_training_goes_on_where_it_was() {
    let scenarios = scenarios(Problem::Mobile, Split::Training, 6);
    let instances: Vec<_> = scenarios.iter().map(Instance::new).collect();
    let pool = || Pool::new(&instances, Problem::Mobile).unwrap();
    let options = small(16);
    let mut first = Training::new(options.clone(), pool(), Device::Cpu).unwrap();
    while first.learner.adam.steps < 8 {
        first.advance().unwrap();
    }
    let mut learner = Learner::new(first.learner.network.weights().clone(), Device::Cpu).unwrap();
    learner.adam = first.learner.adam.clone();
    let mut second = Training::resume(options, pool(), learner, first.rounds()).unwrap();
    assert!(!second.is_over());
    while !second.is_over() {
        let progress = second.advance().unwrap();
        assert!(progress.step > 8 || progress.loss.is_none());
    }
    assert_eq!(second.learner.adam.steps, 16);
    assert!(second.learner.network.weights().is_finite());
}

#[test]
fn the_agent_learns() {
    let held = scenarios(Problem::Mobile, Split::Validation, 12);
    let held: Vec<_> = held.iter().map(Instance::new).collect();
    let trials = trials(&held, Problem::Mobile, 20_000);
    assert!(trials.len() > 4, "{} proven", trials.len());
    let scenarios = scenarios(Problem::Mobile, Split::Training, 40);
    let instances: Vec<_> = scenarios.iter().map(Instance::new).collect();
    let pool = Pool::new(&instances, Problem::Mobile).unwrap();
    let mut training = Training::new(small(300), pool, Device::Cpu).unwrap();
    let before = validate(&training.learner.network, &trials);
    while !training.is_over() {
        training.advance().unwrap();
    }
    let after = validate(&training.learner.average, &trials);
    assert!(after.gap < 0.6 * before.gap, "gap {} after {}", after.gap, before.gap);
}
