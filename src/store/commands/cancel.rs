//! `Cancel`: calls a departure off, or its tour back.

use super::ending;
use super::remembered::Remembered;
use crate::domain::{
    Call, CancelDeparture, Departure, DepartureId, DepartureState, Refusal, TourState, rules,
};
use crate::store::read;
use crate::store::words::Word;
use crate::store::writer::{Command, Failure, Writing};

/// A departure to call off.
#[derive(Debug)]
pub struct Cancel(pub Call<CancelDeparture>);

impl Command for Cancel {
    type Answer = Departure;

    async fn apply(&self, w: &mut Writing) -> Result<Departure, Failure> {
        let CancelDeparture { departure_id: id, reason } = &self.0.content;
        let call = Remembered::new("cancel", id, &self.0);
        let before: Option<DepartureId> = call.find(w).await?;
        let missing = || Refusal::NotFound { what: "departure", id: id.to_string() };
        let departure = read::departure(&mut w.conn, *id).await?.ok_or_else(missing)?;
        if before.is_some() {
            return Ok(departure);
        }
        rules::cancellation(reason)?;
        let (end, reason) = (DepartureState::Cancelled, Some(reason.as_str()));
        match departure.state {
            DepartureState::Announced | DepartureState::Closed => {
                ending::of_departure(w, *id, end, reason).await?;
            }
            DepartureState::Planned => {
                for tour in &departure.tour_ids {
                    if let Some(tour) = read::tour(&mut w.conn, *tour).await? {
                        ending::of_tour(w, &tour, TourState::Cancelled, end, reason).await?;
                    }
                }
            }
            over => {
                let reason = format!("departure {id} is {} already", over.word());
                return Err(Refusal::FailedPrecondition(reason).into());
            }
        }
        call.keep(w, id).await?;
        Ok(read::departure(&mut w.conn, *id).await?.ok_or_else(missing)?)
    }
}
