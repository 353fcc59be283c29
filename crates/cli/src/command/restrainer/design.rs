//! `uplift restrainer design`: stacks out of a catalogue.

#![allow(clippy::doc_markdown)] // what --help prints has no backticks

use std::path::PathBuf;

use clap::{ArgGroup, Args, ValueEnum};
use uplift::restrainer::{DesignTarget, RestrainerDesignOptions, StopperOptions, design as compute};
use uplift::result::OneRisk;
use uplift::structure::DesignOptions;
use uplift::study::Structure;
use uplift_motion::IntensityMeasure;
use uplift_statics::{Limits, Ranking, Tendon};

use crate::command::arguments::{Overwriting, number};
use crate::error::CommandError;
use crate::show::{print_json, print_restrainer_design};
use crate::terminal::Terminal;

#[expect(clippy::struct_excessive_bools, reason = "each is an option")]
#[derive(Debug, Args)]
#[command(
    group = ArgGroup::new("target").required(true).multiple(false),
    after_help = "Example:\n  uplift restrainer design configs/structures/column-j.toml \\\n    \
                  --catalogue configs/structures/disc-springs.csv --capacity-m 0.5\n\n\
                  The tendon, its prestress and its path come from [restrainer] in the structure file; before a stack \
                  is chosen its kind is \"tendon\". A worked design: docs/restrained-columns.md"
)]
pub(super) struct DesignArguments {
    /// Structure file: a restrained frame with its tendon
    structure: PathBuf,
    /// Catalogue of discs (CSV), e.g. configs/structures/disc-springs.csv
    #[arg(long, value_name = "FILE.csv")]
    catalogue: PathBuf,
    /// Target secant stiffness of springs and tendon, N/m, at --at-m
    #[arg(
        long, value_name = "K", group = "target", help_heading = TARGET, allow_negative_numbers = true,
        value_parser = number
    )]
    stiffness_n_m: Option<f64>,
    /// Target displacement capacity, m
    #[arg(
        long, value_name = "M", group = "target", help_heading = TARGET, allow_negative_numbers = true,
        value_parser = number
    )]
    capacity_m: Option<f64>,
    /// Target the capacity required by the spectrum of this result
    #[arg(long, value_name = "RESULT", group = "target", help_heading = TARGET)]
    urs: Option<PathBuf>,
    /// Target zero stiffness after uplift
    #[arg(long, group = "target", help_heading = TARGET)]
    zero_stiffness: bool,
    /// Target positive stiffness after uplift
    #[arg(long, group = "target", help_heading = TARGET)]
    positive_stiffness: bool,
    /// Displacement of the deck for a stiffness, m [default: two column widths]
    #[arg(long, value_name = "M", help_heading = TARGET, allow_negative_numbers = true, value_parser = number)]
    at_m: Option<f64>,
    /// Site [default: the only one]
    #[arg(long, requires = "urs", help_heading = SPECTRUM)]
    site: Option<String>,
    #[command(flatten, next_help_heading = "By a spectrum")]
    risk: OneRisk,
    /// Intensity measure [default: pgv]
    #[arg(long, requires = "urs", help_heading = SPECTRUM)]
    measure: Option<IntensityMeasure>,
    /// Safety factor on the demand (Eq. 3.15)
    #[arg(
        long, value_name = "FS", default_value_t = DesignOptions::default().safety_factor, help_heading = SPECTRUM,
        allow_negative_numbers = true, value_parser = number
    )]
    safety_factor: f64,
    /// Judge the proxy alone, without the wobbling frame
    #[arg(long, requires = "urs", help_heading = SPECTRUM)]
    proxy: bool,
    #[command(flatten)]
    limits: LimitArguments,
    /// Spring deformation at which stoppers engage, m
    #[arg(
        long, value_name = "M", requires = "stopper_stiffness_n_m", help_heading = STOPPER,
        allow_negative_numbers = true, value_parser = number
    )]
    stopper_gap_m: Option<f64>,
    /// Stiffness EA/L of the stoppers' rods, N/m
    #[arg(
        long, value_name = "K", requires = "stopper_gap_m", help_heading = STOPPER, allow_negative_numbers = true,
        value_parser = number
    )]
    stopper_stiffness_n_m: Option<f64>,
    /// Rank by target, mass, length or price
    #[arg(long, value_enum, default_value_t = By::Mass, help_heading = OUTPUT)]
    rank: By,
    /// Number of stacks to print
    #[arg(long, value_name = "N", default_value_t = 12, help_heading = OUTPUT)]
    most: usize,
    /// Stack whose tolerances are reported [default: the first]
    #[arg(long, value_name = "STACK", help_heading = OUTPUT)]
    tolerances_of: Option<String>,
    /// Write every stack
    #[arg(short, long, value_name = "FILE.csv", help_heading = OUTPUT)]
    output: Option<PathBuf>,
    /// Print JSON
    #[arg(long, help_heading = OUTPUT)]
    json: bool,
    #[command(flatten, next_help_heading = "Output")]
    overwriting: Overwriting,
}

