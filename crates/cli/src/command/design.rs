//! `uplift design`: a structure against a uniform risk spectrum, and against its own risk.

mod print;

use std::io::Write;

use clap::Args;
use uplift_motion::IntensityMeasure;
use uplift_risk::TAIL_SHARE_LIMIT;
use uplift_structure::PostUplift;

use super::Terminal;
use super::structure::{StructureArguments, measure_index, site_index};
use crate::error::CommandError;
use uplift::events::Progress;
use uplift::result::{SpectraOfResult, StudyOfResult};
use uplift::structure::{
    ExactDemand, OSCILLATORS, RuleOutcome, SpectrumReading, check_rules, exact_demand, read_spectrum,
};
use uplift::text::per_cent;
use uplift_oscillator::PostUplift as AfterUplift;
use uplift_study::Structure;

#[derive(Debug, Args)]
#[command(
    after_help = "Structures to start from: configs/structures/*.toml. Method and a worked example: docs/design.md"
)]
pub(super) struct DesignArguments {
    #[command(flatten)]
    structure: StructureArguments,
    /// Site of the result [default: its only one]
    #[arg(long)]
    site: Option<String>,
    /// Probability of exceedance, one of the result [default: the smallest]
    #[arg(long)]
    poe: Option<f64>,
    /// Intensity measure of the spectrum: pgv or pga [default: pgv if the result has it]
    #[arg(long)]
    measure: Option<IntensityMeasure>,
    /// Safety factor on the demand (Eq. 3.15)
    #[arg(long, value_name = "FS", default_value_t = 2.5, allow_negative_numbers = true)]
    safety_factor: f64,
    /// Read the spectrum and apply the rules, without analysing the structure itself
    #[arg(long)]
    spectrum_only: bool,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
}

/// All that is told.
struct Design<'a> {
    structure: &'a Structure,
    source: &'a StudyOfResult,
    measure: &'a SpectraOfResult,
    site: usize,
    poe: usize,
    safety_factor: f64,
    restitution: f64,
    target_per_year: f64,
    reading: Option<SpectrumReading>,
    exact: Option<ExactDemand>,
    /// None where the rules do not apply, or where there is no demand to apply them to.
    rules: Option<[RuleOutcome; 2]>,
    notes: Vec<String>,
}

pub(super) fn design(arguments: &DesignArguments, terminal: &Terminal) -> Result<(), CommandError> {
    let safety_factor = arguments.safety_factor;
    if !(safety_factor.is_finite() && safety_factor >= 1.0) {
        return Err(CommandError::Usage(format!("--safety-factor is {safety_factor}: give a number of at least 1")));
    }
    let (structure, source) = arguments.structure.read()?;
    refuse_other_proxies(&source)?;
    let site = site_index(&source, arguments.site.as_deref())?;
    let measure = &source.measures[measure_index(&source, arguments.measure)?];
    let poe = source.poe_index(arguments.poe)?;
    let target_per_year = source.target_per_year(poe)?;
    let system = &structure.system;
    let restitution = structure.description.restitution.unwrap_or(source.study.oscillator.restitution);
    let mut notes = differences(&structure, &source, restitution);

    let strength = system.spectral_strength_at(source.study.gravity_m_s2);
    let reading = read_spectrum(&source.study.strengths, source.spectrum(measure, site, poe), strength);
    if reading.is_none() {
        let strengths = &source.study.strengths;
        notes.push(format!(
            "the spectrum cannot be read at strength {strength:.4}: its strengths go from {} to {}, and beside a censored ordinate there is nothing to read",
            strengths[0],
            strengths[strengths.len() - 1]
        ));
    }
    let exact = if arguments.spectrum_only {
        None
    } else {
        match arguments.structure.records(&source)? {
            Ok(set) => {
                let runs = (OSCILLATORS * set.records.len() * measure.plan.levels.len()) as u64;
                let label = measure.measure().label();
                let progress = Progress::begin(terminal, label, "analyses", runs);
                let weighed = (&measure.plan, &measure.weights[site]);
                let own = (system, restitution);
                let exact = exact_demand(&source.study, weighed, &set, own, target_per_year, &progress);
                drop(progress);
                Some(exact?)
            }
            Err(reason) => {
                notes.push(format!(
                    "the structure itself is not analysed, and what follows is what the spectrum alone says: {reason}"
                ));
                None
            }
        }
    };
    let rules = match system.post_uplift() {
        PostUplift::Positive { .. } => None,
        PostUplift::Negative { .. } | PostUplift::Zero => {
            let read_m = reading.map(|reading| system.participation() * reading.ordinate_m);
            let exact_m = exact.map(|exact| exact.zero_stiffness_m).filter(|demand_m| demand_m.is_finite());
            let rules = check_rules(system, safety_factor, read_m, exact_m);
            Some(rules.map_err(|error| CommandError::input(error.to_string()))?)
        }
    };
    if let Some(exact) = &exact {
        notes.extend(tails(exact));
    }
    let design = Design {
        structure: &structure,
        source: &source,
        measure,
        site,
        poe,
        safety_factor,
        restitution,
        target_per_year,
        reading,
        exact,
        rules,
        notes,
    };
    let mut out = std::io::stdout().lock();
    if arguments.json {
        writeln!(out, "{:#}", design.json()).map_err(CommandError::from)
    } else {
        design.print(&mut out)
    }
}

