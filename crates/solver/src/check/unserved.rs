//! The reasons why requests are not stops.

use crate::plan::{Plan, Reason};
use crate::scenario::{Objective, Scenario};

use super::broken::Findings;
use super::close::Verdict;
use super::cover::Shortfalls;
use super::limits::Limits;
use super::order::{Names, already_charged, quoted_id};
use super::replay::Replay;

/// Reports requests that are listed wrongly, twice or not at all, and wrong reasons.
pub(super) fn compare(
    scenario: &Scenario,
    plan: &Plan,
    names: &Names<'_>,
    order: &[usize],
    shortfalls: &Shortfalls<'_>,
    findings: &mut Findings,
) {
    let mut served = vec![false; scenario.requests.len()];
    order.iter().for_each(|&request| served[request] = true);
    let mut listed_at = vec![None; scenario.requests.len()];
    for (i, unserved) in plan.unserved.iter().enumerate() {
        let path = format!("unserved[{i}].sensor");
        let Some(request) = names.request(&path, &unserved.sensor, findings) else { continue };
        if served[request] {
            findings.add(path, &unserved.sensor, "is a stop of the tour");
            continue;
        }
        if let Some(first) = listed_at[request].replace(i) {
            let rule = format!("must be listed once; unserved[{first}] is it too");
            findings.add(path, &unserved.sensor, rule);
            continue;
        }
        let right = reasons(scenario, request, shortfalls);
        if !right.contains(&unserved.reason) {
            let names: Vec<_> = right.iter().map(|reason| reason.name()).collect();
            let id = quoted_id(scenario, request);
            let rule = format!("the first reason that holds of {id} is {}", names.join(" or "));
            findings.add(format!("unserved[{i}].reason"), &unserved.reason, rule);
        }
    }
    for request in (0..served.len()).filter(|&i| !served[i] && listed_at[i].is_none()) {
        let id = quoted_id(scenario, request);
        findings.missing("unserved", format!("{id} is no stop and must be listed"));
    }
}

/// The reasons that may be given for a request: one, or more where rounding decides.
fn reasons(scenario: &Scenario, request: usize, shortfalls: &Shortfalls<'_>) -> Vec<Reason> {
    let asked = &scenario.requests[request];
    if already_charged(scenario, asked) {
        return vec![Reason::AlreadyCharged];
    }
    let alone = Limits::of(scenario, &Replay::of(scenario, &[request]));
    let not_needed = match scenario.objective {
        Objective::MinDistance if asked.required => Verdict::Kept,
        Objective::MinDistance => shortfalls.does_without(asked.sensor),
        Objective::MaxReward | Objective::MaxCount => Verdict::Kept,
    };
    // A reason holds where its condition is broken; the first that surely holds ends the list.
    let tests = [
        (Reason::Unreachable, alone.in_time()),
        (Reason::NoCapacity, alone.paid()),
        (Reason::NotNeeded, not_needed),
        (Reason::NotChosen, Verdict::Broken),
    ];
    let surely = tests.iter().position(|(_, verdict)| *verdict == Verdict::Broken);
    tests[..=surely.unwrap_or(tests.len() - 1)]
        .iter()
        .filter(|(_, verdict)| *verdict != Verdict::Kept)
        .map(|(reason, _)| *reason)
        .collect()
}
