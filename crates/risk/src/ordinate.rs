//! An ordinate of the uniform risk spectrum, and whether it exists.

/// From this share of the risk on, a tail of the hazard is worth a warning.
pub const TAIL_SHARE_LIMIT: f64 = 0.01;
/// Where a displacement is below this, m, a ratio says nothing: it is at the uplift displacement.
pub const COMPARED_FROM_M: f64 = 0.003;
/// Spectra by two measures that are further apart than this need no band to say so: with 105 recorded pairs 90 % bands
/// are some 40 % wide by PGV and 120 to 170 % by PGA (docs/method.md, section 9), half of each to either side.
pub const MEASURES_APART: f64 = 2.0;
/// From this ratio on the measure chosen matters more than everything else in a study.
pub const MEASURES_APART_DECISIVE: f64 = 3.0;
/// From this share of the risk on, it is decided by what was not analysed.
pub const DECISIVE_SHARE: f64 = 0.1;
/// From this share of the target rate on, motions above the last level may matter though few records exceed the
/// ordinate there: the risk integral goes on with the share of the last level (Eq. 4.4), and the truth may be all.
pub const BEYOND_LIMIT: f64 = 0.1;
/// With fewer records than this a spectrum changes with each of them (Section 4.5.1: 40 are a robust lower limit).
pub const FEW_RECORDS: usize = 40;

/// What kind of ordinate it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum OrdinateFlag {
    /// An ordinate like any other: positive and finite.
    Regular,
    /// The structure moves at all no more often than the target rate, λ(0) ≤ target: the ordinate is 0.
    NoExceedance,
    /// There is no ordinate: every displacement considered is exceeded more often than the target rate. Either
    /// overturning alone is more frequent than that, or the ordinate lies beyond the last threshold of a grid.
    Censored,
}

impl OrdinateFlag {
    /// Every kind, in the order of their numbers.
    pub const ALL: [Self; 3] = [Self::Regular, Self::NoExceedance, Self::Censored];

    /// How it stands in arrays: 0, 1, 2.
    pub fn number(self) -> u8 {
        match self {
            Self::Regular => 0,
            Self::NoExceedance => 1,
            Self::Censored => 2,
        }
    }

    /// The one that stands as this number.
    pub fn from_number(number: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|flag| flag.number() == number)
    }

    /// How it stands in tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::Regular => "regular",
            Self::NoExceedance => "no exceedance",
            Self::Censored => "censored",
        }
    }
}

/// The displacement of a target rate: one point of a uniform risk spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ordinate {
    /// Displacement, m; 0 for [`OrdinateFlag::NoExceedance`], +∞ for [`OrdinateFlag::Censored`].
    pub displacement_m: f64,
    /// Whether the ordinate exists.
    pub flag: OrdinateFlag,
    /// Share of the risk that comes from below the first stripe, 0 to 1.
    ///
    /// The risk meant, in both shares, is that of the runs that fix the ordinate u. Exact: λ just below u, of all runs
    /// with EDP ≥ u. Grid: λ at the threshold below u. Without exceedance: λ(0). Censored: the overturned runs, or λ at
    /// the last threshold. Zero where that risk is zero.
    pub lower_tail_share: f64,
    /// Share of the same risk that comes from above the last stripe, 0 to 1.
    pub upper_tail_share: f64,
}

impl Ordinate {
    /// Whether one of the tails makes up more than [`TAIL_SHARE_LIMIT`] of the risk: the stripes should reach further.
    pub fn has_significant_tail(&self) -> bool {
        self.lower_tail_share > TAIL_SHARE_LIMIT || self.upper_tail_share > TAIL_SHARE_LIMIT
    }
}
