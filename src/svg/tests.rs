//! Pictures of all kinds of plans: well-formed, escaped, bounded, and saying what the plan says.

use roxmltree::Document;
use serde_json::{Value, json};
use voltour_solver::generate::{self, KCoverage, Mobile, Reward};
use voltour_solver::plan::{Plan, Reason, Status, Stop, Unserved, Violation, Warning};
use voltour_solver::scenario::Scenario;
use voltour_solver::solvers::plan_from_order;

use super::picture;

fn scenario(document: &Value) -> Scenario {
    Scenario::from_json(document.to_string().as_bytes()).unwrap()
}

fn generated(document: &impl serde::Serialize) -> Scenario {
    scenario(&serde_json::to_value(document).unwrap())
}

/// A plan that serves every other request.
fn some_plan(scenario: &Scenario) -> Plan {
    let order: Vec<usize> = (0..scenario.requests.len()).step_by(2).collect();
    plan_from_order(scenario, &order, "greedy")
}

/// A reward scenario whose sensors stand in these places and all ask.
fn at(places: &[[f64; 2]]) -> Value {
    let sensor = |(i, place): (usize, &[f64; 2])| json!({"id": format!("s{i}"), "position_m": place, "battery_j": 10800});
    let request = |i: usize| json!({"sensor": format!("s{i}")});
    json!({
        "format": "voltour/scenario/1", "objective": "max_reward",
        "charger": {"start_m": [0, 0], "speed_mps": 5, "travel_jpm": 600, "transfer_w": 20},
        "sensors": places.iter().enumerate().map(sensor).collect::<Vec<_>>(),
        "requests": (0..places.len()).map(request).collect::<Vec<_>>(),
    })
}

/// Parses, so that it is well-formed; without anything that runs or is loaded from elsewhere.
fn well_formed(text: &str) -> Document<'_> {
    let document = Document::parse(text).unwrap();
    for node in document.descendants().filter(roxmltree::Node::is_element) {
        let name = node.tag_name().name();
        assert!(!["script", "image", "foreignObject", "a", "use"].contains(&name), "{name}");
        for attribute in node.attributes() {
            assert!(!attribute.name().starts_with("on") && attribute.name() != "href");
            assert!(!attribute.value().contains("NaN") && !attribute.value().contains("inf"));
        }
    }
    let root = document.root_element();
    assert!(root.attribute("viewBox").is_some_and(|b| b.split(' ').count() == 4));
    document
}

fn count(document: &Document<'_>, class: &str) -> usize {
    document.descendants().filter(|n| n.attribute("class") == Some(class)).count()
}

fn titles(document: &Document<'_>) -> Vec<String> {
    let titles = document.descendants().filter(|n| n.tag_name().name() == "title");
    titles.map(|n| n.text().unwrap_or_default().trim().to_owned()).collect()
}

#[test]
fn every_preset_has_a_picture() {
    for scenario in [
        generated(&generate::k_coverage(&KCoverage::default(), 1).unwrap()),
        generated(&generate::reward(&Reward::default(), 1).unwrap()),
        generated(&generate::mobile(&Mobile::default(), 1).unwrap()),
    ] {
        let plan = some_plan(&scenario);
        let text = picture(&scenario, &plan);
        let document = well_formed(&text);
        // One mark in the legend beside those on the map.
        assert_eq!(count(&document, "stop"), plan.stops.len() + 1);
        let stops = titles(&document).into_iter().filter(|t| t.starts_with("Stop ")).count();
        assert_eq!(stops, plan.stops.len());
        assert!(text.contains(scenario.name.as_deref().unwrap()));
        assert!(text.len() < 300_000);
    }
}

#[test]
fn every_reason_and_shortfall_is_shown() {
    let document = generate::k_coverage(&KCoverage::default(), 2).unwrap();
    let scenario = generated(&document);
    let mut plan = plan_from_order(&scenario, &[], "greedy");
    let reasons = [
        (Reason::AlreadyCharged, "charged"),
        (Reason::Unreachable, "unreachable"),
        (Reason::NoCapacity, "nocapacity"),
        (Reason::NotNeeded, "unneeded"),
        (Reason::NotChosen, "unchosen"),
    ];
    plan.unserved = (scenario.requests.iter().zip(reasons))
        .map(|(request, (reason, _))| Unserved {
            sensor: scenario.sensors[request.sensor].id.clone(),
            reason,
        })
        .collect();
    plan.violations = vec![
        Violation::Coverage { at_m: [100.0, 100.0], needs: 3, has: 1 },
        Violation::Timespan { limit: 10.0, needs: 20.0 },
        Violation::Capacity { limit: 10.0, needs: 20.0 },
    ];
    plan.warnings = vec![Warning::BelowK { at_m: [400.0, 100.0], needs: 3, has: 2 }];
    let text = picture(&scenario, &plan);
    let document = well_formed(&text);
    for (_, class) in reasons {
        assert!(count(&document, class) >= 2, "{class}");
    }
    assert_eq!((count(&document, "short"), count(&document, "belowk")), (2, 2));
    assert!(titles(&document).contains(&"Coverage falls short: needs 3, keeps 1".to_owned()));
    assert!(text.contains("even the empty trip takes 20 s of 10 s"));
}

