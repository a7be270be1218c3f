//! The reference: bare sqlx, the same rows into the same table with the same indices, so many a transaction.

use std::path::Path;

use sqlx::sqlite::{SqliteConnectOptions, SqliteJournalMode, SqliteSynchronous};
use sqlx::{ConnectOptions, Connection, SqliteConnection};

use super::service::sensor;
use super::{REQUESTS, Result, UNACKNOWLEDGED};

/// A database of the service's schema and settings.
pub async fn open(path: &Path) -> Result<SqliteConnection> {
    let mut conn = SqliteConnectOptions::new()
        .filename(path)
        .create_if_missing(true)
        .journal_mode(SqliteJournalMode::Wal)
        .synchronous(SqliteSynchronous::Full)
        .foreign_keys(true)
        .disable_statement_logging()
        .connect()
        .await?;
    sqlx::migrate!("migrations/sqlite").run(&mut conn).await?;
    Ok(conn)
}

/// Inserts a round's requests into a network of its own.
pub async fn insert(conn: &mut SqliteConnection, network: &str) -> Result<()> {
    sqlx::query("INSERT INTO networks (id, version, created_us, updated_us) VALUES (?, 1, 0, 0)")
        .bind(network)
        .execute(&mut *conn)
        .await?;
    let mut number = 0;
    while number < REQUESTS {
        let mut transaction = conn.begin().await?;
        for number in number..number + UNACKNOWLEDGED {
            sqlx::query(
                "INSERT INTO requests (id, network_id, sensor_id, client_id, fingerprint, state,
                 residual_j, required, received_us, updated_us, change)
                 VALUES (?, ?, ?, ?, ?, 'open', 50.0, 0, ?, ?, ?)",
            )
            .bind(uuid::Uuid::now_v7().to_string())
            .bind(network)
            .bind(sensor(number))
            .bind(format!("c{number}"))
            .bind([number as u8; 32].as_slice())
            .bind(1_700_000_000_000_000 + number as i64)
            .bind(1_700_000_000_000_000 + number as i64)
            .bind(number as i64)
            .execute(&mut *transaction)
            .await?;
        }
        transaction.commit().await?;
        number += UNACKNOWLEDGED;
    }
    Ok(())
}
