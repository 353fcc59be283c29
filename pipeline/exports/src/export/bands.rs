//! The bands of a result, as every format takes them.

use uplift_result::{BandKind, StoredBands, before_unit};

use super::Export;
use super::source::Row;

/// All kinds of bands, those of a kind of spectrum side by side.
pub(super) const BY_SPECTRUM: [BandKind; 4] =
    [BandKind::PLAIN, BandKind::JOINT, BandKind::REPAIRED, BandKind::REPAIRED_JOINT];

/// The name of an array of a measure's bands in a MATLAB file: `u05_joint_pgv_m`.
pub(super) fn name_with(kind: BandKind, name: &str, key: &str) -> String {
    let joint = if kind.is_joint { "_joint" } else { "" };
    let repaired = if kind.is_repaired { "_consistent" } else { "" };
    before_unit(name, &format!("{joint}{repaired}_{key}"))
}

/// The band of a spectrum for one size of the sample.
pub(super) struct BandOf<'a> {
    pub(super) records: u32,
    /// Lower limit, median and upper limit over the strengths, m.
    pub(super) limits_m: [&'a [f64]; 3],
    /// Limits of the spectra of all records there could be, and of another set, as
    /// [`INFERRED_BANDS`](uplift_result::INFERRED_BANDS) names them, m; joint bands and older results
    /// have none.
    pub(super) inferred_m: Option<[&'a [f64]; 4]>,
    /// The figures that [`BANDS`](uplift_result::BANDS) exports; NaN where there is none.
    pub(super) figures: [f64; 2],
    /// Share of the samples whose weights miss the site's hazard; of repaired spectra alone.
    pub(super) failed_share: Option<f64>,
}

impl Export {
    /// The bands of a kind of a spectrum, by size of the sample; none where it has none: at a site without repair or
    /// without weighted hazard curves.
    pub(super) fn bands_of(&self, row: &Row<'_>, kind: BandKind) -> Vec<BandOf<'_>> {
        let of_measure = self.bands.as_ref().and_then(|bands| Some((bands, bands.by_measure(row.spectrum.measure)?)));
        let Some((StoredBands { sizes, .. }, of_measure)) = of_measure else { return Vec::new() };
        let Some(of) = kind.select(of_measure) else { return Vec::new() };
        let [site, poe] = row.at;
        let of_size = |(size, &records): (usize, &u32)| BandOf {
            records,
            limits_m: of.limits_m.each_ref().map(|limits| limits.block([site, poe, size])),
            inferred_m: of.inferred.map(|of| of.limits_m().map(|limits| limits.block([site, poe, size]))),
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
    pub(super) fn all_bands_of(&self, row: &Row<'_>) -> impl Iterator<Item = (BandKind, BandOf<'_>)> {
        BY_SPECTRUM.into_iter().flat_map(|kind| self.bands_of(row, kind).into_iter().map(move |band| (kind, band)))
    }

    /// Whether there are bands of a kind.
    pub(super) fn has_bands(&self, kind: BandKind) -> bool {
        self.bands.iter().flat_map(|bands| &bands.measures).any(|of| kind.select(of).is_some())
    }

    /// Whether there are bands beyond the set.
    pub(super) fn has_inferred_bands(&self, kind: BandKind) -> bool {
        self.bands
            .iter()
            .flat_map(|bands| &bands.measures)
            .filter_map(|of| kind.select(of))
            .any(|of| of.inferred.is_some())
    }
}
