//! Storing a plan: its stops are planned, the rest of the batch is open again, the tour is out; all of
//! it or nothing, and only if the departure is still closed as it was when the plan was made.

use jiff::Timestamp;
use voltour_solver::gap;
use voltour_solver::plan::Status;

use super::reopen;
use super::step::step;
use crate::domain::{DepartureId, PlanId, RequestId, RequestState, SensorId, TourId};
use crate::store::StoreError;
use crate::store::cells::{Cells, signed};
use crate::store::words::Word;
use crate::store::writer::{Command, Failure, Writing};

/// A plan that holds.
#[derive(Clone, Debug)]
#[allow(missing_docs)]
pub struct NewPlan {
    pub status: Status,
    pub solver: String,
    pub objective: f64,
    pub bound: Option<f64>,
    pub distance_m: f64,
    pub travel_j: f64,
    pub charge_j: f64,
    pub start_m: [f64; 2],
    pub end_m: [f64; 2],
    pub finish: Timestamp,
    pub stops: Vec<NewStop>,
    pub unserved: u32,
    /// The envelope, compressed.
    pub envelope: Vec<u8>,
    /// The scenario, compressed.
    pub scenario: Vec<u8>,
}

impl NewPlan {
    /// How far its tour may be from the best.
    pub fn gap(&self) -> Option<f64> {
        gap::gap(self.status, self.objective, self.bound)
    }
}

/// A stop of it.
#[derive(Clone, Debug)]
#[allow(missing_docs)]
pub struct NewStop {
    pub request_id: RequestId,
    pub sensor_id: SensorId,
    pub position_m: [f64; 2],
    pub arrive: Timestamp,
    pub depart: Timestamp,
    pub charge_j: f64,
}

/// Stores a plan.
#[derive(Debug)]
pub struct StorePlan {
    /// Of this departure.
    pub departure_id: DepartureId,
    /// With this second 0.
    pub start: Timestamp,
    /// The plan.
    pub plan: NewPlan,
}

/// What became of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Storing {
    /// The tour is out.
    Stored(TourId),
    /// Second 0 has passed: the batch must be closed again.
    Late,
    /// The departure was called off meanwhile, or closed again.
    Gone,
}

impl Command for StorePlan {
    type Answer = Storing;

    async fn apply(&self, w: &mut Writing) -> Result<Storing, Failure> {
        let row = sqlx::query(
            "SELECT network_id, charger_id, start_us FROM departures \
             WHERE id = ? AND state = 'closed'",
        );
        let row = row.bind(self.departure_id.to_string()).fetch_optional(&mut w.conn).await?;
        let Some(row) = row else { return Ok(Storing::Gone) };
        let cells = Cells::new("departures", &row);
        if cells.time_or_none("start_us")? != Some(self.start) {
            return Ok(Storing::Gone);
        }
        if w.now > self.start {
            return Ok(Storing::Late);
        }
        let (network, charger) = (cells.get("network_id")?, cells.get("charger_id")?);
        let plan = PlanId(w.id());
        self.plan_row(w, plan, network, charger).await?;
        let tour = TourId(w.id());
        self.tour_row(w, plan, tour, network, charger).await?;
        self.stop_rows(w, tour).await?;
        let stops: Vec<RequestId> = self.plan.stops.iter().map(|stop| stop.request_id).collect();
        let place = Some(("tour_id", tour.to_string()));
        step(w, &stops, RequestState::Batched, RequestState::Planned, place).await?;
        reopen::batched(w, self.departure_id).await?;
        self.planned(w).await?;
        Ok(Storing::Stored(tour))
    }
}

impl StorePlan {
    async fn plan_row(
        &self,
        w: &mut Writing,
        id: PlanId,
        network: &str,
        charger: &str,
    ) -> Result<(), StoreError> {
        let (plan, now_us) = (&self.plan, w.now_us());
        // The only revision: the unique key makes a second plan of the departure impossible.
        sqlx::query(
            "INSERT INTO plans (id, departure_id, revision, network_id, charger_id, status, solver, \
             objective, bound, distance_m, stop_count, unserved_count, start_us, finish_us, \
             envelope, scenario, created_us) \
             VALUES (?, ?, 1, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        )
        .bind(id.to_string())
        .bind(self.departure_id.to_string())
        .bind(network)
        .bind(charger)
        .bind(plan.status.word())
        .bind(plan.solver.as_str())
        .bind(plan.objective)
        .bind(plan.bound)
        .bind(plan.distance_m)
        .bind(signed(plan.stops.len() as u64))
        .bind(plan.unserved)
        .bind(self.start.as_microsecond())
        .bind(plan.finish.as_microsecond())
        .bind(&plan.envelope[..])
        .bind(&plan.scenario[..])
        .bind(now_us)
        .execute(&mut w.conn)
        .await?;
        Ok(())
    }

    async fn tour_row(
        &self,
        w: &mut Writing,
        plan_id: PlanId,
        id: TourId,
        network: &str,
        charger: &str,
    ) -> Result<(), StoreError> {
        let (plan, now_us, change) = (&self.plan, w.now_us(), w.coming_change());
        let done = sqlx::query(
            "INSERT INTO tours (id, plan_id, departure_id, number, network_id, charger_id, state, \
             start_us, finish_us, start_x_m, start_y_m, end_x_m, end_y_m, distance_m, travel_j, \
             charge_j, heard_us, updated_us, change) \
             VALUES (?1, ?2, ?3, 1, ?4, ?5, 'out', ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?7, \
             ?15, ?16)",
        )
        .bind(id.to_string())
        .bind(plan_id.to_string())
        .bind(self.departure_id.to_string())
        .bind(network)
        .bind(charger)
        .bind(self.start.as_microsecond())
        .bind(plan.finish.as_microsecond())
        .bind(plan.start_m[0])
        .bind(plan.start_m[1])
        .bind(plan.end_m[0])
        .bind(plan.end_m[1])
        .bind(plan.distance_m)
        .bind(plan.travel_j)
        .bind(plan.charge_j)
        .bind(now_us)
        .bind(change)
        .execute(&mut w.conn)
        .await?;
        w.took_changes(done.rows_affected());
        w.tours_moved = true;
        Ok(())
    }

    async fn stop_rows(&self, w: &mut Writing, tour: TourId) -> Result<(), StoreError> {
        for (position, stop) in (0i64..).zip(&self.plan.stops) {
            sqlx::query(
                "INSERT INTO stops (tour_id, position, request_id, sensor_id, x_m, y_m, arrive_us, \
                 depart_us, charge_j, out) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, 1)",
            )
            .bind(tour.to_string())
            .bind(position)
            .bind(stop.request_id.to_string())
            .bind(stop.sensor_id.as_str())
            .bind(stop.position_m[0])
            .bind(stop.position_m[1])
            .bind(stop.arrive.as_microsecond())
            .bind(stop.depart.as_microsecond())
            .bind(stop.charge_j)
            .execute(&mut w.conn)
            .await?;
        }
        Ok(())
    }

    async fn planned(&self, w: &mut Writing) -> Result<(), StoreError> {
        let (now_us, change) = (w.now_us(), w.coming_change());
        let done = sqlx::query(
            "UPDATE departures SET state = 'planned', updated_us = ?, change = ? \
             WHERE id = ? AND state = 'closed'",
        )
        .bind(now_us)
        .bind(change)
        .bind(self.departure_id.to_string())
        .execute(&mut w.conn)
        .await?;
        w.took_changes(done.rows_affected());
        Ok(())
    }
}
