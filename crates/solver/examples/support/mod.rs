//! What the examples share: scenarios by the name of a cell, and a clock.
#![allow(dead_code, clippy::unwrap_used)]

use std::time::Instant;

use voltour_solver::generate::{KCoverage, Mobile, Reward, k_coverage, mobile, reward};
use voltour_solver::scenario::Document;

/// A scenario of a cell: `n/k/alpha` (k-coverage), `reward/n/capacity` with every sensor asking, or
/// `mobile/n` with, if given, `/timespan`.
pub fn draw(cell: &str, seed: u64) -> Document {
    let parts: Vec<&str> = cell.split('/').collect();
    let number = |i: usize| parts[i].parse::<f64>().unwrap();
    let timespan_s = if parts.len() > 2 { number(2) } else { Mobile::default().timespan_s };
    match parts[0] {
        "reward" => reward(
            &Reward {
                sensors: number(1) as u32,
                capacity_j: number(2),
                alpha: 1.0,
                ..Reward::default()
            },
            seed,
        ),
        "mobile" => {
            mobile(&Mobile { sensors: number(1) as u32, timespan_s, ..Mobile::default() }, seed)
        }
        _ => k_coverage(
            &KCoverage {
                sensors: number(0) as u32,
                k: number(1) as u32,
                alpha: number(2),
                ..KCoverage::default()
            },
            seed,
        ),
    }
    .unwrap()
}

/// Seconds of processor time of this thread where the system tells it, so that a busy machine measures
/// the same; else seconds since `begin`.
pub fn spent(begin: Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = text.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| begin.elapsed().as_secs_f64(), |nanoseconds| nanoseconds / 1e9)
}
