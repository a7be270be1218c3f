//! The memory of the process, sampled over each of its lives.
//!
//! A life begins with what fills once: the trained policies, the caches of the database's connections, stacks. What
//! must not be seen is growth that goes on; so the last quarter of a life is compared with the one before it, and the
//! last lives, on a database that has grown, with the first.

use std::fmt;
use std::fs;

use crate::crash::aim::Killed;
use crate::time::pause;

/// Between two samples.
const EVERY_MS: u64 = 250;
/// What the last quarter of a life may have on average beyond the third, as the median of all lives.
const GROWTH_MIB: f64 = 4.0;
/// The same where there are fewer than ten lives: then they are few, and short enough to be filling for all their length.
const GROWTH_OF_FEW_MIB: f64 = 12.0;
/// What a life may reach beyond the highest of the first three.
const DRIFT_MIB: f64 = 64.0;

/// One life: what the process has for itself, in MiB.
#[derive(Clone, Copy, Debug)]
struct Life {
    peak: f64,
    third: f64,
    last: f64,
}

impl Life {
    /// None where it was too short.
    fn of(samples: &[f64]) -> Option<Self> {
        let quarter = samples.len() / 4;
        (quarter > 0).then(|| Self {
            peak: samples.iter().copied().fold(0.0, f64::max),
            third: mean(&samples[2 * quarter..3 * quarter]),
            last: mean(&samples[samples.len() - quarter..]),
        })
    }
}

#[derive(Debug, Default)]
pub struct Memory {
    lives: Vec<Life>,
}

impl Memory {
    /// Samples until the process is killed.
    pub async fn sample(&mut self, pid: u32, killed: &Killed) {
        let mut samples = Vec::new();
        while !killed.struck() {
            samples.extend(own_mib(pid));
            pause(EVERY_MS).await;
        }
        self.add(&samples);
    }

    /// A life with these samples.
    pub fn add(&mut self, samples: &[f64]) {
        self.lives.extend(Life::of(samples));
    }

    /// The last life in words.
    pub fn last(&self) -> String {
        let life = self.lives.last();
        life.map_or_else(|| "too short to be measured".to_owned(), ToString::to_string)
    }

    fn growth(&self) -> f64 {
        let mut growth: Vec<_> = self.lives.iter().map(|life| life.last - life.third).collect();
        growth.sort_by(f64::total_cmp);
        growth[growth.len() / 2]
    }

    fn highest(lives: &[Life]) -> f64 {
        lives.iter().map(|life| life.peak).fold(0.0, f64::max)
    }

    /// Fails where the memory grew.
    pub fn is_flat(&self) {
        assert!(!self.lives.is_empty(), "no life was long enough to be measured");
        let growth = self.growth();
        let bound = if self.lives.len() < 10 { GROWTH_OF_FEW_MIB } else { GROWTH_MIB };
        assert!(growth <= bound, "grows by {growth:.1} MiB in a quarter of a life: {self:?}");
        let first = Self::highest(&self.lives[..self.lives.len().min(3)]);
        let highest = Self::highest(&self.lives);
        assert!(highest <= first + DRIFT_MIB, "from {first:.0} to {highest:.0} MiB: {self:?}");
    }
}

impl fmt::Display for Life {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { peak, third, last } = self;
        write!(f, "at most {peak:.0} MiB, {third:.1} in its third quarter, {last:.1} in its last")
    }
}

impl fmt::Display for Memory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let peak = Self::highest(&self.lives);
        write!(f, "at most {peak:.0} MiB, {:+.1} in the last quarter of a life", self.growth())
    }
}

fn mean(samples: &[f64]) -> f64 {
    samples.iter().sum::<f64>() / samples.len() as f64
}

/// Without the pages of the binary, which come and go as they are used. None once the process is gone.
fn own_mib(pid: u32) -> Option<f64> {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("RssAnon:"))?;
    let kib: f64 = line.trim().strip_suffix(" kB")?.parse().ok()?;
    Some(kib / 1024.0)
}
