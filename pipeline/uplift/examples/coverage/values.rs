//! Bands of `uplift target`: of the width of a frame that overturns as often as a target allows, of drawn sets.

use std::path::Path;

use rayon::prelude::*;
use uplift_bootstrap::{ResamplingPlan, crossing, falling, inferred_mean, inferred_weighted_rate, units};
use uplift_consistency::{RepairOptions, ScaledAnalysis};
use uplift_hazard::Extrapolation;
use uplift_ida::{Peaks, System, Unwatched, analyse};
use uplift_structure::Quantity;
use uplift_uniform_risk::{SpectraOfResult, StudyOfResult, plan_levels};

use crate::sets::{CONFIDENCE, Failed, Population, Tallies, see, weights_of_set, written_out};

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
            for site in 0..measure.weights.len() {
                let drawn = Drawn { sizes, sets, plan: &plan };
                let place = Place { population: self, source: &source, values: &values, peaks: &peaks, at: [im, site] };
                place.plain(&drawn, &mut all)?;
                place.repaired(&drawn, &mut all)?;
            }
        }
        Ok(all)
    }
}

/// The sets that are drawn, so many of each size.
struct Drawn<'a> {
    sizes: &'a [u32],
    sets: usize,
    plan: &'a ResamplingPlan,
}

impl Drawn<'_> {
    /// The limits that each set of the size at `position` has at every value.
    fn limits<T: Send>(
        &self,
        position: usize,
        limits: impl Fn(&[u32]) -> Result<T, Failed> + Sync,
    ) -> Result<Vec<T>, Failed> {
        let samples = &self.plan.samples()[position * self.sets..][..self.sets];
        samples.par_iter().map(|sample| limits(sample.multiplicities())).collect()
    }
}

/// A measure at a site.
struct Place<'a> {
    population: &'a Population,
    source: &'a StudyOfResult,
    values: &'a [f64],
    /// Of the oscillators of all values.
    peaks: &'a Peaks,
    at: [usize; 2],
}

impl Place<'_> {
    /// Bands by records that count alike.
    fn plain(&self, drawn: &Drawn<'_>, all: &mut Tallies) -> Result<(), Failed> {
        let [im, site] = self.at;
        let per_year = self.source.measures[im].weights[site].per_year();
        let of_run = |value: usize, record: usize| -> f64 {
            let runs = self.peaks.row_m(record, value).iter().zip(&per_year);
            runs.filter(|(peak_m, _)| peak_m.is_infinite()).map(|(_, weight)| weight).sum()
        };
        let records = self.peaks.axes().motions;
        let of_value = |value| -> Vec<f64> { (0..records).map(|record| of_run(value, record)).collect() };
        let contributions: Vec<Vec<f64>> = (0..self.values.len()).map(of_value).collect();
        // of single records: what is drawn falls as the whole does
        let fallen = falling(self.values, &contributions.iter().map(Vec::as_slice).collect::<Vec<_>>());
        let rates: Vec<f64> = fallen.iter().map(|of| of.iter().sum::<f64>() / of.len() as f64).collect();
        for (position, &size) in drawn.sizes.iter().enumerate() {
            let alone = units(&(0..size as usize).collect::<Vec<_>>());
            let limits = drawn.limits(position, |multiplicities| {
                let band = |of: &Vec<f64>| {
                    let own: Vec<f64> = written_out(multiplicities).map(|record| of[record]).collect();
                    Ok(inferred_mean(&own, &alone, CONFIDENCE)?)
                };
                fallen.iter().map(band).collect::<Result<_, Failed>>().map(Some)
            })?;
            self.see(("width by target", size), &rates, &limits, all);
        }
        Ok(())
    }

    /// Bands with the weights of a repair, which every set solves for itself; none where the whole has no repair.
    fn repaired(&self, drawn: &Drawn<'_>, all: &mut Tallies) -> Result<(), Failed> {
        let ([im, site], Population { file, question, stored }) = (self.at, self.population);
        let measure = &self.source.measures[im];
        let other = self.source.measures.iter().find(|own| own.measure() != measure.measure()).ok_or("one measure")?;
        let curve = |of: &SpectraOfResult| file.mean_curve(&self.source.sites[site], of.measure());
        let (Some(own), Some(compared)) = (curve(measure)?, curve(other)?) else { return Ok(()) };
        let set = question.set(measure.measure(), other.measure())?;
        let (targets, levels) = (&stored.targets_per_year, &measure.plan.levels);
        let analysis = ScaledAnalysis::new(&set, levels, &own, &compared, targets, Extrapolation::Refuse)?;
        let of_all = analysis.repair(&RepairOptions::default())?;
        let happens = |value: usize| -> Vec<f64> {
            let rows = (0..set.len()).flat_map(|record| self.peaks.row_m(record, value));
            rows.map(|peak_m| f64::from(u8::from(peak_m.is_infinite()))).collect()
        };
        let happens: Vec<Vec<f64>> = (0..self.values.len()).map(happens).collect();
        // of single runs: what is drawn falls as the whole does
        let fallen = falling(self.values, &happens.iter().map(Vec::as_slice).collect::<Vec<_>>());
        let alone = units(&(0..set.len()).collect::<Vec<_>>());
        let rate = |of: &Vec<f64>| Ok(inferred_weighted_rate(of, &of_all.weights, &alone, CONFIDENCE)?.0);
        let rates = fallen.iter().map(rate).collect::<Result<Vec<f64>, Failed>>()?;
        for (position, &size) in drawn.sizes.iter().enumerate() {
            let alone = units(&(0..size as usize).collect::<Vec<_>>());
            let limits = drawn.limits(position, |multiplicities| {
                let weights = weights_of_set(&analysis, &of_all.fit.exponents, multiplicities)?;
                let Some((weights, _)) = weights else { return Ok(None) };
                let band = |of: &Vec<f64>| {
                    let of_record = |record: usize| &of[record * levels.len()..][..levels.len()];
                    let runs: Vec<f64> = written_out(multiplicities).flat_map(of_record).copied().collect();
                    Ok(inferred_weighted_rate(&runs, &weights, &alone, CONFIDENCE)?.1)
                };
                fallen.iter().map(band).collect::<Result<_, Failed>>().map(Some)
            })?;
            self.see(("width, repaired", size), &rates, &limits, all);
        }
        Ok(())
    }

    /// The band of the width of each set, by the limits of the rate at every value, against the width by the `rates` of
    /// the whole.
    fn see(&self, key: (&'static str, u32), rates: &[f64], of_sets: &[Option<Vec<[f64; 2]>>], all: &mut Tallies) {
        let [im, site] = self.at;
        for (target, years) in RETURN_PERIODS.iter().enumerate() {
            let meets = |rates: Vec<f64>| crossing(self.values, rates.into_iter(), 1.0 / years);
            let truth = meets(rates.to_vec());
            if truth <= self.values[0] || truth.is_infinite() {
                continue;
            }
            for (number, limits) in of_sets.iter().enumerate() {
                match limits {
                    None => all.entry(key).or_default().refuse(),
                    Some(limits) => {
                        let band = [0, 1].map(|end| meets(limits.iter().map(|of| of[end]).collect()));
                        see(all, key, (number, [im, site, target, 0]), band, truth);
                    }
                }
            }
        }
    }
}
