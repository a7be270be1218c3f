//! `GetNext`: the tour that a charger is on, or the one that its next departure will have.

use tokio::sync::watch;

use crate::domain::{ChargerId, Departure, DepartureId, DepartureState, NetworkId, Refusal, Tour};
use crate::store::{Reads, StoreError};

/// Looks, and looks again whenever a departure or a tour has changed.
pub(super) async fn wait(
    reads: &Reads,
    mut changes: watch::Receiver<u64>,
    network: &NetworkId,
    charger: &ChargerId,
    departure: Option<DepartureId>,
) -> Result<Tour, Refusal> {
    let mut awaited = None;
    loop {
        // Seen before looking: what changes while we look wakes us again.
        changes.borrow_and_update();
        let found = match departure {
            Some(id) => of_departure(reads, network, charger, id).await?,
            None => of_charger(reads, network, charger, &mut awaited).await?,
        };
        if let Some(tour) = found {
            return Ok(tour);
        }
        let ended = |_| Refusal::Unavailable("the service is shutting down".into());
        changes.changed().await.map_err(ended)?;
    }
}

/// A departure's tour, over or not; none where it is not planned yet.
async fn of_departure(
    reads: &Reads,
    network: &NetworkId,
    charger: &ChargerId,
    id: DepartureId,
) -> Result<Option<Tour>, Refusal> {
    let departure = reads.departure(id).await.map_err(unreadable)?.filter(|departure| {
        departure.announced.network_id == *network && departure.announced.charger_id == *charger
    });
    let missing = || Refusal::NotFound { what: "departure", id: id.to_string() };
    let departure = departure.ok_or_else(missing)?;
    if let Some(tour) = reads.tour_of(id).await.map_err(unreadable)? {
        return Ok(Some(tour));
    }
    match ended(&departure) {
        Some(refusal) => Err(refusal),
        None => Ok(None),
    }
}

/// The tour of the charger that is out; none while its next departure is not planned yet.
async fn of_charger(
    reads: &Reads,
    network: &NetworkId,
    charger: &ChargerId,
    awaited: &mut Option<DepartureId>,
) -> Result<Option<Tour>, Refusal> {
    // In this order: what is planned between the two looks is announced in neither.
    let next = reads.next_departure(network, charger).await.map_err(unreadable)?;
    if let Some(tour) = reads.tour_out(network, charger).await.map_err(unreadable)? {
        return Ok(Some(tour));
    }
    if next.is_some() {
        *awaited = next;
        return Ok(None);
    }
    if let Some(id) = awaited.take()
        && let Some(departure) = reads.departure(id).await.map_err(unreadable)?
        && let Some(refusal) = ended(&departure)
    {
        return Err(refusal);
    }
    if reads.network(network).await.map_err(unreadable)?.is_none() {
        return Err(Refusal::NotFound { what: "network", id: network.to_string() });
    }
    let reason = format!("no departure of charger {charger} is announced");
    Err(Refusal::FailedPrecondition(reason))
}

/// Why a departure will have no tour.
fn ended(departure: &Departure) -> Option<Refusal> {
    let how = match departure.state {
        DepartureState::Cancelled => "cancelled",
        DepartureState::Missed => "missed",
        _ => return None,
    };
    let reason = departure.reason.as_deref().filter(|reason| !reason.is_empty());
    let reason = reason.map(|reason| format!(": {reason}")).unwrap_or_default();
    let id = departure.id;
    Some(Refusal::FailedPrecondition(format!("departure {id} was {how}{reason}")))
}

fn unreadable(error: StoreError) -> Refusal {
    tracing::error!(%error, "the database cannot be read");
    Refusal::Unavailable("the database cannot be read now: try again".into())
}
