//! Whether the levels of a study begin low enough and end high enough for its targets, tried on all of its strengths,
//! or on some where they are many.
//!
//! Below the first level the fragility falls in a straight line (docs/method.md, section 6), so that an ordinate which
//! rests on motions weaker than that comes out too large. How much of its risk lies there the responses alone can say,
//! and a few strengths are quickly analysed: the shares are those that a run would report. Above the last level the
//! share of runs that exceed stays as it is there, though stronger motions may do more: what a run would raise of that
//! is raised before it, as far as these strengths tell.

use serde::Serialize;
use uplift_alarms::{UpperEnd, below_first_case, spectrum_name};
use uplift_fragility::Stripes as Stripe;
use uplift_hazard::rate_from_probability;
use uplift_ida::{Axes, System, Unwatched, analyse};
use uplift_inputs::{RecordSet, SiteHazard};
use uplift_job::JobError;
use uplift_job::alarm::Case;
use uplift_job::text::risk_name;
use uplift_risk::{PooledDemand, RiskCurve, StripeWeights, TAIL_SHARE_LIMIT};
use uplift_study::{Grid, MeasurePlan, UniformRiskStudy, lower_starts};
use uplift_uniform_risk::{Reading, plan_stripes};

use crate::error::StudiesError;

/// Strengths tried at least beside the smallest, spread over those of the study up to the largest.
const LEAST_TRIED: usize = 4;
/// Analyses for which more strengths are tried: the share from outside the levels is often large at one strength alone.
const QUICK_ANALYSES: usize = 60_000;
/// Analyses that a trial may take: more records than this allows are not tried.
const MOST_ANALYSES: usize = 300_000;

/// How far down and up the levels of one measure reach.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LevelCheck {
    /// `PGV` or `PGA`.
    pub im: &'static str,
    /// Unit of the levels.
    pub unit: &'static str,
    /// The first level.
    pub first_level: f64,
    /// The strengths that were tried.
    pub strengths: Vec<f64>,
    /// The largest share of the risk of an ordinate that comes from below the first level, 0 to 1.
    pub lower_tail_share: f64,
    /// Ordinates of which more than 1 % does: `50 % at Athens`, worst first.
    pub too_high_for: Vec<String>,
    /// Levels that would do; none where these do, or where the hazard curves begin too high themselves.
    pub proposal: Option<LevelProposal>,
    /// The last level.
    pub last_level: f64,
    /// The largest share of the risk of an ordinate that comes from above the last level, 0 to 1.
    pub upper_tail_share: f64,
}

/// Levels that begin lower.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LevelProposal {
    /// The line for the study, `pgv.levels_cm_s = […]`.
    pub line: String,
    /// The largest share of the risk that then comes from below the first level, at the strengths tried.
    pub lower_tail_share: f64,
}

/// The peaks of a few strengths at the study's levels and at all lower ones that may be proposed.
struct Trial<'a> {
    study: &'a UniformRiskStudy,
    hazard: &'a [SiteHazard],
    /// First levels that may be proposed, the highest first.
    starts: Vec<f64>,
    /// Positions of the strengths.
    tried: Vec<usize>,
    levels: Grid,
    axes: Axes,
    edp_m: Vec<f64>,
    reading: Reading,
}

/// One of the spectra that a trial looks at: what its ordinates take from outside the levels, one share a strength.
struct Tails<'a> {
    site: &'a SiteHazard,
    poe: f64,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Tails<'_> {
    /// `50 % at Athens`.
    fn in_words(&self, study: &UniformRiskStudy) -> String {
        format!("{} at {}", risk_name(self.poe, study.risk.years), self.site.site)
    }
}

/// What is to be raised of the ends of the levels.
#[derive(Debug, Default)]
pub(super) struct LevelEnds {
    pub(super) lower: Vec<Case>,
    pub(super) upper: Vec<Case>,
}

