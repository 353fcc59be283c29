//! `uplift check`: everything that can be wrong, and what the study would cost.

use std::io::Write;
use std::time::Duration;

use clap::Args;
use serde_json::json;
use uplift_ida::{Plan, estimate};

use super::{Terminal, StudyArguments, displacement, site_table};
use uplift::UpliftError;
use uplift::inputs::{RecordSet, SiteList, read_hazard, read_records};
use uplift::result::{check_target};
use uplift::uniform_risk::{oscillators, plan_stripes};
use uplift_study::{AnyStudy, ResolvedStudy};
use uplift::text::thousands;

/// Time spent on a measure to see how fast this machine is.
const CALIBRATION: Duration = Duration::from_secs(1);

#[derive(Debug, Args)]
pub(super) struct CheckArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Print the plan as JSON
    #[arg(long)]
    json: bool,
}

pub(super) fn check(arguments: &CheckArguments, session: &Terminal) -> Result<(), UpliftError> {
    let study = match arguments.study.load_any()? {
        AnyStudy::UniformRisk(study) => study,
        AnyStudy::Displacement(study) => {
            return displacement::check(&study, &arguments.study.study, arguments.json, session);
        }
    };
    check_target(&study.output.file)?;
    let (_, mut notes) = read_hazard(&study)?;
    let site_list = site_table::read(&study, &study.output.file, session)?;
    notes.extend(site_list.iter().flat_map(|list| list.notes.iter().cloned()));
    let records = read_records(&study)?;
    let oscillators = oscillators(&study)?;
    notes.splice(0..0, study.warnings.iter().cloned());
    notes.extend(records.notes.iter().cloned());

    let threads = rayon::current_num_threads();
    let mut analyses = 0;
    let mut seconds = 0.0;
    for measure in &study.measures {
        let plan: Plan<'_> = plan_stripes(&study, measure, &records, &oscillators)?;
        analyses += plan.analyses();
        seconds += estimate(&plan, CALIBRATION).seconds_one_thread / threads as f64;
    }
    let size = Size::of(&study, &records, site_list.as_ref());

    let mut out = std::io::stdout().lock();
    if arguments.json {
        let plan = json!({
            "study": arguments.study.study,
            "record_set": records.description,
            "synthetic": records.synthetic,
            "analyses": analyses,
            "threads": threads,
            "seconds": seconds,
            "memory_bytes": size.memory_bytes,
            "disk_bytes": size.disk_bytes,
            "output": study.output.file,
            "notes": notes,
        });
        writeln!(out, "{plan:#}")?;
        return Ok(());
    }
    if !session.is_quiet() {
        let toml = study.to_toml().map_err(|error| UpliftError::input(error.to_string()))?;
        writeln!(out, "# The study with every default filled in\n{}", toml.trim_end())?;
        writeln!(out, "\n# The plan")?;
    }
    writeln!(out, "records   {}", records.description)?;
    writeln!(out, "analyses  {}", thousands(analyses))?;
    writeln!(out, "time      about {} on {threads} threads", duration(seconds))?;
    writeln!(out, "memory    about {} MB", size.memory_bytes / 1_000_000)?;
    writeln!(out, "disk      at most about {} MB: {}", size.disk_bytes / 1_000_000, study.output.file.display())?;
    for note in &notes {
        writeln!(out, "note      {note}")?;
    }
    writeln!(out, "The study and its input data are in order.")?;
    Ok(())
}

/// A time for people.
pub(super) fn duration(seconds: f64) -> String {
    match seconds {
        s if s < 1.0 => "a second".to_owned(),
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.0} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

/// What a run takes, in bytes.
struct Size {
    memory_bytes: u64,
    disk_bytes: u64,
}

impl Size {
    /// The stripes hold 12 bytes an analysis; the surface 8 bytes a threshold, in memory twice while it is put in order; records 48
    /// bytes a sample with their integrals and extremes; a site of a table half a kilobyte, and as text 80 bytes an ordinate and 800 a fit.
    fn of(study: &ResolvedStudy, set: &RecordSet, list: Option<&SiteList>) -> Self {
        let count = |n: usize| n as u64;
        let (records, strengths) = (count(set.records.len()), count(study.strengths.len()));
        let levels: u64 = study.measures.iter().map(|measure| count(measure.levels.len())).sum();
        let measures = count(study.measures.len());
        let sites = count(study.sites.len());
        let stripes = 12 * records * strengths * levels;
        let thresholds = if study.risk.maf_surface { count(study.risk.thresholds_m.len()) } else { 0 };
        let surface = 8 * measures * sites * strengths * thresholds;
        let spectra = 40 * measures * sites * strengths * count(study.risk.poe.len());
        let samples: u64 = set.records.iter().map(|record| count(record.accelerogram.len())).sum();
        let listed = list.map_or(0, |list| count(list.sites.len()));
        let exports = list.map_or(0, |list| count(list.exports.len()));
        let text = listed * exports * count(study.risk.poe.len()) * (80 * strengths + 800);
        let program = 30_000_000;
        Self {
            memory_bytes: program
                + stripes
                + surface
                + surface / measures.max(1)
                + spectra
                + 64 * samples
                + 500 * listed,
            disk_bytes: stripes + surface + spectra + text + 1_000_000,
        }
    }
}
