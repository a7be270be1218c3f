//! [`Replay`]: the replay memory H of Algorithm 1.

use rand_pcg::Pcg64Mcg;

use super::Sample;
use super::random::index;

/// A ring of samples: the newest `capacity`. A small one forgets the returns of early, random play.
#[derive(Clone, Debug)]
pub struct Replay {
    samples: Vec<Sample>,
    capacity: usize,
    next: usize,
}

impl Replay {
    /// An empty memory.
    pub fn new(capacity: usize) -> Self {
        Self { samples: Vec::new(), capacity: capacity.max(1), next: 0 }
    }

    /// Stores a sample in the place of the oldest.
    pub fn push(&mut self, sample: Sample) {
        if self.samples.len() < self.capacity {
            self.samples.push(sample);
        } else {
            self.samples[self.next] = sample;
        }
        self.next = (self.next + 1) % self.capacity;
    }

    /// The number of samples.
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.samples.is_empty()
    }

    /// `count` samples, each drawn from all; none from an empty memory.
    pub fn draw<'a>(
        &'a self,
        count: usize,
        rng: &mut Pcg64Mcg,
    ) -> impl Iterator<Item = &'a Sample> {
        let count = if self.is_empty() { 0 } else { count };
        (0..count).map(move |_| &self.samples[index(rng, self.samples.len())])
    }
}
