//! The bands of a result, as every format takes them.

use uplift_job::Array;
use uplift_result::{MeasureBands, StoredBands};

use super::Export;
use super::source::Row;

/// Which spectra bands are of, and what each format calls them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Kind {
    /// What the weights of the records are, and whether weighted hazard curves are drawn too.
    pub(super) weights: &'static str,
    /// What follows the names of the table and of JSON: `u05_joint_n20_m`, `bands_joint`.
    pub(super) suffix: &'static str,
    is_repaired: bool,
    is_joint: bool,
}

/// Of spectra of records that count alike.
pub(super) const PLAIN: Kind = Kind { weights: "alike", suffix: "", is_repaired: false, is_joint: false };
/// Of these over records and weighted hazard curves together.
pub(super) const JOINT: Kind =
    Kind { weights: "alike, with hazard curves", suffix: "_joint", is_repaired: false, is_joint: true };
/// Of repaired spectra.
pub(super) const REPAIRED: Kind =
    Kind { weights: "repaired", suffix: "_consistent", is_repaired: true, is_joint: false };
/// Of these over records and weighted hazard curves together.
pub(super) const REPAIRED_JOINT: Kind =
    Kind { weights: "repaired, with hazard curves", suffix: "_consistent_joint", is_repaired: true, is_joint: true };
/// The bands that some spectra have and others have not.
pub(super) const FURTHER: [Kind; 3] = [REPAIRED, JOINT, REPAIRED_JOINT];
/// All bands, those of a kind of spectrum side by side.
pub(super) const ALL: [Kind; 4] = [PLAIN, JOINT, REPAIRED, REPAIRED_JOINT];

/// Figures of Table 4.1, %: the name of each, and its heading of the workbook.
pub(super) const FIGURES: [(&str, &str); 2] =
    [("e_median_pct", "error of the median, %"), ("r_90ci_pct", "range of the interval, %")];

/// The bands of a kind, of all spectra of a measure.
pub(super) struct MeasureBandsOf<'a> {
    /// Lower limits, medians and upper limits `[site, poe, size, strength]`, m.
    pub(super) limits_m: &'a [Array<4>; 3],
    /// The [`FIGURES`] `[site, poe, size]`; joint bands have no error of the median.
    pub(super) figures: [Option<&'a Array<3>>; 2],
    /// Share of the samples whose weights miss the site's hazard `[site, size]`; of repaired spectra alone.
    pub(super) failed: Option<&'a Array<2>>,
}

impl Kind {
    /// The name of one of its arrays of a measure in a MATLAB file: `u05_joint_pgv_m`.
    pub(super) fn name_with(self, name: &str, key: &str) -> String {
        let (stem, unit) = name.rsplit_once('_').filter(|(_, unit)| ["m", "pct"].contains(unit)).unwrap_or((name, ""));
        let joint = if self.is_joint { "_joint" } else { "" };
        let repaired = if self.is_repaired { "_consistent" } else { "" };
        let unit = if unit.is_empty() { String::new() } else { format!("_{unit}") };
        format!("{stem}{joint}{repaired}_{key}{unit}")
    }

    /// The bands of this kind of a measure.
    pub(super) fn of(self, bands: &MeasureBands) -> Option<MeasureBandsOf<'_>> {
        let (own, failed) = match &bands.repaired {
            _ if !self.is_repaired => (&bands.plain, None),
            repaired => repaired.as_ref().map(|own| (&own.bands, Some(&own.failed)))?,
        };
        Some(if self.is_joint {
            let own = own.joint.as_ref()?;
            let figures = [None, Some(&own.range_of_interval)];
            MeasureBandsOf { limits_m: &own.limits_m, figures, failed: own.failed.as_ref() }
        } else {
            let figures = [Some(&own.error_of_median), Some(&own.range_of_interval)];
            MeasureBandsOf { limits_m: &own.limits_m, figures, failed }
        })
    }
}

/// The band of a spectrum for one size of the sample.
pub(super) struct BandOf<'a> {
    pub(super) records: u32,
    /// Lower limit, median and upper limit over the strengths, m.
    pub(super) limits_m: [&'a [f64]; 3],
    /// Limits of the spectra of all records there could be, and of another set, as
    /// [`INFERRED_BANDS`](uplift_result::INFERRED_BANDS) names them, m; of plain spectra alone, none in older results.
    pub(super) inferred_m: Option<[&'a [f64]; 4]>,
    /// The [`FIGURES`]; NaN where there is none.
    pub(super) figures: [f64; 2],
    /// Share of the samples whose weights miss the site's hazard; of repaired spectra alone.
    pub(super) failed_share: Option<f64>,
}

impl Export {
    /// The bands of a kind of a spectrum, by size of the sample; none where it has none: at a site without repair or
    /// without weighted hazard curves.
    pub(super) fn bands_of(&self, row: &Row<'_>, kind: Kind) -> Vec<BandOf<'_>> {
        let of_measure = self.bands.as_ref().and_then(|bands| Some((bands, bands.of(row.spectrum.measure)?)));
        let Some((StoredBands { sizes, .. }, of_measure)) = of_measure else { return Vec::new() };
        let Some(of) = kind.of(of_measure) else { return Vec::new() };
        let inferred = of_measure.inferred.as_ref().filter(|_| kind == PLAIN);
        let [site, poe] = row.at;
        let of_size = |(size, &records): (usize, &u32)| BandOf {
            records,
            limits_m: of.limits_m.each_ref().map(|limits| limits.block([site, poe, size])),
            inferred_m: inferred.map(|of| of.limits_m().map(|limits| limits.block([site, poe, size]))),
            figures: of.figures.map(|figure| figure.map_or(f64::NAN, |figure| figure[[site, poe, size]])),
            failed_share: of.failed.map(|failed| failed[[site, size]]),
        };
        let is_whole = !kind.is_repaired || kind.is_joint || {
            of.failed.iter().all(|failed| failed.block([site]).iter().all(|share| !share.is_nan()))
        };
        let bands = sizes.iter().enumerate().filter(|_| is_whole).map(of_size);
        bands.filter(|band| !kind.is_joint || !band.limits_m[1].iter().all(|u_m| u_m.is_nan())).collect()
    }

    /// The bands of every kind.
    pub(super) fn all_bands_of(&self, row: &Row<'_>) -> impl Iterator<Item = (Kind, BandOf<'_>)> {
        ALL.into_iter().flat_map(|kind| self.bands_of(row, kind).into_iter().map(move |band| (kind, band)))
    }

    /// Whether there are bands of a kind.
    pub(super) fn has_bands(&self, kind: Kind) -> bool {
        self.bands.iter().flat_map(|bands| &bands.measures).any(|of| kind.of(of).is_some())
    }

    /// Whether there are bands beyond the set.
    pub(super) fn has_inferred_bands(&self) -> bool {
        self.bands.iter().flat_map(|bands| &bands.measures).any(|of| of.inferred.is_some())
    }
}
