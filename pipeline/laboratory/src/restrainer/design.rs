//! Stacks out of a catalogue for the columns of a structure.

mod advice;
mod report;

use std::path::Path;

use uplift_alarms::{Scope, alarms_of_inputs, ranked};
use uplift_design::{DesignError, DesignOptions, DesignReport, OwnReport, design as design_by_spectrum};
use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_job::events::Events;
use uplift_job::outputs::{self, Output, OutputKind};
use uplift_job::table::{ColumnsOf, write_table};
use uplift_job::text::risk_in_words;
use uplift_result::ResultFile;
use uplift_statics::selection::{select, stopper_yield_force_n};
use uplift_statics::{Candidate, Imperfections, Limits, StaticsError, Target, TendonPath};
use uplift_structure::{Kind, StructureDescription};
use uplift_study::{RestrainerFile, Structure};

use super::catalogue;
use super::options::RestrainerDesignOptions;
use crate::error::LaboratoryError;
use crate::pushover::pushed;
pub use report::{AtDemand, RestrainerDesign, StackTarget, StopperReport};

/// A column of every list of stacks, and of no other table.
const STACK_COLUMN: &str = "tendon_utilisation";
/// Stacks that are reported where nothing says how many.
const MOST: usize = 12;
/// Slack of which the effect is reported, m.
const SLACK_M: f64 = 0.002;
/// Prestress of which the effect is reported, as a share of the load on a column: that of column J, 2 kN of 52.2 kN.
const PRESTRESS_SHARE: f64 = 0.04;
/// Gap of a duct of which the effect is reported where the structure has none, m: the specimen's of Chapter 6.
const DUCT_GAP_M: f64 = 0.0087;

/// Finds stacks out of a catalogue for the columns of a structure.
///
/// # Errors
/// A structure without columns, or whose restrainer has no tendon; a catalogue that cannot be read; a target that
/// cannot be, or that no stack meets, with what refuses the nearest; a table that would replace something else or
/// cannot be written; what a design by a spectrum may meet.
pub fn design(
    structure: &Structure,
    options: &RestrainerDesignOptions,
    events: &dyn Events,
) -> Result<RestrainerDesign, LaboratoryError> {
    if let Some(table) = &options.table {
        let output = Output::new(table, OutputKind::Table(STACK_COLUMN)).with_result(&structure.file);
        outputs::check(&[output], &[&structure.file, &options.catalogue], options.force)?;
    }
    let columns = pushed(structure, 0)?;
    let held = columns.restrainer().and_then(|held| held.parts().tendon.map(|tendon| (tendon, *held.parts())));
    let Some((tendon, parts)) = held else { return Err(without_tendon(structure).into()) };
    let limits = Limits { prestress_n: parts.prestress_n, path: columns.path(), ..options.limits.behind(tendon) };
    let discs = catalogue::read(&options.catalogue)?;
    let (target, told, alarms) = target_of(structure, options, events)?;
    let needs_none = told.capacity_m.is_some_and(|capacity_m| capacity_m <= told.free_capacity_m);
    let all = if needs_none { Vec::new() } else { select(&columns, &discs, target, &limits, options.rank)? };
    if all.is_empty() && !needs_none {
        let advice = advice::advice(&columns, &discs, target, &limits)?;
        let (discs, catalogue) = (discs.len(), options.catalogue.display());
        let words = format!("no stack of the {discs} discs of {catalogue} meets {}: {advice}", told.words);
        return Err(JobError::Usage(words).into());
    }
    let stacks: Vec<Candidate> = all.iter().take(options.most.unwrap_or(MOST).max(1)).cloned().collect();
    let with = |stack: &Candidate| columns.clone().with_restrainer(stack.restrainer.clone(), limits.path);
    let stopper = |(stack, stopper)| stopper_behind(stack, &with(stack)?, stopper, limits.tendon_factor);
    let asked = options.stopper_gap_m.zip(options.stopper_stiffness_n_m);
    let stoppers = stacks.iter().zip(asked.into_iter().cycle()).map(stopper);
    let stoppers = stoppers.collect::<Result<_, LaboratoryError>>()?;
    let at_demand = match told.demand_m {
        None => Vec::new(),
        Some(demand_m) => stacks.iter().map(|stack| at_demand(&with(stack)?, demand_m)).collect::<Result<_, _>>()?,
    };
    let (frame, without_frame) = if let Some(first) = stacks.first() {
        with_stack(structure, &with(first)?, first, options, events)?
    } else {
        let free = Some(columns.clone().with_restrained(0)?);
        by_itself(&Structure { columns: free, ..without_restrainers(structure)? }, options, events)?
    };
    let (duct_gap_m, tendon_length_m) = match limits.path {
        TendonPath::Shifted { duct_gap_m, tendon_length_m } => (duct_gap_m, tendon_length_m),
        TendonPath::Column | TendonPath::Foundation => {
            // a tendon reaches from the foot to above the stack; nothing depends much on by how much
            (DUCT_GAP_M.min(0.2 * columns.geometry().half_width_m()), 1.5 * columns.geometry().height_m())
        }
    };
    let imperfections = Imperfections {
        slack_m: SLACK_M,
        prestress_n: PRESTRESS_SHARE * columns.top_load_n(),
        duct_gap_m,
        tendon_length_m,
    };
    let (tolerances_of, tolerances) = match named(&all, options.tolerances_of.as_deref())? {
        Some(wanted) => (stack_name(wanted), with(wanted)?.tolerances(&imperfections)?),
        None => Default::default(),
    };
    let mut files = Vec::new();
    if let Some(table) = &options.table {
        events.writing_into(table.parent().unwrap_or(Path::new("")));
        write(&all, structure, table)?;
        files.push(table.clone());
    }
    Ok(RestrainerDesign {
        name: structure.name(),
        file: structure.file.clone(),
        catalogue: options.catalogue.clone(),
        discs: discs.len(),
        target: told,
        found: all.len(),
        stacks,
        at_demand,
        proxy: options.urs.is_some() && frame.is_none(),
        frame,
        without_frame,
        stoppers,
        tolerances_of,
        tolerances,
        alarms,
        files,
    })
}

