//! The check itself: one rule after the other, each in a file of its own.

use crate::plan::{FORMAT, Plan};
use crate::scenario::Scenario;

use super::broken::{Broken, Findings};
use super::cover::Shortfalls;
use super::limits::Limits;
use super::order::Names;
use super::replay::Replay;
use super::{numbers, status, unserved, violations};

/// Every rule of the format that `plan` breaks as an answer to `scenario`; empty if it holds.
///
/// Only the order of the stops is believed. Where the stops are no tour at all (unknown, repeated
/// or already charged sensors), what depends on the tour is not judged any further.
pub fn check(scenario: &Scenario, plan: &Plan) -> Vec<Broken> {
    let mut findings = Findings::default();
    header(scenario, plan, &mut findings);
    let names = Names::of(scenario);
    let Some(order) = names.order(scenario, plan, &mut findings) else {
        return findings.into_vec();
    };
    let replay = Replay::of(scenario, &order);
    numbers::compare(scenario, plan, &replay, &mut findings);
    let limits = Limits::of(scenario, &replay);
    let mut shortfalls = Shortfalls::of(scenario, &order);
    let broken =
        violations::compare(scenario, plan, &order, &limits, &mut shortfalls, &mut findings);
    violations::compare_warnings(plan, &mut shortfalls, &mut findings);
    unserved::compare(scenario, plan, &names, &order, &shortfalls, &mut findings);
    status::compare(plan, &limits, broken, &mut findings);
    status::compare_bound(scenario, plan, &mut findings);
    findings.into_vec()
}

fn header(scenario: &Scenario, plan: &Plan, findings: &mut Findings) {
    if plan.format != FORMAT {
        findings.add("format", &plan.format, format!("must be \"{FORMAT}\""));
    }
    if plan.scenario != scenario.name {
        let name = serde_json::json!(scenario.name);
        findings.add("scenario", &plan.scenario, format!("must be the scenario's name, {name}"));
    }
    if !(plan.elapsed_s >= 0.0 && plan.elapsed_s.is_finite()) {
        findings.add("elapsed_s", &plan.elapsed_s, "must be >= 0");
    }
}
