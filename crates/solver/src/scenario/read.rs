//! From a JSON tree to [`Document`]: types, missing fields and unknown fields, each with its path.

use serde_json::{Map, Value};

use super::ScenarioError;
use super::document::{
    ChargerDocument, CoverageDocument, Document, RequestDocument, SensorDocument, TravelDocument,
};
use super::json::member;
use super::model::Objective;

type Read<T> = Result<T, ScenarioError>;

/// A value and where it stands.
pub(crate) struct Reader<'a> {
    value: &'a Value,
    path: String,
}

/// The members of an object, and where it stands. `null` members count as left out.
pub(crate) struct Fields<'a> {
    object: &'a Map<String, Value>,
    path: String,
}

impl<'a> Reader<'a> {
    pub(crate) fn root(value: &'a Value) -> Self {
        Self { value, path: String::new() }
    }

    pub(crate) fn wrong(&self, rule: &str) -> ScenarioError {
        let path = if self.path.is_empty() { "$" } else { &self.path };
        ScenarioError::rule(path, self.value, rule)
    }

    pub(crate) fn number(&self) -> Read<f64> {
        self.value.as_f64().ok_or_else(|| self.wrong("must be a number"))
    }

    pub(crate) fn text(&self) -> Read<String> {
        self.value.as_str().map(str::to_owned).ok_or_else(|| self.wrong("must be a string"))
    }

    fn flag(&self) -> Read<bool> {
        self.value.as_bool().ok_or_else(|| self.wrong("must be true or false"))
    }

