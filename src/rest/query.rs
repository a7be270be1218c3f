//! Query parameters: each read once, every fault named, unknown ones refused. The cursor of a list is
//! its last id in base64url: opaque, so that what it holds may change.

use std::fmt::Display;
use std::str::FromStr;

use axum::extract::Query;
use axum::http::Uri;
use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use jiff::Timestamp;
use serde::de::value::{Error as ValueError, StrDeserializer};
use serde::de::{Deserialize, IntoDeserializer};

use super::problem::Problem;
use crate::domain::FieldViolation;
use crate::store::Page;

/// Longer than the cursor of any id.
const LONGEST_CURSOR: usize = 128;

/// The parameters of a call, and what is wrong with those read so far.
pub(super) struct Params {
    pairs: Vec<(String, String)>,
    known: Vec<&'static str>,
    errors: Vec<FieldViolation>,
}

impl Params {
    /// From the address of a call.
    pub fn of(uri: &Uri) -> Result<Self, Problem> {
        let Query(pairs) = Query::<Vec<(String, String)>>::try_from_uri(uri).map_err(|_| {
            refusal("query", "must be name=value pairs joined by &, percent-encoded in UTF-8")
        })?;
        Ok(Self { pairs, known: Vec::new(), errors: Vec::new() })
    }

    /// For calls that have none.
    pub fn none(uri: &Uri) -> Result<(), Problem> {
        Self::of(uri)?.finish()
    }

    /// A parameter that may be given once.
    pub fn one<T: FromStr<Err: Display>>(&mut self, name: &'static str) -> Option<T> {
        let text = self.text(name)?;
        // The error of an id names the value itself.
        self.keep(name, text.parse().map_err(|error: T::Err| error.to_string()))
    }

    /// A time, in RFC 3339.
    pub fn time(&mut self, name: &'static str) -> Option<Timestamp> {
        const RULE: &str = "must be an RFC 3339 time such as 2026-01-31T12:00:00Z (a + is %2B)";
        let text = self.text(name)?;
        self.keep(name, text.parse().map_err(|_| broken(&text, RULE)))
    }

    /// One of the names of an enumeration.
    pub fn named<T: Named>(&mut self, name: &'static str) -> Option<T> {
        let text = self.text(name)?;
        self.keep(name, parse_named(&text))
    }

    /// Names of an enumeration; the parameter may be repeated.
    pub fn several<T: Named>(&mut self, name: &'static str) -> Vec<T> {
        self.known.push(name);
        let texts = self.pairs.iter().filter(|(key, _)| key == name);
        let read: Vec<_> = texts.map(|(_, text)| parse_named(text)).collect();
        read.into_iter().filter_map(|one| self.keep(name, one)).collect()
    }

    /// `limit` and `cursor`; `Id` is the id that the list goes by.
    pub fn page<Id: FromStr>(&mut self) -> Page {
        let rule = format!("must be a whole number from 1 to {}", Page::LARGEST);
        let limit = self.text("limit").and_then(|text| {
            let number = text.parse().ok().filter(|n| (1..=Page::LARGEST).contains(n));
            self.keep("limit", number.ok_or_else(|| broken(&text, &rule)))
        });
        let after = self.text("cursor").and_then(|text| {
            let id = decode::<Id>(&text);
            self.keep("cursor", id.ok_or_else(|| broken(&text, "is no next_cursor of this list")))
        });
        Page { limit: limit.unwrap_or(Page::DEFAULT), after }
    }

    /// Refuses what was wrong, and every name that nobody asked for.
    pub fn finish(mut self) -> Result<(), Problem> {
        let known = match self.known.as_slice() {
            [] => "there are no parameters here".to_owned(),
            names => format!("known here: {}", names.join(", ")),
        };
        let unknown = self.pairs.iter().filter(|(name, _)| !self.known.contains(&name.as_str()));
        let unknown: Vec<_> = unknown
            // A flood of parameters gets a short answer.
            .take(10)
            .map(|(name, _)| FieldViolation {
                field: name.chars().take(80).collect(),
                description: format!("unknown parameter; {known}"),
            })
            .collect();
        self.errors.extend(unknown);
        if self.errors.is_empty() { Ok(()) } else { Err(Problem::invalid(self.errors)) }
    }

    fn text(&mut self, name: &'static str) -> Option<String> {
        self.known.push(name);
        let mut texts = self.pairs.iter().filter(|(key, _)| key == name).map(|(_, text)| text);
        let first = texts.next().cloned();
        if texts.next().is_some() {
            return self.keep(name, Err("given more than once".to_owned()));
        }
        first
    }

    fn keep<T>(&mut self, name: &'static str, read: Result<T, String>) -> Option<T> {
        match read {
            Ok(value) => Some(value),
            Err(_) if self.errors.len() >= 20 => None,
            Err(description) => {
                self.errors.push(FieldViolation { field: name.to_owned(), description });
                None
            }
        }
    }
}

