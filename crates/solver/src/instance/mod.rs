//! The compiled scenario: what a search asks of it, by candidate index, in constant time.
//!
//! It is the paper's graph: the candidates are the nodes, [`Instance::step`] is the edge (when one
//! arrives, and what it costs), the [`DemandSet`] is the table T of constraint 5. Candidates are the
//! requests that are not already charged; nothing here prunes any further.

mod candidate;
mod compile;
mod demands;
mod interception;
mod travel;

pub use candidate::Candidate;
pub use compile::{Effort, Instance};
pub use demands::{Demand, DemandSet};
pub use interception::earliest;
pub use travel::Travel;
