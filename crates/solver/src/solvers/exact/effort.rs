//! How much work a proof may be, and how much search for the tour comes before its first bound.

use super::solve::is_feasible;
use crate::instance::Instance;
use crate::scenario::Objective;
use crate::solvers::baseline;

/// How much work a proof may be: rounds, by the size of what they work on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// As long as the budget lasts; after a number of rounds searches have long reached their limits.
    Whole,
    /// What a second or two are worth, so that the rest of a planner's time is left to others.
    Share,
}

/// Iterations of the baseline before the first bound: a good tour of a small instance.
const FIRST: u64 = 60;
/// In a share, whose budget may end before the first bound is there: so many for each stop of the tour, too.
const FIRST_PER_STOP_OF_SHARE: u64 = 8;
/// And where nothing moves and metres are the cost, one for so many of the fourth power of the stops, up to a limit:
/// the more stops, the longer the bounds take and the less they show, while the tour may still have the wrong stops.
/// Tours of fewer stops than this are proven about as soon as they are searched for.
const FOURTH_POWERS_PER_FIRST: u64 = 110;
const FEWEST_STOPS_OF_POWER: u64 = 21;
const MOST_OF_POWER: u64 = 14_000;
/// In a share where the stops at moving sensors are counted, no more: the proof's own search finds better tours.
const FIRST_OF_COUNT: u64 = 5;
/// Iterations of the baseline for each cube of the stops that a tour needs where its proof is long.
const LONG_PER_CUBE: u64 = 3;
/// Where metres are the cost and nothing moves, tours of so many stops, chosen among so many candidates and at most
/// this share of them, mostly have a long proof.
const FEWEST_STOPS_OF_LONG: u64 = 19;
const CANDIDATES_OF_LONG: std::ops::RangeInclusive<u64> = 30..=64;
const MOST_STOPS_OF_LONG: f64 = 0.75;
/// So much of what they need comes before the first bound at most.
const MOST_BEFORE: u64 = 36_000;

/// The search for the tour that comes before the first bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct First {
    /// Iterations of the baseline.
    pub iterations: u64,
    /// Whether a tour whose proof is long needs no more of them.
    pub whole: bool,
}

impl First {
    /// The search from a tour `start` on. Until it is over, a share does what the baseline alone would do.
    pub fn of(effort: Effort, instance: &Instance<'_>, start: &[u32]) -> Self {
        let part = |iterations| Self { iterations, whole: false };
        if effort == Effort::Whole {
            return part(FIRST);
        }
        let stops = start.len() as u64;
        let first = FIRST + FIRST_PER_STOP_OF_SHARE * stops;
        let power = match instance.scenario.objective {
            Objective::MaxCount if instance.moving => return part(FIRST_OF_COUNT),
            _ if instance.moving => return part(first),
            Objective::MinDistance if is_long(instance, stops) && is_feasible(instance, start) => {
                return Self { iterations: long_search(stops, MOST_BEFORE), whole: true };
            }
            Objective::MinDistance if stops < FEWEST_STOPS_OF_POWER => 0,
            Objective::MinDistance => stops.saturating_pow(4) / FOURTH_POWERS_PER_FIRST,
            Objective::MaxReward | Objective::MaxCount => 0,
        };
        part(baseline::whole_runs(stops, first + power.min(MOST_OF_POWER)))
    }
}

/// Iterations that a tour of so many stops needs where its proof is long, but about this many at most.
pub fn long_search(stops: u64, most: u64) -> u64 {
    baseline::whole_runs(stops, LONG_PER_CUBE.saturating_mul(stops.saturating_pow(3)).min(most))
}

fn is_long(instance: &Instance<'_>, stops: u64) -> bool {
    let candidates = instance.len() as u64;
    stops >= FEWEST_STOPS_OF_LONG
        && CANDIDATES_OF_LONG.contains(&candidates)
        && stops as f64 <= MOST_STOPS_OF_LONG * candidates as f64
}
