//! Sets drawn from a population, with the bands of their plain and repaired spectra.

use std::collections::BTreeMap;

use rayon::prelude::*;
use uplift::consistency::Question;
use uplift::result::{ResultFile, StoredMeasure, StoredStripes};
use uplift_bootstrap::{Band, Replicates, ResamplingPlan, inferred_limits, units, weighted_replicates};
use uplift_consistency::{
    DEFAULT_SMOOTHNESS, Exponents, RecordSet, RepairOptions, Repaired, ScaledAnalysis, Scratch, Solver,
};
use uplift_fragility::Stripes;
use uplift_hazard::Extrapolation;
use uplift_risk::{PooledDemand, RecordSample, RiskCurve, RunWeights};

use crate::tally::{Cell, Tally};

pub type Failed = Box<dyn std::error::Error + Send + Sync>;

pub const CONFIDENCE: f64 = 0.9;
/// Fewer effective records than this leave no repaired spectrum.
const TOO_FEW: f64 = 5.0;
/// Resamples of a set, for percentile bands.
const REPLICATES: usize = 200;
/// So many sets have percentile bands, evenly among all.
const RESAMPLED: usize = 20;
/// Below so many times the displacement at uplift a structure hardly rocks.
const ROCKING: f64 = 2.0;
/// Sets of earthquakes are many records: the bands of so many sites are looked at.
const EARTHQUAKE_SITES: usize = 2;

/// By band and size.
pub type Tallies = BTreeMap<(&'static str, u32), Tally>;

/// The records of a result, which stand for the world.
pub struct Population {
    pub stored: StoredStripes,
    pub file: ResultFile,
    pub question: Question,
}

impl Population {
    pub fn open(path: &std::path::Path) -> Result<Self, Failed> {
        let file = ResultFile::open(path)?;
        Ok(Self { stored: StoredStripes::read(&file)?, question: Question::from_result(&file)?, file })
    }

    /// Whether its records share earthquakes.
    pub fn shares_earthquakes(&self) -> bool {
        self.question.shares_earthquakes()
    }

    /// Positions of the probabilities up to 10 %.
    pub fn rare(&self) -> Vec<usize> {
        (0..self.stored.poes.len()).filter(|&poe| self.stored.poes[poe] < 0.2).collect()
    }

    /// Bands of the plain and of the repaired spectra of sets of records, drawn one by one with replacement. A set that
    /// cannot be repaired has no repaired band.
    pub fn records(&self, sizes: &[u32], sets: usize) -> Result<Tallies, Failed> {
        let plan = ResamplingPlan::draw(self.stored.records.len(), sizes, sets, 1)?;
        let mut all = Tallies::new();
        for (im, measure) in self.stored.measures.iter().enumerate() {
            let Some(other) = self.stored.measures.iter().find(|own| own.measure != measure.measure) else { continue };
            let set = self.question.set(measure.measure, other.measure)?;
            let demands = (0..self.stored.strengths.len()).map(|strength| measure.demand(strength));
            let demands = demands.collect::<Result<Vec<PooledDemand>, _>>()?;
            for site in 0..self.stored.sites.len() {
                let curve = |of| self.file.mean_curve(&self.stored.sites[site], of);
                let (Some(own), Some(compared)) = (curve(measure.measure)?, curve(other.measure)?) else { continue };
                let targets = &self.stored.targets_per_year;
                let levels = &measure.levels;
                let analysis = ScaledAnalysis::new(&set, levels, &own, &compared, targets, Extrapolation::Refuse)?;
                let of_all = &analysis.repair(&RepairOptions::default())?;
                let place = Place {
                    population: self,
                    measure,
                    at: [im, site],
                    set: &set,
                    of_all,
                    demands: &demands,
                    resampled_each: (sets / RESAMPLED).max(1),
                };
                for (position, &size) in sizes.iter().enumerate() {
                    let samples = &plan.samples()[position * sets..(position + 1) * sets];
                    let one =
                        |(number, sample): (usize, &RecordSample)| place.of_set(&analysis, (number, size), sample);
                    for tallies in samples.par_iter().enumerate().map(one).collect::<Result<Vec<_>, Failed>>()? {
                        for (key, tally) in tallies {
                            all.entry(key).or_default().join(tally);
                        }
                    }
                }
            }
        }
        Ok(all)
    }

    /// Bands of the plain spectra of sets of earthquakes, drawn with all their records.
    pub fn earthquakes(&self, sizes: &[u32], sets: usize) -> Result<Tallies, Failed> {
        let earthquakes = units(&self.question.event_of());
        let plan = ResamplingPlan::draw(earthquakes.len(), sizes, sets, 2)?;
        let mut all = Tallies::new();
        for (im, measure) in self.stored.measures.iter().enumerate() {
            let one = |(at, sample): (usize, &RecordSample)| -> Result<Tallies, Failed> {
                let (mut found, size, number) = (Tallies::new(), sizes[at / sets], at % sets);
                let (mut drawn, mut of_units) = (Vec::new(), Vec::new());
                for event in written_out(sample.multiplicities()) {
                    let first = drawn.len();
                    drawn.extend(&earthquakes[event]);
                    of_units.push((first..drawn.len()).collect::<Vec<usize>>());
                }
                let records: Vec<Vec<usize>> = (0..drawn.len()).map(|record| vec![record]).collect();
                for strength in 0..self.stored.strengths.len() {
                    let demand = rows(measure, &drawn, strength)?;
                    for (site, weights) in measure.weights.iter().enumerate().take(EARTHQUAKE_SITES) {
                        for (name, units) in [("by record", &records), ("by earthquake", &of_units)] {
                            let asked = (&[units.len()][..], CONFIDENCE);
                            let targets = &self.stored.targets_per_year;
                            let limits = inferred_limits(&demand, weights, units, targets, asked)?;
                            for (poe, limits) in limits.iter().enumerate() {
                                let truth_m = measure.exact_m[[site, poe, strength]];
                                let cell = (number, [im, site, poe, strength]);
                                see(&mut found, (name, size), cell, limits.truth_m, truth_m);
                            }
                        }
                    }
                }
                Ok(found)
            };
            for tallies in plan.samples().par_iter().enumerate().map(one).collect::<Result<Vec<_>, Failed>>()? {
                for (key, tally) in tallies {
                    all.entry(key).or_default().join(tally);
                }
            }
        }
        Ok(all)
    }
}

/// A measure at a site.
struct Place<'a> {
    population: &'a Population,
    measure: &'a StoredMeasure,
    at: [usize; 2],
    set: &'a RecordSet,
    /// The population's own weights.
    of_all: &'a Repaired,
    /// Of the whole population, `[strength]`.
    demands: &'a [PooledDemand],
    /// One set of so many is resampled.
    resampled_each: usize,
}

