//! Time is a parameter: whoever needs it holds a [`Clock`]. This is the only file that asks the
//! machine what time it is. All times are whole microseconds.

use std::fmt;
use std::future::Future;
use std::pin::Pin;
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use jiff::Timestamp;
use tokio::sync::watch;
use uuid::{ContextV7, Uuid};

/// Sleeping, until it is over.
pub type Sleep<'a> = Pin<Box<dyn Future<Output = ()> + Send + 'a>>;

/// Tells the time and waits for it.
pub trait Clock: fmt::Debug + Send + Sync + 'static {
    /// The time, in whole microseconds.
    fn now(&self) -> Timestamp;
    /// Waits until `now` is `at` or later.
    fn sleep_until(&self, at: Timestamp) -> Sleep<'_>;
    /// How long it has run. It is never set, so that lengths are measured with it.
    fn ran(&self) -> Duration;
    /// Waits for so long, wherever the clock is set meanwhile: before something is tried again.
    fn pause(&self, length: Duration) -> Sleep<'_>;
}

/// A wall clock may be set while someone sleeps; nobody sleeps longer than this without a look.
const LONGEST_SLEEP: Duration = Duration::from_secs(5);

/// The machine's clock.
#[derive(Clone, Copy, Debug, Default)]
pub struct SystemClock;

impl Clock for SystemClock {
    #[expect(clippy::disallowed_methods, reason = "the one clock that is the machine's")]
    fn now(&self) -> Timestamp {
        whole(Timestamp::now())
    }

    #[expect(clippy::disallowed_methods, reason = "the one clock that is the machine's")]
    fn ran(&self) -> Duration {
        static SINCE: OnceLock<Instant> = OnceLock::new();
        SINCE.get_or_init(Instant::now).elapsed()
    }

    fn sleep_until(&self, at: Timestamp) -> Sleep<'_> {
        Box::pin(async move {
            while let Some(left) = left(self.now(), at) {
                tokio::time::sleep(left.min(LONGEST_SLEEP)).await;
            }
        })
    }

    fn pause(&self, length: Duration) -> Sleep<'_> {
        Box::pin(tokio::time::sleep(length))
    }
}

/// A clock that runs faster than the machine's, from the moment it was made.
#[derive(Clone, Copy, Debug)]
pub struct ScaledClock {
    base: Timestamp,
    since: Instant,
    factor: f64,
}

impl ScaledClock {
    /// A clock at which `factor` seconds pass in one; from 0.001 to 1,000,000.
    #[expect(clippy::disallowed_methods, reason = "a clock is made of the machine's")]
    pub fn new(factor: f64) -> Self {
        let factor = if factor.is_finite() { factor.clamp(1e-3, 1e6) } else { 1.0 };
        Self { base: SystemClock.now(), since: Instant::now(), factor }
    }
}

impl Clock for ScaledClock {
    fn now(&self) -> Timestamp {
        plus(self.base, self.ran())
    }

    fn ran(&self) -> Duration {
        self.since.elapsed().mul_f64(self.factor)
    }

    fn sleep_until(&self, at: Timestamp) -> Sleep<'_> {
        Box::pin(async move {
            while let Some(left) = left(self.now(), at) {
                let real = left.div_f64(self.factor).max(Duration::from_micros(100));
                tokio::time::sleep(real.min(LONGEST_SLEEP)).await;
            }
        })
    }

    fn pause(&self, length: Duration) -> Sleep<'_> {
        Box::pin(tokio::time::sleep(length.div_f64(self.factor)))
    }
}

/// A clock that stands still; for tests.
#[derive(Debug)]
pub struct ManualClock {
    shows: watch::Sender<Timestamp>,
    ran: Mutex<Duration>,
}

impl ManualClock {
    /// A clock that shows `now`.
    pub fn new(now: Timestamp) -> Self {
        Self { shows: watch::Sender::new(whole(now)), ran: Mutex::default() }
    }

    /// Lets time pass.
    pub fn advance(&self, by: Duration) {
        *self.ran.lock().unwrap_or_else(PoisonError::into_inner) += by;
        self.shows.send_modify(|now| *now = plus(*now, by));
    }

    /// Sets it, forward or back; no time passes.
    pub fn set(&self, now: Timestamp) {
        self.shows.send_replace(whole(now));
    }
}

impl Clock for ManualClock {
    fn now(&self) -> Timestamp {
        *self.shows.borrow()
    }

