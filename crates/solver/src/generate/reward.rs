//! Fully charging reward maximisation (paper, section "Performance Comparison").

use crate::scenario::{ChargerDocument, Document, FORMAT, Objective, RequestDocument, Scenario};

use super::GenerateError;
use super::draw::Draw;
use super::options::{count, id, not_negative, positive, sensor_at, share, side};

/// Options of [`reward`]; the defaults are the paper's.
#[derive(Clone, Debug, PartialEq)]
pub struct Reward {
    /// Sensors, uniform in the field (paper: 50 to 200).
    pub sensors: u32,
    /// Side of the square field, in metres.
    pub side_m: f64,
    /// A sensor asks when its residual energy is below this share of its battery; at 1, always.
    pub alpha: f64,
    /// Capacity of the charger, in joules (paper: 200,000 to 350,000).
    pub capacity_j: f64,
    /// Capacity of a battery, in joules.
    pub battery_j: f64,
    /// Speed of the charger.
    pub speed_mps: f64,
    /// Energy travelled per metre.
    pub travel_jpm: f64,
    /// Charging power; the paper names none for this problem, so that of k-coverage.
    pub transfer_w: f64,
}

impl Default for Reward {
    fn default() -> Self {
        Self {
            sensors: 100,
            side_m: 1000.0,
            alpha: 0.2,
            capacity_j: 300_000.0,
            battery_j: 10_800.0,
            speed_mps: 5.0,
            travel_jpm: 600.0,
            transfer_w: 20.0,
        }
    }
}

/// A scenario of the preset `reward`: serve the requests worth most within the capacity.
///
/// # Errors
/// The first option that is out of its range.
pub fn reward(options: &Reward, seed: u64) -> Result<Document, GenerateError> {
    validate(options)?;
    let mut draw = Draw::new(seed);
    let &Reward { sensors: n, side_m, alpha, battery_j, .. } = options;
    let places: Vec<_> = (0..n).map(|_| draw.place(side_m)).collect();
    let residuals: Vec<_> = (0..n).map(|_| draw.above(0.0, battery_j)).collect();
    let asks = |residual_j: f64| residual_j < alpha * battery_j || alpha == 1.0;
    let requests = residuals.iter().enumerate().filter(|(_, residual_j)| asks(**residual_j));
    let document = Document {
        format: FORMAT.to_owned(),
        name: Some(format!("reward-n{n}-a{alpha}-s{seed}")),
        objective: Objective::MaxReward,
        charger: ChargerDocument {
            start_m: [side_m / 2.0, side_m / 2.0],
            end_m: None,
            speed_mps: options.speed_mps,
            travel_jpm: options.travel_jpm,
            transfer_w: options.transfer_w,
            capacity_j: Some(options.capacity_j),
            timespan_s: None,
        },
        charge_level: None,
        coverage: None,
        sensors: (places.iter().enumerate())
            .map(|(i, place)| sensor_at(i, *place, battery_j))
            .collect(),
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

fn validate(options: &Reward) -> Result<(), GenerateError> {
    count("sensors", options.sensors)?;
    side("side_m", options.side_m)?;
    share("alpha", options.alpha)?;
    not_negative("capacity_j", options.capacity_j)?;
    positive("battery_j", options.battery_j)?;
    positive("speed_mps", options.speed_mps)?;
    not_negative("travel_jpm", options.travel_jpm)?;
    positive("transfer_w", options.transfer_w)
}
