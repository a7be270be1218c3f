//! Loading and checking.

use std::fmt::Display;
use std::path::Path;
use std::time::Duration;

use figment::Figment;
use figment::error::Kind;
use figment::providers::{Env, Format as _, Toml};
use voltour_solver::solvers::SolverName;

use super::print::is_secret;
use super::{Config, Setting, Span};
use crate::explainer;
use crate::grpc;
use crate::retention;
use crate::scheduler;

/// Every key that is wrong, each with its value and the rule.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", .0.join("; "))]
pub struct ConfigError(pub Vec<String>);

/// Loads the configuration: defaults, then the file, then the environment.
///
/// # Errors
/// The file cannot be read, a key is unknown, or a value breaks a rule.
pub fn load(file: Option<&Path>) -> Result<Config, ConfigError> {
    load_with(file, &[])
}

/// As [`load`], then the settings of the command line, the last of a key before the others.
///
/// # Errors
/// The file cannot be read, a key is unknown, or a value breaks a rule.
pub fn load_with(file: Option<&Path>, settings: &[Setting]) -> Result<Config, ConfigError> {
    let mut figment = Figment::new();
    if let Some(file) = file {
        figment = figment.merge(Toml::file_exact(file));
    }
    // Only keys of sections: VOLTOUR_SERVER, without a section, is the operator's commands'.
    let environment =
        Env::prefixed("VOLTOUR_").filter(|key| key.as_str().contains("__")).split("__");
    figment = figment.merge(environment);
    for setting in settings {
        figment = figment.merge(setting);
    }
    let config: Config = figment
        .extract()
        .map_err(|errors| ConfigError(errors.into_iter().map(|error| line(&error)).collect()))?;
    config.check()?;
    Ok(config)
}

