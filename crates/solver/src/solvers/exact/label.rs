//! Partial tours, which of them comes first, and which of them make others needless.

use std::cmp::Ordering;
use std::hash::BuildHasher;

use super::Model;
use super::bits::Bits;
use crate::tour::Run;

/// No label.
pub const NONE: u32 = u32::MAX;

/// A partial tour.
#[derive(Clone, Debug)]
pub struct Label<const W: usize> {
    pub run: Run,
    pub served: Bits<W>,
    /// Demands not yet met.
    pub open: Bits<W>,
    pub gain: f64,
    /// Multipliers' constant less the prizes collected.
    pub reduced: f64,
    pub parent: u32,
    /// The label before it under the same key.
    pub next: u32,
    pub stops: u32,
    /// State of the paths' tally.
    pub tally: u16,
    pub dominated: bool,
}

/// A label that waits, and the bound under which it does.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    pub bound: f64,
    pub stops: u32,
    pub label: u32,
}

impl Entry {
    /// Puts the least bound first, the longest among equals.
    pub fn compare(&self, other: &Self) -> Ordering {
        let bound = self.bound.total_cmp(&other.bound);
        bound.then(other.stops.cmp(&self.stops)).then(self.label.cmp(&other.label))
    }
}

/// A number that is the same for labels that are interchangeable, and mostly another for others.
pub fn key<const W: usize>(label: &Label<W>, useful: &Bits<W>) -> u64 {
    rustc_hash::FxBuildHasher.hash_one((label.served.both(useful), label.open, label.run.node))
}

/// Whether what follows one label can follow another: they stand at the same place, the same demands are open, and
/// of those whose visits matter, the `useful` ones, they served the same.
pub fn is_interchangeable<const W: usize>(a: &Label<W>, b: &Label<W>, useful: &Bits<W>) -> bool {
    a.run.node == b.run.node && a.open == b.open && a.served.both(useful) == b.served.both(useful)
}

/// Whether whatever follows the second of two labels under one key can follow the first no worse.
pub fn dominates<const W: usize>(model: &Model<'_>, a: &Label<W>, b: &Label<W>) -> bool {
    let distance = !model.length_counts || a.run.distance_m <= b.run.distance_m;
    let energy = !model.energy_counts || model.wide.energy_j(&a.run) <= model.wide.energy_j(&b.run);
    let time = if model.wide.moving && (model.length_counts || model.energy_counts) {
        // Two labels at one moving sensor stand in different places unless they are there at once.
        a.run.arrive_s == b.run.arrive_s
    } else {
        !model.time_counts || a.run.depart_s <= b.run.depart_s
    };
    distance && energy && time
}
