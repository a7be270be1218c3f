//! A version of a network, kept in memory to judge by.

use std::collections::HashMap;
use std::sync::Arc;

use crate::domain::{ChargerType, NetworkId, NetworkSpec, Sensor, SensorId};

/// A version of a network with an index of its sensors.
#[derive(Clone, Debug)]
pub struct KnownNetwork {
    /// Its id.
    pub id: NetworkId,
    /// Which version.
    pub version: u64,
    /// What was put.
    pub spec: Arc<NetworkSpec>,
    at: Arc<HashMap<SensorId, usize>>,
}

impl KnownNetwork {
    /// Indexes a version.
    pub fn new(id: NetworkId, version: u64, spec: Arc<NetworkSpec>) -> Self {
        let at = spec.sensors.iter().enumerate().map(|(i, sensor)| (sensor.id.clone(), i));
        let at = Arc::new(at.collect());
        Self { id, version, spec, at }
    }

    /// A sensor by its id.
    pub fn sensor(&self, id: &SensorId) -> Option<&Sensor> {
        self.at.get(id).and_then(|&i| self.spec.sensors.get(i))
    }

    /// A charger type by its name, or the only one where none is given.
    pub fn charger_type(&self, name: Option<&str>) -> Option<&ChargerType> {
        match (name, self.spec.charger_types.as_slice()) {
            (Some(name), types) => types.iter().find(|kind| kind.name == name),
            (None, [only]) => Some(only),
            (None, _) => None,
        }
    }

    /// The slowest charger type: whoever is slower than it is slower than all.
    pub fn slowest(&self) -> Option<&ChargerType> {
        self.spec.charger_types.iter().min_by(|a, b| a.speed_mps.total_cmp(&b.speed_mps))
    }
}
