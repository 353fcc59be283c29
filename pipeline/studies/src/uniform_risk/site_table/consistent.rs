//! What the repair adds to the tables of many sites.

use std::fmt::Write as _;

use uplift_regression::ExponentialFit;

use super::SiteConsistency;
use super::layout::{cell, number};

/// Columns of the spectra, the last two where they have bands.
pub(super) const SPECTRA: [&str; 3] = ["u_consistent_m", "lower_consistent_m", "upper_consistent_m"];
pub(super) const COEFFICIENTS: [&str; 9] = [
    "bias",
    "max",
    "verdict",
    "least_effective",
    "c0_consistent_m",
    "c1_consistent",
    "c2_consistent_m",
    "rmse_consistent_m",
    "no_repair",
];

pub(super) fn coefficient_cells(consistency: &SiteConsistency, poe: usize) -> String {
    let fit = consistency.spectra.as_ref().ok().map(|spectra| spectra.fits[poe].as_ref());
    let why = match (&consistency.spectra, fit) {
        (Err(reason), _) => reason.clone(),
        (_, Some(Err(reason))) => format!("no fit: {reason}"),
        _ => String::new(),
    };
    let fit = fit.and_then(Result::ok);
    let of_fit = |value: fn(&ExponentialFit) -> f64| fit.map_or_else(String::new, |fit| number(value(fit)));
    let mut cells = String::new();
    for text in [
        number(consistency.bias),
        number(consistency.max),
        consistency.verdict.to_owned(),
        number(consistency.least_effective),
        of_fit(|fit| fit.c0),
        of_fit(|fit| fit.c1),
        of_fit(|fit| fit.c2),
        of_fit(|fit| fit.rmse),
        cell(&why),
    ] {
        let _ = write!(cells, ",{text}");
    }
    cells
}
