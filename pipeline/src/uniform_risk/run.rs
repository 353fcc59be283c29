//! A study of uniform risk, from its inputs to the result file.

use uplift_ida::Shard;
use uplift_risk::OrdinateFlag;
use uplift_study::UniformRiskStudy;

use super::report::RunReport;
use super::{
    Coefficients, Inputs, Outcome, Spectra, Stripes, csv_paths, fit_spectra, needs, site_table, uniform_risk_spectra,
    write_csv, write_result,
};
use crate::checkpoint::{Checkpoint, FinishedRows, checkpoint_path};
use crate::error::UpliftError;
use crate::events::Events;
use crate::frame::{FEW_RECORDS, Place, SYNTHETIC};
use crate::inputs::{RecordSet, read_hazard};
use crate::result::Provenance;
use crate::text::per_cent;

/// Carries out `study`, but for the rows of its analysis that are `known`.
pub(crate) fn run(
    study: &UniformRiskStudy,
    place: &Place<'_>,
    known: FinishedRows,
    events: &dyn Events,
) -> Result<RunReport, UpliftError> {
    let path = place.path;
    let (hazard, notes) = read_hazard(study)?;
    let site_list = site_table::read(study, events)?;
    let inputs = Inputs::read(study)?;
    let records = &inputs.records;
    events.remark("records", &records.description);

    needs(study, records, site_list.as_ref()).with_rows_of(&[checkpoint_path(path)]).require(path, events)?;
    let work = inputs.work(study, Some(path))?;
    let total = work.analyses();
    let mut checkpoint = Checkpoint::open(&checkpoint_path(path), &work.head(Shard::WHOLE))?;
    checkpoint.extend(known);
    checkpoint.path().into_iter().for_each(|path| events.resumes_from(path));
    let analysed = work.results(&checkpoint, events)?;
    checkpoint.release_rows();
    let stripes: Vec<Stripes> =
        study.measures.iter().zip(analysed).map(|(measure, analysed)| Stripes::of(measure, analysed)).collect();
    let mut spectra = Vec::new();
    for (stripes, hazard) in stripes.iter().zip(&hazard) {
        spectra.push(uniform_risk_spectra(study, stripes, hazard)?);
    }
    let coefficients: Vec<Coefficients> = spectra.iter().map(|spectra| fit_spectra(study, spectra)).collect();
    let mut warnings = notes;
    warnings.extend(site_list.iter().flat_map(|list| list.notes.iter().cloned()));
    warnings.extend(records.notes.iter().cloned());
    warnings.extend(warnings_of_records(records));
    warnings.extend(warnings_of_spectra(study, &spectra, &coefficients));

    if events.cancelled() {
        return Err(checkpoint.stopped(total, total));
    }
    let mut provenance = Provenance::new(place.options, records, &hazard);
    provenance.input_checksums.extend(site_list.iter().flat_map(|list| list.checksums.clone()));
    let line = provenance.line(&study.title, &records.description);
    let mut sites = site_table::compute(study, site_list.as_ref(), &stripes, path, &line, events)?;
    warnings.append(&mut sites.warnings);
    provenance.wall_time_s = place.start.elapsed().as_secs_f64();
    let outcome = Outcome {
        study,
        records,
        hazard: &hazard,
        stripes: &stripes,
        spectra: &spectra,
        coefficients: &coefficients,
        warnings: &warnings,
        provenance: &provenance,
    };
    write_result(path, &outcome)?;
    checkpoint.remove();
    let mut files = vec![path.to_owned()];
    if study.output.csv && !study.sites.is_empty() {
        write_csv(path, &outcome)?;
        files.extend(csv_paths(path));
    }
    files.extend(sites.finish()?);
    Ok(RunReport::of(&outcome, files, place.start.elapsed().as_secs_f64()))
}

/// What to know of the records before using the numbers.
fn warnings_of_records(records: &RecordSet) -> Vec<String> {
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
    warnings
}

/// What to know of the spectra of `study` before using them.
pub(crate) fn warnings_of_spectra(
    study: &UniformRiskStudy,
    spectra: &[Spectra],
    coefficients: &[Coefficients],
) -> Vec<String> {
    let mut warnings = Vec::new();
    for spectra in spectra {
        let label = spectra.measure.label();
        for ([site, poe], spectrum) in spectra.ordinates.blocks() {
            let name = format!("{label}, {}, {}", study.sites[site].name, per_cent(study.risk.poe[poe]));
            let censored = spectrum.iter().filter(|ordinate| ordinate.flag == OrdinateFlag::Censored).count();
            if censored > 0 {
                warnings.push(format!(
                    "{name}: {censored} of {} ordinates are censored: overturned runs, or the last threshold, \
                     exceed the target risk",
                    spectrum.len()
                ));
            }
            let heavy = spectrum.iter().filter(|ordinate| ordinate.has_significant_tail()).count();
            if heavy > 0 {
                let share = |value: f64| format!("{:.1} %", 100.0 * value);
                let lower = spectrum.iter().fold(0.0_f64, |most, ordinate| most.max(ordinate.lower_tail_share));
                let upper = spectrum.iter().fold(0.0_f64, |most, ordinate| most.max(ordinate.upper_tail_share));
                warnings.push(format!(
                    "{name}: {heavy} of {} ordinates take more than 1 % of their risk from outside the stripes (at \
                     most {} below the first, {} above the last)",
                    spectrum.len(),
                    share(lower),
                    share(upper)
                ));
            }
        }
    }
    for coefficients in coefficients {
        for ([site, poe], fit) in coefficients.fits.blocks() {
            let name = format!(
                "{}, {}, {}",
                coefficients.measure.label(),
                study.sites[site].name,
                per_cent(study.risk.poe[poe])
            );
            match &fit[0] {
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
