//! The pheromone.

use crate::instance::Instance;
use crate::solvers::{Budget, greedy};
use crate::tour::Tour;

/// The pheromone of every edge, row to column; start and end are the two places behind the candidates.
pub struct Trail {
    size: usize,
    initial: f64,
    amount: Vec<f64>,
}

impl Trail {
    /// 1 / (n L) on each edge, L being the length of the tour that always goes to the nearest.
    pub fn new(instance: &Instance<'_>) -> Self {
        let size = instance.len() + 2;
        let order = greedy::nearest(instance, false, &mut Budget::new(&|_| false));
        let length_m = Tour::new(instance, &order).finished().distance_m;
        let initial = 1.0 / (size as f64 * length_m.max(1.0));
        Self { size, initial, amount: vec![initial; size * size] }
    }

    /// The pheromone of an edge.
    pub fn of(&self, from: usize, to: usize) -> f64 {
        self.amount[from * self.size + to]
    }

    /// The edges of a tour, as indices.
    fn edges(&self, order: &[u32]) -> Vec<usize> {
        let (start, end) = (self.size - 2, self.size - 1);
        let stops = || order.iter().map(|&stop| stop as usize);
        let from = std::iter::once(start).chain(stops());
        from.zip(stops().chain([end])).map(|(from, to)| from * self.size + to).collect()
    }

    /// The local update: towards the initial amount on the edges that an ant took.
    pub fn evaporate(&mut self, order: &[u32], decay: f64) {
        for edge in self.edges(order) {
            self.amount[edge] = (1.0 - decay) * self.amount[edge] + decay * self.initial;
        }
    }

    /// The global update (equations Deltatau_ij and tau_ij): all edges decay, those of the shortest tour gain.
    pub fn reinforce(&mut self, shortest: &[u32], length_m: f64, decay: f64) {
        self.amount.iter_mut().for_each(|amount| *amount *= 1.0 - decay);
        for edge in self.edges(shortest) {
            self.amount[edge] += decay / length_m.max(1.0);
        }
    }
}
