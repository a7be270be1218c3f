//! A tour under construction: with every stop, what the demands still lack.

use crate::instance::Instance;
use crate::scenario::Objective;
use crate::tour::Tour;

/// A tour and how far each demand is met.
#[derive(Debug)]
pub struct Partial {
    /// The tour.
    pub tour: Tour,
    /// By demand, what it lacks; below zero, what it could do without.
    open: Vec<i32>,
}

impl Clone for Partial {
    fn clone(&self) -> Self {
        Self { tour: self.tour.clone(), open: self.open.clone() }
    }

    fn clone_from(&mut self, source: &Self) {
        self.tour.clone_from(&source.tour);
        self.open.clone_from(&source.open);
    }
}

impl Partial {
    /// The tour with these stops.
    pub fn new(instance: &Instance<'_>, order: &[u32]) -> Self {
        let tour = Tour::new(instance, order);
        let open = instance.demands.demands.iter().map(|d| d.needs as i32).collect();
        let mut partial = Self { tour, open };
        for &candidate in order {
            partial.count(instance, candidate, true);
        }
        partial
    }

    fn count(&mut self, instance: &Instance<'_>, candidate: u32, served: bool) {
        for &d in &instance.demands.of[candidate as usize] {
            self.open[d as usize] += if served { -1 } else { 1 };
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

    /// Takes out every stop that no demand needs, one after another from `offset` on, round the end; the
    /// schedule is made anew once. For distances that obey the triangle inequality, where none of them can
    /// be a short cut.
    pub fn remove_spare(&mut self, instance: &Instance<'_>, offset: usize) {
        let stops = self.tour.len();
        let mut spare = Vec::new();
        for i in 0..stops {
            let candidate = self.tour.order()[(i + offset) % stops];
            if !self.is_needed(instance, candidate) {
                self.count(instance, candidate, false);
                spare.push(candidate);
            }
        }
        self.tour.remove(instance, |c| spare.contains(&c));
    }

    /// What demand `d` lacks.
    pub fn lacks(&self, d: usize) -> u32 {
        self.open[d].max(0) as u32
    }

    /// What all demands lack together.
    pub fn missing(&self) -> u32 {
        self.open.iter().map(|&open| open.max(0) as u32).sum()
    }

    /// Sum of `weight` over what the demands lack.
    pub fn penalty(&self, weight: &[f64]) -> f64 {
        // Counts add up faster than weights.
        if self.missing() == 0 {
            return 0.0;
        }
        self.open.iter().zip(weight).map(|(&open, weight)| weight * f64::from(open.max(0))).sum()
    }

    /// Sum of `weight` over the open demands that a candidate helps to meet.
    #[inline]
    pub fn relief(&self, instance: &Instance<'_>, candidate: u32, weight: &[f64]) -> f64 {
        let of = instance.demands.of[candidate as usize].iter().map(|&d| d as usize);
        of.filter(|&d| self.open[d] > 0).map(|d| weight[d]).sum()
    }

    /// Whether a candidate helps to meet an open demand.
    #[inline]
    pub fn helps(&self, instance: &Instance<'_>, candidate: u32) -> bool {
        instance.demands.of[candidate as usize].iter().any(|&d| self.open[d as usize] > 0)
    }

    /// Whether some demand would lack more without this stop.
    pub fn is_needed(&self, instance: &Instance<'_>, candidate: u32) -> bool {
        instance.demands.of[candidate as usize].iter().any(|&d| self.open[d as usize] >= 0)
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
