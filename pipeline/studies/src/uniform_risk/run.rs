//! A study of uniform risk, from its inputs to the result file.

use std::path::{Path, PathBuf};

use uplift_alarms::alarms;
use uplift_engine::checkpoint::{FinishedRows, checkpoint_path};
use uplift_ida::Shard;
use uplift_inputs::{input_checksums, read_other_hazard};
use uplift_job::events::Events;
use uplift_job::study_run::Place;
use uplift_result::earlier::Earlier;
use uplift_result::{KeptGroups, Provenance, ResultFile};
use uplift_study::UniformRiskStudy;
use uplift_uniform_risk::consistency::Answer;
use uplift_uniform_risk::{Coefficients, Stripes, fit_spectra, pooled_demand, precision, uniform_risk_spectra};

use super::computed::ComputedStudy;
use super::earlier::is_of_records;
use super::plan::{hazard_of, tell_mistaken_curves};
use super::report::{MeasureReport, RunReport};
use super::site_table::{self, SiteOutput};
use super::{Inputs, csv_tables, needs, write_result};
use crate::error::StudiesError;
use crate::{complete_result, write_tables};

/// Carries out `study`, but for the rows of its analysis that are `known`.
///
/// # Errors
/// Inputs that cannot be used; a file that cannot be written; a job that was stopped.
pub fn run(
    study: &UniformRiskStudy,
    place: &Place<'_>,
    known: FinishedRows,
    events: &dyn Events,
) -> Result<RunReport, StudiesError> {
    let path = place.path;
    let (hazard, mut notes) = hazard_of(study, events)?;
    let (other_hazard, other_notes) = read_other_hazard(study)?;
    notes.extend(other_notes);
    let site_list = site_table::read(study, events)?;
    let inputs = Inputs::read(study, events)?;
    let records = &inputs.records;
    events.remark("records", &records.description);
    tell_mistaken_curves(study, records, (&hazard, &other_hazard), events)?;

    needs(study, records, site_list.as_ref()).with_rows_of(&[checkpoint_path(path)]).require(path, events)?;
    let beside = site_table::stripes_beside(study, path);
    let options = place.options;
    let further = options.earlier.iter().chain(options.slices.first()).chain(&beside);
    let earlier: Vec<&Path> = std::iter::once(path).chain(further.map(PathBuf::as_path)).collect();
    let work = inputs.work(study, &earlier)?;
    let total = work.analyses();
    let mut checkpoint = work.open_checkpoint(&checkpoint_path(path), Shard::WHOLE)?;
    checkpoint.extend(known);
    checkpoint.path().into_iter().for_each(|path| events.resumes_from(path));
    let analysed = work.results(&checkpoint, events)?;
    checkpoint.release_rows();
    let stripes: Vec<Stripes> = study
        .measures
        .iter()
        .zip(analysed)
        .map(|(measure, analysed)| Stripes::new(measure, records, analysed))
        .collect();
    let mut spectra = Vec::new();
    for (stripes, hazard) in stripes.iter().zip(&hazard) {
        spectra.push(uniform_risk_spectra(study, stripes, hazard)?);
    }
    let coefficients: Vec<Coefficients> = spectra.iter().map(|spectra| fit_spectra(study, spectra)).collect();
    let consistency = Answer::from_run(study, records, (&hazard, &other_hazard), &stripes)?;
    let mut precisions = Vec::new();
    for (stripes, hazard) in stripes.iter().zip(&hazard) {
        let weights: Vec<_> = hazard.iter().map(|site| &site.curve.weights).collect();
        let demand = |strength| pooled_demand(stripes, strength);
        precisions.extend(precision(study, stripes.measure, demand, &weights, consistency.question())?);
    }
    let mut warnings = notes;
    warnings.extend(site_list.iter().flat_map(|list| list.notes.iter().cloned()));
    warnings.extend(records.notes.iter().cloned());

    if events.cancelled() {
        return Err(checkpoint.stopped(total, total).into());
    }
    let mut provenance = Provenance::new(place.options, input_checksums(records, &hazard, &other_hazard));
    provenance.input_checksums.extend(site_list.iter().flat_map(|list| list.checksums.clone()));
    let mut provenance = provenance.with_result(path, &study.to_toml()?);
    let line = provenance.line(&study.title, &records.description);
    let mut sites = match &site_list {
        None => SiteOutput::default(),
        Some(list) if options.slices.is_empty() => {
            site_table::compute(study, list, (&stripes, consistency.question()), (path, &line), events)?
        }
        Some(list) => {
            let checksums = &provenance.input_checksums;
            site_table::join(study, (list, checksums), &options.slices, (path, &line), events)?
        }
    };
    warnings.append(&mut sites.warnings);
    provenance.wall_time_s = place.start.elapsed().as_secs_f64();
    let outcome = ComputedStudy {
        study,
        records,
        hazard: &hazard,
        other_hazard: &other_hazard,
        consistency: &consistency,
        stripes: &stripes,
        spectra: &spectra,
        coefficients: &coefficients,
        precision: &precisions,
        warnings: &warnings,
        provenance: &provenance,
    };
    let additions = valid_additions(&outcome, place)?;
    let earlier = Earlier::keep(path, &provenance.study_digest, additions.as_ref())?;
    write_result(path, &outcome, additions)?;
    earlier.set_aside(events)?;
    checkpoint.remove_unless_shared(events);
    let mut files = vec![path.to_owned()];
    // tables and summary say what every other look at the file says
    let file = ResultFile::open(path)?;
    if study.output.csv && !study.sites.is_empty() {
        files.extend(write_tables(&file, csv_tables(&file)?).inspect_err(complete_result(path, events))?);
    }
    files.extend(sites.finish().inspect_err(complete_result(path, events))?);
    let (of_records, seconds) =
        ((records.description.as_str(), records.synthetic), place.start.elapsed().as_secs_f64());
    let head = provenance.head(&study.title, of_records, alarms(&file)?, files, seconds);
    let measures = stripes.iter().map(MeasureReport::new).collect();
    RunReport::read(&file, head, measures, Some((&consistency, &precisions)))
}

/// The additions to the earlier result that stay valid: of a result with other numbers, or of one that is written
/// `again`, none.
fn valid_additions(outcome: &ComputedStudy<'_>, place: &Place<'_>) -> Result<Option<KeptGroups>, StudiesError> {
    let Ok(file) = ResultFile::open(place.path) else { return Ok(None) };
    let same_numbers = file.head()?.study_digest() == outcome.provenance.study_digest;
    if place.options.again || !same_numbers || !is_of_records(&file, outcome.study, &outcome.records.records)? {
        return Ok(None);
    }
    Ok(Some(KeptGroups::valid_for(file, outcome.study)?))
}
