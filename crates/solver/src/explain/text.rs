//! The explanation in an operator's words.

use std::fmt::{self, Display, Formatter};

use super::change::{Buys, Change, NextChange};
use super::explanation::{
    Alone, Breach, CheapestInsertion, Clause, Explanation, WhyServed, WhyUnserved,
};
use super::sentence::phrase;
use super::words::{all_of, at_least, name, names, number, place, signed};
use crate::plan::{Reason, Status};
use crate::scenario::Objective;

/// So many sub-regions are told of one stop, and so many broken limits of one insertion.
const TOLD: usize = 2;
/// So many stops are told of one tour; the document has all.
const STOPS: usize = 12;

const HOPELESS: &str = "No single change of the capacity, the time span, the speed or one deadline makes \
a feasible tour.";

impl Display for Explanation {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let status = match self.status {
            Status::Optimal => "optimal: no tour is better.",
            Status::Feasible => "feasible: the tour keeps every constraint.",
            Status::BestEffort => "best_effort: no feasible tour was found, and none is ruled out.",
            Status::Infeasible => "infeasible: no tour keeps every constraint.",
        };
        writeln!(f, "{status}")?;
        self.write_conflict(f)?;
        write_list(f, "Not served:", &self.unserved, unserved)?;
        let objective = self.objective;
        write_list(f, "Served:", &self.served, |stop| served(stop, objective))?;
        write_list(f, "What a change would buy:", &self.next, next)?;
        if self.complete && self.conflict.is_some() && self.next.is_empty() {
            writeln!(f, "\n{HOPELESS}")?;
        }
        if !self.complete {
            writeln!(
                f,
                "\nNot every question got its answer in time; more time or iterations may tell more."
            )?;
        }
        Ok(())
    }
}

impl Explanation {
    fn write_conflict(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if let Some(tour) = &self.feasible_tour {
            writeln!(f, "\nA tour that keeps every constraint does exist: {}.", route(tour))?;
        }
        let Some(conflict) = &self.conflict else { return Ok(()) };
        let claim = if conflict.irreducible {
            "take any one of these away, and a tour exists that keeps the others"
        } else {
            "these contradict each other; perhaps fewer of them do"
        };
        writeln!(f, "\n{}\n\nConflict ({claim}):", conflict.sentence)?;
        conflict.clauses.iter().try_for_each(|clause| writeln!(f, "  {}", clause))
    }
}

impl Display for Clause {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&phrase(self))
    }
}

fn write_list<T>(
    f: &mut Formatter<'_>,
    title: &str,
    items: &[T],
    line: impl Fn(&T) -> String,
) -> fmt::Result {
    if items.is_empty() {
        return Ok(());
    }
    writeln!(f, "\n{title}")?;
    items.iter().try_for_each(|item| writeln!(f, "  {}", line(item)))
}

fn unserved(why: &WhyUnserved) -> String {
    let mut facts = Vec::new();
    match (&why.alone, why.reason) {
        (Some(alone), Reason::Unreachable | Reason::NoCapacity) => facts.push(alone_text(alone)),
        _ => facts.extend(why.insertion.as_ref().map(insertion)),
    }
    let more = if facts.is_empty() { String::new() } else { format!("; {}", facts.join("; ")) };
    format!("{}: {}{more}", name(&why.sensor), reason(why.reason))
}

fn reason(reason: Reason) -> &'static str {
    match reason {
        Reason::AlreadyCharged => "it is charged already",
        Reason::Unreachable => "it cannot be reached in time even as the only stop",
        Reason::NoCapacity => "the capacity does not pay for it even as the only stop",
        Reason::NotNeeded => "the tour is as good without it",
        Reason::NotChosen => "the tour does without it",
    }
}

fn alone_text(alone: &Alone) -> String {
    let due = alone.deadline_s.map(|s| format!(" (deadline {} s)", number(s))).unwrap_or_default();
    format!(
        "alone it is reached at {} s{due}, ends at {} s and takes {} J",
        number(alone.arrive_s),
        number(alone.finish_s),
        number(alone.energy_j)
    )
}

