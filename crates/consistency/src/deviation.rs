//! How far the hazard that a set implies lies from the site's.

use std::fmt;

use uplift_risk::RiskCurve;

use crate::{ConsistencyError, ScaledAnalysis};

/// Rates at which the two are compared.
pub const DEVIATION_RATES: usize = 21;

/// The implied hazard against the site's at [`DEVIATION_RATES`] rates over the range.
#[derive(Debug, Clone, PartialEq)]
pub struct Deviation {
    /// ρ, 1/yr, falling, at equal ratios, ends of the range included.
    pub rates_per_year: [f64; DEVIATION_RATES],
    /// The site's level of y at each rate.
    pub site_levels: [f64; DEVIATION_RATES],
    /// The implied level of y at each rate.
    pub implied_levels: [f64; DEVIATION_RATES],
    /// Mean of D = ln(implied/site).
    pub mean: f64,
    /// exp(mean D): how many times the site's level the set brings.
    pub bias: f64,
    /// Root mean square of D.
    pub rms: f64,
    /// Largest |D|.
    pub max: f64,
}

impl Deviation {
    /// Compares over the range of the analysis.
    pub(crate) fn from_analysis(
        analysis: &ScaledAnalysis<'_>,
        implied: &RiskCurve<'_>,
    ) -> Result<Self, ConsistencyError> {
        let rates_per_year: [f64; DEVIATION_RATES] = analysis.range().rates();
        let (mut site_levels, mut implied_levels) = ([0.0; DEVIATION_RATES], [0.0; DEVIATION_RATES]);
        let (mut sum, mut squares, mut max) = (0.0, 0.0, 0.0_f64);
        for (index, &rate) in rates_per_year.iter().enumerate() {
            site_levels[index] = analysis.other().im_at_rate(rate)?;
            implied_levels[index] = implied.exact_ordinate(rate)?.displacement_m;
            let deviation = (implied_levels[index] / site_levels[index]).ln();
            sum += deviation;
            squares += deviation * deviation;
            max = max.max(deviation.abs());
        }
        let count = DEVIATION_RATES as f64;
        let mean = sum / count;
        let rms = (squares / count).sqrt();
        Ok(Self { rates_per_year, site_levels, implied_levels, mean, bias: mean.exp(), rms, max })
    }

    /// What to think of it.
    pub fn verdict(&self) -> Verdict {
        Verdict::from_bias(self.bias, self.max)
    }
}

/// Whether a set scaled to one measure brings the hazard of the other; the limits are judgement, not calibrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Bias within 0.9 to 1.1, and nowhere further off than 0.15 in the logarithm.
    Consistent,
    /// Bias within 0.75 to 1.33, and nowhere further off than 0.4.
    Off,
    /// Further off than that.
    Inconsistent,
}

impl Verdict {
    /// Every verdict, the best first.
    pub const ALL: [Self; 3] = [Self::Consistent, Self::Off, Self::Inconsistent];

    /// Least and largest bias, and the largest |D|; the worst has none.
    pub fn limits(self) -> Option<([f64; 2], f64)> {
        match self {
            Self::Consistent => Some(([0.9, 1.1], 0.15)),
            Self::Off => Some(([0.75, 1.33], 0.4)),
            Self::Inconsistent => None,
        }
    }

    /// Of a bias and the largest |D|.
    pub fn from_bias(bias: f64, max: f64) -> Self {
        let holds = |([least, most], largest): ([f64; 2], f64)| (least..=most).contains(&bias) && max <= largest;
        Self::ALL.into_iter().find(|own| own.limits().is_some_and(holds)).unwrap_or(Self::Inconsistent)
    }

    /// Its name in tables and options: consistent, off, inconsistent.
    pub fn key(self) -> &'static str {
        match self {
            Self::Consistent => "consistent",
            Self::Off => "off",
            Self::Inconsistent => "inconsistent",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}

/// The two deviations of one set at one site, taken apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoSided {
    /// Half the difference of the mean deviations: where the set lies between PGV and PGA. Other records can cure it.
    pub location: f64,
    /// Half their sum: what no single set can avoid, for its records have one distribution of PGA/PGV and the site's
    /// hazard asks for two.
    pub spread: f64,
}

impl TwoSided {
    /// - `scaled_to_pgv`: mean D of PGA, of the set scaled to PGV.
    /// - `scaled_to_pga`: mean D of PGV, of the set scaled to PGA.
    pub fn from_deviations(scaled_to_pgv: &Deviation, scaled_to_pga: &Deviation) -> Self {
        let (pga, pgv) = (scaled_to_pgv.mean, scaled_to_pga.mean);
        Self { location: 0.5 * (pga - pgv), spread: 0.5 * (pga + pgv) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_at_their_limits() {
        for (bias, max, verdict) in [
            (1.0, 0.0, Verdict::Consistent),
            (0.9, 0.15, Verdict::Consistent),
            (1.0, 0.151, Verdict::Off),
            (0.89, 0.1, Verdict::Off),
            (1.33, 0.4, Verdict::Off),
            (1.34, 0.4, Verdict::Inconsistent),
            (0.74, 0.3, Verdict::Inconsistent),
            (1.0, 0.41, Verdict::Inconsistent),
            (f64::NAN, f64::NAN, Verdict::Inconsistent),
        ] {
            assert_eq!(Verdict::from_bias(bias, max), verdict, "{bias} {max}");
        }
        assert!(Verdict::Consistent < Verdict::Off && Verdict::Off < Verdict::Inconsistent);
    }
}
