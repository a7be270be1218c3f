//! What relaxed paths are paid and charged beside what they cost.

use super::network::Arc;

/// The prices under which paths are looked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Prices {
    /// By candidate, what a visit takes off the cost.
    pub prizes: Vec<f64>,
    /// What a joule costs.
    pub per_j: f64,
}

impl Prices {
    /// What following an arc costs.
    #[inline]
    pub fn of(&self, arc: &Arc) -> f64 {
        arc.cost + self.per_j * arc.energy_j - self.prizes[arc.to as usize]
    }
}
