//! Confidence bands in the result file and in tables beside it.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_bootstrap::ResamplingPlan;

use super::bands::{BandSettings, Bands};
use crate::error::UpliftError;
use crate::result::{StoredStripes, extend_result, line, sign, write_table};
use uplift_labelled::{LabelledError, LabelledWriter};

/// Groups and axes of the file that bands replace.
const REPLACED: [&str; 3] = ["/bootstrap", "/axes/sample_size", "/axes/replicate"];

/// All that is written of a bootstrap.
pub(super) struct BandsFile<'a> {
    /// The result it was made from.
    pub(super) stored: &'a StoredStripes,
    /// The draws.
    pub(super) plan: &'a ResamplingPlan,
    /// Where the draws come from, in words.
    pub(super) plan_source: &'a str,
    /// What kind of bands.
    pub(super) settings: &'a BandSettings,
    /// The bands, a measure each.
    pub(super) bands: &'a [Bands],
}

/// The tables beside the result file: bands, and the figures of Table 4.1.
pub(super) fn band_paths(result: &Path) -> [PathBuf; 2] {
    ["bands.csv", "table-4-1.csv"].map(|extension| result.with_extension(extension))
}

/// Write the bands into the result file, in place of earlier ones, and into tables beside it.
///
/// # Errors
/// Whatever keeps the files from being written; the result file is then as it was.
pub(super) fn write_bands(file: &BandsFile<'_>) -> Result<(), UpliftError> {
    let BandsFile { stored, plan, settings, .. } = file;
    extend_result(stored, &REPLACED, |writer| add_bands(writer, file))?;
    let what = format!(
        "bootstrap: {}, {} replicates, {} interval, confidence {}",
        file.plan_source,
        plan.replicates(),
        settings.interval.key(),
        settings.confidence
    );
    let line = line(stored, &what);
    let [bands, figures] = band_paths(&stored.path);
    write_table(&bands, &line, bands_table(file))?;
    write_table(&figures, &line, figures_table(file))
}

fn add_bands(writer: &mut LabelledWriter, file: &BandsFile<'_>) -> Result<(), LabelledError> {
    let BandsFile { stored, plan, settings, .. } = file;
    writer.axis_u32("sample_size", plan.sizes(), "1", "records drawn in a replicate")?;
    let numbers: Vec<u32> = (0..).take(plan.replicates()).collect();
    writer.axis_u32("replicate", &numbers, "1", "number of the replicate")?;
    sign(writer, "/bootstrap")?;
    writer.attribute("/bootstrap", "plan", file.plan_source)?;
    writer.attribute("/bootstrap", "confidence", settings.confidence)?;
    writer.attribute("/bootstrap", "interval", settings.interval.key())?;
    writer.attribute("/bootstrap", "strength_above", settings.strength_above)?;
    let long_name = "how often each record was drawn";
    let dims = ["sample_size", "replicate", "record"];
    writer.array_u32("/bootstrap/multiplicity", &dims, &plan.multiplicities(), "1", long_name)?;
    for bands in file.bands {
        let group = format!("/bootstrap/{}", bands.measure.key());
        let dims = ["site", "poe", "sample_size", "strength"];
        let [lower, median, upper] = limit_names(settings.confidence);
        for (name, values, what) in [
            (lower, &bands.lower_m, "lower limit"),
            (median, &bands.median_m, "median of the replicates"),
            (upper, &bands.upper_m, "upper limit"),
        ] {
            writer.array_f64(&format!("{group}/{name}"), &dims, values, "m", what)?;
        }
        if let Some([lower, upper]) = &bands.simultaneous_m {
            for (name, values) in [("simultaneous_lower_m", lower), ("simultaneous_upper_m", upper)] {
                let long_name = "limit of the band that holds whole spectra";
                writer.array_f64(&format!("{group}/{name}"), &dims, values, "m", long_name)?;
            }
        }
        for joint in &bands.joint {
            let group = format!("{group}/joint/{}", stored.sites[joint.site]);
            let [lower, median, upper] = limit_names(settings.confidence);
            for (name, values) in [(lower, &joint.lower_m), (median, &joint.median_m), (upper, &joint.upper_m)] {
                let long_name = "limit over resampled records and weighted hazard curves together";
                writer.array_f64(
                    &format!("{group}/{name}"),
                    &["poe", "sample_size", "strength"],
                    values,
                    "m",
                    long_name,
                )?;
            }
            let ranges: Vec<f64> =
                joint.range_of_interval.iter().map(|value| value.map_or(f64::NAN, |value| 100.0 * value)).collect();
            let long_name = "range of the joint interval (Eq. 4.10)";
            writer.array_f64(&format!("{group}/r_90ci"), &["poe", "sample_size"], &ranges, "%", long_name)?;
        }
        let dims = ["site", "poe", "sample_size"];
        let percent = |values: &[Option<f64>]| -> Vec<f64> {
            values.iter().map(|value| value.map_or(f64::NAN, |value| 100.0 * value)).collect()
        };
        let errors = percent(&bands.error_of_median);
        writer.array_f64(&format!("{group}/e_median"), &dims, &errors, "%", "error of the median (Eq. 4.9)")?;
        let ranges = percent(&bands.range_of_interval);
        writer.array_f64(&format!("{group}/r_90ci"), &dims, &ranges, "%", "range of the interval (Eq. 4.10)")?;
    }
    Ok(())
}

