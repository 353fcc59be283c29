//! The result file, written as docs/hdf5-layout.md describes it.

use std::path::Path;

use uplift_motion::{Combination, IntensityMeasure};
use uplift_risk::{Ordinate, OrdinateFlag};

use super::Outcome;
use super::write_hazard::{write_branches, write_hazard};
use crate::checkpoint::{motion_key, oscillator_key};
use crate::error::UpliftError;
use crate::inputs::Record;
use crate::result::{Origin, level_axis};
use uplift_labelled::{LabelledError, LabelledWriter};

/// Write `outcome` to `path`, aside and renamed, so that an earlier file survives a failure.
///
/// # Errors
/// Whatever keeps the file from being written, a full disk for instance.
pub fn write_result(path: &Path, outcome: &Outcome<'_>) -> Result<(), UpliftError> {
    let mut writer = LabelledWriter::create(path)?;
    write_root(&mut writer, outcome)?;
    write_axes(&mut writer, outcome)?;
    write_records(&mut writer, &outcome.records.records, outcome.study.records.intensity)?;
    write_hazard(&mut writer, outcome.hazard)?;
    for (index, plan) in outcome.study.measures.iter().enumerate() {
        write_measure(&mut writer, outcome, index, plan.measure)?;
    }
    writer.finish()?;
    Ok(())
}

fn write_root(writer: &mut LabelledWriter, outcome: &Outcome<'_>) -> Result<(), UpliftError> {
    let Outcome { study, records, .. } = outcome;
    let study_toml = study.to_toml().map_err(|error| UpliftError::input(error.to_string()))?;
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
    writer.axis_text("record", &ids, "ground motion record")?;
    writer.axis_f64("strength", &study.strengths, "1", "uplift strength f_up/(m g)")?;
    for plan in &study.measures {
        let intensity = study.records.intensity.long_name();
        let long_name = format!("stripe level of {}, {intensity}", plan.measure.long_name());
        writer.axis_f64(&level_axis(plan.measure), &plan.levels, plan.measure.unit(), &long_name)?;
    }
    if study.risk.maf_surface {
        writer.axis_f64("threshold", &study.risk.thresholds_m, "m", "displacement threshold")?;
    }
    let sites: Vec<String> = study.sites.iter().map(|site| site.name.clone()).collect();
    if !sites.is_empty() {
        writer.axis_text("site", &sites, "site")?;
    }
    let years = study.risk.years;
    writer.axis_f64("poe", &study.risk.poe, "1", &format!("probability of exceedance in {years} years"))
}

fn write_records(writer: &mut LabelledWriter, records: &[Record], intensity: Combination) -> Result<(), LabelledError> {
    let dims = &["record"];
    let number = |key: &str| -> Vec<f64> { records.iter().map(|record| record.number(key)).collect() };
    let text = |key: &str| -> Vec<String> {
        records.iter().map(|record| record.metadata.get(key).cloned().unwrap_or_default()).collect()
    };
    writer.array_text("/records/event", dims, &text("event"), "earthquake")?;
    writer.array_text("/records/station", dims, &text("station"), "recording station")?;
    writer.array_f64("/records/magnitude", dims, &number("magnitude"), "1", "moment magnitude")?;
    writer.array_f64("/records/rrup_km", dims, &number("rrup_km"), "km", "closest distance to the rupture")?;
    writer.array_f64("/records/vs30", dims, &number("vs30"), "m/s", "mean shear-wave velocity of the upper 30 m")?;
    let component: Vec<String> = records.iter().map(|record| record.component.to_string()).collect();
    writer.array_text("/records/component", dims, &component, "horizontal component analysed")?;
    let motions: Vec<String> = records.iter().map(|record| motion_key(&record.accelerogram)).collect();
    writer.array_text("/records/motion_sha256", dims, &motions, "SHA-256 of time step and samples in m/s2")?;
    let checksum: Vec<String> = records.iter().map(|record| record.checksum.clone()).collect();
    writer.array_text("/records/checksum", dims, &checksum, "SHA-256 of the component")?;
    let pga: Vec<f64> = records.iter().map(|record| record.pga_g).collect();
    writer.array_f64(
        "/records/pga_g",
        dims,
        &pga,
        "g",
        &format!("PGA of the unscaled pair, {}", intensity.long_name()),
    )?;
    let pgv: Vec<f64> = records.iter().map(|record| record.pgv_cm_s).collect();
    writer.array_f64(
        "/records/pgv_cm_s",
        dims,
        &pgv,
        "cm/s",
        &format!("PGV of the unscaled pair, {}", intensity.long_name()),
    )?;
    for (name, from, to) in [("duration_5_75_s", 0.05, 0.75), ("duration_5_95_s", 0.05, 0.95)] {
        let durations: Vec<f64> =
            records.iter().map(|record| record.accelerogram.significant_duration_s(from, to)).collect();
        let long_name = format!(
            "significant duration of the component, {} to {} % of the Arias intensity",
            100.0 * from,
            100.0 * to
        );
        writer.array_f64(&format!("/records/{name}"), dims, &durations, "s", &long_name)?;
    }
    let dt: Vec<f64> = records.iter().map(|record| record.accelerogram.dt_s()).collect();
    writer.array_f64("/records/dt_s", dims, &dt, "s", "sampling interval")?;
    let samples: Vec<u32> =
        records.iter().map(|record| u32::try_from(record.accelerogram.len()).unwrap_or(u32::MAX)).collect();
    writer.array_u32("/records/samples", dims, &samples, "1", "number of samples")
}

