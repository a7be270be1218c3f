//! `Announce`: a charger leaves at t0; its batch closes a lead time before.

use std::time::Duration;

use super::remembered::{Remembered, same};
use crate::clock::{minus, plus};
use crate::domain::{Announcement, Call, Departure, DepartureId, Fingerprint, Refusal, rules};
use crate::store::cells::{Cells, text};
use crate::store::read;
use crate::store::writer::{Command, Failure, Writing};

/// What a call is remembered as.
pub(super) const ANNOUNCE: &str = "announce";

/// A departure to announce.
#[derive(Debug)]
pub struct Announce {
    /// What is announced.
    pub call: Call<Announcement>,
    /// From the close of the batch to second 0.
    pub lead: Duration,
    /// Departures of a network that may wait for their plan.
    pub most: u32,
}

impl Announce {
    async fn before(
        &self,
        w: &mut Writing,
        fingerprint: Fingerprint,
    ) -> Result<Option<Departure>, Failure> {
        let Call { client_id, content } = &self.call;
        let row = sqlx::query(
            "SELECT id, fingerprint FROM departures WHERE network_id = ? AND client_id = ?",
        );
        let row = row.bind(content.network_id.as_str()).bind(client_id.as_str());
        let Some(row) = row.fetch_optional(&mut w.conn).await? else {
            let network = &content.network_id;
            return Remembered::with(ANNOUNCE, network, client_id, fingerprint).find(w).await;
        };
        let cells = Cells::new("departures", &row);
        same(cells.get("fingerprint")?, fingerprint, client_id)?;
        Ok(read::departure(&mut w.conn, cells.parsed("id")?).await?)
    }
}

impl Command for Announce {
    type Answer = Departure;

    async fn apply(&self, w: &mut Writing) -> Result<Departure, Failure> {
        let Call { client_id, content } = &self.call;
        let fingerprint = self.call.fingerprint();
        if let Some(before) = self.before(w, fingerprint).await? {
            return Ok(before);
        }
        let network = w.network(&content.network_id).await?;
        let announced = rules::announcement(&network, content, w.now)?;
        let waiting = sqlx::query_scalar::<_, i64>(
            "SELECT count(*) FROM departures \
             WHERE network_id = ? AND state IN ('announced', 'closed')",
        );
        if waiting.bind(network.id.as_str()).fetch_one(&mut w.conn).await? >= i64::from(self.most) {
            let most = self.most;
            let reason = format!("{most} departures of the network wait for their plan already");
            return Err(Refusal::exhausted("limits.departures", reason).into());
        }
        let id = DepartureId(w.id());
        let t0 = announced.t0.unwrap_or_else(|| plus(w.now, self.lead));
        let (now_us, change) = (w.now_us(), w.coming_change());
        let done = sqlx::query(
            "INSERT INTO departures (id, network_id, charger_id, charger_type, client_id, \
             fingerprint, announced, state, t0_us, close_us, announced_us, updated_us, change) \
             VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, 'announced', ?8, ?9, ?10, ?10, ?11)",
        )
        .bind(id.to_string())
        .bind(announced.network_id.as_str())
        .bind(announced.charger_id.as_str())
        .bind(announced.charger_type.clone())
        .bind(client_id.as_str())
        .bind(&fingerprint.0[..])
        .bind(text(&announced))
        .bind(t0.as_microsecond())
        .bind(minus(t0, self.lead).max(w.now).as_microsecond())
        .bind(now_us)
        .bind(change)
        .execute(&mut w.conn)
        .await?;
        w.took_changes(done.rows_affected());
        w.tours_moved = true;
        let missing = || Refusal::NotFound { what: "departure", id: id.to_string() };
        Ok(read::departure(&mut w.conn, id).await?.ok_or_else(missing)?)
    }
}
