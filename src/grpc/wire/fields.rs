//! What reading a message found wrong: the path of each bad field, its value and the rule it breaks.

use std::fmt::{self, Display};
use std::str::FromStr;

use jiff::Timestamp;

use crate::domain::{ClientId, FieldViolation, IdError, Refusal};

/// The path of a field, linked to its parent's: it costs nothing until a rule is broken.
#[derive(Clone, Copy, Debug)]
pub struct Path<'a> {
    parent: Option<&'a Path<'a>>,
    step: Step,
}

#[derive(Clone, Copy, Debug)]
enum Step {
    Root,
    Field(&'static str),
    Index(usize),
}

impl<'a> Path<'a> {
    /// The whole message.
    pub const ROOT: Path<'static> = Path { parent: None, step: Step::Root };

    /// A field of this message.
    pub fn field(&'a self, name: &'static str) -> Path<'a> {
        Path { parent: Some(self), step: Step::Field(name) }
    }

    /// An item of this repeated field.
    pub fn index(&'a self, index: usize) -> Path<'a> {
        Path { parent: Some(self), step: Step::Index(index) }
    }
}

impl Display for Path<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(parent) = self.parent {
            parent.fmt(f)?;
        }
        match self.step {
            Step::Root => Ok(()),
            Step::Field(name) if self.parent.is_none_or(|p| matches!(p.step, Step::Root)) => {
                f.write_str(name)
            }
            Step::Field(name) => write!(f, ".{name}"),
            Step::Index(index) => write!(f, "[{index}]"),
        }
    }
}

/// What a number must be, besides finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Nothing else.
    Finite,
    /// At least 0.
    AtLeastZero,
    /// Greater than 0.
    Positive,
    /// Greater than 0, at most 1.
    Fraction,
}

impl Rule {
    fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Finite => true,
                Self::AtLeastZero => value >= 0.0,
                Self::Positive => value > 0.0,
                Self::Fraction => value > 0.0 && value <= 1.0,
            }
    }

    fn text(self) -> &'static str {
        match self {
            Self::Finite => "must be finite",
            Self::AtLeastZero => "must be finite and at least 0",
            Self::Positive => "must be finite and greater than 0",
            Self::Fraction => "must be greater than 0 and at most 1",
        }
    }
}

/// Collects the violations of one message. A reader answers `None` exactly where it added one.
#[derive(Debug, Default)]
pub struct Fields {
    violations: Vec<FieldViolation>,
    omitted: usize,
}

/// A network of thousands of sensors may be wrong in each: more than these help nobody.
const KEPT: usize = 50;

impl Fields {
    /// A field breaks a rule.
    pub fn add(&mut self, at: Path<'_>, description: impl Into<String>) {
        if self.violations.len() < KEPT {
            let description = description.into();
            self.violations.push(FieldViolation { field: at.to_string(), description });
        } else {
            self.omitted += 1;
        }
    }

    /// A field breaks a rule; for where a value is to be answered.
    pub fn refuse<T>(&mut self, at: Path<'_>, description: impl Into<String>) -> Option<T> {
        self.add(at, description);
        None
    }

    /// The value, if nothing was wrong with any field.
    pub fn finish<T>(mut self, value: Option<T>) -> Result<T, Refusal> {
        if self.omitted > 0 {
            let description = format!("{} more fields break rules", self.omitted);
            self.violations.push(FieldViolation { field: String::new(), description });
        }
        match value {
            Some(value) if self.violations.is_empty() => Ok(value),
            // Readers answer `None` only with a violation; should one forget, the call is refused all the same.
            _ => Err(Refusal::Invalid(self.violations)),
        }
    }

    /// An id that must be there.
    pub fn id<T: FromStr<Err = IdError>>(&mut self, at: Path<'_>, text: &str) -> Option<T> {
        match text.parse() {
            Ok(id) => Some(id),
            Err(error) => self.refuse(at, error.to_string()),
        }
    }

    /// The field `client_id`.
    pub fn client_id(&mut self, text: &str) -> Option<ClientId> {
        self.id(Path::ROOT.field("client_id"), text)
    }

    /// An id that may be left out.
    pub fn optional_id<T: FromStr<Err = IdError>>(
        &mut self,
        at: Path<'_>,
        text: &str,
    ) -> Option<Option<T>> {
        if text.is_empty() { Some(None) } else { self.id(at, text).map(Some) }
    }

    /// A number.
    pub fn number(&mut self, at: Path<'_>, value: f64, rule: Rule) -> Option<f64> {
        if rule.holds(value) {
            // A minus zero is a zero: the same content must have the same fingerprint.
            Some(value + 0.0)
        } else {
            self.refuse(at, format!("{value} {}", rule.text()))
        }
    }

    /// A number that may be left out.
    pub fn optional_number(
        &mut self,
        at: Path<'_>,
        value: Option<f64>,
        rule: Rule,
    ) -> Option<Option<f64>> {
        match value {
            None => Some(None),
            Some(value) => self.number(at, value, rule).map(Some),
        }
    }

    /// A message that must be there.
    pub fn present<T>(&mut self, at: Path<'_>, value: Option<T>) -> Option<T> {
        value.or_else(|| self.refuse(at, "is missing"))
    }

    /// A time of the years 1970 to 9999, cut to whole microseconds: the service keeps no finer ones.
    pub fn time(&mut self, at: Path<'_>, time: prost_types::Timestamp) -> Option<Timestamp> {
        let prost_types::Timestamp { seconds, nanos } = time;
        if !(0..1_000_000_000).contains(&nanos) {
            let rule = "must be 0 to 999999999";
            return self.refuse(at.field("nanos"), format!("{nanos} {rule}"));
        }
        let whole = seconds.checked_mul(1_000_000).filter(|_| seconds >= 0);
        let time = whole
            .and_then(|micros| micros.checked_add(i64::from(nanos) / 1_000))
            .and_then(|micros| Timestamp::from_microsecond(micros).ok());
        time.or_else(|| {
            let rule = "must lie in the years 1970 to 9999";
            self.refuse(at.field("seconds"), format!("{seconds} {rule}"))
        })
    }

    /// A time that must be there.
    pub fn required_time(
        &mut self,
        at: Path<'_>,
        time: Option<prost_types::Timestamp>,
    ) -> Option<Timestamp> {
        let time = self.present(at, time)?;
        self.time(at, time)
    }

    /// A time that may be left out.
    pub fn optional_time(
        &mut self,
        at: Path<'_>,
        time: Option<prost_types::Timestamp>,
    ) -> Option<Option<Timestamp>> {
        match time {
            None => Some(None),
            Some(time) => self.time(at, time).map(Some),
        }
    }

    /// Text that may be left out, of so many bytes at most.
    pub fn text(&mut self, at: Path<'_>, text: String, most: usize) -> Option<Option<String>> {
        match text.len() {
            0 => Some(None),
            length if length <= most => Some(Some(text)),
            length => self.refuse(at, format!("has {length} bytes, and must have at most {most}")),
        }
    }

    /// Every item of a repeated field, each read by `read`; none if one of them is bad.
    pub fn each<W, T>(
        &mut self,
        at: Path<'_>,
        items: impl IntoIterator<Item = W>,
        mut read: impl FnMut(&mut Self, Path<'_>, W) -> Option<T>,
    ) -> Option<Vec<T>> {
        let items = items.into_iter();
        let mut all = Some(Vec::with_capacity(items.size_hint().0));
        for (index, item) in items.enumerate() {
            match (read(self, at.index(index), item), &mut all) {
                (Some(item), Some(all)) => all.push(item),
                _ => all = None,
            }
        }
        all
    }
}
