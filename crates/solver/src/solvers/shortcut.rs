//! A legal tour to begin with where the empty trip is none.
//!
//! Without the triangle inequality a stop may be a short cut to the end, in time or in energy.

use crate::instance::Instance;
use crate::tour::{Run, simulate};

/// The empty tour if it keeps the limits; else a legal one, if a search for a short cut finds it; else
/// the empty tour.
pub fn legal_start(instance: &Instance<'_>) -> Vec<u32> {
    let empty = instance.finish(&instance.departure());
    if instance.keeps_limits(&empty) || instance.metric || instance.moving {
        return Vec::new();
    }
    // From all weight on time to all weight on energy.
    let shares = (0..=8).map(|i| f64::from(i) / 8.0);
    let paths = shares.map(|share| shortest(instance, share));
    paths.into_iter().find(|order| simulate(instance, order).1).unwrap_or_default()
}

/// Dijkstra's algorithm over the candidates that are reached in time, by a mean of time and energy,
/// each as a share of its limit. By time alone it is exact: being early is never worse.
fn shortest(instance: &Instance<'_>, energy_share: f64) -> Vec<u32> {
    let share =
        |value: f64, limit: f64| if limit.is_finite() { value / limit.max(1e-9) } else { 0.0 };
    let cost = |run: &Run| {
        let time = share(run.depart_s, instance.timespan_s);
        let energy = share(instance.energy_j(run), instance.capacity_j);
        // A little time breaks ties, and is all there is where nothing bounds it.
        (1.0 - energy_share) * time + energy_share * energy + 1e-12 * run.depart_s
    };
    let size = instance.len();
    let mut best: Vec<Option<(Run, Option<u32>)>> = vec![None; size];
    let mut done = vec![false; size];
    let mut at = (instance.departure(), None);
    let mut end: (f64, Option<u32>) = (f64::INFINITY, None);
    loop {
        let finish = cost(&instance.finish(&at.0));
        if finish < end.0 {
            end = (finish, at.1);
        }
        for to in 0..size as u32 {
            if done[to as usize] {
                continue;
            }
            let run = instance.step(&at.0, to);
            let better = best[to as usize].is_none_or(|(old, _)| cost(&run) < cost(&old));
            if instance.in_time(&run) && better {
                best[to as usize] = Some((run, at.1));
            }
        }
        let open = (0..size as u32).filter(|&c| !done[c as usize]);
        let open = open.filter_map(|c| best[c as usize].map(|(run, _)| (c, run)));
        let next = open.min_by(|a, b| cost(&a.1).total_cmp(&cost(&b.1)));
        let Some((candidate, run)) = next else { break };
        done[candidate as usize] = true;
        at = (run, Some(candidate));
    }
    let mut order = Vec::new();
    let mut last = end.1;
    while let Some(candidate) = last {
        order.push(candidate);
        last = best[candidate as usize].and_then(|(_, before)| before);
    }
    order.reverse();
    order
}
