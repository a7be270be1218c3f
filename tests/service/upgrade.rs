//! A database of the first version, with data: it opens, keeps everything, and what is new works on it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use sqlx::migrate::Migrator;
use sqlx::sqlite::SqliteConnectOptions;
use sqlx::{AssertSqlSafe, ConnectOptions, SqliteConnection};
use voltour::proto::TourState;

use crate::app::{Settings, TestApp};
use crate::database::{open, rows};
use crate::explanations::{explanation, not_yet};
use crate::field::{departure, line};
use crate::time::from_now;

/// The migrations, by version.
pub fn migrations() -> BTreeMap<u32, PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("migrations/sqlite");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let version = |file: &Path| file.file_name().unwrap().to_str().unwrap()[..4].parse().unwrap();
    files.map(|file| (version(&file), file)).collect()
}

/// A database as an earlier version made it: its schema alone, and every row of `from` that fits in there.
pub async fn of_version(version: u32, from: &Path, to: &Path) {
    let only = tempfile::tempdir().unwrap();
    for (_, file) in migrations().range(..=version) {
        std::fs::copy(file, only.path().join(file.file_name().unwrap())).unwrap();
    }
    // Tables are filled in no special order.
    let options = SqliteConnectOptions::new().filename(to).foreign_keys(false);
    let mut conn = options.create_if_missing(true).connect().await.unwrap();
    Migrator::new(only.path()).await.unwrap().run(&mut conn).await.unwrap();
    let attach = sqlx::query("ATTACH ? AS newer").bind(from.to_str().unwrap());
    attach.execute(&mut conn).await.unwrap();
    for row in rows(&mut conn, "SELECT name FROM sqlite_schema WHERE type = 'table'").await {
        copy(&mut conn, &row[0]).await;
    }
}

async fn copy(conn: &mut SqliteConnection, table: &str) {
    if table.starts_with('_') {
        return;
    }
    let columns = sqlx::query_scalar("SELECT group_concat(name, ', ') FROM pragma_table_info(?)");
    let columns: String = columns.bind(table).fetch_one(&mut *conn).await.unwrap();
    let sql = format!("INSERT INTO main.{table} ({columns}) SELECT {columns} FROM newer.{table}");
    sqlx::query(AssertSqlSafe(sql)).execute(conn).await.unwrap();
}

#[tokio::test]
async fn a_database_of_the_first_version_opens_with_all_that_is_in_it() {
    let settings = Settings { explanation_budget: "0s", ..Settings::default() };
    let mut app = TestApp::with(settings).await;
    app.put(line(3)).await;
    let served = app.ask("s1").await;
    let over = app.drive("A").await;
    app.charged(&over, "s1").await;
    app.complete(&over).await;
    let planned = app.ask("s2").await;
    let out = app.drive("A").await;
    let announced =
        app.announce(voltour::proto::AnnounceRequest { t0: from_now(3_600_000), ..departure("B") });
    let announced = announced.await;
    let before = (app.request(&served.id).await, app.request(&planned.id).await);
    let plans = app.json("/v1/plans").await;
    assert_eq!(app.sigterm().await.code(), Some(0));

    let old = app.file("old.db");
    of_version(1, &app.database(), &old).await;
    for end in ["-wal", "-shm"] {
        // Left only by a connection that did not close.
        let _ = std::fs::remove_file(format!("{}{end}", app.database().display()));
    }
    std::fs::rename(&old, app.database()).unwrap();
    let mut conn = open(&app.database()).await;
    let tables = rows(&mut conn, "SELECT name FROM sqlite_schema WHERE name = 'explanations'");
    assert!(tables.await.is_empty(), "the first version had none");
    drop(conn);

    app.launch().await;
    assert_eq!((app.request(&served.id).await, app.request(&planned.id).await), before);
    assert_eq!(app.departure(&announced.id).await, announced);
    assert_eq!(app.json("/v1/plans").await, plans);
    assert_eq!(app.tour_state(&out.id).await, "out");
    assert_eq!(app.complete(&out).await.state, TourState::Completed as i32);
    not_yet(&app, &over).await;
    // The present version goes on where the first one stopped, and explains its plans.
    app.kill9();
    app.configure(Settings::default());
    app.launch().await;
    let next = app.drive("A").await;
    for tour in [&over, &out, &next] {
        assert_eq!(explanation(&app, tour).await["complete"], true);
    }
}
