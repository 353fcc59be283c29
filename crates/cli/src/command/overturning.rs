//! `uplift overturning`: how often a structure overturns, by its equivalent oscillator and by the rigid block that rotates as it does.

mod print;
mod tables;

use std::path::{Path, PathBuf};

use clap::Args;
use uplift_block::RockingBlock;
use uplift_motion::IntensityMeasure;
use uplift_risk::{StripeWeights, TAIL_SHARE_LIMIT};
use uplift_structure::PostUplift;

use super::Terminal;
use super::structure::{StructureArguments, measure_index, site_index};
use crate::error::CommandError;
use uplift::events::Progress;
use uplift::outputs::{refuse_foreign, refuse_overwriting};
use uplift::result::{SpectraOfResult, StudyOfResult, write_aside};
use uplift::structure::{Collapse, EventRisk, Model, collapse};
use uplift::text::per_cent;
use uplift_plot::{Width, png, svg};
use uplift_report::figures::overturning_figure;
use uplift_study::Structure;

/// Dots per inch of a PNG.
const DOTS_PER_INCH: f32 = 300.0;

#[derive(Debug, Args)]
#[command(
    after_help = "Structures to start from: configs/structures/*.toml. Method and a worked example: docs/design.md"
)]
pub(super) struct OverturningArguments {
    #[command(flatten)]
    structure: StructureArguments,
    /// Site of the result [default: all]
    #[arg(long)]
    site: Option<String>,
    /// Intensity measure: pgv or pga [default: all of the result]
    #[arg(long)]
    measure: Option<IntensityMeasure>,
    /// One coefficient of restitution for both models, in place of the structure's, the study's (oscillator) and that of angular momentum (block)
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    restitution: Option<f64>,
    /// Print everything as JSON
    #[arg(long)]
    json: bool,
    /// Draw the collapse fragility as SVG or PNG
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
    /// Write the collapse fragility to this CSV file, and the risk to one that ends in .risk.csv beside it
    #[arg(long, short, value_name = "FILE.csv")]
    output: Option<PathBuf>,
}

