//! Reads: each from the pool of read-only connections, never behind the writer.

use jiff::Timestamp;
use serde::Serialize;
use sqlx::sqlite::SqliteRow;
use sqlx::{AssertSqlSafe, QueryBuilder, Sqlite, SqliteConnection, SqlitePool};
use tokio::sync::watch;
use voltour_solver::plan::Status;

use super::cells::{Cells, signed};
use super::page::{DepartureFilter, Listed, Page, PlanFilter, RequestFilter};
use super::rows::{self, departure_columns, request_columns, tour_columns};
use super::words::Word;
use super::{StoreError, Trouble};
use crate::domain::{
    ChargerId, Departure, DepartureId, Network, NetworkId, NetworkScope, PlanId, Request,
    RequestId, Tour, TourId,
};

/// The read half of the store; cheap to clone.
#[derive(Clone, Debug)]
pub struct Reads {
    pool: SqlitePool,
    trouble: watch::Receiver<Option<Trouble>>,
}

/// A plan in a list.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(missing_docs)]
pub struct PlanSummary {
    pub id: PlanId,
    pub departure_id: DepartureId,
    pub revision: u32,
    pub network_id: NetworkId,
    pub charger_id: ChargerId,
    pub status: Status,
    pub solver: String,
    pub objective: f64,
    pub bound: Option<f64>,
    pub gap: Option<f64>,
    pub distance_m: f64,
    pub stops: u32,
    pub unserved: u32,
    pub start: Timestamp,
    pub finish: Timestamp,
    pub created_at: Timestamp,
}

/// A departure that is not planned yet: what the scheduler goes by.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct Waiting {
    pub id: DepartureId,
    pub network_id: NetworkId,
    pub t0: Timestamp,
    pub closes_at: Timestamp,
    /// Its charger has a tour out.
    pub charger_out: bool,
}

type Select = QueryBuilder<Sqlite>;

impl Reads {
    pub(super) fn new(pool: SqlitePool, trouble: watch::Receiver<Option<Trouble>>) -> Self {
        Self { pool, trouble }
    }

    pub(super) fn pool(&self) -> &SqlitePool {
        &self.pool
    }

    pub(super) async fn close(&self) {
        self.pool.close().await;
    }

    /// The present version of a network with its spec; none where there is no such network.
    pub async fn network(&self, id: &NetworkId) -> Result<Option<Network>, StoreError> {
        let row = sqlx::query(
            "SELECT n.id, n.version, n.created_us, n.updated_us, v.sensor_count, v.spec \
             FROM networks n JOIN network_versions v \
             ON v.network_id = n.id AND v.version = n.version WHERE n.id = ?",
        );
        let Some(row) = row.bind(id.as_str()).fetch_optional(&self.pool).await? else {
            return Ok(None);
        };
        let mut network = rows::network(&row)?;
        let spec = Cells::new("network_versions", &row).unpacked("spec")?;
        network.spec = Some(
            serde_json::from_slice(&spec)
                .map_err(|error| StoreError::row("network_versions", error))?,
        );
        Ok(Some(network))
    }

    /// Networks by id, without specs.
    pub async fn networks(
        &self,
        scope: &NetworkScope,
        page: &Page,
    ) -> Result<Listed<Network>, StoreError> {
        let mut select = Select::new(
            "SELECT n.id, n.version, n.created_us, n.updated_us, v.sensor_count \
             FROM networks n JOIN network_versions v \
             ON v.network_id = n.id AND v.version = n.version WHERE 1 = 1",
        );
        within(&mut select, "n.id", scope);
        if let Some(after) = &page.after {
            select.push(" AND n.id > ").push_bind(after.clone());
        }
        select.push(" ORDER BY n.id");
        self.page(select, page, rows::network, |network| network.id.to_string()).await
    }

    /// A request.
    pub async fn request(&self, id: RequestId) -> Result<Option<Request>, StoreError> {
        let mut conn = self.pool.acquire().await?;
        request(&mut conn, id).await
    }

