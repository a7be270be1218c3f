//! What must never be in the database, whatever was killed when: each rule is a query without rows.

use std::path::Path;

use sqlx::Connection;

use crate::database::{open, rows};

/// At every moment.
const NEVER: [(&str, &str); 12] = [
    (
        "a departure with two plans of one revision",
        "SELECT departure_id, CAST(revision AS TEXT) FROM plans GROUP BY 1, 2 HAVING count(*) > 1",
    ),
    ("a departure with two plans", "SELECT departure_id FROM plans GROUP BY 1 HAVING count(*) > 1"),
    (
        "a request that is a stop of two tours that are out",
        "SELECT s.request_id FROM stops s JOIN tours t ON t.id = s.tour_id
         WHERE t.state = 'out' GROUP BY 1 HAVING count(*) > 1",
    ),
    (
        "a charger with two tours out",
        "SELECT network_id, charger_id FROM tours WHERE state = 'out' GROUP BY 1, 2 HAVING count(*) > 1",
    ),
    (
        "a sensor with two requests that are dealt with",
        "SELECT network_id, sensor_id FROM requests WHERE state IN ('batched', 'planned')
         GROUP BY 1, 2 HAVING count(*) > 1",
    ),
    (
        "a sensor with two open requests",
        "SELECT network_id, sensor_id FROM requests WHERE state = 'open'
         GROUP BY 1, 2 HAVING count(*) > 1",
    ),
    (
        "a batched request whose departure is not being planned",
        "SELECT r.id, d.state FROM requests r LEFT JOIN departures d ON d.id = r.departure_id
         WHERE r.state = 'batched' AND (d.state IS NULL OR d.state <> 'closed')",
    ),
    (
        "a planned request that is no stop of a tour that is out",
        "SELECT r.id FROM requests r WHERE r.state = 'planned' AND NOT EXISTS
         (SELECT 1 FROM stops s JOIN tours t ON t.id = s.tour_id
          WHERE s.request_id = r.id AND t.id = r.tour_id AND t.state = 'out' AND s.out = 1)",
    ),
    (
        "a stop of a tour that is out whose request is neither planned nor served",
        "SELECT s.request_id, r.state FROM stops s JOIN tours t ON t.id = s.tour_id
         JOIN requests r ON r.id = s.request_id
         WHERE t.state = 'out' AND r.state NOT IN ('planned', 'served')",
    ),
    (
        "a departure whose state is not that of its plan and tour",
        "SELECT d.id, d.state, p.id, t.state FROM departures d
         LEFT JOIN plans p ON p.departure_id = d.id LEFT JOIN tours t ON t.plan_id = p.id
         WHERE (d.state IN ('announced', 'closed', 'missed') AND p.id IS NOT NULL)
            OR (d.state = 'planned' AND (t.state IS NULL OR t.state <> 'out'))
            OR (d.state = 'completed' AND (t.state IS NULL OR t.state <> 'completed'))",
    ),
    (
        "a plan from a second 0 that had passed when it was stored",
        "SELECT id, CAST(created_us - start_us AS TEXT) FROM plans WHERE created_us > start_us",
    ),
    (
        "a stop that is counted as out though its tour is over, or the other way round",
        "SELECT s.tour_id, t.state FROM stops s JOIN tours t ON t.id = s.tour_id
         WHERE (s.out = 1) <> (t.state = 'out')",
    ),
];

/// When everything that was announced is over.
const SETTLED: [(&str, &str); 3] = [
    ("a request that is stuck in a batch", "SELECT id FROM requests WHERE state = 'batched'"),
    (
        "a departure that is stuck",
        "SELECT id, state FROM departures WHERE state IN ('announced', 'closed')",
    ),
    ("a tour that is still out", "SELECT id FROM tours WHERE state = 'out'"),
];

async fn none(database: &Path, rules: &[(&str, &'static str)]) {
    let mut conn = open(database).await;
    // One snapshot for all: the server goes on.
    let mut snapshot = conn.begin().await.expect("a transaction");
    for (what, sql) in rules {
        let found = rows(&mut snapshot, sql).await;
        assert!(found.is_empty(), "{what}: {found:?}");
    }
}

pub async fn hold(database: &Path) {
    none(database, &NEVER).await;
    let mut conn = open(database).await;
    let verdict = rows(&mut conn, "PRAGMA integrity_check").await;
    assert_eq!(verdict, [["ok"]]);
}

pub async fn settled(database: &Path) {
    none(database, &SETTLED).await;
}