    fn ran(&self) -> Duration {
        *self.ran.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn sleep_until(&self, at: Timestamp) -> Sleep<'_> {
        let mut now = self.shows.subscribe();
        Box::pin(async move {
            // Only fails where the clock is gone, and it is borrowed.
            let _ = now.wait_for(|now| *now >= at).await;
        })
    }

    /// Pauses are no part of what such a clock shows: they are short, and pass by themselves.
    fn pause(&self, length: Duration) -> Sleep<'_> {
        Box::pin(tokio::time::sleep(length))
    }
}

/// Makes ids that rise strictly within a process (UUIDv7 with a counter).
#[derive(Debug, Default)]
pub struct Ids(Mutex<ContextV7>);

impl Ids {
    /// Goes on after an id that was made before, whatever the clock shows by now.
    pub fn go_on_after(&self, last: Uuid) {
        if let Some(at) = last.get_timestamp() {
            // Of a millisecond later, for within one the counter begins anywhere.
            let nanos = u64::from(at.to_unix().1) + 1_000_000;
            let (seconds, nanos) = (at.to_unix().0 + nanos / 1_000_000_000, nanos % 1_000_000_000);
            let nanos = u32::try_from(nanos).unwrap_or_default();
            let context = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            // An id that nobody gets: it is made for the context to remember its time.
            let _ = Uuid::new_v7(uuid::Timestamp::from_unix(&*context, seconds, nanos));
        }
    }

    /// The next id, made at `now`.
    pub fn next(&self, now: Timestamp) -> Uuid {
        let context = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let since = now.as_microsecond().max(0).unsigned_abs();
        let nanos = u32::try_from(since % 1_000_000 * 1_000).unwrap_or_default();
        Uuid::new_v7(uuid::Timestamp::from_unix(&*context, since / 1_000_000, nanos))
    }
}

/// `at + by`, or the last time there is.
pub fn plus(at: Timestamp, by: Duration) -> Timestamp {
    whole(at.checked_add(by).unwrap_or(Timestamp::MAX))
}

/// `at - by`, or the first time there is.
pub fn minus(at: Timestamp, by: Duration) -> Timestamp {
    whole(at.checked_sub(by).unwrap_or(Timestamp::MIN))
}

/// Seconds from `from` to `to`; negative where `to` is the earlier.
pub fn seconds(from: Timestamp, to: Timestamp) -> f64 {
    // Exact for the some 285 years that a double counts in microseconds.
    (to.as_microsecond() - from.as_microsecond()) as f64 / 1e6
}

/// Seconds since the Unix epoch.
pub fn unix_s(at: Timestamp) -> f64 {
    seconds(Timestamp::UNIX_EPOCH, at)
}

/// Whole microseconds: what the database keeps.
pub fn whole(at: Timestamp) -> Timestamp {
    Timestamp::from_microsecond(at.as_microsecond()).unwrap_or(at)
}

fn left(now: Timestamp, at: Timestamp) -> Option<Duration> {
    let left = at.as_microsecond().saturating_sub(now.as_microsecond());
    u64::try_from(left).ok().filter(|&left| left > 0).map(Duration::from_micros)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_rise_even_when_the_clock_does_not() {
        let (ids, now) = (Ids::default(), SystemClock.now());
        let made: Vec<Uuid> =
            [now, now, now, minus(now, Duration::from_secs(9)), now].map(|at| ids.next(at)).into();
        assert!(made.windows(2).all(|pair| pair[0] < pair[1]), "{made:?}");
    }

    #[test]
    fn ids_rise_after_a_restart_with_a_clock_that_was_set_back() {
        let now = SystemClock.now();
        let last = Ids::default().next(now);
        let ids = Ids::default();
        ids.go_on_after(last);
        let day = minus(now, Duration::from_secs(86_400));
        assert!(last < ids.next(day) && ids.next(day) < ids.next(now));
    }

    #[tokio::test]
    async fn a_scaled_clock_sleeps_less() {
        let clock = ScaledClock::new(1_000.0);
        let from = clock.now();
        clock.sleep_until(plus(from, Duration::from_secs(20))).await;
        let slept = seconds(from, clock.now());
        assert!((20.0..2_000.0).contains(&slept), "{slept}");
    }

    #[tokio::test]
    async fn a_manual_clock_wakes_when_it_is_set() {
        let clock = std::sync::Arc::new(ManualClock::new(Timestamp::UNIX_EPOCH));
        let at = plus(clock.now(), Duration::from_secs(5));
        let sleeper = clock.clone();
        let sleeping = tokio::spawn(async move { sleeper.sleep_until(at).await });
        clock.advance(Duration::from_secs(5));
        sleeping.await.unwrap();
    }
}
