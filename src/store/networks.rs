//! What the writer knows of networks without asking: their present version, which of their sensors are
//! taken for dead. It is forgotten whenever a transaction is rolled back.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use sqlx::SqliteConnection;

use super::StoreError;
use super::cells::{Cells, signed};
use super::writer::{Failure, Writing};
use crate::domain::rules::KnownNetwork;
use crate::domain::{NetworkId, NetworkSpec, Refusal, SensorId};

/// Sensors of all networks kept at most; then all are forgotten and read again when needed.
const KEPT: usize = 200_000;

/// The networks known.
#[derive(Debug, Default)]
pub(super) struct Networks {
    known: HashMap<NetworkId, Known>,
    sensors: usize,
}

#[derive(Debug)]
struct Known {
    present: KnownNetwork,
    dead: HashSet<SensorId>,
    /// Sensors that have got a request since the last close: a hint, to spare the attempt that the
    /// unique index would refuse.
    opened: HashSet<SensorId>,
}

impl Networks {
    /// Forgets all.
    pub fn forget(&mut self) {
        *self = Self::default();
    }

    /// Forgets one, before it changes.
    pub fn forget_one(&mut self, id: &NetworkId) {
        if let Some(known) = self.known.remove(id) {
            self.sensors = self.sensors.saturating_sub(known.present.spec.sensors.len());
        }
    }

    /// Takes note of an open request.
    pub fn opened(&mut self, id: &NetworkId, sensor: &SensorId) {
        if let Some(known) = self.known.get_mut(id)
            && !known.opened.contains(sensor)
        {
            known.opened.insert(sensor.clone());
        }
    }

    /// Whether a sensor may have an open request; where it is not known, the database knows.
    pub fn perhaps_open(&self, id: &NetworkId, sensor: &SensorId) -> bool {
        self.known.get(id).is_some_and(|known| known.opened.contains(sensor))
    }

    /// Takes note of a close: few requests are open now.
    pub fn closed(&mut self, id: &NetworkId) {
        if let Some(known) = self.known.get_mut(id) {
            known.opened.clear();
        }
    }

    /// Takes note of a sensor that died.
    pub fn died(&mut self, id: &NetworkId, sensor: &SensorId) {
        if let Some(known) = self.known.get_mut(id) {
            known.dead.insert(sensor.clone());
        }
    }

    /// Takes note of a sensor that is back; whether it was dead.
    pub fn revived(&mut self, id: &NetworkId, sensor: &SensorId) -> bool {
        self.known.get_mut(id).is_some_and(|known| known.dead.remove(sensor))
    }
}

impl Writing {
    /// The present version of a network.
    pub async fn network(&mut self, id: &NetworkId) -> Result<KnownNetwork, Failure> {
        let missing = || Refusal::NotFound { what: "network", id: id.to_string() };
        Ok(self.network_or_none(id).await?.ok_or_else(missing)?)
    }

    /// The present version of a network, if there is one.
    pub async fn network_or_none(
        &mut self,
        id: &NetworkId,
    ) -> Result<Option<KnownNetwork>, StoreError> {
        if let Some(known) = self.networks.known.get(id) {
            return Ok(Some(known.present.clone()));
        }
        let version = sqlx::query_scalar::<_, i64>("SELECT version FROM networks WHERE id = ?");
        let version = version.bind(id.as_str()).fetch_optional(&mut self.conn).await?;
        let Some(version) = version.map(i64::unsigned_abs) else { return Ok(None) };
        let spec = Arc::new(spec(&mut self.conn, id, version).await?);
        let present = KnownNetwork::new(id.clone(), version, spec);
        let dead = dead(&mut self.conn, id).await?;
        self.networks.sensors += present.spec.sensors.len();
        if self.networks.sensors > KEPT {
            self.networks.forget();
            self.networks.sensors = present.spec.sensors.len();
        }
        let known = Known { present: present.clone(), dead, opened: HashSet::new() };
        self.networks.known.insert(id.clone(), known);
        Ok(Some(present))
    }

    /// A sensor that was taken for dead is alive.
    pub async fn revive(&mut self, id: &NetworkId, sensor: &SensorId) -> Result<(), StoreError> {
        if self.networks.revived(id, sensor) {
            let back = "DELETE FROM dead_sensors WHERE network_id = ? AND sensor_id = ?";
            let back = sqlx::query(back).bind(id.as_str()).bind(sensor.as_str());
            back.execute(&mut self.conn).await?;
        }
        Ok(())
    }
}

/// A version's spec.
pub(super) async fn spec(
    conn: &mut SqliteConnection,
    id: &NetworkId,
    version: u64,
) -> Result<NetworkSpec, StoreError> {
    let row = sqlx::query("SELECT spec FROM network_versions WHERE network_id = ? AND version = ?");
    let row = row.bind(id.as_str()).bind(signed(version)).fetch_one(conn).await?;
    let json = Cells::new("network_versions", &row).unpacked("spec")?;
    serde_json::from_slice(&json).map_err(|error| StoreError::row("network_versions", error))
}

/// The sensors of a network that are taken for dead.
pub(super) async fn dead(
    conn: &mut SqliteConnection,
    id: &NetworkId,
) -> Result<HashSet<SensorId>, StoreError> {
    let rows = sqlx::query("SELECT sensor_id FROM dead_sensors WHERE network_id = ?");
    let rows = rows.bind(id.as_str()).fetch_all(conn).await?;
    rows.iter().map(|row| Cells::new("dead_sensors", row).parsed("sensor_id")).collect()
}
