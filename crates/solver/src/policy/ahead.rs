//! [`Ahead`]: what each action would leave of the others.

use super::Feature;
use super::encoder::sq;
use super::pressure::Pressure;
use crate::framework::{Action, Episode, Insert, Scales};
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
        let detour_m = |action: &Action| {
            let (tour, place) = (state.tour(), action.insertion.position);
            tour.detour_m(state.instance(), place, action.candidate)
        };
        let untimed = state.instance().untimed;
        let detours_m = if untimed { actions.iter().map(detour_m).collect() } else { Vec::new() };
        let tour = state.tour().clone();
        let mut view = View { episode, weights, detours_m, tour, lost: Vec::new() };
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
    /// By action, metres by which it lengthens the way now; where totals decide.
    detours_m: Vec<f64>,
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
        for (k, (other, &weight)) in actions.iter().zip(&self.weights).enumerate() {
            if other.candidate == action.candidate {
                continue;
            }
            all += weight;
            if let Some(effort) = self.effort(k, action.insertion.position) {
                kept += weight;
                after.dearer += weight * (effort - other.insertion.effort);
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

    /// The effort of another action after an insertion at `position`: at the cheaper of its old place and the two new
    /// ones; only where none of them is legal, at any.
    fn effort(&self, index: usize, position: usize) -> Option<f64> {
        let (instance, other) = (self.episode.state().instance(), &self.episode.actions()[index]);
        let (tour, candidate) = (&self.tour, other.candidate);
        if self.episode.definition().insertion() == Insert::Append {
            return tour.insertion(instance, tour.len(), candidate).map(|place| place.effort);
        }
        if !tour.has_room(instance, candidate) {
            return None;
        }
        let (old, new) = (other.insertion.position, [position, position + 1]);
        let anywhere = || tour.cheapest(instance, candidate).map(|place| place.effort);
        if instance.untimed {
            let detours_m = new.map(|p| tour.detour_m(instance, p, candidate));
            let metres = detours_m.into_iter().fold(f64::INFINITY, f64::min);
            if old == position {
                return tour.effort_of_detour(instance, candidate, metres).or_else(anywhere);
            }
            // The way to its old place is as it was, and no other but the new ones is shorter.
            let metres = metres.min(self.detours_m[index]);
            return tour.effort_of_detour(instance, candidate, metres);
        }
        let mut cheapest: Option<Insertion> = None;
        for place in [old + usize::from(old > position)].into_iter().chain(new) {
            let most = cheapest.map_or(f64::INFINITY, |cheapest| cheapest.effort);
            cheapest = tour.insertion_below(instance, place, candidate, most).or(cheapest);
        }
        cheapest.map(|place| place.effort).or_else(anywhere)
    }
}