/// Names of both limits and the median: `u05_m`, `u50_m`, `u95_m` for a confidence of 0.9, `u02_5_m` and `u97_5_m` for
/// 0.95.
fn limit_names(confidence: f64) -> [String; 3] {
    let tail = 0.5 * (1.0 - confidence);
    [tail, 0.5, 1.0 - tail].map(|level| percentile_name(100.0 * level))
}

/// Name of a percentile of displacements: `u05_m`, or `u02_5_m` for 2.5 %.
pub(crate) fn percentile_name(percent: f64) -> String {
    let percent = ((percent * 1e6).round() / 1e6).to_string();
    let (whole, part) = percent.split_once('.').map_or((percent.as_str(), ""), |(whole, part)| (whole, part));
    let part = if part.is_empty() { String::new() } else { format!("_{part}") };
    format!("u{whole:0>2}{part}_m")
}

fn bands_table(file: &BandsFile<'_>) -> Vec<Column> {
    let (stored, sizes) = (file.stored, file.plan.sizes());
    let (mut site, mut im) = (Vec::new(), Vec::new());
    let (mut poe, mut size, mut strength) = (Vec::new(), Vec::new(), Vec::new());
    let mut limits: [Vec<f64>; 5] = Default::default();
    for bands in file.bands {
        let mut columns = vec![&bands.lower_m, &bands.median_m, &bands.upper_m];
        if let Some([lower, upper]) = &bands.simultaneous_m {
            columns.extend([lower, upper]);
        }
        for (all, of_measure) in limits.iter_mut().zip(columns) {
            all.extend_from_slice(of_measure);
        }
        for site_name in &stored.sites {
            for &poe_value in &stored.poes {
                for &sample_size in sizes {
                    for &eta in &stored.strengths {
                        site.push(site_name.as_str());
                        im.push(bands.measure.label());
                        poe.push(poe_value);
                        size.push(sample_size);
                        strength.push(eta);
                    }
                }
            }
        }
    }
    let years = vec![stored.years; site.len()];
    let mut columns = vec![
        Column::new("site".into(), site),
        Column::new("im".into(), im),
        Column::new("poe".into(), poe),
        Column::new("years".into(), years),
        Column::new("sample_size".into(), size),
        Column::new("strength".into(), strength),
    ];
    let [lower, median, upper] = limit_names(file.settings.confidence);
    let names = [lower, median, upper, "simultaneous_lower_m".to_owned(), "simultaneous_upper_m".to_owned()];
    for (name, values) in names.into_iter().zip(limits).filter(|(_, values)| !values.is_empty()) {
        columns.push(Column::new(name.into(), values));
    }
    columns
}

fn figures_table(file: &BandsFile<'_>) -> Vec<Column> {
    let (stored, sizes) = (file.stored, file.plan.sizes());
    let (mut site, mut im, mut poe, mut size) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (mut errors, mut ranges) = (Vec::new(), Vec::new());
    for bands in file.bands {
        for (cell, (error, range)) in bands.error_of_median.iter().zip(&bands.range_of_interval).enumerate() {
            let spectrum = cell / sizes.len();
            site.push(stored.sites[spectrum / stored.poes.len()].as_str());
            im.push(bands.measure.label());
            poe.push(stored.poes[spectrum % stored.poes.len()]);
            size.push(sizes[cell % sizes.len()]);
            errors.push(error.map(|error| 100.0 * error));
            ranges.push(range.map(|range| 100.0 * range));
        }
    }
    let years = vec![stored.years; site.len()];
    vec![
        Column::new("site".into(), site),
        Column::new("im".into(), im),
        Column::new("poe".into(), poe),
        Column::new("years".into(), years),
        Column::new("sample_size".into(), size),
        Column::new("e_median_pct".into(), errors),
        Column::new("r_90ci_pct".into(), ranges),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_named_by_their_level() {
        assert_eq!(limit_names(0.9), ["u05_m", "u50_m", "u95_m"]);
        assert_eq!(limit_names(0.95), ["u02_5_m", "u50_m", "u97_5_m"]);
        assert_eq!(limit_names(0.68), ["u16_m", "u50_m", "u84_m"]);
    }
}
