//! Confidence bands in the result file and in tables beside it.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_bootstrap::ResamplingPlan;

use super::bands::{BandSettings, Bands};
use crate::array::Array;
use crate::error::UpliftError;
use crate::outputs::{Output, OutputKind, beside};
use crate::result::layout::{MULTIPLICITY, axis, band, bootstrap, joint_band, limit_names};
use crate::result::{Addition, StoredStripes, line, sign, write_table};
use uplift_labelled::{LabelledError, LabelledWriter};

/// Groups and axes of the file that bands replace.
fn replaced() -> [String; 3] {
    [bootstrap::ROOT.to_owned(), axis::path(axis::SAMPLE_SIZE), axis::path(axis::REPLICATE)]
}

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
    ["bands.csv", "table-4-1.csv"].map(|ending| beside(result, ending))
}

/// The same, as they are to be written.
pub(super) fn tables(result: &Path) -> [Output; 2] {
    let [bands, figures] = band_paths(result);
    [Output::new(bands, OutputKind::Table("sample_size")), Output::new(figures, OutputKind::Table("e_median_pct"))]
}

/// Write the bands into the result file, in place of earlier ones, and into tables beside it.
///
/// # Errors
/// Whatever keeps the files from being written; the result file is then as it was.
pub(super) fn write_bands(addition: &Addition, file: &BandsFile<'_>) -> Result<(), UpliftError> {
    let BandsFile { stored, plan, settings, .. } = file;
    addition.write(stored, &replaced(), |writer| add_bands(writer, file))?;
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
    writer.axis_u32(axis::SAMPLE_SIZE, plan.sizes(), "1", "records drawn in a replicate")?;
    let numbers: Vec<u32> = (0..).take(plan.replicates()).collect();
    writer.axis_u32(axis::REPLICATE, &numbers, "1", "number of the replicate")?;
    let root = bootstrap::ROOT;
    sign(writer, root)?;
    writer.attribute(root, "plan", file.plan_source)?;
    writer.attribute(root, "confidence", settings.confidence)?;
    writer.attribute(root, "interval", settings.interval.key())?;
    writer.attribute(root, "strength_above", settings.strength_above)?;
    let long_name = "how often each record was drawn";
    let dims = [axis::SAMPLE_SIZE, axis::REPLICATE, axis::RECORD];
    writer.array_u32(MULTIPLICITY, &dims, &plan.multiplicities(), "1", long_name)?;
    let [lower, median, upper] = limit_names(settings.confidence);
    for bands in file.bands {
        let measure = bands.measure;
        let dims = [axis::SITE, axis::POE, axis::SAMPLE_SIZE, axis::STRENGTH];
        for (name, values, what) in [
            (&lower, &bands.lower_m, "lower limit"),
            (&median, &bands.median_m, "median of the replicates"),
            (&upper, &bands.upper_m, "upper limit"),
        ] {
            writer.array_f64(&band(measure, name), &dims, values.values(), "m", what)?;
        }
        if let Some([lower, upper]) = &bands.simultaneous_m {
            let paths = [bootstrap::simultaneous_lower_m(measure), bootstrap::simultaneous_upper_m(measure)];
            for (path, values) in paths.iter().zip([lower, upper]) {
                let long_name = "limit of the band that holds whole spectra";
                writer.array_f64(path, &dims, values.values(), "m", long_name)?;
            }
        }
        for joint in &bands.joint {
            let path = |name: &str| joint_band(measure, &stored.sites[joint.site], name);
            for (name, values) in [(&lower, &joint.lower_m), (&median, &joint.median_m), (&upper, &joint.upper_m)] {
                let dims = [axis::POE, axis::SAMPLE_SIZE, axis::STRENGTH];
                let long_name = "limit over resampled records and weighted hazard curves together";
                writer.array_f64(&path(name), &dims, values.values(), "m", long_name)?;
            }
            let dims = [axis::POE, axis::SAMPLE_SIZE];
            let ranges = percent(&joint.range_of_interval);
            writer.array_f64(&path("r_90ci"), &dims, ranges.values(), "%", "range of the joint interval (Eq. 4.10)")?;
        }
        let dims = [axis::SITE, axis::POE, axis::SAMPLE_SIZE];
        let errors = percent(&bands.error_of_median);
        writer.array_f64(
            &bootstrap::e_median(measure),
            &dims,
            errors.values(),
            "%",
            "error of the median (Eq. 4.9)",
        )?;
        let ranges = percent(&bands.range_of_interval);
        writer.array_f64(
            &bootstrap::r_90ci(measure),
            &dims,
            ranges.values(),
            "%",
            "range of the interval (Eq. 4.10)",
        )?;
    }
    Ok(())
}

/// Shares in per cent; NaN for none.
pub(super) fn percent<const N: usize>(values: &Array<N, Option<f64>>) -> Array<N> {
    values.map(|value| value.map_or(f64::NAN, |value| 100.0 * value))
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
            all.extend_from_slice(of_measure.values());
        }
        for ([site_index, poe_index, size_index, strength_index], _) in bands.lower_m.blocks() {
            site.push(stored.sites[site_index].as_str());
            im.push(bands.measure.label());
            poe.push(stored.poes[poe_index]);
            size.push(sizes[size_index]);
            strength.push(stored.strengths[strength_index]);
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
        for (at @ [site_index, poe_index, size_index], error) in bands.error_of_median.blocks() {
            site.push(stored.sites[site_index].as_str());
            im.push(bands.measure.label());
            poe.push(stored.poes[poe_index]);
            size.push(sizes[size_index]);
            errors.push(error[0].map(|error| 100.0 * error));
            ranges.push(bands.range_of_interval[at].map(|range| 100.0 * range));
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