/// An enumeration whose names serde knows.
pub(super) trait Named: for<'a> Deserialize<'a> {
    /// What a value must be one of.
    const NAMES: &'static str;
}

fn parse_named<T: Named>(text: &str) -> Result<T, String> {
    let from: StrDeserializer<'_, ValueError> = text.into_deserializer();
    T::deserialize(from).map_err(|_| broken(text, &format!("must be one of {}", T::NAMES)))
}

impl Named for crate::domain::RequestState {
    const NAMES: &'static str = "open, batched, planned, served, expired, withdrawn, superseded";
}

impl Named for crate::domain::DepartureState {
    const NAMES: &'static str = "announced, closed, planned, completed, overdue, cancelled, missed";
}

/// The value, cut, and the rule that it breaks.
fn broken(text: &str, rule: &str) -> String {
    let start: String = text.chars().take(80).collect();
    format!("{start:?} {rule}")
}

/// One field that breaks a rule.
pub(super) fn refusal(field: &str, description: impl Into<String>) -> Problem {
    Problem::invalid(vec![FieldViolation { field: field.into(), description: description.into() }])
}

/// The cursor for the page after this id.
pub(super) fn cursor(next: Option<String>) -> Option<String> {
    next.map(|id| URL_SAFE_NO_PAD.encode(id))
}

fn decode<Id: FromStr>(cursor: &str) -> Option<String> {
    let bytes = URL_SAFE_NO_PAD.decode(cursor).ok().filter(|_| cursor.len() <= LONGEST_CURSOR)?;
    String::from_utf8(bytes).ok().filter(|id| id.parse::<Id>().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::{NetworkId, PlanId, RequestState};

    const ID: &str = "01890a5d-ac96-774b-bcce-b302099a8057";

    fn params(query: &str) -> Params {
        Params::of(&format!("/x?{query}").parse().unwrap()).map_err(|_| ()).unwrap()
    }

    fn fields(problem: Problem) -> Vec<(String, String)> {
        let json = serde_json::to_value(problem).unwrap();
        let text = |value: &serde_json::Value| value.as_str().unwrap().to_owned();
        let errors = json["errors"].as_array().unwrap().iter();
        errors.map(|e| (text(&e["field"]), text(&e["description"]))).collect()
    }

    #[test]
    fn good_parameters_are_read() {
        let cursor = cursor(Some(ID.into())).unwrap();
        let query = format!(
            "network=north:1&state=open&state=planned&from=2026-01-31T12:00:00%2B01:00\
             &limit=500&cursor={cursor}"
        );
        let mut params = params(&query);
        assert_eq!(params.one::<NetworkId>("network").unwrap().as_str(), "north:1");
        let states: Vec<RequestState> = params.several("state");
        assert_eq!(states, [RequestState::Open, RequestState::Planned]);
        assert_eq!(params.time("from").unwrap().to_string(), "2026-01-31T11:00:00Z");
        let page = params.page::<PlanId>();
        assert_eq!((page.limit, page.after.as_deref()), (500, Some(ID)));
        assert!(params.finish().is_ok());
    }

    #[test]
    fn every_fault_is_named() {
        let mut params = params("network=a%20b&state=opn&from=now&limit=0&cursor=!&colour=red");
        params.one::<NetworkId>("network");
        params.several::<RequestState>("state");
        params.time("from");
        params.page::<PlanId>();
        let faults = fields(params.finish().unwrap_err());
        let names: Vec<_> = faults.iter().map(|(field, _)| field.as_str()).collect();
        assert_eq!(names, ["network", "state", "from", "limit", "cursor", "colour"]);
        assert!(faults[1].1.starts_with("\"opn\" must be one of open, batched"));
        assert!(faults[5].1.contains("known here: network, state, from, limit, cursor"));
    }

    #[test]
    fn repetitions_and_strangers_are_refused() {
        let mut twice = params("limit=1&limit=2");
        assert_eq!(twice.page::<PlanId>().limit, Page::DEFAULT);
        assert_eq!(fields(twice.finish().unwrap_err())[0].1, "given more than once");
        let uri: Uri = "/v1/plans/1?x=1".parse().unwrap();
        assert_eq!(fields(Params::none(&uri).unwrap_err())[0].0, "x");
    }

    #[test]
    fn cursors_of_other_lists_and_garbage_are_refused() {
        let foreign = cursor(Some("north".into())).unwrap();
        for text in [foreign.as_str(), "%00", "====", &"A".repeat(4000), "501"] {
            let mut params = params(&format!("cursor={text}"));
            params.page::<PlanId>();
            assert_eq!(fields(params.finish().unwrap_err())[0].0, "cursor");
        }
        assert_eq!(cursor(None), None);
    }
}
