//! The result file, written as docs/hdf5-layout.md describes it.

use std::collections::BTreeSet;
use std::path::Path;

use uplift_engine::checkpoint::oscillator_key;
use uplift_inputs::at_level::AtLevel;
use uplift_inputs::{DrawnStructure, Record, motion_keys};
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_motion::{Combination, IntensityMeasure};
use uplift_result::declared::measure_names;
use uplift_result::layout::attribute::root;
use uplift_result::layout::{attribute, axis};
use uplift_result::{
    DRAWN_QUANTITY, DRAWN_STRUCTURE, FACTORS, IMPACTS, INTENSITY, KeptGroups, MOTION_KEYS, MeasureSpectra, PEAKS,
    RECORDS, RISK_SURFACE, SHARES, StoredRecords, drawn_names, intensity_names,
};

use super::ComputedStudy;
use super::write_hazard::{write_hazard, write_other_hazard};
use crate::error::StudiesError;

/// Write `outcome` to `path` with the `additions` to an earlier result, atomically: an earlier file survives a failure.
///
/// # Errors
/// Whatever keeps the file from being written, a full disk for instance.
pub(crate) fn write_result(
    path: &Path,
    outcome: &ComputedStudy<'_>,
    additions: Option<KeptGroups>,
) -> Result<(), StudiesError> {
    let mut writer = LabelledWriter::create(path)?;
    write_root(&mut writer, outcome)?;
    write_axes(&mut writer, outcome)?;
    write_records(&mut writer, &outcome.records.records, outcome.study.records.intensity)?;
    write_hazard(&mut writer, outcome.hazard)?;
    write_other_hazard(&mut writer, outcome.other_hazard)?;
    let spectra = outcome.stored_spectra();
    for (index, stored) in spectra.measures.iter().enumerate() {
        write_measure(&mut writer, outcome, index, stored)?;
    }
    if !additions.as_ref().is_some_and(KeptGroups::has_repair) {
        outcome.consistency.group(false).write(&mut writer)?;
    }
    if let Some(additions) = additions {
        additions.write(&mut writer)?; // closes the earlier file, which is about to be replaced
    }
    writer.finish()?;
    Ok(())
}

fn write_root(writer: &mut LabelledWriter, outcome: &ComputedStudy<'_>) -> Result<(), StudiesError> {
    let ComputedStudy { study, records, .. } = outcome;
    let toml = study.to_toml()?;
    let own = (study.title.as_str(), study.gravity_m_s2, toml.as_str());
    outcome.provenance.write(writer, own, (&records.description, records.synthetic), outcome.warnings)?;
    root::SEED.write(writer, &[], study.seed)?;
    root::POE_YEARS.write(writer, &[], study.risk.years)?;
    root::CONTOUR.write(writer, &[], study.risk.contour.key())?;
    Ok(())
}

fn write_axes(writer: &mut LabelledWriter, outcome: &ComputedStudy<'_>) -> Result<(), LabelledError> {
    let study = outcome.study;
    let ids: Vec<String> = outcome.records.records.iter().map(|record| record.id.clone()).collect();
    axis::RECORD.write_texts(writer, &[], &ids)?;
    axis::STRENGTH.write(writer, &[], &study.strengths)?;
    for plan in &study.measures {
        let (measure, combination) = (plan.measure, study.records.intensity.long_name());
        let names = [
            ("<im>", measure.key()),
            ("<unit>", measure.unit()),
            ("<measure>", measure.long_name()),
            ("<combination>", combination),
        ];
        axis::STRIPE_LEVEL.write(writer, &names, &plan.levels)?;
    }
    if study.risk.maf_surface {
        axis::THRESHOLD.write(writer, &[], &study.risk.thresholds_m)?;
    }
    if let Some(structures) = outcome.spectra.first().and_then(|spectra| spectra.structures.first()) {
        axis::STRUCTURE.write_texts(writer, &[], &structures.names)?;
    }
    let sites: Vec<String> = study.sites.iter().map(|site| site.name.clone()).collect();
    if !sites.is_empty() {
        axis::SITE.write_texts(writer, &[], &sites)?;
    }
    axis::POE.write(writer, &[("<years>", &study.risk.years.to_string())], &study.risk.poe)
}

fn write_records(
    writer: &mut LabelledWriter,
    records: &[Record],
    combination: Combination,
) -> Result<(), LabelledError> {
    let stored = stored_records(records);
    let lengths = [(axis::RECORD.name, records.len())];
    RECORDS.write(writer, &[], &lengths, &stored)?;
    MOTION_KEYS.write(writer, &[], &lengths, &stored)?;
    for measure in IntensityMeasure::OF_CHAPTER_4.into_iter().chain(stored.further.keys().copied()) {
        let words = if measure.is_of_chapter_4() { measure.label() } else { measure.long_name() };
        let more = [("<measure>", words), ("<combination>", combination.long_name())];
        let names = [&intensity_names(measure)[..], &more].concat();
        INTENSITY.write_array(writer, &names, stored.intensities(measure).unwrap_or_default())?;
    }
    write_drawn_structures(writer, records)
}

