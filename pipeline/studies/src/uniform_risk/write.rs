//! The result file, written as docs/hdf5-layout.md describes it.

use std::path::Path;

use uplift_engine::checkpoint::oscillator_key;
use uplift_inputs::at_level::AtLevel;
use uplift_inputs::{DrawnStructure, Record, motion_keys};
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_motion::Combination;
use uplift_result::layout::{URS_PRECISION, axis, ida, intensity, records as layout, risk};
use uplift_result::{MeasureSpectra, Origin, urs};
use uplift_structure::UncertainQuantity;
use uplift_uniform_risk::consistency::Keep;

use super::Outcome;
use super::write_hazard::{write_branches, write_hazard, write_other_hazard, write_structures};
use crate::error::StudiesError;

/// Write `outcome` to `path`, atomically: an earlier file survives a failure.
///
/// # Errors
/// Whatever keeps the file from being written, a full disk for instance.
pub fn write_result(path: &Path, outcome: &Outcome<'_>) -> Result<(), StudiesError> {
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
    outcome.consistency.add(&mut writer, Keep::Exponents)?;
    writer.finish()?;
    Ok(())
}

fn write_root(writer: &mut LabelledWriter, outcome: &Outcome<'_>) -> Result<(), StudiesError> {
    let Outcome { study, records, .. } = outcome;
    let study_toml = study.to_toml()?;
    let origin = Origin {
        title: &study.title,
        study_toml: &study_toml,
        gravity_m_s2: study.gravity_m_s2,
        record_set: &records.description,
        synthetic: records.synthetic,
        warnings: outcome.warnings,
        provenance: outcome.provenance,
    };
    origin.write(writer)?;
    writer.attribute("/", "seed", study.seed)?;
    writer.attribute("/", "poe_years", study.risk.years)?;
    writer.attribute("/", "contour", study.risk.contour.key())?;
    Ok(())
}

fn write_axes(writer: &mut LabelledWriter, outcome: &Outcome<'_>) -> Result<(), LabelledError> {
    let study = outcome.study;
    let ids: Vec<String> = outcome.records.records.iter().map(|record| record.id.clone()).collect();
    writer.axis_text(axis::RECORD, &ids, "ground motion record")?;
    writer.axis_f64(axis::STRENGTH, &study.strengths, "1", "uplift strength f_up/(m g)")?;
    for plan in &study.measures {
        let intensity = study.records.intensity.long_name();
        let long_name = format!("stripe level of {}, {intensity}", plan.measure.long_name());
        writer.axis_f64(&axis::level(plan.measure), &plan.levels, plan.measure.unit(), &long_name)?;
    }
    if study.risk.maf_surface {
        writer.axis_f64(axis::THRESHOLD, &study.risk.thresholds_m, "m", "displacement threshold")?;
    }
    if let Some(structures) = outcome.spectra.first().and_then(|spectra| spectra.structures.first()) {
        writer.axis_text(axis::STRUCTURE, &structures.names, "structure that may be")?;
    }
    let sites: Vec<String> = study.sites.iter().map(|site| site.name.clone()).collect();
    if !sites.is_empty() {
        writer.axis_text(axis::SITE, &sites, "site")?;
    }
    let years = study.risk.years;
    writer.axis_f64(axis::POE, &study.risk.poe, "1", &format!("probability of exceedance in {years} years"))
}

fn write_records(
    writer: &mut LabelledWriter,
    records: &[Record],
    combination: Combination,
) -> Result<(), LabelledError> {
    let dims = &[axis::RECORD];
    let number = |key: &str| -> Vec<f64> { records.iter().map(|record| record.number(key)).collect() };
    let text = |key: &str| -> Vec<String> {
        records.iter().map(|record| record.metadata.get(key).cloned().unwrap_or_default()).collect()
    };
    writer.array_text(layout::EVENT, dims, &text("event"), "earthquake")?;
    writer.array_text(layout::STATION, dims, &text("station"), "recording station")?;
    writer.array_f64(layout::MAGNITUDE, dims, &number("magnitude"), "1", "moment magnitude")?;
    writer.array_f64(layout::RRUP_KM, dims, &number("rrup_km"), "km", "closest distance to the rupture")?;
    writer.array_f64(layout::VS30, dims, &number("vs30"), "m/s", "mean shear-wave velocity of the upper 30 m")?;
    let component: Vec<String> = records.iter().map(|record| record.direction.to_string()).collect();
    writer.array_text(layout::COMPONENT, dims, &component, "horizontal component analysed")?;
    writer.array_text(
        layout::MOTION_SHA256,
        dims,
        &motion_keys(records),
        "SHA-256 of time step and samples in m/s2",
    )?;
    let checksum: Vec<String> = records.iter().map(|record| record.checksum.clone()).collect();
    writer.array_text(layout::CHECKSUM, dims, &checksum, "SHA-256 of the component")?;
    let pga: Vec<f64> = records.iter().map(|record| record.pga_g).collect();
    writer.array_f64(
        layout::PGA_G,
        dims,
        &pga,
        "g",
        &format!("PGA of the unscaled pair, {}", combination.long_name()),
    )?;
    let pgv: Vec<f64> = records.iter().map(|record| record.pgv_cm_s).collect();
    writer.array_f64(
        layout::PGV_CM_S,
        dims,
        &pgv,
        "cm/s",
        &format!("PGV of the unscaled pair, {}", combination.long_name()),
    )?;
    let further = records.first().map_or_else(Vec::new, |record| record.further.keys().copied().collect());
    for measure in further {
        let values: Vec<f64> = records.iter().map(|record| record.intensity(measure)).collect();
        let long_name = format!("{} of the unscaled pair, {}", measure.long_name(), combination.long_name());
        writer.array_f64(&intensity(measure), dims, &values, measure.unit(), &long_name)?;
    }
    for (path, from, to) in [(layout::DURATION_5_75_S, 0.05, 0.75), (layout::DURATION_5_95_S, 0.05, 0.95)] {
        let durations: Vec<f64> =
            records.iter().map(|record| record.accelerogram.significant_duration_s(from, to)).collect();
        let long_name = format!(
            "significant duration of the component, {} to {} % of the Arias intensity",
            100.0 * from,
            100.0 * to
        );
        writer.array_f64(path, dims, &durations, "s", &long_name)?;
    }
    write_drawn_structures(writer, records)?;
    let dt: Vec<f64> = records.iter().map(|record| record.accelerogram.dt_s()).collect();
    writer.array_f64(layout::DT_S, dims, &dt, "s", "sampling interval")?;
    let samples: Vec<u32> =
        records.iter().map(|record| u32::try_from(record.accelerogram.len()).unwrap_or(u32::MAX)).collect();
    writer.array_u32(layout::SAMPLES, dims, &samples, "1", "number of samples")
}