/// What a stopper does behind a stack in columns.
fn stopper_behind(
    stack: &Candidate,
    held: &uplift_statics::RestrainedColumns,
    (gap_m, stiffness_n_m): (f64, f64),
    tendon_factor: f64,
) -> Result<StopperReport, LaboratoryError> {
    let yields = stopper_yield_force_n(&stack.restrainer, gap_m, stiffness_n_m, tendon_factor);
    let most_yield_n = match yields {
        // a stack that is flat before the gap closes has no use for a stopper
        Err(StaticsError::StopperBehindFlat { .. }) => None,
        found => found?,
    };
    let engages_at_n = match stack.restrainer.parts().spring {
        uplift_statics::Spring::Discs(discs) => discs.law().force_n(gap_m),
        _ => f64::NAN,
    };
    let elongation_m = stack.restrainer.elongation_at_force_m(engages_at_n);
    let rotation = elongation_m.and_then(|elongation_m| held.rotation_at_elongation_rad(elongation_m));
    let engages_at_m = rotation.and_then(|rotation| held.at_rotation(rotation).ok()).map(|state| state.displacement_m);
    Ok(StopperReport { engages_at_n, engages_at_m, most_yield_n })
}

/// Columns with a stack in them at the demand (m).
fn at_demand(held: &uplift_statics::RestrainedColumns, demand_m: f64) -> Result<AtDemand, LaboratoryError> {
    let state = held.at_displacement(demand_m)?;
    Ok(AtDemand { tendon_n: state.tendon_n, spring_m: state.spring_m.unwrap_or(0.0) })
}

/// What the frame itself says of a structure with a stack in its columns, which are `held` by it: its demand by the
/// result of the target, and whether the stack's capacity is enough; or why it is left out.
fn with_stack(
    structure: &Structure,
    held: &uplift_statics::RestrainedColumns,
    stack: &Candidate,
    options: &RestrainerDesignOptions,
    events: &dyn Events,
) -> Result<(Option<OwnReport>, Option<String>), LaboratoryError> {
    let Some(capacity_m) = stack.capacity_m.filter(|_| options.urs.is_some()) else { return Ok((None, None)) };
    let description = StructureDescription {
        tendon_stiffness_n_m: structure.description.tendon_stiffness_for_capacity_n_m(capacity_m)?,
        ..structure.description
    };
    by_itself(&resolved(structure, &description, Some(held.clone()))?, options, events)
}

