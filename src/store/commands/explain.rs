//! The explanation of a plan: an attempt is counted before it begins, so that a plan which kills the
//! process is not tried for ever; what it gave is stored when it ends.

use crate::domain::PlanId;
use crate::store::explanations::ATTEMPTS;
use crate::store::writer::{Command, Failure, Writing};

/// Counts an attempt to explain a plan; the answer is whether it may begin.
#[derive(Debug)]
pub struct BeginExplanation {
    /// The plan.
    pub plan_id: PlanId,
}

impl Command for BeginExplanation {
    type Answer = bool;

    async fn apply(&self, w: &mut Writing) -> Result<bool, Failure> {
        let now_us = w.now_us();
        let done = sqlx::query(
            "INSERT INTO explanations (plan_id, attempts, updated_us) VALUES (?1, 1, ?2) \
             ON CONFLICT (plan_id) DO UPDATE SET attempts = attempts + 1, updated_us = ?2 \
             WHERE document IS NULL AND attempts < ?3",
        )
        .bind(self.plan_id.to_string())
        .bind(now_us)
        .bind(ATTEMPTS)
        .execute(&mut w.conn)
        .await?;
        Ok(done.rows_affected() > 0)
    }
}

/// What became of an attempt.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Attempt {
    /// The document, compressed.
    Explained(Vec<u8>),
    /// The service ends: the attempt does not count.
    Interrupted,
    /// It would fail again.
    GivenUp,
}

/// Ends an attempt.
#[derive(Debug)]
pub struct EndExplanation {
    /// Of this plan.
    pub plan_id: PlanId,
    /// With this.
    pub attempt: Attempt,
}

impl Command for EndExplanation {
    type Answer = ();

    async fn apply(&self, w: &mut Writing) -> Result<(), Failure> {
        let (now_us, id) = (w.now_us(), self.plan_id.to_string());
        let update = match &self.attempt {
            Attempt::Explained(document) => sqlx::query(
                "UPDATE explanations SET updated_us = ?1, document = ?3 \
                 WHERE plan_id = ?2 AND document IS NULL",
            )
            .bind(now_us)
            .bind(id)
            .bind(&document[..]),
            Attempt::Interrupted => sqlx::query(
                "UPDATE explanations SET updated_us = ?1, attempts = attempts - 1 \
                 WHERE plan_id = ?2 AND document IS NULL AND attempts > 0",
            )
            .bind(now_us)
            .bind(id),
            Attempt::GivenUp => sqlx::query(
                "UPDATE explanations SET updated_us = ?1, attempts = ?3 \
                 WHERE plan_id = ?2 AND document IS NULL",
            )
            .bind(now_us)
            .bind(id)
            .bind(ATTEMPTS),
        };
        update.execute(&mut w.conn).await?;
        Ok(())
    }
}
