//! Why a document was refused: one broken rule, named so that its author can mend it.

use std::fmt;

/// The first broken rule of a document.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ScenarioError {
    /// The text is not JSON.
    #[error("not JSON: line {line}, column {column}: {reason}")]
    Syntax {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What the parser says.
        reason: String,
    },
    /// A field breaks a rule.
    #[error("{path}: {value}: {rule}")]
    Rule {
        /// JSON path of the field, such as `requests[3].deadline_s`.
        path: String,
        /// The value as JSON, shortened to one line; `missing` where there is none.
        value: String,
        /// The rule that it breaks.
        rule: String,
    },
}

impl ScenarioError {
    pub(crate) fn missing(path: impl fmt::Display, rule: impl fmt::Display) -> Self {
        Self::Rule { path: path.to_string(), value: "missing".into(), rule: rule.to_string() }
    }

    pub(crate) fn rule(
        path: impl fmt::Display,
        value: &impl serde::Serialize,
        rule: impl fmt::Display,
    ) -> Self {
        Self::Rule { path: path.to_string(), value: shorten(value), rule: rule.to_string() }
    }

    /// The JSON path of the field at fault; none where the text is not JSON.
    pub fn path(&self) -> Option<&str> {
        match self {
            Self::Syntax { .. } => None,
            Self::Rule { path, .. } => Some(path),
        }
    }
}

/// A value as JSON, cut at 80 characters: whole matrices do not belong in a log line.
fn shorten(value: &impl serde::Serialize) -> String {
    const LONGEST: usize = 80;
    let text = serde_json::to_string(value).unwrap_or_else(|error| error.to_string());
    match text.char_indices().nth(LONGEST) {
        Some((cut, _)) => format!("{}...", &text[..cut]),
        None => text,
    }
}
