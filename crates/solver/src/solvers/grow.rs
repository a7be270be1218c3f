//! Cheapest feasible insertion, step by step: whom to insert is a score, where is the cheapest place.
//!
//! The cheapest place of each candidate is remembered and only looked for anew where the last
//! insertion broke it, so that a step costs a few evaluations a candidate.

use super::Budget;
use super::partial::{Partial, gain};
use crate::instance::Instance;
use crate::tour::Insertion;

/// The remembered place of a candidate.
#[derive(Clone, Copy, Debug)]
struct Place {
    candidate: u32,
    insertion: Option<Insertion>,
}

/// How the next candidate is chosen.
pub struct Rule<'a> {
    /// Weight of each demand.
    pub weight: &'a [f64],
    /// What one unit of the objective is worth beside the weights.
    pub unit: f64,
    /// Candidates that an open demand cannot do without come first.
    pub must_first: bool,
    /// Exponent of the effort: 0 ignores it, 1 is gain per effort.
    pub power: f64,
}

/// Inserts candidates of `pool` as long as one is worth something and has a legal place. `noise` is a
/// factor on each score, asked once a candidate and step. Returns whether the budget lasted.
pub fn grow(
    instance: &Instance<'_>,
    partial: &mut Partial,
    pool: &[u32],
    rule: &Rule<'_>,
    mut noise: impl FnMut() -> f64,
    mut budget: Option<&mut Budget<'_>>,
) -> bool {
    let outside = pool.iter().filter(|&&c| !partial.tour.serves(c));
    let mut places: Vec<Place> =
        outside.map(|&candidate| Place { candidate, insertion: None }).collect();
    let mut fresh = None;
    loop {
        if fresh.is_none() || !instance.demands.demands.is_empty() {
            places.retain(|place| worth(instance, partial, place.candidate, rule) > 0.0);
        }
        for place in &mut places {
            place.update(instance, partial, fresh);
        }
        let must = if rule.must_first && !instance.demands.demands.is_empty() {
            must(instance, partial, &places)
        } else {
            Vec::new()
        };
        let mut best: Option<(bool, f64, u32, Insertion)> = None;
        for place in &places {
            let Some(insertion) = place.insertion else { continue };
            let first = must.get(place.candidate as usize).copied().unwrap_or(false);
            let effort = insertion.effort.max(1e-9);
            // `powf` is dear, and most rules ask for gain per effort.
            let price = if rule.power == 1.0 { effort } else { effort.powf(rule.power) };
            let score = noise() * worth(instance, partial, place.candidate, rule) / price;
            if best.is_none_or(|(f, s, ..)| (first, score) > (f, s)) {
                best = Some((first, score, place.candidate, insertion));
            }
        }
        let Some((.., candidate, insertion)) = best else { return true };
        partial.insert(instance, insertion.position, candidate);
        fresh = Some(insertion.position);
        places.retain(|place| place.candidate != candidate);
        if let Some(budget) = budget.as_deref_mut()
            && !budget.spend()
        {
            return false;
        }
    }
}

fn worth(instance: &Instance<'_>, partial: &Partial, candidate: u32, rule: &Rule<'_>) -> f64 {
    rule.unit * gain(instance, candidate) + partial.relief(instance, candidate, rule.weight)
}

impl Place {
    /// After an insertion at `fresh`, the remembered place moves, is beaten by one of the two new
    /// places, or must be looked for again.
    #[inline]
    fn update(&mut self, instance: &Instance<'_>, partial: &Partial, fresh: Option<usize>) {
        let tour = &partial.tour;
        let Some(fresh) = fresh else {
            self.insertion = tour.cheapest(instance, self.candidate);
            return;
        };
        // Without a legal place before, there is none now unless a detour may be a short cut.
        let Some(old) = self.insertion else {
            if !instance.metric {
                self.insertion = tour.cheapest(instance, self.candidate);
            }
            return;
        };
        let kept = match old.position.cmp(&fresh) {
            std::cmp::Ordering::Less => tour.insertion(instance, old.position, self.candidate),
            std::cmp::Ordering::Equal => None,
            std::cmp::Ordering::Greater => {
                tour.insertion(instance, old.position + 1, self.candidate)
            }
        };
        let Some(kept) = kept else {
            self.insertion = tour.cheapest(instance, self.candidate);
            return;
        };
        let new = [fresh, fresh + 1].into_iter();
        let new = new.filter_map(|p| tour.insertion(instance, p, self.candidate));
        let best = new.fold(kept, |best, i| if i.effort < best.effort { i } else { best });
        self.insertion = Some(best);
    }
}

/// By candidate, whether an open demand has no more members with a legal place than it lacks.
fn must(instance: &Instance<'_>, partial: &Partial, places: &[Place]) -> Vec<bool> {
    let mut must = vec![false; instance.len()];
    let mut available = vec![0; instance.demands.demands.len()];
    let legal = || places.iter().filter(|place| place.insertion.is_some());
    for place in legal() {
        for &d in &instance.demands.of[place.candidate as usize] {
            available[d as usize] += 1;
        }
    }
    for place in legal() {
        let of = &instance.demands.of[place.candidate as usize];
        must[place.candidate as usize] = of.iter().any(|&d| {
            let lacks = partial.lacks(d as usize);
            lacks > 0 && available[d as usize] <= lacks
        });
    }
    must
}
