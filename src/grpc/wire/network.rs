//! Networks.

use voltour_solver::scenario::Objective;

use super::place::{place_to_wire, point_to_wire, time_to_wire};
use super::{Fields, Path, Rule};
use crate::domain::{
    Call, ChargerId, ChargerType, Coverage, Network, NetworkSpec, Refusal, Sensor, SensorId,
    TimedPoint,
};
use crate::proto;
use crate::scheduler::{PutNetwork, UpdateTrajectories};

/// Reads `NetworkService.Put`.
pub fn put_network(wire: proto::PutNetworkRequest) -> Result<Call<PutNetwork>, Refusal> {
    let mut fields = Fields::default();
    let at = Path::ROOT;
    let client_id = fields.client_id(&wire.client_id);
    let network_id = fields.id(at.field("network_id"), &wire.network_id);
    let spec = fields.present(at.field("spec"), wire.spec);
    let spec = spec.and_then(|spec| read_spec(&mut fields, at.field("spec"), spec));
    let expected_version = wire.expected_version;
    let call = || {
        let content = PutNetwork { network_id: network_id?, spec: spec?, expected_version };
        Some(Call { client_id: client_id?, content })
    };
    let call = call();
    fields.finish(call)
}

/// Reads `NetworkService.UpdateTrajectory`.
pub fn trajectories(
    wire: proto::UpdateTrajectoryRequest,
) -> Result<Call<UpdateTrajectories>, Refusal> {
    let mut fields = Fields::default();
    let at = Path::ROOT;
    let client_id = fields.client_id(&wire.client_id);
    let network_id = fields.id(at.field("network_id"), &wire.network_id);
    let trajectories =
        fields.each(at.field("trajectories"), wire.trajectories, |fields, at, item| {
            let id = fields.id::<SensorId>(at.field("sensor_id"), &item.sensor_id);
            let points: Option<Vec<TimedPoint>> = fields
                .present(at.field("trajectory"), item.trajectory)
                .and_then(|wire| fields.trajectory(at.field("trajectory"), wire));
            Some((id?, points?))
        });
    let call = || {
        let content = UpdateTrajectories { network_id: network_id?, trajectories: trajectories? };
        Some(Call { client_id: client_id?, content })
    };
    let call = call();
    fields.finish(call)
}

fn read_spec(fields: &mut Fields, at: Path<'_>, wire: proto::NetworkSpec) -> Option<NetworkSpec> {
    let objective = read_objective(fields, at.field("objective"), wire.objective);
    let level = at.field("charge_level");
    let charge_level = fields.optional_number(level, wire.charge_level, Rule::Fraction);
    let coverage = match wire.coverage {
        None => Some(None),
        Some(wire) => read_coverage(fields, at.field("coverage"), wire).map(Some),
    };
    let types = at.field("charger_types");
    if wire.charger_types.is_empty() {
        fields.add(types, "must have at least one charger type");
    }
    let charger_types = fields.each(types, wire.charger_types, read_charger_type);
    let sensors = fields.each(at.field("sensors"), wire.sensors, read_sensor);
    Some(NetworkSpec {
        objective: objective?,
        charge_level: charge_level?,
        coverage: coverage?,
        charger_types: charger_types?,
        sensors: sensors?,
    })
}

fn read_objective(fields: &mut Fields, at: Path<'_>, wire: i32) -> Option<Objective> {
    match proto::Objective::try_from(wire) {
        Ok(proto::Objective::MinDistance) => Some(Objective::MinDistance),
        Ok(proto::Objective::MaxReward) => Some(Objective::MaxReward),
        Ok(proto::Objective::MaxCount) => Some(Objective::MaxCount),
        Ok(proto::Objective::Unspecified) => fields.refuse(at, "is missing"),
        Err(_) => fields.refuse(at, format!("{wire} is no objective")),
    }
}

fn read_coverage(fields: &mut Fields, at: Path<'_>, wire: proto::Coverage) -> Option<Coverage> {
    if wire.k == 0 {
        fields.add(at.field("k"), "0 must be at least 1");
    }
    let field_m = fields.each(at.field("field_m"), wire.field_m, Fields::point);
    Some(Coverage { k: wire.k, field_m: field_m? })
}

