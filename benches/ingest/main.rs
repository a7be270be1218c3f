//! What the service takes, against what the database can.
//!
//! First the acknowledged durable requests a second, over one SubmitStream and over sixteen with 1,000 unacknowledged in all,
//! against bare sqlx that inserts the same rows into the same table with the same indices, 1,000 a transaction: on one disk
//! in one run, in turns. Then the 99th percentile of the time to an acknowledgement, idle and while a plan is computed. The
//! ratios are what counts. `cargo bench --bench ingest`.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]
#![allow(clippy::disallowed_methods, missing_docs)]

mod latency;
mod reference;
mod service;

use std::error::Error;
use std::time::Instant;

/// Requests in a round, each of a sensor of its own; a multiple of every number of streams.
const REQUESTS: usize = 20_000;
/// Sent and not yet acknowledged; rows in a transaction of the reference.
const UNACKNOWLEDGED: usize = 1_000;
const STREAMS: [usize; 2] = [1, 16];
const ROUNDS: usize = 5;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

#[tokio::main]
async fn main() -> Result<()> {
    // Beside the build, not in /tmp: that may be memory.
    let directory = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR"))?;
    let (mut server, channel) = service::serve(directory.path(), "").await?;
    let mut bare = reference::open(&directory.path().join("bare.db")).await?;
    println!("{REQUESTS} requests a round, acknowledged and durable, a second:");
    for count in STREAMS {
        let mut ratios = Vec::new();
        for round in 0..ROUNDS {
            let network = format!("round-{count}-{round}");
            service::put(&channel, &network, REQUESTS).await?;
            let streamed = per_second(service::streams(&channel, &network, count)).await?;
            let reference = per_second(reference::insert(&mut bare, &network)).await?;
            ratios.push(streamed / reference);
            println!(
                "  {count:>2} streams {streamed:>8.0}   bare sqlx {reference:>8.0}   ratio {:.2}",
                streamed / reference
            );
        }
        ratios.sort_by(f64::total_cmp);
        let median = ratios[ROUNDS / 2];
        println!("median ratio over {count} streams {median:.2} (to reach: at least 0.5)");
    }
    server.kill()?;
    server.wait()?;
    let directory = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR"))?;
    latency::measure(directory.path()).await
}

async fn per_second(work: impl Future<Output = Result<()>>) -> Result<f64> {
    let began = Instant::now();
    work.await?;
    Ok(REQUESTS as f64 / began.elapsed().as_secs_f64())
}
