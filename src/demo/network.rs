//! The network of the demonstration, drawn by the solver's generator.

use voltour_solver::generate::{GenerateError, KCoverage, k_coverage};
use voltour_solver::scenario::{Document, Objective, SensorDocument};

use super::world::{Battery, World};
use crate::cli::Failure;
use crate::clock::Clock;
use crate::domain::{ChargerType, Coverage, NetworkSpec, Place, Sensor, SensorId};

/// The same one every time.
const SEED: u64 = 7;
/// A sensor asks when so much of its battery is left.
pub(super) const ASKS_BELOW: f64 = 0.45;
/// A tour lasts so long at most.
const TIMESPAN_S: f64 = 2.0 * 3600.0;

/// A network, and the field that it stands for.
pub(super) fn draw(clock: &dyn Clock) -> Result<(NetworkSpec, World), Failure> {
    let options = KCoverage {
        sensors: 24,
        k: 1,
        alpha: ASKS_BELOW,
        side_m: 300.0,
        drain_min_w: 0.3,
        drain_max_w: 0.7,
        ..KCoverage::default()
    };
    let failed = |error: GenerateError| Failure::other(format!("no network was drawn: {error}"));
    let document = k_coverage(&options, SEED).map_err(failed)?;
    let batteries = batteries(&document, clock);
    let sensors =
        document.sensors.iter().zip(&batteries).map(|(drawn, battery)| sensor(drawn, battery));
    let sensors: Vec<Sensor> = sensors.collect::<Result<_, _>>()?;
    let spec = spec(&document, sensors);
    let named = spec.sensors.iter().map(|sensor| sensor.id.clone()).zip(batteries);
    let world = World::new(named.collect());
    Ok((spec, world))
}

/// As drawn where a sensor asks; the others are fuller, each another bit.
fn batteries(document: &Document, clock: &dyn Clock) -> Vec<Battery> {
    let now = clock.now();
    let battery = |(i, sensor): (usize, &SensorDocument)| {
        let asks = document.requests.iter().find(|request| request.sensor == sensor.id);
        let full = sensor.battery_j;
        let share = ASKS_BELOW + (1.0 - ASKS_BELOW) * ((i * 7 % 10) as f64 + 1.0) / 10.0;
        let level_j = asks.and_then(|request| request.residual_j).unwrap_or(share * full);
        let spread = 0.3 + 0.05 * (i % 8) as f64;
        let drain_w = asks.and_then(|request| request.drain_w).unwrap_or(spread);
        Battery::new(full, level_j, drain_w, now)
    };
    document.sensors.iter().enumerate().map(battery).collect()
}

fn sensor(drawn: &SensorDocument, battery: &Battery) -> Result<Sensor, Failure> {
    let id: SensorId = drawn.id.parse().map_err(|error| Failure::other(format!("{error}")))?;
    Ok(Sensor {
        id,
        place: Place::PositionM(drawn.position_m.unwrap_or_default()),
        range_m: drawn.range_m,
        battery_j: drawn.battery_j,
        drain_w: Some(battery.drain_w),
    })
}

/// As many sensors as a tour can charge, and the field stays covered: the drawn objective would leave
/// whoever is not needed to run empty, which is right and no pleasure to watch.
fn spec(document: &Document, sensors: Vec<Sensor>) -> NetworkSpec {
    let charger = &document.charger;
    let coverage = document
        .coverage
        .as_ref()
        .map(|coverage| Coverage { k: coverage.k as u32, field_m: coverage.field_m.clone() });
    NetworkSpec {
        objective: Objective::MaxCount,
        charge_level: document.charge_level,
        coverage,
        charger_types: vec![ChargerType {
            name: "truck".to_owned(),
            speed_mps: charger.speed_mps,
            travel_jpm: charger.travel_jpm,
            transfer_w: charger.transfer_w,
            capacity_j: charger.capacity_j,
            timespan_s: Some(TIMESPAN_S),
            start_m: charger.start_m,
            end_m: charger.end_m,
        }],
        sensors,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::SystemClock;
    use crate::grpc::wire;
    use crate::proto::PutNetworkRequest;

    #[test]
    fn the_drawn_network_keeps_the_rules_of_the_contract() {
        let (spec, world) = draw(&SystemClock).unwrap();
        assert_eq!(spec.sensors.len(), 24);
        assert!(!world.due(SystemClock.now()).is_empty());
        let put = PutNetworkRequest {
            client_id: "c".to_owned(),
            network_id: "demo".to_owned(),
            spec: Some(wire::spec_to_wire(&spec)),
            expected_version: None,
        };
        assert_eq!(wire::put_network(put).unwrap().content.spec, spec);
    }
}
