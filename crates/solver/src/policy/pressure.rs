//! What the demands ask of each candidate in a state.

use super::Feature;
use crate::framework::{Episode, State};

/// The demands of a state.
pub struct Pressure {
    /// By demand, what it lacks by its members that are actions, at most 1; 0 where it is met.
    of: Vec<f64>,
    /// By demand, whether it cannot do without any of these.
    tight: Vec<bool>,
    open: usize,
    /// Share of all covers still lacking.
    pub lacking_share: f64,
    /// The most that a demand lacks.
    pub most_lacking: f64,
    /// Actions that a demand cannot do without.
    pub musts: usize,
}

impl Pressure {
    pub fn new(episode: &Episode<'_>) -> Self {
        let state = episode.state();
        let demands = &state.instance().demands;
        let lacks: Vec<u32> = (0..demands.demands.len()).map(|d| state.lacks(d)).collect();
        let available = episode.available();
        let of = |d: usize| match lacks[d] {
            0 => 0.0,
            lacks => (f64::from(lacks) / f64::from(available[d].max(1))).min(1.0),
        };
        let needs: u32 = demands.demands.iter().map(|demand| demand.needs).sum();
        let tight: Vec<bool> =
            (0..lacks.len()).map(|d| lacks[d] > 0 && available[d] <= lacks[d]).collect();
        let is_must =
            |candidate: u32| demands.of[candidate as usize].iter().any(|&d| tight[d as usize]);
        Self {
            of: (0..lacks.len()).map(of).collect(),
            open: state.open_demands(),
            lacking_share: f64::from(lacks.iter().sum::<u32>()) / f64::from(needs.max(1)),
            most_lacking: f64::from(lacks.iter().copied().max().unwrap_or(0)),
            musts: episode.actions().iter().filter(|action| is_must(action.candidate)).count(),
            tight,
        }
    }

    /// What the demands that a candidate is in press for it together.
    pub fn on(&self, state: &State<'_>, candidate: u32) -> f64 {
        state.instance().demands.of[candidate as usize].iter().map(|&d| self.of[d as usize]).sum()
    }

    pub fn fill(&self, state: &State<'_>, candidate: u32, mut set: impl FnMut(Feature, f64)) {
        let demands = &state.instance().demands;
        let of = &demands.of[candidate as usize];
        if of.is_empty() {
            return;
        }
        let (mut open, mut sum, mut most, mut must) = (0, 0.0, 0.0_f64, false);
        for &d in of {
            let pressure = self.of[d as usize];
            open += usize::from(pressure > 0.0);
            sum += pressure;
            most = most.max(pressure);
            must |= self.tight[d as usize];
        }
        set(Feature::Helps, open as f64 / self.open.max(1) as f64);
        set(Feature::Pressure, sum / (1.0 + sum));
        set(Feature::MostPressure, most);
        set(Feature::Must, f64::from(u8::from(must)));
        set(Feature::Met, (of.len() - open) as f64 / of.len() as f64);
        set(Feature::Member, of.len() as f64 / demands.demands.len() as f64);
    }
}
