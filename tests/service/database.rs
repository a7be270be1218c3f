//! The database read directly, past the service: what no call tells, and what the crash tests take on
//! nobody's account.

use std::path::Path;

use sqlx::sqlite::SqliteConnectOptions;
use sqlx::{ConnectOptions, Row, SqliteConnection};

use crate::app::TestApp;

/// Opens the database of a running server for reading.
pub async fn open(path: &Path) -> SqliteConnection {
    let options = SqliteConnectOptions::new().filename(path).read_only(true);
    options.disable_statement_logging().connect().await.expect("the database opens")
}

/// The rows of a query, every column as text, null as "null".
pub async fn rows(conn: &mut SqliteConnection, sql: &'static str) -> Vec<Vec<String>> {
    let rows = sqlx::query(sql).fetch_all(conn).await.unwrap_or_else(|e| panic!("{sql}: {e}"));
    let text = |row: &sqlx::sqlite::SqliteRow, column: usize| {
        let value: Option<String> = row.get_unchecked(column);
        value.unwrap_or_else(|| "null".into())
    };
    rows.iter().map(|row| (0..row.len()).map(|column| text(row, column)).collect()).collect()
}

/// Opens a database that nobody else has open, such as a copy.
pub async fn open_copy(path: &Path) -> SqliteConnection {
    let options = SqliteConnectOptions::new().filename(path);
    options.disable_statement_logging().connect().await.expect("the database opens")
}

impl TestApp {
    /// The state of a tour, also of one that is over: no call tells it.
    pub async fn tour_state(&self, id: &str) -> String {
        let mut conn = open(&self.database()).await;
        let state = sqlx::query_scalar("SELECT state FROM tours WHERE id = ?").bind(id);
        state.fetch_one(&mut conn).await.expect("a tour")
    }
}
