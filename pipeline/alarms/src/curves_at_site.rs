//! The hazard curves of a site in one measure, and which of them is odd.

use uplift_hazard::HazardCurve;
use uplift_motion::IntensityMeasure;

/// The hazard of a site in one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct CurvesAtSite<'a> {
    /// Name of the site.
    pub site: &'a str,
    /// The measure.
    pub measure: IntensityMeasure,
    /// What the spectra are made of, in field units.
    pub curve: &'a HazardCurve,
    /// Weighted alternatives with their names.
    pub branches: Vec<(&'a str, &'a HazardCurve)>,
}

/// One of the curves of a site.
pub(super) struct Found<'a> {
    pub(super) curve: &'a HazardCurve,
    /// `the hazard curve`, or `the weighted curve "a" (and 1 more of 3)`.
    pub(super) name: String,
    /// Whether it is the one that the spectra are made of.
    pub(super) is_all: bool,
}

impl<'a> CurvesAtSite<'a> {
    /// `Athens, PGV`.
    pub(super) fn subject(&self) -> String {
        format!("{}, {}", self.site, self.measure.label())
    }

    /// The curve of the spectra where `is_odd` holds for it, else the first weighted one for which it does.
    pub(super) fn first_that(&self, is_odd: impl Fn(&HazardCurve) -> bool) -> Option<Found<'a>> {
        if is_odd(self.curve) {
            return Some(Found { curve: self.curve, name: "the hazard curve".to_owned(), is_all: true });
        }
        let mut odd = self.branches.iter().filter(|(_, branch)| is_odd(branch));
        let (name, curve) = odd.next()?;
        let others = match odd.count() {
            0 => String::new(),
            more => format!(" (and {more} more of {})", self.branches.len()),
        };
        Some(Found { curve, name: format!("the weighted curve \"{name}\"{others}"), is_all: false })
    }
}
