//! The least spanning tree over what must be visited, under potentials that make it a path.
//!
//! Held and Karp (1970): a tour without its start and end is a path, a path is a spanning tree, and
//! adding a potential to both legs at each place changes all tours alike, trees not. Where one of
//! several candidates must be visited, the set is one place, as near to others as its nearest member:
//! a tour that makes only one stop in each set is no longer, for no detour is shorter than the way itself.

use super::Places;

/// Neighbours among which the ascent looks for its trees.
const NEAR: usize = 10;
/// Edges looked at in the ascent, and its steps at most.
const WORK: usize = 2_500_000;
const MOST_STEPS: usize = 400;
/// How often the trees of all edges are asked which edges the ascent lacks.
const ROUNDS: usize = 4;

/// No tour from `start` to `end` that meets each of these sets is shorter, in metres.
pub fn spanning(
    places: &Places,
    sets: &[Vec<u32>],
    start: usize,
    end: usize,
    incumbent_m: f64,
) -> f64 {
    let least = |set: &[u32], way: &dyn Fn(usize) -> f64| {
        set.iter().map(|&i| way(i as usize)).fold(f64::INFINITY, f64::min)
    };
    let detour = |i: usize| places.least_m(start, i) + places.least_m(i, end);
    let single = sets.iter().map(|set| least(set, &detour)).fold(0.0, f64::max);
    let bound = single.max(places.least_m(start, end));
    if sets.len() < 2 {
        return bound;
    }
    let between = |a: &[u32], b: &[u32]| least(a, &|i| least(b, &|j| places.least_m(i, j)));
    let m = sets.len();
    let mut way = vec![0.0; m * m];
    for a in 0..m {
        for b in 0..a {
            let least = between(&sets[a], &sets[b]);
            (way[a * m + b], way[b * m + a]) = (least, least);
        }
    }
    let ends = [start, end]
        .map(|place| sets.iter().map(|set| least(set, &|i| places.least_m(place, i))).collect());
    let mut tree = Tree { m, way, ends, edges: Vec::new() };
    bound.max(tree.ascend(incumbent_m))
}

/// An edge of the ascent, and what it costs under the potentials.
#[derive(Clone, Copy, Debug)]
struct Edge {
    ends: [u32; 2],
    way: f64,
    cost: f64,
}

struct Tree {
    m: usize,
    way: Vec<f64>,
    /// By end of the tour, the ways to each set.
    ends: [Vec<f64>; 2],
    edges: Vec<Edge>,
}

impl Tree {
    fn ascend(&mut self, incumbent_m: f64) -> f64 {
        let m = self.m;
        let mut potential = vec![0.0; m];
        self.near();
        let mut best = self.whole(&potential);
        let steps = (WORK / self.edges.len().max(1)).clamp(20, MOST_STEPS);
        let first = 0.5 * best / m as f64;
        let (mut before, mut top, mut at) = (vec![0.0; m], potential.clone(), f64::NEG_INFINITY);
        for step in 0..steps {
            let (value, degrees) = self.part(&potential);
            if value > at {
                at = value;
                top.clone_from(&potential);
            }
            if (step + 1) % steps.div_ceil(ROUNDS) == 0 || step + 1 == steps {
                best = best.max(self.whole(&top));
                if best >= incumbent_m {
                    break;
                }
                at = f64::NEG_INFINITY;
            }
            let size = first * 0.003_f64.powf(step as f64 / steps as f64);
            for a in 0..m {
                let slope = 2.0 - f64::from(degrees[a]);
                potential[a] += size * (0.7 * slope + 0.3 * before[a]);
                before[a] = slope;
            }
        }
        best
    }

    /// The edges to the nearest others.
    fn near(&mut self) {
        let m = self.m;
        let k = NEAR.min(m - 1);
        for a in 0..m {
            let row = &self.way[a * m..(a + 1) * m];
            let mut others: Vec<u32> = (0..m as u32).filter(|&b| b as usize != a).collect();
            let by =
                |x: &u32, y: &u32| row[*x as usize].total_cmp(&row[*y as usize]).then(x.cmp(y));
            others.select_nth_unstable_by(k - 1, by);
            let new = others[..k].iter().map(|&b| (a as u32, b));
            let new: Vec<Edge> = new.map(|(a, b)| self.edge(a, b)).collect();
            self.edges.extend(new);
        }
        self.tidy();
    }