/// What the frame itself says; none by its proxy alone and without a result.
fn by_itself(
    structure: &Structure,
    options: &RestrainerDesignOptions,
    events: &dyn Events,
) -> Result<(Option<OwnReport>, Option<String>), LaboratoryError> {
    let Some(result) = options.urs.as_ref().filter(|_| !options.proxy) else { return Ok((None, None)) };
    let found = design_by_spectrum(structure, result, &options.by_spectrum(), events)?;
    Ok((found.own, found.without_own))
}

/// That a structure has no tendon to put a stack behind, and what to write.
fn without_tendon(structure: &Structure) -> JobError {
    let tendon = "kind = \"tendon\" until there is a stack, tendon_stiffness_n_m or tendon_area_m2 and tendon_length_m";
    // tendons of the description are linear restrainers, as those of the table may be
    let advice = if RestrainerFile::load(&structure.file).is_ok() {
        format!("[restrainer] has none: give {tendon}")
    } else {
        let place = match structure.description.kind {
            Kind::RestrainedFrame => "in place of tendon_stiffness_n_m and tendon_anchorage",
            _ => "below kind = \"restrained-frame\"",
        };
        format!("the file has no table [restrainer]: write it {place}, with anchorage, {tendon}")
    };
    JobError::Usage(format!("{}: a stack needs a tendon in series, and {advice}", structure.file.display()))
}

/// What a stack is called: packets in alternate sense, discs in each where there are several, the disc.
pub fn stack_name(stack: &Candidate) -> String {
    let parallel = if stack.parallel > 1 { format!("{} x ", stack.parallel) } else { String::new() };
    format!("{} x {parallel}{}", stack.springs, stack.disc)
}

/// The stack of this name, whatever its spaces; the first where none is given, and none where none is needed.
fn named<'a>(stacks: &'a [Candidate], name: Option<&str>) -> Result<Option<&'a Candidate>, LaboratoryError> {
    let (Some(name), Some(first)) = (name, stacks.first()) else { return Ok(stacks.first()) };
    let plain = |name: &str| name.split_whitespace().collect::<String>();
    Ok(Some(stacks.iter().find(|stack| plain(&stack_name(stack)) == plain(name)).ok_or_else(|| {
        JobError::Usage(format!(
            "{name:?} is none of the {} stacks that meet the target: name one of the list, e.g. \"{}\"",
            stacks.len(),
            stack_name(first)
        ))
    })?))
}

/// The target as the search takes it, as it is reported, and what to know of the spectrum that it comes from.
fn target_of(
    structure: &Structure,
    options: &RestrainerDesignOptions,
    events: &dyn Events,
) -> Result<(Target, StackTarget, Vec<Alarm>), LaboratoryError> {
    let columns = pushed(structure, 0)?;
    let free = columns.without_stoppers()?.linear(0.0)?;
    let critical_stiffness_n_m = free.critical_stiffness_n_m();
    let free_capacity_m = columns.geometry().width_m();
    let at_m = options.at_m.unwrap_or(2.0 * free_capacity_m);
    let report = |words: String, stiffness_n_m: f64, capacity_m: Option<f64>| StackTarget {
        words,
        stiffness_n_m,
        capacity_m,
        demand_m: None,
        at_m: capacity_m.unwrap_or(at_m),
        free_capacity_m,
        critical_stiffness_n_m,
    };
    let capacity = |words: String, capacity_m: f64| {
        if !(capacity_m > 0.0 && capacity_m.is_finite()) {
            return Err(LaboratoryError::from(JobError::Usage(format!(
                "a displacement capacity of {capacity_m} m: give one above 0, in m"
            ))));
        }
        let told = report(words, free.stiffness_for_capacity_n_m(capacity_m), Some(capacity_m));
        Ok((Target::Capacity { capacity_m }, told, Vec::new()))
    };
    match (options.stiffness_n_m, options.capacity_m, &options.urs) {
        (Some(stiffness_n_m), ..) => {
            let words = format!("{:.0} kN/m at {at_m:.4} m", 1e-3 * stiffness_n_m);
            Ok((Target::Stiffness { stiffness_n_m, at_m }, report(words, stiffness_n_m, None), Vec::new()))
        }
        (_, Some(capacity_m), _) if capacity_m > 0.0 && capacity_m <= free_capacity_m => Err(JobError::Usage(format!(
            "a capacity of {capacity_m:.4} m: the columns have {free_capacity_m:.4} m without any restrainer; \
                 give more"
        ))
        .into()),
        (_, Some(capacity_m), _) => capacity(format!("a capacity of {capacity_m:.4} m"), capacity_m),
        (.., Some(result)) => {
            let design = DesignOptions { spectrum_only: true, ..options.by_spectrum() };
            let found = design_by_spectrum(&without_restrainers(structure)?, result, &design, events)?;
            // the capacity that a rule asks for does not depend on the one that there is; the larger of both rules
            let required = found.rules.iter().filter_map(|own| Some((own.check()?.required_capacity_m, own.rule)));
            let Some((required_m, rule)) = required.max_by(|a, b| a.0.total_cmp(&b.0)) else {
                return Err(JobError::input(format!(
                    "{}: its spectrum says no capacity for {}: {}",
                    result.display(),
                    found.site,
                    found.notes.join("; ")
                ))
                .into());
            };
            let words = format!(
                "a capacity of {required_m:.4} m: required by {} with a safety factor of {}, at {}, {}, by {}",
                rule.words(),
                design.safety_factor,
                found.site,
                risk_in_words(found.poe, found.years),
                found.im
            );
            let (target, told, _) = capacity(words, required_m)?;
            let told = StackTarget { demand_m: Some(required_m / design.safety_factor), ..told };
            Ok((target, told, alarms_of_demand(result, &found)?))
        }
        _ if options.zero_stiffness => {
            let words = format!("a force that stays up to {at_m:.4} m");
            Ok((Target::ZeroStiffness { at_m }, report(words, critical_stiffness_n_m, None), Vec::new()))
        }
        _ => {
            let words = format!("a force that rises up to {at_m:.4} m");
            Ok((Target::PositiveStiffness { at_m }, report(words, critical_stiffness_n_m, None), Vec::new()))
        }
    }
}

