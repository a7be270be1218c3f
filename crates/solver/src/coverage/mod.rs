//! From sensing disks to demands: "serve at least so many of these requesters".
//!
//! The faces of the arrangement of all disks and the field's border are found exactly, from the
//! vertices of the arrangement; each distinct set of covering sensors is a [`Region`] with a witness
//! point. From those come the [`Demand`]s of a scenario (`formats.md`, constraint 5), of which only the
//! ones that no other implies remain.

use crate::scenario::{Point, Scenario};

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

/// Every distinct region of the scenario's coverage constraint, in a fixed order; empty without one.
pub fn regions(_scenario: &Scenario) -> Vec<Region> {
    Vec::new()
}

/// The demands of the scenario that no other demand implies, in a fixed order.
pub fn demands(_scenario: &Scenario, _regions: &[Region]) -> Vec<Demand> {
    Vec::new()
}
