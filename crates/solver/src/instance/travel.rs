//! Distances between places at rest: candidates 0 to n - 1, then start (n) and end (n + 1).

use super::Candidate;
use crate::scenario::{Point, Scenario};

/// Beyond this many candidates Euclidean distances are computed when asked: the points stay in the
/// cache, a dense matrix would not.
const DENSE: usize = 500;

/// Travel distances in metres.
#[derive(Clone, Debug)]
pub enum Travel {
    /// Row to column.
    Dense {
        /// Candidates plus two.
        size: usize,
        /// Row by row.
        distance_m: Vec<f64>,
    },
    /// Euclidean, on demand.
    Points(Vec<Point>),
}

impl Travel {
    pub(super) fn new(scenario: &Scenario, candidates: &[Candidate]) -> Self {
        let size = candidates.len() + 2;
        if let Some(matrix) = &scenario.travel {
            let rows: Vec<usize> = candidates.iter().map(|c| c.request + 2).chain([0, 1]).collect();
            let row = |&from: &usize| rows.iter().map(move |&to| matrix.get(from, to));
            return Self::Dense { size, distance_m: rows.iter().flat_map(row).collect() };
        }
        let ends = [scenario.charger.start_m, scenario.charger.end_m];
        let points: Vec<Point> = candidates.iter().map(|c| c.point).chain(ends).collect();
        if candidates.len() > DENSE {
            return Self::Points(points);
        }
        let row =
            |from: &Point| points.iter().map(move |to| (to - from).norm()).collect::<Vec<_>>();
        Self::Dense { size, distance_m: points.iter().flat_map(row).collect() }
    }

    /// Distance from one place to another, in metres.
    #[inline]
    pub fn distance_m(&self, from: usize, to: usize) -> f64 {
        match self {
            Self::Dense { size, distance_m } => distance_m[from * size + to],
            Self::Points(points) => (points[to] - points[from]).norm(),
        }
    }

    /// The distances from a place to all, where they are tabled.
    #[inline]
    pub fn row_m(&self, from: usize) -> Option<&[f64]> {
        match self {
            Self::Dense { size, distance_m } => Some(&distance_m[from * size..(from + 1) * size]),
            Self::Points(_) => None,
        }
    }

    /// Whether every distance between candidates is the same both ways.
    pub(super) fn is_symmetric(&self) -> bool {
        let Self::Dense { size, .. } = self else { return true };
        let pairs = (0..size - 2).flat_map(|a| (0..a).map(move |b| (a, b)));
        pairs.into_iter().all(|(a, b)| self.distance_m(a, b) == self.distance_m(b, a))
    }
}
