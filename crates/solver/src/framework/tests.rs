use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;

use super::{Episode, definition};
use crate::generate;
use crate::instance::Instance;
use crate::policy::Problem;
use crate::scenario::{Document, Scenario};

/// Small scenarios of the three problems.
pub(crate) fn drawn(seed: u64) -> [Document; 3] {
    let k_coverage = generate::KCoverage { sensors: 32, k: 2, ..Default::default() };
    let reward = generate::Reward { sensors: 40, alpha: 1.0, ..Default::default() };
    let mobile = generate::Mobile { sensors: 12, ..Default::default() };
    [
        generate::k_coverage(&k_coverage, seed).unwrap(),
        generate::reward(&reward, seed).unwrap(),
        generate::mobile(&mobile, seed).unwrap(),
    ]
}

/// Plays random actions to the end; what it does after each is the caller's.
fn play(document: &Document, seed: u64, mut look: impl FnMut(&Episode<'_>, f64)) {
    let scenario = Scenario::from_document(document).unwrap();
    let instance = Instance::new(&scenario);
    let definition = definition(Problem::of(scenario.objective));
    let mut episode = Episode::new(&instance, definition);
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    while !episode.is_over() {
        let reward = episode.act(rng.random_range(0..episode.actions().len()));
        look(&episode, reward);
    }
}

#[test]
fn the_rewards_add_up_to_the_objective() {
    for seed in 0..20 {
        for document in drawn(seed) {
            let (mut sum, mut objective, mut failed) = (0.0, 0.0, false);
            play(&document, seed, |episode, reward| {
                sum += reward;
                objective = episode.definition().objective(episode.state());
                failed = episode.is_over() && !episode.succeeded();
                assert!((episode.earned() - sum).abs() < 1e-9);
            });
            let name = document.name.as_deref().unwrap_or_default();
            if failed {
                assert!(sum < objective - 3.0, "{name}: a failure costs, {sum} {objective}");
            } else {
                assert!((sum - objective).abs() < 1e-6, "{name}: {sum} is not {objective}");
            }
        }
    }
}

#[test]
fn every_state_is_a_legal_tour_and_every_action_keeps_it_so() {
    for seed in 0..10 {
        for document in drawn(seed) {
            play(&document, seed, |episode, _| {
                let state = episode.state();
                assert!(state.tour().is_legal());
                for action in episode.actions() {
                    let after = state.after(action.candidate, action.insertion.position);
                    assert!(after.tour().is_legal(), "{action:?} in {:?}", state.tour().order());
                }
            });
        }
    }
}

#[test]
fn k_coverage_ends_when_the_demands_are_met_or_cannot_be() {
    let (mut met, mut dead) = (0, 0);
    for seed in 0..40 {
        let [document, ..] = drawn(seed);
        play(&document, seed, |episode, _| {
            if episode.is_over() {
                let open = episode.state().open_demands();
                assert_eq!(episode.succeeded(), open == 0);
                if open == 0 { met += 1 } else { dead += 1 }
            } else {
                assert!(episode.state().open_demands() > 0);
                assert!(episode.actions().iter().all(|a| episode.state().helps(a.candidate)));
            }
        });
    }
    assert!(met > 0 && dead > 0, "both ends are reached: {met} {dead}");
}

#[test]
fn a_mobile_tour_is_appended_to() {
    let [.., document] = drawn(3);
    let mut before: Vec<u32> = Vec::new();
    play(&document, 3, |episode, _| {
        assert_eq!(episode.order()[..before.len()], before);
        before = episode.order().to_vec();
    });
    assert!(before.len() > 3);
}

#[test]
fn an_index_that_is_no_action_changes_nothing() {
    let [document, ..] = drawn(0);
    let scenario = Scenario::from_document(&document).unwrap();
    let instance = Instance::new(&scenario);
    let mut episode = Episode::new(&instance, definition(Problem::KCoverage));
    assert_eq!(episode.act(usize::MAX), 0.0);
    assert!(episode.order().is_empty());
}
