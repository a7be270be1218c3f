//! The features: the field, every sensor with what the plan does about it, the tour, its two ends.

use std::collections::HashMap;

use geojson::feature::Id;
use geojson::{Feature, FeatureCollection, Geometry, JsonObject};
use serde_json::{Value, json};
use voltour_solver::plan::Plan;
use voltour_solver::scenario::{Place, Request, Scenario, Sensor};

use super::Origin;

/// A position lies more than 1,000 km from the origin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the plan reaches more than 1,000 km from it")]
pub struct OutOfReach;

/// The map of a plan as the text of a feature collection: positions in degrees (longitude, latitude) where an
/// origin is given, else in metres of the plane. Times in its properties are seconds after the plan's second 0.
///
/// # Errors
/// With an origin, a position is too far from it.
pub fn map(
    scenario: &Scenario,
    plan: &Plan,
    origin: Option<&Origin>,
) -> Result<String, OutOfReach> {
    let drawing = Drawing { scenario, plan, origin };
    let features = drawing.features()?;
    Ok(FeatureCollection { bbox: None, features, foreign_members: None }.to_string())
}

struct Drawing<'a> {
    scenario: &'a Scenario,
    plan: &'a Plan,
    origin: Option<&'a Origin>,
}

type Drawn = Result<Feature, OutOfReach>;

impl Drawing<'_> {
    /// What lies below comes first.
    fn features(&self) -> Result<Vec<Feature>, OutOfReach> {
        let charger = &self.scenario.charger;
        let mut features = Vec::with_capacity(self.scenario.sensors.len() + 4);
        features.extend(self.field().transpose()?);
        features.push(self.tour()?);
        let roles = self.roles();
        let asked = self.scenario.requests.iter().map(|request| (request.sensor, request));
        let asked: HashMap<_, _> = asked.collect();
        for (i, sensor) in self.scenario.sensors.iter().enumerate() {
            let role = roles.get(sensor.id.as_str()).copied().unwrap_or_default();
            features.push(self.sensor(sensor, asked.get(&i).copied(), role)?);
        }
        features.push(self.depot("start", charger.start_m.into())?);
        features.push(self.depot("end", charger.end_m.into())?);
        Ok(features)
    }

    fn field(&self) -> Option<Drawn> {
        let coverage = self.scenario.coverage.as_ref()?;
        // Counter-clockwise already; a ring ends where it begins.
        let corners = coverage.field.corners();
        let ring = corners.iter().chain(corners.first()).map(|&corner| self.place(corner.into()));
        let properties =
            json!({"kind": "field", "k": coverage.k, "area_m2": coverage.field.area_m2()});
        Some(
            ring.collect::<Result<Vec<_>, _>>()
                .map(|ring| feature("field".to_owned(), Geometry::new_polygon([ring]), properties)),
        )
    }

    fn tour(&self) -> Drawn {
        let (plan, charger) = (self.plan, &self.scenario.charger);
        let stops = plan.stops.iter().map(|stop| stop.position_m);
        let ends: [[f64; 2]; 2] = [charger.start_m.into(), charger.end_m.into()];
        let line = std::iter::once(ends[0]).chain(stops).chain([ends[1]]);
        let line = line.map(|at| self.place(at)).collect::<Result<Vec<_>, _>>()?;
        let properties = json!({
            "kind": "tour", "status": plan.status, "solver": plan.solver, "objective": plan.objective,
            "bound": plan.bound, "distance_m": plan.distance_m, "travel_j": plan.travel_j,
            "charge_j": plan.charge_j, "finish_s": plan.finish_s, "stops": plan.stops.len(),
        });
        Ok(feature("tour".to_owned(), Geometry::new_line_string(line), properties))
    }

    fn sensor(&self, sensor: &Sensor, asked: Option<&Request>, role: Role) -> Drawn {
        let met = role.stop.map(|stop| self.plan.stops[stop].position_m);
        let at = met.unwrap_or_else(|| sensor.place.at(0.0).into());
        let mut properties = json!({
            "kind": "sensor", "sensor": sensor.id, "role": role.name(), "battery_j": sensor.battery_j,
            "range_m": sensor.range_m, "moving": matches!(sensor.place, Place::Moving(_)),
        });
        let mut more = |name: &str, value: Value| properties[name] = value;
        if let Some(request) = asked {
            more("deadline_s", json!(request.deadline_s));
            more("residual_j", json!(request.residual_j));
            more("reward", json!(request.reward));
            more("required", json!(request.required));
        }
        if let Some(stop) = role.stop {
            let planned = &self.plan.stops[stop];
            more("order", json!(stop + 1));
            more("arrive_s", json!(planned.arrive_s));
            more("depart_s", json!(planned.depart_s));
            more("charge_j", json!(planned.charge_j));
        }
        if let Some(reason) = role.reason {
            more("reason", json!(reason));
        }
        let point = Geometry::new_point(self.place(at)?);
        Ok(feature(format!("sensor:{}", sensor.id), point, properties))
    }

    fn depot(&self, kind: &'static str, at: [f64; 2]) -> Drawn {
        let point = Geometry::new_point(self.place(at)?);
        Ok(feature(kind.to_owned(), point, json!({"kind": kind})))
    }

    /// By sensor, of those that the plan names.
    fn roles(&self) -> HashMap<&str, Role> {
        let stops = self.plan.stops.iter().enumerate();
        let stops = stops.map(|(i, stop)| (&*stop.sensor, Role { stop: Some(i), reason: None }));
        let unserved = self.plan.unserved.iter();
        let unserved = unserved
            .map(|left| (&*left.sensor, Role { stop: None, reason: Some(left.reason.name()) }));
        unserved.chain(stops).collect()
    }

    fn place(&self, at_m: [f64; 2]) -> Result<[f64; 2], OutOfReach> {
        match self.origin {
            None => Ok(at_m),
            Some(origin) => origin.locate(at_m).ok_or(OutOfReach),
        }
    }
}

