//! What the repair adds to the tables and the map of many sites.

use std::fmt::Write as _;

use uplift_regression::ExponentialFit;
use uplift_risk::Ordinate;

use super::SiteConsistency;
use super::files::{cell, json_number, number};

pub(super) const SPECTRA: &str = "u_consistent_m";
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

/// The repaired ordinates of the probability at `poe`, of so many `strengths`; none without a repair.
pub(super) fn spectrum(consistency: &SiteConsistency, poe: usize, strengths: usize) -> Option<&[Ordinate]> {
    consistency.spectra.as_ref().ok().and_then(|spectra| spectra.ordinates.chunks(strengths).nth(poe))
}

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

/// The properties of the map: an ordinate for each of `shown`, with its name, of the probability named `key`.
pub(super) fn properties<'a>(
    spectrum: Option<&[Ordinate]>,
    key: &str,
    shown: impl Iterator<Item = (usize, &'a str)>,
) -> String {
    let mut properties = String::new();
    for (strength, ending) in shown {
        let u_m = spectrum.and_then(|spectrum| spectrum.get(strength)).map(|ordinate| ordinate.displacement_m);
        let _ = write!(properties, ",\"{key}_consistent{ending}\":{}", json_number(u_m));
    }
    properties
}
