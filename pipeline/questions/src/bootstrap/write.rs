//! Confidence bands in the result file and in tables beside it.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_bootstrap::{ResamplingPlan, Unit};
use uplift_job::outputs::{Output, OutputKind, beside};
use uplift_job::table::{ColumnsOf, write_table};
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::declared::{Names, Quantity};
use uplift_result::layout::{axis, limit_names};
use uplift_result::{
    BANDS, DRAWS, FAILED_PAIRS, FAILED_SAMPLES, INFERRED_BANDS, InferredBands, JOINT_BANDS, LockedResult,
    REPAIRED_BANDS, SIMULTANEOUS_BANDS, SiteJointBands, StoredDraws, band_lengths, band_names, sign,
};
use uplift_uniform_risk::{BandOf, QuotedUnits, StoredStripes};

use super::bands::{BandSettings, Bands, RepairedBands, SpectraBands};
use crate::error::QuestionsError;

/// Groups and axes of the file that bands replace.
fn replaced() -> [String; 3] {
    [BANDS.root().to_owned(), axis::path(axis::SAMPLE_SIZE), axis::path(axis::REPLICATE)]
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
    /// Whose scatter those of the truth are of, where records are not drawn by earthquake, a measure each.
    pub(super) quoted: &'a [QuotedUnits],
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
pub(super) fn write_bands(locked: &LockedResult, file: &BandsFile<'_>) -> Result<(), QuestionsError> {
    let BandsFile { stored, plan, settings, .. } = file;
    locked.write(&replaced(), |writer| add_bands(writer, file))?;
    let what = format!(
        "bootstrap: {}, {} replicates, {} interval, confidence {}",
        file.plan_source,
        plan.replicates(),
        settings.interval.key(),
        settings.confidence
    );
    let line = stored.line(&what);
    let [bands, figures] = band_paths(&stored.path);
    write_table(&bands, &line, bands_table(file))?;
    Ok(write_table(&figures, &line, figures_table(file))?)
}

fn add_bands(writer: &mut LabelledWriter, file: &BandsFile<'_>) -> Result<(), LabelledError> {
    let BandsFile { stored, plan, settings, .. } = file;
    writer.axis_u32(axis::SAMPLE_SIZE, plan.sizes(), "1", "records drawn in a replicate")?;
    let numbers: Vec<u32> = (0..).take(plan.replicates()).collect();
    writer.axis_u32(axis::REPLICATE, &numbers, "1", "number of the replicate")?;
    let root = BANDS.root();
    sign(writer, root)?;
    writer.attribute(root, "plan", file.plan_source)?;
    writer.attribute(root, "unit", plan.unit().key())?;
    writer.attribute(root, "confidence", settings.confidence)?;
    writer.attribute(root, "interval", settings.interval.key())?;
    writer.attribute(root, "strength_above", settings.strength_above)?;
    let draws = StoredDraws {
        records: stored.records.len(),
        sizes: plan.sizes().to_vec(),
        replicates: plan.replicates(),
        multiplicities: plan.multiplicities(),
        unit: plan.unit(),
    };
    DRAWS.write(writer, &[], &draws.lengths(), &draws)?;
    let limits = limit_names(settings.confidence);
    for (bands, quoted) in file.bands.iter().zip(file.quoted) {
        let names = |of_repaired| band_names(bands.measure, &limits, of_repaired);
        add_spectra_bands(writer, &names(""), &bands.plain, &stored.sites)?;
        let lengths = band_lengths(bands.plain.lower_m.shape());
        INFERRED_BANDS.write(writer, &names(""), &lengths, &bands.inferred)?;
        let of = if plan.unit() == Unit::Event { BandOf::Earthquakes } else { quoted.of };
        writer.attribute(&BANDS.group(&names("")), "band_of", <&str>::from(of))?;
        if let Some(repaired) = &bands.repaired {
            let names = names(REPAIRED_BANDS);
            add_spectra_bands(writer, &names, &repaired.bands, &stored.sites)?;
            INFERRED_BANDS.write(writer, &names, &lengths, &repaired.inferred)?;
            FAILED_SAMPLES.write_array(writer, &names, repaired.failed.values())?;
        }
    }
    Ok(())
}

/// Adds the bands of the spectra of all sites, with a group for each site that has weighted hazard curves.
fn add_spectra_bands(
    writer: &mut LabelledWriter,
    names: Names<'_>,
    bands: &SpectraBands,
    sites: &[String],
) -> Result<(), LabelledError> {
    let (stored, lengths) = (bands.stored(), band_lengths(bands.lower_m.shape()));
    BANDS.write(writer, names, &lengths, &stored)?;
    if let Some(limits_m) = &bands.simultaneous_m {
        SIMULTANEOUS_BANDS.write(writer, names, &lengths, limits_m)?;
    }
    let Some((joint, places)) = stored.joint.as_ref().zip(bands.joint.as_ref().map(|joint| &joint.sites)) else {
        return Ok(());
    };
    for &site in places {
        let (names, own) = ([names, &[("<site>", &sites[site])]].concat(), SiteJointBands::new(joint, site));
        JOINT_BANDS.write(writer, &names, &lengths, &own)?;
        if joint.failed.is_some() {
            FAILED_PAIRS.write(writer, &names, &lengths, &own)?;
        }
    }
    Ok(())
}

fn bands_table(file: &BandsFile<'_>) -> Vec<Column> {
    let (stored, sizes) = (file.stored, file.plan.sizes());
    let rows = file.bands.iter().flat_map(|of| of.plain.lower_m.blocks::<4>().map(move |(at, _)| (of.measure, at)));
    let mut columns = ColumnsOf::new(rows)
        .with("site", |(_, [site, ..])| stored.sites[site].as_str())
        .with("im", |(measure, _)| measure.label())
        .with("poe", |(_, [_, poe, ..])| stored.poes[poe])
        .with("years", |_| stored.years)
        .with("sample_size", |(_, [_, _, size, _])| sizes[size])
        .with("strength", |(_, [.., strength])| stored.strengths[strength])
        .build();
    let plain: Vec<&SpectraBands> = file.bands.iter().map(|bands| &bands.plain).collect();
    columns.extend(limit_columns("", &plain, file.settings.confidence));
    let inferred: Vec<&InferredBands> = file.bands.iter().map(|bands| &bands.inferred).collect();
    columns.extend(inferred_columns("", &inferred));
    let repaired: Vec<&SpectraBands> =
        file.bands.iter().filter_map(|bands| bands.repaired.as_ref().map(|repaired| &repaired.bands)).collect();
    columns.extend(limit_columns("_consistent", &repaired, file.settings.confidence));
    let inferred: Vec<&InferredBands> =
        file.bands.iter().filter_map(|bands| Some(&bands.repaired.as_ref()?.inferred)).collect();
    columns.extend(inferred_columns("_consistent", &inferred));
    columns.extend(joint_columns("_joint", &plain, file.settings.confidence));
    columns.extend(joint_columns("_consistent_joint", &repaired, file.settings.confidence));
    columns
}

/// The joint limits of all measures, their names with `suffix` before the unit; none where no site has any.
fn joint_columns(suffix: &str, bands: &[&SpectraBands], confidence: f64) -> Vec<Column> {
    if bands.iter().all(|of| of.joint.is_none()) {
        return Vec::new();
    }
    let column = |(limit, name): (usize, String)| {
        // a measure of whose sites none has any has as many rows
        let of_measure = |of: &&SpectraBands| match &of.joint {
            Some(joint) => {
                joint.limits_m[limit].values().iter().map(|&u_m| Some(u_m).filter(|u_m| !u_m.is_nan())).collect()
            }
            None => vec![None; of.median_m.values().len()],
        };
        let values: Vec<Option<f64>> = bands.iter().flat_map(of_measure).collect();
        Column::new(format!("{}{suffix}_m", name.trim_end_matches("_m")).into(), values)
    };
    limit_names(confidence).into_iter().enumerate().map(column).collect()
}

/// The limits beyond the set of all measures, their names with `suffix` before the unit; none of no bands.
fn inferred_columns(suffix: &str, bands: &[&InferredBands]) -> Vec<Column> {
    let column = |quantity: &Quantity<InferredBands>| {
        let of_measure = |of: &&InferredBands| {
            let places = 0..of.truth_m[0].values().len();
            places.filter_map(|at| quantity.number(of, at)).collect::<Vec<f64>>()
        };
        let name = format!("{}{suffix}_m", quantity.name.trim_end_matches("_m"));
        Column::new(name.into(), bands.iter().flat_map(of_measure).collect::<Vec<f64>>())
    };
    if bands.is_empty() { Vec::new() } else { INFERRED_BANDS.quantities.iter().map(column).collect() }
}

/// The limits of all measures, their names with `suffix` before the unit; none of no bands.
fn limit_columns(suffix: &str, bands: &[&SpectraBands], confidence: f64) -> Vec<Column> {
    let of_measures = bands.iter().map(|bands| {
        let mut columns = vec![&bands.lower_m, &bands.median_m, &bands.upper_m];
        columns.extend(bands.simultaneous_m.iter().flatten());
        columns
    });
    let mut limits: Vec<Vec<f64>> = Vec::new();
    for columns in of_measures {
        limits.resize_with(columns.len(), Vec::new);
        for (all, of_measure) in limits.iter_mut().zip(columns) {
            all.extend_from_slice(of_measure.values());
        }
    }
    let names = limit_names(confidence);
    let names = names.iter().map(String::as_str).chain(SIMULTANEOUS_BANDS.quantities.iter().map(|own| own.name));
    names
        .zip(limits)
        .map(|(name, values)| Column::new(format!("{}{suffix}_m", name.trim_end_matches("_m")).into(), values))
        .collect()
}

fn per_cent(share: Option<f64>) -> Option<f64> {
    share.map(|share| 100.0 * share)
}

fn figures_table(file: &BandsFile<'_>) -> Vec<Column> {
    let (stored, sizes) = (file.stored, file.plan.sizes());
    let rows = file.bands.iter().flat_map(|of| of.plain.error_of_median.blocks::<3>().map(move |(at, _)| (of, at)));
    let mut columns = ColumnsOf::new(rows)
        .with("site", |(_, [site, ..])| stored.sites[site].as_str())
        .with("im", |(of, _)| of.measure.label())
        .with("poe", |(_, [_, poe, _])| stored.poes[poe])
        .with("years", |_| stored.years)
        .with("sample_size", |(_, [.., size])| sizes[size])
        .with("e_median_pct", |(of, at)| per_cent(of.plain.error_of_median[at]))
        .with("r_90ci_pct", |(of, at)| per_cent(of.plain.range_of_interval[at]));
    if file.bands.iter().any(|of| of.repaired.is_some()) {
        let failed = |own: &RepairedBands, [site, _, size]: [usize; 3]| own.failed[[site, size]];
        columns = columns
            .with("e_median_consistent_pct", |(of, at)| per_cent(of.repaired.as_ref()?.bands.error_of_median[at]))
            .with("r_90ci_consistent_pct", |(of, at)| per_cent(of.repaired.as_ref()?.bands.range_of_interval[at]))
            .with("failed_consistent_pct", |(of, at)| {
                per_cent(Some(failed(of.repaired.as_ref()?, at)).filter(|share| !share.is_nan()))
            });
    }
    let mut columns = columns.build();
    columns.extend(joint_figure_columns(file.bands));
    columns
}

/// The figures of the joint bands; none where no site has weighted hazard curves.
fn joint_figure_columns(bands: &[Bands]) -> Vec<Column> {
    let figures: [JointFigure; 3] = [
        ("r_90ci_joint_pct", |bands, at| bands.plain.joint.as_ref()?.range_of_interval[at]),
        ("r_90ci_consistent_joint_pct", |bands, at| {
            bands.repaired.as_ref()?.bands.joint.as_ref()?.range_of_interval[at]
        }),
        ("failed_consistent_joint_pct", |bands, [site, _, size]| {
            let joint = bands.repaired.as_ref()?.bands.joint.as_ref()?;
            Some(joint.failed.as_ref()?[[site, size]]).filter(|share| !share.is_nan())
        }),
    ];
    let has_some = bands.iter().any(|of| of.plain.joint.is_some());
    let is_repaired = bands.iter().any(|of| of.repaired.as_ref().is_some_and(|own| own.bands.joint.is_some()));
    let column = |(name, figure): JointFigure| {
        let of_measure = |of: &'_ Bands| -> Vec<Option<f64>> {
            let places = of.plain.error_of_median.blocks::<3>().map(|(at, _)| at);
            places.map(|at| Some(100.0 * figure(of, at)?)).collect()
        };
        Column::new(name.into(), bands.iter().flat_map(of_measure).collect::<Vec<_>>())
    };
    let there = usize::from(has_some) + 2 * usize::from(is_repaired);
    figures.into_iter().take(there).map(column).collect()
}

/// A column, and its figure at `[site, poe, size]`.
type JointFigure = (&'static str, fn(&Bands, [usize; 3]) -> Option<f64>);