/// What the plan does about a sensor: one of the two, or neither.
#[derive(Clone, Copy, Default)]
struct Role {
    /// Which stop it is, from 0.
    stop: Option<usize>,
    /// Why it is none.
    reason: Option<&'static str>,
}

impl Role {
    fn name(&self) -> &'static str {
        match (self.stop, self.reason) {
            (Some(_), _) => "stop",
            (None, Some(_)) => "unserved",
            (None, None) => "idle",
        }
    }
}

fn feature(id: String, geometry: Geometry, properties: Value) -> Feature {
    let properties = match properties {
        Value::Object(properties) => properties,
        _ => JsonObject::new(),
    };
    Feature {
        id: Some(Id::String(id)),
        geometry: Some(geometry),
        properties: Some(properties),
        ..Feature::default()
    }
}

#[cfg(test)]
mod tests {
    use voltour_solver::solvers::plan_from_order;

    use super::*;

    fn scenario() -> Scenario {
        let document = json!({
            "format": "voltour/scenario/1", "objective": "max_count",
            "charger": {"start_m": [0, 0], "speed_mps": 5, "travel_jpm": 1, "transfer_w": 10},
            "coverage": {"k": 1, "field_m": [[0, 0], [0, 10], [10, 10], [10, 0]]},
            "sensors": [
                {"id": "</a>", "position_m": [3, 4], "range_m": 100, "battery_j": 10},
                {"id": "b", "position_m": [6, 8], "range_m": 100, "battery_j": 10},
                {"id": "c", "position_m": [9, 9], "range_m": 100, "battery_j": 10},
            ],
            "requests": [{"sensor": "b", "reward": 2}, {"sensor": "</a>"}],
        });
        Scenario::from_json(document.to_string().as_bytes()).unwrap()
    }

    fn drawn(origin: Option<&str>) -> Value {
        let scenario = scenario();
        let plan = plan_from_order(&scenario, &[1], "greedy");
        let origin = origin.map(|text| text.parse::<Origin>().unwrap());
        serde_json::from_str(&map(&scenario, &plan, origin.as_ref()).unwrap()).unwrap()
    }

    #[test]
    fn every_feature_is_there_and_the_text_is_geojson() {
        let map = drawn(None);
        let read: geojson::GeoJson = map.to_string().parse().unwrap();
        assert_eq!(geojson::FeatureCollection::try_from(read).unwrap().features.len(), 7);
        let ids: Vec<_> = map["features"].as_array().unwrap().iter().map(|f| &f["id"]).collect();
        assert_eq!(ids, ["field", "tour", "sensor:</a>", "sensor:b", "sensor:c", "start", "end"]);
        let ring = &map["features"][0]["geometry"]["coordinates"][0];
        assert_eq!((&ring[0], ring.as_array().unwrap().len()), (&ring[4], 5));
        let tour = &map["features"][1];
        assert_eq!(tour["geometry"]["coordinates"], json!([[0.0, 0.0], [3.0, 4.0], [0.0, 0.0]]));
        let roles: Vec<_> = (2..5).map(|i| &map["features"][i]["properties"]["role"]).collect();
        assert_eq!(roles, ["stop", "unserved", "idle"]);
        assert_eq!(map["features"][2]["properties"]["order"], 1);
        assert_eq!(map["features"][3]["properties"]["reward"], 2.0);
        assert!(map["features"][3]["properties"]["reason"].is_string());
    }

    #[test]
    fn an_origin_puts_it_on_the_earth() {
        let map = drawn(Some("11.5,45"));
        let at = &map["features"][2]["geometry"]["coordinates"];
        let (lon, lat) = (at[0].as_f64().unwrap(), at[1].as_f64().unwrap());
        assert!((lon - 11.500_038).abs() < 1e-6 && (lat - 45.000_036).abs() < 1e-6, "{at}");
    }
}