    /// Every item of a list, read by `read`.
    pub(crate) fn list<T>(&self, read: impl Fn(Reader<'a>) -> Read<T>) -> Read<Vec<T>> {
        let items = self.value.as_array().ok_or_else(|| self.wrong("must be a list"))?;
        let item = |(i, value)| read(Reader { value, path: format!("{}[{i}]", self.path) });
        items.iter().enumerate().map(item).collect()
    }

    /// A list of numbers; matrices are made of these, so that a path is built only for a wrong one.
    fn numbers(&self) -> Read<Vec<f64>> {
        let items = self.value.as_array().ok_or_else(|| self.wrong("must be a list"))?;
        let number = |(i, value): (usize, &'a Value)| {
            let wrong = || Reader { value, path: format!("{}[{i}]", self.path) };
            value.as_f64().ok_or_else(|| wrong().wrong("must be a number"))
        };
        items.iter().enumerate().map(number).collect()
    }

    /// A row of exactly `N` numbers.
    pub(crate) fn row<const N: usize>(&self) -> Read<[f64; N]> {
        let numbers = self.numbers()?;
        numbers.try_into().map_err(|_| self.wrong(&format!("must be a list of {N} numbers")))
    }

    /// A required member of an object, before it is known which others are allowed.
    pub(crate) fn peek<T>(&self, name: &str, read: impl Fn(Reader<'a>) -> Read<T>) -> Read<T> {
        let object = self.value.as_object().ok_or_else(|| self.wrong("must be an object"))?;
        Fields { object, path: self.path.clone() }.required(name, read)
    }

    /// The members of an object that has no others than `known`.
    pub(crate) fn fields(self, known: &[&str]) -> Read<Fields<'a>> {
        let object = self.value.as_object().ok_or_else(|| self.wrong("must be an object"))?;
        match object.iter().find(|(key, _)| !known.contains(&key.as_str())) {
            Some((key, value)) => {
                let rule = format!("unknown field; known here: {}", known.join(", "));
                Err(ScenarioError::rule(member(&self.path, key), value, rule))
            }
            None => Ok(Fields { object, path: self.path }),
        }
    }
}

impl<'a> Fields<'a> {
    pub(crate) fn optional<T>(
        &self,
        name: &str,
        read: impl Fn(Reader<'a>) -> Read<T>,
    ) -> Read<Option<T>> {
        let value = self.object.get(name).filter(|value| !value.is_null());
        value.map(|value| read(Reader { value, path: member(&self.path, name) })).transpose()
    }

    pub(crate) fn required<T>(&self, name: &str, read: impl Fn(Reader<'a>) -> Read<T>) -> Read<T> {
        self.optional(name, read)?
            .ok_or_else(|| ScenarioError::missing(member(&self.path, name), "required"))
    }

    /// Whether the member stands in the document, be it as `null`.
    pub(crate) fn stands(&self, name: &str) -> bool {
        self.object.contains_key(name)
    }

    pub(crate) fn path_of(&self, name: &str) -> String {
        member(&self.path, name)
    }
}

pub(super) fn document(tree: &Value) -> Read<Document> {
    const KNOWN: [&str; 9] = [
        "format",
        "name",
        "objective",
        "charger",
        "charge_level",
        "coverage",
        "sensors",
        "requests",
        "travel",
    ];
    let fields = Reader::root(tree).fields(&KNOWN)?;
    Ok(Document {
        format: fields.required("format", |v| v.text())?,
        name: fields.optional("name", |v| v.text())?,
        objective: fields.required("objective", objective)?,
        charger: fields.required("charger", charger)?,
        charge_level: fields.optional("charge_level", |v| v.number())?,
        coverage: fields.optional("coverage", coverage)?,
        sensors: fields.required("sensors", |v| v.list(sensor))?,
        requests: fields.required("requests", |v| v.list(request))?,
        travel: fields.optional("travel", travel)?,
    })
}

fn objective(reader: Reader<'_>) -> Read<Objective> {
    let name = reader.text()?;
    Objective::from_name(&name)
        .ok_or_else(|| reader.wrong("must be min_distance, max_reward or max_count"))
}

fn charger(reader: Reader<'_>) -> Read<ChargerDocument> {
    const KNOWN: [&str; 7] =
        ["start_m", "end_m", "speed_mps", "travel_jpm", "transfer_w", "capacity_j", "timespan_s"];
    let fields = reader.fields(&KNOWN)?;
    Ok(ChargerDocument {
        start_m: fields.required("start_m", |v| v.row())?,
        end_m: fields.optional("end_m", |v| v.row())?,
        speed_mps: fields.required("speed_mps", |v| v.number())?,
        travel_jpm: fields.required("travel_jpm", |v| v.number())?,
        transfer_w: fields.required("transfer_w", |v| v.number())?,
        capacity_j: fields.optional("capacity_j", |v| v.number())?,
        timespan_s: fields.optional("timespan_s", |v| v.number())?,
    })
}

fn coverage(reader: Reader<'_>) -> Read<CoverageDocument> {
    let fields = reader.fields(&["k", "field_m"])?;
    Ok(CoverageDocument {
        k: fields.required("k", |v| v.number())?,
        field_m: fields.required("field_m", |v| v.list(|corner| corner.row()))?,
    })
}

fn sensor(reader: Reader<'_>) -> Read<SensorDocument> {
    let fields = reader.fields(&["id", "position_m", "trajectory", "range_m", "battery_j"])?;
    Ok(SensorDocument {
        id: fields.required("id", |v| v.text())?,
        position_m: fields.optional("position_m", |v| v.row())?,
        trajectory: fields.optional("trajectory", |v| v.list(|row| row.row()))?,
        range_m: fields.optional("range_m", |v| v.number())?,
        battery_j: fields.required("battery_j", |v| v.number())?,
    })
}

fn request(reader: Reader<'_>) -> Read<RequestDocument> {
    const KNOWN: [&str; 7] =
        ["sensor", "ready_s", "deadline_s", "residual_j", "drain_w", "reward", "required"];
    let fields = reader.fields(&KNOWN)?;
    Ok(RequestDocument {
        sensor: fields.required("sensor", |v| v.text())?,
        ready_s: fields.optional("ready_s", |v| v.number())?,
        deadline_s: fields.optional("deadline_s", |v| v.number())?,
        residual_j: fields.optional("residual_j", |v| v.number())?,
        drain_w: fields.optional("drain_w", |v| v.number())?,
        reward: fields.optional("reward", |v| v.number())?,
        required: fields.optional("required", |v| v.flag())?,
    })
}

fn travel(reader: Reader<'_>) -> Read<TravelDocument> {
    let fields = reader.fields(&["distance_m"])?;
    let rows = |v: Reader<'_>| v.list(|row| row.numbers());
    Ok(TravelDocument { distance_m: fields.required("distance_m", rows)? })
}