fn line(error: &figment::Error) -> String {
    let key = error.path.join(".");
    let kind = match &error.kind {
        // Without the line of the file that a parser shows: a token may stand there.
        Kind::Message(text) => {
            text.lines().filter(|line| !is_quoted(line)).collect::<Vec<_>>().join(" ")
        }
        // The others say what they have found.
        _ if error.path.iter().any(|part| is_secret(part)) => "must be a text".to_owned(),
        kind => kind.to_string(),
    };
    let source = error.metadata.as_ref().map(|metadata| match &metadata.source {
        Some(source) => format!(" (in {source})"),
        None => format!(" (in {})", metadata.name),
    });
    let separator = if key.is_empty() { "" } else { ": " };
    let text = format!("{key}{separator}{kind}{}", source.unwrap_or_default());
    // One line, whatever a parser put into its message.
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Whether a parser quotes a file with this line: ` 2 | seed = "7"`.
fn is_quoted(line: &str) -> bool {
    line.trim_start()
        .trim_start_matches(|digit: char| digit.is_ascii_digit())
        .trim_start()
        .starts_with('|')
}

impl Config {
    /// The scheduler's settings.
    pub fn settings(&self) -> scheduler::Settings {
        let planning = &self.planning;
        scheduler::Settings {
            lead: self.lead(),
            budget: planning.budget.0,
            max_late: planning.max_late.0,
            overdue_after: planning.overdue_after.0,
            // Checked when it was loaded.
            solver: planning.solver.parse().unwrap_or(SolverName::Auto),
            seed: planning.seed,
            planner_threads: planning.threads,
            limits: scheduler::Limits {
                networks: self.limits.networks,
                departures: self.limits.departures,
            },
        }
    }

    /// The explainer's settings.
    pub fn explainer(&self) -> explainer::Settings {
        let planning = &self.planning;
        explainer::Settings { budget: planning.explanation_budget.0, seed: planning.seed }
    }

    /// The gRPC edge's limits.
    pub fn grpc_limits(&self) -> grpc::Limits {
        let limits = &self.limits;
        grpc::Limits {
            message_bytes: limits.message_bytes,
            connections: limits.connections,
            calls: limits.calls,
            streams: limits.streams,
            all_calls: limits.all_calls,
            waits: limits.waits,
            unacknowledged: limits.unacknowledged,
            longest_wait: limits.longest_wait.0,
        }
    }

    fn lead(&self) -> Duration {
        let budget = self.planning.budget.0;
        self.planning.lead.map_or(budget.saturating_add(Duration::from_secs(1)), |lead| lead.0)
    }

    /// Every rule that the types do not keep.
    fn check(&self) -> Result<(), ConfigError> {
        let mut errors = Errors::default();
        self.check_access(&mut errors.0);
        let same = self.grpc.listen == self.rest.listen && self.grpc.listen.port() != 0;
        errors.check(!same, "rest.listen", self.rest.listen, "must not be that of grpc.listen");
        let path = self.store.path.display();
        errors.check(!path.to_string().is_empty(), "store.path", "\"\"", "must name a file");
        let folder = self.policy.folder.as_deref();
        let is_named = folder.is_none_or(|folder| !folder.as_os_str().is_empty());
        errors.check(is_named, "policy.folder", "\"\"", "must name a folder");
        if let Some(history) = self.retention.history {
            let (least, most) = (Span(retention::SHORTEST), Span::seconds(36_500 * 86_400));
            errors.within("retention.history", history, least, most);
        }
        self.check_planning(&mut errors);
        self.check_limits(&mut errors);
        self.check_telemetry(&mut errors);
        if errors.0.is_empty() { Ok(()) } else { Err(ConfigError(errors.0)) }
    }

    fn check_planning(&self, errors: &mut Errors) {
        let planning = &self.planning;
        if let Err(error) = planning.solver.parse::<SolverName>() {
            errors.0.push(format!("planning.solver: {error}"));
        }
        let budget = planning.budget;
        let (least, most) = (Span(Duration::from_millis(10)), Span::seconds(600));
        errors.within("planning.budget", budget, least, most);
        let (none, explained) = (Span(Duration::ZERO), planning.explanation_budget);
        errors.within("planning.explanation_budget", explained, none, most);
        if let Some(lead) = planning.lead {
            let rule = format!("must be longer than planning.budget, {budget}");
            errors.check(lead > budget, "planning.lead", lead, &rule);
            errors.within("planning.lead", lead, least, Span::seconds(3_600));
        }
        let day = Span::seconds(86_400);
        errors.within("planning.max_late", planning.max_late, Span::seconds(1), day);
        errors.within("planning.overdue_after", planning.overdue_after, Span::seconds(1), day);
        errors.within("planning.threads", planning.threads, 1, 64);
    }

    fn check_telemetry(&self, errors: &mut Errors) {
        let telemetry = &self.telemetry;
        errors.within("telemetry.sample_ratio", telemetry.sample_ratio, 0.0, 1.0);
        let Some(endpoint) = &telemetry.otlp_endpoint else { return };
        let parsed = endpoint.parse::<axum::http::Uri>();
        let good = parsed.is_ok_and(|uri| {
            uri.scheme_str() == Some("http") && uri.port().is_some() && uri.path() == "/"
        });
        let shown = format!("{:?}", endpoint.chars().take(80).collect::<String>());
        let rule = "must be http://HOST:PORT of a collector that takes OTLP over gRPC";
        errors.check(good, "telemetry.otlp_endpoint", shown, rule);
    }

    fn check_limits(&self, errors: &mut Errors) {
        let limits = &self.limits;
        errors.within("limits.message_bytes", limits.message_bytes, 1_024, 64 * 1024 * 1024);
        errors.within("limits.connections", limits.connections, 1, 100_000);
        errors.within("limits.calls", limits.calls, 1, 100_000);
        errors.within("limits.streams", limits.streams, 1, 100_000);
        errors.within("limits.unacknowledged", limits.unacknowledged, 1, 100_000);
        errors.within("limits.all_calls", limits.all_calls, 1, 1_000_000);
        errors.within("limits.waits", limits.waits, 1, 1_000_000);
        errors.within("limits.rest_calls", limits.rest_calls, 1, 10_000);
        errors.within("limits.networks", limits.networks, 1, 1_000_000);
        errors.within("limits.departures", limits.departures, 1, 100_000);
        let (least, most) = (Span::seconds(1), Span::seconds(3_600));
        errors.within("limits.slow_client", limits.slow_client, least, most);
        errors.within("limits.longest_wait", limits.longest_wait, least, most);
        let within = self.lifecycle.stop_within;
        errors.within("lifecycle.stop_within", within, Span(Duration::ZERO), Span::seconds(600));
    }
}

#[derive(Default)]
struct Errors(Vec<String>);

impl Errors {
    fn check(&mut self, holds: bool, key: &str, value: impl Display, rule: &str) {
        if !holds {
            self.0.push(format!("{key}: {value} {rule}"));
        }
    }

    fn within<T: PartialOrd + Display>(&mut self, key: &str, value: T, least: T, most: T) {
        let rule = format!("must be from {least} to {most}");
        self.check(value >= least && value <= most, key, value, &rule);
    }
}

#[cfg(test)]
#[expect(clippy::result_large_err, reason = "the closures' error is figment's")]
mod tests {
    use figment::Jail;

    use super::*;

    fn errors(toml: &str) -> Vec<String> {
        let mut errors = Vec::new();
        Jail::expect_with(|jail| {
            jail.create_file("voltour.toml", toml)?;
            errors = load(Some(Path::new("voltour.toml"))).unwrap_err().0;
            Ok(())
        });
        errors
    }

    #[test]
    fn the_environment_wins_over_the_file_over_the_defaults() {
        Jail::expect_with(|jail| {
            let toml = "[planning]\nbudget = \"1s\"\nseed = 7\n[log]\nformat = \"json\"";
            jail.create_file("voltour.toml", toml)?;
            jail.set_env("VOLTOUR_PLANNING__SEED", "9");
            jail.set_env("VOLTOUR_GRPC__LISTEN", "[::1]:0");
            jail.set_env("VOLTOUR_SERVER", "http://127.0.0.1:7440");
            let config = load(Some(Path::new("voltour.toml"))).unwrap();
            assert_eq!(config.planning.seed, 9);
            assert_eq!(config.settings().lead, Duration::from_secs(2));
            assert_eq!(config.grpc.listen.to_string(), "[::1]:0");
            assert_eq!(config.rest, super::super::Rest::default());
            Ok(())
        });
    }

    #[test]
    fn the_defaults_keep_every_rule() {
        Config::default().check().unwrap();
    }

    #[test]
    fn every_error_names_key_value_and_rule() {
        let cases = [
            ("[planning]\nbugdet = \"2s\"", "planning", "bugdet"),
            ("[plannning]\n", "", "plannning"),
            ("[planning]\nbudget = \"soon\"", "planning.budget", "\"soon\" must be a length"),
            ("[planning]\nbudget = \"3s\"\nlead = \"3s\"", "planning.lead: 3s", "longer than"),
            ("[planning]\nsolver = \"magic\"", "planning.solver", "magic"),
            ("[planning]\nexplanation_budget = \"1h\"", "explanation_budget: 1h", "from 0s to 10m"),
            ("[planning]\nthreads = 0", "planning.threads: 0", "from 1 to 64"),
            ("[retention]\nhistory = \"1d\"", "retention.history: 24h", "from 168h to"),
            ("[policy]\nfolder = \"\"", "policy.folder", "must name a folder"),
            ("[tls]\nkey_file = \"k.pem\"", "tls.certificate_file", "tls.key_file"),
            ("[tls]\nclient_ca_file = \"c.pem\"", "tls.client_ca_file", "tls.certificate_file"),
            ("[access]\nbootstrap_token = \"short\"", "access.bootstrap_token", "32 to 256"),
            ("[rest]\nhosts = [\"a/b\"]", "rest.hosts", "\"a/b\" must be the name of a host"),
            ("[limits]\nstreams = -1", "limits.streams", "-1"),
            ("[log]\nformat = \"xml\"", "log.format", "xml"),
            (
                "[telemetry]\notlp_endpoint = \"here\"",
                "telemetry.otlp_endpoint: \"here\"",
                "http://",
            ),
            ("[telemetry]\nsample_ratio = 2.0", "telemetry.sample_ratio: 2", "from 0 to 1"),
            ("[grpc]\nlisten = \"here\"", "grpc.listen", "socket address"),
            ("[grpc", "", "voltour.toml"),
        ];
        for (toml, key, says) in cases {
            let errors = errors(toml);
            assert!(
                errors.iter().any(|e| e.contains(key) && e.contains(says)),
                "{toml}: {errors:?}"
            );
            assert!(errors.iter().all(|e| !e.contains('\n')), "{errors:?}");
        }
    }

    #[test]
    fn a_file_that_is_not_there_is_an_error() {
        assert!(load(Some(Path::new("no/such/file.toml"))).is_err());
    }
}
