//! A key that the command line sets: `planning.budget=1s`.

use std::convert::Infallible;
use std::str::FromStr;

use figment::providers::Serialized;
use figment::value::{Dict, Map, Value};
use figment::{Error, Metadata, Profile, Provider};

/// A key, with its section, and its value as text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Setting {
    key: String,
    value: String,
}

impl FromStr for Setting {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let pair = text.split_once('=').filter(|(key, _)| {
            key.split('.').count() == 2 && key.split('.').all(|part| !part.is_empty())
        });
        let (key, value) = pair.ok_or_else(|| {
            format!("{text:?} must be SECTION.KEY=VALUE, such as planning.budget=1s")
        })?;
        Ok(Self { key: key.to_owned(), value: value.to_owned() })
    }
}

impl Provider for &Setting {
    fn metadata(&self) -> Metadata {
        Metadata::named(format!("--set {}", self.key))
    }

    /// The value is read as the environment's are: a number, a truth or a text.
    fn data(&self) -> Result<Map<Profile, Dict>, Error> {
        let value: Result<Value, Infallible> = self.value.parse();
        let Ok(value) = value;
        Serialized::default(&self.key, value).data()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setting_has_a_section_a_key_and_a_value() {
        for text in ["log.filter=a=b,c=d", "log.filter=", "planning.seed=7"] {
            assert!(text.parse::<Setting>().is_ok(), "{text}");
        }
        for text in ["", "planning.seed", "seed=7", ".seed=7", "planning.=7", "a.b.c=1"] {
            let error = text.parse::<Setting>().unwrap_err();
            assert!(error.contains("SECTION.KEY=VALUE"), "{error}");
        }
    }
}
