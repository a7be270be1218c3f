//! The progress bar of a bench.

use indicatif::{ProgressBar, ProgressStyle};

use crate::bench::Run;

const TEMPLATE: &str = "{bar:24} {human_pos}/{human_len} {elapsed}<{eta}  {msg}";

/// Runs done, and how long the rest will take.
pub(super) struct Bar(ProgressBar);

impl Bar {
    /// A bar of so many runs.
    pub fn new(runs: u64) -> Self {
        let bar = ProgressBar::new(runs);
        if let Ok(style) = ProgressStyle::with_template(TEMPLATE) {
            bar.set_style(style);
        }
        Self(bar)
    }

    /// One more.
    pub fn step(&self, run: &Run) {
        self.0.inc(1);
        self.0.set_message(format!("{} {}", run.group, run.algorithm));
    }

    /// Leaves the terminal to what is printed then.
    pub fn end(&self) {
        self.0.finish_and_clear();
    }
}
