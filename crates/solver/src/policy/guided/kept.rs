//! [`Kept`]: the best tour seen.

use crate::framework::Episode;
use crate::instance::Instance;
use crate::tour::{Tour, Value};

/// The best tour seen, with how many were complete.
#[derive(Clone, Debug)]
pub struct Kept {
    /// Its stops in order.
    pub order: Vec<u32>,
    /// Its value.
    pub value: Value,
    /// Complete roll-outs seen.
    pub roll_outs: u64,
}

impl Kept {
    /// Nothing but the empty tour.
    pub fn nothing(instance: &Instance<'_>) -> Self {
        let value = Value::of(instance, &Tour::new(instance, &[]));
        Self { order: Vec::new(), value, roll_outs: 0 }
    }

    /// Counts an episode that is over and keeps its tour if it is better.
    pub fn finished(&mut self, episode: &Episode<'_>) {
        self.roll_outs += 1;
        self.offer(episode.state().instance(), episode.state().tour());
    }

    /// Keeps a tour if it is better.
    pub fn offer(&mut self, instance: &Instance<'_>, tour: &Tour) {
        let value = Value::of(instance, tour);
        if tour.is_legal() && value.beats(&self.value) {
            self.order = tour.order().to_vec();
            self.value = value;
        }
    }
}
