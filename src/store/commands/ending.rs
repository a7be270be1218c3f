//! How a tour, or a departure without one, comes to its end: the same for completion, cancellation
//! and silence. What was not reported served is open again.

use super::reopen;
use crate::domain::{DepartureId, DepartureState, Tour, TourState};
use crate::store::StoreError;
use crate::store::words::Word;
use crate::store::writer::Writing;

/// Ends a tour that is out, and its departure.
pub(super) async fn of_tour(
    w: &mut Writing,
    tour: &Tour,
    end: TourState,
    departure: DepartureState,
    reason: Option<&str>,
) -> Result<(), StoreError> {
    let (now_us, change) = (w.now_us(), w.coming_change());
    let done = sqlx::query(
        "UPDATE tours SET state = ?, updated_us = ?, change = ? WHERE id = ? AND state = 'out'",
    )
    .bind(end.word())
    .bind(now_us)
    .bind(change)
    .bind(tour.id.to_string())
    .execute(&mut w.conn)
    .await?;
    w.took_changes(done.rows_affected());
    sqlx::query("UPDATE stops SET out = 0 WHERE tour_id = ?")
        .bind(tour.id.to_string())
        .execute(&mut w.conn)
        .await?;
    of_departure(w, tour.departure_id, departure, reason).await
}

/// Ends a departure that is not over, and reopens its requests.
pub(super) async fn of_departure(
    w: &mut Writing,
    id: DepartureId,
    end: DepartureState,
    reason: Option<&str>,
) -> Result<(), StoreError> {
    let (now_us, change) = (w.now_us(), w.coming_change());
    let done = sqlx::query(
        "UPDATE departures SET state = ?, reason = coalesce(?, reason), updated_us = ?, change = ? \
         WHERE id = ? AND state IN ('announced', 'closed', 'planned')",
    )
    .bind(end.word())
    .bind(reason.map(str::to_owned))
    .bind(now_us)
    .bind(change)
    .bind(id.to_string())
    .execute(&mut w.conn)
    .await?;
    w.took_changes(done.rows_affected());
    if done.rows_affected() > 0 {
        w.tally.ended.push(end);
    }
    w.tours_moved = true;
    reopen::all(w, id).await
}
