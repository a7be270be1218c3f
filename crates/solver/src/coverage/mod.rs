//! From sensing disks to demands: "serve at least so many of these requesters".
//!
//! The faces of the arrangement of all disks and the field's border are found exactly, from the
//! vertices of the arrangement; each distinct set of covering sensors is a [`Region`] with a witness
//! point. From those come the [`Demand`]s of a scenario (`formats.md`, constraint 5), of which only the
//! ones that no other implies remain. [`shortfalls`] says which regions a choice of served requests
//! leaves short, [`below_k`] which the deployment itself leaves short.

mod arrangement;
mod border;
mod crossings;
mod demands;
mod disks;
mod faces;
mod frame;
mod sectors;
mod sets;
mod shortfall;
mod surroundings;

use crate::scenario::Point;

pub use arrangement::regions;
pub use demands::demands;
pub use shortfall::{Shortfall, below_k, shortfalls};

/// A distinct set of sensors that covers some sub-region of positive area inside the field.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// The covering sensors, as rising indices into the scenario's sensors; may be empty.
    pub covering: Vec<u32>,
    /// A point well inside one of the sub-regions.
    pub witness: Point,
}

/// At least `needs` of `members` must be served.
#[derive(Clone, Debug, PartialEq)]
pub struct Demand {
    /// Rising indices into the scenario's requests; none of them is already charged.
    pub members: Vec<u32>,
    /// From 1 to the number of members.
    pub needs: u32,
    /// A point inside the sub-region that asks for it.
    pub witness: Point,
}
