use std::sync::atomic::{AtomicUsize, Ordering};

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;

use super::{Effort, Guide, Kept, Rule};
use crate::framework::definition;
use crate::framework::tests::drawn;
use crate::instance::Instance;
use crate::policy::{Batch, Problem, QError, QFunction};
use crate::scenario::{Document, Scenario};
use crate::solvers::Budget;
use crate::stop::MaxIterations;
use crate::tour::{Tour, Value};

/// Asks a guide by the rule.
fn guided<T>(document: &Document, ask: impl FnOnce(&Guide<'_>) -> T) -> T {
    let scenario = Scenario::from_document(document).unwrap();
    let instance = Instance::new(&scenario);
    let problem = Problem::of(scenario.objective);
    ask(&Guide::new(&instance, definition(problem), &Rule(problem)))
}

/// The best value that an effort gives.
fn best(document: &Document, effort: Effort) -> (Value, u64) {
    guided(document, |guide| {
        let mut kept = Kept::nothing(guide.instance);
        let mut rng = Pcg64Mcg::seed_from_u64(1);
        let mut budget = Budget::new(&MaxIterations(1_000));
        guide.construct(effort, &mut rng, &mut budget, &mut kept).unwrap();
        let tour = Tour::new(guide.instance, &kept.order);
        assert!(tour.is_legal());
        assert_eq!(
            Value::of(guide.instance, &tour).compare(&kept.value),
            std::cmp::Ordering::Equal
        );
        (kept.value, kept.roll_outs)
    })
}

#[test]
fn a_beam_of_one_is_the_greedy_roll_out() {
    for seed in 0..10 {
        for document in drawn(seed) {
            guided(&document, |guide| {
                let mut greedy = [guide.begin()];
                guide.greedy(&mut greedy, 1).unwrap();
                let beam = guide.beam(1).unwrap();
                assert_eq!(beam.len(), 1);
                assert_eq!(beam[0].order(), greedy[0].order());
            });
        }
    }
}

#[test]
fn several_actions_at_once_value_fewer_states() {
    let (mut alone, mut pairs) = ((0, 0), (0, 0));
    for document in drawn(4) {
        guided(&document, |guide| {
            for (at_once, sum) in [(1, &mut alone), (2, &mut pairs)] {
                let mut ends = [guide.begin()];
                let before = guide.valued();
                guide.greedy(&mut ends, at_once).unwrap();
                assert!(ends[0].is_over());
                sum.0 += guide.valued() - before;
                sum.1 += ends[0].order().len() as u64;
            }
        });
    }
    assert_eq!(alone.0, alone.1, "one state for each stop");
    assert!(4 * pairs.0 < 3 * pairs.1, "{pairs:?}");
}

#[test]
fn cold_samples_are_greedy_and_hot_ones_differ() {
    let [document, ..] = drawn(2);
    guided(&document, |guide| {
        let mut greedy = [guide.begin()];
        guide.greedy(&mut greedy, 1).unwrap();
        let mut rng = Pcg64Mcg::seed_from_u64(5);
        let mut cold = vec![guide.begin(); 4];
        guide.sample(&mut cold, 0.0, &mut rng).unwrap();
        assert!(cold.iter().all(|end| end.order() == greedy[0].order()));
        let mut hot = vec![guide.begin(); 8];
        guide.sample(&mut hot, 1.0, &mut rng).unwrap();
        assert!(hot.iter().any(|end| end.order() != hot[0].order()));
    });
}

#[test]
fn every_part_only_adds() {
    let parts = [
        Effort { beam: 8, ..Effort::GREEDY },
        Effort { look_ahead: 4, ..Effort::GREEDY },
        Effort { samples: 20, temperature: 0.3, ..Effort::GREEDY },
        Effort { orders: 16, ..Effort::GREEDY },
    ];
    let mut gained = [0; 4];
    for seed in 0..15 {
        for document in drawn(seed) {
            let (greedy, one) = best(&document, Effort::GREEDY);
            assert_eq!(one, 1);
            for (part, gained) in parts.iter().zip(&mut gained) {
                let (value, _) = best(&document, *part);
                assert!(!greedy.beats(&value), "{part:?}");
                *gained += usize::from(value.beats(&greedy));
            }
        }
    }
    assert!(gained.iter().all(|&gained| gained > 0), "each part must help somewhere: {gained:?}");
}

#[test]
fn the_whole_effort_is_at_most_32_roll_outs() {
    let problems = [Problem::KCoverage, Problem::Reward, Problem::Mobile];
    for (document, problem) in drawn(4).iter().zip(problems) {
        let (_, roll_outs) = best(document, Effort::whole(problem));
        assert!((2..=32).contains(&roll_outs), "{roll_outs}");
    }
}

/// A function that may be asked for so many states.
struct Hurried(Rule, AtomicUsize);

impl QFunction for Hurried {
    fn values(&self, batch: &Batch) -> Result<Vec<f32>, QError> {
        self.0.values(batch)
    }

    fn has_time(&self) -> bool {
        let left = |left: usize| left.checked_sub(1);
        self.1.fetch_update(Ordering::Relaxed, Ordering::Relaxed, left).is_ok()
    }
}

#[test]
fn a_function_without_time_is_left_within_a_step() {
    let [document, ..] = drawn(2);
    let scenario = Scenario::from_document(&document).unwrap();
    let instance = Instance::new(&scenario);
    let problem = Problem::of(scenario.objective);
    let asked = guided(&document, |guide| {
        guide.beam(3).unwrap();
        guide.valued()
    });
    let beam = |states: usize| {
        let hurried = Hurried(Rule(problem), AtomicUsize::new(states));
        let guide = Guide::new(&instance, definition(problem), &hurried);
        guide.beam(3).map(|ends| ends.len()).map_err(|error| (error, guide.valued()))
    };
    let enough = usize::try_from(asked).unwrap();
    assert!(enough > 3 && beam(enough).is_ok());
    let (error, valued) = beam(enough - 1).unwrap_err();
    assert_eq!(error, QError::TooSlow);
    assert!(valued < asked, "the last step is not begun");
}
