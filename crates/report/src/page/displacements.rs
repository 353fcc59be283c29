//! Displacements with their confidence bands, for the tables of the page.

use uplift::UpliftError;
use uplift::consistency::Question;
use uplift::result::{MeasureSpectra, ResultFile};
use uplift_bootstrap::{inferred_limits, units};
use uplift_motion::IntensityMeasure;
use uplift_risk::RiskError;

use crate::figures::FigureSource;

/// How often a band is to hold the displacement of all records like those of the set.
const CONFIDENCE: f64 = 0.9;

/// A row of a table of displacements, by positions.
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub(super) measure: IntensityMeasure,
    pub(super) site: usize,
    pub(super) poe: usize,
    /// Whether it is of weighted records, which have no band.
    pub(super) repaired: bool,
    /// A cell for each strength.
    pub(super) cells: Vec<String>,
}

/// The displacements by every measure at the strengths `shown`, by position; the repaired ones below the plain ones.
///
/// # Errors
/// A file that is damaged.
pub(super) fn rows(file: &ResultFile, source: &FigureSource, shown: &[usize]) -> Result<Vec<Row>, UpliftError> {
    let mut rows = Vec::new();
    for of in &source.spectra.measures {
        let found = displacements(file, source, of, shown)?;
        let cells = found.chunks(shown.len().max(1)).map(|row| row.iter().map(Displacement::shown).collect());
        let places = of.u_m.blocks::<2>().map(|(at, _)| at);
        for ([site, poe], cells) in places.zip(cells) {
            let row = Row { measure: of.measure, site, poe, repaired: false, cells };
            rows.push(row.clone());
            if let Some(u_m) = source.repaired(of.measure, site) {
                let without_band = |&eta: &usize| Displacement { u_m: u_m[[site, poe, eta]], band_m: None }.shown();
                rows.push(Row { repaired: true, cells: shown.iter().map(without_band).collect(), ..row });
            }
        }
    }
    Ok(rows)
}

/// A displacement of uniform risk, m, with the limits of its confidence band; none of a single record.
#[derive(Debug, Clone, Copy)]
struct Displacement {
    u_m: f64,
    band_m: Option<[f64; 2]>,
}

/// The displacements by a measure: by site, then probability, then strength.
fn displacements(
    file: &ResultFile,
    source: &FigureSource,
    of: &MeasureSpectra,
    shown: &[usize],
) -> Result<Vec<Displacement>, UpliftError> {
    let stored = &source.stored;
    // the records of a pair are not independent
    let each = || (0..stored.records.len()).collect();
    let pairs = units(&Question::from_result(file).map_or_else(|_| each(), |question| question.pair_of()));
    let asked = (&[pairs.len()][..], CONFIDENCE);
    let mut found = Vec::new();
    for measure in stored.measures.iter().filter(|own| own.measure == of.measure) {
        let demands = shown.iter().map(|&strength| measure.demand(strength)).collect::<Result<Vec<_>, _>>()?;
        for (site, weights) in measure.weights.iter().enumerate() {
            let limits =
                demands.iter().map(|demand| inferred_limits(demand, weights, &pairs, &stored.targets_per_year, asked));
            let limits = limits.collect::<Result<Vec<_>, RiskError>>().map_err(|error| source.fail(&error))?;
            for poe in 0..stored.poes.len() {
                found.extend(shown.iter().zip(&limits).map(|(&strength, limits)| {
                    let band_m = limits[poe].truth_m;
                    let band_m = band_m.iter().all(|limit| !limit.is_nan()).then_some(band_m);
                    Displacement { u_m: of.u_m[[site, poe, strength]], band_m }
                }));
            }
        }
    }
    Ok(found)
}

impl Displacement {
    /// `0.35 (0.24 to 0.84)`.
    fn shown(&self) -> String {
        if !self.u_m.is_finite() {
            return "not analysed".to_owned();
        }
        let band = self.band_m.map_or_else(String::new, |[lower, upper]| {
            let upper = if upper.is_finite() { format!("to {}", significant(upper)) } else { "or more".to_owned() };
            format!(" ({} {upper})", significant(lower))
        });
        significant(self.u_m) + &band
    }
}

/// A number with two significant digits.
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

    #[test]
    fn a_displacement_with_its_band() {
        let shown = |u_m: f64, band_m| Displacement { u_m, band_m }.shown();
        assert_eq!(shown(0.352, Some([0.241, 0.838])), "0.35 (0.24 to 0.84)");
        assert_eq!(shown(0.352, Some([0.241, f64::INFINITY])), "0.35 (0.24 or more)");
        assert_eq!([shown(0.352, None), shown(f64::INFINITY, None)], ["0.35", "not analysed"]);
    }
}