    /// Requests, newest first.
    pub async fn requests(
        &self,
        f: &RequestFilter,
        page: &Page,
    ) -> Result<Listed<Request>, StoreError> {
        let mut select =
            Select::new(concat!("SELECT ", request_columns!(), " FROM requests r WHERE 1 = 1"));
        within(&mut select, "r.network_id", &f.within);
        equal(&mut select, "r.network_id", f.network_id.as_ref());
        equal(&mut select, "r.sensor_id", f.sensor_id.as_ref());
        among(&mut select, "r.state", &f.states);
        newest(&mut select, "r.id", page);
        self.page(select, page, rows::request, |request| request.id.to_string()).await
    }

    /// Requests of a network that changed after `change`, in the order of their change. No two rows
    /// have the same change, so that the last one's is where to go on.
    pub async fn requests_since(
        &self,
        n: &NetworkId,
        change: u64,
        limit: u32,
    ) -> Result<Vec<Request>, StoreError> {
        const SQL: &str = concat!(
            "SELECT ",
            request_columns!(),
            " FROM requests r WHERE r.network_id = ? AND r.change > ? ORDER BY r.change LIMIT ?"
        );
        let rows = sqlx::query(SQL).bind(n.as_str()).bind(signed(change)).bind(limit);
        rows.fetch_all(&self.pool).await?.iter().map(rows::request).collect()
    }

    /// Requests of a network that are open, batched or planned, and the change they were read at.
    pub async fn live_requests(&self, n: &NetworkId) -> Result<(Vec<Request>, u64), StoreError> {
        const SQL: &str = concat!(
            "SELECT ",
            request_columns!(),
            " FROM requests r WHERE r.network_id = ?1 AND r.state = 'open' UNION ALL SELECT ",
            request_columns!(),
            " FROM requests r WHERE r.network_id = ?1 AND r.state IN ('batched', 'planned')"
        );
        let mut tx = self.pool.begin().await?;
        let rows = sqlx::query(SQL).bind(n.as_str()).fetch_all(&mut *tx).await?;
        let change = latest(&mut tx, "requests", n).await?;
        let mut live = rows.iter().map(rows::request).collect::<Result<Vec<_>, _>>()?;
        live.sort_by_key(|request| request.change);
        Ok((live, change))
    }

    /// A departure.
    pub async fn departure(&self, id: DepartureId) -> Result<Option<Departure>, StoreError> {
        let mut conn = self.pool.acquire().await?;
        departure(&mut conn, id).await
    }

    /// Departures, newest first.
    pub async fn departures(
        &self,
        f: &DepartureFilter,
        page: &Page,
    ) -> Result<Listed<Departure>, StoreError> {
        let mut select =
            Select::new(concat!("SELECT ", departure_columns!(), " FROM departures d WHERE 1 = 1"));
        within(&mut select, "d.network_id", &f.within);
        equal(&mut select, "d.network_id", f.network_id.as_ref());
        equal(&mut select, "d.charger_id", f.charger_id.as_ref());
        among(&mut select, "d.state", &f.states);
        newest(&mut select, "d.id", page);
        self.page(select, page, rows::departure, |departure| departure.id.to_string()).await
    }

    /// Departures of a network that changed after `change`, in the order of their change.
    pub async fn departures_since(
        &self,
        n: &NetworkId,
        change: u64,
        limit: u32,
    ) -> Result<Vec<Departure>, StoreError> {
        const SQL: &str = concat!(
            "SELECT ",
            departure_columns!(),
            " FROM departures d WHERE d.network_id = ? AND d.change > ? ORDER BY d.change LIMIT ?"
        );
        let rows = sqlx::query(SQL).bind(n.as_str()).bind(signed(change)).bind(limit);
        rows.fetch_all(&self.pool).await?.iter().map(rows::departure).collect()
    }

    /// Departures that are announced, closed or planned, and the change they were read at.
    pub async fn live_departures(
        &self,
        n: &NetworkId,
    ) -> Result<(Vec<Departure>, u64), StoreError> {
        const SQL: &str = concat!(
            "SELECT ",
            departure_columns!(),
            " FROM departures d WHERE d.network_id = ? \
             AND d.state IN ('announced', 'closed', 'planned') ORDER BY d.change"
        );
        let mut tx = self.pool.begin().await?;
        let rows = sqlx::query(SQL).bind(n.as_str()).fetch_all(&mut *tx).await?;
        let change = latest(&mut tx, "departures", n).await?;
        Ok((rows.iter().map(rows::departure).collect::<Result<_, _>>()?, change))
    }

