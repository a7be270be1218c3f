//! Parameters of the ant colony system.

/// Parameters of the colony. The paper names none; these are those of Dorigo and Gambardella, but for `q0`: with
/// their 0.9 more scenarios are left without a feasible tour (32 sensors, k 2, alpha 0.8: 9 of 12 have one, and
/// 11 with 0.5).
#[derive(Clone, Debug, PartialEq)]
pub struct AcsOptions {
    /// Colonies, one after the other, each without pheromone; the best tour of all is kept.
    pub runs: u32,
    /// Iterations of a colony at most.
    pub iterations: u32,
    /// Iterations without a better tour after which a colony ends.
    pub patience: u32,
    /// Ants in an iteration.
    pub ants: u32,
    /// Exponent of the nearness.
    pub beta: f64,
    /// Share of the steps that take the best edge rather than a random one.
    pub q0: f64,
    /// Global pheromone decay (theta).
    pub decay: f64,
    /// Local pheromone decay.
    pub local_decay: f64,
    /// Steepness of the first deadline heuristic: little slack is attractive.
    pub slack: f64,
    /// Steepness of the second: a long wait is not.
    pub wait: f64,
}

impl Default for AcsOptions {
    fn default() -> Self {
        Self {
            runs: 5,
            iterations: 1_000,
            patience: 200,
            ants: 10,
            beta: 2.0,
            q0: 0.5,
            decay: 0.1,
            local_decay: 0.1,
            slack: 1.0,
            wait: 1.0,
        }
    }
}