/// The structure that each record shakes, where these are not known exactly.
fn write_drawn_structures(writer: &mut LabelledWriter, records: &[Record]) -> Result<(), LabelledError> {
    let dims = &[axis::RECORD];
    let drawn: Vec<&DrawnStructure> = records.iter().filter_map(|record| record.structure.as_ref()).collect();
    let Some(first) = drawn.first() else { return Ok(()) };
    let numbers: Vec<u32> = drawn.iter().map(|structure| u32::try_from(structure.number).unwrap_or(u32::MAX)).collect();
    writer.array_u32(layout::STRUCTURE, dims, &numbers, "1", "number of the structure that the record shakes")?;
    for (quantity, _) in &first.values {
        let values: Vec<f64> = drawn.iter().map(|structure| structure.value(*quantity).unwrap_or(f64::NAN)).collect();
        let (path, unit, long_name) = match quantity {
            UncertainQuantity::Strength => (layout::STRENGTH_FACTOR, "1", "factor on the strength of the structure"),
            UncertainQuantity::Restitution => (layout::RESTITUTION, "1", "restitution of the structure"),
            UncertainQuantity::UpliftDisplacement => {
                (layout::UPLIFT_DISPLACEMENT_M, "m", "displacement at uplift of the structure")
            }
            UncertainQuantity::Capacity => (layout::CAPACITY_M, "m", "displacement capacity of the structure"),
        };
        writer.array_f64(path, dims, &values, unit, long_name)?;
    }
    Ok(())
}

fn write_measure(
    writer: &mut LabelledWriter,
    outcome: &Outcome<'_>,
    index: usize,
    stored: &MeasureSpectra,
) -> Result<(), LabelledError> {
    let (stripes, measure) = (&outcome.stripes[index], stored.measure);
    let (group, dims) = (ida::group(measure), [axis::RECORD, axis::STRENGTH, &axis::level(measure)]);
    let long_name = if stripes.at_level.is_some() {
        "peak displacement, infinite where overturned, NaN where the record does not belong to the level"
    } else {
        "peak displacement, infinite where overturned"
    };
    writer.array_f64(&ida::edp_m(measure), &dims, stripes.peaks.displacement_m(), "m", long_name)?;
    writer.array_u32(&ida::impacts(measure), &dims, stripes.peaks.impacts(), "1", "number of impacts")?;
    if let Some(AtLevel { factors, shares, .. }) = &stripes.at_level {
        let level = axis::level(measure);
        let dims = [axis::RECORD, &level];
        let long_name = "scale factor of the record, NaN where it does not belong to the level";
        writer.array_f64(&ida::factor(measure), &dims, factors, "1", long_name)?;
        if let Some(shares) = shares {
            let long_name = "how much the record counts at the level, 0 where it does not belong to it";
            writer.array_f64(&ida::share(measure), &[&level, axis::RECORD], shares, "1", long_name)?;
        }
    }
    writer.attribute(&group, "oscillator_key", oscillator_key(outcome.study).as_str())?;
    writer.attribute(&group, "analyses", stripes.analyses)?;
    writer.attribute(&group, "seconds", stripes.seconds)?;

    let spectra = &outcome.spectra[index];
    if spectra.ordinates.values().is_empty() {
        return Ok(()); // a study without sites ends with the stripes
    }
    if let Some(surface) = &spectra.maf_per_year {
        let dims = [axis::SITE, axis::STRENGTH, axis::THRESHOLD];
        let long_name = "mean annual frequency of exceeding the threshold";
        writer.array_f64(&risk::maf_per_year(measure), &dims, surface.values(), "1/yr", long_name)?;
    }
    stored.write_spectra(writer)?;
    if let Some(precision) = outcome.precision.iter().find(|own| own.im == measure.label()) {
        let group = urs::GROUP.of_measure(measure);
        writer.attribute(&group, URS_PRECISION, precision.words().as_str())?;
        writer.attribute(&group, "half_width", precision.half_width[0])?;
        if let Some(by_event) = precision.half_width_by_event {
            writer.attribute(&group, "half_width_by_event", by_event)?;
        }
    }
    write_branches(writer, outcome, spectra)?;
    write_structures(writer, outcome, spectra)?;
    stored.write_coefficients(writer)
}
