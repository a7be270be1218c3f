//! Random numbers that depend on the seed and on what they are for, and on nothing that came before: a
//! training that was interrupted goes on with the numbers it would have had.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// The stream of random numbers for the `index`-th thing of a kind.
pub fn stream(seed: u64, kind: u64, index: u64) -> Pcg64Mcg {
    let mut state = [0; 16];
    let mixed = mix(mix(seed ^ mix(kind)) ^ index);
    state[..8].copy_from_slice(&mixed.to_le_bytes());
    state[8..].copy_from_slice(&mix(mixed).to_le_bytes());
    Pcg64Mcg::from_seed(state)
}

/// Uniform in [0, 1).
pub fn unit(rng: &mut Pcg64Mcg) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// Uniform in `0..count`; 0 if `count` is 0.
pub fn index(rng: &mut Pcg64Mcg, count: usize) -> usize {
    ((u128::from(rng.next_u64()) * count as u128) >> 64) as usize
}

/// SplitMix64's finaliser (Steele, Lea and Flood 2014).
fn mix(value: u64) -> u64 {
    let z = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
