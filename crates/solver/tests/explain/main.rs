//! Explanations against an exhaustive oracle, hand-made texts, and the documents' own promises.
#![allow(clippy::unwrap_used, clippy::panic)]

mod conflicts;
mod documents;
#[path = "../mixed/mod.rs"]
mod mixed;
mod next;
mod oracle;
mod sensible;
mod texts;
