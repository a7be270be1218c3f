//! The contradiction of a conflict in one sentence.

use super::explanation::{Alone, Clause};
use super::words::{all_of, name, names, number, place, sentence_case};
use crate::instance::Instance;
use crate::tolerance::holds;

/// So many sensors are told one by one.
const TOLD: usize = 4;

/// The sentence for a conflict; `alone` are the sensors that its demands name.
pub(super) fn of(clauses: &[Clause], alone: &[Alone], instance: &Instance<'_>) -> String {
    let conflict = Parts::of(clauses);
    match conflict.demands[..] {
        [] => nothing_asked(&conflict, instance),
        [demand] if conflict.strangers(alone).is_empty() => {
            let asked = format!("{}{}", phrase(demand), conflict.before(alone));
            let why = single(demand, &conflict, alone, instance);
            let named = matches!(demand, Clause::Required { .. });
            format!("{}; {why}.", sentence_case(&asked, named))
        }
        _ => several(&conflict, alone),
    }
}

/// A conflict, sorted by kind.
struct Parts<'a> {
    demands: Vec<&'a Clause>,
    deadlines: Vec<(&'a str, f64)>,
    timespan_s: Option<f64>,
    capacity_j: Option<f64>,
}

impl<'a> Parts<'a> {
    fn of(clauses: &'a [Clause]) -> Self {
        let mut parts =
            Self { demands: Vec::new(), deadlines: Vec::new(), timespan_s: None, capacity_j: None };
        for clause in clauses {
            match clause {
                Clause::Demand { .. } | Clause::Required { .. } => parts.demands.push(clause),
                Clause::Deadline { sensor, deadline_s } => {
                    parts.deadlines.push((sensor, *deadline_s));
                }
                Clause::Timespan { timespan_s } => parts.timespan_s = Some(*timespan_s),
                Clause::Capacity { capacity_j } => parts.capacity_j = Some(*capacity_j),
            }
        }
        parts
    }

    /// Deadlines of sensors that no demand names: without the triangle inequality they may be in the way.
    fn strangers(&self, alone: &[Alone]) -> Vec<String> {
        let stranger = |(sensor, _): &&(&str, f64)| !alone.iter().any(|a| a.sensor == *sensor);
        self.deadlines.iter().filter(stranger).map(due).collect()
    }

    /// The deadlines of the sensors named just before: one for all, or each its own.
    fn before(&self, alone: &[Alone]) -> String {
        match self.deadlines[..] {
            [] => String::new(),
            [(_, first), ..]
                if self.deadlines.len() == alone.len()
                    && self.deadlines.iter().all(|(_, other)| *other == first) =>
            {
                format!(" before {} s", number(first))
            }
            _ => format!(" ({})", self.deadlines.iter().map(due).collect::<Vec<_>>().join(", ")),
        }
    }
}

fn due((sensor, deadline_s): &(&str, f64)) -> String {
    format!("{} before {} s", name(sensor), number(*deadline_s))
}

/// What a demand asks.
pub(super) fn phrase(demand: &Clause) -> String {
    match demand {
        Clause::Required { sensor } => format!("{} is required", name(sensor)),
        Clause::Demand { at_m, needs, members } => {
            let whom = match (*needs, members.len()) {
                (_, 1) => String::new(),
                (1, _) => "one of ".to_owned(),
                (2, 2) => "both of ".to_owned(),
                (needs, all) if needs as usize == all => "all of ".to_owned(),
                (needs, _) => format!("{needs} of "),
            };
            format!("the sub-region at {} needs {whom}{}", place(*at_m), names(members))
        }
        Clause::Deadline { sensor, deadline_s } => {
            format!("{} must be reached before {} s", name(sensor), number(*deadline_s))
        }
        Clause::Capacity { capacity_j } => {
            format!("the charger has {} J", number(*capacity_j))
        }
        Clause::Timespan { timespan_s } => {
            format!("the charger must be at the end before {} s", number(*timespan_s))
        }
    }
}

/// Even the empty trip is too much.
fn nothing_asked(conflict: &Parts<'_>, instance: &Instance<'_>) -> String {
    let end = instance.finish(&instance.departure());
    match (conflict.timespan_s, conflict.capacity_j) {
        (Some(timespan_s), None) if conflict.deadlines.is_empty() => format!(
            "Even without a stop the charger is at the end at {} s only, and must be there before {} s.",
            number(end.arrive_s),
            number(timespan_s)
        ),
        (None, Some(capacity_j)) if conflict.deadlines.is_empty() => format!(
            "Even without a stop the way takes {} J, and the charger has {} J.",
            number(instance.energy_j(&end)),
            number(capacity_j)
        ),
        _ => several(conflict, &[]),
    }
}

