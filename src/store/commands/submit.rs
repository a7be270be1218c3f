//! `Submit`: stores a request. Where nothing stands in its way it is one statement; the unique indices
//! tell where something does.

use sqlx::Row;

use super::remembered::{Remembered, same};
use crate::clock::whole;
use crate::domain::{Call, Fingerprint, NewRequest, Request, RequestId, RequestState, rules};
use crate::store::StoreError;
use crate::store::cells::{micros, text};
use crate::store::rows::{self, request_columns};
use crate::store::writer::{Command, Failure, Writing};

/// What a call is remembered as.
pub(super) const SUBMIT: &str = "submit";

/// A request to store.
#[derive(Debug)]
pub struct Submit {
    call: Call<NewRequest>,
    fingerprint: Fingerprint,
}

impl Submit {
    /// A request to store.
    pub fn new(call: Call<NewRequest>) -> Self {
        Self { fingerprint: call.fingerprint(), call }
    }

    /// The request that the same call made before.
    async fn before(&self, w: &mut Writing) -> Result<Option<Request>, Failure> {
        const SQL: &str = concat!(
            "SELECT r.fingerprint, ",
            request_columns!(),
            " FROM requests r WHERE r.network_id = ? AND r.client_id = ?"
        );
        let client_id = &self.call.client_id;
        let row = sqlx::query(SQL).bind(self.call.content.network_id.as_str());
        let row = row.bind(client_id.as_str()).fetch_optional(&mut w.conn).await?;
        let Some(row) = row else { return self.forgotten().find(w).await };
        same(row.try_get("fingerprint")?, self.fingerprint, client_id)?;
        Ok(Some(rows::request(&row)?))
    }

    /// The call as it is remembered once its request is deleted.
    fn forgotten(&self) -> Remembered<'_> {
        let Call { client_id, content } = &self.call;
        Remembered::with(SUBMIT, &content.network_id, client_id, self.fingerprint)
    }

    /// Stores it unless something stands in its way; whether it did.
    async fn insert(&self, w: &mut Writing, request: &mut Request) -> Result<bool, Failure> {
        let change = w.coming_change();
        request.change = change.unsigned_abs();
        let asked = &request.asked;
        let insert = sqlx::query(
            "INSERT INTO requests (id, network_id, sensor_id, client_id, fingerprint, state, place, \
             deadline_us, ready_us, residual_j, measured_us, drain_w, reward, required, \
             received_us, updated_us, change) \
             SELECT ?1, ?2, ?3, ?4, ?5, 'open', ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16 \
             WHERE NOT EXISTS (SELECT 1 FROM calls WHERE scope = 'submit:' || ?2 AND client_id = ?4) \
             ON CONFLICT DO NOTHING",
        )
        .bind(request.id.to_string())
        .bind(asked.network_id.as_str())
        .bind(asked.sensor_id.as_str())
        .bind(request.client_id.as_str())
        .bind(&self.fingerprint.0[..])
        .bind(asked.place.as_ref().map(text))
        .bind(micros(asked.deadline))
        .bind(micros(asked.ready))
        .bind(asked.residual_j)
        .bind(micros(asked.measured_at))
        .bind(asked.drain_w)
        .bind(asked.reward)
        .bind(asked.required)
        .bind(request.received_at.as_microsecond())
        .bind(request.updated_at.as_microsecond())
        .bind(change);
        let rows = insert.execute(&mut w.conn).await?.rows_affected();
        w.took_changes(rows);
        Ok(rows == 1)
    }

    /// A newer request takes the place of an open one; not so a call that came before.
    async fn supersede(&self, w: &mut Writing) -> Result<(), Failure> {
        let asked = &self.call.content;
        let (now_us, change) = (w.now_us(), w.coming_change());
        let done = sqlx::query(
            "UPDATE requests SET state = 'superseded', updated_us = ?1, change = ?2 \
             WHERE network_id = ?3 AND sensor_id = ?4 AND state = 'open' AND NOT EXISTS \
             (SELECT 1 FROM requests c WHERE c.network_id = ?3 AND c.client_id = ?5) AND NOT EXISTS \
             (SELECT 1 FROM calls WHERE scope = 'submit:' || ?3 AND client_id = ?5)",
        )
        .bind(now_us)
        .bind(change)
        .bind(asked.network_id.as_str())
        .bind(asked.sensor_id.as_str())
        .bind(self.call.client_id.as_str())
        .execute(&mut w.conn)
        .await?;
        w.took_changes(done.rows_affected());
        Ok(())
    }

    fn request(&self, w: &mut Writing) -> Request {
        let asked = &self.call.content;
        Request {
            id: RequestId(w.id()),
            state: RequestState::Open,
            client_id: self.call.client_id.clone(),
            // As it will be read: the database keeps whole microseconds.
            asked: NewRequest {
                deadline: asked.deadline.map(whole),
                ready: asked.ready.map(whole),
                measured_at: asked.measured_at.map(whole),
                ..asked.clone()
            },
            received_at: w.now,
            updated_at: w.now,
            departure_id: None,
            tour_id: None,
            withdrawal_pending: false,
            change: 0,
        }
    }
}

impl Command for Submit {
    type Answer = Request;

    async fn apply(&self, w: &mut Writing) -> Result<Request, Failure> {
        let asked = &self.call.content;
        let network = w.network(&asked.network_id).await?;
        if let Err(refusal) = rules::request(&network, asked, w.now) {
            // What was taken once is answered the same again, whatever the rules say by now.
            let before = self.before(w).await?.ok_or(Failure::Refused(refusal))?;
            w.tally.duplicates += 1;
            return Ok(before);
        }
        let mut request = self.request(w);
        if w.networks.perhaps_open(&asked.network_id, &asked.sensor_id) {
            self.supersede(w).await?;
        }
        if !self.insert(w, &mut request).await? {
            if let Some(before) = self.before(w).await? {
                w.tally.duplicates += 1;
                return Ok(before);
            }
            self.supersede(w).await?;
            if !self.insert(w, &mut request).await? {
                // A defect, and something may be written already: all is rolled back.
                let reason = "something stands in the way of a newer request";
                return Err(StoreError::row("requests", reason).into());
            }
        }
        w.tally.accepted += 1;
        w.networks.opened(&asked.network_id, &asked.sensor_id);
        w.revive(&asked.network_id, &asked.sensor_id).await?;
        Ok(request)
    }
}
