//! How exploration and the learning rate change over a run.

use super::Options;

/// Epsilon after a share `done` of the steps: falls linearly, then stays.
pub fn epsilon(options: &Options, done: f64) -> f64 {
    let along = (done / options.explore.max(f64::MIN_POSITIVE)).min(1.0);
    options.epsilon_start + (options.epsilon_end - options.epsilon_start) * along
}

/// The learning rate after a share `done` of the steps: constant, then linear to its end.
pub fn learning_rate(options: &Options, done: f64) -> f64 {
    let falling = (1.0 - options.hold).max(f64::MIN_POSITIVE);
    let along = ((done - options.hold) / falling).clamp(0.0, 1.0);
    options.learning_rate * (1.0 - along * (1.0 - options.rate_end))
}
