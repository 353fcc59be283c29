//! A result at other risks than those of its study: its stripes and hazard hold them all.

use clap::Args;
use uplift_hazard::probability_from_rate;
use uplift_job::typed::{number, number_or_per_cent};
use uplift_job::{Array, JobError, in_file};
use uplift_plausible::{PROBABILITY, RETURN_PERIOD, YEARS};
use uplift_result::{ResultFile, RiskAxes, StoredSpectra};
use uplift_study::{Kind, UniformRiskStudy};

use crate::coefficients::{Coefficients, stored_spectra};
use crate::consistency::consistency_at_target_risks;
use crate::error::UniformRiskError;
use crate::site_risk::{SiteRisk, SiteSpectra};
use crate::spectra::Spectra;
use crate::stored_stripes::{StoredMeasure, stored_measure};

/// Most risks, each a spectrum for every site.
const MOST_RISKS: usize = 1000;

/// What the command line calls them.
const POE_OPTION: &str = "--poe";
const RETURN_PERIOD_OPTION: &str = "--return-period";
const YEARS_OPTION: &str = "--years";

/// The risks that a result is read at; by default those of its study.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub struct TargetRisks {
    /// Probabilities of exceedance, 0.1 or 10% [default: the study's]
    #[arg(
        long,
        value_name = "P[,P…]",
        value_delimiter = ',',
        allow_negative_numbers = true,
        value_parser = number_or_per_cent,
        conflicts_with = "return_period"
    )]
    pub poe: Vec<f64>,
    /// Return periods in years instead
    #[arg(long, value_name = "YEARS[,…]", value_delimiter = ',', allow_negative_numbers = true, value_parser = number)]
    pub return_period: Vec<f64>,
    /// Years of the probabilities [default: the study's]
    #[arg(long, value_name = "YEARS", allow_negative_numbers = true, value_parser = number)]
    pub years: Option<f64>,
}

/// The one risk that a result is read at; by default the smallest probability of its study.
#[derive(Debug, Clone, Copy, Default, PartialEq, Args)]
pub struct OneRisk {
    /// Probability of exceedance, 0.1 or 10% [default: the smallest]
    #[arg(
        long, value_name = "P", allow_negative_numbers = true, value_parser = number_or_per_cent,
        conflicts_with = "return_period"
    )]
    pub poe: Option<f64>,
    /// Return period in years instead
    #[arg(long, value_name = "YEARS", allow_negative_numbers = true, value_parser = number)]
    pub return_period: Option<f64>,
    /// Years of the probability [default: the study's]
    #[arg(long, value_name = "YEARS", allow_negative_numbers = true, value_parser = number)]
    pub years: Option<f64>,
}

impl From<OneRisk> for TargetRisks {
    fn from(one: OneRisk) -> Self {
        let OneRisk { poe, return_period, years } = one;
        Self { poe: poe.into_iter().collect(), return_period: return_period.into_iter().collect(), years }
    }
}

impl TargetRisks {
    /// Whether the probabilities are those of the study.
    pub(crate) fn has_targets_of_study(&self) -> bool {
        self.poe.is_empty() && self.return_period.is_empty()
    }

    /// The probabilities asked for, and the years that they refer to, of a study with `poes` in `years`.
    fn probabilities(&self, poes: &[f64], years: f64) -> Result<(Vec<f64>, f64), UniformRiskError> {
        let years = match self.years {
            Some(years) => YEARS.check("--years", years).map_err(|mistake| JobError::Implausible(vec![mistake]))?,
            None => years,
        };
        let (option, given) = match (&self.poe[..], &self.return_period[..]) {
            ([], []) => (YEARS_OPTION, poes),
            ([], periods) => (RETURN_PERIOD_OPTION, periods),
            (poes, _) => (POE_OPTION, poes),
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
        if mistakes.is_empty() { Ok((asked, years)) } else { Err(JobError::Usage(mistakes.join("\n")).into()) }
    }
}

/// The probability of exceedance in `years` that the `value` of an `option` asks for, or why there is none.
fn probability(option: &str, value: f64, years: f64) -> Result<f64, String> {
    // nobody asks for what happens every year, or for a probability above one
    if option == RETURN_PERIOD_OPTION && value > 0.0 && value < 1.0 {
        return Err(format!("{option} {value}: is in years, e.g. 475; a probability is {POE_OPTION} {value}"));
    }
    if option == POE_OPTION && value > 1.0 {
        let per_cent = if value < 100.0 { format!("; {value} % is {option} {value}%") } else { String::new() };
        return Err(format!(
            "{option} {value}: a probability is below 1 (a comma separates two){per_cent}; a return period is \
             {RETURN_PERIOD_OPTION} {value}"
        ));
    }
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
        let (what, way_out) = if poe > 0.5 { ("certain", "fewer") } else { ("rarer than any number", "more") };
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

/// The result `file` at the risks `asked`: axes, spectra, coefficients, warnings, stripes and study are from now on
/// of these, read off the stripes as a run reads them, to the bit; bands once they are resampled.
///
/// # Errors
/// Risks that are none; a file that is damaged, or of another kind; a study without sites.
pub fn at_target_risks(file: ResultFile, asked: &TargetRisks) -> Result<ResultFile, UniformRiskError> {
    if *asked == TargetRisks::default() {
        return Ok(file);
    }
    if file.kind() != Kind::UniformRisk {
        return Err(file
            .fail(
                "holds displacement spectra of record sets, which have no probability: leave out --poe, \
                 --return-period and --years",
            )
            .into());
    }
    let axes = file.axes_with_sites()?;
    let mut study = file.stored_study()?;
    (study.risk.poe, study.risk.years) = asked.probabilities(&axes.poes, axes.years)?;
    let mut measures = Vec::new();
    for measure in file.measures() {
        let stripes = stored_measure(&file, &axes, &[], measure, study.risk.extrapolate)?;
        let (spectra, fits) = read(&study, &axes, &stripes).map_err(|error| in_file(error, file.path()))?;
        measures.push(stored_spectra(&spectra, &fits));
    }
    let RiskAxes { strengths, sites, .. } = axes;
    let spectra = StoredSpectra { strengths, poes: study.risk.poe, years: study.risk.years, sites, measures };
    let file = file.with_spectra(spectra);
    let consistency = consistency_at_target_risks(&file)?;
    Ok(file.with_consistency(consistency))
}

/// The spectra of `study` and their coefficients, off `stripes`.
fn read(
    study: &UniformRiskStudy,
    axes: &RiskAxes,
    stripes: &StoredMeasure,
) -> Result<(Spectra, Coefficients), UniformRiskError> {
    let (strengths, poes) = (axes.strengths.len(), study.risk.poe.len());
    let risk = SiteRisk::from_demands(study, strengths, |strength| stripes.demand(strength))?;
    let of_site = |weights| risk.spectra(weights).map_err(JobError::input);
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
