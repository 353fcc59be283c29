//! Kinds of bands, and what tables and exports call them.

use uplift_job::Array;

use super::bands::{INFERRED_BANDS, InferredBands, MeasureBands, SIMULTANEOUS_BANDS};

/// Which spectra bands are of, and what each format calls it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BandKind {
    /// What the weights of the records are, and whether weighted hazard curves are drawn too.
    pub weights: &'static str,
    /// What follows the names in tables and in JSON: `u05_joint_m`, `bands_joint`.
    pub suffix: &'static str,
    /// Whether the spectra are the repaired ones.
    pub is_repaired: bool,
    /// Whether the bands are over records and weighted hazard curves together.
    pub is_joint: bool,
}

/// The bands of a kind, of all spectra of a measure.
#[derive(Debug, Clone, Copy)]
pub struct BandsOfKind<'a> {
    /// Lower limits, medians and upper limits `[site, poe, size, strength]`, m.
    pub limits_m: &'a [Array<4>; 3],
    /// Limits of the bands of whole spectra, if made.
    pub simultaneous_m: Option<&'a [Array<4>; 2]>,
    /// Those beyond the set; joint bands have none.
    pub inferred: Option<&'a InferredBands>,
    /// The figures of Table 4.1 `[site, poe, size]`; joint bands have no error of the median.
    pub figures: [Option<&'a Array<3>>; 2],
    /// Share of the samples whose weights miss the site's hazard `[site, size]`; of repaired spectra alone.
    pub failed: Option<&'a Array<2>>,
}

/// A name with a suffix before its unit, its last part: `u05_joint_m` of `u05_m`; at the end of a single word.
pub fn before_unit(name: &str, suffix: &str) -> String {
    match name.rsplit_once('_') {
        Some((stem, unit)) => format!("{stem}{suffix}_{unit}"),
        None => format!("{name}{suffix}"),
    }
}

impl BandKind {
    /// Those of spectra of records that count alike.
    pub const PLAIN: Self = Self { weights: "alike", suffix: "", is_repaired: false, is_joint: false };
    /// Those of repaired spectra.
    pub const REPAIRED: Self = Self { weights: "repaired", suffix: "_consistent", is_repaired: true, is_joint: false };
    /// Those of plain spectra over records and weighted hazard curves together.
    pub const JOINT: Self =
        Self { weights: "alike, with hazard curves", suffix: "_joint", is_repaired: false, is_joint: true };
    /// The same of repaired spectra.
    pub const REPAIRED_JOINT: Self = Self {
        weights: "repaired, with hazard curves",
        suffix: "_consistent_joint",
        is_repaired: true,
        is_joint: true,
    };
    /// All, in the order of the columns of tables.
    pub const ALL: [Self; 4] = [Self::PLAIN, Self::REPAIRED, Self::JOINT, Self::REPAIRED_JOINT];

    /// The name of a column of a table, whose unit stays at the end: `u05_joint_m` of `u05_m`.
    pub fn column(self, name: &str) -> String {
        before_unit(name, self.suffix)
    }

    /// The bands of this kind of a measure.
    pub fn select(self, bands: &MeasureBands) -> Option<BandsOfKind<'_>> {
        let (own, inferred, failed) = match &bands.repaired {
            _ if !self.is_repaired => (&bands.plain, &bands.inferred, None),
            repaired => repaired.as_ref().map(|own| (&own.bands, &own.inferred, Some(&own.failed)))?,
        };
        Some(if self.is_joint {
            let joint = own.joint.as_ref()?;
            BandsOfKind {
                limits_m: &joint.limits_m,
                simultaneous_m: None,
                inferred: None,
                figures: [None, Some(&joint.range_of_interval)],
                failed: joint.failed.as_ref(),
            }
        } else {
            BandsOfKind {
                limits_m: &own.limits_m,
                simultaneous_m: own.simultaneous_m.as_ref(),
                inferred: inferred.as_ref(),
                figures: [Some(&own.error_of_median), Some(&own.range_of_interval)],
                failed,
            }
        })
    }
}

impl<'a> BandsOfKind<'a> {
    /// Every limit with its name, that of the first three being `limit_names`.
    pub fn limits(self, limit_names: &'a [String; 3]) -> impl Iterator<Item = (&'a str, &'a Array<4>)> {
        let limits = limit_names.iter().map(String::as_str).zip(self.limits_m);
        let of_whole = SIMULTANEOUS_BANDS.quantities.iter().map(|own| own.name);
        let beyond = INFERRED_BANDS.quantities.iter().map(|own| own.name);
        let inferred_m = self.inferred.into_iter().flat_map(InferredBands::limits_m);
        limits.chain(of_whole.zip(self.simultaneous_m.into_iter().flatten())).chain(beyond.zip(inferred_m))
    }
}
