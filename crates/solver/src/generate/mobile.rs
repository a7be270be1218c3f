//! Mobile network charging path (paper, section "Performance Comparison").

use crate::scenario::{
    ChargerDocument, Document, FORMAT, Objective, RequestDocument, Scenario, SensorDocument,
};

use super::GenerateError;
use super::draw::{Draw, round};
use super::options::{
    at_most, below, count, id, not_negative, option, positive, sensor_at, share, side,
};

/// Options of [`mobile`]; the defaults are the paper's.
#[derive(Clone, Debug, PartialEq)]
pub struct Mobile {
    /// Sensors, at first uniform in the field (paper: 10 to 30).
    pub sensors: u32,
    /// Side of the square field, in metres.
    pub side_m: f64,
    /// The charger must have reached the upper right corner by then, in seconds.
    pub timespan_s: f64,
    /// Slowest average speed of a sensor.
    pub sensor_min_mps: f64,
    /// Fastest average speed of a sensor; less than the charger's.
    pub sensor_max_mps: f64,
    /// Required charging level.
    pub alpha: f64,
    /// A sensor is charged to (1 - epsilon) x alpha of its battery.
    pub epsilon: f64,
    /// A sensor asks when its residual energy is at most this share of its battery.
    pub request_below: f64,
    /// Capacity of a battery, in joules.
    pub battery_j: f64,
    /// Speed of the charger.
    pub speed_mps: f64,
    /// Energy travelled per metre; without a capacity, nothing depends on it.
    pub travel_jpm: f64,
    /// Charging power.
    pub transfer_w: f64,
}

impl Default for Mobile {
    fn default() -> Self {
        Self {
            sensors: 20,
            side_m: 100.0,
            timespan_s: 1800.0,
            sensor_min_mps: 0.0,
            sensor_max_mps: 2.0,
            alpha: 0.9,
            epsilon: 0.1,
            request_below: 1.0,
            battery_j: 10_800.0,
            speed_mps: 5.0,
            travel_jpm: 600.0,
            transfer_w: 40.0,
        }
    }
}

/// A scenario of the preset `mobile`: meet and charge as many moving sensors as the time allows.
///
/// # Errors
/// The first option that is out of its range.
pub fn mobile(options: &Mobile, seed: u64) -> Result<Document, GenerateError> {
    validate(options)?;
    let mut draw = Draw::new(seed);
    let &Mobile { sensors: n, side_m, battery_j, .. } = options;
    let sensors: Vec<_> = (0..n as usize)
        .map(|i| SensorDocument {
            position_m: None,
            trajectory: Some(random_way_points(options, &mut draw)),
            ..sensor_at(i, [0.0, 0.0], battery_j)
        })
        .collect();
    let residuals: Vec<_> = (0..n).map(|_| draw.between(0.0, battery_j)).collect();
    let asks = |residual_j: f64| residual_j <= options.request_below * battery_j;
    let requests = residuals.iter().enumerate().filter(|(_, residual_j)| asks(**residual_j));
    let document = Document {
        format: FORMAT.to_owned(),
        name: Some(format!("mobile-n{n}-s{seed}")),
        objective: Objective::MaxCount,
        charger: ChargerDocument {
            start_m: [side_m / 2.0, side_m / 2.0],
            end_m: Some([side_m, side_m]),
            speed_mps: options.speed_mps,
            travel_jpm: options.travel_jpm,
            transfer_w: options.transfer_w,
            capacity_j: None,
            timespan_s: Some(options.timespan_s),
        },
        charge_level: Some(round((1.0 - options.epsilon) * options.alpha)),
        coverage: None,
        sensors,
        requests: requests
            .map(|(i, residual_j)| RequestDocument {
                sensor: id(i),
                ready_s: None,
                deadline_s: None,
                residual_j: Some(*residual_j),
                drain_w: None,
                reward: None,
                required: None,
            })
            .collect(),
        travel: None,
    };
    Scenario::from_document(&document)?;
    Ok(document)
}

/// The random way point model without pauses: straight legs between uniform places, all at the
/// sensor's own speed, until the time span is over.
fn random_way_points(options: &Mobile, draw: &mut Draw) -> Vec<[f64; 3]> {
    /// Below it a leg would be rounded to another speed; such a leg is drawn again.
    const SHORTEST_LEG_M: f64 = 0.01;
    let speed_mps = draw.between(options.sensor_min_mps, options.sensor_max_mps);
    let [mut x, mut y] = draw.place(options.side_m);
    let mut now_s = 0.0;
    let mut rows = vec![[now_s, x, y]];
    while now_s < options.timespan_s && speed_mps > 0.0 {
        let [to_x, to_y] = draw.place(options.side_m);
        let leg_m = (to_x - x).hypot(to_y - y);
        if leg_m >= SHORTEST_LEG_M {
            (x, y, now_s) = (to_x, to_y, round(now_s + leg_m / speed_mps));
            rows.push([now_s, x, y]);
        }
    }
    rows
}

fn validate(options: &Mobile) -> Result<(), GenerateError> {
    /// Sides of the field that all sensors together may travel; a leg is half a side on average.
    const MOST_SIDES: f64 = 10_000_000.0;
    count("sensors", options.sensors)?;
    side("side_m", options.side_m)?;
    positive("timespan_s", options.timespan_s)?;
    not_negative("sensor_min_mps", options.sensor_min_mps)?;
    not_negative("sensor_max_mps", options.sensor_max_mps)?;
    at_most("sensor_min_mps", options.sensor_min_mps, "sensor_max_mps", options.sensor_max_mps)?;
    positive("speed_mps", options.speed_mps)?;
    below("sensor_max_mps", options.sensor_max_mps, "speed_mps", options.speed_mps)?;
    let metres = f64::from(options.sensors) * options.sensor_max_mps * options.timespan_s;
    let rule = "must leave the trajectories fewer than some ten million rows";
    option("timespan_s", options.timespan_s, rule, metres <= MOST_SIDES * options.side_m)?;
    positive("alpha", options.alpha)?;
    share("alpha", options.alpha)?;
    share("epsilon", options.epsilon)?;
    below("epsilon", options.epsilon, "1 (nothing would be charged)", 1.0)?;
    share("request_below", options.request_below)?;
    positive("battery_j", options.battery_j)?;
    not_negative("travel_jpm", options.travel_jpm)?;
    positive("transfer_w", options.transfer_w)
}
