//! What was acknowledged is there, as it was acknowledged; asked over gRPC where there is a call for it,
//! read from the database where there is none.

use std::collections::HashMap;

use tonic::Request;
use voltour::proto::{ChargingRequest, GetNextRequest, ListRequestsRequest, Tour};

use super::charger::Charger;
use super::station::Station;
use crate::app::{PATIENCE, TestApp};
use crate::database::{open, rows};
use crate::field::FIELD;

pub async fn acknowledged(app: &TestApp, stations: &[Station], chargers: &[Charger]) {
    let stored = all_requests(app).await;
    for (sent, id) in stations.iter().flat_map(|station| &station.acknowledged) {
        let request = stored.get(id).unwrap_or_else(|| panic!("lost: {sent:?}"));
        assert_eq!(request.submitted.as_ref(), Some(sent));
    }
    for charger in chargers {
        announced(app, charger).await;
        on_its_way(app, charger).await;
    }
    reported(app, chargers).await;
}

async fn all_requests(app: &TestApp) -> HashMap<String, ChargingRequest> {
    let mut list = ListRequestsRequest {
        network_id: FIELD.into(),
        page_size: 500,
        ..ListRequestsRequest::default()
    };
    let mut all = HashMap::new();
    loop {
        let page = app.requests().list(list.clone()).await.expect("List").into_inner();
        for request in page.requests {
            assert!(all.insert(request.id.clone(), request).is_none(), "listed twice");
        }
        list.page_token = page.next_page_token;
        if list.page_token.is_empty() {
            return all;
        }
    }
}

async fn announced(app: &TestApp, charger: &Charger) {
    for told in &charger.announced {
        let stored = app.departure(&told.id).await;
        assert_eq!((&stored.announced, stored.t0), (&told.announced, told.t0));
    }
}

/// The same tour, whatever was reported of it since.
fn driving(tour: &Tour) -> Tour {
    let mut tour = Tour { updated_at: None, ..tour.clone() };
    tour.stops.iter_mut().for_each(|stop| stop.outcome = 0);
    tour
}

/// The tour that a charger was given before the crash is given again.
async fn on_its_way(app: &TestApp, charger: &Charger) {
    let Some(tour) = charger.on() else { return };
    let mut next = Request::new(GetNextRequest {
        network_id: FIELD.into(),
        charger_id: tour.charger_id.clone(),
        departure_id: String::new(),
    });
    next.set_timeout(PATIENCE);
    let again = app.tours().get_next(next).await.expect("GetNext").into_inner();
    assert_eq!(driving(&again), driving(tour));
}

async fn reported(app: &TestApp, chargers: &[Charger]) {
    let mut conn = open(&app.database()).await;
    let visits =
        rows(&mut conn, "SELECT id, tour_id, client_id, sensor_id, outcome FROM visits").await;
    let visits: HashMap<_, _> = visits.iter().map(|row| (row[0].as_str(), &row[1..])).collect();
    let states = rows(&mut conn, "SELECT id, state FROM tours").await;
    let states: HashMap<_, _> = states.iter().map(|row| (row[0].as_str(), &row[1])).collect();
    let stops =
        rows(&mut conn, "SELECT tour_id, request_id FROM stops ORDER BY tour_id, position").await;
    for charger in chargers {
        for told in &charger.visits {
            let report = told.reported.as_ref().expect("what was reported");
            let outcome = ["", "charged", "skipped", "failed"][report.outcome as usize];
            let expected =
                [&report.tour_id, &report.client_id, &report.sensor_id, &outcome.to_owned()]
                    .map(String::clone);
            assert_eq!(visits.get(told.id.as_str()), Some(&expected.as_slice()), "{told:?}");
        }
        for (tour, state) in &charger.ended {
            assert_eq!(states.get(tour.as_str()).map(|s| s.as_str()), Some(*state), "tour {tour}");
        }
        for tour in charger.tours.values() {
            let stored = stops.iter().filter(|row| row[0] == tour.id).map(|row| &row[1]);
            assert!(stored.eq(tour.stops.iter().map(|stop| &stop.request_id)), "{tour:?}");
        }
    }
}