/// Tries the levels of `measure`: what a run would take from outside them, and what is to be raised of that as far as
/// the strengths tried tell.
///
/// Not tried where there is no hazard curve to try them by, the records are too many, or each level has records of its
/// own; of their upper end the hazard alone says something then.
pub(super) fn check_levels(
    study: &UniformRiskStudy,
    measure: &MeasurePlan,
    inputs: (&RecordSet, &[System]),
    hazard: &[SiteHazard],
) -> Result<(Option<LevelCheck>, LevelEnds), StudiesError> {
    let Some(trial) = Trial::new(study, measure, inputs, hazard)? else {
        return Ok((None, level_ends(study, measure, &untried(study, hazard))?));
    };
    let own = trial.tails(measure.levels[0])?;
    let mut below: Vec<(f64, String)> = own.iter().map(|tails| (most(&tails.lower), tails.in_words(study))).collect();
    below.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut check = LevelCheck {
        im: measure.measure.label(),
        unit: measure.measure.unit(),
        first_level: measure.levels[0],
        strengths: trial.tried.iter().map(|&strength| study.strengths[strength]).collect(),
        lower_tail_share: below.first().map_or(0.0, |(share, _)| *share),
        too_high_for: below.into_iter().filter(|(share, _)| *share > TAIL_SHARE_LIMIT).map(|(_, name)| name).collect(),
        proposal: None,
        last_level: measure.levels[measure.levels.len() - 1],
        upper_tail_share: own.iter().map(|tails| most(&tails.upper)).fold(0.0, f64::max),
    };
    if !check.too_high_for.is_empty() {
        for &start in &trial.starts {
            let lower_tail_share = trial.tails(start)?.iter().map(|tails| most(&tails.lower)).fold(0.0, f64::max);
            if lower_tail_share <= TAIL_SHARE_LIMIT {
                let lowered = measure.starting_at(start).map_err(|error| JobError::input(error.to_string()))?;
                check.proposal = Some(LevelProposal { line: lowered.line(), lower_tail_share });
                break;
            }
        }
    }
    Ok((Some(check), level_ends(study, measure, &own)?))
}

fn most(shares: &[f64]) -> f64 {
    shares.iter().copied().fold(0.0, f64::max)
}

/// The spectra of a study of which nothing is analysed.
fn untried<'a>(study: &UniformRiskStudy, hazard: &'a [SiteHazard]) -> Vec<Tails<'a>> {
    let of = |site| move |&poe: &f64| Tails { site, poe, lower: Vec::new(), upper: Vec::new() };
    hazard.iter().flat_map(|site| study.risk.poe.iter().map(of(site))).collect()
}

