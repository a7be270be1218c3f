//! A tour of which nothing was heard for too long.

use std::time::Duration;

use super::ending;
use crate::clock::plus;
use crate::domain::{DepartureState, TourId, TourState};
use crate::store::cells::Cells;
use crate::store::read;
use crate::store::writer::{Command, Failure, Writing};

/// Gives a tour up if nothing was heard of it for `after`; the answer is whether it did.
#[derive(Debug)]
pub struct Overdue {
    /// The tour.
    pub tour_id: TourId,
    /// How long after the last report, or the planned finish if later.
    pub after: Duration,
}

impl Command for Overdue {
    type Answer = bool;

    async fn apply(&self, w: &mut Writing) -> Result<bool, Failure> {
        let row = sqlx::query("SELECT heard_us FROM tours WHERE id = ? AND state = 'out'");
        let row = row.bind(self.tour_id.to_string()).fetch_optional(&mut w.conn).await?;
        let Some(row) = row else { return Ok(false) };
        if plus(Cells::new("tours", &row).time("heard_us")?, self.after) > w.now {
            return Ok(false);
        }
        let Some(tour) = read::tour(&mut w.conn, self.tour_id).await? else { return Ok(false) };
        let end = (TourState::Overdue, DepartureState::Overdue);
        let reason = Some("nothing was heard of its tour");
        ending::of_tour(w, &tour, end.0, end.1, reason).await?;
        Ok(true)
    }
}
