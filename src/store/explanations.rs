//! Reading explanations; and which plan is to be explained next, for the database is the queue.

use sqlx::SqlitePool;

use super::cells::Cells;
use super::{Reads, StoreError};
use crate::domain::PlanId;

/// How often a plan is tried to be explained.
pub(super) const ATTEMPTS: u32 = 3;
/// So many plans are explained, the newest; older ones that have no explanation get none any more.
const NEWEST: u32 = 100;

/// What there is of a plan's explanation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Explained {
    /// The document, as JSON text. It never changes.
    Document(Vec<u8>),
    /// Nothing so far.
    NotYet,
    /// Nothing, after as many attempts as there may be.
    GivenUp,
}

impl Reads {
    /// The explanation of a plan; none where there is no such plan.
    pub async fn explanation(&self, id: PlanId) -> Result<Option<Explained>, StoreError> {
        let row = sqlx::query(
            "SELECT e.document, coalesce(e.attempts, 0) AS attempts, e.document IS NULL AS missing \
             FROM plans p LEFT JOIN explanations e ON e.plan_id = p.id WHERE p.id = ?",
        );
        let row = row.bind(id.to_string()).fetch_optional(self.pool()).await?;
        let Some(row) = row else { return Ok(None) };
        let cells = Cells::new("explanations", &row);
        Ok(Some(if !cells.get::<bool>("missing")? {
            Explained::Document(cells.unpacked("document")?)
        } else if cells.count("attempts")? < ATTEMPTS {
            Explained::NotYet
        } else {
            Explained::GivenUp
        }))
    }

    /// The newest plan that is to be explained; none where all are.
    pub async fn unexplained(&self) -> Result<Option<PlanId>, StoreError> {
        let row = sqlx::query(
            "SELECT p.id FROM (SELECT id FROM plans ORDER BY id DESC LIMIT ?) p \
             LEFT JOIN explanations e ON e.plan_id = p.id \
             WHERE e.plan_id IS NULL OR (e.document IS NULL AND e.attempts < ?) \
             ORDER BY p.id DESC LIMIT 1",
        );
        let row = row.bind(NEWEST).bind(ATTEMPTS).fetch_optional(self.pool()).await?;
        row.map(|row| Cells::new("plans", &row).parsed("id")).transpose()
    }
}

/// How many plans are to be explained.
pub(super) async fn waiting_explanations(pool: &SqlitePool) -> Result<u64, StoreError> {
    let count = sqlx::query_scalar::<_, i64>(
        "SELECT count(*) FROM (SELECT id FROM plans ORDER BY id DESC LIMIT ?) p \
         LEFT JOIN explanations e ON e.plan_id = p.id \
         WHERE e.plan_id IS NULL OR (e.document IS NULL AND e.attempts < ?)",
    );
    let count = count.bind(NEWEST).bind(ATTEMPTS).fetch_one(pool).await?;
    Ok(count.unsigned_abs())
}
