//! The task: looks once in a while, and deletes portion after portion, each a command among those of everybody else.

use std::sync::Arc;
use std::time::Duration;

use jiff::Timestamp;
use tokio_util::sync::CancellationToken;

use crate::clock::{Clock, minus, plus, seconds};
use crate::domain::Refusal;
use crate::store::{Forget, Forgotten, Writer};

/// Nothing is deleted sooner after its end: a client may repeat a call for so long.
pub const SHORTEST: Duration = Duration::from_secs(7 * 86_400);

/// How often it looks for something to delete.
const LOOK: Duration = Duration::from_secs(600);
/// Between two portions: the writer is everybody's.
const REST: Duration = Duration::from_millis(200);
/// A clock that went so far from the time that has passed was set, and perhaps wrongly.
const TRUSTED_S: f64 = 3_600.0;

/// The task and what it needs.
#[derive(Debug)]
pub struct Retention {
    writer: Writer,
    clock: Arc<dyn Clock>,
    history: Duration,
    cancel: CancellationToken,
    /// What the clock showed when it had run for so long.
    begun: (Timestamp, Duration),
}

impl Retention {
    /// Of what a writer keeps; `cancel` ends it.
    pub fn new(
        writer: Writer,
        clock: Arc<dyn Clock>,
        history: Duration,
        cancel: CancellationToken,
    ) -> Self {
        let begun = (clock.now(), clock.ran());
        Self { writer, clock, history, cancel, begun }
    }

    /// Runs until it is cancelled. A look comes only after a while: the clock of a machine that has just started may
    /// be wrong, and is seen to be set until then.
    pub async fn run(self) {
        loop {
            tokio::select! {
                () = self.cancel.cancelled() => return,
                () = self.clock.pause(LOOK) => {}
            }
            match self.round().await {
                Ok(gone) if gone == Forgotten::default() => {}
                Ok(Forgotten { departures, requests, calls }) => {
                    tracing::info!(departures, requests, calls, "deleted what was over for long");
                }
                Err(error) => tracing::warn!(%error, "nothing can be deleted now"),
            }
        }
    }

    async fn round(&self) -> Result<Forgotten, Refusal> {
        let mut gone = Forgotten::default();
        while let Some(before) = self.before()
            && !self.cancel.is_cancelled()
        {
            let portion = self.writer.call(Forget { before }).await?;
            gone += portion;
            if !portion.is_whole_portion() {
                break;
            }
            self.clock.pause(REST).await;
        }
        Ok(gone)
    }

    /// What ended before this may go; none where the clock is not to be trusted.
    fn before(&self) -> Option<Timestamp> {
        let (shown, ran) = self.begun;
        let now = self.clock.now();
        let expected = plus(shown, self.clock.ran().saturating_sub(ran));
        let off_s = seconds(expected, now);
        if off_s.abs() > TRUSTED_S {
            tracing::warn!(
                off_s,
                "the clock was set: nothing is deleted until the service is started again"
            );
            return None;
        }
        Some(minus(now, self.history))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::RequestState;
    use crate::store::fixture::Bench;

    fn of(bench: &Bench) -> Retention {
        let (writer, clock) = (bench.store.writer.clone(), bench.clock.clone());
        Retention::new(writer, clock, SHORTEST, CancellationToken::new())
    }

    #[tokio::test]
    async fn what_is_over_for_long_goes_unless_the_clock_was_set() {
        let bench = Bench::new().await;
        for _ in 0..250 {
            bench.submit("s1").await;
        }
        let last = bench.submit("s2").await;
        let right = bench.clock.now();
        let retention = of(&bench);
        bench.clock.set(plus(right, 100 * SHORTEST));
        assert_eq!(retention.round().await.unwrap(), Forgotten::default());
        assert_eq!(retention.before(), None);
        // Wrong at the start, and put right afterwards.
        let started = of(&bench);
        bench.clock.set(right);
        assert_eq!(started.before(), None);
        assert!(retention.before().is_some(), "it is as it was");
        bench.clock.advance(100 * SHORTEST);
        let gone = retention.round().await.unwrap();
        assert_eq!(gone.requests, 249, "all that was superseded, over several portions");
        assert_eq!(bench.state(last.id).await, RequestState::Open);
    }

    #[tokio::test]
    async fn a_clock_is_not_believed_at_once() {
        let bench = Bench::new().await;
        let first = bench.submit("s1").await;
        bench.clock.set(plus(bench.clock.now(), 100 * SHORTEST));
        bench.submit("s1").await;
        let running = tokio::spawn(of(&bench).run());
        tokio::task::yield_now().await;
        // Whatever it deletes at once is gone when this is stored.
        bench.submit("s2").await;
        assert_eq!(bench.state(first.id).await, RequestState::Superseded);
        running.abort();
    }
}
