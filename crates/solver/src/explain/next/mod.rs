//! What the next change would buy: one number of the scenario raised, as little as is known to do.

mod feasible;
mod lever;
mod shorter;
mod stop;

pub(super) use feasible::feasible;
pub(super) use lever::Lever;
pub(super) use shorter::shorter;
pub(super) use stop::{notable, one_more};
