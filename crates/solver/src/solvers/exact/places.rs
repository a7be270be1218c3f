//! Who a tour can reach at all, and what the ways between places measure at least whichever other stops
//! lie on them: what every quick bound is made of.

use super::Model;
use crate::instance::Instance;
use crate::scenario::{Place, Point};

/// Beyond this many candidates, the shortest ways through a matrix without the triangle inequality are
/// not worked out.
const CLOSED: usize = 400;

/// Least ways, the same in both directions.
#[derive(Debug)]
enum Ways {
    /// Straight lines between places at rest.
    Points(Vec<Point>),
    /// Straight lines between the boxes that trajectories stay in: the way is one line through the places
    /// where sensors are met, whatever the times.
    Boxes(Vec<(Point, Point)>),
    /// Row by row, over any stops between.
    Matrix(Vec<f64>),
    /// Nothing is known.
    Unknown,
}

/// The candidates that a tour can serve, and the least ways between them.
#[derive(Debug)]
pub struct Places {
    ways: Ways,
    size: usize,
    /// Candidates that some tour within the limits may serve.
    pub open: Vec<u32>,
    /// By candidate, energy delivered there at least, in joules.
    pub charge_j: Vec<f64>,
}

impl Places {
    pub fn new(model: &Model<'_>) -> Self {
        let instance = &model.wide;
        let n = instance.len();
        let mut places =
            Self { ways: ways(model), size: n + 2, open: Vec::new(), charge_j: Vec::new() };
        let speed = instance.scenario.charger.speed_mps;
        for i in 0..n {
            let c = &instance.candidates[i];
            // The charger is faster than every sensor: nothing is met sooner by way of another.
            let earliest_s = if instance.moving {
                instance.step(&instance.departure(), i as u32).arrive_s
            } else {
                c.ready_s.max(places.least_m(instance.start(), i) / speed)
            };
            let charge_j = c.charge_j(earliest_s);
            places.charge_j.push(charge_j);
            let out_m = places.least_m(instance.start(), i);
            let back_m = places.least_m(i, instance.end());
            let end_s =
                earliest_s + charge_j / instance.scenario.charger.transfer_w + back_m / speed;
            let energy_j = charge_j + instance.scenario.charger.travel_jpm * (out_m + back_m);
            // Rounding must not shut out what just keeps a limit.
            let keeps = |value: f64, limit: f64| value <= limit + 1e-9 * (1.0 + limit.abs());
            if keeps(earliest_s, c.due_s)
                && keeps(end_s, instance.timespan_s)
                && keeps(energy_j, instance.capacity_j)
            {
                places.open.push(i as u32);
            }
        }
        places
    }

    /// What the way between two places measures at least, in metres.
    #[inline]
    pub fn least_m(&self, a: usize, b: usize) -> f64 {
        match &self.ways {
            Ways::Points(points) => (points[a] - points[b]).norm(),
            Ways::Boxes(boxes) => {
                let ((low, high), (other_low, other_high)) = (boxes[a], boxes[b]);
                let apart = |axis: usize| {
                    (low[axis] - other_high[axis]).max(other_low[axis] - high[axis]).max(0.0)
                };
                apart(0).hypot(apart(1))
            }
            Ways::Matrix(rows) => rows[a * self.size + b],
            Ways::Unknown => 0.0,
        }
    }
}

fn ways(model: &Model<'_>) -> Ways {
    let instance = &model.wide;
    let charger = &instance.scenario.charger;
    let ends = [charger.start_m, charger.end_m];
    if instance.metric {
        return Ways::Points(instance.candidates.iter().map(|c| c.point).chain(ends).collect());
    }
    if instance.moving {
        let boxes = (0..instance.len()).map(|i| surroundings(instance, i));
        return Ways::Boxes(boxes.chain(ends.map(|end| (end, end))).collect());
    }
    if model.direct || instance.len() <= CLOSED {
        return Ways::Matrix(closure(instance, model.direct));
    }
    Ways::Unknown
}

/// The box that a sensor never leaves.
fn surroundings(instance: &Instance<'_>, candidate: usize) -> (Point, Point) {
    let c = &instance.candidates[candidate];
    let sensor = instance.scenario.requests[c.request].sensor;
    match &instance.scenario.sensors[sensor].place {
        Place::Fixed(point) => (*point, *point),
        Place::Moving(trajectory) => {
            let places = trajectory.waypoints().iter().map(|row| row.position_m);
            places.fold((c.point, c.point), |(low, high), p| (low.inf(&p), high.sup(&p)))
        }
    }
}

/// The shortest ways over any candidates (Floyd 1962), the shorter direction of each.
fn closure(instance: &Instance<'_>, direct: bool) -> Vec<f64> {
    let (n, size) = (instance.len(), instance.len() + 2);
    let mut way = vec![0.0; size * size];
    for from in 0..size {
        for to in 0..size {
            way[from * size + to] = instance.distance_m(from, to);
        }
    }
    for over in (0..n).filter(|_| !direct) {
        for from in 0..size {
            let first = way[from * size + over];
            for to in 0..size {
                let through = first + way[over * size + to];
                let here = &mut way[from * size + to];
                *here = here.min(through);
            }
        }
    }
    let (start, end) = (n, n + 1);
    // No way leads to the start, or from the end.
    for i in 0..n {
        way[i * size + start] = way[start * size + i];
        way[end * size + i] = way[i * size + end];
    }
    way[end * size + start] = way[start * size + end];
    for a in 0..n {
        for b in 0..a {
            let least = way[a * size + b].min(way[b * size + a]);
            (way[a * size + b], way[b * size + a]) = (least, least);
        }
    }
    way
}
