//! Why a command ended without its result.

/// Lines for standard error, and the exit code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// 2 for bad input, 1 for everything else.
    pub code: u8,
    /// At least one, each whole.
    pub lines: Vec<String>,
}

impl Failure {
    /// The input is bad: exit code 2.
    pub fn input(line: impl Into<String>) -> Self {
        Self { code: 2, lines: vec![line.into()] }
    }

    /// The input is good, and yet it did not work: exit code 1.
    pub fn other(line: impl Into<String>) -> Self {
        Self { code: 1, lines: vec![line.into()] }
    }
}
