//! The algorithms side by side: the paper's tables drawn anew, and public instances. Knows the solvers and the
//! policies, and nothing of the service.
//!
//! Work is a list of [`Job`]s, each a scenario with the [`Entrant`]s that solve it. [`work`] runs them on
//! several threads; every [`Run`] goes to the [`Log`] at once, so that an interrupted bench goes on where it
//! was. Tables, plots and text are made from the log alone.

mod document;
mod entrant;
mod error;
mod job;
mod log;
mod measure;
mod paper;
mod plot;
mod public;
mod published;
mod run;
mod settings;
mod sheet;
mod summary;
mod table;
mod work;

pub use document::replaced;
pub use entrant::Entrant;
pub use error::BenchError;
pub use job::{Job, Source};
pub use log::Log;
pub use paper::{paper_jobs, tables};
pub use plot::plot;
pub use public::Public;
pub use published::{Figures, Published, published};
pub use run::{Ended, Run};
pub use settings::Settings;
pub use sheet::{Row, Sheet};
pub use summary::{Reference, Summary, references, summaries};
pub use table::{Measure, Setting, Table};
pub use work::{Trained, work};

#[cfg(test)]
mod tests;
