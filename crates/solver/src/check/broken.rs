//! What the checker reports, one broken rule at a time.

use std::fmt;

use serde::Serialize;

use super::close;

/// A rule that a plan breaks; prints as one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// JSON path in the plan, such as `stops[3].arrive_s`.
    pub path: String,
    /// What the plan says there, as JSON; `missing` where it says nothing.
    pub value: String,
    /// The rule, with the value that the checker found.
    pub rule: String,
}

impl fmt::Display for Broken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: {}", self.path, self.value, self.rule)
    }
}

/// The broken rules found so far.
#[derive(Default)]
pub(super) struct Findings(Vec<Broken>);

impl Findings {
    pub(super) fn add(
        &mut self,
        path: impl fmt::Display,
        value: &impl Serialize,
        rule: impl fmt::Display,
    ) {
        self.push(path, quote(value), rule);
    }

    pub(super) fn missing(&mut self, path: impl fmt::Display, rule: impl fmt::Display) {
        self.push(path, "missing".to_owned(), rule);
    }

    /// A number in the plan against the one recomputed.
    pub(super) fn number(&mut self, path: impl fmt::Display, claimed: f64, expected: f64) {
        if !close::equal(claimed, expected) {
            self.add(path, &claimed, format!("recomputed as {expected}"));
        }
    }

    pub(super) fn into_vec(self) -> Vec<Broken> {
        self.0
    }

    fn push(&mut self, path: impl fmt::Display, value: String, rule: impl fmt::Display) {
        self.0.push(Broken { path: path.to_string(), value, rule: rule.to_string() });
    }
}

/// A value as JSON on one line, cut at 80 characters.
pub(super) fn quote(value: &impl Serialize) -> String {
    const LONGEST: usize = 80;
    let text = serde_json::to_string(value).unwrap_or_else(|error| error.to_string());
    match text.char_indices().nth(LONGEST) {
        Some((cut, _)) => format!("{}...", &text[..cut]),
        None => text,
    }
}
