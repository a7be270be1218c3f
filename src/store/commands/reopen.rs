//! What becomes of requests that their tour leaves out: open again; but withdrawn if that was asked
//! meanwhile, and superseded if their sensor has a newer open request.

use crate::domain::DepartureId;
use crate::store::StoreError;
use crate::store::writer::Writing;

macro_rules! reopen {
    ($states:literal) => {
        concat!(
            "UPDATE requests SET state = CASE \
             WHEN withdraw_us IS NOT NULL THEN 'withdrawn' \
             WHEN EXISTS (SELECT 1 FROM requests o WHERE o.network_id = requests.network_id \
             AND o.sensor_id = requests.sensor_id AND o.state = 'open') THEN 'superseded' \
             ELSE 'open' END, updated_us = ?1, change = ?2 + numbered.n \
             FROM (SELECT id, row_number() OVER (ORDER BY id) AS n FROM requests \
             WHERE departure_id = ?3 AND state IN (",
            $states,
            ")) AS numbered WHERE requests.id = numbered.id"
        )
    };
}

/// Reopens what is batched or planned of a departure.
pub(super) async fn all(w: &mut Writing, departure: DepartureId) -> Result<(), StoreError> {
    run(w, reopen!("'batched', 'planned'"), departure).await
}

/// Reopens what is batched of a departure and no stop of its tour.
pub(super) async fn batched(w: &mut Writing, departure: DepartureId) -> Result<(), StoreError> {
    run(w, reopen!("'batched'"), departure).await
}

async fn run(w: &mut Writing, sql: &'static str, departure: DepartureId) -> Result<(), StoreError> {
    let (now_us, before) = (w.now_us(), w.changes_before());
    let update = sqlx::query(sql).bind(now_us).bind(before).bind(departure.to_string());
    let done = update.execute(&mut w.conn).await?;
    w.took_changes(done.rows_affected());
    Ok(())
}