/// What is to be known of the curves and records that a demand comes from.
fn alarms_of_demand(result: &Path, found: &DesignReport) -> Result<Vec<Alarm>, LaboratoryError> {
    let file = ResultFile::open(result)?;
    let site = file.axes_with_sites()?.sites.iter().position(|site| *site == found.site);
    let measure = file.measures().into_iter().find(|measure| measure.label() == found.im);
    let scope = Scope { site, measure, ..Scope::default() };
    Ok(ranked(alarms_of_inputs(&file, &scope).map_err(DesignError::from)?))
}

/// The columns without their restrainers, which may be a tendon that is still to get its springs.
fn without_restrainers(structure: &Structure) -> Result<Structure, LaboratoryError> {
    let description = StructureDescription {
        kind: Kind::Frame,
        tendon_stiffness_n_m: None,
        tendon_anchorage: None,
        ..structure.description
    };
    // a description that was one of a restrained frame is one of a free frame
    resolved(structure, &description, None)
}

/// The structure with another description, and columns.
fn resolved(
    structure: &Structure,
    description: &StructureDescription,
    columns: Option<uplift_statics::RestrainedColumns>,
) -> Result<Structure, LaboratoryError> {
    let system = description.resolve().map_err(|mistakes| match mistakes.into_iter().next() {
        Some(mistake) => LaboratoryError::Structure(mistake),
        None => JobError::input(structure.name()).into(),
    })?;
    Ok(Structure { description: *description, system, columns, ..structure.clone() })
}

fn write(stacks: &[Candidate], structure: &Structure, file: &Path) -> Result<(), LaboratoryError> {
    let columns = ColumnsOf::new(stacks)
        .with("disc", |stack| stack.disc.clone())
        .with("springs", |stack| stack.springs)
        .with("parallel", |stack| stack.parallel)
        .with("miss", |stack| stack.miss)
        .with("secant_n_m", |stack| stack.secant_n_m)
        .with("at_m", |stack| stack.at_m)
        .with("tendon_n", |stack| stack.tendon_n)
        .with("spring_m", |stack| stack.spring_m)
        .with("stroke_share", |stack| stack.stroke_share)
        .with(STACK_COLUMN, |stack| stack.tendon_utilisation)
        .with("capacity_m", |stack| stack.capacity_m)
        .with("linear_capacity_m", |stack| stack.linear_capacity_m)
        .with("length_m", |stack| stack.length_m)
        .with("mass_kg", |stack| stack.mass_kg)
        .with("price", |stack| stack.price);
    let line = format!("{}; stacks of springs, structure {}", outputs::mark(), structure.file.display());
    Ok(write_table(file, &line, columns.build())?)
}
