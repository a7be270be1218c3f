//! Times as the wire has them, and waiting for a condition.

use std::future::Future;
use std::time::{Duration, Instant};

use jiff::Timestamp;

use crate::app::PATIENCE;

/// Microseconds since the epoch.
pub fn now_us() -> i64 {
    Timestamp::now().as_microsecond()
}

/// A wire time from microseconds since the epoch.
pub fn wire(us: i64) -> prost_types::Timestamp {
    prost_types::Timestamp {
        seconds: us.div_euclid(1_000_000),
        nanos: (us.rem_euclid(1_000_000) * 1000) as i32,
    }
}

/// A wire time so many milliseconds from now; before now if negative.
pub fn from_now(ms: i64) -> Option<prost_types::Timestamp> {
    Some(wire(now_us() + ms * 1000))
}

/// Microseconds since the epoch of a wire time that must be there.
pub fn us(time: &Option<prost_types::Timestamp>) -> i64 {
    let time = time.expect("a time");
    time.seconds * 1_000_000 + i64::from(time.nanos) / 1000
}

/// Asks again until there is an answer; fails with `what` after a long wait.
pub async fn until<T, F, A>(what: &str, mut ask: F) -> T
where
    F: FnMut() -> A,
    A: Future<Output = Option<T>>,
{
    let end = Instant::now() + PATIENCE;
    loop {
        if let Some(answer) = ask().await {
            return answer;
        }
        assert!(Instant::now() < end, "waited in vain: {what}");
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
}

/// Sleeps.
pub async fn pause(ms: u64) {
    tokio::time::sleep(Duration::from_millis(ms)).await;
}
