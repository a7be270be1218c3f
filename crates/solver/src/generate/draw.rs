//! Uniform draws, written out from raw bits so that they never change under a library upgrade.

use rand::Rng;
use rand_pcg::Pcg64Mcg;

/// A stream of draws.
pub(super) struct Draw(Pcg64Mcg);

impl Draw {
    pub(super) fn new(seed: u64) -> Self {
        let high = mix(seed.wrapping_add(0x9e37_79b9_7f4a_7c15));
        let low = mix(seed.wrapping_add(0x3c6e_f372_fe94_f82a));
        Self(Pcg64Mcg::new(u128::from(high) << 64 | u128::from(low)))
    }

    /// Uniform in [0, 1), a multiple of 2^-53.
    fn unit(&mut self) -> f64 {
        const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
        (self.0.next_u64() >> 11) as f64 * STEP
    }

    /// Uniform in [low, high].
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        round(low + self.unit() * (high - low)).clamp(low, high)
    }

    /// Uniform in (low, high]: never `low` itself, by the step of rounding at least.
    pub(super) fn above(&mut self, low: f64, high: f64) -> f64 {
        let steps = ((high - low) * PER_UNIT).floor();
        round(high - (self.unit() * steps).floor() / PER_UNIT)
    }

    /// Uniform in a square with a corner at the origin.
    pub(super) fn place(&mut self, side_m: f64) -> [f64; 2] {
        let x = self.between(0.0, side_m);
        [x, self.between(0.0, side_m)]
    }
}

const PER_UNIT: f64 = 1e6;

/// To a millionth.
pub(super) fn round(x: f64) -> f64 {
    (x * PER_UNIT).round() / PER_UNIT
}

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): spreads neighbouring seeds.
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_fill_their_range_evenly() {
        let mut draw = Draw::new(1);
        let draws: Vec<f64> = (0..20_000).map(|_| draw.between(-1.0, 3.0)).collect();
        let mean = draws.iter().sum::<f64>() / draws.len() as f64;
        assert!((mean - 1.0).abs() < 0.03, "{mean}");
        for quarter in 0..4 {
            let from = f64::from(quarter) - 1.0;
            let inside = draws.iter().filter(|x| (from..from + 1.0).contains(*x)).count();
            assert!((4_700..5_300).contains(&inside), "{inside} from {from}");
        }
        assert!(draws.iter().all(|x| round(*x) == *x && (-1.0..=3.0).contains(x)));
    }

    #[test]
    fn above_leaves_out_its_lower_end_and_reaches_the_upper() {
        let mut draw = Draw::new(2);
        let draws: Vec<f64> = (0..2_000).map(|_| draw.above(5.0, 5.000_003)).collect();
        assert!(draws.iter().all(|x| *x > 5.0));
        for end in [5.000_001, 5.000_002, 5.000_003] {
            assert!(draws.contains(&end));
        }
    }

    #[test]
    fn neighbouring_seeds_have_nothing_in_common() {
        let first = |seed| Draw::new(seed).between(0.0, 1.0);
        assert!((first(1) - first(2)).abs() > 1e-3 && (first(2) - first(3)).abs() > 1e-3);
        assert_eq!(first(7), first(7));
    }
}