/// What is to be raised of the first and the last level of `measure`.
fn level_ends(
    study: &UniformRiskStudy,
    measure: &MeasurePlan,
    spectra: &[Tails<'_>],
) -> Result<LevelEnds, StudiesError> {
    let mut cases = LevelEnds::default();
    for tails in spectra {
        let curve = &tails.site.curve.curve;
        let end = UpperEnd {
            plan: measure,
            curve,
            extrapolate: study.risk.extrapolate,
            target_per_year: rate_from_probability(tails.poe, study.risk.years)?,
        };
        let name = spectrum_name(&tails.site.site, measure.measure, &risk_name(tails.poe, study.risk.years));
        cases.lower.extend(below_first_case((measure, curve), &name, &tails.lower));
        cases.upper.extend(end.case(&name, &tails.upper)?);
    }
    Ok(cases)
}

/// Positions of the strengths to try: so many `parts` spread evenly, with the smallest and the largest, without that of
/// a free mass.
fn tried(strengths: &[f64], parts: usize) -> Vec<usize> {
    let begin = usize::from(strengths.first() == Some(&0.0));
    let count = strengths.len() - begin;
    let mut positions: Vec<usize> =
        (1..=parts).map(|part| begin + (count * part).div_ceil(parts)).map(|end| end.saturating_sub(1)).collect();
    positions.insert(0, begin);
    positions.retain(|position| (begin..strengths.len()).contains(position));
    positions.dedup();
    positions
}

impl<'a> Trial<'a> {
    /// The peaks of the strengths tried; none where the levels cannot be tried.
    fn new(
        study: &'a UniformRiskStudy,
        measure: &MeasurePlan,
        (records, systems): (&RecordSet, &[System]),
        hazard: &'a [SiteHazard],
    ) -> Result<Option<Self>, StudiesError> {
        if records.at_level.is_some() {
            // nobody knows the records of levels that are not there
            return Ok(None);
        }
        let first = measure.levels[0];
        // below the foot of any curve a level would be refused
        let curves = hazard.iter().flat_map(|site| {
            let branches = site.branches.iter().map(|branch| &branch.input);
            std::iter::once(&site.curve).chain(branches).map(|input| input.curve.first().im)
        });
        let Some(least) = curves.reduce(f64::max) else { return Ok(None) };
        let mut starts = lower_starts(first, least);
        // what a study cannot say is not proposed: a curve may begin at any number
        starts.truncate(starts.partition_point(|&start| measure.starting_at(start).is_ok()));
        let widest = match starts.last() {
            Some(&start) => measure.starting_at(start).map_err(|error| JobError::input(error.to_string()))?,
            None => measure.clone(),
        };
        let of_strength = records.records.len() * widest.levels.len();
        let parts = (QUICK_ANALYSES / of_strength.max(1)).clamp(LEAST_TRIED, study.strengths.len().max(LEAST_TRIED));
        let tried: Vec<usize> = tried(&study.strengths, parts);
        if tried.is_empty() || of_strength * tried.len() > MOST_ANALYSES {
            return Ok(None);
        }
        let oscillators: Vec<System> = tried.iter().map(|&strength| systems[strength].clone()).collect();
        let plan = plan_stripes(study, &widest, records, &oscillators)?;
        let peaks = analyse(&plan, &Unwatched)?;
        Ok(Some(Self {
            study,
            hazard,
            starts,
            tried,
            levels: widest.levels.clone(),
            axes: peaks.axes(),
            edp_m: peaks.displacement_m().to_vec(),
            reading: Reading::from_study(study)?,
        }))
    }

    /// What the spectra of each site and probability take from outside the levels if the first is `start`.
    fn tails(&self, start: f64) -> Result<Vec<Tails<'a>>, StudiesError> {
        let dropped = self.levels.partition_point(|level| *level < start * (1.0 - 1e-9));
        let levels = &self.levels[dropped..];
        let Axes { motions, systems, scales } = self.axes;
        let weights =
            |site: &SiteHazard| StripeWeights::from_hazard(&site.curve.curve, levels, self.study.risk.extrapolate);
        let weights = self.hazard.iter().map(weights).collect::<Result<Vec<_>, _>>()?;
        let mut all = untried(self.study, self.hazard);
        for system in 0..systems {
            let edp_m = &self.edp_m[system * scales + dropped..];
            let demand = PooledDemand::new(&Stripe::strided(levels, edp_m, motions, systems * scales)?)?;
            for (weights, of_site) in weights.iter().zip(all.chunks_mut(self.study.risk.poe.len())) {
                let ordinates = self.reading.ordinates(&RiskCurve::new(&demand, weights)?)?;
                for (tails, ordinate) in of_site.iter_mut().zip(ordinates) {
                    tails.lower.push(ordinate.lower_tail_share);
                    tails.upper.push(ordinate.upper_tail_share);
                }
            }
        }
        Ok(all)
    }
}

#[cfg(test)]
mod tests {
    use super::tried;

    #[test]
    fn the_strengths_tried_span_those_of_the_study() {
        let strengths: Vec<f64> = (0..=300).map(|i| f64::from(i) / 300.0).collect();
        assert_eq!(tried(&strengths, 4), [1, 75, 150, 225, 300]);
        assert_eq!(tried(&[0.0, 0.3], 4), [1]);
        assert_eq!(tried(&[0.1, 0.2, 0.3], 4), [0, 1, 2]);
        assert_eq!(tried(&[0.0], 4), [0; 0]);
        assert_eq!(tried(&strengths, strengths.len()), (1..=300).collect::<Vec<_>>());
    }
}
