//! A result asked for other risks than those of its study: its stripes and hazard hold them all.

use uplift_hazard::probability_from_rate;
use uplift_plausible::{PROBABILITY, RETURN_PERIOD, YEARS};
use uplift_study::{Kind, UniformRiskStudy};

use super::file::{ResultFile, RiskAxes};
use super::{MeasureSpectra, StoredBands, StoredConsistency, StoredMeasure, StoredSpectra};
use crate::array::Array;
use crate::consistency::consistency_of_asked;
use crate::error::UpliftError;
use crate::uniform_risk::site_table::{SiteRisk, SiteSpectra};
use crate::uniform_risk::{Coefficients, Spectra};

/// Most risks, each a spectrum for every site.
const MOST_RISKS: usize = 1000;

/// What the command line calls them.
const POE_OPTION: &str = "--poe";
const RETURN_PERIOD_OPTION: &str = "--return-period";
const YEARS_OPTION: &str = "--years";

/// The risks that a result is asked for; by default those of its study.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct AskedRisk {
    /// What spectra are asked for.
    pub targets: RiskTargets,
    /// Years that probabilities refer to; those of the study where none are given.
    pub years: Option<f64>,
}

/// What spectra are asked for.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum RiskTargets {
    /// Those of the probabilities of the study.
    #[default]
    OfStudy,
    /// Those of these probabilities of exceedance, within [`PROBABILITY`].
    Probabilities(Vec<f64>),
    /// Those of these return periods, years: a rate of one in so many (Eq. 4.8).
    ReturnPeriods(Vec<f64>),
}

/// What a result says of the risks that it was asked for.
pub(super) struct Asked {
    pub(super) spectra: StoredSpectra,
    pub(super) consistency: Vec<StoredConsistency>,
    /// None until they are made.
    pub(super) bands: Option<StoredBands>,
}

impl AskedRisk {
    /// One probability of exceedance in the years of the study.
    pub fn probability(poe: f64) -> Self {
        Self { targets: RiskTargets::Probabilities(vec![poe]), years: None }
    }

    /// Whether nothing else is asked for than what the study has.
    pub fn is_of_study(&self) -> bool {
        self.targets == RiskTargets::OfStudy && self.years.is_none()
    }

    /// The probabilities asked for, and the years that they refer to, of a study with `poes` in `years`.
    fn probabilities(&self, poes: &[f64], years: f64) -> Result<(Vec<f64>, f64), UpliftError> {
        let years = match self.years {
            Some(years) => YEARS.check("--years", years).map_err(|mistake| UpliftError::Implausible(vec![mistake]))?,
            None => years,
        };
        let (option, given) = match &self.targets {
            RiskTargets::OfStudy => (YEARS_OPTION, poes),
            RiskTargets::Probabilities(poes) => (POE_OPTION, poes.as_slice()),
            RiskTargets::ReturnPeriods(periods) => (RETURN_PERIOD_OPTION, periods.as_slice()),
        };
        let mut mistakes = Vec::new();
        let mut asked: Vec<f64> = Vec::new();
        for &value in given {
            match probability(option, value, years) {
                Ok(poe) if asked.contains(&poe) => mistakes.push(format!("{option} {value} is given twice")),
                Ok(poe) => asked.push(poe),
                Err(mistake) => mistakes.push(mistake),
            }
        }
        if given.is_empty() || given.len() > MOST_RISKS {
            mistakes = vec![format!("{option}: {} are given; from 1 to {MOST_RISKS} are possible", given.len())];
        }
        if mistakes.is_empty() { Ok((asked, years)) } else { Err(UpliftError::Usage(mistakes.join("\n"))) }
    }
}