/// What a result holds of the records.
fn stored_records(records: &[Record]) -> StoredRecords {
    fn each<V>(records: &[Record], value: impl Fn(&Record) -> V) -> Vec<V> {
        records.iter().map(value).collect()
    }
    let number = |key| each(records, |record| record.number(key));
    let text = |key| each(records, |record| record.metadata.get(key).cloned().unwrap_or_default());
    let duration = |from, to| each(records, |record| record.accelerogram.significant_duration_s(from, to));
    let further = records.first().into_iter().flat_map(|record| record.further.keys().copied());
    StoredRecords {
        ids: each(records, |record| record.id.clone()),
        event: text("event"),
        station: text("station"),
        magnitude: number("magnitude"),
        rrup_km: number("rrup_km"),
        vs30: number("vs30"),
        component: each(records, |record| record.direction.to_string()),
        motion_sha256: motion_keys(records),
        checksum: each(records, |record| record.checksum.clone()),
        pga_g: each(records, |record| record.pga_g),
        pgv_cm_s: each(records, |record| record.pgv_cm_s),
        further: further.map(|own| (own, each(records, |record| record.intensity(own)))).collect(),
        duration_5_75_s: duration(0.05, 0.75),
        duration_5_95_s: duration(0.05, 0.95),
        dt_s: each(records, |record| record.accelerogram.dt_s()),
        samples: each(records, |record| u32::try_from(record.accelerogram.len()).unwrap_or(u32::MAX)),
    }
}

/// The structure that each record shakes, where these are not known exactly.
fn write_drawn_structures(writer: &mut LabelledWriter, records: &[Record]) -> Result<(), LabelledError> {
    let drawn: Vec<&DrawnStructure> = records.iter().filter_map(|record| record.structure.as_ref()).collect();
    let Some(first) = drawn.first() else { return Ok(()) };
    let numbers: Vec<u32> = drawn.iter().map(|structure| u32::try_from(structure.number).unwrap_or(u32::MAX)).collect();
    DRAWN_STRUCTURE.write_array(writer, &[], &numbers)?;
    for (quantity, _) in &first.values {
        let values: Vec<f64> = drawn.iter().map(|structure| structure.value(*quantity).unwrap_or(f64::NAN)).collect();
        DRAWN_QUANTITY.write_array(writer, &drawn_names(*quantity), &values)?;
    }
    Ok(())
}

fn write_measure(
    writer: &mut LabelledWriter,
    outcome: &ComputedStudy<'_>,
    index: usize,
    stored: &MeasureSpectra,
) -> Result<(), LabelledError> {
    let (stripes, measure) = (&outcome.stripes[index], stored.measure);
    let not_of_level =
        if stripes.at_level.is_some() { ", NaN where the record does not belong to the level" } else { "" };
    let names = [measure_names(measure)[0], ("<not_of_level>", not_of_level)];
    PEAKS.write_array(writer, &names, stripes.peaks.displacement_m())?;
    IMPACTS.write_array(writer, &names, stripes.peaks.impacts())?;
    if let Some(AtLevel { factors, shares, .. }) = &stripes.at_level {
        FACTORS.write_array(writer, &names, factors)?;
        if let Some(shares) = shares {
            SHARES.write_array(writer, &names, shares)?;
        }
    }
    attribute::stripes::OSCILLATOR_KEY.write(writer, &names, oscillator_key(outcome.study))?;
    attribute::stripes::ANALYSES.write(writer, &names, stripes.analyses)?;
    attribute::stripes::SECONDS.write(writer, &names, stripes.seconds)?;

    let spectra = &outcome.spectra[index];
    if spectra.ordinates.values().is_empty() {
        return Ok(()); // a study without sites ends with the stripes
    }
    if let Some(surface) = &spectra.maf_per_year {
        RISK_SURFACE.write_array(writer, &names, surface.values())?;
    }
    stored.write_spectra(writer)?;
    if let Some(precision) = outcome.precision.iter().find(|own| own.im == measure.label()) {
        attribute::precision::PRECISION.write(writer, &names, precision.words())?;
        attribute::precision::HALF_WIDTH.write(writer, &names, precision.half_width[0])?;
        if let Some(width) = precision.half_width_by_event {
            attribute::precision::HALF_WIDTH_BY_EVENT.write(writer, &names, width)?;
        }
    }
    let mut axes = BTreeSet::new();
    for branches in &spectra.branches {
        let site = &outcome.study.sites[branches.site].name;
        branches.write_curves(writer, (measure, site, &axis::branch(site, measure, &mut axes)))?;
    }
    for structures in &spectra.structures {
        structures.write_structures(writer, (measure, &outcome.study.sites[structures.site].name))?;
    }
    stored.write_coefficients(writer)
}