impl Place<'_> {
    /// The bands of a drawn set.
    fn of_set(
        &self,
        analysis: &ScaledAnalysis<'_>,
        (number, size): (usize, u32),
        sample: &RecordSample,
    ) -> Result<Tallies, Failed> {
        let ([im, site], stored) = (self.at, &self.population.stored);
        let targets = &stored.targets_per_year;
        let multiplicities = sample.multiplicities();
        let drawn: Vec<usize> = written_out(multiplicities).collect();
        let alone: Vec<Vec<usize>> = (0..drawn.len()).map(|record| vec![record]).collect();
        let demands = (0..stored.strengths.len()).map(|strength| rows(self.measure, &drawn, strength));
        let demands = demands.collect::<Result<Vec<PooledDemand>, Failed>>()?;
        let stripes = &self.measure.weights[site];
        let resamples = match number % self.resampled_each {
            0 => Some(ResamplingPlan::draw(drawn.len(), &[size], REPLICATES, 2 + number as u64)?),
            _ => None,
        };
        let mut found = Tallies::new();
        let cell = |[poe, strength]: [usize; 2]| (number, [im, site, poe, strength]);
        // of all ordinates, and of those at which the structure rocks
        let see_both = |found: &mut Tallies, [all, rocking]: [&'static str; 2], cell, limits_m, truth_m| {
            see(found, (all, size), cell, limits_m, truth_m);
            if truth_m >= ROCKING * stored.uplift_displacement_m {
                see(found, (rocking, size), cell, limits_m, truth_m);
            }
        };
        for (strength, demand) in demands.iter().enumerate() {
            let limits = inferred_limits(demand, stripes, &alone, targets, (&[drawn.len()], CONFIDENCE))?;
            let replicates = resamples.as_ref().map(|plan| Replicates::from_plan(demand, &[stripes], targets, plan));
            let replicates = replicates.transpose()?;
            for (poe, limits) in limits.iter().enumerate() {
                let truth_m = self.measure.exact_m[[site, poe, strength]];
                see_both(&mut found, ["plain", "plain, rocking"], cell([poe, strength]), limits.truth_m, truth_m);
                if let Some(replicates) = &replicates {
                    let band_m = percentile(replicates.ordinates_m(0, poe, 0));
                    see(&mut found, ("plain, percentile", size), cell([poe, strength]), band_m, truth_m);
                }
            }
        }

        let of_all = self.of_all;
        let Some((weights, exponents)) = weights_of_set(analysis, &of_all.fit.exponents, multiplicities)? else {
            found.entry(("repaired", size)).or_default().refuse();
            return Ok(found);
        };
        let (solver, mut scratch) = (Solver::new(analysis, DEFAULT_SMOOTHNESS)?, Scratch::default());
        let all = self.set.len();
        let resampled = |plan: &ResamplingPlan| -> Result<Vec<f64>, Failed> {
            let of_population = |sample: &RecordSample| {
                let mut times = vec![0; all];
                sample.multiplicities().iter().zip(&drawn).for_each(|(count, &record)| times[record] += count);
                RecordSample::new(times)
            };
            let samples = plan.samples().iter().map(of_population).collect::<Result<Vec<_>, _>>()?;
            let weigh = |sample: &RecordSample, shares: &mut [f64]| -> Result<(), Failed> {
                let own = solver.solve_sample(sample.multiplicities(), &exponents, &mut scratch)?;
                Ok(solver.shares(sample.multiplicities(), &own.exponents, &mut scratch, shares)?)
            };
            weighted_replicates(self.demands, stripes, targets, &samples, weigh)
        };
        let resampled = resamples.as_ref().map(resampled).transpose()?;
        for (strength, demand) in demands.iter().enumerate() {
            let truths = RiskCurve::weighted(&self.demands[strength], &of_all.weights)?.exact_ordinates(targets)?;
            let limits = inferred_limits(demand, &weights, &alone, targets, (&[drawn.len()], CONFIDENCE))?;
            for (poe, (limits, truth)) in limits.iter().zip(&truths).enumerate() {
                let truth_m = truth.displacement_m;
                see_both(&mut found, ["repaired", "repaired, rocking"], cell([poe, strength]), limits.truth_m, truth_m);
                if let Some(resampled) = &resampled {
                    let of_cell = &resampled[(strength * targets.len() + poe) * REPLICATES..][..REPLICATES];
                    let band_m = percentile(of_cell);
                    see(&mut found, ("repaired, percentile", size), cell([poe, strength]), band_m, truth_m);
                }
            }
        }
        Ok(found)
    }
}

