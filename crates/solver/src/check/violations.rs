//! The lists of what a tour breaks and of what the deployment cannot give.

use std::collections::BTreeSet;

use crate::plan::{Plan, Violation, Warning};
use crate::scenario::{Point, Scenario};

use super::broken::Findings;
use super::close::Verdict;
use super::cover::{Count, List, Mismatch, Shortfalls};
use super::limits::{Budget, Limits};
use super::order::{already_charged, quoted_id};

/// Reports entries of `violations` that are not true and true ones that are not listed. Returns
/// whether the tour breaks any of these constraints.
pub(super) fn compare(
    scenario: &Scenario,
    plan: &Plan,
    order: &[usize],
    limits: &Limits,
    shortfalls: &mut Shortfalls<'_>,
    findings: &mut Findings,
) -> Verdict {
    let mut unmet = required(scenario, order);
    let mut truth = shortfalls.verdict();
    if !unmet.is_empty() {
        truth = Verdict::Broken;
    }
    let mut budgets = Budgets::of(limits);
    truth = truth.max(budgets.verdict());
    let mut sets = BTreeSet::new();
    for (i, violation) in plan.violations.iter().enumerate() {
        let path = format!("violations[{i}]");
        match violation {
            Violation::Required { sensor } => {
                let known = |request: &usize| id(scenario, *request) == sensor;
                match unmet.iter().position(known) {
                    Some(place) => drop(unmet.remove(place)),
                    None => findings.add(
                        format!("{path}.sensor"),
                        sensor,
                        "not a required request that the tour leaves out, or listed before",
                    ),
                }
            }
            Violation::Coverage { at_m, needs, has } => {
                let count = Count { needs: *needs, has: *has };
                let known =
                    place(List::Violations, &path, *at_m, count, &sets, shortfalls, findings);
                if let Some(set) = known {
                    truth = truth.max(Verdict::Either);
                    sets.insert(set);
                }
            }
            Violation::Timespan { limit, needs } => {
                budgets.timespan.claim(&path, "timespan", *limit, *needs, findings);
            }
            Violation::Capacity { limit, needs } => {
                budgets.capacity.claim(&path, "capacity", *limit, *needs, findings);
            }
        }
    }
    for request in unmet {
        let id = quoted_id(scenario, request);
        findings.missing("violations", format!("required {id} is not served and not listed"));
    }
    unlisted(List::Violations, &sets, shortfalls, findings);
    budgets.timespan.missing("timespan", findings);
    budgets.capacity.missing("capacity", findings);
    truth
}

/// Reports entries of `warnings` that are not true and true ones that are not listed.
pub(super) fn compare_warnings(
    plan: &Plan,
    shortfalls: &mut Shortfalls<'_>,
    findings: &mut Findings,
) {
    let mut sets = BTreeSet::new();
    for (i, Warning::BelowK { at_m, needs, has }) in plan.warnings.iter().enumerate() {
        let path = format!("warnings[{i}]");
        let count = Count { needs: *needs, has: *has };
        sets.extend(place(List::Warnings, &path, *at_m, count, &sets, shortfalls, findings));
    }
    unlisted(List::Warnings, &sets, shortfalls, findings);
}

/// The required requests that a tour leaves out. One that is already charged is kept.
fn required(scenario: &Scenario, order: &[usize]) -> Vec<usize> {
    let mut open: Vec<bool> = (scenario.requests.iter())
        .map(|request| request.required && !already_charged(scenario, request))
        .collect();
    order.iter().for_each(|&request| open[request] = false);
    (0..open.len()).filter(|&request| open[request]).collect()
}

fn id(scenario: &Scenario, request: usize) -> &String {
    &scenario.sensors[scenario.requests[request].sensor].id
}

/// The covering set that an entry names; reports an entry that names none.
fn place(
    list: List,
    path: &str,
    at_m: [f64; 2],
    count: Count,
    taken: &BTreeSet<Vec<u32>>,
    shortfalls: &mut Shortfalls<'_>,
    findings: &mut Findings,
) -> Option<Vec<u32>> {
    let mismatch = match shortfalls.identify(list, Point::from(at_m), count, taken) {
        Ok(set) => return Some(set),
        Err(mismatch) => mismatch,
    };
    let at = format!("{path}.at_m");
    match mismatch {
        Mismatch::NotInField => findings.add(at, &at_m, "must lie inside coverage.field_m"),
        Mismatch::NotShort(Count { needs, has }) => {
            let rule = format!("covers there are not short: {has}, needed {needs}");
            findings.add(at, &at_m, rule);
        }
        Mismatch::Repeated => {
            findings.add(at, &at_m, "an earlier entry names the same covering sensors");
        }
        Mismatch::Differs(right) => {
            if count.needs != right.needs {
                let rule = format!("recomputed as {}", right.needs);
                findings.add(format!("{path}.needs"), &count.needs, rule);
            }
            if count.has != right.has {
                let rule = format!("recomputed as {}", right.has);
                findings.add(format!("{path}.has"), &count.has, rule);
            }
        }
    }
    None
}

fn unlisted(
    list: List,
    listed: &BTreeSet<Vec<u32>>,
    shortfalls: &Shortfalls<'_>,
    findings: &mut Findings,
) {
    let name = match list {
        List::Violations => "violations",
        List::Warnings => "warnings",
    };
    for (_, at, Count { needs, has }) in
        shortfalls.surely(list).filter(|(set, ..)| !listed.contains(*set))
    {
        let rule = format!("at [{}, {}] {needs} covers are needed, {has} there", at.x, at.y);
        findings.missing(name, rule);
    }
}

/// The two budgets of an empty trip, as far as it breaks them.
struct Budgets {
    timespan: Exceeded,
    capacity: Exceeded,
}

struct Exceeded {
    budget: Option<Budget>,
    listed: bool,
}

impl Budgets {
    fn of(limits: &Limits) -> Self {
        let exceeded = |budget: Option<Budget>| Exceeded {
            budget: budget.filter(|b| limits.empty_trip && b.verdict() != Verdict::Kept),
            listed: false,
        };
        Self { timespan: exceeded(limits.timespan), capacity: exceeded(limits.capacity) }
    }

    fn verdict(&self) -> Verdict {
        let worst = self.timespan.budget.iter().chain(&self.capacity.budget);
        worst.map(|budget| budget.verdict()).max().unwrap_or(Verdict::Kept)
    }
}

impl Exceeded {
    fn claim(&mut self, path: &str, kind: &str, limit: f64, needs: f64, findings: &mut Findings) {
        match self.budget {
            Some(budget) if !self.listed => {
                findings.number(format!("{path}.limit"), limit, budget.limit);
                findings.number(format!("{path}.needs"), needs, budget.needs);
            }
            Some(_) => findings.add(path, &kind, "must be listed once"),
            None => findings.add(path, &kind, "only for an empty trip that breaks the limit"),
        }
        self.listed = true;
    }

    fn missing(&self, kind: &str, findings: &mut Findings) {
        let surely = self.budget.filter(|budget| budget.verdict() == Verdict::Broken);
        if let Some(Budget { limit, needs }) = surely.filter(|_| !self.listed) {
            let rule = format!("the empty trip breaks the {kind}: limit {limit}, needs {needs}");
            findings.missing("violations", rule);
        }
    }
}
