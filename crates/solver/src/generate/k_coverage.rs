//! Optimal k-coverage charging (paper, section "Performance Comparison").

use crate::coverage;
use crate::scenario::{
    ChargerDocument, CoverageDocument, Document, FORMAT, Objective, RequestDocument, Scenario,
    ScenarioError, SensorDocument,
};

use super::GenerateError;
use super::draw::{Draw, round};
use super::options::{at_most, below, count, id, not_negative, positive, sensor_at, share, side};

/// Options of [`k_coverage`]; the defaults are the paper's.
#[derive(Clone, Debug, PartialEq)]
pub struct KCoverage {
    /// Sensors, uniform in the field (paper: 32 to 80).
    pub sensors: u32,
    /// Covers that every point of the field has and must keep (paper: 2 to 4).
    pub k: u32,
    /// A sensor asks when its residual energy is at most this share of its battery
    /// (paper: 0.2 to 0.8).
    pub alpha: f64,
    /// Side of the square field, in metres.
    pub side_m: f64,
    /// Sensing range, in metres.
    pub range_m: f64,
    /// Capacity of a battery, in joules.
    pub battery_j: f64,
    /// Residual energies lie above this, in joules.
    pub residual_above_j: f64,
    /// Least consumption. The paper takes records of real sensors; these two bound a uniform draw.
    pub drain_min_w: f64,
    /// Greatest consumption.
    pub drain_max_w: f64,
    /// Speed of the charger.
    pub speed_mps: f64,
    /// Energy travelled per metre.
    pub travel_jpm: f64,
    /// Charging power.
    pub transfer_w: f64,
    /// Deployments drawn at most until one is k-covered.
    pub attempts: u32,
}

impl Default for KCoverage {
    fn default() -> Self {
        Self {
            sensors: 48,
            k: 3,
            alpha: 0.45,
            side_m: 500.0,
            range_m: 135.0,
            battery_j: 10_800.0,
            residual_above_j: 540.0,
            drain_min_w: 0.2,
            drain_max_w: 0.6,
            speed_mps: 5.0,
            travel_jpm: 600.0,
            transfer_w: 20.0,
            attempts: 1_000_000,
        }
    }
}

/// A scenario of the preset `k_coverage`: the shortest tour that keeps every point covered k times.
/// All sensors together cover every point k times.
///
/// # Errors
/// The first option that is out of its range, or no deployment within the attempts.
pub fn k_coverage(options: &KCoverage, seed: u64) -> Result<Document, GenerateError> {
    validate(options)?;
    let mut draw = Draw::new(seed);
    let mut document = deploy(options, seed, &mut draw)?;
    let residuals: Vec<f64> = (0..options.sensors)
        .map(|_| draw.above(options.residual_above_j, options.battery_j))
        .collect();
    for (i, residual_j) in residuals.into_iter().enumerate() {
        let drain_w = draw.between(options.drain_min_w, options.drain_max_w);
        if residual_j <= options.alpha * options.battery_j {
            document.requests.push(RequestDocument {
                sensor: id(i),
                ready_s: None,
                deadline_s: Some(round(residual_j / drain_w)),
                residual_j: Some(residual_j),
                drain_w: Some(drain_w),
                reward: None,
                required: None,
            });
        }
    }
    Scenario::from_document(&document)?;
    Ok(document)
}

/// Draws deployments until one is k-covered; a document without requests.
fn deploy(options: &KCoverage, seed: u64, draw: &mut Draw) -> Result<Document, GenerateError> {
    let &KCoverage { sensors, k, attempts, .. } = options;
    for _ in 0..attempts {
        let places: Vec<_> = (0..sensors).map(|_| draw.place(options.side_m)).collect();
        if !may_be_covered(options, &places) {
            continue;
        }
        let document = without_requests(options, seed, &places);
        if is_covered(&document, k)? {
            return Ok(document);
        }
    }
    Err(GenerateError::NotCovered { attempts, sensors, k })
}

/// Whether all of a lattice of points have k covers. Most deployments fail here, at little cost:
/// near a point that k disks do not reach, there is ground that they do not reach either.
fn may_be_covered(options: &KCoverage, places: &[[f64; 2]]) -> bool {
    const STEPS: u32 = 16;
    let at = |step: u32| options.side_m * f64::from(step) / f64::from(STEPS);
    let covers = |x: f64, y: f64| {
        let reach = |place: &&[f64; 2]| (place[0] - x).hypot(place[1] - y) <= options.range_m;
        places.iter().filter(reach).take(options.k as usize).count() as u32
    };
    // Corners first: they have the fewest neighbours.
    let corners = [(0, 0), (0, STEPS), (STEPS, 0), (STEPS, STEPS)];
    let lattice = (0..=STEPS).flat_map(|i| (0..=STEPS).map(move |j| (i, j)));
    corners.into_iter().chain(lattice).all(|(i, j)| covers(at(i), at(j)) >= options.k)
}

/// Whether every sub-region has k covers, exactly.
fn is_covered(document: &Document, k: u32) -> Result<bool, ScenarioError> {
    let scenario = Scenario::from_document(document)?;
    let regions = coverage::regions(&scenario);
    Ok(regions.iter().all(|region| region.covering.len() >= k as usize))
}

fn without_requests(options: &KCoverage, seed: u64, places: &[[f64; 2]]) -> Document {
    let &KCoverage { sensors: n, k, alpha, side_m: side, .. } = options;
    let sensor = |(i, place): (usize, &[f64; 2])| SensorDocument {
        range_m: Some(options.range_m),
        ..sensor_at(i, *place, options.battery_j)
    };
    Document {
        format: FORMAT.to_owned(),
        name: Some(format!("k_coverage-n{n}-k{k}-a{alpha}-s{seed}")),
        objective: Objective::MinDistance,
        charger: ChargerDocument {
            start_m: [side / 2.0, side / 2.0],
            end_m: None,
            speed_mps: options.speed_mps,
            travel_jpm: options.travel_jpm,
            transfer_w: options.transfer_w,
            capacity_j: None,
            timespan_s: None,
        },
        charge_level: None,
        coverage: Some(CoverageDocument {
            k: f64::from(k),
            field_m: vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]],
        }),
        sensors: places.iter().enumerate().map(sensor).collect(),
        requests: Vec::new(),
        travel: None,
    }
}

fn validate(options: &KCoverage) -> Result<(), GenerateError> {
    count("sensors", options.sensors)?;
    count("k", options.k)?;
    at_most("k", f64::from(options.k), "sensors", f64::from(options.sensors))?;
    share("alpha", options.alpha)?;
    side("side_m", options.side_m)?;
    positive("range_m", options.range_m)?;
    positive("battery_j", options.battery_j)?;
    not_negative("residual_above_j", options.residual_above_j)?;
    below("residual_above_j", options.residual_above_j, "battery_j", options.battery_j)?;
    positive("drain_min_w", options.drain_min_w)?;
    positive("drain_max_w", options.drain_max_w)?;
    at_most("drain_min_w", options.drain_min_w, "drain_max_w", options.drain_max_w)?;
    positive("speed_mps", options.speed_mps)?;
    not_negative("travel_jpm", options.travel_jpm)?;
    positive("transfer_w", options.transfer_w)?;
    positive("attempts", f64::from(options.attempts))
}
