//! A random history of a store, and what of it was acknowledged while there was power.

use std::collections::HashMap;

use futures_util::future::join_all;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use voltour_power_loss::Disk;

use crate::domain::{
    Departure, DepartureId, NewRequest, NewVisit, Outcome, Refusal, Request, RequestId, Tour,
    TourId, Visit,
};
use crate::store::fixture::{Bench, asks, report, spec};
use crate::store::{Closing, Storing};

/// What was acknowledged last of each.
#[derive(Debug, Default)]
pub struct Acknowledged {
    pub submitted: Vec<(String, NewRequest, RequestId)>,
    pub visited: Vec<(String, NewVisit, Visit)>,
    pub requests: HashMap<RequestId, Request>,
    pub departures: HashMap<DepartureId, Departure>,
    pub tours: HashMap<TourId, Tour>,
    out: Vec<TourId>,
}

/// Somebody at work on a store until the power goes.
pub struct History<'a> {
    pub bench: &'a Bench,
    pub disk: &'a Disk,
    pub dice: Pcg64Mcg,
    pub acknowledged: Acknowledged,
}

impl History<'_> {
    pub async fn run(&mut self) {
        // Without power from the first, there is no network either.
        let _ = self.bench.try_put(spec()).await;
        while !self.disk.is_cut() {
            let done = match self.dice.random_range(0..10) {
                0..5 => self.submit().await,
                5 => self.withdraw().await,
                6 | 7 => self.depart().await,
                8 => self.visit().await,
                _ => self.end().await,
            };
            // What a rule forbids is no failure; without power everything is one.
            if !matches!(done, Ok(()) | Err(Refusal::FailedPrecondition(_))) {
                assert!(self.disk.is_cut(), "{done:?}");
            }
            self.bench.advance(self.dice.random_range(0..3));
        }
    }

    /// What came before the cut counts.
    fn told<T>(&self, answer: T) -> Option<T> {
        (!self.disk.is_cut()).then_some(answer)
    }

    /// Several at once: one transaction.
    async fn submit(&mut self) -> Result<(), Refusal> {
        let sensor = |dice: &mut Pcg64Mcg| format!("s{}", dice.random_range(0..5));
        let number = self.dice.random_range(1..12);
        let calls: Vec<_> =
            (0..number).map(|_| (self.bench.fresh(), asks(&sensor(&mut self.dice)))).collect();
        let answers = calls.iter().map(|(id, asked)| self.bench.try_submit(id, asked.clone()));
        for ((id, asked), answer) in calls.clone().into_iter().zip(join_all(answers).await) {
            if let Some(request) = self.told(answer?) {
                self.acknowledged.submitted.push((id, asked, request.id));
                self.acknowledged.requests.insert(request.id, request);
            }
        }
        Ok(())
    }

    async fn withdraw(&mut self) -> Result<(), Refusal> {
        let submitted = &self.acknowledged.submitted;
        if submitted.is_empty() {
            return Ok(());
        }
        let id =
            submitted[submitted.len() - 1 - self.dice.random_range(0..submitted.len().min(9))].2;
        let request = self.bench.withdraw(id).await?;
        if let Some(request) = self.told(request) {
            self.acknowledged.requests.insert(request.id, request);
        }
        Ok(())
    }

    /// A departure as far as it goes: its charger may have a tour out.
    async fn depart(&mut self) -> Result<(), Refusal> {
        let charger = format!("c{}", self.dice.random_range(0..3));
        let leaves = crate::store::fixture::leaves(&charger, None);
        let departure = self.bench.try_announce(&self.bench.fresh(), leaves).await?;
        let id = departure.id;
        let Some(departure) = self.told(departure) else { return Ok(()) };
        self.acknowledged.departures.insert(id, departure);
        let batch = match self.bench.try_close(id).await? {
            Closing::Closed(batch) => batch,
            Closing::ChargerOut => return self.call_off(id).await,
            other => panic!("{other:?}"),
        };
        let sensors: Vec<_> =
            batch.requests.iter().map(|request| request.asked.sensor_id.to_string()).collect();
        let taken = self.dice.random_range(0..=sensors.len());
        let stops: Vec<&str> = sensors.iter().take(taken).map(String::as_str).collect();
        let stored = self.bench.store_plan(&batch, &stops).await?;
        let Storing::Stored(tour) = stored else { panic!("{stored:?}") };
        if self.told(()).is_some() {
            self.acknowledged.out.push(tour);
        }
        self.look(tour).await;
        Ok(())
    }

    async fn call_off(&mut self, id: DepartureId) -> Result<(), Refusal> {
        let departure = self.bench.cancel(id).await?;
        if let Some(departure) = self.told(departure) {
            self.acknowledged.departures.insert(id, departure);
        }
        Ok(())
    }

    async fn visit(&mut self) -> Result<(), Refusal> {
        let Some(&id) = self.acknowledged.out.last() else { return Ok(()) };
        let outcome = if self.dice.random() { Outcome::Charged } else { Outcome::Failed };
        let what = report(id, &format!("s{}", self.dice.random_range(0..5)), outcome);
        let call = self.bench.fresh();
        let visit = self.bench.try_visit(&call, what.clone()).await?;
        if let Some(visit) = self.told(visit) {
            self.acknowledged.visited.push((call, what, visit));
        }
        self.look(id).await;
        Ok(())
    }

    async fn end(&mut self) -> Result<(), Refusal> {
        if self.acknowledged.out.is_empty() {
            return Ok(());
        }
        let which = self.dice.random_range(0..self.acknowledged.out.len());
        let id = self.acknowledged.out.remove(which);
        if self.dice.random() {
            self.bench.complete(id).await?;
        } else if let Some(tour) = self.acknowledged.tours.get(&id) {
            self.bench.cancel(tour.departure_id).await?;
        }
        self.look(id).await;
        Ok(())
    }

    /// What others see of a tour, they may count on.
    async fn look(&mut self, id: TourId) {
        let Ok(Some(tour)) = self.bench.store.reads.tour(id).await else { return };
        if let Some(tour) = self.told(tour) {
            self.acknowledged.tours.insert(id, tour);
        }
    }
}