    /// A tour with its stops.
    pub async fn tour(&self, id: TourId) -> Result<Option<Tour>, StoreError> {
        let mut conn = self.pool.acquire().await?;
        tour(&mut conn, id).await
    }

    /// The tour of a charger that is out.
    pub async fn tour_out(&self, n: &NetworkId, c: &ChargerId) -> Result<Option<Tour>, StoreError> {
        let mut tx = self.pool.begin().await?;
        let out = sqlx::query_scalar::<_, String>(
            "SELECT id FROM tours WHERE network_id = ? AND charger_id = ? AND state = 'out'",
        );
        let out = out.bind(n.as_str()).bind(c.as_str()).fetch_optional(&mut *tx).await?;
        match out.and_then(|id| id.parse().ok()) {
            Some(id) => tour(&mut tx, id).await,
            None => Ok(None),
        }
    }

    /// The tour of a departure, over or not; none before it is planned.
    pub async fn tour_of(&self, departure: DepartureId) -> Result<Option<Tour>, StoreError> {
        let mut tx = self.pool.begin().await?;
        let id = sqlx::query_scalar::<_, String>(
            "SELECT t.id FROM tours t JOIN plans p ON p.id = t.plan_id WHERE t.departure_id = ? \
             ORDER BY p.revision DESC, t.number LIMIT 1",
        );
        let id = id.bind(departure.to_string()).fetch_optional(&mut *tx).await?;
        match id.and_then(|id| id.parse().ok()) {
            Some(id) => tour(&mut tx, id).await,
            None => Ok(None),
        }
    }

    /// Tours of a network that changed after `change`, in the order of their change.
    pub async fn tours_since(
        &self,
        n: &NetworkId,
        change: u64,
        limit: u32,
    ) -> Result<Vec<Tour>, StoreError> {
        const SQL: &str = concat!(
            "SELECT ",
            tour_columns!(),
            " FROM tours t JOIN plans p ON p.id = t.plan_id \
             WHERE t.network_id = ? AND t.change > ? ORDER BY t.change LIMIT ?"
        );
        let mut tx = self.pool.begin().await?;
        let rows = sqlx::query(SQL).bind(n.as_str()).bind(signed(change)).bind(limit);
        let rows = rows.fetch_all(&mut *tx).await?;
        with_stops(&mut tx, &rows).await
    }

    /// Tours that are out, and the change they were read at.
    pub async fn live_tours(&self, n: &NetworkId) -> Result<(Vec<Tour>, u64), StoreError> {
        const SQL: &str = concat!(
            "SELECT ",
            tour_columns!(),
            " FROM tours t JOIN plans p ON p.id = t.plan_id \
             WHERE t.network_id = ? AND t.state = 'out' ORDER BY t.change"
        );
        let mut tx = self.pool.begin().await?;
        let rows = sqlx::query(SQL).bind(n.as_str()).fetch_all(&mut *tx).await?;
        let change = latest(&mut tx, "tours", n).await?;
        Ok((with_stops(&mut tx, &rows).await?, change))
    }

    /// Plans, newest first.
    pub async fn plans(
        &self,
        f: &PlanFilter,
        page: &Page,
    ) -> Result<Listed<PlanSummary>, StoreError> {
        let mut select = Select::new(
            "SELECT p.id, p.departure_id, p.revision, p.network_id, p.charger_id, p.status, \
             p.solver, p.objective, p.bound, p.distance_m, p.stop_count, p.unserved_count, \
             p.start_us, p.finish_us, p.created_us FROM plans p WHERE 1 = 1",
        );
        within(&mut select, "p.network_id", &f.within);
        equal(&mut select, "p.network_id", f.network_id.as_ref());
        equal(&mut select, "p.charger_id", f.charger_id.as_ref());
        equal(&mut select, "p.status", f.status.as_ref());
        equal(&mut select, "p.solver", f.solver.as_ref());
        if let Some(from) = f.from {
            select.push(" AND p.created_us >= ").push_bind(from.as_microsecond());
        }
        if let Some(until) = f.until {
            select.push(" AND p.created_us < ").push_bind(until.as_microsecond());
        }
        newest(&mut select, "p.id", page);
        self.page(select, page, rows::plan, |plan| plan.id.to_string()).await
    }

