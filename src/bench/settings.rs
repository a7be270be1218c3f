//! [`Settings`]: what every run of a bench has in common.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// What the numbers of a bench depend on. Two benches with the same settings may share a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// Version of the binary.
    pub version: String,
    /// Seed of the scenarios and of every random choice.
    pub seed: u64,
    /// Processor time of each solver on each scenario at most, in seconds.
    pub time_limit_s: f64,
    /// Iterations of `baseline`.
    pub iterations: u64,
    /// Memory that `acs`, `dp` and `app` may use, in MiB.
    pub memory_mib: u32,
    /// SHA-256 of the policies, by problem.
    pub policies: BTreeMap<String, String>,
}

impl Settings {
    /// The first setting in which two differ: its name, here and there.
    pub fn difference(&self, other: &Self) -> Option<(String, String, String)> {
        let fields = |settings: &Self| match serde_json::to_value(settings) {
            Ok(serde_json::Value::Object(fields)) => fields,
            _ => serde_json::Map::new(),
        };
        let (here, there) = (fields(self), fields(other));
        let differs = here.iter().find(|(name, value)| there.get(*name) != Some(value));
        differs.map(|(name, value)| {
            let other = there.get(name).map_or_else(String::new, ToString::to_string);
            (name.clone(), value.to_string(), other)
        })
    }
}