fn read_charger_type(
    fields: &mut Fields,
    at: Path<'_>,
    wire: proto::ChargerType,
) -> Option<ChargerType> {
    // Spelled like a charger's id, so that both can stand in a path or a label as they are.
    let name = fields.id::<ChargerId>(at.field("name"), &wire.name);
    let speed = fields.number(at.field("speed_mps"), wire.speed_mps, Rule::Positive);
    let travel = fields.number(at.field("travel_jpm"), wire.travel_jpm, Rule::AtLeastZero);
    let transfer = fields.number(at.field("transfer_w"), wire.transfer_w, Rule::Positive);
    let capacity =
        fields.optional_number(at.field("capacity_j"), wire.capacity_j, Rule::AtLeastZero);
    let timespan =
        fields.optional_number(at.field("timespan_s"), wire.timespan_s, Rule::AtLeastZero);
    let start = fields.required_point(at.field("start_m"), wire.start_m);
    let end = fields.optional_point(at.field("end_m"), wire.end_m);
    Some(ChargerType {
        name: name?.into(),
        speed_mps: speed?,
        travel_jpm: travel?,
        transfer_w: transfer?,
        capacity_j: capacity?,
        timespan_s: timespan?,
        start_m: start?,
        end_m: end?,
    })
}

fn read_sensor(fields: &mut Fields, at: Path<'_>, wire: proto::Sensor) -> Option<Sensor> {
    let id = fields.id(at.field("id"), &wire.id);
    let place = fields
        .present(at.field("place"), wire.place)
        .and_then(|wire| fields.place(at.field("place"), wire));
    let range = fields.optional_number(at.field("range_m"), wire.range_m, Rule::Positive);
    let battery = fields.number(at.field("battery_j"), wire.battery_j, Rule::Positive);
    let drain = fields.optional_number(at.field("drain_w"), wire.drain_w, Rule::AtLeastZero);
    Some(Sensor { id: id?, place: place?, range_m: range?, battery_j: battery?, drain_w: drain? })
}

/// Reads a network as the service answers it.
pub fn network(wire: proto::Network) -> Result<Network, Refusal> {
    let mut fields = Fields::default();
    let at = Path::ROOT;
    let id = fields.id(at.field("id"), &wire.id);
    let created_at = fields.required_time(at.field("created_at"), wire.created_at);
    let updated_at = fields.required_time(at.field("updated_at"), wire.updated_at);
    let spec = match wire.spec {
        None => Some(None),
        Some(spec) => read_spec(&mut fields, at.field("spec"), spec).map(Some),
    };
    let (version, sensor_count) = (wire.version, wire.sensor_count);
    let network = || {
        let (created_at, updated_at) = (created_at?, updated_at?);
        Some(Network { id: id?, version, created_at, updated_at, sensor_count, spec: spec? })
    };
    let network = network();
    fields.finish(network)
}

/// A network for the wire.
pub fn network_to_wire(network: Network) -> proto::Network {
    proto::Network {
        id: network.id.into(),
        version: network.version,
        spec: network.spec.as_ref().map(spec_to_wire),
        created_at: Some(time_to_wire(network.created_at)),
        updated_at: Some(time_to_wire(network.updated_at)),
        sensor_count: network.sensor_count,
    }
}

/// A network's spec for the wire.
pub fn spec_to_wire(spec: &NetworkSpec) -> proto::NetworkSpec {
    let objective = match spec.objective {
        Objective::MinDistance => proto::Objective::MinDistance,
        Objective::MaxReward => proto::Objective::MaxReward,
        Objective::MaxCount => proto::Objective::MaxCount,
    };
    let coverage = |coverage: &Coverage| proto::Coverage {
        k: coverage.k,
        field_m: coverage.field_m.iter().copied().map(point_to_wire).collect(),
    };
    proto::NetworkSpec {
        objective: objective.into(),
        charge_level: spec.charge_level,
        coverage: spec.coverage.as_ref().map(coverage),
        charger_types: spec.charger_types.iter().map(charger_type_to_wire).collect(),
        sensors: spec.sensors.iter().map(sensor_to_wire).collect(),
    }
}

fn charger_type_to_wire(kind: &ChargerType) -> proto::ChargerType {
    proto::ChargerType {
        name: kind.name.clone(),
        speed_mps: kind.speed_mps,
        travel_jpm: kind.travel_jpm,
        transfer_w: kind.transfer_w,
        capacity_j: kind.capacity_j,
        timespan_s: kind.timespan_s,
        start_m: Some(point_to_wire(kind.start_m)),
        end_m: kind.end_m.map(point_to_wire),
    }
}

fn sensor_to_wire(sensor: &Sensor) -> proto::Sensor {
    proto::Sensor {
        id: sensor.id.as_str().to_owned(),
        place: Some(place_to_wire(&sensor.place)),
        range_m: sensor.range_m,
        battery_j: sensor.battery_j,
        drain_w: sensor.drain_w,
    }
}
