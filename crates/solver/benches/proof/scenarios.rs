//! The scenarios: drawn with fixed seeds over the settings of the paper's simulations.

use std::error::Error;

use voltour_solver::generate::{GenerateError, KCoverage, Reward, k_coverage, reward};
use voltour_solver::instance::Instance;
use voltour_solver::scenario::{Document, Scenario};

/// Settings of k-coverage: sensors, covers, the share of the battery below which a sensor asks, scenarios.
const K_COVERAGE: [(u32, u32, f64, usize); 14] = [
    (48, 3, 0.45, 3),
    (64, 3, 0.45, 3),
    (72, 3, 0.45, 3),
    (80, 3, 0.45, 3),
    (64, 2, 0.45, 3),
    (64, 4, 0.45, 3),
    (32, 2, 0.2, 1),
    (32, 2, 0.4, 1),
    (32, 2, 0.6, 1),
    (32, 2, 0.8, 1),
    (48, 3, 0.2, 1),
    (48, 3, 0.4, 1),
    (48, 3, 0.6, 1),
    (48, 3, 0.8, 1),
];

/// Settings of reward: sensors, all of which ask, capacity in joules, scenarios.
const REWARD: [(u32, f64, usize); 2] = [(50, 300_000.0, 2), (100, 300_000.0, 2)];

/// All 30, with their names, or those whose names contain a text.
pub fn scenarios(only: &str) -> Result<Vec<(String, Scenario)>, Box<dyn Error>> {
    let mut found = Vec::new();
    for document in coverage_documents().chain(reward_documents()) {
        let document = document?;
        let name = document.name.clone().unwrap_or_default();
        if name.contains(only) {
            found.push((name, Scenario::from_document(&document)?));
        }
    }
    if found.is_empty() {
        return Err(format!("no scenario's name contains {only:?}").into());
    }
    Ok(found)
}

/// The first scenarios of each setting in which somebody must be charged: without a demand the best tour
/// is none, and there is nothing to time.
fn coverage_documents() -> impl Iterator<Item = Result<Document, GenerateError>> {
    K_COVERAGE.into_iter().flat_map(|(sensors, k, alpha, count)| {
        let options = KCoverage { sensors, k, alpha, ..KCoverage::default() };
        let drawn = (0..).map(move |seed| k_coverage(&options, seed));
        drawn.filter(|document| document.as_ref().map_or(true, has_demand)).take(count)
    })
}

fn reward_documents() -> impl Iterator<Item = Result<Document, GenerateError>> {
    REWARD.into_iter().flat_map(|(sensors, capacity_j, count)| {
        let options = Reward { sensors, capacity_j, alpha: 1.0, ..Reward::default() };
        (0..count as u64).map(move |seed| reward(&options, seed))
    })
}

fn has_demand(document: &Document) -> bool {
    let scenario = Scenario::from_document(document);
    scenario.is_ok_and(|scenario| !Instance::new(&scenario).demands.demands.is_empty())
}
