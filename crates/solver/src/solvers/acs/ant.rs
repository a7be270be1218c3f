//! One agent: its walk, and the transition rule with the two deadline heuristics.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::AcsOptions;
use super::trail::Trail;
use crate::instance::Instance;
use crate::tour::Run;

/// An agent under way: where it is, and what the table T still asks.
pub struct Ant<'a, 'b> {
    instance: &'a Instance<'b>,
    here: Run,
    order: Vec<u32>,
    visited: Vec<bool>,
    lacks: Vec<u32>,
}

/// A sensor that an ant may go to.
struct Open {
    candidate: u32,
    leg_m: f64,
    slack_s: f64,
    wait_s: f64,
}

impl<'a, 'b> Ant<'a, 'b> {
    /// At the start, nothing visited.
    pub fn new(instance: &'a Instance<'b>) -> Self {
        Self {
            instance,
            here: instance.departure(),
            order: Vec::new(),
            visited: vec![false; instance.len()],
            lacks: instance.demands.demands.iter().map(|demand| demand.needs).collect(),
        }
    }

    /// Walks until the coverage is kept, or it is stuck.
    pub fn walk(mut self, options: &AcsOptions, trail: &Trail, rng: &mut Pcg64Mcg) -> Vec<u32> {
        loop {
            let open = self.open();
            let scores = scores(&open, options, trail, self.here.node as usize);
            let Some(next) = choose(&scores, options.q0, rng) else { return self.order };
            let candidate = open[next].candidate;
            self.here = self.instance.step(&self.here, candidate);
            self.order.push(candidate);
            self.visited[candidate as usize] = true;
            for &d in &self.instance.demands.of[candidate as usize] {
                self.lacks[d as usize] = self.lacks[d as usize].saturating_sub(1);
            }
        }
    }

    /// The sensors that help, are reached before their deadlines, and leave a way to the end.
    fn open(&self) -> Vec<Open> {
        let instance = self.instance;
        let helps =
            |c: u32| instance.demands.of[c as usize].iter().any(|&d| self.lacks[d as usize] > 0);
        let ahead = (0..instance.len() as u32).filter(|&c| !self.visited[c as usize] && helps(c));
        let open = ahead.filter_map(|candidate| {
            let there = instance.step(&self.here, candidate);
            let leg_m = there.distance_m - self.here.distance_m;
            let leg_s = leg_m / instance.scenario.charger.speed_mps;
            let legal = instance.in_time(&there) && instance.keeps_limits(&instance.finish(&there));
            legal.then(|| Open {
                candidate,
                leg_m,
                slack_s: instance.candidates[candidate as usize].due_s - there.arrive_s,
                wait_s: (there.arrive_s - self.here.depart_s - leg_s).max(0.0),
            })
        });
        open.collect()
    }
}

/// Pheromone x nearness^beta x the two deadline heuristics, by open sensor.
fn scores(open: &[Open], options: &AcsOptions, trail: &Trail, from: usize) -> Vec<f64> {
    let mean = |of: &dyn Fn(&Open) -> f64| {
        let finite: Vec<f64> = open.iter().map(of).filter(|value| value.is_finite()).collect();
        (finite.iter().sum::<f64>() / finite.len().max(1) as f64).max(1e-9)
    };
    let (mean_slack, mean_wait) = (mean(&|open| open.slack_s), mean(&|open| open.wait_s));
    let falling = |steepness: f64, value: f64, mean: f64| {
        // However unattractive, it stays possible.
        (1.0 / (1.0 + (steepness * (value - mean) / mean).exp())).max(1e-6)
    };
    let score = |open: &Open| {
        let urgency = falling(options.slack, open.slack_s, mean_slack);
        let patience =
            if open.wait_s > 0.0 { falling(options.wait, open.wait_s, mean_wait) } else { 1.0 };
        let nearness = (1.0 / open.leg_m.max(1e-3)).powf(options.beta);
        trail.of(from, open.candidate as usize) * nearness * urgency * patience
    };
    open.iter().map(score).collect()
}

/// The transition rule: the best with probability `q0`, else one at random in proportion to its score.
fn choose(scores: &[f64], q0: f64, rng: &mut Pcg64Mcg) -> Option<usize> {
    let best = (0..scores.len()).reduce(|a, b| if scores[b] > scores[a] { b } else { a })?;
    if rng.random_range(0.0..1.0) < q0 {
        return Some(best);
    }
    let total: f64 = scores.iter().sum();
    let mut left = rng.random_range(0.0..1.0) * total;
    let chosen = scores.iter().position(|score| {
        left -= score;
        left < 0.0
    });
    Some(chosen.unwrap_or(best))
}
