//! [`Rule`]: the control, a Q-function without learning.

use crate::policy::{Batch, FEATURES, Feature, Problem, QError, QFunction};

/// What a stop that a demand cannot do without is worth beside any detour.
const MUST: f32 = 100.0;

/// The untrained rule: cheapest feasible insertion, stops that a demand cannot do without first; most gain for
/// effort where gains count.
#[derive(Clone, Copy, Debug)]
pub struct Rule(pub Problem);

impl QFunction for Rule {
    fn values(&self, batch: &Batch) -> Result<Vec<f32>, QError> {
        let value = |row: &[f32]| {
            let of = |feature: Feature| row[feature.column()];
            let must = MUST * of(Feature::Must);
            must + match self.0 {
                Problem::KCoverage => -of(Feature::Detour),
                // The ratio r itself: the feature is r / (1 + r).
                Problem::Reward | Problem::Mobile => {
                    of(Feature::Ratio) / (1.0 - of(Feature::Ratio)).max(1e-6)
                }
            }
        };
        Ok(batch.nodes.chunks_exact(FEATURES).map(value).collect())
    }

    fn reads_ahead(&self) -> bool {
        false
    }
}
