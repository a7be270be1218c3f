//! Coverage, recomputed: which sets of sensors cover the sub-regions of the field, found by walking
//! along every circle and every edge of the border and noting who covers the ground on either side.
//! Every sub-region has such a piece of border, so every set is met.

mod border;
mod circle;
mod disks;
mod faces;
mod field;
mod shortfalls;
mod sweep;
#[cfg(test)]
mod tests;

pub(super) use shortfalls::{Count, List, Mismatch, Shortfalls};
