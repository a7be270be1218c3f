//! In what a kill struck, read from a copy of the database as the dead process left it: opening the
//! original would do the recovery that the next process has to do.

use std::collections::HashSet;
use std::fmt;
use std::fs;
use std::path::Path;

use super::aim::Aim;
use super::station::Station;
use crate::database::{open_copy, rows};
use crate::time::now_us;

/// How often each was struck; a kill may strike several at once.
#[derive(Clone, Debug, Default)]
pub struct Struck {
    aims: Vec<(Aim, u32)>,
    /// Requests were under way.
    ingest: u32,
    /// Requests were stored and their acknowledgements never came.
    unheard: u32,
    /// A departure was announced and its batch not closed.
    announced: u32,
    /// The close of a batch came next: it was due, and nothing was being planned.
    closing: u32,
    /// A batch was closed and its plan not stored.
    planning: u32,
    /// A plan was stored in the last moment.
    stored: u32,
    /// A tour was out.
    out: u32,
}

impl Struck {
    pub async fn count(&mut self, aim: Aim, database: &Path, station: &Station) {
        let now = now_us();
        match self.aims.iter_mut().find(|(other, _)| *other == aim) {
            Some((_, times)) => *times += 1,
            None => self.aims.push((aim, 1)),
        }
        let copy = tempfile::tempdir().expect("a temporary directory");
        let to = copy.path().join("copy.db");
        for suffix in ["", "-wal"] {
            let name = |path: &Path| format!("{}{suffix}", path.display());
            if Path::new(&name(database)).exists() {
                fs::copy(name(database), name(&to)).expect("the copy");
            }
        }
        let mut conn = open_copy(&to).await;
        let stored: HashSet<String> = rows(&mut conn, "SELECT client_id FROM requests")
            .await
            .into_iter()
            .map(|mut row| row.remove(0))
            .collect();
        let departures =
            rows(&mut conn, "SELECT state, CAST(close_us AS TEXT) FROM departures").await;
        let last = rows(&mut conn, "SELECT CAST(max(created_us) AS TEXT) FROM plans").await;
        let due = |us: &str| us.parse::<i64>().is_ok_and(|us| us <= now);
        let mut count = |counter: fn(&mut Self) -> &mut u32, yes: bool| {
            *counter(self) += u32::from(yes);
        };
        count(|s| &mut s.ingest, !station.waiting.is_empty());
        count(|s| &mut s.unheard, station.waiting.iter().any(|r| stored.contains(&r.client_id)));
        count(|s| &mut s.announced, departures.iter().any(|d| d[0] == "announced"));
        let planning = departures.iter().any(|d| d[0] == "closed");
        let closing = departures.iter().any(|d| d[0] == "announced" && due(&d[1]));
        count(|s| &mut s.closing, closing && !planning);
        count(|s| &mut s.planning, planning);
        let fresh = last[0][0].parse::<i64>().is_ok_and(|us| us > now - 30_000);
        count(|s| &mut s.stored, fresh);
        count(|s| &mut s.out, departures.iter().any(|d| d[0] == "planned"));
    }
}

impl fmt::Display for Struck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "requests under way {}, stored but unacknowledged {}, departure announced {}, \
             close due {}, planning {}, plan just stored {}, tour out {}; aimed at {:?}",
            self.ingest,
            self.unheard,
            self.announced,
            self.closing,
            self.planning,
            self.stored,
            self.out,
            self.aims
        )
    }
}
