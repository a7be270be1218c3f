//! The commands, and the one place where a command's failure becomes lines and an exit code.

use std::io::Write;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use super::{
    backup, bench, check, config, explain, generate, operator, pages, policies, serve, solve, token,
};

/// Plans the tours of mobile chargers in wireless rechargeable sensor networks.
#[derive(Debug, Parser)]
#[command(name = "voltour", version, propagate_version = true, after_long_help = EXAMPLES)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "\
Examples:
  See the service at work, with a base station and a charger played for you:
    voltour serve --demo

  Draw a scenario, solve it, check the plan:
    voltour generate k_coverage --sensors 40 --seed 1 > scenario.json
    voltour solve scenario.json -o plan.json
    voltour check scenario.json plan.json

  Run the service, and drive it from another terminal:
    voltour serve
    voltour network put network.json
    voltour request submit --network north --sensor s1 --in 90m --residual-j 1620
    voltour depart --network north --charger truck-1
    voltour tour get --network north --charger truck-1 --wait 30s

`voltour help COMMAND` says more about each.";

/// One a file.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Plan one tour: a scenario document in, a plan document out
    Solve(solve::Args),
    /// Check a plan against its scenario, independently of the solver
    Check(check::Args),
    /// Say why a plan is as it is: what contradicts what, who is not served and why, what a change would buy
    Explain(explain::Args),
    /// Draw a random scenario
    Generate(generate::Args),
    /// Compare the algorithms: the paper's tables, public instances
    #[command(subcommand)]
    Bench(bench::Command),
    /// Show the trained policies
    #[command(subcommand)]
    Policy(policies::Command),
    /// Run the scheduling service, or its demonstration
    Serve(serve::Args),
    /// Make and revoke API tokens, on the service's machine
    #[command(subcommand)]
    Token(token::Command),
    /// Copy the database, also while the service runs on it
    Backup(backup::Backup),
    /// Put a backup in the place of the database, while no service runs
    Restore(backup::Restore),
    /// Look at the configuration
    #[command(subcommand)]
    Config(config::Command),
    /// Print the completions of a shell
    Completions(pages::Completions),
    /// Write the man pages
    Man(pages::Man),
    /// What an operator does with a running service.
    #[command(flatten)]
    Operator(operator::Command),
}

/// Runs a command to its exit code; failures go to standard error, one line each.
pub fn run(cli: Cli) -> ExitCode {
    let done = match cli.command {
        Command::Solve(args) => solve::run(args),
        Command::Check(args) => check::run(args),
        Command::Explain(args) => explain::run(args),
        Command::Generate(args) => generate::run(args),
        Command::Bench(command) => bench::run(command),
        Command::Policy(command) => policies::run(command),
        Command::Serve(args) => serve::run(args),
        Command::Token(command) => token::run(command),
        Command::Backup(args) => backup::backup(args),
        Command::Restore(args) => backup::restore(args),
        Command::Config(command) => config::run(command),
        Command::Completions(args) => pages::completions(args),
        Command::Man(args) => pages::man(args),
        Command::Operator(command) => operator::run(command),
    };
    done.unwrap_or_else(|failure| {
        let mut stderr = std::io::stderr().lock();
        for line in &failure.lines {
            // With standard error gone there is nobody left to tell.
            let _ = writeln!(stderr, "voltour: {line}");
        }
        ExitCode::from(failure.code)
    })
}
