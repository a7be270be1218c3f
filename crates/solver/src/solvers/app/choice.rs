//! Which of the two a scenario asks for.

use super::{mobile, reward};
use crate::instance::Instance;
use crate::scenario::Objective;
use crate::solvers::Budget;
use crate::solvers::paper::{Attempt, PaperOptions, is_step};

/// Recursion levels beyond which no tour could be that long.
const MOST_LEVELS: u32 = 12;

/// The algorithm of the scenario's objective.
pub(in crate::solvers) fn app(
    instance: &Instance<'_>,
    options: &PaperOptions,
    budget: &mut Budget<'_>,
) -> Attempt {
    match instance.scenario.objective {
        Objective::MaxReward => reward::app(instance, options, budget),
        Objective::MaxCount => mobile::app(instance, options, budget),
        Objective::MinDistance => Attempt::finished(Vec::new()),
    }
}

/// What a scenario or the options lack for either algorithm to say anything of it.
pub(in crate::solvers) fn app_needs(
    instance: &Instance<'_>,
    options: &PaperOptions,
) -> Option<&'static str> {
    let free = instance.demands.demands.is_empty();
    let (holds, needs) = match instance.scenario.objective {
        Objective::MaxReward => (
            free && instance.untimed && instance.metric && instance.timespan_s.is_infinite(),
            "a capacity to be the only limit, and straight ways",
        ),
        Objective::MaxCount => (
            free && instance.timespan_s.is_finite()
                && instance.capacity_j.is_infinite()
                && is_step(options.app_step_s)
                && (0.0..1.0).contains(&options.app_epsilon)
                && (1..=MOST_LEVELS).contains(&options.app_level),
            "a time span and no capacity, in steps above 0, epsilon in [0, 1) and 1 to 12 levels",
        ),
        Objective::MinDistance => (false, "the largest reward or number to be sought"),
    };
    (!holds).then_some(needs)
}
