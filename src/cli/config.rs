//! `voltour config`: looks at the configuration as `voltour serve` would read it, and changes nothing.

use std::path::PathBuf;
use std::process::ExitCode;

use super::{Failure, documents};
use crate::config::{self, Config, Setting};
use crate::telemetry;
use crate::tls::Tls;

/// What to do with the configuration.
#[derive(Debug, clap::Subcommand)]
pub enum Command {
    /// Check the file, the environment and the flags; says nothing where all is good
    ///
    /// The files of a token and of certificates that they name are read too. Whether an address beyond loopback may be
    /// listened on is seen only when the service starts, for it depends on the tokens in its database.
    Check(Source),
    /// Print what is in force, as TOML: the file, the environment over it, the flags over both; secrets are masked
    Print(Source),
}

/// Where the configuration comes from, beside the environment.
#[derive(Debug, clap::Args)]
pub struct Source {
    /// TOML file with the configuration; every key has a default
    #[arg(long, value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// Set a key, over the file and the environment; may be repeated
    #[arg(long, value_name = "SECTION.KEY=VALUE")]
    pub set: Vec<Setting>,
}

impl Source {
    fn load(&self) -> Result<Config, Failure> {
        let config = config::load_with(self.config.as_deref(), &self.set)
            .map_err(|errors| Failure { code: 2, lines: errors.0 })?;
        let filter = &config.log.filter;
        telemetry::filter(filter)
            .map_err(|error| Failure::input(format!("log.filter: {filter:?}: {error}")))?;
        Ok(config)
    }
}

/// Runs the command: 0 where the configuration is good, 2 with a line a fault where it is not.
pub fn run(command: Command) -> Result<ExitCode, Failure> {
    match command {
        Command::Check(source) => {
            let config = source.load()?;
            config.bootstrap().map_err(|errors| Failure { code: 2, lines: errors.0 })?;
            Tls::open(&config.tls).map_err(|error| Failure::input(error.to_string()))?;
        }
        Command::Print(source) => {
            let text = config::print(&source.load()?);
            documents::print(&text.map_err(|error| Failure::input(error.to_string()))?)?;
        }
    }
    Ok(ExitCode::SUCCESS)
}