/// The weights of a set drawn from the records of an `analysis`, solved from these `exponents` on, with its own
/// exponents; none where it cannot be repaired.
pub fn weights_of_set(
    analysis: &ScaledAnalysis<'_>,
    exponents: &Exponents,
    multiplicities: &[u32],
) -> Result<Option<(RunWeights, Exponents)>, Failed> {
    let (solver, mut scratch) = (Solver::new(analysis, DEFAULT_SMOOTHNESS)?, Scratch::default());
    let fit = solver.solve(multiplicities, exponents, &mut scratch)?;
    let (all, levels) = (multiplicities.len(), analysis.stripes().level_count());
    let drawn: Vec<usize> = written_out(multiplicities).collect();
    let mut shares = vec![0.0; levels * all];
    solver.shares(multiplicities, &fit.exponents, &mut scratch, &mut shares)?;
    let calibration = solver.calibration(multiplicities, &fit.exponents, &mut scratch, &shares)?;
    let calibration = calibration.iter().map(|own| drawn.iter().map(|&record| own[record]).collect()).collect();
    let shares: Vec<f64> = (0..levels)
        .flat_map(|level| drawn.iter().map(move |&record| (level * all + record, record)))
        .map(|(place, record)| shares[place] / f64::from(multiplicities[record]))
        .collect();
    let effective = |level: usize| {
        1.0 / shares[level * drawn.len()..][..drawn.len()].iter().map(|share| share * share).sum::<f64>()
    };
    let is_enough = (0..levels).filter(|&level| analysis.is_in_range(level)).all(|at| effective(at) >= TOO_FEW);
    if !(fit.is_reached() && is_enough) {
        return Ok(None);
    }
    Ok(Some((RunWeights::new(analysis.stripes(), &shares)?.with_calibration(calibration)?, fit.exponents)))
}

/// The band of a cell, but for a truth of 0.
pub fn see(found: &mut Tallies, key: (&'static str, u32), cell: (usize, Cell), limits_m: [f64; 2], truth_m: f64) {
    if truth_m > 0.0 {
        found.entry(key).or_default().see(cell, limits_m, truth_m);
    }
}

fn percentile(replicates_m: &[f64]) -> [f64; 2] {
    let mut sorted = replicates_m.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let band = Band::percentile(&sorted, CONFIDENCE);
    [band.lower_m, band.upper_m]
}

/// Each position as often as it is drawn.
pub fn written_out(multiplicities: &[u32]) -> impl Iterator<Item = usize> + '_ {
    multiplicities.iter().enumerate().flat_map(|(position, &times)| (0..times).map(move |_| position))
}

/// The runs of the drawn records at a strength.
fn rows(measure: &StoredMeasure, drawn: &[usize], strength: usize) -> Result<PooledDemand, Failed> {
    let edp_m: Vec<f64> =
        drawn.iter().flat_map(|&record| measure.edp_m.block([record, strength]).iter().copied()).collect();
    Ok(PooledDemand::new(&Stripes::new(&measure.levels, &edp_m)?)?)
}
