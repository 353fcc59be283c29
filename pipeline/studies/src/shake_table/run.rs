//! A study of a shaking table, from its inputs to the result file.

use std::time::Instant;

use uplift_alarms::alarms;
use uplift_job::events::{Events, Silent};
use uplift_job::study_run::Place;
use uplift_result::earlier::Earlier;
use uplift_result::{Provenance, ResultFile};
use uplift_study::{Kind, ShakeTableStudy};

use super::plan::needs;
use super::report::RunReport;
use super::spectra::spectra;
use super::{Inputs, ShakeTableOutcome, carry_out, csv_tables, write_shake_table};
use crate::error::StudiesError;
use crate::{complete_result, write_tables};

/// What every result says of the model.
const TORSION: &str = "the deck does not turn about the vertical in the model: torsion, which was up to 0.115 rad in \
                       the tests of Chapter 6, is outside of it";

/// Carries out `study`. Its tests take seconds: what is stopped begins again.
///
/// # Errors
/// Inputs that cannot be used; a file that cannot be written; a job that was stopped.
pub fn run(study: &ShakeTableStudy, place: &Place<'_>, events: &dyn Events) -> Result<RunReport, StudiesError> {
    let path = place.path;
    let inputs = Inputs::read(study, events)?;
    events.remark("records", &inputs.records.description);
    needs(study, &inputs).require(path, events)?;
    let begin = Instant::now();
    let mut table = carry_out(study, &inputs, events)?;
    table.spectra = Some(spectra(study, &inputs, events)?);
    let seconds = begin.elapsed().as_secs_f64();
    let mut warnings = inputs.notes.clone();
    warnings.push(TORSION.to_owned());
    let provenance = Provenance::new(place.options, inputs.checksums);
    let mut provenance = provenance.with_result(path, &study.to_toml()?);
    provenance.wall_time_s = place.start.elapsed().as_secs_f64();
    let outcome = ShakeTableOutcome { study, table: &table, seconds, warnings: &warnings, provenance: &provenance };
    let earlier = Earlier::keep(path, &provenance.study_digest, None)?;
    write_shake_table(path, &outcome)?;
    earlier.set_aside(events)?;
    let mut files = vec![path.to_owned()];
    let file = ResultFile::open(path)?;
    if study.output.csv {
        files.extend(write_tables(&file, csv_tables(&file)?).inspect_err(complete_result(path, events))?);
    }
    let alarms = alarms(&file)?;
    let records = (table.records.as_str(), table.synthetic);
    let head = provenance.head(&study.title, records, alarms, files, place.start.elapsed().as_secs_f64());
    Ok(RunReport { head, kind: Kind::ShakeTable.key(), table })
}

/// Whether the result in `file` was computed from the structure, records and excitations of `study`.
///
/// # Errors
/// Inputs that cannot be used; a file that is damaged or of another kind.
pub fn is_of_inputs(file: &ResultFile, study: &ShakeTableStudy) -> Result<bool, StudiesError> {
    let inputs = Inputs::read(study, &Silent)?;
    let played = inputs.played().into_iter().map(|(excitation, _)| excitation);
    Ok(file.head()?.input_checksums == inputs.checksums && played.eq(file.shake_table()?.excitations))
}
