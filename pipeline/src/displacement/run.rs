//! A study of displacement spectra, from its inputs to the result file.

use std::collections::BTreeMap;
use std::time::Instant;

use uplift_spectra::MotionSet;
use uplift_study::DisplacementStudy;

use super::report::RunReport;
use super::{
    Designs, DisplacementOutcome, analyses, design_examples, set_spectra, structures, write_displacement_csv,
    write_displacements,
};
use crate::error::UpliftError;
use crate::events::{Events, Progress};
use crate::inputs::{RecordSets, read_record_sets};
use crate::result::{Provenance, ResultFile};
use crate::run::{Place, SYNTHETIC};
use crate::text::thousands;

/// With fewer motions beyond a percentile than this, one of them decides it.
const FEW_BEYOND: f64 = 5.0;

/// Carries out `study`.
pub(crate) fn run(study: &DisplacementStudy, place: &Place<'_>, events: &dyn Events) -> Result<RunReport, UpliftError> {
    let path = place.path;
    let records = read_record_sets(study)?;
    events.remark("records", &records.description);
    let sets = records.motions(study.gravity_m_s2)?;
    let structures = structures(study)?;

    let begin = Instant::now();
    let mut spectra = Vec::new();
    let mut total = 0;
    for set in &sets {
        let count = analyses(study, set);
        total += count;
        events.remark(
            &format!("{}:", set.name()),
            &format!(
                "{} motions x {} scalings x {} structures = {} analyses",
                set.motions().len(),
                study.scaling.ways().0.len(),
                structures.len(),
                thousands(count)
            ),
        );
        let progress = Progress::begin(events, set.name(), "analyses", count);
        spectra.push(set_spectra(study, &structures, set, &progress)?);
    }
    let seconds = begin.elapsed().as_secs_f64();
    let (designs, without_design) = design(study, &sets, events)?.unzip();
    let mut warnings = records.notes.clone();
    warnings.extend(warnings_of(study, &records, &sets));
    warnings.extend(without_design.into_iter().flatten());
    if events.cancelled() {
        return Err(UpliftError::Interrupted);
    }

    let mut provenance = Provenance::of_inputs(place.options, checksums(&records));
    provenance.wall_time_s = place.start.elapsed().as_secs_f64();
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
    let rows = ResultFile::open(path)?.design()?.map_or_else(Vec::new, |design| design.rows);
    if study.output.csv {
        files.extend(write_displacement_csv(path, &outcome, &rows)?);
    }
    Ok(RunReport::of(&outcome, rows, files, place.start.elapsed().as_secs_f64()))
}

/// The design examples, if the study asks for them, with notes.
fn design(
    study: &DisplacementStudy,
    sets: &[MotionSet<'_>],
    events: &dyn Events,
) -> Result<Option<(Designs, Vec<String>)>, UpliftError> {
    let Some(plan) = &study.design else { return Ok(None) };
    let examples = (sets.len() * study.scaling.ways().0.len()) as u64;
    events.remark("design", &format!("{examples} examples, {} points around each value", plan.noise_points));
    let progress = Progress::begin(events, "design", "examples", examples);
    let designs = design_examples(study, plan, sets, &progress);
    drop(progress);
    designs.map(Some)
}

fn checksums(records: &RecordSets) -> BTreeMap<String, String> {
    let of_record = |record: &crate::inputs::SetRecord| {
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
