//! When to kill: anywhere, or around a moment that is known beforehand, so that few trials hit all phases.

use std::sync::atomic::{AtomicBool, AtomicI64, AtomicU64, Ordering};
use std::time::Duration;

use super::rng::Rng;
use crate::time::{now_us, pause, until};

/// What everybody sees of the kill, and the aim sees of the departures.
#[derive(Debug, Default)]
pub struct Killed {
    struck: AtomicBool,
    /// When the batch that was announced last will close; 0 before.
    closes_us: AtomicI64,
    /// Tours that chargers were given.
    fetched: AtomicU64,
}

impl Killed {
    pub fn strike(&self) {
        self.struck.store(true, Ordering::SeqCst);
    }

    /// Whether errors are to be expected.
    pub fn struck(&self) -> bool {
        self.struck.load(Ordering::SeqCst)
    }

    pub fn fetched(&self) {
        self.fetched.fetch_add(1, Ordering::SeqCst);
    }

    pub fn announced(&self, closes_us: i64) {
        self.closes_us.store(closes_us, Ordering::SeqCst);
    }
}

impl Killed {
    /// Waits for the next tour that a charger is given.
    async fn next_tour(&self) {
        let before = self.fetched.load(Ordering::SeqCst);
        let end = now_us() + 30_000_000;
        while self.fetched.load(Ordering::SeqCst) == before {
            assert!(now_us() < end, "waited in vain: a tour");
            tokio::time::sleep(Duration::from_millis(1)).await;
        }
    }
}

/// What the kill is aimed at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// Any moment.
    Anywhere,
    /// The first moments, when what was unacknowledged comes again.
    Retries,
    /// The transaction that closes a batch.
    Closing,
    /// The search.
    Planning,
    /// The transaction that stores the plan.
    Storing,
    /// The moment at which a charger has its tour.
    Fetching,
}

impl Aim {
    pub fn draw(rng: &mut Rng) -> Self {
        use Aim::{Anywhere, Closing, Fetching, Planning, Retries, Storing};
        let all = [Anywhere, Retries, Closing, Planning, Storing, Fetching];
        all[rng.range(0, 6) as usize]
    }

    /// Waits until it is time.
    pub async fn wait(self, rng: &mut Rng, killed: &Killed) {
        // Milliseconds after the close: the search takes 120 of them.
        let offset = match self {
            Self::Anywhere => return pause(rng.range(0, 2000)).await,
            Self::Retries => return pause(rng.range(0, 150)).await,
            Self::Closing => rng.range(0, 16) as i64 - 4,
            Self::Planning => rng.range(5, 120) as i64,
            Self::Storing => rng.range(115, 160) as i64,
            Self::Fetching => return killed.next_tour().await,
        };
        let closes_us = until("a departure to aim at", || async {
            let closes_us = killed.closes_us.load(Ordering::SeqCst);
            (closes_us + offset * 1000 > now_us()).then_some(closes_us)
        });
        let strike_us = closes_us.await + offset * 1000;
        let left = u64::try_from(strike_us - now_us()).unwrap_or_default();
        tokio::time::sleep(Duration::from_micros(left)).await;
    }
}
