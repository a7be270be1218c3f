//! Options of the paper's comparison algorithms on the command line.

use voltour_solver::solvers::{AcsOptions, PaperOptions, Unfinished};

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
    #[arg(long, value_name = "S", value_parser = step, allow_negative_numbers = true)]
    pub dp_step: Option<f64>,
    /// app among moving sensors: step of the time, in seconds [default: 300]
    #[arg(long, value_name = "S", value_parser = step, allow_negative_numbers = true)]
    pub app_step: Option<f64>,
    /// app among moving sensors: recursion level, 1 to 12 [default: 3]
    #[arg(long, value_name = "L", value_parser = clap::value_parser!(u32).range(1..=12))]
    pub app_level: Option<u32>,
    /// app among moving sensors: plan with charges to 1 - E of the level [default: 0]
    #[arg(long, value_name = "E", value_parser = epsilon, allow_negative_numbers = true)]
    pub app_epsilon: Option<f64>,
    /// nearest, random: go to any sensor in reach, not only to those that help
    #[arg(long)]
    pub literal: bool,
    /// random: walks, the best of which is kept [default: 100]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub walks: Option<u32>,
    /// acs.
    #[command(flatten)]
    pub acs: Acs,
}

/// Parameters of the ant colony system.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(next_help_heading = "Options of the comparison algorithms")]
pub struct Acs {
    /// acs: colonies, one after the other, the best tour of all is kept [default: 5]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub acs_runs: Option<u32>,
    /// acs: iterations of a colony at most [default: 1000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub acs_iterations: Option<u32>,
    /// acs: iterations without a better tour that end a colony [default: 200]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub acs_patience: Option<u32>,
    /// acs: ants in an iteration [default: 10]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub acs_ants: Option<u32>,
    /// acs: exponent of the nearness [default: 2]
    #[arg(long, value_name = "B", value_parser = weight, allow_negative_numbers = true)]
    pub acs_beta: Option<f64>,
    /// acs: share of the steps that take the best edge rather than a random one [default: 0.5]
    #[arg(long, value_name = "Q", value_parser = share, allow_negative_numbers = true)]
    pub acs_q0: Option<f64>,
    /// acs: global pheromone decay, theta [default: 0.1]
    #[arg(long, value_name = "D", value_parser = share, allow_negative_numbers = true)]
    pub acs_decay: Option<f64>,
    /// acs: local pheromone decay [default: 0.1]
    #[arg(long, value_name = "D", value_parser = share, allow_negative_numbers = true)]
    pub acs_local_decay: Option<f64>,
    /// acs: steepness of the first deadline heuristic: little slack is attractive [default: 1]
    #[arg(long, value_name = "S", value_parser = weight, allow_negative_numbers = true)]
    pub acs_slack: Option<f64>,
    /// acs: steepness of the second: a long wait is not [default: 1]
    #[arg(long, value_name = "S", value_parser = weight, allow_negative_numbers = true)]
    pub acs_wait: Option<f64>,
}

impl Acs {
    fn options(&self) -> AcsOptions {
        let default = AcsOptions::default();
        AcsOptions {
            runs: self.acs_runs.unwrap_or(default.runs),
            iterations: self.acs_iterations.unwrap_or(default.iterations),
            patience: self.acs_patience.unwrap_or(default.patience),
            ants: self.acs_ants.unwrap_or(default.ants),
            beta: self.acs_beta.unwrap_or(default.beta),
            q0: self.acs_q0.unwrap_or(default.q0),
            decay: self.acs_decay.unwrap_or(default.decay),
            local_decay: self.acs_local_decay.unwrap_or(default.local_decay),
            slack: self.acs_slack.unwrap_or(default.slack),
            wait: self.acs_wait.unwrap_or(default.wait),
        }
    }
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
            walks: self.walks.unwrap_or(default.walks),
            acs: self.acs.options(),
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

/// A share.
fn share(text: &str) -> Result<f64, String> {
    number(text, "in [0, 1]", |share| (0.0..=1.0).contains(&share))
}

/// An exponent or a steepness.
fn weight(text: &str) -> Result<f64, String> {
    number(text, "a finite number, 0 or more", |weight| weight >= 0.0 && weight.is_finite())
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
