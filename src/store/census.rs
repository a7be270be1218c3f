//! What there is in the database, for a monitor: from partial indices and the file's own counts, so that it costs
//! the same however long the history is.

use sqlx::{Row, SqlitePool};

use super::explanations::waiting_explanations;
use super::{Reads, StoreError};

/// What there is now.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs)]
pub struct Census {
    pub announced: u64,
    pub closed: u64,
    /// Departures whose tour is out.
    pub planned: u64,
    pub open_requests: u64,
    /// Plans that are still to be explained.
    pub unexplained: u64,
    pub database_bytes: u64,
    /// Of the write-ahead log; 0 where there is none.
    pub log_bytes: u64,
}

impl Reads {
    /// Counts what there is.
    pub async fn census(&self) -> Result<Census, StoreError> {
        let pool = self.pool();
        let waiting = sqlx::query(
            "SELECT coalesce(sum(state = 'announced'), 0), coalesce(sum(state = 'closed'), 0) \
             FROM departures INDEXED BY departures_queue WHERE state IN ('announced', 'closed')",
        );
        let waiting = waiting.fetch_one(pool).await?;
        let count =
            |column: usize| Ok::<_, StoreError>(waiting.try_get::<i64, _>(column)?.unsigned_abs());
        let (announced, closed) = (count(0)?, count(1)?);
        let planned =
            number(pool, "SELECT count(*) FROM tours INDEXED BY tours_out WHERE state = 'out'")
                .await?;
        let open_requests = number(
            pool,
            "SELECT count(*) FROM requests INDEXED BY requests_open WHERE state = 'open'",
        )
        .await?;
        let unexplained = waiting_explanations(pool).await?;
        let pages = number(pool, "PRAGMA page_count").await?;
        let database_bytes = pages * number(pool, "PRAGMA page_size").await?;
        let log_bytes = log_bytes(pool).await;
        Ok(Census {
            announced,
            closed,
            planned,
            open_requests,
            unexplained,
            database_bytes,
            log_bytes,
        })
    }
}

async fn number(pool: &SqlitePool, sql: &'static str) -> Result<u64, StoreError> {
    Ok(sqlx::query_scalar::<_, i64>(sql).fetch_one(pool).await?.unsigned_abs())
}

async fn log_bytes(pool: &SqlitePool) -> u64 {
    let mut path = pool.connect_options().get_filename().as_os_str().to_owned();
    path.push("-wal");
    tokio::fs::metadata(path).await.map_or(0, |file| file.len())
}

#[cfg(test)]
mod tests {
    use crate::store::fixture::Bench;

    #[tokio::test]
    async fn what_is_over_is_not_in_the_census() {
        let bench = Bench::new().await;
        for sensor in ["s1", "s2"] {
            bench.submit(sensor).await;
        }
        let empty = bench.store.reads.census().await.unwrap();
        assert_eq!(
            (empty.announced, empty.closed, empty.planned, empty.open_requests),
            (0, 0, 0, 2)
        );
        assert!(empty.database_bytes > 4_096 && empty.log_bytes > 0, "{empty:?}");
        bench.tour("c", &["s1"]).await;
        bench.announce("d").await;
        let closed = bench.announce("e").await;
        bench.closed(closed).await;
        let census = bench.store.reads.census().await.unwrap();
        assert_eq!((census.announced, census.closed, census.planned), (1, 1, 1), "{census:?}");
        assert_eq!((census.open_requests, census.unexplained), (0, 1), "{census:?}");
    }
}
