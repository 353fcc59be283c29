//! `uplift restrainer design`: stacks out of a catalogue.

#![allow(clippy::doc_markdown)] // what --help prints has no backticks

use std::path::PathBuf;

use clap::{ArgGroup, Args, ValueEnum};
use uplift::restrainer::{DesignTarget, RestrainerDesignOptions, StopperOptions, design as compute};
use uplift::structure::DesignOptions;
use uplift::study::Structure;
use uplift_motion::IntensityMeasure;
use uplift_statics::{Limits, Ranking, Tendon};

use crate::command::arguments::{ForceArgument, OneRiskArguments, number};
use crate::error::CommandError;
use crate::show::{print_json, print_restrainer_design};
use crate::terminal::Terminal;

#[derive(Debug, Args)]
#[command(
    group = ArgGroup::new("target").required(true).multiple(false),
    after_help = "The tendon, its prestress and its path are those of [restrainer] in the structure file; until there \
                  is a stack its kind is \"tendon\". A worked design: docs/restrained-columns.md"
)]
pub(super) struct DesignArguments {
    /// Structure file (TOML): a restrained frame with the tendon in its [restrainer]
    structure: PathBuf,
    /// Discs to choose from: CSV with outer_diameter_mm, inner_diameter_mm, thickness_mm, cone_height_mm (or
    /// free_height_mm), and where known reduced_thickness_mm, mass_kg, price, name
    #[arg(long, value_name = "FILE.csv")]
    catalogue: PathBuf,
    /// Secant stiffness of springs and tendon, N/m, at the travel --at-m
    #[arg(
        long, value_name = "K", group = "target", help_heading = TARGET, allow_negative_numbers = true,
        value_parser = number
    )]
    stiffness_n_m: Option<f64>,
    /// Displacement capacity, m
    #[arg(
        long, value_name = "M", group = "target", help_heading = TARGET, allow_negative_numbers = true,
        value_parser = number
    )]
    capacity_m: Option<f64>,
    /// The capacity that the spectrum of this result asks for: demand times safety factor
    #[arg(long, value_name = "RESULT", group = "target", help_heading = TARGET)]
    urs: Option<PathBuf>,
    /// A force that stays after uplift
    #[arg(long, group = "target", help_heading = TARGET)]
    zero_stiffness: bool,
    /// A force that rises after uplift
    #[arg(long, group = "target", help_heading = TARGET)]
    positive_stiffness: bool,
    /// Travel of the deck at which a stiffness counts, m [default: twice the width of a column]
    #[arg(long, value_name = "M", help_heading = TARGET, allow_negative_numbers = true, value_parser = number)]
    at_m: Option<f64>,
    /// Site [default: the only one]
    #[arg(long, requires = "urs", help_heading = SPECTRUM)]
    site: Option<String>,
    #[command(flatten, next_help_heading = "By a spectrum")]
    risk: OneRiskArguments,
    /// Intensity measure [default: pgv]
    #[arg(long, requires = "urs", help_heading = SPECTRUM)]
    measure: Option<IntensityMeasure>,
    /// Safety factor on the demand (Eq. 3.15)
    #[arg(
        long, value_name = "FS", default_value_t = DesignOptions::default().safety_factor, help_heading = SPECTRUM,
        allow_negative_numbers = true, value_parser = number
    )]
    safety_factor: f64,
    #[command(flatten)]
    limits: LimitArguments,
    /// Size stoppers that engage at this deformation of the springs, m
    #[arg(
        long, value_name = "M", requires = "stopper_stiffness_n_m", help_heading = STOPPER,
        allow_negative_numbers = true, value_parser = number
    )]
    stopper_gap_m: Option<f64>,
    /// Stiffness EA/L of their rods, N/m
    #[arg(
        long, value_name = "K", requires = "stopper_gap_m", help_heading = STOPPER, allow_negative_numbers = true,
        value_parser = number
    )]
    stopper_stiffness_n_m: Option<f64>,
    /// Rank by mass, length or price, or by what the target is missed by
    #[arg(long, value_enum, default_value_t = By::Mass, help_heading = OUTPUT)]
    rank: By,
    /// Most stacks that are printed
    #[arg(long, value_name = "N", default_value_t = 12, help_heading = OUTPUT)]
    most: usize,
    /// Tell what imperfections do to this stack, as the list calls it, e.g. "6 x 2 x 160/82/10" [default: the first]
    #[arg(long, value_name = "STACK", help_heading = OUTPUT)]
    tolerances_of: Option<String>,
    /// Write every stack to this CSV file
    #[arg(short, long, value_name = "FILE.csv", help_heading = OUTPUT)]
    output: Option<PathBuf>,
    /// Print JSON
    #[arg(long, help_heading = OUTPUT)]
    json: bool,
    #[command(flatten, next_help_heading = "Output")]
    overwriting: ForceArgument,
}

const TARGET: &str = "Target (one of the first five)";
const SPECTRUM: &str = "By a spectrum";
const LIMITS: &str = "Limits";
const STOPPER: &str = "Stoppers";
const OUTPUT: &str = "Output";

/// What limits a stack.
#[derive(Debug, Args)]
struct LimitArguments {
    /// By how much a stiffness may miss its target, as a share of it
    #[arg(
        long, value_name = "SHARE", default_value_t = 0.1, help_heading = LIMITS, allow_negative_numbers = true,
        value_parser = number
    )]
    tolerance: f64,
    /// By how much a capacity may exceed what is asked for, as a share of it
    #[arg(
        long, value_name = "SHARE", default_value_t = 0.25, help_heading = LIMITS, allow_negative_numbers = true,
        value_parser = number
    )]
    excess: f64,
    /// Share of its stroke that a stack may be pressed by: 1 is flat, 0.75 lets it last
    #[arg(
        long, value_name = "SHARE", default_value_t = 1.0, help_heading = LIMITS, allow_negative_numbers = true,
        value_parser = number
    )]
    stroke: f64,
    /// Factor between the tendon's yield and its largest force
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
    /// Least inner diameter, m: what has to pass through
    #[arg(long, value_name = "M", help_heading = LIMITS, allow_negative_numbers = true, value_parser = number)]
    least_inner_diameter_m: Option<f64>,
    /// Largest height of the unloaded stack, m
    #[arg(long, value_name = "M", help_heading = LIMITS, allow_negative_numbers = true, value_parser = number)]
    largest_length_m: Option<f64>,
    /// Most discs in the same sense
    #[arg(long, value_name = "N", default_value_t = 2, help_heading = LIMITS)]
    parallel: u32,
    /// Most packets in alternate sense
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
                    risk: self.risk.asked(),
                    measure: self.measure,
                    safety_factor: self.safety_factor,
                    spectrum_only: true,
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