const TARGET: &str = "Target (one of the first five)";
const SPECTRUM: &str = "By a spectrum";
const LIMITS: &str = "Limits";
const STOPPER: &str = "Stoppers";
const OUTPUT: &str = "Output";

/// What limits a stack.
#[derive(Debug, Args)]
struct LimitArguments {
    /// Relative tolerance of a stiffness
    #[arg(
        long, value_name = "SHARE", default_value_t = 0.1, help_heading = LIMITS, allow_negative_numbers = true,
        value_parser = number
    )]
    tolerance: f64,
    /// Relative tolerance of a capacity
    #[arg(
        long, value_name = "SHARE", default_value_t = 0.25, help_heading = LIMITS, allow_negative_numbers = true,
        value_parser = number
    )]
    excess: f64,
    /// Largest share of the stroke: 1 is flat, 0.75 for durability
    #[arg(
        long, value_name = "SHARE", default_value_t = 1.0, help_heading = LIMITS, allow_negative_numbers = true,
        value_parser = number
    )]
    stroke: f64,
    /// Safety factor on the tendon's yield
    #[arg(
        long, value_name = "FS", default_value_t = 1.5, help_heading = LIMITS, allow_negative_numbers = true,
        value_parser = number
    )]
    tendon_factor: f64,
    /// Largest force of the tendon, N
    #[arg(long, value_name = "N", help_heading = LIMITS, allow_negative_numbers = true, value_parser = number)]
    largest_force_n: Option<f64>,
    /// Largest outer diameter, m
    #[arg(long, value_name = "M", help_heading = LIMITS, allow_negative_numbers = true, value_parser = number)]
    largest_diameter_m: Option<f64>,
    /// Smallest inner diameter, m
    #[arg(long, value_name = "M", help_heading = LIMITS, allow_negative_numbers = true, value_parser = number)]
    least_inner_diameter_m: Option<f64>,
    /// Largest height of the unloaded stack, m
    #[arg(long, value_name = "M", help_heading = LIMITS, allow_negative_numbers = true, value_parser = number)]
    largest_length_m: Option<f64>,
    /// Most discs in parallel
    #[arg(long, value_name = "N", default_value_t = 2, help_heading = LIMITS)]
    parallel: u32,
    /// Most packets in series
    #[arg(long, value_name = "N", default_value_t = 40, help_heading = LIMITS)]
    springs: u32,
}

impl LimitArguments {
    /// The limits; the tendon in them is replaced by that of the structure.
    fn limits(&self) -> Limits {
        Limits {
            tolerance: self.tolerance,
            capacity_excess: self.excess,
            stroke_share: self.stroke,
            tendon_factor: self.tendon_factor,
            largest_force_n: self.largest_force_n,
            largest_diameter_m: self.largest_diameter_m,
            least_inner_diameter_m: self.least_inner_diameter_m,
            largest_length_m: self.largest_length_m,
            most_parallel: self.parallel,
            most_series: self.springs,
            ..Limits::behind(Tendon { stiffness_n_m: 1.0, yield_n: None, failure_n: None })
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum By {
    Target,
    Mass,
    Length,
    Price,
}

impl DesignArguments {
    fn target(&self) -> DesignTarget {
        match (self.stiffness_n_m, self.capacity_m, &self.urs) {
            (Some(stiffness_n_m), ..) => DesignTarget::Stiffness(stiffness_n_m),
            (_, Some(capacity_m), _) => DesignTarget::Capacity(capacity_m),
            (.., Some(result)) => DesignTarget::Spectrum {
                result: result.clone(),
                options: Box::new(DesignOptions {
                    site: self.site.clone(),
                    risk: self.risk,
                    measure: self.measure,
                    safety_factor: self.safety_factor,
                    proxy: self.proxy,
                    ..DesignOptions::default()
                }),
            },
            _ if self.zero_stiffness => DesignTarget::ZeroStiffness,
            _ => DesignTarget::PositiveStiffness,
        }
    }
}

pub(super) fn design(arguments: &DesignArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let structure = Structure::load(&arguments.structure)?;
    let stopper = arguments.stopper_gap_m.zip(arguments.stopper_stiffness_n_m);
    let options = RestrainerDesignOptions {
        catalogue: arguments.catalogue.clone(),
        target: arguments.target(),
        at_m: arguments.at_m,
        limits: Some(arguments.limits.limits()),
        ranking: match arguments.rank {
            By::Target => Ranking::Target,
            By::Mass => Ranking::Mass,
            By::Length => Ranking::Length,
            By::Price => Ranking::Price,
        },
        stopper: stopper.map(|(gap_m, stiffness_n_m)| StopperOptions { gap_m, stiffness_n_m }),
        tolerances_of: arguments.tolerances_of.clone(),
        most: arguments.most,
        table: arguments.output.clone(),
        force: arguments.overwriting.force,
    };
    let report = compute(&structure, &options, terminal)?;
    if arguments.json { print_json(&report) } else { print_restrainer_design(&report, terminal) }
}
