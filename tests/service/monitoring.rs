//! The dashboard and the alert rules in `deploy/`: they ask for what the running binary exports, and every alert has
//! its part in the operator's manual.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use serde_json::Value;

use crate::app::TestApp;
use crate::explanations::explanation;
use crate::field::line;
use crate::metrics::metrics;
use crate::time::until;

/// Words of PromQL that are no metrics.
const WORDS: [&str; 19] = [
    "and",
    "by",
    "changes",
    "histogram_quantile",
    "increase",
    "label_values",
    "max",
    "min",
    "min_over_time",
    "on",
    "or",
    "rate",
    "sum",
    "time",
    "unless",
    "without",
    "avg",
    "count",
    "le",
];
/// What the monitor itself makes, and labels that it adds.
const MONITORS: [&str; 1] = ["up"];
const ADDED: [&str; 3] = ["instance", "job", "le"];

fn deployed(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("deploy").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// What there is: each sample's name, and the labels that it has.
type Exported = BTreeMap<String, BTreeSet<String>>;

fn exported(text: &str) -> Exported {
    let mut all = Exported::new();
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let (name, rest) = line.split_once(['{', ' ']).expect("a sample");
        let labels = all.entry(name.to_owned()).or_default();
        if line[name.len()..].starts_with('{') {
            let inside = rest.rsplit_once('}').expect("the end of labels").0;
            labels.extend(names(inside).into_iter().map(|(name, _)| name));
        }
    }
    all
}

/// The identifiers of an expression outside its strings, each with whether it stands within braces.
fn names(expression: &str) -> Vec<(String, bool)> {
    let (mut found, mut word, mut quoted, mut braced) = (Vec::new(), String::new(), false, false);
    for c in expression.chars().chain([' ']) {
        if c == '"' {
            quoted = !quoted;
        }
        if !quoted && (c.is_ascii_alphanumeric() || "_$:".contains(c)) {
            word.push(c);
            continue;
        }
        let is_name = word.starts_with(|c: char| c.is_ascii_alphabetic());
        // A length of time such as 5m, or a variable of the dashboard, is none.
        if is_name {
            found.push((word.clone(), braced));
        }
        word.clear();
        match c {
            '{' if !quoted => braced = true,
            '}' if !quoted => braced = false,
            _ => {}
        }
    }
    found
}

/// What an expression asks for and is not there.
fn unknown(expression: &str, exported: &Exported) -> Vec<String> {
    let labels: BTreeSet<&str> =
        exported.values().flatten().map(String::as_str).chain(ADDED).collect();
    let words: BTreeSet<&str> = WORDS.into_iter().chain(MONITORS).collect();
    let mut metric: Option<&BTreeSet<String>> = None;
    let mut wrong = Vec::new();
    for (name, braced) in names(expression) {
        let known = if braced {
            ADDED.contains(&name.as_str()) || metric.is_none_or(|labels| labels.contains(&name))
        } else if let Some(labels) = exported.get(&name) {
            metric = Some(labels);
            true
        } else {
            if MONITORS.contains(&name.as_str()) {
                metric = None;
            }
            // A label outside of braces stands after `by`.
            words.contains(name.as_str()) || labels.contains(name.as_str())
        };
        if !known {
            wrong.push(name);
        }
    }
    wrong
}

/// Everything under this key, wherever it is.
fn under<'a>(document: &'a Value, key: &str, found: &mut Vec<&'a str>) {
    match document {
        Value::Object(members) => members.iter().for_each(|(name, value)| match value {
            Value::String(text) if name == key => found.push(text),
            value => under(value, key, found),
        }),
        Value::Array(items) => items.iter().for_each(|item| under(item, key, found)),
        _ => {}
    }
}

/// The alerts with their expressions; the file keeps each in a line, and the order of the keys.
fn alerts() -> Vec<(String, String)> {
    let text = deployed("prometheus/alerts.yml");
    let after = |key: &str| {
        let lines = text.lines().filter_map(|line| line.trim().strip_prefix(key));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    let (alerts, expressions) = (after("- alert: "), after("expr: "));
    for key in ["summary: ", "description: ", "runbook: ", "severity: "] {
        assert_eq!(after(key).len(), alerts.len(), "{key}");
    }
    for (alert, runbook) in alerts.iter().zip(after("runbook: ")) {
        assert_eq!(runbook, format!("docs/operations.md#{}", alert.to_lowercase()));
    }
    assert_eq!(alerts.len(), expressions.len());
    alerts.into_iter().zip(expressions).collect()
}

/// What the binary exports once everything has happened.
async fn lived() -> Exported {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    app.ask("s1").await;
    let tour = app.drive("A").await;
    explanation(&app, &tour).await;
    app.get("/v1/plans").await;
    // Counted after the commit, a moment after it can be read.
    let text = until("the plan is counted", || async {
        let text = metrics(&app).await;
        text.contains("voltour_plans_total{").then_some(text)
    });
    exported(&text.await)
}

#[tokio::test]
async fn the_dashboard_and_the_alerts_ask_for_what_there_is() {
    let exported = lived().await;
    let dashboard: Value = serde_json::from_str(&deployed("grafana/voltour.json")).expect("JSON");
    let mut asked = Vec::new();
    under(&dashboard, "expr", &mut asked);
    assert!(asked.len() > 25, "{asked:?}");
    under(&dashboard, "definition", &mut asked);
    let alerts = alerts();
    let rules = alerts.iter().map(|(_, expression)| expression.as_str());
    for expression in asked.into_iter().chain(rules) {
        assert_eq!(unknown(expression, &exported), [""; 0], "{expression}");
    }
    // The check would find what is wrong.
    for (wrong, found) in [
        ("rate(voltour_plan_total[5m])", "voltour_plan_total"),
        ("sum by (colour) (voltour_streams)", "colour"),
        ("voltour_departures{phase=\"planned\"} > 0", "phase"),
        ("voltour_database_size_bytes{state=\"log\"}", "state"),
        ("sums(voltour_streams)", "sums"),
    ] {
        assert_eq!(unknown(wrong, &exported), [found], "{wrong}");
    }
}

#[test]
fn every_alert_has_its_part_in_the_manual() {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/operations.md");
    let alerts = alerts();
    assert!(alerts.len() > 10);
    let manual = std::fs::read_to_string(path).expect("the manual");
    for (alert, _) in alerts {
        let heading = format!("### {alert}");
        assert!(
            manual.lines().any(|line| line == heading),
            "{heading} is not in docs/operations.md"
        );
    }
}

#[test]
fn the_dashboard_is_one_that_grafana_takes() {
    let dashboard: Value = serde_json::from_str(&deployed("grafana/voltour.json")).expect("JSON");
    assert_eq!((&dashboard["uid"], &dashboard["title"]), (&"voltour".into(), &"voltour".into()));
    assert!(dashboard["schemaVersion"].as_u64() >= Some(36));
    let panels = dashboard["panels"].as_array().expect("panels");
    let ids: BTreeSet<u64> = panels.iter().map(|panel| panel["id"].as_u64().unwrap()).collect();
    assert_eq!(ids.len(), panels.len(), "an id of its own");
    for panel in panels {
        let place = &panel["gridPos"];
        assert!(place["x"].as_u64().unwrap() + place["w"].as_u64().unwrap() <= 24, "{panel}");
        if panel["type"] != "row" {
            assert!(!panel["targets"].as_array().unwrap().is_empty(), "{panel}");
        }
    }
}