    /// The network of a plan; none where there is no such plan.
    pub async fn plan_network(&self, id: PlanId) -> Result<Option<NetworkId>, StoreError> {
        let row = sqlx::query("SELECT network_id FROM plans WHERE id = ?").bind(id.to_string());
        let row = row.fetch_optional(&self.pool).await?;
        row.map(|row| Cells::new("plans", &row).parsed("network_id")).transpose()
    }

    /// The envelope `{plan, provenance}` of a plan, as JSON text.
    pub async fn plan_envelope(&self, id: PlanId) -> Result<Option<Vec<u8>>, StoreError> {
        self.document(id, "SELECT envelope AS document FROM plans WHERE id = ?").await
    }

    /// The scenario of a plan, as JSON text.
    pub async fn plan_scenario(&self, id: PlanId) -> Result<Option<Vec<u8>>, StoreError> {
        self.document(id, "SELECT scenario AS document FROM plans WHERE id = ?").await
    }

    /// Whether the database answers: for readiness.
    pub async fn ping(&self) -> Result<(), StoreError> {
        sqlx::query("SELECT 1").execute(&self.pool).await?;
        Ok(())
    }

    /// Why nothing can be written now, if that is so. What is stored can be read all the same, but for a
    /// damaged database.
    pub fn trouble(&self) -> watch::Receiver<Option<Trouble>> {
        self.trouble.clone()
    }

    /// The departures that are not planned yet, a network's in the order of (t0, id).
    pub async fn waiting(&self) -> Result<Vec<Waiting>, StoreError> {
        let rows = sqlx::query(
            "SELECT d.id, d.network_id, d.t0_us, d.close_us, EXISTS (SELECT 1 FROM tours t \
             WHERE t.network_id = d.network_id AND t.charger_id = d.charger_id \
             AND t.state = 'out') AS charger_out \
             FROM departures d WHERE d.state IN ('announced', 'closed') \
             ORDER BY d.network_id, d.t0_us, d.id",
        );
        rows.fetch_all(&self.pool).await?.iter().map(waiting).collect()
    }

    /// The next departure of a charger that is not planned yet.
    pub async fn next_departure(
        &self,
        n: &NetworkId,
        c: &ChargerId,
    ) -> Result<Option<DepartureId>, StoreError> {
        let id = sqlx::query_scalar::<_, String>(
            "SELECT id FROM departures WHERE network_id = ? AND charger_id = ? \
             AND state IN ('announced', 'closed') ORDER BY t0_us, id LIMIT 1",
        );
        let id = id.bind(n.as_str()).bind(c.as_str()).fetch_optional(&self.pool).await?;
        id.map(|id| id.parse().map_err(|error| StoreError::row("departures", error))).transpose()
    }

    /// The tour that is out of which nothing was heard for longest, and since when (or its planned
    /// finish, if that is later).
    pub async fn longest_unheard(&self) -> Result<Option<(TourId, Timestamp)>, StoreError> {
        let row = sqlx::query(
            "SELECT id, heard_us FROM tours WHERE state = 'out' ORDER BY heard_us LIMIT 1",
        );
        let Some(row) = row.fetch_optional(&self.pool).await? else { return Ok(None) };
        let cells = Cells::new("tours", &row);
        Ok(Some((cells.parsed("id")?, cells.time("heard_us")?)))
    }

    async fn document(&self, id: PlanId, sql: &'static str) -> Result<Option<Vec<u8>>, StoreError> {
        let row = sqlx::query(sql).bind(id.to_string()).fetch_optional(&self.pool).await?;
        row.map(|row| Cells::new("plans", &row).unpacked("document")).transpose()
    }

    async fn page<T>(
        &self,
        mut select: Select,
        page: &Page,
        read: fn(&SqliteRow) -> Result<T, StoreError>,
        key: fn(&T) -> String,
    ) -> Result<Listed<T>, StoreError> {
        let limit = page.limit.clamp(1, Page::LARGEST);
        // One more than asked tells whether there is a next page.
        select.push(" LIMIT ").push_bind(limit + 1);
        let rows = select.build().fetch_all(&self.pool).await?;
        let mut items = rows.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        let more = items.len() > limit as usize;
        items.truncate(limit as usize);
        let next = items.last().filter(|_| more).map(key);
        Ok(Listed { items, next })
    }
}

