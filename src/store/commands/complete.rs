//! `Complete`: the charger is back.

use super::ending;
use super::remembered::Remembered;
use crate::domain::{Call, DepartureState, Refusal, Tour, TourId, TourState};
use crate::store::read;
use crate::store::words::Word;
use crate::store::writer::{Command, Failure, Writing};

/// A tour that is over.
#[derive(Debug)]
pub struct Complete(pub Call<TourId>);

impl Command for Complete {
    type Answer = Tour;

    async fn apply(&self, w: &mut Writing) -> Result<Tour, Failure> {
        let id = self.0.content;
        let call = Remembered::new("complete", id, &self.0);
        let before: Option<TourId> = call.find(w).await?;
        let missing = || Refusal::NotFound { what: "tour", id: id.to_string() };
        let tour = read::tour(&mut w.conn, id).await?.ok_or_else(missing)?;
        if before.is_some() {
            return Ok(tour);
        }
        if tour.state != TourState::Out {
            let reason = format!("tour {id} is {} already", tour.state.word());
            return Err(Refusal::FailedPrecondition(reason).into());
        }
        let end = (TourState::Completed, DepartureState::Completed);
        ending::of_tour(w, &tour, end.0, end.1, None).await?;
        call.keep(w, &id).await?;
        Ok(read::tour(&mut w.conn, id).await?.ok_or_else(missing)?)
    }
}
