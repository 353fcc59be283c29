//! A study of displacement spectra, end to end.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Instant;

use serde_json::json;
use uplift_spectra::MotionSet;

use super::super::Terminal;
use super::super::run::{SYNTHETIC, print_end, shown_path};
use super::table::json_row;
use uplift::UpliftError;
use uplift::inputs::{RecordSets, read_record_sets};
use uplift::result::{ResultLock};
use uplift_labelled::{LabelledReader, remove_leftovers};
use uplift::events::{Events, Progress};
use uplift::displacement::{DesignRow, DisplacementOutcome, read_design, write_displacement_csv, write_displacements};
use uplift::result::{Provenance, check_target};
use uplift::displacement::{Designs, analyses, design_examples, set_spectra, structures};
use uplift_study::{DisplacementStudy, Structures};
use uplift::text::{metres, nearest, table, thousands};

/// With fewer motions beyond a percentile than this, one of them decides it.
const FEW_BEYOND: f64 = 5.0;

/// Carry out `study` and write its result to `path`.
pub(in super::super) fn run(
    study: &DisplacementStudy,
    study_file: &Path,
    path: &Path,
    json: bool,
    session: &Terminal,
) -> Result<(), UpliftError> {
    let start = Instant::now();
    // a place that cannot be written is found now, not after the analyses
    check_target(path)?;
    let _lock = ResultLock::acquire(path)?;
    remove_leftovers(path);
    for warning in &study.warnings {
        session.note(&format!(
"{warning}"));
    }
    let records = read_record_sets(study)?;
    session.remark("records", &format!(
"{}", records.description));
    let sets = records.motions(study.gravity_m_s2)?;
    let structures = structures(study)?;

    let begin = Instant::now();
    let mut spectra = Vec::new();
    let mut total = 0;
    for set in &sets {
        let count = analyses(study, set);
        total += count;
        session.say(&format!(
            "{}: {} motions x {} scalings x {} structures = {} analyses",
            set.name(),
            set.motions().len(),
            study.scaling.ways().0.len(),
            structures.len(),
            thousands(count)
        ));
        let progress = Progress::begin(session, set.name(), "analyses", count);
        let of_set = set_spectra(study, &structures, set, &progress);
        drop(progress);
        spectra.push(of_set?);
    }
    let seconds = begin.elapsed().as_secs_f64();
    let (designs, without_design) = design(study, &sets, session)?.unzip();
    let mut warnings = records.notes.clone();
    warnings.extend(warnings_of(study, &records, &sets));
    warnings.extend(without_design.into_iter().flatten());
    if session.cancelled() {
        return Err(UpliftError::Interrupted);
    }

    let provenance =
        Provenance::of_inputs(&study_file.display().to_string(), start.elapsed().as_secs_f64(), checksums(&records));
    let outcome = DisplacementOutcome {
        study,
        records: &records,
        sets: &sets,
        spectra: &spectra,
        designs: designs.as_ref(),
        analyses: total,
        seconds,
        warnings: &warnings,
        provenance: &provenance,
    };
    write_displacements(path, &outcome)?;
    let mut files = vec![path.to_owned()];
    // the tables say what the file says
    let rows = read_design(&LabelledReader::open(path)?)?;
    if study.output.csv {
        files.extend(write_displacement_csv(path, &outcome, &rows)?);
    }
    let seconds = start.elapsed().as_secs_f64();
    let mut out = std::io::stdout().lock();
    if json {
        writeln!(out, "{:#}", summary(&outcome, &rows, &files, seconds))?;
    } else if !session.is_quiet() {
        print_summary(&mut out, &outcome, &files, seconds)?;
    }
    Ok(())
}