fn equal(select: &mut Select, column: &str, value: Option<&impl ToString>) {
    if let Some(value) = value {
        select.push(" AND ").push(column).push(" = ").push_bind(value.to_string());
    }
}

fn within(select: &mut Select, column: &str, scope: &NetworkScope) {
    let NetworkScope::Only(ids) = scope else { return };
    select.push(" AND ").push(column).push(" IN (");
    let mut list = select.separated(", ");
    for id in ids {
        list.push_bind(id.to_string());
    }
    select.push(")");
}

fn among<W: Word + PartialEq>(select: &mut Select, column: &str, states: &[W]) {
    if states.is_empty() {
        return;
    }
    select.push(" AND ").push(column).push(" IN (");
    let mut list = select.separated(", ");
    // A list may be long and repetitive; there are only so many states.
    for (_, word) in W::ALL.iter().filter(|(state, _)| states.contains(state)) {
        list.push_bind(*word);
    }
    select.push(")");
}

fn newest(select: &mut Select, id: &str, page: &Page) {
    if let Some(after) = &page.after {
        select.push(" AND ").push(id).push(" < ").push_bind(after.clone());
    }
    select.push(" ORDER BY ").push(id).push(" DESC");
}

fn waiting(row: &SqliteRow) -> Result<Waiting, StoreError> {
    let cells = Cells::new("departures", row);
    Ok(Waiting {
        id: cells.parsed("id")?,
        network_id: cells.parsed("network_id")?,
        t0: cells.time("t0_us")?,
        closes_at: cells.time("close_us")?,
        charger_out: cells.get("charger_out")?,
    })
}

/// The last change of a network's rows in a table.
async fn latest(
    conn: &mut SqliteConnection,
    table: &'static str,
    network: &NetworkId,
) -> Result<u64, StoreError> {
    let sql = format!("SELECT coalesce(max(change), 0) FROM {table} WHERE network_id = ?");
    let latest = sqlx::query_scalar::<_, i64>(AssertSqlSafe(sql)).bind(network.as_str());
    Ok(latest.fetch_one(conn).await?.unsigned_abs())
}

pub(super) async fn request(
    conn: &mut SqliteConnection,
    id: RequestId,
) -> Result<Option<Request>, StoreError> {
    const SQL: &str = concat!("SELECT ", request_columns!(), " FROM requests r WHERE r.id = ?");
    let row = sqlx::query(SQL).bind(id.to_string()).fetch_optional(conn).await?;
    row.as_ref().map(rows::request).transpose()
}

pub(super) async fn departure(
    conn: &mut SqliteConnection,
    id: DepartureId,
) -> Result<Option<Departure>, StoreError> {
    const SQL: &str = concat!("SELECT ", departure_columns!(), " FROM departures d WHERE d.id = ?");
    let row = sqlx::query(SQL).bind(id.to_string()).fetch_optional(conn).await?;
    row.as_ref().map(rows::departure).transpose()
}

/// A tour with its stops; within a transaction, for it takes two queries.
pub(super) async fn tour(
    conn: &mut SqliteConnection,
    id: TourId,
) -> Result<Option<Tour>, StoreError> {
    const SQL: &str = concat!(
        "SELECT ",
        tour_columns!(),
        " FROM tours t JOIN plans p ON p.id = t.plan_id WHERE t.id = ?"
    );
    let row = sqlx::query(SQL).bind(id.to_string()).fetch_optional(&mut *conn).await?;
    Ok(with_stops(conn, row.as_slice()).await?.pop())
}

async fn with_stops(
    conn: &mut SqliteConnection,
    rows: &[SqliteRow],
) -> Result<Vec<Tour>, StoreError> {
    let mut tours = Vec::with_capacity(rows.len());
    for row in rows {
        let mut tour = rows::tour(row)?;
        let stops = sqlx::query("SELECT * FROM stops WHERE tour_id = ? ORDER BY position");
        let stops = stops.bind(tour.id.to_string()).fetch_all(&mut *conn).await?;
        tour.stops = stops.iter().map(rows::stop).collect::<Result<_, _>>()?;
        tours.push(tour);
    }
    Ok(tours)
}
