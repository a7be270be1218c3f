//! Options of the paper's comparison algorithms on the command line.

use voltour_solver::solvers::{PaperOptions, Unfinished};

/// Bytes of a MiB.
const MIB: usize = 1 << 20;

/// What `acs`, `dp`, `app`, `nearest` and `random` take beside the limits; each has the paper's value by default.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(next_help_heading = "Options of the comparison algorithms")]
pub struct Paper {
    /// Memory that acs, dp and app may use, in MiB [default: 1024]
    #[arg(long, value_name = "MIB", value_parser = clap::value_parser!(u32).range(1..))]
    pub memory_limit: Option<u32>,
    /// dp: step of the time, in seconds [default: 1]
    #[arg(long, value_name = "S", value_parser = step)]
    pub dp_step: Option<f64>,
    /// app among moving sensors: step of the time, in seconds [default: 300]
    #[arg(long, value_name = "S", value_parser = step)]
    pub app_step: Option<f64>,
    /// app among moving sensors: recursion level, 1 to 12 [default: 3]
    #[arg(long, value_name = "L", value_parser = clap::value_parser!(u32).range(1..=12))]
    pub app_level: Option<u32>,
    /// app among moving sensors: plan with charges to 1 - E of the level [default: 0]
    #[arg(long, value_name = "E", value_parser = epsilon)]
    pub app_epsilon: Option<f64>,
    /// nearest, random: go to any sensor in reach, not only to those that help
    #[arg(long)]
    pub literal: bool,
}

impl Paper {
    /// The options that they set.
    pub(super) fn options(&self) -> PaperOptions {
        let default = PaperOptions::default();
        PaperOptions {
            memory_bytes: self
                .memory_limit
                .map_or(default.memory_bytes, |mib| (mib as usize).saturating_mul(MIB)),
            dp_step_s: self.dp_step.unwrap_or(default.dp_step_s),
            app_step_s: self.app_step.unwrap_or(default.app_step_s),
            app_level: self.app_level.unwrap_or(default.app_level),
            app_epsilon: self.app_epsilon.unwrap_or(default.app_epsilon),
            literal: self.literal,
            ..default
        }
    }
}

/// A step of time in seconds.
fn step(text: &str) -> Result<f64, String> {
    number(text, "a finite number above 0", |step| step > 0.0 && step.is_finite())
}

/// A share that leaves something.
fn epsilon(text: &str) -> Result<f64, String> {
    number(text, "at least 0 and below 1", |epsilon| (0.0..1.0).contains(&epsilon))
}

fn number(text: &str, rule: &str, holds: impl Fn(f64) -> bool) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number| holds(*number));
    number.ok_or_else(|| format!("must be {rule}"))
}

/// Says on standard error that an algorithm did not come to its end, and which limit would have to give.
pub(super) fn tell(solver: &str, unfinished: Option<Unfinished>) {
    let limit = match unfinished {
        None => return,
        Some(Unfinished::Budget) => "the time or the iterations",
        Some(Unfinished::Memory) => "the memory",
    };
    eprintln!("voltour: {solver} did not finish: {limit} ran out");
}
