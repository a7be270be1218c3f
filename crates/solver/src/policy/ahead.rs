//! [`Ahead`]: what each action would leave of the others.

use super::Feature;
use super::encoder::sq;
use super::pressure::Pressure;
use crate::framework::{Action, Episode, Insert, Scales, State};
use crate::solvers::gain;
use crate::tour::{Insertion, Tour};

/// What the state after each action would look like, by action.
pub struct Ahead {
    after: Vec<After>,
}

/// The state after an action, beside the one before it.
#[derive(Clone, Copy, Default)]
struct After {
    /// Share of the weight of the other actions that have no legal place any more.
    lost: f64,
    /// Number of demands that these make impossible.
    broken: f64,
    /// Mean effort by which the others grow dearer, by weight.
    dearer: f64,
}

impl Ahead {
    /// Looks one step ahead of every action. Where demands are open, actions weigh what the demands press for
    /// them; elsewhere what they gain.
    pub fn new(episode: &Episode<'_>, pressure: &Pressure) -> Self {
        let (state, actions) = (episode.state(), episode.actions());
        let weight = |action: &Action| match state.open_demands() {
            0 => gain(state.instance(), action.candidate),
            _ => pressure.on(state, action.candidate),
        };
        let weights: Vec<f64> = actions.iter().map(weight).collect();
        let mut view = View { episode, weights, tour: state.tour().clone(), lost: Vec::new() };
        Self { after: (0..actions.len()).map(|index| view.after(index)).collect() }
    }

    pub fn fill(
        &self,
        index: usize,
        open: usize,
        scales: &Scales,
        mut set: impl FnMut(Feature, f64),
    ) {
        let after = self.after[index];
        set(Feature::Loses, after.lost);
        set(Feature::Breaks, after.broken / open.max(1) as f64);
        set(Feature::Dearer, sq(after.dearer / scales.effort));
    }
}

struct View<'a, 'b> {
    episode: &'a Episode<'b>,
    weights: Vec<f64>,
    /// Room for the tour after an action.
    tour: Tour,
    /// By demand, members that are lost.
    lost: Vec<u32>,
}

impl View<'_, '_> {
    fn after(&mut self, index: usize) -> After {
        let (state, actions) = (self.episode.state(), self.episode.actions());
        let (instance, action) = (state.instance(), &actions[index]);
        let available = self.episode.available();
        self.tour.clone_from(state.tour());
        self.tour.insert(instance, action.insertion.position, action.candidate);
        self.lost.clear();
        self.lost.resize(instance.demands.demands.len(), 0);
        let (mut after, mut all, mut kept) = (After::default(), 0.0, 0.0);
        for (other, weight) in actions.iter().zip(&self.weights) {
            if other.candidate == action.candidate {
                continue;
            }
            all += weight;
            if let Some(place) = self.place(state, other, action.insertion.position) {
                kept += weight;
                after.dearer += weight * (place.effort - other.insertion.effort);
                continue;
            }
            after.lost += weight;
            for &d in &instance.demands.of[other.candidate as usize] {
                self.lost[d as usize] += 1;
            }
        }
        // What a demand lacks and its members left shrink alike where the action is one of them.
        let broken = |d: usize| self.lost[d] > 0 && state.lacks(d) + self.lost[d] > available[d];
        after.broken = (0..self.lost.len()).filter(|&d| broken(d)).count() as f64;
        after.lost /= all.max(f64::MIN_POSITIVE);
        after.dearer /= kept.max(f64::MIN_POSITIVE);
        after
    }

    /// A place of another action after an insertion at `position`: the cheaper of its old place and the two new
    /// ones; only where none of them is legal, any.
    fn place(&self, state: &State<'_>, other: &Action, position: usize) -> Option<Insertion> {
        let insert = self.episode.definition().insertion();
        if insert == Insert::Append {
            return self.tour.insertion(state.instance(), self.tour.len(), other.candidate);
        }
        let old = other.insertion.position;
        let places = [old + usize::from(old > position), position, position + 1];
        let found = places
            .iter()
            .filter_map(|&p| self.tour.insertion(state.instance(), p, other.candidate));
        let cheapest = found.min_by(|a, b| a.effort.total_cmp(&b.effort));
        // Where totals decide and the way to its old place is as it was, no other is shorter.
        if state.instance().untimed && old != position {
            return cheapest;
        }
        cheapest.or_else(|| self.tour.cheapest(state.instance(), other.candidate))
    }
}
