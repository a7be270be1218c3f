//! The calls that make no row of their own, or whose row is deleted, remembered by the id that their client gave them.

use jiff::Timestamp;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::domain::{Call, ClientId, Fingerprint, Refusal};
use crate::store::StoreError;
use crate::store::cells::{Cells, text};
use crate::store::writer::{Failure, Writing};

/// A call by its scope, its client's id for it and its content.
pub(super) struct Remembered<'a> {
    scope: String,
    client_id: &'a ClientId,
    fingerprint: Fingerprint,
}

impl<'a> Remembered<'a> {
    /// A call on something.
    pub fn new<T: Serialize>(kind: &str, what: impl ToString, call: &'a Call<T>) -> Self {
        Self::with(kind, what, &call.client_id, call.fingerprint())
    }

    /// A call whose fingerprint is known.
    pub fn with(
        kind: &str,
        what: impl ToString,
        client_id: &'a ClientId,
        fingerprint: Fingerprint,
    ) -> Self {
        Self { scope: format!("{kind}:{}", what.to_string()), client_id, fingerprint }
    }

    /// What was kept for the answer, if the call came before.
    pub async fn find<A: DeserializeOwned>(&self, w: &mut Writing) -> Result<Option<A>, Failure> {
        const SQL: &str = "SELECT fingerprint, answer FROM calls WHERE scope = ? AND client_id = ?";
        let row = sqlx::query(SQL).bind(&self.scope).bind(self.client_id.as_str());
        let Some(row) = row.fetch_optional(&mut w.conn).await? else { return Ok(None) };
        let cells = Cells::new("calls", &row);
        same(cells.get("fingerprint")?, self.fingerprint, self.client_id)?;
        Ok(Some(cells.json("answer")?))
    }

    /// Keeps what the answer is made of.
    pub async fn keep(&self, w: &mut Writing, answer: &impl Serialize) -> Result<(), Failure> {
        Ok(self.keep_since(w.now, w, answer).await?)
    }

    /// Keeps it as if the call had come at another time: it is forgotten so much sooner or later.
    pub async fn keep_since(
        &self,
        time: Timestamp,
        w: &mut Writing,
        answer: &impl Serialize,
    ) -> Result<(), StoreError> {
        const SQL: &str = "INSERT INTO calls (scope, client_id, fingerprint, answer, created_us) \
                           VALUES (?, ?, ?, ?, ?)";
        let time_us = time.as_microsecond();
        let insert = sqlx::query(SQL).bind(&self.scope).bind(self.client_id.as_str());
        let insert = insert.bind(&self.fingerprint.0[..]).bind(text(answer)).bind(time_us);
        insert.execute(&mut w.conn).await?;
        Ok(())
    }
}

/// Refuses other content under an id that was used before.
pub(super) fn same(
    kept: &[u8],
    fingerprint: Fingerprint,
    client_id: &ClientId,
) -> Result<(), Refusal> {
    if kept == fingerprint.0 {
        Ok(())
    } else {
        Err(Refusal::AlreadyExists { client_id: client_id.to_string() })
    }
}
