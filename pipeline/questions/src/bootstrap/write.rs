//! Confidence bands in the result file and in tables beside it.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_bootstrap::{ResamplingPlan, Unit};
use uplift_job::outputs::{Output, OutputKind, beside};
use uplift_job::table::{ColumnsOf, write_table};
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::declared::Names;
use uplift_result::layout::attribute::bootstrap as attribute;
use uplift_result::layout::{axis, limit_names};
use uplift_result::{
    BANDS, BandKind, BandsOfKind, DRAWS, FAILED_PAIRS, FAILED_SAMPLES, INFERRED_BANDS, InferredBands, JOINT_BANDS,
    LockedResult, MeasureBands, REPAIRED_BANDS, SIMULTANEOUS_BANDS, SiteJointBands, StoredDraws, StoredSpectraBands,
    band_lengths, band_names, sign,
};
use uplift_uniform_risk::{BandOf, QuotedUnits, StoredStripes};

use super::bands::BandSettings;
use crate::error::QuestionsError;

/// Groups and axes of the file that bands replace.
fn replaced() -> [String; 3] {
    [BANDS.root().to_owned(), axis::path(axis::SAMPLE_SIZE.name), axis::path(axis::REPLICATE.name)]
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
    pub(super) bands: &'a [MeasureBands],
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
    axis::SAMPLE_SIZE.write(writer, &[], plan.sizes())?;
    let numbers: Vec<u32> = (0..).take(plan.replicates()).collect();
    axis::REPLICATE.write(writer, &[], &numbers)?;
    sign(writer, BANDS.root())?;
    attribute::PLAN.write(writer, &[], file.plan_source)?;
    attribute::UNIT.write(writer, &[], plan.unit().key())?;
    attribute::CONFIDENCE.write(writer, &[], settings.confidence)?;
    attribute::INTERVAL.write(writer, &[], settings.interval.key())?;
    attribute::STRENGTH_ABOVE.write(writer, &[], settings.strength_above)?;
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
        add_spectra_bands(writer, &names(""), (&bands.plain, bands.inferred.as_ref()), &stored.sites)?;
        let of = if plan.unit() == Unit::Event { BandOf::Earthquakes } else { quoted.of };
        writer.attribute(&BANDS.group(&names("")), "band_of", <&str>::from(of))?;
        if let Some(repaired) = &bands.repaired {
            let names = names(REPAIRED_BANDS);
            add_spectra_bands(writer, &names, (&repaired.bands, repaired.inferred.as_ref()), &stored.sites)?;
            FAILED_SAMPLES.write_array(writer, &names, repaired.failed.values())?;
        }
    }
    Ok(())
}

/// Adds the bands of the spectra of all sites, with a group for each site that has weighted hazard curves.
fn add_spectra_bands(
    writer: &mut LabelledWriter,
    names: Names<'_>,
    (bands, inferred): (&StoredSpectraBands, Option<&InferredBands>),
    sites: &[String],
) -> Result<(), LabelledError> {
    let lengths = band_lengths(bands.limits_m[0].shape());
    BANDS.write(writer, names, &lengths, bands)?;
    if let Some(limits_m) = &bands.simultaneous_m {
        SIMULTANEOUS_BANDS.write(writer, names, &lengths, limits_m)?;
    }
    for (joint, &site) in bands.joint.iter().flat_map(|joint| joint.sites.iter().map(move |site| (joint, site))) {
        let (names, own) = ([names, &[("<site>", &sites[site])]].concat(), SiteJointBands::new(joint, site));
        JOINT_BANDS.write(writer, &names, &lengths, &own)?;
        if joint.failed.is_some() {
            FAILED_PAIRS.write(writer, &names, &lengths, &own)?;
        }
    }
    inferred.map_or(Ok(()), |inferred| INFERRED_BANDS.write(writer, names, &lengths, inferred))
}

/// The kinds of bands that there are, each with those of every measure; none of a measure of whose sites none has any.
fn kinds<'a>(file: &BandsFile<'a>) -> impl Iterator<Item = (BandKind, Vec<Option<BandsOfKind<'a>>>)> {
    let bands = file.bands;
    let of_kind = move |kind: BandKind| (kind, bands.iter().map(|bands| kind.select(bands)).collect::<Vec<_>>());
    BandKind::ALL.into_iter().map(of_kind).filter(|(_, of)| of.iter().any(Option::is_some))
}

fn known(value: f64) -> Option<f64> {
    Some(value).filter(|value| !value.is_nan())
}

fn bands_table(file: &BandsFile<'_>) -> Vec<Column> {
    let (stored, sizes) = (file.stored, file.plan.sizes());
    let rows = file.bands.iter().flat_map(|of| of.plain.limits_m[0].blocks::<4>().map(move |(at, _)| (of.measure, at)));
    let mut columns = ColumnsOf::new(rows)
        .with("site", |(_, [site, ..])| stored.sites[site].as_str())
        .with("im", |(measure, _)| measure.label())
        .with("poe", |(_, [_, poe, ..])| stored.poes[poe])
        .with("years", |_| stored.years)
        .with("sample_size", |(_, [_, _, size, _])| sizes[size])
        .with("strength", |(_, [.., strength])| stored.strengths[strength])
        .build();
    let names = limit_names(file.settings.confidence);
    for (kind, of) in kinds(file) {
        let Some(first) = of.iter().flatten().next() else { continue };
        for (name, limits) in first.limits(&names) {
            // a site without weighted hazard curves has empty cells
            let cell = |u_m: &f64| if kind.is_joint { known(*u_m) } else { Some(*u_m) };
            let of_measure = |of: &Option<BandsOfKind<'_>>| match of
                .and_then(|of| of.limits(&names).find(|(own, _)| *own == name))
            {
                Some((_, limits)) => limits.values().iter().map(cell).collect(),
                None => vec![None; limits.values().len()],
            };
            let values: Vec<Option<f64>> = of.iter().flat_map(of_measure).collect();
            columns.push(Column::new(kind.column(name).into(), values));
        }
    }
    columns
}

fn figures_table(file: &BandsFile<'_>) -> Vec<Column> {
    let (stored, sizes) = (file.stored, file.plan.sizes());
    let places = (0..file.bands.len()).zip(file.bands);
    let rows = places.flat_map(|(place, of)| of.plain.error_of_median.blocks::<3>().map(move |(at, _)| (place, at)));
    let mut columns = ColumnsOf::new(rows)
        .with("site", |(_, [site, ..])| stored.sites[site].as_str())
        .with("im", |(place, _)| file.bands[place].measure.label())
        .with("poe", |(_, [_, poe, _])| stored.poes[poe])
        .with("years", |_| stored.years)
        .with("sample_size", |(_, [.., size])| sizes[size]);
    for (kind, of) in kinds(file) {
        for (figure, quantity) in BANDS.exported().enumerate() {
            if of.iter().flatten().any(|of| of.figures[figure].is_some()) {
                columns = columns
                    .with(kind.column(quantity.exported_name()), |(place, at)| known(of[place]?.figures[figure]?[at]));
            }
        }
        if of.iter().flatten().any(|of| of.failed.is_some()) {
            let failed =
                |(place, [site, _, size]): (usize, [usize; 3])| known(100.0 * of[place]?.failed?[[site, size]]);
            columns = columns.with(kind.column("failed_pct"), failed);
        }
    }
    columns.build()
}