/// Why one demand cannot be met.
fn single(
    demand: &Clause,
    conflict: &Parts<'_>,
    alone: &[Alone],
    instance: &Instance<'_>,
) -> String {
    let needs = match demand {
        Clause::Demand { needs, .. } => *needs as usize,
        _ => 1,
    };
    match (!conflict.deadlines.is_empty(), conflict.timespan_s, conflict.capacity_j) {
        (true, None, None) => {
            let when = match instance.scenario.travel {
                None => "at the earliest ",
                Some(_) => "as the only stop ",
            };
            let takes = |a: &Alone| (a.arrive_s, a.deadline_s.unwrap_or(f64::INFINITY));
            let (able, facts) =
                told(alone, takes, &[when, " is reached at ", " at "], " s", "later");
            format!("{}{facts}", cannot("reach", " in time", needs, alone.len(), able))
        }
        (false, Some(timespan_s), None) => {
            let takes = |a: &Alone| (a.finish_s, timespan_s);
            let words = ["with ", " alone it is there at ", " at "];
            let (able, facts) = told(alone, takes, &words, " s", "later");
            let tail = format!(" and be at the end before {} s", number(timespan_s));
            format!("{}{facts}", cannot("charge", &tail, needs, alone.len(), able))
        }
        (false, None, Some(capacity_j)) => {
            let takes = |a: &Alone| (a.energy_j, capacity_j);
            let (able, facts) = told(alone, takes, &["", " alone takes ", " "], " J", "more");
            let tail = format!(" with {} J", number(capacity_j));
            format!("{}{facts}", cannot("charge", &tail, needs, alone.len(), able))
        }
        (_, timespan_s, capacity_j) => {
            let end = timespan_s.map(|s| format!("be at the end before {} s", number(s)));
            let pay = capacity_j.map(|j| format!("do with {} J", number(j)));
            let more: Vec<String> = end.into_iter().chain(pay).collect();
            format!("the charger cannot do that and {}", all_of(&more))
        }
    }
}

/// How many sensors keep their limit as the only stop, and what each of them takes, in words: what stands before the
/// first name, after it, and after each further one.
fn told(
    alone: &[Alone],
    takes: impl Fn(&Alone) -> (f64, f64),
    words: &[&str; 3],
    unit: &str,
    worse: &str,
) -> (usize, String) {
    let able = alone.iter().filter(|&a| holds(takes(a).0, takes(a).1)).count();
    let mut sorted: Vec<&Alone> = alone.iter().collect();
    sorted.sort_by(|a, b| takes(a).0.total_cmp(&takes(b).0));
    let [before, first, further] = words;
    let fact = |(i, a): (usize, &&Alone)| {
        let verb = if i == 0 { first } else { further };
        format!("{}{verb}{}{unit}", name(&a.sensor), number(takes(a).0))
    };
    let mut facts: Vec<String> = sorted.iter().take(TOLD).enumerate().map(fact).collect();
    if sorted.len() > TOLD {
        facts.push(format!("the others {worse}"));
    }
    (able, format!(": {before}{}", all_of(&facts)))
}

/// That so many of them are too many, where `able` of `all` would be possible one at a time.
fn cannot(verb: &str, tail: &str, needs: usize, all: usize, able: usize) -> String {
    let whom = match (needs, all, able) {
        (_, 1, _) => "it".to_owned(),
        (1, 2, 0) => "either".to_owned(),
        (_, _, 0) => "any of them".to_owned(),
        (needs, _, able) if able < needs => format!("more than {able} of them"),
        (2, 2, _) => "both".to_owned(),
        (needs, all, _) if needs == all => "all of them".to_owned(),
        (needs, ..) => format!("{needs} of them"),
    };
    format!("the charger cannot {verb} {whom}{tail}")
}

/// Several demands, each good by itself.
fn several(conflict: &Parts<'_>, alone: &[Alone]) -> String {
    let due_of = |sensor: &str| conflict.deadlines.iter().find(|(s, _)| *s == sensor);
    let mut told: Vec<&str> = Vec::new();
    let mut phrases: Vec<String> = Vec::new();
    for demand in &conflict.demands {
        let members = match demand {
            Clause::Demand { members, .. } => members.as_slice(),
            Clause::Required { sensor } => std::slice::from_ref(sensor),
            _ => &[],
        };
        // A deadline is told once, where its sensor is first named.
        let new = members.iter().filter_map(|m| due_of(m)).filter(|(s, _)| !told.contains(s));
        let new: Vec<&(&str, f64)> = new.collect();
        told.extend(new.iter().map(|(sensor, _)| *sensor));
        let due = match (demand, &new[..]) {
            (_, []) => String::new(),
            (Clause::Required { .. }, [(_, deadline_s), ..]) => {
                format!(" before {} s", number(*deadline_s))
            }
            _ => format!(" ({})", new.iter().map(|d| due(d)).collect::<Vec<_>>().join(", ")),
        };
        phrases.push(format!("{}{due}", phrase(demand)));
    }
    let strangers = conflict.strangers(alone);
    if !strangers.is_empty() {
        phrases.push(format!("on the way, {}", all_of(&strangers)));
    }
    phrases.extend(conflict.timespan_s.map(|timespan_s| phrase(&Clause::Timespan { timespan_s })));
    phrases.extend(conflict.capacity_j.map(|capacity_j| phrase(&Clause::Capacity { capacity_j })));
    let named = matches!(conflict.demands.first(), Some(Clause::Required { .. }));
    format!("{}: no tour keeps all of this together.", sentence_case(&phrases.join("; "), named))
}
