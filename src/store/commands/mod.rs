//! The commands: one file each, each one step in the life of something. Every step from one state to
//! another is an update on the condition of the former, so that none is taken twice.

mod announce;
mod cancel;
mod close;
mod complete;
mod ending;
mod explain;
mod forget;
mod overdue;
mod paths;
mod plan;
mod put;
mod remembered;
mod reopen;
mod step;
mod submit;
mod take_back;
#[cfg(test)]
mod tests;
mod visit;

pub use announce::Announce;
pub use cancel::Cancel;
pub use close::{Batch, CloseBatch, Closing};
pub use complete::Complete;
pub use explain::{Attempt, BeginExplanation, EndExplanation};
pub use forget::{Forget, Forgotten};
pub use overdue::Overdue;
pub use paths::UpdatePaths;
pub use plan::{NewPlan, NewStop, StorePlan, Storing};
pub use put::Put;
pub use submit::Submit;
pub use take_back::TakeBack;
pub use visit::ReportVisit;
