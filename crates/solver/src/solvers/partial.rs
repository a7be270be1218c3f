//! A tour under construction: with every stop, what the demands still lack.

use crate::instance::Instance;
use crate::scenario::Objective;
use crate::tour::Tour;

/// A tour and how far each demand is met.
#[derive(Debug)]
pub struct Partial {
    /// The tour.
    pub tour: Tour,
    /// By demand, its members that are served.
    has: Vec<u32>,
}

impl Clone for Partial {
    fn clone(&self) -> Self {
        Self { tour: self.tour.clone(), has: self.has.clone() }
    }

    fn clone_from(&mut self, source: &Self) {
        self.tour.clone_from(&source.tour);
        self.has.clone_from(&source.has);
    }
}

impl Partial {
    /// The tour with these stops.
    pub fn new(instance: &Instance<'_>, order: &[u32]) -> Self {
        let tour = Tour::new(instance, order);
        let mut partial = Self { tour, has: vec![0; instance.demands.demands.len()] };
        for &candidate in order {
            partial.count(instance, candidate, true);
        }
        partial
    }

    fn count(&mut self, instance: &Instance<'_>, candidate: u32, served: bool) {
        for &d in &instance.demands.of[candidate as usize] {
            let has = &mut self.has[d as usize];
            *has = if served { *has + 1 } else { *has - 1 };
        }
    }

    /// Puts a candidate before the stop at `position`.
    pub fn insert(&mut self, instance: &Instance<'_>, position: usize, candidate: u32) {
        self.tour.insert(instance, position, candidate);
        self.count(instance, candidate, true);
    }

    /// Takes out the stops for which `leaves` holds.
    pub fn remove(&mut self, instance: &Instance<'_>, leaves: impl Fn(u32) -> bool) {
        for p in 0..self.tour.len() {
            let candidate = self.tour.order()[p];
            if leaves(candidate) {
                self.count(instance, candidate, false);
            }
        }
        self.tour.remove(instance, leaves);
    }

    /// What demand `d` lacks.
    pub fn lacks(&self, instance: &Instance<'_>, d: usize) -> u32 {
        instance.demands.demands[d].needs.saturating_sub(self.has[d])
    }

    /// What all demands lack together.
    pub fn missing(&self, instance: &Instance<'_>) -> u32 {
        (0..self.has.len()).map(|d| self.lacks(instance, d)).sum()
    }

    /// Sum of `weight` over what the demands lack.
    pub fn penalty(&self, instance: &Instance<'_>, weight: &[f64]) -> f64 {
        weight.iter().enumerate().map(|(d, w)| w * f64::from(self.lacks(instance, d))).sum()
    }

    /// Sum of `weight` over the open demands that a candidate helps to meet.
    pub fn relief(&self, instance: &Instance<'_>, candidate: u32, weight: &[f64]) -> f64 {
        let demands = &instance.demands.demands;
        let of = instance.demands.of[candidate as usize].iter().map(|&d| d as usize);
        of.filter(|&d| self.has[d] < demands[d].needs).map(|d| weight[d]).sum()
    }

    /// Whether some demand would lack more without this stop.
    pub fn is_needed(&self, instance: &Instance<'_>, candidate: u32) -> bool {
        let demands = &instance.demands.demands;
        let of = &instance.demands.of[candidate as usize];
        of.iter().any(|&d| self.has[d as usize] <= demands[d as usize].needs)
    }
}

/// What serving a candidate adds to the objective: its reward, one, or nothing.
pub fn gain(instance: &Instance<'_>, candidate: u32) -> f64 {
    match instance.scenario.objective {
        Objective::MinDistance => 0.0,
        Objective::MaxReward => instance.candidates[candidate as usize].reward,
        Objective::MaxCount => 1.0,
    }
}
