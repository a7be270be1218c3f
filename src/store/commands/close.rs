//! Closing a batch: which requests a departure plans, frozen from now on. A departure that was closed
//! and not planned in time is closed again: the same batch, with a later second 0.

use std::collections::{HashMap, HashSet};
use std::time::Duration;

use jiff::Timestamp;

use super::step::step;
use super::{ending, put};
use crate::clock::{plus, seconds};
use crate::domain::rules::KnownNetwork;
use crate::domain::{
    ChargerType, Departure, DepartureId, DepartureState, Request, RequestId, RequestState,
    SensorId, TimedPoint,
};
use crate::store::cells::{Cells, signed};
use crate::store::rows::{self, request_columns};
use crate::store::writer::{Command, Failure, Writing};
use crate::store::{StoreError, networks, read};

/// Closes a departure's batch, or closes it again.
#[derive(Debug)]
pub struct CloseBatch {
    /// The departure.
    pub departure_id: DepartureId,
    /// From now to second 0 at the earliest.
    pub lead: Duration,
    /// From t0 to second 0 at the latest.
    pub max_late: Duration,
}

/// What became of it.
#[derive(Debug)]
pub enum Closing {
    /// To be planned.
    Closed(Box<Batch>),
    /// It can start in time no more, or its charger type is gone; its requests stay open.
    Missed,
    /// Its charger has a tour out; it waits for the end of that.
    ChargerOut,
    /// It is over, or planned already.
    Gone,
}

/// All that a plan is made from.
#[derive(Clone, Debug)]
pub struct Batch {
    /// The departure, closed.
    pub departure: Departure,
    /// Second 0.
    pub start: Timestamp,
    /// The version of the network that is planned on.
    pub network: KnownNetwork,
    /// The charger's type there.
    pub kind: ChargerType,
    /// The requests, by id.
    pub requests: Vec<Request>,
    /// Sensors taken for dead.
    pub dead: HashSet<SensorId>,
    /// Trajectories in place of what is registered.
    pub paths: HashMap<SensorId, Vec<TimedPoint>>,
}

impl CloseBatch {
    async fn missed(&self, w: &mut Writing, reason: &str) -> Result<Closing, Failure> {
        let (id, missed) = (self.departure_id, DepartureState::Missed);
        ending::of_departure(w, id, missed, Some(reason)).await?;
        Ok(Closing::Missed)
    }

    /// The version that it was closed on, or else the present one.
    async fn network(
        &self,
        w: &mut Writing,
        departure: &Departure,
    ) -> Result<KnownNetwork, Failure> {
        let present = w.network(&departure.announced.network_id).await?;
        put::version(w, &present, departure.network_version.unwrap_or(present.version)).await
    }

    async fn close(
        &self,
        w: &mut Writing,
        start: Timestamp,
        network: &KnownNetwork,
        batch: usize,
    ) -> Result<(), Failure> {
        let (now_us, change) = (w.now_us(), w.coming_change());
        let done = sqlx::query(
            "UPDATE departures SET state = 'closed', close_us = ?1, start_us = ?2, \
             network_version = ?3, batch_size = ?4, updated_us = ?1, change = ?5 \
             WHERE id = ?6 AND state IN ('announced', 'closed')",
        )
        .bind(now_us)
        .bind(start.as_microsecond())
        .bind(signed(network.version))
        .bind(signed(batch as u64))
        .bind(change)
        .bind(self.departure_id.to_string())
        .execute(&mut w.conn)
        .await?;
        w.took_changes(done.rows_affected());
        w.networks.closed(&network.id);
        w.tours_moved = true;
        Ok(())
    }
}

impl Command for CloseBatch {
    type Answer = Closing;

    async fn apply(&self, w: &mut Writing) -> Result<Closing, Failure> {
        let departure = read::departure(&mut w.conn, self.departure_id).await?;
        let Some(departure) = departure else { return Ok(Closing::Gone) };
        let again = match departure.state {
            DepartureState::Announced => false,
            DepartureState::Closed => true,
            _ => return Ok(Closing::Gone),
        };
        let start = departure.t0.max(plus(w.now, self.lead));
        if start > plus(departure.t0, self.max_late) {
            let late = seconds(departure.t0, start);
            return self.missed(w, &format!("it would start {late:.0} s late")).await;
        }
        if charger_out(w, &departure).await? {
            return Ok(Closing::ChargerOut);
        }
        let network = self.network(w, &departure).await?;
        let kind = network.charger_type(departure.announced.charger_type.as_deref()).cloned();
        let Some(kind) = kind else {
            return self.missed(w, "its charger type is no more in the network").await;
        };
        let candidates = match again {
            true => frozen(w, &departure).await?,
            false => {
                unexpire(w, &network, start).await?;
                open(w, &network).await?
            }
        };
        let late = |request: &Request| request.asked.deadline.is_some_and(|at| at < start);
        let (expired, requests): (Vec<_>, Vec<_>) = candidates.into_iter().partition(late);
        expire(w, &expired).await?;
        if !again {
            let ids: Vec<RequestId> = requests.iter().map(|request| request.id).collect();
            let place = Some(("departure_id", self.departure_id.to_string()));
            step(w, &ids, RequestState::Open, RequestState::Batched, place).await?;
        }
        self.close(w, start, &network, requests.len()).await?;
        let dead = networks::dead(&mut w.conn, &network.id).await?;
        let paths = paths(w, &network).await?;
        let departure = read::departure(&mut w.conn, self.departure_id).await?;
        let Some(departure) = departure else { return Ok(Closing::Gone) };
        let batch = Batch { departure, start, network, kind, requests, dead, paths };
        Ok(Closing::Closed(Box::new(batch)))
    }
}

