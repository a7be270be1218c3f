//! Which candidates a partial tour can still serve in time, told from those that it must.
//!
//! Every stop takes the time of its charge and of the shortest way to it. Those that must be served, in the
//! order of their deadlines, are all in time or no order makes them so (J. R. Jackson, "Scheduling a
//! production line to minimize maximum tardiness", 1955). Who fits nowhere among them is out of reach,
//! which may make other members of its demands necessary.

use super::Model;
use super::bits::Bits;
use crate::tour::Run;

/// A stop that must be made.
#[derive(Clone, Copy, Debug)]
struct Job {
    candidate: u32,
    /// Its way and its charge at least, in seconds.
    takes_s: f64,
    /// When it must be done, in seconds, with some room for rounding.
    by_s: f64,
    /// What those before it and itself take, in seconds.
    until_s: f64,
    /// By how much the first of the stops can be put off before this one is late, in seconds.
    slack_s: f64,
}

/// A schedule of the stops that must be made, and who fits into it.
pub struct Timetable {
    /// By candidate, the shortest way to it, in seconds.
    way_s: Vec<f64>,
    /// Whether some candidate has a deadline.
    binds: bool,
    jobs: Vec<Job>,
    /// By job, the least slack of those before it; last, of all.
    before_s: Vec<f64>,
    /// By job, the least slack from it on; last, infinite.
    after_s: Vec<f64>,
}

impl Timetable {
    pub fn new(model: &Model<'_>) -> Self {
        let instance = &model.wide;
        let n = model.len();
        let speed_mps = instance.scenario.charger.speed_mps;
        let way_s = |to: usize| {
            // A sensor that moves may come to the charger.
            if instance.moving {
                return 0.0;
            }
            let froms = (0..n).chain([instance.start()]).filter(|&from| from != to);
            froms
                .map(|from| instance.distance_m(from, to) / speed_mps)
                .fold(f64::INFINITY, f64::min)
        };
        Self {
            way_s: (0..n).map(way_s).collect(),
            binds: instance.candidates.iter().any(|c| c.due_s.is_finite()),
            jobs: Vec::new(),
            before_s: vec![f64::INFINITY],
            after_s: vec![f64::INFINITY],
        }
    }

    /// Takes out of `pool`, whom `run` may still serve, those whom it cannot; whether the demands left can be
    /// met. `open` has, by demand, its members and how many more of them it needs.
    pub fn keeps<const W: usize>(
        &mut self,
        model: &Model<'_>,
        run: &Run,
        open: &[(Bits<W>, u32)],
        pool: &mut Bits<W>,
    ) -> bool {
        loop {
            let mut must = Bits::EMPTY;
            for (members, needs) in open {
                let left = members.common(pool);
                if left < *needs {
                    return false;
                }
                if left == *needs {
                    must = must.union(&members.both(pool));
                }
            }
            if !self.schedule(model, run, &must) {
                return false;
            }
            let before = *pool;
            if !must.is_empty() && self.binds {
                for candidate in before.minus(&must).iter() {
                    if !self.fits(run, self.job(model, run, candidate)) {
                        pool.remove(candidate);
                    }
                }
            }
            if *pool == before {
                return true;
            }
        }
    }

    /// Whether, after going on as `next` does, those who must be served still can be.
    pub fn admits(&self, run: &Run, next: &Run) -> bool {
        let delay_s = next.depart_s - run.depart_s;
        match self.jobs.iter().position(|job| job.candidate == next.node) {
            Some(place) => {
                delay_s <= self.before_s[place]
                    && delay_s - self.jobs[place].takes_s <= self.after_s[place + 1]
            }
            None => delay_s <= self.after_s[0],
        }
    }

    fn fits(&self, run: &Run, job: Job) -> bool {
        let place = self.jobs.partition_point(|other| other.by_s <= job.by_s);
        let before_s = place.checked_sub(1).map_or(0.0, |last| self.jobs[last].until_s);
        run.depart_s + before_s + job.takes_s <= job.by_s && job.takes_s <= self.after_s[place]
    }

    fn job(&self, model: &Model<'_>, run: &Run, candidate: u32) -> Job {
        let c = &model.wide.candidates[candidate as usize];
        // Charged later, it takes no less.
        let charge_s = c.charge_j(run.depart_s) * model.wide.transfer_spj;
        let takes_s = self.way_s[candidate as usize] + charge_s;
        let by_s = (c.due_s + charge_s) * (1.0 + 1e-12) + 1e-6;
        Job { candidate, takes_s, by_s, until_s: 0.0, slack_s: 0.0 }
    }

    /// Puts stops in the order of their deadlines; whether all of them are in time.
    fn schedule<const W: usize>(&mut self, model: &Model<'_>, run: &Run, must: &Bits<W>) -> bool {
        let mut jobs = std::mem::take(&mut self.jobs);
        jobs.clear();
        if self.binds {
            jobs.extend(must.iter().map(|candidate| self.job(model, run, candidate)));
        }
        jobs.sort_unstable_by(|a, b| a.by_s.total_cmp(&b.by_s));
        let (mut done_s, mut until_s, mut least_s) = (run.depart_s, 0.0, f64::INFINITY);
        self.before_s.clear();
        for job in &mut jobs {
            done_s += job.takes_s;
            until_s += job.takes_s;
            job.until_s = until_s;
            job.slack_s = job.by_s - done_s;
            self.before_s.push(least_s);
            least_s = least_s.min(job.slack_s);
        }
        self.before_s.push(least_s);
        self.after_s.clear();
        self.after_s.resize(jobs.len() + 1, f64::INFINITY);
        for (k, job) in jobs.iter().enumerate().rev() {
            self.after_s[k] = self.after_s[k + 1].min(job.slack_s);
        }
        self.jobs = jobs;
        least_s >= 0.0
    }
}
