//! The charger: announces its departure, fetches its tour, drives it, reports each visit, returns.

use std::sync::Arc;
use std::time::Duration;

use voltour_solver::gap::percent;

use super::stage::Play;
use crate::cli::Failure;
use crate::cli::operator::{Service, call, fresh_id, refused, unreadable, waiting};
use crate::clock::plus;
use crate::domain::{Announcement, ChargerId, Departure, NewVisit, Outcome, Stop, Tour};
use crate::grpc::wire;
use crate::proto::departure_service_client::DepartureServiceClient;
use crate::proto::tour_service_client::TourServiceClient;
use crate::proto::{CompleteRequest, GetNextRequest};

/// How long it waits for a plan, off stage.
const PATIENCE: Duration = Duration::from_secs(60);
/// How long it rests between two tours, on stage.
const REST: Duration = Duration::from_secs(15 * 60);
/// How often it looks whether anybody waits, on stage.
const LOOKS: Duration = Duration::from_secs(60);

/// Plays so many departures, or until it is stopped.
pub(super) async fn play(
    play: Arc<Play>,
    charger: ChargerId,
    departures: Option<u32>,
) -> Result<(), Failure> {
    let mut gone = 0;
    while departures.is_none_or(|all| gone < all) {
        while play.world.waiting() == 0 {
            play.clock.sleep_until(plus(play.clock.now(), LOOKS)).await;
        }
        let departure = announce(&play, &charger).await?;
        let mut client = TourServiceClient::new(play.channel.clone());
        match fetch(&play, &mut client, &departure).await? {
            Some(tour) => drive(&play, &mut client, tour).await?,
            None => play.tell(&charger, "stays where it is"),
        }
        gone += 1;
        play.clock.sleep_until(plus(play.clock.now(), REST)).await;
    }
    Ok(())
}

async fn announce(play: &Play, charger: &ChargerId) -> Result<Departure, Failure> {
    let announced = Announcement {
        network_id: play.network.clone(),
        charger_id: charger.clone(),
        charger_type: None,
        t0: None,
        start_m: None,
        end_m: None,
        capacity_j: None,
        timespan_s: None,
    };
    let message = wire::announcement_to_wire(&fresh_id()?, announced);
    let mut client = DepartureServiceClient::new(play.channel.clone());
    let departure = client.announce(call(message)).await.map_err(refused)?.into_inner();
    let departure = wire::departure(departure).map_err(unreadable)?;
    let leaves = play.teller.time(departure.t0);
    play.tell(charger, &format!("announces that it leaves at {leaves}; the batch closes"));
    Ok(departure)
}

/// The tour of a departure; none where it was refused.
async fn fetch(
    play: &Play,
    client: &mut TourServiceClient<Service>,
    departure: &Departure,
) -> Result<Option<Tour>, Failure> {
    let charger = &departure.announced.charger_id;
    let message = GetNextRequest {
        network_id: play.network.as_str().to_owned(),
        charger_id: charger.as_str().to_owned(),
        departure_id: departure.id.to_string(),
    };
    match client.get_next(waiting(message, PATIENCE)).await {
        Ok(tour) => wire::tour(tour.into_inner()).map(Some).map_err(unreadable),
        Err(status) => {
            play.tell(charger, &format!("gets no tour: {}", status.message()));
            Ok(None)
        }
    }
}

async fn drive(
    play: &Play,
    client: &mut TourServiceClient<Service>,
    tour: Tour,
) -> Result<(), Failure> {
    let charger = &tour.charger_id;
    let (stops, back) = (tour.stops.len(), play.teller.time(tour.finish));
    let (length, solver) = (tour.distance_m, &tour.solver);
    let gap = tour.gap.map(|gap| format!(", gap {}", percent(gap))).unwrap_or_default();
    let plan =
        format!("gets its tour: {stops} stops, {length:.0} m, back at {back} (by {solver}{gap})");
    play.tell(charger, &plan);
    play.clock.sleep_until(tour.start).await;
    for stop in &tour.stops {
        play.clock.sleep_until(stop.arrive).await;
        let percent = 100.0 * play.world.share(&stop.sensor_id, stop.arrive);
        // From the plug on: a sensor that is being charged does not ask.
        play.world.charged(&stop.sensor_id, stop.depart);
        play.clock.sleep_until(stop.depart).await;
        report(client, &tour, stop).await?;
        let (sensor, energy) = (&stop.sensor_id, stop.charge_j);
        let what =
            format!("has charged {sensor}, which had {percent:.0} % left, with {energy:.0} J");
        play.tell(charger, &what);
    }
    play.clock.sleep_until(tour.finish).await;
    let message = CompleteRequest { client_id: fresh_id()?.into(), tour_id: tour.id.to_string() };
    client.complete(call(message)).await.map_err(refused)?;
    let waiting = play.world.waiting();
    play.tell(charger, &format!("is back; {waiting} sensors wait for the next tour"));
    play.tell(charger, &format!("picture of the tour: {}", play.picture(tour.plan_id)));
    Ok(())
}

async fn report(
    client: &mut TourServiceClient<Service>,
    tour: &Tour,
    stop: &Stop,
) -> Result<(), Failure> {
    let visit = NewVisit {
        tour_id: tour.id,
        sensor_id: stop.sensor_id.clone(),
        outcome: Outcome::Charged,
        arrived_at: Some(stop.arrive),
        departed_at: Some(stop.depart),
        charge_j: Some(stop.charge_j),
        note: None,
    };
    let message = wire::new_visit_to_wire(&fresh_id()?, visit);
    client.report_visit(call(message)).await.map_err(refused)?;
    Ok(())
}
