//! What the soak looks for is seen where it happens.

use super::history::History;
use super::memory::Memory;
use super::operator::Operator;
use crate::app::TestApp;
use crate::field::line;

/// The operator, and the id, departure, scenario and plan of a tour with one stop.
async fn one_plan(app: &TestApp) -> (Operator, [String; 4]) {
    app.put(line(1)).await;
    app.ask("s1").await;
    let tour = app.drive("A").await;
    let history = History::of(&app.rest);
    let envelope = history.json(&format!("/v1/plans/{}", tour.plan_id)).await.unwrap();
    let scenario = history.text(&format!("/v1/plans/{}/scenario", tour.plan_id)).await.unwrap();
    let plan = envelope["plan"].to_string();
    (Operator::new(app.file("checked")), [tour.plan_id, tour.departure_id, scenario, plan])
}

#[tokio::test]
#[should_panic(expected = "check refuses plan")]
async fn a_plan_that_breaks_a_rule_is_noticed() {
    let app = TestApp::start().await;
    let (mut operator, [id, departure, scenario, plan]) = one_plan(&app).await;
    let broken = plan.replace("\"s1\"", "\"s2\"");
    operator.judge(&id, &departure, &scenario, &broken).await;
}

#[tokio::test]
#[should_panic(expected = "is planned twice, the second time as another")]
async fn a_departure_with_two_plans_is_noticed() {
    let app = TestApp::start().await;
    let (mut operator, [id, departure, scenario, plan]) = one_plan(&app).await;
    operator.judge(&id, &departure, &scenario, &plan).await;
    operator.knows(&id, &departure);
    operator.judge("another", &departure, &scenario, &plan).await;
}

#[tokio::test]
#[should_panic(expected = "is not in the history")]
async fn a_plan_that_is_gone_is_noticed() {
    let app = TestApp::start().await;
    let (operator, [id, departure, ..]) = one_plan(&app).await;
    operator.knows(&id, &departure);
}

#[test]
fn memory_that_fills_and_stays_is_flat() {
    let mut memory = Memory::default();
    for life in 0..9 {
        let filling = |i: u32| 50.0 + f64::from(i.min(40)) + f64::from(life);
        memory.add(&(0..100).map(filling).collect::<Vec<_>>());
    }
    memory.is_flat();
}

#[test]
#[should_panic(expected = "in a quarter of a life")]
fn memory_that_grows_within_lives_is_noticed() {
    let mut memory = Memory::default();
    for _ in 0..10 {
        memory.add(&(0..100).map(|i| 50.0 + f64::from(i) / 4.0).collect::<Vec<_>>());
    }
    memory.is_flat();
}

#[test]
#[should_panic(expected = "from 50 to 130 MiB")]
fn memory_that_grows_from_life_to_life_is_noticed() {
    let mut memory = Memory::default();
    for level in [50.0, 50.0, 50.0, 130.0] {
        memory.add(&[level; 40]);
    }
    memory.is_flat();
}
