//! The configuration as text, for those who want to see what is in force. What is secret is not shown.

use toml::{Table, Value};

use super::{Config, Span};

/// What stands for a secret.
const MASK: &str = "***";

/// The whole configuration as TOML, sections and keys in the order of the alphabet: what is in force, with values that
/// follow from others filled in, and secrets masked.
///
/// # Errors
/// A value is not one of TOML: a seed above 2^63 - 1.
pub fn print(config: &Config) -> Result<String, toml::ser::Error> {
    let mut config = config.clone();
    config.planning.lead = Some(Span(config.settings().lead));
    let mut table = Table::try_from(&config)?;
    table.iter_mut().for_each(|(key, value)| mask(key, value));
    toml::to_string(&table)
}

/// By name, so that a key that is added later is masked before anybody thinks of it.
fn mask(key: &str, value: &mut Value) {
    match value {
        Value::Table(table) => table.iter_mut().for_each(|(key, value)| mask(key, value)),
        _ if is_secret(key) => *value = Value::String(MASK.to_owned()),
        Value::Array(values) => values.iter_mut().for_each(|value| mask(key, value)),
        _ => {}
    }
}

/// A file that holds a secret is named `_file` and is shown.
pub(super) fn is_secret(key: &str) -> bool {
    ["token", "tokens", "secret", "password"].iter().any(|end| key.ends_with(end))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Access, Policy, Telemetry, Tls};

    /// The sample that is installed: every key, with its default.
    const SAMPLE: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/deploy/voltour.toml"));

    fn read(text: &str) -> Config {
        toml::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
    }

    #[test]
    fn what_is_printed_is_read_as_the_same() {
        let config = Config::default();
        let text = print(&config).unwrap();
        let mut again = read(&text);
        assert_eq!(again.planning.lead, Some(Span::seconds(3)), "in force: budget and a second");
        again.planning.lead = None;
        assert_eq!(again, config);
    }

    #[test]
    fn secrets_are_masked_wherever_they_are() {
        let text = "[access]\nbootstrap_token = \"t0p\"\ntoken_file = \"shown\"\n\
                    [[access.users]]\npassword = \"t0p\"\n[proxy]\nsecret = [\"t0p\"]";
        let mut table: Table = text.parse().unwrap();
        table.iter_mut().for_each(|(key, value)| mask(key, value));
        let text = toml::to_string(&table).unwrap();
        assert!(!text.contains("t0p") && text.contains("shown"), "{text}");
        assert_eq!(text.matches("***").count(), 3, "{text}");
    }

    #[test]
    fn the_sample_is_the_defaults() {
        assert_eq!(read(SAMPLE), Config::default());
    }

    #[test]
    fn a_token_is_masked_in_what_is_printed() {
        let token = "t0p-t0p-t0p-t0p-t0p-t0p-t0p-t0p-t0p";
        let config = read(&format!("[access]\nbootstrap_token = \"{token}\""));
        let text = print(&config).unwrap();
        assert!(text.contains("bootstrap_token = \"***\"") && !text.contains("t0p"), "{text}");
    }

    /// Every key: also those without a default have a value, and a new one of their sections must get one here.
    fn full() -> Config {
        let path = || Some("a-path".into());
        let token = Some("x".repeat(40).parse().unwrap());
        let mut config = Config {
            tls: Tls { certificate_file: path(), key_file: path(), client_ca_file: path() },
            access: Access { bootstrap_token: token, bootstrap_token_file: path() },
            policy: Policy { folder: path() },
            telemetry: Telemetry {
                otlp_endpoint: Some("http://localhost:4317".into()),
                ..Telemetry::default()
            },
            ..Config::default()
        };
        config.planning.lead = Some(Span::seconds(3));
        config
    }

    #[test]
    fn the_sample_shows_every_key_and_no_other() {
        // What is commented out for want of a default, too; but a secret has no sample.
        let is_key = |line: &str| {
            let key = line.split_once(" = ").map(|(key, _)| key);
            key.is_some_and(|key| !key.contains(' ') && !is_secret(key))
        };
        let line = |line: &str| {
            let bare = line.strip_prefix("# ").filter(|bare| is_key(bare)).unwrap_or(line);
            format!("{bare}\n")
        };
        let shown: String = SAMPLE.lines().map(line).collect();
        read(&shown);
        let keys = Table::try_from(full()).unwrap();
        let sections = |table: &Table| table.keys().cloned().collect::<Vec<_>>();
        let sample: Table = SAMPLE.parse().unwrap();
        assert_eq!(sections(&sample), sections(&keys));
        for (section, keys) in &keys {
            for key in keys.as_table().unwrap().keys() {
                let here = SAMPLE.split_once(&format!("[{section}]\n")).unwrap().1;
                let here = here.split("\n[").next().unwrap();
                let is_shown = here
                    .lines()
                    .any(|line| line.trim_start_matches("# ").starts_with(&format!("{key} = ")));
                assert!(is_shown, "{section}.{key} is not in deploy/voltour.toml");
            }
        }
    }
}
