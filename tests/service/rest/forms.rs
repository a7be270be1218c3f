//! What other tools take from REST: the map of a plan, the table of all, both compressed where they like it, and the
//! document of the contract with its page.

use reqwest::header::{ACCEPT_ENCODING, CONTENT_ENCODING, CONTENT_TYPE, ETAG, IF_NONE_MATCH};
use serde_json::{Value, json};

use crate::app::{PATIENCE, TestApp};
use crate::field::{covered, line};

/// The positions of a feature's line or point, in pairs.
fn place<'a>(map: &'a Value, kind: &str) -> &'a Value {
    let features = map["features"].as_array().expect("features");
    let found = features.iter().find(|feature| feature["properties"]["kind"] == kind);
    &found.unwrap_or_else(|| panic!("no {kind} in {map}"))["geometry"]["coordinates"]
}

#[tokio::test]
async fn a_map_is_in_metres_or_on_the_earth() {
    let app = TestApp::start().await;
    app.put(covered(3, 1)).await;
    app.ask("s2").await;
    app.ask("s1").await;
    let tour = app.drive("A").await;
    let path = format!("/v1/plans/{}.geojson", tour.plan_id);
    let answer = app.get(&path).await;
    assert_eq!(answer.headers()[CONTENT_TYPE], "application/geo+json");
    let map: Value = answer.json().await.unwrap();
    assert_eq!(map["type"], "FeatureCollection");
    assert_eq!(place(&map, "start"), &json!([0.0, 0.0]));
    let mut driven = vec![json!([0.0, 0.0])];
    driven.extend(tour.stops.iter().map(|stop| {
        let at = stop.position_m.as_ref().expect("a position");
        json!([at.x_m, at.y_m])
    }));
    driven.push(json!([0.0, 0.0]));
    assert_eq!(place(&map, "tour"), &Value::Array(driven));
    let ring = place(&map, "field")[0].as_array().unwrap();
    assert_eq!((ring.len(), ring.first()), (5, ring.last()));

    let earth = app.json(&format!("{path}?origin=11.58,48.14")).await;
    for at in place(&earth, "tour").as_array().unwrap().iter().chain([place(&earth, "start")]) {
        let (lon, lat) = (at[0].as_f64().unwrap(), at[1].as_f64().unwrap());
        assert!((lon - 11.58).abs() < 0.001 && (lat - 48.14).abs() < 0.001, "{at}");
    }
}

#[tokio::test]
async fn the_table_has_a_line_for_every_plan() {
    let app = TestApp::start().await;
    app.put(line(1)).await;
    let mut plans = Vec::new();
    for _ in 0..3 {
        let tour = app.drive("A").await;
        app.complete(&tour).await;
        plans.insert(0, tour.plan_id);
    }
    let answer = app.get("/v1/plans.csv").await;
    assert!(answer.headers()[CONTENT_TYPE].to_str().unwrap().starts_with("text/csv"));
    let table = answer.text().await.unwrap();
    let ids: Vec<_> = table.lines().map(|line| line.split(',').next().unwrap()).collect();
    assert_eq!(ids, ["id", &plans[0], &plans[1], &plans[2]]);
    let none = app.get("/v1/plans.csv?charger=B").await.text().await.unwrap();
    assert_eq!(none.lines().count(), 1, "{none}");
    let client = reqwest::Client::builder().timeout(PATIENCE).build().unwrap();
    let packed = client.get(format!("{}/v1/plans.csv", app.rest)).header(ACCEPT_ENCODING, "gzip");
    let packed = packed.send().await.unwrap();
    assert_eq!(packed.headers()[CONTENT_ENCODING], "gzip");
    let packed = packed.bytes().await.expect("a whole answer");
    assert!(packed.starts_with(&[0x1f, 0x8b]));
}

#[tokio::test]
async fn who_takes_gzip_gets_it_and_is_known_again() {
    let app = TestApp::start().await;
    app.put(line(2)).await;
    let tour = app.drive("A").await;
    let address = format!("{}/v1/plans/{}", app.rest, tour.plan_id);
    let client = reqwest::Client::builder().timeout(PATIENCE).build().unwrap();
    let packed = client.get(&address).header(ACCEPT_ENCODING, "gzip").send().await.unwrap();
    assert_eq!(packed.headers()[CONTENT_ENCODING], "gzip");
    let tag = packed.headers()[ETAG].clone();
    assert!(tag.to_str().unwrap().starts_with("W/\""), "{tag:?}");
    assert!(packed.bytes().await.unwrap().starts_with(&[0x1f, 0x8b]));
    let again = client.get(&address).header(IF_NONE_MATCH, &tag).send().await.unwrap();
    assert_eq!((again.status().as_u16(), &again.headers()[ETAG]), (304, &tag));
}

#[tokio::test]
async fn the_document_is_the_checked_in_one_and_has_a_page() {
    let app = TestApp::start().await;
    let served = app.get("/openapi.json").await.text().await.unwrap();
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/openapi.json");
    assert_eq!(
        served.trim(),
        std::fs::read_to_string(file).unwrap().trim(),
        "`just openapi` writes it"
    );
    let page = app.get("/docs").await;
    assert!(page.url().path().ends_with("/docs/"), "followed to {}", page.url());
    assert!(page.text().await.unwrap().contains("swagger-ui"));
    assert_eq!(app.get("/docs/swagger-ui-bundle.js").await.status(), 200);
}
