//! Bands of `uplift target`: of the width of a frame that overturns as often as a target allows, of drawn sets.

use std::path::Path;

use rayon::prelude::*;
use uplift_bootstrap::{ResamplingPlan, crossing, falling, inferred_mean, units};
use uplift_ida::{System, Unwatched, analyse};
use uplift_structure::Quantity;
use uplift_uniform_risk::{StudyOfResult, plan_levels};

use crate::sets::{CONFIDENCE, Failed, Population, Tallies, see, written_out};

/// Targets: 2 and 10 % in 50 years, as of the spectra, and two that are rarer.
const RETURN_PERIODS: [f64; 4] = [2475.0, 475.0, 5000.0, 10_000.0];
/// Widths about the frame's own, each 4 % above the one before: as `uplift target` tries them within a band.
const VALUES: i32 = 71;
const STEP: f64 = 1.04;

impl Population {
    /// Bands of the width of sets of records, drawn one by one with replacement. The truth is the width by all records;
    /// where it is none of those tried there is no cell.
    pub fn values(&self, sizes: &[u32], sets: usize) -> Result<Tallies, Failed> {
        let structure = uplift_study::Structure::load(Path::new("configs/structures/frame.toml"))?;
        let source = StudyOfResult::read(&self.file, None)?;
        let records = source.records()?;
        let restitution = structure.description.restitution.unwrap_or(source.study.oscillator.restitution);
        let no_value = |_| "the frame has no such width";
        let own = Quantity::Width.value(&structure.description).map_err(no_value)?.ok_or("the frame has no width")?;
        let values: Vec<f64> = (0..VALUES).map(|step| own * STEP.powi(step - VALUES / 2)).collect();
        let system = |&value: &f64| {
            let system = Quantity::Width.varied(&structure.description, value).map_err(no_value)?;
            Ok(System::Oscillator(system.spectral_oscillator(restitution)?))
        };
        let systems = values.iter().map(system).collect::<Result<Vec<System>, Failed>>()?;
        let plan = ResamplingPlan::draw(records.records.len(), sizes, sets, 1)?;
        let mut all = Tallies::new();
        for (im, measure) in source.measures.iter().enumerate() {
            let levels = (measure.measure(), &measure.plan.levels[..]);
            let peaks = analyse(&plan_levels(&source.study, levels, &records, &systems)?, &Unwatched)?;
            for (site, weights) in measure.weights.iter().enumerate() {
                let per_year = weights.per_year();
                let of_run = |value: usize, record: usize| -> f64 {
                    let runs = peaks.row_m(record, value).iter().zip(&per_year);
                    runs.filter(|(peak_m, _)| peak_m.is_infinite()).map(|(_, weight)| weight).sum()
                };
                let of_value =
                    |value| -> Vec<f64> { (0..records.records.len()).map(|record| of_run(value, record)).collect() };
                let contributions: Vec<Vec<f64>> = (0..values.len()).map(of_value).collect();
                // of single records: what is drawn falls as the whole does
                let fallen = falling(&values, &contributions.iter().map(Vec::as_slice).collect::<Vec<_>>());
                let means: Vec<f64> = fallen.iter().map(|of| of.iter().sum::<f64>() / of.len() as f64).collect();
                for (position, &size) in sizes.iter().enumerate() {
                    let alone = units(&(0..size as usize).collect::<Vec<_>>());
                    let limits = |number: usize| -> Result<Vec<[f64; 2]>, Failed> {
                        let drawn: Vec<usize> =
                            written_out(plan.samples()[position * sets + number].multiplicities()).collect();
                        let band = |of: &Vec<f64>| {
                            let own: Vec<f64> = drawn.iter().map(|&record| of[record]).collect();
                            Ok(inferred_mean(&own, &alone, CONFIDENCE)?)
                        };
                        fallen.iter().map(band).collect()
                    };
                    let of_sets = (0..sets).into_par_iter().map(limits).collect::<Result<Vec<_>, Failed>>()?;
                    for (target, years) in RETURN_PERIODS.iter().enumerate() {
                        let meets = |rates: &mut dyn Iterator<Item = f64>| {
                            crossing(&values, rates.collect::<Vec<_>>().into_iter(), 1.0 / years)
                        };
                        let truth = meets(&mut means.iter().copied());
                        if truth <= values[0] || truth.is_infinite() {
                            continue;
                        }
                        for (number, limits) in of_sets.iter().enumerate() {
                            let band = [0, 1].map(|end| meets(&mut limits.iter().map(|of| of[end])));
                            see(&mut all, ("width by target", size), (number, [im, site, target, 0]), band, truth);
                        }
                    }
                }
            }
        }
        Ok(all)
    }
}
