//! The queue against a sorted list.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::label::Entry;
use super::queue::Queue;

#[test]
fn all_come_out_once_and_nearly_in_order() {
    let mut rng = Pcg64Mcg::seed_from_u64(7);
    for most in [5.0, f64::INFINITY] {
        let mut queue = Queue::new(-3.0, most);
        let mut inside: Vec<f64> = Vec::new();
        for label in 0..4_000 {
            if rng.random_bool(0.6) {
                let bound = rng.random_range(-3.0..6.0);
                queue.push(Entry { bound, stops: 1, label });
                inside.push(bound);
            } else if let Some(entry) = queue.pop() {
                let least = inside.iter().copied().fold(f64::INFINITY, f64::min);
                let place = inside.iter().position(|&bound| bound == entry.bound).unwrap();
                inside.swap_remove(place);
                // Beyond the last step no order is kept.
                let step = if most.is_finite() { 8.0 / 256.0 } else { 4.0 / 256.0 };
                assert!(entry.bound <= least + step || least >= 1.0 - step);
                let left = inside.iter().copied().fold(f64::INFINITY, f64::min);
                assert_eq!(queue.bound(), left);
            } else {
                assert!(inside.is_empty());
            }
        }
        inside.sort_by(f64::total_cmp);
        let drained: Vec<f64> = queue.drain().iter().map(|entry| entry.bound).collect();
        assert_eq!(drained, inside);
        assert!(queue.pop().is_none());
    }
}
