//! `ReportVisit`: what became of a stop. Always stored; `charged` serves what it can serve.

use jiff::Timestamp;
use sqlx::Row;

use super::remembered::same;
use crate::domain::{
    Call, Fingerprint, NewVisit, Outcome, Refusal, RequestId, Tour, Visit, VisitId, rules,
};
use crate::store::cells::{micros, text};
use crate::store::words::Word;
use crate::store::writer::{Command, Failure, Writing};
use crate::store::{StoreError, read, rows};

/// A report.
#[derive(Debug)]
pub struct ReportVisit(pub Call<NewVisit>);

impl ReportVisit {
    async fn before(
        &self,
        w: &mut Writing,
        fingerprint: Fingerprint,
    ) -> Result<Option<Visit>, Failure> {
        let Call { client_id, content } = &self.0;
        let row = sqlx::query("SELECT * FROM visits WHERE tour_id = ? AND client_id = ?");
        let row = row.bind(content.tour_id.to_string()).bind(client_id.as_str());
        let Some(row) = row.fetch_optional(&mut w.conn).await? else { return Ok(None) };
        same(row.try_get("fingerprint")?, fingerprint, client_id)?;
        Ok(Some(rows::visit(&row)?))
    }

    /// The report concerns a sensor of the network, or a stop of the tour if the network has dropped
    /// it since.
    async fn judge(&self, w: &mut Writing, tour: &Tour) -> Result<(), Failure> {
        let reported = &self.0.content;
        rules::visit(reported)?;
        let network = w.network(&tour.network_id).await?;
        let stop = tour.stops.iter().any(|stop| stop.sensor_id == reported.sensor_id);
        if !stop && network.sensor(&reported.sensor_id).is_none() {
            let rule = format!("{:?}: no sensor of the network", reported.sensor_id.as_str());
            return Err(Refusal::invalid("sensor_id", rule).into());
        }
        Ok(())
    }

    /// The requests that a charge serves: the stop of its tour, while that is out; what that tour had
    /// as a stop and is open again; and what was open before the charger left the sensor.
    async fn serve(&self, w: &mut Writing, tour: &Tour) -> Result<Vec<RequestId>, Failure> {
        let reported = &self.0.content;
        let at = reported.departed_at.or(reported.arrived_at).unwrap_or(w.now);
        let found = sqlx::query_scalar::<_, String>(
            "SELECT id FROM requests WHERE network_id = ?1 AND sensor_id = ?2 AND state = 'planned' \
             AND tour_id = ?3 UNION ALL \
             SELECT id FROM requests WHERE network_id = ?1 AND sensor_id = ?2 AND state = 'open' \
             AND (tour_id = ?3 OR received_us <= ?4) ORDER BY id",
        )
        .bind(tour.network_id.as_str())
        .bind(reported.sensor_id.as_str())
        .bind(tour.id.to_string())
        .bind(at.as_microsecond())
        .fetch_all(&mut w.conn)
        .await?;
        let mut served = Vec::with_capacity(found.len());
        for id in found {
            let (now_us, change) = (w.now_us(), w.coming_change());
            // `tour_id` becomes that of the tour that served it; a stop's is that already.
            let done = sqlx::query(
                "UPDATE requests SET state = 'served', tour_id = ?, updated_us = ?, change = ? \
                 WHERE id = ? AND state IN ('planned', 'open')",
            )
            .bind(tour.id.to_string())
            .bind(now_us)
            .bind(change)
            .bind(id.as_str())
            .execute(&mut w.conn)
            .await?;
            w.took_changes(done.rows_affected());
            served.push(id.parse().map_err(|error| StoreError::row("requests", error))?);
        }
        w.revive(&tour.network_id, &reported.sensor_id).await?;
        Ok(served)
    }

    async fn note_on_tour(&self, w: &mut Writing, tour: &Tour) -> Result<(), Failure> {
        let (now_us, change) = (w.now_us(), w.coming_change());
        sqlx::query("UPDATE stops SET outcome = ? WHERE tour_id = ? AND sensor_id = ?")
            .bind(self.0.content.outcome.word())
            .bind(tour.id.to_string())
            .bind(self.0.content.sensor_id.as_str())
            .execute(&mut w.conn)
            .await?;
        let done = sqlx::query(
            "UPDATE tours SET heard_us = CASE WHEN heard_us < ?1 THEN ?1 ELSE heard_us END, \
             updated_us = ?1, change = ?2 WHERE id = ?3",
        )
        .bind(now_us)
        .bind(change)
        .bind(tour.id.to_string())
        .execute(&mut w.conn)
        .await?;
        w.took_changes(done.rows_affected());
        w.tours_moved = true;
        Ok(())
    }

    async fn store(
        &self,
        w: &mut Writing,
        fingerprint: Fingerprint,
        visit: &Visit,
    ) -> Result<(), Failure> {
        let reported = &visit.reported;
        sqlx::query(
            "INSERT INTO visits (id, tour_id, client_id, fingerprint, sensor_id, outcome, \
             arrived_us, departed_us, charge_j, note, served, received_us) \
             VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        )
        .bind(visit.id.to_string())
        .bind(reported.tour_id.to_string())
        .bind(visit.client_id.as_str())
        .bind(&fingerprint.0[..])
        .bind(reported.sensor_id.as_str())
        .bind(reported.outcome.word())
        .bind(micros(reported.arrived_at))
        .bind(micros(reported.departed_at))
        .bind(reported.charge_j)
        .bind(reported.note.clone())
        .bind(text(&visit.served))
        .bind(visit.received_at.as_microsecond())
        .execute(&mut w.conn)
        .await?;
        Ok(())
    }
}

impl Command for ReportVisit {
    type Answer = Visit;

    async fn apply(&self, w: &mut Writing) -> Result<Visit, Failure> {
        let Call { client_id, content } = &self.0;
        let fingerprint = self.0.fingerprint();
        if let Some(before) = self.before(w, fingerprint).await? {
            return Ok(before);
        }
        let missing = || Refusal::NotFound { what: "tour", id: content.tour_id.to_string() };
        let tour = read::tour(&mut w.conn, content.tour_id).await?.ok_or_else(missing)?;
        self.judge(w, &tour).await?;
        let served = match content.outcome {
            Outcome::Charged => self.serve(w, &tour).await?,
            Outcome::Skipped | Outcome::Failed => Vec::new(),
        };
        self.note_on_tour(w, &tour).await?;
        let whole = |time: Option<Timestamp>| time.map(crate::clock::whole);
        let visit = Visit {
            id: VisitId(w.id()),
            client_id: client_id.clone(),
            reported: NewVisit {
                arrived_at: whole(content.arrived_at),
                departed_at: whole(content.departed_at),
                ..content.clone()
            },
            received_at: w.now,
            served,
        };
        self.store(w, fingerprint, &visit).await?;
        Ok(visit)
    }
}
