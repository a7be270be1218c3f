//! Repair of missed deadlines: a stop that no legal place can take is put where it makes the tour least
//! late, and the order is mended until nobody is.
//!
//! The penalty is the sum of the lateness of all stops and of the end, brought down by moving one stop at a
//! time (1-shift), late stops to earlier places first: the constructive phase of R. Ferreira da Silva and
//! S. Urrutia, "A General VNS heuristic for the traveling salesman problem with time windows" (2010).
//! Deviations: (1) the first improving move is made, without their perturbation, for the ruin of the search is
//! one; (2) service times grow with the arrival, so every trial is simulated forward.

use crate::instance::Instance;

/// Longer tours are left to insertion: a pass costs the cube of the length.
pub const LONGEST: usize = 80;
/// Improving moves at most.
const MOVES: usize = 200;

/// The order with `newcomer` in it and all deadlines and the time span kept, if the descent gets there.
pub fn squeeze(instance: &Instance<'_>, order: &[u32], newcomer: u32) -> Option<Vec<u32>> {
    if order.len() >= LONGEST {
        return None;
    }
    let mut best = (f64::INFINITY, 0);
    let mut trial = order.to_vec();
    trial.insert(0, newcomer);
    for place in 0..trial.len() {
        if place > 0 {
            trial.swap(place - 1, place);
        }
        let late_s = lateness_s(instance, &trial, best.0);
        if late_s < best.0 {
            best = (late_s, place);
        }
    }
    // The newcomer stands last now.
    let (mut late_s, place) = best;
    trial[place..].rotate_right(1);
    for _ in 0..MOVES {
        if late_s <= 0.0 {
            return Some(trial);
        }
        late_s = shift(instance, &mut trial, late_s)?;
    }
    None
}

/// Makes the first move of one stop that lessens the lateness; none where no move does.
fn shift(instance: &Instance<'_>, order: &mut [u32], late_s: f64) -> Option<f64> {
    let late = late_stops(instance, order);
    // Late stops forward to an earlier place, stops in time backward to a later one, then the rest.
    for (wants_late, earlier) in [(true, true), (false, false), (false, true), (true, false)] {
        for from in (0..order.len()).filter(|&p| late[p] == wants_late) {
            let places = if earlier { 0..from } else { from + 1..order.len() };
            for to in places {
                relocate(order, from, to);
                let now_s = lateness_s(instance, order, late_s);
                if now_s < late_s {
                    return Some(now_s);
                }
                relocate(order, to, from);
            }
        }
    }
    None
}

fn relocate(order: &mut [u32], from: usize, to: usize) {
    if from < to {
        order[from..=to].rotate_left(1);
    } else {
        order[to..=from].rotate_right(1);
    }
}

fn late_stops(instance: &Instance<'_>, order: &[u32]) -> Vec<bool> {
    let mut run = instance.departure();
    let late = |&candidate: &u32| {
        run = instance.step(&run, candidate);
        !instance.in_time(&run)
    };
    order.iter().map(late).collect()
}

/// Sum of the lateness of the stops and of the end, in seconds; given up, as infinite, once it
/// reaches `enough_s`.
fn lateness_s(instance: &Instance<'_>, order: &[u32], enough_s: f64) -> f64 {
    let mut run = instance.departure();
    let mut late_s = 0.0;
    for &candidate in order {
        run = instance.step(&run, candidate);
        late_s += (run.arrive_s - instance.candidates[candidate as usize].due_s).max(0.0);
        if late_s >= enough_s {
            return f64::INFINITY;
        }
    }
    late_s + (instance.finish(&run).arrive_s - instance.timespan_s).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    /// Sensors on a line, each 10 s from the next, charged in no time.
    fn line(deadlines_s: &[f64]) -> Scenario {
        let sensor = |i: usize| serde_json::json!({"id": i.to_string(), "position_m": [i as f64 + 1.0, 0], "battery_j": 1e-9});
        let request = |(i, due): (usize, &f64)| serde_json::json!({"sensor": i.to_string(), "deadline_s": due});
        let document = serde_json::json!({
            "format": "voltour/scenario/1",
            "objective": "min_distance",
            "charger": {"start_m": [0, 0], "speed_mps": 0.1, "travel_jpm": 0, "transfer_w": 1},
            "sensors": (0..deadlines_s.len()).map(sensor).collect::<Vec<_>>(),
            "requests": deadlines_s.iter().enumerate().map(request).collect::<Vec<_>>(),
        });
        Scenario::from_json(document.to_string().as_bytes()).unwrap()
    }

    #[test]
    fn a_newcomer_that_fits_nowhere_comes_in_by_moving_others() {
        // 1 before 0 is in time, and no place beside them is for 2: 0 has to go first.
        let scenario = line(&[30.0, 20.0, 30.0]);
        let instance = Instance::new(&scenario);
        assert!(lateness_s(&instance, &[1, 0], f64::INFINITY) <= 0.0);
        for order in [[2, 1, 0], [1, 2, 0], [1, 0, 2]] {
            assert!(lateness_s(&instance, &order, f64::INFINITY) > 0.0, "{order:?}");
        }
        assert_eq!(squeeze(&instance, &[1, 0], 2), Some(vec![0, 1, 2]));
    }

    #[test]
    fn what_cannot_be_in_time_is_left_out() {
        let scenario = line(&[10.0, 20.0, 5.0]);
        assert_eq!(squeeze(&Instance::new(&scenario), &[0, 1], 2), None);
    }
}
