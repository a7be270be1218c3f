//! How long the network takes for 32 states of 44 candidates: plain matrix products beside burn's, and a gradient.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::disallowed_methods,
    reason = "a benchmark"
)]

#[path = "../tests/trainer/states.rs"]
#[allow(dead_code)]
mod states;

use std::time::Instant;

use voltour_solver::policy::QFunction;
use voltour_trainer::dqn::Device;
use voltour_trainer::network::{Differentiable, Network, Target};

/// Median milliseconds of 50 calls, after five that do not count.
fn milliseconds(mut call: impl FnMut()) -> f64 {
    (0..5).for_each(|_| call());
    let mut times: Vec<f64> = (0..50)
        .map(|_| {
            let begin = Instant::now();
            call();
            1e3 * begin.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn main() {
    let weights = states::weights(1);
    let mut batch = states::batch(32, 44, 1);
    batch.mask.fill(1.0);
    let burn = Differentiable::new(Device::Cpu.open().unwrap());
    let plain = Network::new(weights.clone());
    let target = Target {
        values: vec![0.5; batch.mask.len()],
        weights: batch.mask.clone(),
        differences: 0.0,
    };
    let forward = milliseconds(|| drop(plain.values(&batch).unwrap()));
    let of_burn = milliseconds(|| drop(burn.values(&weights, &batch).unwrap()));
    let gradient = milliseconds(|| drop(burn.gradient(&weights, &batch, &target).unwrap()));
    println!("32 states of 44 candidates");
    println!("values, plain   {forward:7.2} ms");
    println!("values, burn    {of_burn:7.2} ms   {:.2} of plain", of_burn / forward);
    println!("gradient, burn  {gradient:7.2} ms   {:.2} of burn's values", gradient / of_burn);
}
