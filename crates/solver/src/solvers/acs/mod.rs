//! Ant Colony System (paper, section "Comparison Algorithms" of the optimal k-coverage charging problem; M.
//! Dorigo, L. Gambardella, "Ant colony system", 1997; C.-B. Cheng, C.-P. Mao, "A modified ant colony system
//! for solving the travelling salesman problem with time windows", 2007).
//!
//! Deviations, where the paper is silent or leaves a choice:
//! 1. An ant goes only to sensors that lower an entry of the table T, as the paper's dynamic programme does.
//! 2. The pheromone of all edges decays by equation (tau_ij) only in an iteration that has a feasible tour.
//! 3. The slack and the wait of the two deadline heuristics are measured in their means over the open
//!    sensors, so that their steepness has no unit.
//! 4. The nearness of a sensor counts beside the two, as in the colony system that they were added to.
//! 5. A tour that is not feasible is kept where there is no better one: the plan says what it breaks.

mod ant;
mod colony;
mod options;
mod trail;

pub(super) use colony::acs;
pub use options::AcsOptions;
