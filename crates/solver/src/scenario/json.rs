//! JSON text to a tree that remembers nothing but values, refusing what `serde_json` lets pass
//! in silence: a repeated key.

use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Number, Value};

use super::ScenarioError;

/// Parses one JSON text.
///
/// # Errors
/// [`ScenarioError::Syntax`] with line and column where the text is not JSON (NaN and `1e999` are
/// not), and [`ScenarioError::Rule`] with the path of a repeated key.
pub(crate) fn parse(text: &[u8]) -> Result<Value, ScenarioError> {
    let mut repeated = None;
    let mut deserializer = serde_json::Deserializer::from_slice(text);
    let tree = Tree { at: &Path::Root, repeated: &mut repeated }
        .deserialize(&mut deserializer)
        .and_then(|value| deserializer.end().map(|()| value));
    match (tree, repeated) {
        (_, Some(path)) => Err(ScenarioError::rule(&path, &path, "key is repeated")),
        (Ok(value), None) => Ok(value),
        (Err(error), None) => Err(ScenarioError::Syntax {
            line: error.line(),
            column: error.column(),
            reason: reason(&error),
        }),
    }
}

/// What the parser says, without the line and column that it puts at the end.
fn reason(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    text.strip_suffix(&place).unwrap_or(&text).to_owned()
}

/// The path of a member: `parent.key`, or `parent["odd key"]` where the key is not a plain word.
pub(super) fn member(path: &str, key: &str) -> String {
    let plain = !key.is_empty() && key.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
    match (plain, path.is_empty()) {
        (true, true) => key.to_owned(),
        (true, false) => format!("{path}.{key}"),
        (false, _) => {
            let start: String = key.chars().take(40).collect();
            format!("{path}[{}]", Value::from(start))
        }
    }
}

/// Where the parser stands; written out only when something is wrong there.
enum Path<'a> {
    Root,
    Member(&'a Path<'a>, &'a str),
    Item(&'a Path<'a>, usize),
}

impl Path<'_> {
    fn text(&self) -> String {
        match self {
            Self::Root => String::new(),
            Self::Member(parent, key) => member(&parent.text(), key),
            Self::Item(parent, index) => format!("{}[{index}]", parent.text()),
        }
    }
}

struct Tree<'a> {
    at: &'a Path<'a>,
    repeated: &'a mut Option<String>,
}

impl<'de> DeserializeSeed<'de> for Tree<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Tree<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(Value::Bool(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Value, E> {
        Number::from_f64(value).map(Value::Number).ok_or_else(|| E::custom("not a finite number"))
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut list = Vec::new();
        loop {
            let at = Path::Item(self.at, list.len());
            match items.next_element_seed(Tree { at: &at, repeated: &mut *self.repeated })? {
                Some(item) => list.push(item),
                None => return Ok(Value::Array(list)),
            }
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, mut members: A) -> Result<Value, A::Error> {
        let mut object = Map::new();
        while let Some(key) = members.next_key::<String>()? {
            let at = Path::Member(self.at, &key);
            if object.contains_key(&key) {
                self.repeated.get_or_insert(at.text());
                return Err(A::Error::custom("repeated key"));
            }
            let value = members.next_value_seed(Tree { at: &at, repeated: &mut *self.repeated })?;
            object.insert(key, value);
        }
        Ok(Value::Object(object))
    }
}