    fn edge(&self, a: u32, b: u32) -> Edge {
        let way = self.way[a as usize * self.m + b as usize];
        Edge { ends: [a.min(b), a.max(b)], way, cost: way }
    }

    fn tidy(&mut self) {
        self.edges.sort_unstable_by_key(|edge| edge.ends);
        self.edges.dedup_by_key(|edge| edge.ends);
    }

    /// The bound by the least tree of all edges (Prim 1957), which join those of the ascent.
    fn whole(&mut self, potential: &[f64]) -> f64 {
        let m = self.m;
        let mut from = vec![0u32; m];
        let mut cost = vec![f64::INFINITY; m];
        let mut out: Vec<u32> = (1..m as u32).collect();
        let (mut here, mut total) = (0usize, 0.0);
        while !out.is_empty() {
            let row = &self.way[here * m..(here + 1) * m];
            let (mut next, mut least) = (0, f64::INFINITY);
            for (k, &b) in out.iter().enumerate() {
                let b = b as usize;
                let new = row[b] - potential[here] - potential[b];
                if new < cost[b] {
                    (cost[b], from[b]) = (new, here as u32);
                }
                if cost[b] < least {
                    (next, least) = (k, cost[b]);
                }
            }
            here = out.swap_remove(next) as usize;
            total += least;
            let edge = self.edge(from[here], here as u32);
            self.edges.push(edge);
        }
        self.tidy();
        let (ends, _) = self.both_ends(potential);
        let sum: f64 = potential.iter().sum();
        let size: f64 = potential.iter().map(|p| p.abs()).sum();
        total + ends + 2.0 * sum - 1e-12 * (1.0 + total.abs() + size) * (1.0 + m as f64).sqrt()
    }

    /// The least tree of the ascent's edges (Kruskal 1956), and how many legs each set has.
    fn part(&mut self, potential: &[f64]) -> (f64, Vec<u32>) {
        for edge in &mut self.edges {
            let [a, b] = edge.ends;
            edge.cost = edge.way - potential[a as usize] - potential[b as usize];
        }
        self.edges.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        let mut of: Vec<u32> = (0..self.m as u32).collect();
        let mut degrees = vec![0; self.m];
        let (mut total, mut open) = (0.0, self.m - 1);
        for edge in &self.edges {
            let [a, b] = edge.ends.map(|end| find(&mut of, end));
            if a != b {
                of[a as usize] = b;
                total += edge.cost;
                edge.ends.iter().for_each(|&end| degrees[end as usize] += 1);
                open -= 1;
                if open == 0 {
                    break;
                }
            }
        }
        let (ends, met) = self.both_ends(potential);
        met.iter().for_each(|&a| degrees[a] += 1);
        (total + ends + 2.0 * potential.iter().sum::<f64>(), degrees)
    }

    /// The cheapest legs from the start and to the end; they do not meet the same set, as there are two.
    fn both_ends(&self, potential: &[f64]) -> (f64, [usize; 2]) {
        let two = [0, 1].map(|end: usize| {
            let cost = |a: usize| self.ends[end][a] - potential[a];
            let mut two = [(f64::INFINITY, 0); 2];
            for a in 0..self.m {
                let new = (cost(a), a);
                if new.0 < two[0].0 {
                    two = [new, two[0]];
                } else if new.0 < two[1].0 {
                    two[1] = new;
                }
            }
            two
        });
        let [out, back] = two;
        if out[0].1 != back[0].1 {
            return (out[0].0 + back[0].0, [out[0].1, back[0].1]);
        }
        let (other_out, other_back) = (out[1].0 + back[0].0, out[0].0 + back[1].0);
        if other_out < other_back {
            (other_out, [out[1].1, back[0].1])
        } else {
            (other_back, [out[0].1, back[1].1])
        }
    }
}

/// The representative of the tree that holds a set, the ways to it halved.
fn find(of: &mut [u32], mut a: u32) -> u32 {
    while of[a as usize] != a {
        of[a as usize] = of[of[a as usize] as usize];
        a = of[a as usize];
    }
    a
}
