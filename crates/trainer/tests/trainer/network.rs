//! The two networks agree, and neither minds padding or the order of the rows.

use voltour_solver::policy::QFunction;
use voltour_trainer::dqn::Device;
use voltour_trainer::network::{Differentiable, Network};

use super::states::{assert_close, batch, padded, reordered, weights};

const SIZES: [(usize, usize); 5] = [(1, 1), (2, 7), (3, 20), (8, 33), (2, 80)];

#[test]
fn burn_agrees_with_plain_products() {
    let burn = Differentiable::new(Device::Cpu.open().unwrap());
    for (seed, (states, rows)) in (0..).zip(SIZES) {
        let (weights, batch) = (weights(seed), batch(states, rows, seed));
        let q = Network::new(weights.clone()).values(&batch).unwrap();
        assert_close(&burn.values(&weights, &batch).unwrap(), &q);
        let padding = batch.mask.iter().zip(&q).filter(|(mask, _)| **mask == 0.0);
        assert!(padding.into_iter().all(|(_, q)| *q == 0.0));
    }
}

#[test]
fn padding_changes_nothing() {
    let burn = Differentiable::new(Device::Cpu.open().unwrap());
    let (weights, batch) = (weights(7), batch(4, 12, 7));
    let wide = padded(&batch, 9);
    let q = burn.values(&weights, &batch).unwrap();
    for of_wide in [
        burn.values(&weights, &wide).unwrap(),
        Network::new(weights.clone()).values(&wide).unwrap(),
    ] {
        let cut: Vec<f32> = of_wide.chunks(21).flat_map(|row| row[..12].to_vec()).collect();
        assert_close(&cut, &q);
    }
}

#[test]
fn values_follow_the_rows() {
    let burn = Differentiable::new(Device::Cpu.open().unwrap());
    let (weights, batch) = (weights(3), batch(3, 11, 3));
    let order = [4, 2, 10, 0, 9, 1, 7, 3, 8, 6, 5];
    let other = reordered(&batch, &order);
    let follow = |q: &[f32]| -> Vec<f32> {
        q.chunks(11).flat_map(|row| order.map(|old| row[old])).collect()
    };
    let q = burn.values(&weights, &batch).unwrap();
    assert_close(&burn.values(&weights, &other).unwrap(), &follow(&q));
    assert_close(&Network::new(weights).values(&other).unwrap(), &follow(&q));
}
