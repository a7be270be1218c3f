//! REST and gRPC tell the same of the same thing.

use jiff::Timestamp;
use serde_json::Value;
use voltour::proto::SubmitRequest;

use crate::app::TestApp;
use crate::field::{FIELD, line, request};
use crate::time::{from_now, us};

/// An RFC 3339 time in UTC, in microseconds since the epoch.
fn micros(time: &Value) -> i64 {
    let text = time.as_str().unwrap_or_else(|| panic!("{time} is no time"));
    assert!(text.ends_with('Z'), "{text} is not in UTC");
    text.parse::<Timestamp>().expect("RFC 3339").as_microsecond()
}

#[tokio::test]
async fn of_a_network() {
    let app = TestApp::start().await;
    let network = app.put(line(2)).await;
    let read = app.json(&format!("/v1/networks/{FIELD}")).await;
    assert_eq!((&read["id"], &read["version"]), (&FIELD.into(), &1.into()));
    assert_eq!(read["sensor_count"], 2);
    assert_eq!(micros(&read["created_at"]), us(&network.created_at));
    let spec = &read["spec"];
    assert_eq!(spec["objective"], "max_reward");
    assert_eq!(spec["charger_types"][0]["name"], "truck");
    assert_eq!(spec["charger_types"][0]["start_m"], serde_json::json!([0.0, 0.0]));
    assert_eq!(spec["sensors"][1]["id"], "s2");
    assert_eq!(spec["sensors"][1]["battery_j"], 100.0);
    let listed = app.json("/v1/networks").await;
    assert_eq!(listed["items"][0]["id"], FIELD);
    assert!(listed["items"][0]["spec"].is_null(), "lists leave the sensors out");
}

#[tokio::test]
async fn of_a_request_in_every_part() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let sent = SubmitRequest {
        deadline: from_now(600_000),
        ready: from_now(1_000),
        residual_j: Some(12.5),
        measured_at: from_now(-1_000),
        drain_w: Some(0.25),
        reward: Some(7.0),
        required: true,
        ..request("s1")
    };
    let stored = app.submit(sent.clone()).await;
    let read = app.json(&format!("/v1/requests/{}", stored.id)).await;
    assert_eq!((&read["id"], &read["state"]), (&stored.id.into(), &"open".into()));
    assert_eq!(read["network_id"], FIELD);
    assert_eq!(read["sensor_id"], "s1");
    assert_eq!(read["client_id"], sent.client_id.as_str());
    assert_eq!(micros(&read["deadline"]), us(&sent.deadline));
    assert_eq!(micros(&read["ready"]), us(&sent.ready));
    assert_eq!(micros(&read["measured_at"]), us(&sent.measured_at));
    assert_eq!((&read["residual_j"], &read["drain_w"]), (&12.5.into(), &0.25.into()));
    assert_eq!((&read["reward"], &read["required"]), (&7.0.into(), &true.into()));
    assert_eq!(micros(&read["received_at"]), us(&stored.received_at));
}

#[tokio::test]
async fn of_a_departure_and_its_plan() {
    let app = TestApp::start().await;
    app.put(line(3)).await;
    for sensor in ["s1", "s3"] {
        app.ask(sensor).await;
    }
    let tour = app.drive("A").await;
    let departure = app.departure(&tour.departure_id).await;
    let read = app.json(&format!("/v1/departures/{}", departure.id)).await;
    assert_eq!((&read["state"], &read["batch_size"]), (&"planned".into(), &2.into()));
    assert_eq!(read["plan_id"], tour.plan_id.as_str());
    assert_eq!(read["tour_ids"], serde_json::json!([tour.id]));
    for (member, time) in [
        ("t0", &departure.t0),
        ("closes_at", &departure.closes_at),
        ("start", &departure.start),
        ("announced_at", &departure.announced_at),
    ] {
        assert_eq!(micros(&read[member]), us(time), "{member}");
    }

    let envelope = app.json(&format!("/v1/plans/{}", tour.plan_id)).await;
    let mut members: Vec<_> = envelope.as_object().unwrap().keys().collect();
    members.sort();
    assert_eq!(members, ["plan", "provenance"], "an envelope and no more");
    assert_eq!(envelope["plan"]["objective"], tour.objective);
    assert_eq!(envelope["plan"]["solver"], tour.solver.as_str());
    let stops = envelope["plan"]["stops"].as_array().unwrap();
    assert_eq!(stops.len(), tour.stops.len());
    for (read, stop) in stops.iter().zip(&tour.stops) {
        assert_eq!(read["sensor"], stop.sensor_id.as_str());
        assert_eq!(read["charge_j"], stop.charge_j);
        // Seconds after the start, the same to the microsecond.
        let arrive = read["arrive_s"].as_f64().unwrap() * 1e6;
        assert!((arrive - (us(&stop.arrive) - us(&tour.start)) as f64).abs() <= 1.0);
    }
    let summary = app.json("/v1/plans").await["items"][0].take();
    assert_eq!(
        (&summary["id"], &summary["departure_id"]),
        (&tour.plan_id.as_str().into(), &departure.id.as_str().into())
    );
    assert_eq!((&summary["stops"], &summary["unserved"]), (&2.into(), &0.into()));
    assert_eq!(
        (&summary["solver"], &summary["objective"]),
        (&tour.solver.as_str().into(), &tour.objective.into())
    );
    assert_eq!(
        (micros(&summary["start"]), micros(&summary["finish"])),
        (us(&tour.start), us(&tour.finish))
    );
    assert_eq!(micros(&envelope["provenance"]["start"]), us(&tour.start));
    let batch = envelope["provenance"]["batch"].as_array().unwrap();
    assert_eq!(batch.len(), 2);
}
