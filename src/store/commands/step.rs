//! Steps that many requests take at once, each on the condition of its former state.

use sqlx::{QueryBuilder, Sqlite};

use crate::domain::{RequestId, RequestState};
use crate::store::StoreError;
use crate::store::words::Word;
use crate::store::writer::Writing;

/// Rows in one statement.
const CHUNK: usize = 500;

/// Takes requests from one state to another, and notes where they are now.
///
/// # Errors
/// One of them was not in the state that it must have been in: a defect, all is rolled back.
pub(super) async fn step(
    w: &mut Writing,
    ids: &[RequestId],
    from: RequestState,
    to: RequestState,
    place: Option<(&'static str, String)>,
) -> Result<(), StoreError> {
    for chunk in ids.chunks(CHUNK) {
        let mut update = QueryBuilder::<Sqlite>::new("UPDATE requests SET state = ");
        update.push_bind(to.word()).push(", updated_us = ").push_bind(w.now_us());
        if let Some((column, value)) = &place {
            update.push(", ").push(column).push(" = ").push_bind(value.clone());
        }
        update.push(", change = numbered.n + ").push_bind(w.changes_before());
        update.push(
            " FROM (SELECT id, row_number() OVER (ORDER BY id) AS n FROM requests WHERE state = ",
        );
        update.push_bind(from.word()).push(" AND id IN (");
        let mut list = update.separated(", ");
        for id in chunk {
            list.push_bind(id.to_string());
        }
        update.push(")) AS numbered WHERE requests.id = numbered.id");
        let rows = update.build().execute(&mut w.conn).await?.rows_affected();
        if rows != chunk.len() as u64 {
            let reason = format!("{rows} of {} were {}", chunk.len(), from.word());
            return Err(StoreError::row("requests", reason));
        }
        w.took_changes(rows);
    }
    Ok(())
}
