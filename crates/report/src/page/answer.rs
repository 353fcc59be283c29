//! The answer in a sentence for each site: how far a structure must be able to go.

use serde::Serialize;
use uplift::Array;
use uplift::text::{nearest, per_cent, risk_in_words};

use crate::figures::FigureSource;

/// Strengths of which the sentence speaks.
const SHOWN_STRENGTHS: [f64; 3] = [0.1, 0.2, 0.4];

/// The sentences, and what they have in common.
#[derive(Debug, Serialize)]
pub(super) struct Answer {
    /// `2 % in 50 years`.
    probability: String,
    /// `PGV`.
    measure: &'static str,
    /// `90 %`; none without bands.
    confidence: Option<String>,
    sites: Vec<SiteAnswer>,
    /// Sites that are in the table alone.
    others: usize,
}

/// What a structure must survive at a site.
#[derive(Debug, Serialize)]
struct SiteAnswer {
    site: String,
    cases: Vec<Case>,
    /// By weighted records, where the records as they are do not bring the site's hazard; none elsewhere.
    repaired: Vec<Case>,
}

#[derive(Debug, Serialize)]
struct Case {
    /// Acceleration at uplift, g.
    strength: String,
    displacement: String,
    band: Option<String>,
}

/// The answer of the first measure for the rarest probability; none without spectra.
pub(super) fn answer(source: &FigureSource) -> Option<Answer> {
    let spectra = &source.spectra;
    let of = spectra.measures.first()?;
    let poe = source.rarest();
    let shown = nearest(&spectra.strengths, &SHOWN_STRENGTHS);
    let bands = source.bands.as_ref().and_then(|stored| Some((stored, stored.of(of.measure)?)));
    let without_band = |strength: usize, u_m: f64| Case {
        strength: significant(spectra.strengths[strength]),
        displacement: if u_m.is_finite() {
            format!("{} m", significant(u_m))
        } else {
            "more than was analysed".to_owned()
        },
        band: None,
    };
    let case = |site: usize, strength: usize, u_m: f64, limits_m: Option<[&Array<4>; 2]>| {
        let size = bands.map_or(0, |(stored, _)| stored.of_set(source.stored.records.len()));
        let band = limits_m.map(|limits_m| {
            let [lower, upper] = limits_m.map(|limit_m| limit_m[[site, poe, size, strength]]);
            if upper.is_finite() {
                format!("{} to {} m", significant(lower), significant(upper))
            } else {
                format!("{} m and more", significant(lower))
            }
        });
        Case { band: band.filter(|_| u_m.is_finite()), ..without_band(strength, u_m) }
    };
    let plain_m = bands.map(|(_, bands)| match &bands.inferred {
        Some(inferred) => inferred.truth_m.each_ref(),
        None => outer(&bands.plain.limits_m),
    });
    let repaired_m = bands.and_then(|(_, bands)| Some(outer(&bands.repaired.as_ref()?.bands.limits_m)));
    let repaired = |site: usize| -> Vec<Case> {
        let Some(u_m) = source.repaired(of.measure, site) else { return Vec::new() };
        shown.iter().map(|&strength| case(site, strength, u_m[[site, poe, strength]], repaired_m)).collect()
    };
    let site = |site: usize| SiteAnswer {
        site: spectra.sites[site].clone(),
        cases: shown.iter().map(|&strength| case(site, strength, of.u_m[[site, poe, strength]], plain_m)).collect(),
        repaired: repaired(site),
    };
    Some(Answer {
        probability: risk_in_words(spectra.poes[poe], spectra.years),
        measure: of.measure.label(),
        confidence: bands.map(|(stored, _)| per_cent(stored.confidence)),
        sites: source.sites().map(site).collect(),
        others: spectra.sites.len() - source.sites().len(),
    })
}

/// Both limits, without the median.
fn outer([lower_m, _, upper_m]: &[Array<4>; 3]) -> [&Array<4>; 2] {
    [lower_m, upper_m]
}

/// A number as it is spoken: two digits that say something.
pub(crate) fn significant(value: f64) -> String {
    if !(value > 0.0 && value.is_finite()) {
        return if value == 0.0 { "0".to_owned() } else { "–".to_owned() };
    }
    // what rounding makes of it decides where the first digit stands
    let written = format!("{value:.1e}");
    let exponent: i32 = written.split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0);
    match usize::try_from(1 - exponent) {
        Ok(decimals) => format!("{value:.decimals$}"),
        Err(_) => format!("{:.0}", written.parse().unwrap_or(value)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_digits_that_say_something() {
        let said: Vec<String> = [0.2345, 0.1, 0.00998, 12.6, 68257.0, 0.0, f64::NAN].map(significant).into();
        assert_eq!(said, ["0.23", "0.10", "0.010", "13", "68000", "0", "–"]);
    }
}
