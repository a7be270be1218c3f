//! The document: it survives JSON, and the same question has the same answer.

use voltour_solver::explain::{Explanation, FORMAT, explain};
use voltour_solver::scenario::Scenario;
use voltour_solver::stop::MaxIterations;

use crate::conflicts::plan;
use crate::mixed;

fn draws(most: u64) -> impl Iterator<Item = Scenario> {
    (0..most)
        .filter_map(|seed| Scenario::from_document(&mixed::draw(1 + seed as usize % 9, seed)).ok())
}

#[test]
fn an_explanation_survives_json() {
    for scenario in draws(200) {
        let explanation = explain(&scenario, &plan(&scenario, 100), 0, &MaxIterations(2_000));
        assert_eq!(explanation.format, FORMAT);
        let text = serde_json::to_string(&explanation).unwrap();
        assert_eq!(serde_json::from_str::<Explanation>(&text).unwrap(), explanation);
    }
}

#[test]
fn the_same_iterations_give_the_same_explanation() {
    for scenario in draws(120) {
        let plan = plan(&scenario, 100);
        for iterations in [0, 17, 700, 20_000] {
            let one = explain(&scenario, &plan, 3, &MaxIterations(iterations));
            // A host's clock, as far as the search can tell.
            let two = explain(&scenario, &plan, 3, &|done: u64| done >= iterations);
            assert_eq!(one, two);
        }
    }
}

#[test]
fn no_line_breaks_and_no_control_characters_come_from_names() {
    let text = r#"{
      "format": "voltour/scenario/1", "objective": "min_distance",
      "charger": {"start_m": [0, 0], "speed_mps": 5, "travel_jpm": 1, "transfer_w": 10},
      "sensors": [{"id": "a\n\u001b[2J", "position_m": [100, 0], "battery_j": 100}],
      "requests": [{"sensor": "a\n\u001b[2J", "deadline_s": 10, "required": true}]
    }"#;
    let scenario = Scenario::from_json(text.as_bytes()).unwrap();
    let told = explain(&scenario, &plan(&scenario, 10), 0, &MaxIterations(1_000)).to_string();
    assert!(!told.contains('\u{1b}') && told.contains(r#""a\n\u{1b}[2J" is required"#), "{told}");
}