fn write_measure(
    writer: &mut LabelledWriter,
    outcome: &Outcome<'_>,
    index: usize,
    measure: IntensityMeasure,
) -> Result<(), LabelledError> {
    let key = measure.key();
    let stripes = &outcome.stripes[index];
    let (group, dims) = (format!("/ida/{key}"), ["record", "strength", &level_axis(measure)]);
    let edp = format!("{group}/edp_m");
    writer.array_f64(&edp, &dims, stripes.edp.edp_m(), "m", "peak displacement, infinite where overturned")?;
    writer.array_u32(&format!("{group}/impacts"), &dims, stripes.edp.impacts(), "1", "number of impacts")?;
    writer.attribute(&group, "oscillator_key", oscillator_key(outcome.study).as_str())?;
    writer.attribute(&group, "analyses", stripes.analyses)?;
    writer.attribute(&group, "seconds", stripes.seconds)?;

    let spectra = &outcome.spectra[index];
    if spectra.shape[0] == 0 {
        return Ok(()); // a study without sites ends with the stripes
    }
    if let Some(surface) = &spectra.maf_per_year {
        let path = format!("/risk/{key}/maf_per_year");
        let long_name = "mean annual frequency of exceeding the threshold";
        writer.array_f64(&path, &["site", "strength", "threshold"], surface, "1/yr", long_name)?;
    }
    let dims = ["site", "poe", "strength"];
    let of = |value: fn(&Ordinate) -> f64| -> Vec<f64> { spectra.ordinates.iter().map(value).collect() };
    let path = |name: &str| format!("/urs/{key}/{name}");
    writer.array_f64(&path("u_m"), &dims, &of(|o| o.displacement_m), "m", "uniform risk displacement")?;
    let flags: Vec<u8> = spectra.ordinates.iter().map(|ordinate| flag_number(ordinate.flag)).collect();
    let long_name = "0 regular, 1 no exceedance so that the ordinate is 0, 2 censored";
    writer.array_u8(&path("flag"), &dims, &flags, "1", long_name)?;
    let long_name = "share of the risk from below the first stripe";
    writer.array_f64(&path("lower_tail_share"), &dims, &of(|o| o.lower_tail_share), "1", long_name)?;
    let long_name = "share of the risk from above the last stripe";
    writer.array_f64(&path("upper_tail_share"), &dims, &of(|o| o.upper_tail_share), "1", long_name)?;

    write_branches(writer, outcome, spectra)?;

    let fits = &outcome.coefficients[index].fits;
    let dims = ["site", "poe"];
    let path = |name: &str| format!("/regression/{key}/{name}");

    let columns: [(&str, Value, &str, &str); 6] = [
        ("c0_m", |fit| fit.c0, "m", "c0 of u = c0 exp(c1 strength) + c2"),
        ("c1", |fit| fit.c1, "1", "c1"),
        ("c2_m", |fit| fit.c2, "m", "c2, not negative"),
        ("rmse_m", |fit| fit.rmse, "m", "root mean square error with n - 3 degrees of freedom"),
        ("rmse_plain_m", |fit| fit.rmse_plain, "m", "root mean square error over n points"),
        ("max_abs_residual_m", |fit| fit.max_abs_residual, "m", "largest residual"),
    ];
    for (name, value, unit, long_name) in columns {
        let values: Vec<f64> = fits.iter().map(|fit| fit.as_ref().map_or(f64::NAN, value)).collect();
        writer.array_f64(&path(name), &dims, &values, unit, long_name)?;
    }
    let bound: Vec<u8> = fits.iter().map(|fit| u8::from(fit.as_ref().is_ok_and(|fit| fit.bound_active))).collect();
    writer.array_u8(&path("bound_active"), &dims, &bound, "1", "1 where c2 is held at 0")?;
    let points: Vec<u32> =
        fits.iter().map(|fit| fit.as_ref().map_or(0, |fit| u32::try_from(fit.points).unwrap_or(u32::MAX))).collect();
    writer.array_u32(&path("points"), &dims, &points, "1", "strengths fitted, 0 where there is no fit")
}

/// A column of the coefficients.
type Value = fn(&uplift_regression::ExponentialFit) -> f64;

/// How a flag stands in the file.
fn flag_number(flag: OrdinateFlag) -> u8 {
    match flag {
        OrdinateFlag::Regular => 0,
        OrdinateFlag::NoExceedance => 1,
        OrdinateFlag::Censored => 2,
    }
}
