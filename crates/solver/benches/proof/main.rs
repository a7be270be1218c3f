//! How much sooner voltour proves a tour than a general solver does: the median, over fixed scenarios,
//! of the time of OR-Tools CP-SAT with two workers over the time of ours, both taken in one run.
//!
//! `cargo bench -p voltour-solver --bench proof -- [--limit SECONDS] [--only FILTER] [--solver NAME]
//! [--solver-limit SECONDS]`. It needs Python 3 and, the first time, the network: OR-Tools goes into a
//! virtual environment of its own. Neither the tests nor a plain `cargo bench` run it.
//!
//! Both times begin at the compiled instance; the building of CP-SAT's model is off the clock, and the
//! ratio with our compilation on ours stands beside the other. Where the comparison leans, it leans
//! towards CP-SAT: it has two threads and we have one, it is told the greedy tour, and a limit
//! that it runs into counts as the time that it would have needed.
//!
//! Moving sensors are left out: when the charger meets one is no linear function of when it left, so
//! CP-SAT would have to be given a discretised problem, which is another one.

// Printing is what it is for.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod arguments;
mod compiled;
mod cpsat;
mod ours;
mod row;
mod scenarios;

use std::error::Error;
use std::process::ExitCode;

use arguments::Arguments;
use compiled::Compiled;
use cpsat::CpSat;
use ours::Ours;
use row::Row;

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("proof: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Prints the table; whether both solvers agree everywhere.
fn run() -> Result<bool, Box<dyn Error>> {
    let arguments = Arguments::read(std::env::args().skip(1))?;
    let scenarios = scenarios::scenarios(&arguments.only)?;
    let mut cpsat = CpSat::start(arguments.limit_s)?;
    println!(
        "{} ({} s) against CP-SAT ({} s)",
        arguments.solver, arguments.solver_limit_s, arguments.limit_s
    );
    println!("{}", Row::HEAD);
    let mut rows = Vec::new();
    for (name, scenario) in &scenarios {
        let ours = Ours::solve(scenario, &arguments)?;
        let theirs = cpsat.solve(name, &Compiled::new(name, scenario)?)?;
        let row = Row::new(name, scenario, ours, &theirs);
        println!("{row}");
        rows.push(row);
    }
    println!("{}", row::summary(&rows));
    Ok(rows.iter().all(Row::agrees))
}
