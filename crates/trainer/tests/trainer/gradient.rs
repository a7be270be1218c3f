//! Burn's gradient against differences of the plain network's loss.

use voltour_solver::policy::{Batch, QFunction};
use voltour_trainer::dqn::{Device, stream, unit};
use voltour_trainer::network::{Differentiable, Network, Target, Weights};

use super::states::{batch, weights};

fn huber(d: f64) -> f64 {
    if d.abs() <= 1.0 { 0.5 * d * d } else { d.abs() - 0.5 }
}

/// The loss as documented, in double precision over the plain network's values.
fn loss(weights: &Weights, batch: &Batch, target: &Target) -> f64 {
    let q = Network::new(weights.clone()).values(batch).unwrap();
    let mut sum = 0.0;
    for b in 0..batch.states {
        let rows = b * batch.rows..(b + 1) * batch.rows;
        let pairs = || {
            rows.clone().map(|i| (f64::from(q[i] - target.values[i]), f64::from(target.weights[i])))
        };
        let total: f64 = pairs().map(|(_, w)| w).sum();
        let mean = pairs().map(|(d, w)| d * w).sum::<f64>() / total.max(1e-6);
        let differences = f64::from(target.differences);
        sum += pairs().map(|(d, w)| w * (huber(d) + differences * huber(d - mean))).sum::<f64>();
    }
    sum
}

#[test]
fn the_gradient_is_the_slope_of_the_loss() {
    let burn = Differentiable::new(Device::Cpu.open().unwrap());
    let (weights, batch) = (weights(5), batch(6, 15, 5));
    let mut rng = stream(5, 101, 0);
    let labelled: Vec<f32> =
        batch.mask.iter().map(|mask| if unit(&mut rng) < 0.4 { *mask } else { 0.0 }).collect();
    let values = labelled.iter().map(|_| (4.0 * unit(&mut rng) - 2.0) as f32).collect();
    for differences in [0.0, 0.7] {
        let target = Target { values: Vec::clone(&values), weights: labelled.clone(), differences };
        let (value, gradient) = burn.gradient(&weights, &batch, &target).unwrap();
        let exact = loss(&weights, &batch, &target);
        assert!((f64::from(value) - exact).abs() < 1e-4 * exact, "{value} is not {exact}");
        for part in weights.parts() {
            let norm = |g: &[f32]| g.iter().map(|g| f64::from(*g).powi(2)).sum::<f64>().sqrt();
            let slope = &gradient[part.start..part.start + part.len()];
            let length = norm(slope);
            let along = |step: f64| {
                let mut moved = weights.clone();
                for (w, g) in moved.values_mut()[part.start..].iter_mut().zip(slope) {
                    *w += (step * f64::from(*g) / length) as f32;
                }
                loss(&moved, &batch, &target)
            };
            let step = 3e-3;
            let measured = (along(step) - along(-step)) / (2.0 * step);
            let error = (measured - length).abs() / length;
            assert!(error < 0.03, "{}: slope {measured}, gradient {length}", part.name);
        }
    }
}
