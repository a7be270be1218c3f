//! `Put`: creates a network, or stores its next version.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::remembered::Remembered;
use crate::domain::rules::KnownNetwork;
use crate::domain::{Call, Fingerprint, Network, PutNetwork, Refusal};
use crate::store::cells::{Cells, pack, signed};
use crate::store::networks;
use crate::store::writer::{Command, Failure, Writing};

/// A network that was judged already.
#[derive(Debug)]
pub struct Put {
    call: Call<PutNetwork>,
    fingerprint: Fingerprint,
    spec: Vec<u8>,
    most: u32,
}

/// What is kept of the answer.
#[derive(Serialize, Deserialize)]
struct Answer {
    version: u64,
}

impl Put {
    /// Compresses the spec; it may take a while. There may be `most` networks.
    ///
    /// # Errors
    /// It cannot be compressed.
    pub fn new(call: Call<PutNetwork>, most: u32) -> Result<Self, Refusal> {
        let failed =
            |error: String| Refusal::Internal(format!("the spec cannot be packed: {error}"));
        let json = serde_json::to_vec(&call.content.spec).map_err(|e| failed(e.to_string()))?;
        let spec = pack(&json).map_err(|error| failed(error.to_string()))?;
        Ok(Self { fingerprint: call.fingerprint(), spec, call, most })
    }

    /// Whether there may be one more network.
    async fn has_room(&self, w: &mut Writing) -> Result<(), Failure> {
        let count = sqlx::query_scalar::<_, i64>("SELECT count(*) FROM networks");
        if count.fetch_one(&mut w.conn).await? < i64::from(self.most) {
            return Ok(());
        }
        let reason = format!("there are {} networks, the most at once", self.most);
        Err(Refusal::exhausted("limits.networks", reason).into())
    }

    async fn store(&self, w: &mut Writing, version: u64) -> Result<(), Failure> {
        let PutNetwork { network_id, spec, .. } = &self.call.content;
        let now_us = w.now_us();
        sqlx::query(
            "INSERT INTO networks (id, version, created_us, updated_us) VALUES (?1, ?2, ?3, ?3) \
             ON CONFLICT (id) DO UPDATE SET version = ?2, updated_us = ?3",
        )
        .bind(network_id.as_str())
        .bind(signed(version))
        .bind(now_us)
        .execute(&mut w.conn)
        .await?;
        sqlx::query(
            "INSERT INTO network_versions (network_id, version, spec, sensor_count, created_us) \
             VALUES (?, ?, ?, ?, ?)",
        )
        .bind(network_id.as_str())
        .bind(signed(version))
        .bind(&self.spec[..])
        .bind(signed(spec.sensors.len() as u64))
        .bind(now_us)
        .execute(&mut w.conn)
        .await?;
        // The trajectories that came after the former version are no news any more.
        sqlx::query("DELETE FROM trajectories WHERE network_id = ?")
            .bind(network_id.as_str())
            .execute(&mut w.conn)
            .await?;
        w.networks.forget_one(network_id);
        Ok(())
    }

    /// The network as it was at a version.
    async fn answer(&self, w: &mut Writing, version: u64) -> Result<Network, Failure> {
        let id = &self.call.content.network_id;
        let row = sqlx::query(
            "SELECT n.created_us, v.created_us AS updated_us, v.sensor_count FROM networks n \
             JOIN network_versions v ON v.network_id = n.id WHERE n.id = ? AND v.version = ?",
        );
        let row = row.bind(id.as_str()).bind(signed(version)).fetch_one(&mut w.conn).await?;
        let cells = Cells::new("network_versions", &row);
        Ok(Network {
            id: id.clone(),
            version,
            created_at: cells.time("created_us")?,
            updated_at: cells.time("updated_us")?,
            sensor_count: cells.count("sensor_count")?,
            spec: Some(self.call.content.spec.clone()),
        })
    }
}

impl Command for Put {
    type Answer = Network;

    async fn apply(&self, w: &mut Writing) -> Result<Network, Failure> {
        let PutNetwork { network_id, spec, expected_version } = &self.call.content;
        let client_id = &self.call.client_id;
        let call = Remembered::with("put", network_id, client_id, self.fingerprint);
        if let Some(Answer { version }) = call.find(w).await? {
            return self.answer(w, version).await;
        }
        let present = w.network_or_none(network_id).await?;
        let version = present.as_ref().map_or(0, |network| network.version);
        if let Some(expected) = expected_version.filter(|expected| *expected != version) {
            let reason = format!("the present version is {version}, {expected} was expected");
            return Err(Refusal::Aborted(reason).into());
        }
        if present.is_none() {
            self.has_room(w).await?;
        }
        let unchanged = |network: &KnownNetwork| Arc::as_ref(&network.spec) == spec;
        let version = match present.as_ref().is_some_and(unchanged) {
            true => version,
            false => {
                self.store(w, version + 1).await?;
                version + 1
            }
        };
        call.keep(w, &Answer { version }).await?;
        self.answer(w, version).await
    }
}

/// A version of a network that is not the present one any more.
pub(super) async fn version(
    w: &mut Writing,
    present: &KnownNetwork,
    version: u64,
) -> Result<KnownNetwork, Failure> {
    if present.version == version {
        return Ok(present.clone());
    }
    let spec = networks::spec(&mut w.conn, &present.id, version).await?;
    Ok(KnownNetwork::new(present.id.clone(), version, Arc::new(spec)))
}