/// The probability of exceedance in `years` that the `value` of an `option` asks for, or why there is none.
fn probability(option: &str, value: f64, years: f64) -> Result<f64, String> {
    let poe = if option == RETURN_PERIOD_OPTION {
        RETURN_PERIOD.check(RETURN_PERIOD_OPTION, value).map_err(|mistake| mistake.to_string())?;
        probability_from_rate(1.0 / value, years).map_err(|error| error.to_string())?
    } else {
        value
    };
    if PROBABILITY.contains(poe) {
        return Ok(poe);
    }
    Err(if option == RETURN_PERIOD_OPTION {
        let (what, way_out) = if poe > 0.5 { ("certain", "fewer") } else { ("rarer than can be told", "more") };
        format!("{option} {value}: in {years} years that is {what}: give {way_out} --years")
    } else if poe > 0.0 && poe < 1.0 {
        format!("{option} {value:e}: a probability is {PROBABILITY}")
    } else {
        format!(
            "{option} {value}: a probability is above 0 and below 1 (10 % is 0.1 or 10%; a comma separates two, the \
             decimal mark is a point)"
        )
    })
}

impl ResultFile {
    /// The same result at the risks asked for: axes, spectra, coefficients, warnings, stripes and study are from now on
    /// of these, read off the stripes as a run reads them, to the bit; bands once they are
    /// [`resampled`](Self::resampled).
    ///
    /// # Errors
    /// Risks that are none; a file that is damaged, or of another kind; a study without sites.
    pub fn at(mut self, asked: &AskedRisk) -> Result<Self, UpliftError> {
        if asked.is_of_study() {
            return Ok(self);
        }
        if self.kind() != Kind::UniformRisk {
            return Err(self.fail(
                "holds displacement spectra of record sets, which are of no probability: leave out --poe, \
                 --return-period and --years",
            ));
        }
        let axes = self.axes_with_sites()?;
        let mut study = self.stored_study()?;
        (study.risk.poe, study.risk.years) = asked.probabilities(&axes.poes, axes.years)?;
        let mut spectra = Vec::new();
        let mut coefficients = Vec::new();
        for measure in self.measures() {
            let stripes = self.stored_measure(&axes, &[], measure, study.risk.extrapolate)?;
            let (of_measure, fits) = read(&study, &axes, &stripes).map_err(|error| error.in_file(&self.path))?;
            spectra.push(of_measure);
            coefficients.push(fits);
        }
        let RiskAxes { strengths, sites, .. } = axes;
        let measures = spectra.iter().zip(&coefficients).map(|(of, fits)| MeasureSpectra::of(of, fits)).collect();
        let spectra = StoredSpectra { strengths, poes: study.risk.poe, years: study.risk.years, sites, measures };
        self.asked = Some(Asked { spectra, consistency: Vec::new(), bands: None });
        let consistency = consistency_of_asked(&self)?;
        if let Some(asked) = &mut self.asked {
            asked.consistency = consistency;
        }
        Ok(self)
    }

    /// Whether it was asked for other risks than those of its study.
    pub fn is_asked(&self) -> bool {
        self.asked.is_some()
    }

    /// The same with `bands` at the risks that it was asked for.
    pub(crate) fn with_bands(mut self, bands: StoredBands) -> Self {
        if let Some(asked) = &mut self.asked {
            asked.bands = Some(bands);
        }
        self
    }
}

/// The spectra of `study` and their coefficients, off `stripes`.
fn read(
    study: &UniformRiskStudy,
    axes: &RiskAxes,
    stripes: &StoredMeasure,
) -> Result<(Spectra, Coefficients), UpliftError> {
    let (strengths, poes) = (axes.strengths.len(), study.risk.poe.len());
    let risk = SiteRisk::of(study, strengths, |strength| stripes.demand(strength))?;
    let of_site = |weights| risk.spectra(weights).map_err(UpliftError::input);
    let sites: Vec<SiteSpectra> = stripes.weights.iter().map(of_site).collect::<Result<_, _>>()?;
    let ordinates = Array::from_fn([sites.len(), poes, strengths], |[site, poe, strength]| {
        sites[site].ordinates[poe * strengths + strength]
    });
    let fits = Array::from_fn([sites.len(), poes], |[site, poe]| sites[site].fits[poe].clone());
    let measure = stripes.measure;
    Ok((
        Spectra { measure, ordinates, branches: Vec::new(), structures: Vec::new(), maf_per_year: None },
        Coefficients { measure, fits },
    ))
}
