//! `uplift run`: the main job, end to end.

#[cfg(feature = "mpi")]
mod mpi;
mod summary;
mod work;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Instant;

use clap::Args;
use uplift_ida::Part;
use uplift_risk::OrdinateFlag;

use super::{Terminal, StudyArguments, displacement, site_table};
use uplift::UpliftError;
use uplift::inputs::{RecordSet, read_hazard, read_records};
use uplift::checkpoint::{KeptPieces, journal_path};
use uplift::result::{ResultLock};
use uplift_labelled::remove_leftovers;
use uplift::result::{Provenance, check_target};
use uplift::uniform_risk::{Outcome, csv_paths, write_csv, write_result};
use uplift::uniform_risk::{Coefficients, Spectra, fit_spectra, uniform_risk_spectra};
use uplift_study::{AnyStudy, ResolvedStudy};
use uplift::text::per_cent;
pub(super) use summary::{print_end, print_outcome, shown_path};
pub(super) use work::Work;

/// Fewer records than this make a spectrum that changes with each of them (Section 4.5.1: 40 are a robust lower limit).
const FEW_RECORDS: usize = 40;
/// What is said of every result of synthetic records.
pub(super) const SYNTHETIC: &str =
    "the records are synthetic: for results that matter bring real ones (records/README.md)";

#[derive(Debug, Args)]
pub(super) struct RunArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Result file, instead of the study's output.file
    #[arg(short, long, value_name = "FILE.h5")]
    output: Option<PathBuf>,
    /// Compute only part I of N of the stripes, into a file of its own; `uplift merge` joins the parts
    #[arg(long, value_name = "I/N", value_parser = shard, help = "Compute only part I of N of the stripes, into a file of its own (-o names it); uplift merge joins the parts")]
    shard: Option<Part>,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

/// Most parts that a run is cut into.
pub(super) const MOST_SHARDS: u64 = 100_000;

fn shard(text: &str) -> Result<Part, String> {
    let numbers = text
        .split_once('/')
        .and_then(|(index, count)| Some((index.trim().parse::<u64>().ok()?, count.trim().parse::<u64>().ok()?)));
    match numbers {
        Some((index, count)) if index >= 1 && index <= count && count <= MOST_SHARDS => {
            Ok(Part { index: index - 1, count })
        }
        _ => Err(format!("write 1/8 for the first of eight parts; at most {MOST_SHARDS}")),
    }
}

pub(super) fn run(arguments: &RunArguments, session: &Terminal) -> Result<(), UpliftError> {
    #[cfg(feature = "mpi")]
    if let Some(outcome) = mpi::run(arguments, session) {
        return outcome;
    }
    let study = match arguments.study.load_any()? {
        AnyStudy::UniformRisk(study) => study,
        AnyStudy::Displacement(study) => {
            if arguments.shard.is_some() {
                return Err(UpliftError::Usage(
                    "--shard cuts the stripes of a study of uniform risk; this one is of displacement spectra, a matter of minutes: run it as a whole".to_owned(),
                ));
            }
            let path = arguments.output.clone().unwrap_or_else(|| study.output.file.clone());
            return displacement::run(&study, &arguments.study.study, &path, arguments.json, session);
        }
    };
    if let Some(part) = arguments.shard {
        let path = arguments.output.clone().unwrap_or_else(|| shard_path(&study.output.file, part));
        let pieces = run_shard(&study, &path, part, None, session)?;
        let Part { index, count } = part;
        writeln!(
            std::io::stdout(),
            "shard {} of {count}, {pieces} pieces: {}",
            index + 1,
            shown_path(&path).display()
        )?;
        return Ok(());
    }
    let path = arguments.output.clone().unwrap_or_else(|| study.output.file.clone());
    run_study(&study, &arguments.study.study, &path, session, |outcome, files, seconds| {
        print_outcome(arguments.json, session, outcome, files, seconds)
    })
}

/// Where one part of the stripes of the result at `result` is kept.
fn shard_path(result: &Path, Part { index, count }: Part) -> PathBuf {
    let width = count.to_string().len();
    result.with_extension(format!("shard-{:0width$}-of-{count}", index + 1))
}

/// Carry out one part of the stripes of a study into the file `path`, but for what is known from an `earlier` result; the number of its
/// pieces.
fn run_shard(
    study: &ResolvedStudy,
    path: &Path,
    part: Part,
    earlier: Option<&Path>,
    session: &Terminal,
) -> Result<u64, UpliftError> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)
            .map_err(|error| UpliftError::input(format!("{} cannot be made: {error}", folder.display())))?;
    }
    let _lock = ResultLock::acquire(path)?;
    // a mistake in the hazard is found before, not when the shards are joined
    read_hazard(study)?;
    let records = read_records(study)?;
    session.remark("records", &format!(
"{}", records.description));
    let work = Work::new(study, &records)?;
    let head = work.head(part);
    let (file, known) = work::open(path, &head, earlier)?;
    session.kept_in(path);
    work.carry_out(&known, &file, part, session)?;
    Ok(head.pieces)
}

