//! Lists: filters, and cursors that lose and repeat nothing while rows are being added.

use super::{all, walk};
use crate::app::TestApp;
use crate::field::{FIELD, line, put, sensor};

#[tokio::test]
async fn requests_page_by_page_while_more_come_in() {
    let app = TestApp::start().await;
    app.put(line(60)).await;
    let mut before = Vec::new();
    for number in 1..=23 {
        before.push(app.ask(&sensor(number).id).await.id);
    }
    before.reverse();
    let mut number = 24;
    let path = format!("/v1/requests?network={FIELD}");
    let found = walk(&app, &path, 3, async || {
        app.ask(&sensor(number).id).await;
        app.withdraw(&before[before.len() - (number - 23)]).await;
        number += 1;
    });
    assert_eq!(all(&found.await, "id"), before);
}

#[tokio::test]
async fn every_list_is_walked_to_its_end() {
    let app = TestApp::start().await;
    for id in ["c", "a", "b"] {
        let call = voltour::proto::PutNetworkRequest { network_id: id.into(), ..put(line(1)) };
        app.networks().put(call).await.unwrap();
    }
    app.put(line(1)).await;
    let mut plans = Vec::new();
    let mut departures = Vec::new();
    for _ in 0..4 {
        let tour = app.drive("A").await;
        app.complete(&tour).await;
        plans.insert(0, tour.plan_id);
        departures.insert(0, tour.departure_id);
    }
    for limit in [1, 3, 4, 500] {
        let networks = walk(&app, "/v1/networks", limit, async || ()).await;
        assert_eq!(all(&networks, "id"), ["a", "b", "c", FIELD]);
        let found = walk(&app, "/v1/plans", limit, async || ()).await;
        assert_eq!(all(&found, "id"), plans);
        let found = walk(&app, "/v1/departures", limit, async || ()).await;
        assert_eq!(all(&found, "id"), departures);
    }
}

#[tokio::test]
async fn filters_let_pass_what_they_name() {
    let app = TestApp::start().await;
    app.put(line(3)).await;
    let old = app.ask("s1").await.id;
    let new = app.ask("s1").await.id;
    let other = app.ask("s2").await.id;
    let first = app.drive("A").await;
    app.charged(&first, "s1").await;
    app.complete(&first).await;
    let second = app.drive("B").await;
    let ids = |path: String| {
        let app = &app;
        async move {
            let found = app.json(&path).await["items"].take();
            all(found.as_array().unwrap(), "id").into_iter().map(String::from).collect::<Vec<_>>()
        }
    };
    let time = |stamp: &Option<prost_types::Timestamp>| {
        let us = crate::time::us(stamp);
        jiff::Timestamp::from_microsecond(us).unwrap().to_string()
    };
    // Made between the two plans: the end of the first tour.
    let between = time(&app.departure(&first.departure_id).await.updated_at);
    let none: [&str; 0] = [];
    for (path, expected) in [
        ("requests?state=served".to_owned(), vec![new.as_str()]),
        ("requests?state=served&state=superseded".to_owned(), vec![&new, &old]),
        ("requests?sensor=s2".to_owned(), vec![&other]),
        ("requests?network=nowhere".to_owned(), none.to_vec()),
        (format!("requests?network={FIELD}&sensor=s1&state=superseded"), vec![&old]),
        ("departures?state=completed".to_owned(), vec![&first.departure_id]),
        ("departures?charger=B".to_owned(), vec![&second.departure_id]),
        ("departures?charger=C".to_owned(), none.to_vec()),
        ("plans?charger=A".to_owned(), vec![&first.plan_id]),
        ("plans?network=nowhere".to_owned(), none.to_vec()),
        ("plans?solver=random".to_owned(), none.to_vec()),
        (format!("plans?solver={}&charger=B", second.solver), vec![&second.plan_id]),
        ("plans?status=infeasible".to_owned(), none.to_vec()),
        (format!("plans?from={between}"), vec![&second.plan_id]),
        (format!("plans?until={between}"), vec![&first.plan_id]),
        (format!("plans?from={between}&until={between}"), none.to_vec()),
    ] {
        assert_eq!(ids(format!("/v1/{path}")).await, expected, "{path}");
    }
}
