//! What the repair adds to the tables of many sites.

use std::fmt::Write as _;

use uplift_result::before_unit;

use super::SiteConsistency;
use super::layout::{FIT, cell, fit_number, number};

/// Columns of the spectra, the last two where they have bands.
pub(super) const SPECTRA: [&str; 3] = ["u_consistent_m", "lower_consistent_m", "upper_consistent_m"];

/// Columns of the coefficients.
pub(super) fn coefficients() -> impl Iterator<Item = String> {
    let of_fit = FIT.map(|(name, _)| before_unit(name, "_consistent"));
    let of_site = ["bias", "max", "verdict", "least_effective"].map(str::to_owned);
    of_site.into_iter().chain(of_fit).chain(["no_repair".to_owned()])
}

pub(super) fn coefficient_cells(consistency: &SiteConsistency, poe: usize) -> String {
    let fit = consistency.spectra.as_ref().ok().map(|spectra| spectra.fits[poe].as_ref());
    let why = match (&consistency.spectra, fit) {
        (Err(reason), _) => reason.clone(),
        (_, Some(Err(reason))) => format!("no fit: {reason}"),
        _ => String::new(),
    };
    let fit = fit.and_then(Result::ok);
    let [bias, max, least] = [consistency.bias, consistency.max, consistency.least_effective].map(number);
    let mut cells = format!(",{bias},{max},{},{least}", consistency.verdict);
    for (_, value) in FIT {
        let _ = write!(cells, ",{}", fit_number(fit, value));
    }
    cells + "," + &cell(&why)
}