/// Carry out a study, write its result to `path`, and `report` what was found, the files and the seconds it took.
pub(super) fn run_study(
    study: &ResolvedStudy,
    study_file: &Path,
    path: &Path,
    session: &Terminal,
    report: impl FnOnce(&Outcome<'_>, &[PathBuf], f64) -> Result<(), UpliftError>,
) -> Result<(), UpliftError> {
    run_study_from(study, study_file, path, KeptPieces::default(), session, report)
}

/// As [`run_study`], with pieces of it that are `kept` from elsewhere.
pub(super) fn run_study_from(
    study: &ResolvedStudy,
    study_file: &Path,
    path: &Path,
    kept: KeptPieces,
    session: &Terminal,
    report: impl FnOnce(&Outcome<'_>, &[PathBuf], f64) -> Result<(), UpliftError>,
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
    let (hazard, notes) = read_hazard(study)?;
    let site_list = site_table::read(study, path, session)?;
    let records = read_records(study)?;
    session.remark("records", &format!(
"{}", records.description));

    let work = Work::new(study, &records)?;
    let (journal, mut known) = work::open(&journal_path(path), &work.head(Part::WHOLE), Some(path))?;
    known.kept.extend(kept);
    session.kept_in(journal.path());
    let stripes = work.carry_out(&known, &journal, Part::WHOLE, session)?;
    drop(known);
    let mut spectra = Vec::new();
    for (stripes, hazard) in stripes.iter().zip(&hazard) {
        spectra.push(uniform_risk_spectra(study, stripes, hazard)?);
    }
    let coefficients: Vec<Coefficients> = spectra.iter().map(|spectra| fit_spectra(study, spectra)).collect();
    let mut warnings = notes;
    warnings.extend(site_list.iter().flat_map(|list| list.notes.iter().cloned()));
    warnings.extend(records.notes.iter().cloned());
    warnings.extend(warnings_of(study, &records, &spectra, &coefficients));

    if session.cancelled() {
        let total = stripes.iter().map(|stripes| stripes.analyses).sum();
        return Err(UpliftError::Paused { what: "analyses", done: total, total, path: journal.path().to_owned() });
    }
    let mut provenance = Provenance::new(&study_file.display().to_string(), 0.0, &records, &hazard);
    provenance.input_checksums.extend(site_list.iter().flat_map(|list| list.checksums.clone()));
    let line = provenance.line(&study.title, &records.description);
    let mut sites = site_table::compute(study, site_list.as_ref(), &stripes, path, &line, session)?;
    warnings.append(&mut sites.warnings);
    provenance.wall_time_s = start.elapsed().as_secs_f64();
    let outcome = Outcome {
        study,
        records: &records,
        hazard: &hazard,
        stripes: &stripes,
        spectra: &spectra,
        coefficients: &coefficients,
        warnings: &warnings,
        provenance: &provenance,
    };
    write_result(path, &outcome)?;
    journal.remove();
    let mut files = vec![path.to_owned()];
    if study.output.csv && !study.sites.is_empty() {
        write_csv(path, &outcome)?;
        files.extend(csv_paths(path));
    }
    files.extend(sites.finish()?);
    report(&outcome, &files, start.elapsed().as_secs_f64())
}

fn warnings_of(
    study: &ResolvedStudy,
    records: &RecordSet,
    spectra: &[Spectra],
    coefficients: &[Coefficients],
) -> Vec<String> {
    let mut warnings = Vec::new();
    if records.synthetic {
        warnings.push(SYNTHETIC.to_owned());
    }
    if records.records.len() < FEW_RECORDS {
        warnings.push(format!(
            "few records ({}): below about {FEW_RECORDS} the spectra depend strongly on the choice of records",
            records.records.len()
        ));
    }
    for spectra in spectra {
        let [sites, poes, _] = spectra.shape;
        let label = spectra.measure.label();
        for (site, poe) in (0..sites).flat_map(|site| (0..poes).map(move |poe| (site, poe))) {
            let spectrum = spectra.spectrum(site, poe);
            let name = format!("{label}, {}, {}", study.sites[site].name, per_cent(study.risk.poe[poe]));
            let censored = spectrum.iter().filter(|ordinate| ordinate.flag == OrdinateFlag::Censored).count();
            if censored > 0 {
                warnings.push(format!(
                    "{name}: {censored} of {} ordinates are censored: overturned runs, or the last threshold, exceed the target risk",
                    spectrum.len()
                ));
            }
            let heavy = spectrum.iter().filter(|ordinate| ordinate.has_significant_tail()).count();
            if heavy > 0 {
                let share = |value: f64| format!("{:.1} %", 100.0 * value);
                let lower = spectrum.iter().fold(0.0_f64, |most, ordinate| most.max(ordinate.lower_tail_share));
                let upper = spectrum.iter().fold(0.0_f64, |most, ordinate| most.max(ordinate.upper_tail_share));
                warnings.push(format!(
                    "{name}: {heavy} of {} ordinates take more than 1 % of their risk from outside the stripes (at most {} below the first, {} above the last)",
                    spectrum.len(),
                    share(lower),
                    share(upper)
                ));
            }
        }
    }
    for coefficients in coefficients {
        for (row, fit) in coefficients.fits.iter().enumerate() {
            let poes = study.risk.poe.len();
            let name = format!(
                "{}, {}, {}",
                coefficients.measure.label(),
                study.sites[row / poes].name,
                per_cent(study.risk.poe[row % poes])
            );
            match fit {
                Err(reason) => warnings.push(format!("{name}: no fit: {reason}")),
                Ok(fit) if fit.at_search_limit => warnings.push(format!(
                    "{name}: the spectrum is no decaying exponential: its coefficients mean nothing one by one"
                )),
                Ok(_) => {}
            }
        }
    }
    warnings
}
