//! Why no scenario was drawn.

use crate::scenario::ScenarioError;

/// Why no scenario was drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GenerateError {
    /// An option is out of its range.
    #[error("{name}: {value}: {rule}")]
    Option {
        /// The option.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The range.
        rule: String,
    },
    /// No deployment drawn was covered as asked.
    #[error(
        "attempts: {attempts}: none of that many deployments of {sensors} sensors covers the \
         whole field {k} times; more sensors, a longer range or more attempts may help"
    )]
    NotCovered {
        /// Deployments drawn.
        attempts: u32,
        /// Sensors in each.
        sensors: u32,
        /// Covers asked for.
        k: u32,
    },
    /// The options are each in range, but what they make together is no scenario.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
}
