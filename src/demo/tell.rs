//! What the audience reads: one line an event, with the time on stage.

use jiff::Timestamp;

use crate::cli::say;
use crate::clock::seconds;

/// Tells what happens; knows when the play began.
#[derive(Clone, Copy, Debug)]
pub(super) struct Teller {
    began: Timestamp,
}

impl Teller {
    /// The play begins.
    pub(super) fn new(began: Timestamp) -> Self {
        Self { began }
    }

    /// Something happens at `at`.
    pub(super) fn tell(&self, at: Timestamp, who: &str, what: &str) {
        say(format!("{:>6}  {who:<12}  {what}", self.time(at)));
    }

    /// A time on stage, in hours and minutes since the play began.
    pub(super) fn time(&self, at: Timestamp) -> String {
        let minutes = (seconds(self.began, at).max(0.0) / 60.0) as u64;
        format!("{}:{:02}", minutes / 60, minutes % 60)
    }
}