fn insertion(insertion: &CheapestInsertion) -> String {
    let place = match &insertion.after {
        Some(sensor) => format!("after {}", name(sensor)),
        None => "as the first stop".to_owned(),
    };
    let cost = format!(
        "{} m, {} s, {} J",
        signed(insertion.extra_m),
        signed(insertion.extra_s),
        signed(insertion.extra_j)
    );
    let mut breaks: Vec<String> = insertion.breaks.iter().take(TOLD).map(breach).collect();
    if insertion.breaks.len() > TOLD {
        breaks.push(format!("{} more limits would be broken", insertion.breaks.len() - TOLD));
    }
    if breaks.is_empty() {
        return format!("it would fit {place} ({cost})");
    }
    format!("{place} ({cost}) {}", all_of(&breaks))
}

fn breach(breach: &Breach) -> String {
    match breach {
        Breach::Deadline { sensor, arrive_s, deadline_s } => {
            format!("{} would be {} s late", name(sensor), at_least(arrive_s - deadline_s))
        }
        Breach::Capacity { energy_j, capacity_j } => {
            format!("the tour would take {} J more than there are", at_least(energy_j - capacity_j))
        }
        Breach::Timespan { finish_s, timespan_s } => {
            format!("the tour would end {} s too late", at_least(finish_s - timespan_s))
        }
    }
}

fn served(stop: &WhyServed, objective: Objective) -> String {
    let mut loses = Vec::new();
    if stop.required {
        loses.push("a required request would not be served".to_owned());
    }
    for short in stop.short.iter().take(TOLD) {
        let at = place(short.at_m);
        loses.push(format!(
            "the sub-region at {at} would have {} of {} it needs",
            short.has, short.needs
        ));
    }
    if stop.short.len() > TOLD {
        loses.push(format!("{} more sub-regions would be short", stop.short.len() - TOLD));
    }
    match objective {
        Objective::MaxReward if stop.reward > 0.0 => {
            loses.push(format!("a reward of {} would be lost", number(stop.reward)));
        }
        Objective::MaxCount => loses.push("one stop less would count".to_owned()),
        _ => {}
    }
    loses.extend(stop.breaks.iter().map(breach));
    let mut saves = format!(
        "{} m, {} s, {} J",
        signed(-stop.saves_m),
        signed(-stop.saves_s),
        signed(-stop.saves_j)
    );
    if loses.is_empty() {
        loses.push("nothing would break: it is only passed by".to_owned());
    }
    saves.insert_str(0, "without it ");
    format!("{}: {saves}; {}", name(&stop.sensor), all_of(&loses))
}

fn next(next: &NextChange) -> String {
    let change = match &next.change {
        Change::Capacity { from_j, to_j } => {
            format!("a capacity of {} J (now {})", at_least(*to_j), number(*from_j))
        }
        Change::Timespan { from_s, to_s } => {
            format!("a time span of {} s (now {})", at_least(*to_s), number(*from_s))
        }
        Change::Speed { from_mps, to_mps } => {
            format!("a speed of {} m/s (now {})", at_least(*to_mps), number(*from_mps))
        }
        Change::Deadline { sensor, from_s, to_s } => {
            let (sensor, to) = (name(sensor), at_least(*to_s));
            format!("a deadline of {to} s for {sensor} (now {})", number(*from_s))
        }
    };
    let buys = match &next.buys {
        Buys::Feasible => "makes a feasible tour".to_owned(),
        Buys::Stop { sensor, from, to } => {
            format!(
                "has {} served too: {} in place of {}",
                name(sensor),
                number(*to),
                number(*from)
            )
        }
        Buys::Shorter { from_m, to_m } => {
            format!("shortens the tour by {} m to {} m", number(from_m - to_m), number(*to_m))
        }
    };
    let proof = match next.too_little {
        Some(value) if next.proven => {
            format!("; no less would do ({} is proven too little)", number(value))
        }
        Some(value) => format!("; {} is too little, what lies between is open", number(value)),
        None => String::new(),
    };
    format!("{change} {buys}{proof} (tour: {})", route(&next.tour))
}

fn route(tour: &[String]) -> String {
    let more = tour.len().saturating_sub(STOPS);
    match (tour.len(), more) {
        (0, _) => "no stop".to_owned(),
        (_, 0) => names(tour),
        _ => format!("{} and {more} more", names(&tour[..STOPS])),
    }
}