/// The rules start from the ZSBE system: a spectrum of another says nothing to them.
fn refuse_other_proxies(source: &StudyOfResult) -> Result<(), CommandError> {
    let (what, key) = match source.study.oscillator.post_uplift {
        AfterUplift::Zero => return Ok(()),
        AfterUplift::Negative { capacity_m } => {
            (format!("of negative stiffness, with a capacity of {capacity_m} m"), "capacity_m")
        }
        AfterUplift::Positive { stiffness_per_s2 } => {
            (format!("of positive stiffness, {stiffness_per_s2} 1/s2 after uplift"), "post_uplift_stiffness_per_s2")
        }
    };
    Err(CommandError::input(format!(
        "{}: its spectra are those of an oscillator {what}; the rules start from zero stiffness (ZSBE): run the study without oscillator.{key}",
        source.path.display()
    )))
}

/// What the structure and the study's oscillator do not have in common.
fn differences(structure: &Structure, source: &StudyOfResult, restitution: f64) -> Vec<String> {
    let (system, oscillator) = (&structure.system, &source.study.oscillator);
    let apart = |a: f64, b: f64| (a - b).abs() > 1e-9 * a.abs().max(b.abs());
    let mut notes = Vec::new();
    if source.synthetic {
        notes.push("the records are synthetic, and scatter less than real ones: not for design".to_owned());
    }
    let uplift_m = system.spectral_uplift_displacement_m();
    if apart(uplift_m, oscillator.uplift_displacement_m) {
        notes.push(format!(
            "the spectrum is of an uplift displacement of {} mm, the structure's is {} mm, over Γ {:.3} mm (Section 3.5)",
            1e3 * oscillator.uplift_displacement_m,
            1e3 * system.conditions().uplift_displacement_m(),
            1e3 * uplift_m
        ));
    }
    if apart(restitution, oscillator.restitution) {
        notes.push(format!(
            "the spectrum is of a restitution of {}, the structure's is {restitution}",
            oscillator.restitution
        ));
    }
    let gravity_m_s2 = system.conditions().gravity_m_s2();
    if apart(gravity_m_s2, source.study.gravity_m_s2) {
        notes.push(format!(
            "the spectrum is of a gravity of {} m/s2, the structure's is {gravity_m_s2} m/s2",
            source.study.gravity_m_s2
        ));
    }
    notes
}

/// Risks that come from outside the stripes.
fn tails(exact: &ExactDemand) -> Vec<String> {
    let demand = &exact.structure;
    let shares = [
        ("the demand on the structure", demand.lower_tail_share.max(demand.upper_tail_share)),
        ("exceeding the capacity", exact.beyond_capacity.map_or(0.0, |risk| risk.tail_share())),
        ("overturning", exact.overturning.tail_share()),
    ];
    shares
        .into_iter()
        .filter(|(_, share)| *share > TAIL_SHARE_LIMIT)
        .map(|(what, share)| {
            format!(
                "{} of the risk of {what} comes from outside the analysed levels: they should reach further",
                per_cent((1000.0 * share).round() / 1000.0)
            )
        })
        .collect()
}