/// All that is told.
struct Overturning<'a> {
    structure: &'a Structure,
    source: &'a StudyOfResult,
    /// Positions of the sites.
    sites: Vec<usize>,
    /// Where the restitution of each model comes from.
    models: Vec<(Model, &'static str)>,
    /// `[measure]` of `[model]`.
    found: Vec<(&'a SpectraOfResult, Vec<Collapse>)>,
    records: usize,
    notes: Vec<String>,
}

pub(super) fn overturning(arguments: &OverturningArguments, terminal: &Terminal) -> Result<(), CommandError> {
    check_outputs(arguments)?;
    let (structure, source) = arguments.structure.read()?;
    let sites = match &arguments.site {
        Some(site) => vec![site_index(&source, Some(site))?],
        None => (0..source.sites.len()).collect(),
    };
    let measures: Vec<&SpectraOfResult> = match arguments.measure {
        Some(measure) => vec![&source.measures[measure_index(&source, Some(measure))?]],
        None => source.measures.iter().collect(),
    };
    let mut notes = Vec::new();
    let models = models(&structure, &source, arguments.restitution, &mut notes)?;
    let set = arguments.structure.records(&source)?.map_err(|reason| {
        CommandError::input(format!(
            "{reason}; overturning needs the records that the result was made from (--manifest says where they are)"
        ))
    })?;
    let mut study = source.study.clone();
    if !study.oscillator.free_vibration {
        // what is lost when a record ends has overturned, whoever looks
        study.oscillator.free_vibration = true;
        notes.push(
            "the study ends with its records (free_vibration = false); here what falls after their end counts as overturned"
                .to_owned(),
        );
    }
    let years = study.risk.years;
    let mut found = Vec::new();
    for measure in measures {
        let weights: Vec<&StripeWeights> = sites.iter().map(|&site| &measure.weights[site]).collect();
        let of_model = |(model, _): &(Model, &'static str)| {
            let runs = (set.records.len() * measure.plan.levels.len()) as u64;
            let label = format!("{}, {}", measure.measure().label(), model.name());
            let progress = Progress::begin(terminal, &label, "analyses", runs);
            let demands_m = model.demands_m(&study, &measure.plan, &set, &progress);
            drop(progress);
            collapse(&measure.plan.levels, &demands_m?, &weights, years)
        };
        let of_models = models.iter().map(of_model).collect::<Result<Vec<_>, _>>()?;
        found.push((measure, of_models));
    }
    let mut overturning =
        Overturning { structure: &structure, source: &source, sites, models, found, records: set.records.len(), notes };
    overturning.doubt();
    if let Some(path) = &arguments.plot {
        overturning.plot(path)?;
    }
    if let Some(path) = &arguments.output {
        overturning.write(path)?;
    }
    let mut out = std::io::stdout().lock();
    if arguments.json { overturning.print_json(&mut out) } else { overturning.print(&mut out) }?;
    let risk = arguments.output.as_deref().map(tables::risk_path);
    for path in arguments.plot.iter().chain(&arguments.output).chain(&risk) {
        terminal.say(&path.display().to_string());
    }
    Ok(())
}

/// Names that would lose something, before anything is computed.
fn check_outputs(arguments: &OverturningArguments) -> Result<(), CommandError> {
    if let Some(path) = &arguments.plot
        && !path.extension().is_some_and(|extension| extension == "svg" || extension == "png")
    {
        return Err(CommandError::Usage(format!("--plot {}: give a name that ends in .svg or .png", path.display())));
    }
    if let Some(path) = &arguments.output {
        if path.extension().is_none_or(|extension| extension != "csv") {
            return Err(CommandError::Usage(format!("-o {}: give a name that ends in .csv", path.display())));
        }
        refuse_foreign(path)?;
        refuse_foreign(&tables::risk_path(path))?;
    }
    for path in arguments.plot.iter().chain(&arguments.output) {
        refuse_overwriting(path, &arguments.structure.inputs())?;
    }
    Ok(())
}

/// The models of a structure, each with the origin of its restitution.
fn models(
    structure: &Structure,
    source: &StudyOfResult,
    for_both: Option<f64>,
    notes: &mut Vec<String>,
) -> Result<Vec<(Model, &'static str)>, CommandError> {
    let (study, own) = (&source.study, structure.description.restitution);
    let chosen = for_both.map(|value| (value, "--restitution")).or(own.map(|value| (value, "the structure file")));
    let (restitution, origin) = chosen.unwrap_or((study.oscillator.restitution, "the study"));
    let fail = |error: &dyn std::fmt::Display| match for_both {
        Some(_) => CommandError::Usage(format!("--restitution: {error}")),
        None => CommandError::input(error.to_string()),
    };
    let oscillator = structure.system.spectral_oscillator(restitution).map_err(|error| fail(&error))?;
    let mut models = vec![(Model::Oscillator(oscillator), origin)];
    match structure.system.post_uplift() {
        PostUplift::Negative { .. } => {}
        PostUplift::Zero | PostUplift::Positive { .. } => notes.push(
            "the force does not fall after uplift: the equivalent oscillator never overturns, however far it goes"
                .to_owned(),
        ),
    }
    let Some(block) = structure.block else {
        let kind = structure.description.kind.name();
        notes.push(format!("a {kind} rotates as no solitary block does: only the equivalent oscillator is analysed"));
        return Ok(models);
    };
    let (restitution, origin) = chosen.unwrap_or((block.restitution, "angular momentum"));
    let rocking = match RockingBlock::new(block.size_m, block.slenderness_rad) {
        Ok(rocking) => rocking,
        Err(error) => {
            notes.push(format!("only the equivalent oscillator is analysed, for no block rocks so: {error}"));
            return Ok(models);
        }
    };
    let block = rocking
        .with_gravity(structure.system.conditions().gravity_m_s2())
        .and_then(|block| block.with_restitution(restitution))
        .map_err(|error| fail(&error))?;
    models.push((Model::Block(block), origin));
    Ok(models)
}

impl Overturning<'_> {
    /// Notes on what the numbers rest on.
    fn doubt(&mut self) {
        if self.source.synthetic {
            self.notes.push("the records are synthetic, and scatter less than real ones: not for design".to_owned());
        }
        if let [(a, _), (b, _)] = &self.models[..]
            && a.restitution().to_bits() != b.restitution().to_bits()
        {
            self.notes.push(format!(
                "the oscillator keeps {} of its velocity at an impact, the block {:.4}: part of what they differ by is that (--restitution gives both the same)",
                a.restitution(),
                b.restitution()
            ));
        }
        for (measure, found) in &self.found {
            let label = measure.measure().label();
            for (found, (model, _)) in found.iter().zip(&self.models) {
                if let Err(reason) = &found.fit {
                    self.notes.push(format!("no lognormal fragility of the {} by {label}: {reason}", model.name()));
                }
                let shares = found.risks.iter().map(EventRisk::tail_share);
                let largest = shares.fold(0.0, f64::max);
                if largest > TAIL_SHARE_LIMIT {
                    self.notes.push(format!(
                        "up to {} of the risk of the {} by {label} comes from outside the analysed levels: they should reach further",
                        per_cent((1000.0 * largest).round() / 1000.0),
                        model.name()
                    ));
                }
            }
        }
    }

    fn plot(&self, path: &Path) -> Result<(), CommandError> {
        let measures: Vec<(IntensityMeasure, Vec<(&str, &Collapse)>)> = self
            .found
            .iter()
            .map(|(measure, found)| {
                let models = found.iter().zip(&self.models).map(|(found, (model, _))| (model.name(), found));
                (measure.measure(), models.collect())
            })
            .collect();
        let remark = if self.source.synthetic { "synthetic records: not for design" } else { "" };
        let figure = overturning_figure(&format!("Overturning of {}", self.structure.name()), remark, &measures);
        let drawing = svg(&figure, Width::Double).map_err(CommandError::input)?;
        if path.extension().is_some_and(|extension| extension == "png") {
            let image = png(&drawing.svg, DOTS_PER_INCH).map_err(|error| CommandError::input(error.to_string()))?;
            Ok(write_aside(path, &image)?)
        } else {
            Ok(write_aside(path, drawing.svg.as_bytes())?)
        }
    }
}
