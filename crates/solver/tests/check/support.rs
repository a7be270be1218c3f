//! Documents as JSON trees, so that a test can change one field.

use serde_json::Value;
use voltour_solver::check::{Broken, check};
use voltour_solver::plan::Plan;
use voltour_solver::scenario::Scenario;

/// The broken rules of a plan, as a user would get them.
pub fn judge(scenario: &Value, plan: &Value) -> Vec<Broken> {
    let scenario = Scenario::from_json(scenario.to_string().as_bytes()).expect("a scenario");
    let plan = Plan::from_json(plan.to_string().as_bytes()).expect("a plan");
    check(&scenario, &plan)
}

#[track_caller]
pub fn holds(scenario: &Value, plan: &Value) {
    let broken = judge(scenario, plan);
    assert!(broken.is_empty(), "{}", lines(&broken));
}

/// The plan is refused, with a finding at that path that uses these words.
#[track_caller]
pub fn breaks(scenario: &Value, plan: &Value, path: &str, words: &str) {
    let broken = judge(scenario, plan);
    let found = broken.iter().any(|b| b.path == path && b.rule.contains(words));
    assert!(found, "no finding at {path} with {words:?} in:\n{}", lines(&broken));
    assert!(broken.iter().all(|b| !b.to_string().contains('\n')), "one line each");
}

/// A copy of a document with the value at a JSON pointer replaced.
#[track_caller]
pub fn with(document: &Value, pointer: &str, value: Value) -> Value {
    let mut changed = document.clone();
    *changed.pointer_mut(pointer).expect("the pointer leads somewhere") = value;
    changed
}

/// A copy of a document with several values replaced.
#[track_caller]
pub fn with_all(document: &Value, changes: &[(&str, Value)]) -> Value {
    changes.iter().fold(document.clone(), |doc, (at, value)| with(&doc, at, value.clone()))
}

/// A copy of a document without the item of a list.
#[track_caller]
pub fn without(document: &Value, list: &str, item: usize) -> Value {
    let mut changed = document.clone();
    changed.pointer_mut(list).and_then(Value::as_array_mut).expect("a list").remove(item);
    changed
}

/// A copy of a document with an item added at the end of a list.
#[track_caller]
pub fn pushed(document: &Value, list: &str, item: Value) -> Value {
    let mut changed = document.clone();
    changed.pointer_mut(list).and_then(Value::as_array_mut).expect("a list").push(item);
    changed
}

fn lines(broken: &[Broken]) -> String {
    broken.iter().map(|b| format!("  {b}\n")).collect()
}
