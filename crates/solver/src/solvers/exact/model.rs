//! What a proof is about: the instance with its limits as wide as the check lets them be, and what of
//! a partial tour decides how well it can go on.

use crate::instance::{Demand, Instance};
use crate::scenario::Objective;
use crate::tolerance::tolerance;

/// What is looked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// A tour that no other beats.
    Optimum,
    /// Any feasible tour.
    AnyTour,
}

/// Beyond this many candidates a matrix is taken to break the triangle inequality: looking would take longer
/// than what it may save.
const MOST_TRIANGLES: usize = 300;

/// An instance as the proof sees it. Costs are minimised: metres, or negated rewards.
#[derive(Debug)]
pub struct Model<'a> {
    /// With limits that hold for every tour that the check accepts.
    pub wide: Instance<'a>,
    /// With limits that a solver keeps to.
    pub strict: &'a Instance<'a>,
    /// What is looked for.
    pub aim: Aim,
    /// By candidate, what serving it takes off the cost.
    pub gains: Vec<f64>,
    /// Whether metres are the cost.
    pub length_counts: bool,
    /// What must be served; single members first, none implied by another.
    pub demands: Vec<Demand>,
    /// For each candidate, the demands that it helps to meet.
    pub of: Vec<Vec<u32>>,
    /// A stop that no open demand asks for is never worth making.
    pub useful_only: bool,
    /// No stop on the way makes a place reachable sooner or with less energy.
    pub direct: bool,
    /// A later time may make a tour worse.
    pub time_counts: bool,
    /// More energy spent may make a tour worse.
    pub energy_counts: bool,
}

impl<'a> Model<'a> {
    pub fn new(strict: &'a Instance<'a>, aim: Aim) -> Self {
        let wide = widened(strict);
        let optimum = aim == Aim::Optimum;
        let objective = strict.scenario.objective;
        let gain = |c: &crate::instance::Candidate| match objective {
            Objective::MaxReward if optimum => c.reward,
            Objective::MaxCount if optimum => 1.0,
            _ => 0.0,
        };
        let gains: Vec<f64> = wide.candidates.iter().map(gain).collect();
        let length_counts = optimum && objective == Objective::MinDistance;
        let demands = simplified(strict.demands.demands.clone());
        let mut of = vec![Vec::new(); wide.len()];
        for (d, demand) in (0u32..).zip(&demands) {
            for &member in &demand.members {
                of[member as usize].push(d);
            }
        }
        let drains = wide.candidates.iter().any(|c| c.drain_w > 0.0);
        let energy_counts = wide.capacity_j.is_finite();
        let looked_at = !wide.moving && wide.len() <= MOST_TRIANGLES;
        let triangle = wide.metric || looked_at && keeps_triangle(&wide);
        Self {
            useful_only: gains.iter().all(|&gain| gain == 0.0) && !wide.moving && triangle,
            direct: wide.moving && !energy_counts || !wide.moving && triangle,
            time_counts: wide.timespan_s.is_finite()
                || wide.candidates.iter().any(|c| c.due_s.is_finite())
                || drains && energy_counts,
            energy_counts,
            wide,
            strict,
            aim,
            gains,
            length_counts,
            demands,
            of,
        }
    }

    /// Number of candidates.
    pub fn len(&self) -> usize {
        self.wide.len()
    }

    /// What travelling so far and gaining `gain` costs.
    #[inline]
    pub fn cost(&self, length_m: f64, gain: f64) -> f64 {
        if self.length_counts { length_m } else { -gain }
    }
}

/// The instance with the whole tolerance instead of a solver's half of it, and a little for rounding.
fn widened<'a>(strict: &Instance<'a>) -> Instance<'a> {
    let widen = |limit: f64| {
        if limit.is_finite() { limit + 0.501 * tolerance(limit) } else { limit }
    };
    let mut wide = strict.clone();
    for candidate in &mut wide.candidates {
        candidate.due_s = widen(candidate.due_s);
    }
    wide.timespan_s = widen(wide.timespan_s);
    wide.capacity_j = widen(wide.capacity_j);
    wide
}

/// Whether no detour over a candidate is shorter than the way itself.
fn keeps_triangle(instance: &Instance<'_>) -> bool {
    let n = instance.len();
    let froms = (0..n).chain([instance.start()]);
    froms.into_iter().all(|a| {
        (0..n).filter(|&b| b != a).all(|b| {
            let leg = instance.distance_m(a, b);
            (0..n)
                .chain([instance.end()])
                .filter(|&c| c != a && c != b)
                .all(|c| instance.distance_m(a, c) <= leg + instance.distance_m(b, c))
        })
    })
}

/// The demands with those candidates that must be served taken out of the others, the rest without
/// those that another implies.
fn simplified(mut rest: Vec<Demand>) -> Vec<Demand> {
    let mut must: Vec<u32> = Vec::new();
    loop {
        let before = must.len();
        for demand in &mut rest {
            let had = demand.members.len();
            demand.members.retain(|member| must.binary_search(member).is_err());
            demand.needs = demand.needs.saturating_sub((had - demand.members.len()) as u32);
        }
        rest.retain(|demand| demand.needs > 0);
        for demand in rest.iter().filter(|d| d.needs as usize >= d.members.len()) {
            must.extend(&demand.members);
        }
        must.sort_unstable();
        must.dedup();
        if must.len() == before {
            break;
        }
    }
    let implies = |strong: &Demand, weak: &Demand| {
        let outside = |member: &&u32| weak.members.binary_search(member).is_err();
        strong.needs >= weak.needs + strong.members.iter().filter(outside).count() as u32
    };
    let kept = (0..rest.len()).filter(|&d| {
        (0..rest.len()).all(|other| {
            other == d
                || !implies(&rest[other], &rest[d])
                || other > d && implies(&rest[d], &rest[other])
        })
    });
    let single =
        |&member: &u32| Demand { members: vec![member], needs: 1, sets: 1, required: false };
    must.iter().map(single).chain(kept.map(|d| rest[d].clone())).collect()
}
