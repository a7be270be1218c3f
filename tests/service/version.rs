//! Networks: versions, what a new one changes, and what it leaves alone.

use tonic::Code;
use voltour::proto::{GetNetworkRequest, PutNetworkRequest};

use crate::app::TestApp;
use crate::calls::{OPEN, listed, sensors};
use crate::field::{FIELD, covered, line, put};
use crate::time::us;

fn get(id: &str) -> GetNetworkRequest {
    GetNetworkRequest { network_id: id.into() }
}

#[tokio::test]
async fn a_network_comes_back_as_it_was_put() {
    let app = TestApp::start().await;
    let mut spec = covered(3, 2);
    spec.charge_level = Some(0.75);
    spec.charger_types[0].capacity_j = Some(1e6);
    spec.charger_types[0].end_m = crate::field::point(1.0, 2.0);
    // Free text, kept letter for letter.
    spec.sensors[2].id = "dépôt <&\"'> 3".into();
    let answer = app.put(spec.clone()).await;
    assert_eq!((answer.version, answer.sensor_count, &answer.id), (1, 3, &FIELD.to_owned()));
    assert_eq!(answer.spec, Some(spec));
    let read = app.networks().get(get(FIELD)).await.unwrap().into_inner();
    assert_eq!(read, answer);
    let refused = app.networks().get(get("nowhere")).await.unwrap_err();
    assert_eq!(refused.code(), Code::NotFound);
}

#[tokio::test]
async fn only_other_content_makes_a_new_version() {
    let app = TestApp::start().await;
    let first = app.put(line(2)).await;
    let same = app.put(line(2)).await;
    assert_eq!((same.version, same.updated_at), (1, first.updated_at));
    let other = app.put(line(3)).await;
    assert_eq!((other.version, other.created_at), (2, first.created_at));
    assert!(us(&other.updated_at) > us(&first.updated_at));
}

#[tokio::test]
async fn the_expected_version_must_be_the_present_one() {
    let app = TestApp::start().await;
    let expecting =
        |version, spec| PutNetworkRequest { expected_version: Some(version), ..put(spec) };
    let refused = app.networks().put(expecting(1, line(1))).await.unwrap_err();
    assert_eq!(refused.code(), Code::Aborted, "there is none yet");
    app.networks().put(expecting(0, line(1))).await.unwrap();
    let refused = app.networks().put(expecting(0, line(2))).await.unwrap_err();
    assert_eq!(refused.code(), Code::Aborted, "there is one");
    let next = app.networks().put(expecting(1, line(2))).await.unwrap().into_inner();
    assert_eq!(next.version, 2);
    let refused = app.networks().put(expecting(1, line(3))).await.unwrap_err();
    assert_eq!(refused.code(), Code::Aborted, "it is another one by now");
}

#[tokio::test]
async fn the_next_departure_is_planned_on_the_new_version() {
    let app = TestApp::start().await;
    app.put(line(3)).await;
    let (stays, goes) = (app.ask("s1").await, app.ask("s3").await);
    let mut spec = line(2);
    spec.sensors[0].place = crate::field::at_rest(0.0, 70.0);
    app.put(spec).await;
    let tour = app.drive("A").await;
    assert_eq!(sensors(&tour), ["s1"], "s3 is no longer a sensor of the network");
    assert_eq!(tour.stops[0].position_m, crate::field::point(0.0, 70.0));
    let scenario = app.scenario(&tour).await;
    assert_eq!(listed(&scenario, "sensors", "id"), ["s1", "s2"]);
    assert_eq!(app.state(&stays.id).await, crate::calls::PLANNED);
    assert_eq!(app.state(&goes.id).await, OPEN, "nothing acknowledged is lost");
    app.complete(&tour).await;
    app.put(line(3)).await;
    let mut again = app.drive("A").await.stops;
    again.sort_by(|a, b| a.sensor_id.cmp(&b.sensor_id));
    assert_eq!(again.last().unwrap().request_id, goes.id);
}