/// The design examples, if the study asks for them, with notes.
fn design(
    study: &DisplacementStudy,
    sets: &[MotionSet<'_>],
    session: &Terminal,
) -> Result<Option<(Designs, Vec<String>)>, UpliftError> {
    let Some(plan) = &study.design else { return Ok(None) };
    let examples = (sets.len() * study.scaling.ways().0.len()) as u64;
    session.remark("design", &format!(
"{examples} examples, {} points around each value", plan.noise_points));
    let progress = Progress::begin(session, "design", "examples", examples);
    let designs = design_examples(study, plan, sets, &progress);
    drop(progress);
    designs.map(Some)
}

fn checksums(records: &RecordSets) -> BTreeMap<String, String> {
    let of_record = |record: &uplift::inputs::SetRecord| {
        let [h1, h2] = record.checksums.clone();
        [(format!("record {} h1", record.pair.id), h1), (format!("record {} h2", record.pair.id), h2)]
    };
    records.records.iter().flat_map(of_record).collect()
}

fn warnings_of(study: &DisplacementStudy, records: &RecordSets, sets: &[MotionSet<'_>]) -> Vec<String> {
    let mut warnings = Vec::new();
    if records.synthetic {
        warnings.push(SYNTHETIC.to_owned());
    }
    for set in sets {
        let motions = set.motions().len() as f64;
        let beyond = |percent: f64| motions * percent.min(100.0 - percent) / 100.0;
        let few: Vec<String> = (study.percentiles.iter())
            .filter(|percent| beyond(**percent) < FEW_BEYOND)
            .map(|percent| format!("{percent} %"))
            .collect();
        if !few.is_empty() {
            warnings.push(format!(
                "{}: {motions} motions are few for the percentiles {}: fewer than {FEW_BEYOND} lie beyond, and one of them decides",
                set.name(),
                few.join(", ")
            ));
        }
    }
    warnings
}

/// The name of what the first and last line of a spectrum are, and how it is said.
fn abscissa_in_words(structures: &Structures) -> [&'static str; 2] {
    match structures {
        Structures::Oscillators(_) => ["strength", "smallest u_up, largest u_cap"],
        Structures::Blocks(_) => ["tan(alpha)", "largest block"],
    }
}

fn print_summary(
    out: &mut impl Write,
    outcome: &DisplacementOutcome<'_>,
    files: &[PathBuf],
    seconds: f64,
) -> Result<(), UpliftError> {
    let study = outcome.study;
    let abscissa = study.structures.abscissa();
    let shown = nearest(abscissa, &[0.1, 0.2, 0.4]);
    // of the lines, the one that overturns last
    let line = match &study.structures {
        Structures::Oscillators(family) => family.capacity_m.len() - 1,
        Structures::Blocks(family) => family.height_m.len() - 1,
    };
    let middle = nearest(&study.percentiles, &[50.0])[0];
    let [name, which] = abscissa_in_words(&study.structures);
    writeln!(
        out,
        "\nDisplacement spectra, {} % of each set, {which}: displacement in m{}",
        study.percentiles[middle],
        if outcome.records.synthetic { " (synthetic records)" } else { "" }
    )?;
    let header: Vec<String> = ["record set", "scaling", "by"]
        .map(str::to_owned)
        .into_iter()
        .chain(shown.iter().map(|&at| format!("{name} {:.3}", abscissa[at])))
        .collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let lines = study.structures.lines();
    let mut rows = Vec::new();
    for (set, spectra) in outcome.sets.iter().zip(outcome.spectra) {
        for (to, target) in study.scaling.to.iter().enumerate() {
            for (by, whose) in study.scaling.by.iter().enumerate() {
                let row = (to * study.scaling.by.len() + by) * lines + line;
                let ordinates = &spectra.percentile_m[(row * study.percentiles.len() + middle) * abscissa.len()..];
                let mut cells = vec![set.name().to_owned(), target.to_string(), whose.key().to_owned()];
                cells.extend(shown.iter().map(|&at| match ordinates[at] {
                    f64::INFINITY => "overturns".to_owned(),
                    ordinate => metres(ordinate),
                }));
                rows.push(cells);
            }
        }
    }
    writeln!(out, "{}", table(&header, &rows))?;
    print_end(out, outcome.warnings, files, seconds)?;
    if outcome.designs.is_some() {
        writeln!(out, "Design example: uplift table {}", shown_path(&files[0]).display())?;
    }
    Ok(())
}

fn summary(
    outcome: &DisplacementOutcome<'_>,
    rows: &[DesignRow],
    files: &[PathBuf],
    seconds: f64,
) -> serde_json::Value {
    let sets: Vec<serde_json::Value> = (outcome.records.sets.iter().zip(outcome.sets))
        .map(|(set, motions)| {
            json!({
                "name": set.name,
                "records": set.members.len(),
                "motions": motions.motions().len(),
                "median_pga_g": motions.median_pga_g(),
                "median_pgv_cm_s": motions.median_pgv_cm_s(),
            })
        })
        .collect();
    json!({
        "program": "uplift",
        "version": uplift::VERSION,
        "commit": uplift::COMMIT,
        "kind": uplift_study::DISPLACEMENT_SPECTRA,
        "study": outcome.provenance.study_file,
        "title": outcome.study.title,
        "record_set": outcome.records.description,
        "synthetic": outcome.records.synthetic,
        "files": files,
        "sets": sets,
        "analyses": outcome.analyses,
        "design": rows.iter().map(json_row).collect::<Vec<_>>(),
        "warnings": outcome.warnings,
        "seconds": seconds,
    })
}
