//! What is out in the field: batteries that run down, and are charged.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use jiff::Timestamp;

use super::network::ASKS_BELOW;
use crate::clock::{plus, seconds};
use crate::domain::SensorId;

/// A battery, as it was when somebody last looked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Battery {
    pub full_j: f64,
    pub drain_w: f64,
    level_j: f64,
    at: Timestamp,
    asked: Asked,
}

/// What its sensor has asked for since it was last charged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asked {
    Nothing,
    /// To be charged before it is empty.
    InTime,
    /// To be charged at all: it is empty.
    Empty,
}

/// A sensor that asks now.
#[derive(Clone, Debug)]
pub(super) struct Due {
    pub sensor: SensorId,
    pub residual_j: f64,
    pub drain_w: f64,
    /// When it will be empty; none if it is already.
    pub deadline: Option<Timestamp>,
}

impl Battery {
    /// A battery at `at`.
    pub(super) fn new(full_j: f64, level_j: f64, drain_w: f64, at: Timestamp) -> Self {
        Self { full_j, drain_w, level_j, at, asked: Asked::Nothing }
    }

    fn level(&self, now: Timestamp) -> f64 {
        (self.level_j - self.drain_w * seconds(self.at, now)).max(0.0)
    }

    fn due(&self, now: Timestamp) -> Option<Asked> {
        let level = self.level(now);
        match self.asked {
            Asked::Nothing if level <= 0.0 => Some(Asked::Empty),
            Asked::Nothing if level <= ASKS_BELOW * self.full_j => Some(Asked::InTime),
            Asked::InTime if level <= 0.0 => Some(Asked::Empty),
            _ => None,
        }
    }
}

/// The field. Shared between the players.
#[derive(Debug)]
pub(super) struct World(Mutex<BTreeMap<SensorId, Battery>>);

impl World {
    /// With these batteries.
    pub(super) fn new(batteries: BTreeMap<SensorId, Battery>) -> Self {
        Self(Mutex::new(batteries))
    }

    /// The sensors that have something to ask for now.
    pub(super) fn due(&self, now: Timestamp) -> Vec<Due> {
        let asks = |(sensor, battery): (&SensorId, &Battery)| {
            let asked = battery.due(now)?;
            let residual_j = battery.level(now);
            let left = Duration::from_secs_f64(residual_j / battery.drain_w.max(1e-6));
            let deadline = (asked == Asked::InTime).then(|| plus(now, left));
            Some(Due { sensor: sensor.clone(), residual_j, drain_w: battery.drain_w, deadline })
        };
        self.lock().iter().filter_map(asks).collect()
    }

    /// What a sensor asked for is with the service.
    pub(super) fn asked(&self, due: &Due) {
        if let Some(battery) = self.lock().get_mut(&due.sensor) {
            battery.asked = if due.deadline.is_some() { Asked::InTime } else { Asked::Empty };
        }
    }

    /// How many sensors wait to be charged.
    pub(super) fn waiting(&self) -> usize {
        self.lock().values().filter(|battery| battery.asked != Asked::Nothing).count()
    }

    /// The share of its battery that a sensor has left.
    pub(super) fn share(&self, sensor: &SensorId, at: Timestamp) -> f64 {
        self.lock().get(sensor).map_or(0.0, |battery| battery.level(at) / battery.full_j)
    }

    /// A sensor was charged, and is full at `at`.
    pub(super) fn charged(&self, sensor: &SensorId, at: Timestamp) {
        if let Some(battery) = self.lock().get_mut(sensor) {
            (battery.level_j, battery.at, battery.asked) = (battery.full_j, at, Asked::Nothing);
        }
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<SensorId, Battery>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sensor_asks_once_in_time_and_once_more_when_it_is_empty() {
        let start = Timestamp::UNIX_EPOCH;
        let after = |seconds| plus(start, Duration::from_secs(seconds));
        let id: SensorId = "s".parse().unwrap();
        let battery = Battery::new(100.0, 50.0, 1.0, start);
        let world = World::new(BTreeMap::from([(id.clone(), battery)]));
        assert!(world.due(start).is_empty());
        let due = world.due(after(10)).pop().unwrap();
        assert_eq!((due.residual_j, due.deadline), (40.0, Some(after(50))));
        world.asked(&due);
        assert!(world.due(after(20)).is_empty());
        let due = world.due(after(60)).pop().unwrap();
        assert_eq!(due.deadline, None);
        world.asked(&due);
        assert_eq!((world.due(after(70)).len(), world.waiting()), (0, 1));
        world.charged(&id, after(80));
        assert_eq!((world.waiting(), world.share(&id, after(90))), (0, 0.9));
    }
}