async fn charger_out(w: &mut Writing, departure: &Departure) -> Result<bool, StoreError> {
    let out = sqlx::query_scalar::<_, i64>(
        "SELECT count(*) FROM tours WHERE network_id = ? AND charger_id = ? AND state = 'out'",
    );
    let out = out.bind(departure.announced.network_id.as_str());
    let out = out.bind(departure.announced.charger_id.as_str());
    Ok(out.fetch_one(&mut w.conn).await? > 0)
}

/// The batch that was frozen before.
async fn frozen(w: &mut Writing, departure: &Departure) -> Result<Vec<Request>, StoreError> {
    const SQL: &str = concat!(
        "SELECT ",
        request_columns!(),
        " FROM requests r WHERE r.departure_id = ? AND r.state = 'batched' ORDER BY r.id"
    );
    let rows = sqlx::query(SQL).bind(departure.id.to_string()).fetch_all(&mut w.conn).await?;
    rows.iter().map(rows::request).collect()
}

/// The open requests of a network, but those of sensors that another tour holds already, and those of
/// sensors that the present version has no more: they wait.
async fn open(w: &mut Writing, network: &KnownNetwork) -> Result<Vec<Request>, StoreError> {
    const SQL: &str = concat!(
        "SELECT ",
        request_columns!(),
        " FROM requests r WHERE r.network_id = ? AND r.state = 'open' AND NOT EXISTS (\
         SELECT 1 FROM requests h WHERE h.network_id = r.network_id \
         AND h.sensor_id = r.sensor_id AND h.state IN ('batched', 'planned')) ORDER BY r.id"
    );
    let rows = sqlx::query(SQL).bind(network.id.as_str()).fetch_all(&mut w.conn).await?;
    let requests = rows.iter().map(rows::request);
    let known = |request: &Result<Request, StoreError>| match request {
        Ok(request) => network.sensor(&request.asked.sensor_id).is_some(),
        Err(_) => true,
    };
    requests.filter(known).collect()
}

/// Opens what expired at a time that is still to come: the clock was set forward then, and back since. Only the
/// last request of a sensor, for which nothing was done since, is meant: that is the one that it died of.
async fn unexpire(
    w: &mut Writing,
    network: &KnownNetwork,
    start: Timestamp,
) -> Result<(), StoreError> {
    let rows = sqlx::query(
        "SELECT d.sensor_id, d.request_id FROM dead_sensors d JOIN requests r ON r.id = d.request_id \
         WHERE d.network_id = ? AND d.since_us > ? AND r.state = 'expired' AND r.deadline_us >= ? \
         AND NOT EXISTS (SELECT 1 FROM requests o WHERE o.network_id = d.network_id \
         AND o.sensor_id = d.sensor_id AND o.state = 'open') ORDER BY r.id",
    );
    let rows = rows.bind(network.id.as_str()).bind(w.now_us()).bind(start.as_microsecond());
    for row in rows.fetch_all(&mut w.conn).await? {
        let cells = Cells::new("dead_sensors", &row);
        let (id, sensor): (RequestId, SensorId) =
            (cells.parsed("request_id")?, cells.parsed("sensor_id")?);
        tracing::warn!(request = %id, "expired by a clock that was ahead: open again");
        step(w, &[id], RequestState::Expired, RequestState::Open, None).await?;
        sqlx::query("DELETE FROM dead_sensors WHERE network_id = ? AND sensor_id = ?")
            .bind(network.id.as_str())
            .bind(sensor.as_str())
            .execute(&mut w.conn)
            .await?;
        w.networks.revived(&network.id, &sensor);
    }
    Ok(())
}

/// Ends requests whose deadline is before second 0; their sensors are taken for dead, unless a newer
/// request is open.
async fn expire(w: &mut Writing, expired: &[Request]) -> Result<(), StoreError> {
    for request in expired {
        let end = match request.withdrawal_pending {
            true => RequestState::Withdrawn,
            false => RequestState::Expired,
        };
        step(w, &[request.id], request.state, end, None).await?;
        let (network, sensor) = (&request.asked.network_id, &request.asked.sensor_id);
        let now_us = w.now_us();
        let died = sqlx::query(
            "INSERT INTO dead_sensors (network_id, sensor_id, request_id, since_us) \
             SELECT ?1, ?2, ?3, ?4 WHERE NOT EXISTS (SELECT 1 FROM requests \
             WHERE network_id = ?1 AND sensor_id = ?2 AND state = 'open') ON CONFLICT DO NOTHING",
        )
        .bind(network.as_str())
        .bind(sensor.as_str())
        .bind(request.id.to_string())
        .bind(now_us);
        if end == RequestState::Expired && died.execute(&mut w.conn).await?.rows_affected() > 0 {
            w.networks.died(network, sensor);
        }
    }
    Ok(())
}

async fn paths(
    w: &mut Writing,
    network: &KnownNetwork,
) -> Result<HashMap<SensorId, Vec<TimedPoint>>, StoreError> {
    let rows = sqlx::query("SELECT sensor_id, waypoints FROM trajectories WHERE network_id = ?");
    let rows = rows.bind(network.id.as_str()).fetch_all(&mut w.conn).await?;
    let path = |row| {
        let cells = Cells::new("trajectories", row);
        Ok((cells.parsed("sensor_id")?, cells.json("waypoints")?))
    };
    rows.iter().map(path).collect()
}
