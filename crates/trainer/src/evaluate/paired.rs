//! [`Paired`]: two methods on the same scenarios with the same seeds.

/// A gap that differs by less is the same.
const SAME: f64 = 1e-9;
/// Quantile of the normal distribution: an interval of so many standard errors either side holds in 95 % of cases.
const ERRORS: f64 = 1.96;

/// How a method's gaps compare with another's.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Paired {
    /// By scenario that both solved with some seed, the method's gap less the other's: the mean over those seeds.
    differences: Vec<f64>,
    /// Runs with a smaller gap than the other's, or that alone solved their scenario.
    pub better: usize,
    /// Runs with the same gap.
    pub equal: usize,
    /// Runs with a larger gap, or where the other alone solved the scenario.
    pub worse: usize,
}

impl Paired {
    /// Adds a scenario: by seed, the gap of the method and the other's, as shares; `None` is unsolved.
    pub fn add(&mut self, runs: impl IntoIterator<Item = (Option<f64>, Option<f64>)>) {
        let mut both = Vec::new();
        for run in runs {
            let difference = match run {
                (Some(gap), Some(other)) => {
                    both.push(gap - other);
                    gap - other
                }
                (Some(_), None) => f64::NEG_INFINITY,
                (None, Some(_)) => f64::INFINITY,
                (None, None) => 0.0,
            };
            match difference {
                d if d < -SAME => self.better += 1,
                d if d > SAME => self.worse += 1,
                _ => self.equal += 1,
            }
        }
        if !both.is_empty() {
            self.differences.push(mean(&both));
        }
    }

    /// Mean difference over the scenarios, as a share: below 0 where the method is better.
    pub fn mean(&self) -> f64 {
        mean(&self.differences)
    }

    /// The mean over all such scenarios is within so much of [`Self::mean`] in 95 % of cases. Seeds do not make
    /// scenarios, so that more of them alone do not make this 0. Infinite for fewer than two scenarios.
    pub fn margin(&self) -> f64 {
        let (count, mean) = (self.differences.len() as f64, self.mean());
        if count < 2.0 {
            return f64::INFINITY;
        }
        let squares: f64 = self.differences.iter().map(|d| (d - mean).powi(2)).sum();
        ERRORS * (squares / (count - 1.0) / count).sqrt()
    }
}

/// 0 of none.
pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}
