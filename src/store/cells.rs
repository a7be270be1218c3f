//! The cells of a row, as types of the domain; and the other way round, text and documents.

use jiff::Timestamp;
use serde::Serialize;
use serde::de::DeserializeOwned;
use sqlx::sqlite::SqliteRow;
use sqlx::{Decode, Row, Sqlite, Type};

use super::StoreError;
use super::words::Word;

/// A row of a table.
#[derive(Clone, Copy)]
pub(super) struct Cells<'r> {
    table: &'static str,
    row: &'r SqliteRow,
}

type Cell<T> = Result<T, StoreError>;

impl<'r> Cells<'r> {
    pub fn new(table: &'static str, row: &'r SqliteRow) -> Self {
        Self { table, row }
    }

    pub fn get<T: Decode<'r, Sqlite> + Type<Sqlite>>(self, name: &'static str) -> Cell<T> {
        self.row.try_get(name).map_err(|error| self.wrong(name, error))
    }

    /// A text of which something is made that has rules, such as an id.
    pub fn parsed<T: std::str::FromStr>(self, name: &'static str) -> Cell<T>
    where
        T::Err: ToString,
    {
        self.get::<&str>(name)?.parse().map_err(|error: T::Err| self.wrong(name, error.to_string()))
    }

    pub fn parsed_or_none<T: std::str::FromStr>(self, name: &'static str) -> Cell<Option<T>>
    where
        T::Err: ToString,
    {
        let parse = |text: &str| text.parse();
        let parsed = self.get::<Option<&str>>(name)?.map(parse).transpose();
        parsed.map_err(|error: T::Err| self.wrong(name, error.to_string()))
    }

    pub fn word<T: Word>(self, name: &'static str) -> Cell<T> {
        let word: &str = self.get(name)?;
        T::from_word(word).ok_or_else(|| self.wrong(name, word))
    }

    pub fn word_or_none<T: Word>(self, name: &'static str) -> Cell<Option<T>> {
        let word: Option<&str> = self.get(name)?;
        word.map(|word| T::from_word(word).ok_or_else(|| self.wrong(name, word))).transpose()
    }

    pub fn time(self, name: &'static str) -> Cell<Timestamp> {
        let micros = self.get(name)?;
        Timestamp::from_microsecond(micros).map_err(|error| self.wrong(name, error))
    }

    pub fn time_or_none(self, name: &'static str) -> Cell<Option<Timestamp>> {
        let time = |micros| Timestamp::from_microsecond(micros);
        let time = self.get::<Option<i64>>(name)?.map(time).transpose();
        time.map_err(|error| self.wrong(name, error))
    }

    pub fn count(self, name: &'static str) -> Cell<u32> {
        let number: i64 = self.get(name)?;
        number.try_into().map_err(|error| self.wrong(name, error))
    }

    /// Of versions and changes.
    pub fn number(self, name: &'static str) -> Cell<u64> {
        let number: i64 = self.get(name)?;
        number.try_into().map_err(|error| self.wrong(name, error))
    }

    pub fn json<T: DeserializeOwned>(self, name: &'static str) -> Cell<T> {
        serde_json::from_str(self.get(name)?).map_err(|error| self.wrong(name, error))
    }

    pub fn json_or_none<T: DeserializeOwned>(self, name: &'static str) -> Cell<Option<T>> {
        let text: Option<&str> = self.get(name)?;
        let value = text.map(serde_json::from_str).transpose();
        value.map_err(|error| self.wrong(name, error))
    }

    /// A compressed text.
    pub fn unpacked(self, name: &'static str) -> Cell<Vec<u8>> {
        zstd::decode_all(self.get::<&[u8]>(name)?).map_err(|error| self.wrong(name, error))
    }

    fn wrong(self, name: &str, reason: impl ToString) -> StoreError {
        StoreError::row(self.table, format!("{name}: {}", reason.to_string()))
    }
}

/// Microseconds of an optional time.
pub(super) fn micros(time: Option<Timestamp>) -> Option<i64> {
    time.map(Timestamp::as_microsecond)
}

/// A document as JSON text. Plain structs of plain fields cannot fail to become JSON.
pub(super) fn text(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

/// Compresses a document.
///
/// # Errors
/// The compressor has no memory.
pub(crate) fn pack(document: &[u8]) -> Result<Vec<u8>, std::io::Error> {
    const LEVEL: i32 = 3;
    zstd::bulk::compress(document, LEVEL)
}

/// A number for a column; SQLite's whole numbers are signed.
pub(super) fn signed(number: u64) -> i64 {
    i64::try_from(number).unwrap_or(i64::MAX)
}
