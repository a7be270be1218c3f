//! The framework of the paper (section 5): one episode, and problems that differ in a few lines.
//!
//! An episode begins with the empty tour. Its [`State`] is the ordered list of stops so far; an [`Action`] is a
//! candidate with the place that the insertion function gives it; [`Episode::act`] is the transition; the
//! reward of an action is the change of the objective function; the stop function ends the episode. A problem
//! is a [`Definition`]: what it does not say, all problems share. The policy that chooses among the actions
//! lives in [`crate::policy`], for whoever trains it as for whoever uses it.
//!
//! # A problem of one's own
//! K-coverage for a charger that wants to be back soon rather than to drive little: the objective function
//! is the time at which it is back, with its sign turned, and nothing else is new.
//!
//! ```
//! use voltour_solver::framework::{Action, Definition, Episode, Insert, State};
//! use voltour_solver::generate::{KCoverage, k_coverage};
//! use voltour_solver::instance::Instance;
//! use voltour_solver::scenario::Scenario;
//!
//! struct BackSoon;
//!
//! impl Definition for BackSoon {
//!     fn name(&self) -> &'static str {
//!         "back-soon"
//!     }
//!     fn insertion(&self) -> Insert {
//!         Insert::Cheapest
//!     }
//!     fn objective(&self, state: &State<'_>) -> f64 {
//!         -state.tour().finished().arrive_s / state.scales().time_s
//!     }
//!     fn reward(&self, state: &State<'_>, candidate: u32, place: &Action) -> f64 {
//!         self.objective(&state.after(candidate, place.insertion.position)) - self.objective(state)
//!     }
//!     fn stops(&self, state: &State<'_>) -> bool {
//!         state.open_demands() == 0
//!     }
//! }
//!
//! // A charger capacity, as any other limit of the scenario, is heeded by every problem.
//! let options = KCoverage { sensors: 48, k: 2, ..KCoverage::default() };
//! let mut document = k_coverage(&options, 1)?;
//! document.charger.capacity_j = Some(1e9);
//! let scenario = Scenario::from_document(&document)?;
//! let instance = Instance::new(&scenario);
//! let mut episode = Episode::new(&instance, &BackSoon);
//! while let Some(best) = (0..episode.actions().len())
//!     .max_by(|&a, &b| episode.actions()[a].reward.total_cmp(&episode.actions()[b].reward))
//! {
//!     episode.act(best);
//! }
//! assert!(episode.succeeded());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod action;
mod definition;
mod episode;
mod problems;
mod scales;
mod state;

pub use action::Action;
pub use definition::{Definition, Insert};
pub use episode::Episode;
pub use problems::{KCoverage, Mobile, Reward, definition};
pub use scales::Scales;
pub use state::State;

#[cfg(test)]
pub(crate) mod tests;
