//! What an installation takes from the command line's definition: shell completions and man pages.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::CommandFactory;
use clap_complete::Shell;

use super::{Cli, Failure, documents};

/// The arguments of `voltour completions`.
#[derive(Debug, clap::Args)]
#[command(after_long_help = "Such as: voltour completions bash > /etc/bash_completion.d/voltour")]
pub struct Completions {
    /// For which shell
    pub shell: Shell,
}

/// The arguments of `voltour man`.
#[derive(Debug, clap::Args)]
#[command(after_long_help = "Such as: voltour man /usr/local/share/man/man1")]
pub struct Man {
    /// Folder for them, made where there is none: voltour.1 and one a command, voltour-solve.1, ...
    pub dir: PathBuf,
}

/// Prints the completions.
pub fn completions(args: Completions) -> Result<ExitCode, Failure> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "voltour", &mut text);
    documents::print(&String::from_utf8_lossy(&text))?;
    Ok(ExitCode::SUCCESS)
}

/// Writes the pages.
pub fn man(args: Man) -> Result<ExitCode, Failure> {
    let written = std::fs::create_dir_all(&args.dir)
        .and_then(|()| clap_mangen::generate_to(Cli::command(), &args.dir));
    let dir = args.dir.display().to_string();
    written.map_err(|error| Failure::other(format!("{dir:?}: {error}")))?;
    Ok(ExitCode::SUCCESS)
}