#[test]
fn free_text_is_escaped() {
    let nasty = "<script>alert('1')</script>&\"]]>\u{0}\u{1b}\u{202e}\n";
    let mut document = at(&[[10.0, 20.0], [30.0, 5.0]]);
    for (of, field) in [("sensors", "id"), ("requests", "sensor")] {
        document[of][0][field] = json!(nasty);
    }
    document["name"] = json!(nasty);
    let scenario = scenario(&document);
    let mut plan = some_plan(&scenario);
    plan.solver = nasty.to_owned();
    let text = picture(&scenario, &plan);
    let document = well_formed(&text);
    let clean = "<script>alert('1')</script>&\"]]>\u{fffd}\u{fffd}\u{fffd}\u{fffd}";
    let first = titles(&document).into_iter().find(|t| t.starts_with("Stop 1")).unwrap();
    assert!(first.contains(clean), "{first:?}");
}

#[test]
fn an_empty_scenario_and_an_empty_tour_have_pictures() {
    let empty = scenario(&at(&[]));
    well_formed(&picture(&empty, &plan_from_order(&empty, &[], "greedy")));
    let idle = generated(&generate::reward(&Reward::default(), 3).unwrap());
    let mut plan = plan_from_order(&idle, &[], "greedy");
    plan.status = Status::Infeasible;
    assert!(picture(&idle, &plan).contains("INFEASIBLE"));
}

#[test]
fn odd_places_have_pictures() {
    let huge = f64::MAX;
    for places in [
        vec![[0.0, 0.0]; 30],
        vec![[7.0, 0.0], [9.0, 0.0]],
        vec![[1e15, 1e15], [1e15 + 1.0, 1e15]],
        vec![[huge, huge], [-huge, -huge], [huge, -huge]],
        vec![[1e-300, 0.0], [0.0, 5e-324]],
    ] {
        let scenario = scenario(&at(&places));
        let mut plan = some_plan(&scenario);
        // Distances overflow there, and a picture has to cope with whatever stands in a plan.
        plan.finish_s = f64::MAX;
        well_formed(&picture(&scenario, &plan));
    }
}

#[test]
fn a_plan_of_another_scenario_has_a_picture() {
    let scenario = scenario(&at(&[[1.0, 2.0]]));
    let mut plan = some_plan(&scenario);
    plan.stops.push(Stop {
        sensor: "stranger".into(),
        position_m: [50.0, 60.0],
        arrive_s: -1.0,
        depart_s: 1e300,
        charge_j: 0.0,
    });
    plan.unserved.push(Unserved { sensor: "other".into(), reason: Reason::NotChosen });
    let text = picture(&scenario, &plan);
    assert!(text.contains("stranger"));
    well_formed(&text);
}

#[test]
fn thousands_of_sensors_stay_small() {
    let places: Vec<_> = (0..60_000_u32)
        .map(|i| [f64::from(i % 300) * 3.7, f64::from(i / 300) * 5.1 + f64::from(i % 7)])
        .collect();
    let scenario = scenario(&at(&places));
    let text = picture(&scenario, &some_plan(&scenario));
    assert!(text.len() < 2_500_000, "{}", text.len());
    well_formed(&text);
}

#[test]
fn a_matrix_makes_the_line_dashed() {
    let mut document = at(&[[10.0, 0.0], [0.0, 10.0]]);
    document["travel"] = json!({"distance_m": vec![vec![5.0; 4]; 4]});
    let scenario = scenario(&document);
    let text = picture(&scenario, &some_plan(&scenario));
    let picture = well_formed(&text);
    let mut legs = picture.descendants().filter(|n| n.attribute("class") == Some("leg"));
    assert!(legs.all(|leg| leg.attribute("stroke-dasharray").is_some()));
}

#[test]
fn the_same_plan_gives_the_same_picture() {
    let scenario = generated(&generate::mobile(&Mobile::default(), 5).unwrap());
    let plan = some_plan(&scenario);
    assert_eq!(picture(&scenario, &plan), picture(&scenario, &plan));
}
