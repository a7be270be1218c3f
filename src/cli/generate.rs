//! `voltour generate`. Draws a random scenario, as in the paper's simulation settings.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Subcommand;
use voltour_solver::generate::{self, GenerateError, KCoverage, Mobile, Reward};

use super::{Failure, documents, pretty};

/// Its arguments.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
The same preset, options and seed give the same scenario, for good.

Exit codes:
  0  a scenario was drawn
  2  bad arguments, or no deployment was found that is covered as asked

Examples:
  voltour generate k_coverage --sensors 48 --k 3 --alpha 0.6 --seed 1
  voltour generate reward --sensors 200 --seed 7 -o scenario.json
  voltour generate mobile --seed 3 | voltour solve -

`voltour generate PRESET --help` lists every option of a preset with its default.")]
pub struct Args {
    /// Which of the paper's problems
    #[command(subcommand)]
    pub preset: Preset,
}

/// The three presets of the one model.
#[derive(Debug, Subcommand)]
pub enum Preset {
    /// The shortest tour that keeps every point of a field covered by k sensors
    #[command(name = "k_coverage", alias = "k-coverage")]
    KCoverage {
        /// What to draw.
        #[command(flatten)]
        options: KCoverageArgs,
        /// Seed and place.
        #[command(flatten)]
        common: Common,
    },
    /// The largest reward that the charger's energy can pay for
    Reward {
        /// What to draw.
        #[command(flatten)]
        options: RewardArgs,
        /// Seed and place.
        #[command(flatten)]
        common: Common,
    },
    /// As many moving sensors as the time span allows
    Mobile {
        /// What to draw.
        #[command(flatten)]
        options: MobileArgs,
        /// Seed and place.
        #[command(flatten)]
        common: Common,
    },
}

/// What every preset has.
#[derive(Debug, clap::Args)]
pub struct Common {
    /// Seed of every random choice
    #[arg(long, value_name = "S")]
    pub seed: u64,
    /// Write the scenario into this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// Options of the solver crate as arguments: the same names, the same defaults.
macro_rules! arguments {
    ($(#[$doc:meta])* $name:ident, $options:ident {
        $($(#[$field_doc:meta])* $field:ident: $kind:ty, $value_name:literal;)*
    }) => {
        $(#[$doc])*
        #[derive(Debug, clap::Args)]
        pub struct $name {
            $($(#[$field_doc])*
            #[arg(long, value_name = $value_name, allow_negative_numbers = true,
                  default_value_t = $options::default().$field)]
            pub $field: $kind,)*
        }

        impl From<$name> for $options {
            fn from(arguments: $name) -> Self {
                Self { $($field: arguments.$field,)* }
            }
        }
    };
}

arguments! {
    /// Options of the preset `k_coverage`.
    KCoverageArgs, KCoverage {
        /// Sensors, uniform in the field (paper: 32 to 80)
        sensors: u32, "N";
        /// Covers that every point of the field has and must keep (paper: 2 to 4)
        k: u32, "K";
        /// A sensor asks when at most this share of its battery is left (paper: 0.2 to 0.8)
        alpha: f64, "SHARE";
        /// Side of the square field
        side_m: f64, "METRES";
        /// Sensing range
        range_m: f64, "METRES";
        /// Capacity of a battery
        battery_j: f64, "JOULES";
        /// Residual energies lie above this
        residual_above_j: f64, "JOULES";
        /// Least consumption
        drain_min_w: f64, "WATTS";
        /// Greatest consumption
        drain_max_w: f64, "WATTS";
        /// Speed of the charger
        speed_mps: f64, "SPEED";
        /// Energy that the charger travels with, per metre
        travel_jpm: f64, "JOULES";
        /// Charging power
        transfer_w: f64, "WATTS";
        /// Deployments drawn at most until one is covered as asked
        attempts: u32, "N";
    }
}

arguments! {
    /// Options of the preset `reward`.
    RewardArgs, Reward {
        /// Sensors, uniform in the field (paper: 50 to 200)
        sensors: u32, "N";
        /// Side of the square field
        side_m: f64, "METRES";
        /// A sensor asks when less than this share of its battery is left; at 1, always
        alpha: f64, "SHARE";
        /// Capacity of the charger (paper: 200000 to 350000)
        capacity_j: f64, "JOULES";
        /// Capacity of a battery
        battery_j: f64, "JOULES";
        /// Speed of the charger
        speed_mps: f64, "SPEED";
        /// Energy that the charger travels with, per metre
        travel_jpm: f64, "JOULES";
        /// Charging power
        transfer_w: f64, "WATTS";
    }
}

arguments! {
    /// Options of the preset `mobile`.
    MobileArgs, Mobile {
        /// Sensors, at first uniform in the field (paper: 10 to 30)
        sensors: u32, "N";
        /// Side of the square field
        side_m: f64, "METRES";
        /// The charger must have reached the upper right corner by then
        timespan_s: f64, "SECONDS";
        /// Slowest average speed of a sensor
        sensor_min_mps: f64, "SPEED";
        /// Fastest average speed of a sensor; less than the charger's
        sensor_max_mps: f64, "SPEED";
        /// Required charging level
        alpha: f64, "SHARE";
        /// A sensor is charged to (1 - epsilon) x alpha of its battery
        epsilon: f64, "SHARE";
        /// A sensor asks when at most this share of its battery is left
        request_below: f64, "SHARE";
        /// Capacity of a battery
        battery_j: f64, "JOULES";
        /// Speed of the charger
        speed_mps: f64, "SPEED";
        /// Energy that the charger travels with, per metre
        travel_jpm: f64, "JOULES";
        /// Charging power
        transfer_w: f64, "WATTS";
    }
}

/// Runs the command.
pub fn run(args: Args) -> Result<ExitCode, Failure> {
    let (drawn, common) = match args.preset {
        Preset::KCoverage { options, common } => {
            (generate::k_coverage(&options.into(), common.seed), common)
        }
        Preset::Reward { options, common } => {
            (generate::reward(&options.into(), common.seed), common)
        }
        Preset::Mobile { options, common } => {
            (generate::mobile(&options.into(), common.seed), common)
        }
    };
    let document = drawn.map_err(|error| refused(&error))?;
    documents::write(common.output.as_deref(), &pretty::json(&document)?)?;
    Ok(ExitCode::SUCCESS)
}

fn refused(error: &GenerateError) -> Failure {
    match error {
        GenerateError::Option { name, value, rule } => {
            Failure::input(format!("--{}: {value}: {rule}", name.replace('_', "-")))
        }
        error => Failure::input(error.to_string()),
    }
}
