//! A study of displacement spectra, from its inputs to the result file.

use std::collections::BTreeMap;
use std::time::Instant;

use uplift_alarms::alarms;
use uplift_engine::checkpoint::{FinishedRows, checkpoint_path};
use uplift_ida::Shard;
use uplift_inputs::RecordSets;
use uplift_job::JobError;
use uplift_job::events::{Events, Silent};
use uplift_job::study_run::Place;
use uplift_result::earlier::Earlier;
use uplift_result::{Provenance, ResultFile};
use uplift_spectra::MotionSet;
use uplift_study::DisplacementStudy;

use super::report::RunReport;
use super::rounding::rounding;
use super::write::stored_motions;
use super::{DisplacementOutcome, Inputs, carry_out_designs, csv_tables, needs, set_spectra, write_displacements};
use crate::error::StudiesError;
use crate::{complete_result, write_tables};

/// With fewer motions beyond a percentile than this, one of them decides it.
const FEW_BEYOND: f64 = 5.0;

/// Carries out `study`, but for the rows of its analysis that are `known`.
///
/// # Errors
/// Inputs that cannot be used; a file that cannot be written; a job that was stopped.
pub fn run(
    study: &DisplacementStudy,
    place: &Place<'_>,
    known: FinishedRows,
    events: &dyn Events,
) -> Result<RunReport, StudiesError> {
    let path = place.path;
    let inputs = Inputs::read(study, events)?;
    let records = &inputs.records;
    events.remark("records", &records.description);
    let sets = inputs.sets(study)?;

    let needs = needs(study, records, &sets.motions).with_rows_of(&[checkpoint_path(path)]);
    needs.require(path, events)?;
    let work = sets.work(study)?;
    let total = work.analyses();
    let mut checkpoint = work.open_checkpoint(&checkpoint_path(path), Shard::WHOLE)?;
    checkpoint.extend(known);
    checkpoint.path().into_iter().for_each(|path| events.resumes_from(path));
    let begin = Instant::now();
    let (mut spectra, mut moved, mut analyses) = (Vec::new(), Vec::new(), 0);
    work.carry_out(&checkpoint, Shard::WHOLE, events, &mut |place, analysed| {
        match sets.motions.get(place) {
            Some(set) => {
                spectra.push(set_spectra(study, set, &analysed.peaks));
                analyses += analysed.analyses;
            }
            None => moved.push(rounding(study, &spectra[place - sets.motions.len()], &analysed.peaks)),
        }
        Ok(())
    })?;
    let seconds = begin.elapsed().as_secs_f64();
    let designs = carry_out_designs(study, &sets, Shard::WHOLE, (&checkpoint, total), events)?;
    let (designs, without_design) = designs.unzip();
    let mut warnings = records.notes.clone();
    warnings.extend(warnings_of(study, &sets.motions));
    warnings.extend(without_design.into_iter().flatten());
    if events.cancelled() {
        return Err(checkpoint.stopped(total, total).into());
    }

    let provenance = Provenance::new(place.options, checksums(records));
    let mut provenance = provenance.with_result(path, &study.to_toml()?);
    provenance.wall_time_s = place.start.elapsed().as_secs_f64();
    let outcome = DisplacementOutcome {
        study,
        records,
        sets: &sets.motions,
        spectra: &spectra,
        rounding: &moved,
        designs: designs.as_ref(),
        analyses,
        seconds,
        warnings: &warnings,
        provenance: &provenance,
    };
    let earlier = Earlier::keep(path, &provenance.study_digest, None)?;
    write_displacements(path, &outcome)?;
    earlier.set_aside(events)?;
    checkpoint.remove();
    let mut files = vec![path.to_owned()];
    // the tables say what the file says
    let file = ResultFile::open(path)?;
    if study.output.csv {
        files.extend(write_tables(&file, csv_tables(&file, study)?).inspect_err(complete_result(path, events))?);
    }
    let of_records = (records.description.as_str(), records.synthetic);
    let head = provenance.head(&study.title, of_records, alarms(&file)?, files, place.start.elapsed().as_secs_f64());
    let report = RunReport::read(&file, study, head)?;
    Ok(report.ok_or_else(|| JobError::input(format!("{}: no report can be made of it", path.display())))?)
}

/// Whether the result in `file` was computed from the records of `study` as its manifest describes them.
///
/// # Errors
/// Records that cannot be used; a file that is damaged or of another kind.
pub fn is_of_records(file: &ResultFile, study: &DisplacementStudy) -> Result<bool, StudiesError> {
    let inputs = Inputs::read(study, &Silent)?;
    if file.head()?.input_checksums != checksums(&inputs.records) {
        return Ok(false);
    }
    let motions = inputs.sets(study)?.motions;
    let names = inputs.records.sets.iter().map(|set| &set.name);
    if !names.eq(file.displacements()?.sets.iter().map(|set| &set.name)) {
        return Ok(false);
    }
    for (set, motions) in inputs.records.sets.iter().zip(&motions) {
        if !file.holds_motions(&set.name, &stored_motions(&inputs.records, set, motions))? {
            return Ok(false);
        }
    }
    Ok(true)
}

fn checksums(records: &RecordSets) -> BTreeMap<String, String> {
    records.records.iter().flat_map(uplift_inputs::SetRecord::named_checksums).collect()
}

fn warnings_of(study: &DisplacementStudy, sets: &[MotionSet<'_>]) -> Vec<String> {
    let mut warnings = Vec::new();
    for set in sets {
        let motions = set.motions().len() as f64;
        let beyond = |percent: f64| motions * percent.min(100.0 - percent) / 100.0;
        let few: Vec<String> = (study.percentiles.iter())
            .filter(|percent| beyond(**percent) < FEW_BEYOND)
            .map(|percent| format!("{percent} %"))
            .collect();
        if !few.is_empty() {
            warnings.push(format!(
                "{}: {motions} motions are few for the percentiles {}: fewer than {FEW_BEYOND} are beyond them",
                set.name(),
                few.join(", ")
            ));
        }
    }
    warnings
}
