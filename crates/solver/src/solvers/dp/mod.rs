//! The paper's dynamic programme (section "Dynamic Programming Based Algorithm"): colourful paths in the
//! time-discretised graph.
//!
//! A vertex is a sensor at a step of time, an edge leads to the first step at which the charger can be there.
//! Each sensor is a colour of its own, and each vertex keeps the colour sets of the paths to it: no path
//! comes to a sensor twice (N. Alon, R. Yuster, U. Zwick, "Color-coding", 1995).

mod programme;
mod table;

pub(super) use programme::dp;
