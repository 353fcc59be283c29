//! Bands of the rate of overturning by a lognormal fragility, of drawn sets.

use std::path::Path;

use rayon::prelude::*;
use uplift_bootstrap::{ResamplingPlan, contributions, inferred_mean, units};
use uplift_fragility::{LognormalFit, Stripes, fit_lognormal, fits_without_each, stripe_counts};
use uplift_ida::{System, Unwatched, analyse};
use uplift_risk::StripeWeights;
use uplift_uniform_risk::{StudyOfResult, plan_levels};

use crate::sets::{CONFIDENCE, Failed, Population, Tallies, see, written_out};

/// A threshold that nothing but overturning exceeds, m.
const OVERTURNING_M: f64 = f64::MAX;

impl Population {
    /// Bands of the rate of overturning of a frame's oscillator, of sets of records drawn one by one with replacement.
    /// The truth is the rate by the fragility of all records. A set of which a fit hangs on one record has no band.
    pub fn lognormal(&self, sizes: &[u32], sets: usize) -> Result<Tallies, Failed> {
        let structure = uplift_study::Structure::load(Path::new("configs/structures/frame.toml"))?;
        let source = StudyOfResult::read(&self.file, None)?;
        let records = source.records()?;
        let restitution = structure.description.restitution.unwrap_or(source.study.oscillator.restitution);
        let systems = [System::Oscillator(structure.system.spectral_oscillator(restitution)?)];
        let plan = ResamplingPlan::draw(records.records.len(), sizes, sets, 1)?;
        let mut all = Tallies::new();
        for (im, measure) in source.measures.iter().enumerate() {
            let levels: &[f64] = &measure.plan.levels;
            let peaks =
                analyse(&plan_levels(&source.study, (measure.measure(), levels), &records, &systems)?, &Unwatched)?;
            let rows =
                |of: &[usize]| -> Vec<f64> { of.iter().flat_map(|&record| peaks.row_m(record, 0).to_vec()).collect() };
            let rate = |fit: &LognormalFit, weights: &StripeWeights| -> Result<f64, Failed> {
                let shares: Vec<f64> = levels.iter().map(|&level| fit.fragility.probability(level)).collect();
                Ok(weights.disaggregate(&shares)?.total_per_year())
            };
            let of_all = rows(&(0..records.records.len()).collect::<Vec<_>>());
            let of_all = fit_lognormal(&stripe_counts(&Stripes::new(levels, &of_all)?, OVERTURNING_M)?)?;
            for (position, &size) in sizes.iter().enumerate() {
                let alone = units(&(0..size as usize).collect::<Vec<_>>());
                // the bands of every site; none without a fit
                let limits = |number: usize| -> Result<Option<Vec<[f64; 2]>>, Failed> {
                    let sample = plan.samples()[position * sets + number].multiplicities();
                    let drawn = rows(&written_out(sample).collect::<Vec<_>>());
                    let stripes = Stripes::new(levels, &drawn)?;
                    let own = fit_lognormal(&stripe_counts(&stripes, OVERTURNING_M)?);
                    let (Ok(own), Ok(without)) = (own, fits_without_each(&stripes, OVERTURNING_M, &alone)) else {
                        return Ok(None);
                    };
                    let of_site = |weights: &StripeWeights| {
                        let rates = without.iter().map(|fit| rate(fit, weights)).collect::<Result<Vec<_>, Failed>>()?;
                        Ok(inferred_mean(&contributions(rate(&own, weights)?, &rates), &alone, CONFIDENCE)?)
                    };
                    measure.weights.iter().map(of_site).collect::<Result<Vec<_>, Failed>>().map(Some)
                };
                let of_sets = (0..sets).into_par_iter().map(limits).collect::<Result<Vec<_>, Failed>>()?;
                for (site, weights) in measure.weights.iter().enumerate() {
                    let truth = rate(&of_all, weights)?;
                    for (number, limits) in of_sets.iter().enumerate() {
                        let key = ("lognormal rate", size);
                        match limits {
                            Some(limits) => see(&mut all, key, (number, [im, site, 0, 0]), limits[site], truth),
                            None => all.entry(key).or_default().refuse(),
                        }
                    }
                }
            }
        }
        Ok(all)
    }
}
