//! How often the band of `uplift target` holds the value that it is a band of, by simulation with a known truth:
//!
//! ```sh
//! uplift run configs/europe.toml -o population.h5 --set records.synthetic.pairs=400 --set 'strengths.values=[0.1]'
//! cargo run --release -p uplift-design --example target_coverage population.h5 configs/structures/frame.toml width 400
//! ```
//!
//! The records of the result stand for the world: sets of 20, 40 and 105 are drawn from them with replacement, and each
//! makes its band as if it were all there is, at every site, by every measure, for overturning at three target rates.
//! Standard errors count sets: the same sets serve all sites, measures and rates.
#![allow(clippy::print_stdout)]

use std::error::Error;
use std::path::Path;

use rayon::prelude::*;
use uplift_bootstrap::{ResamplingPlan, inferred_mean, units};
use uplift_ida::{System, Unwatched, analyse};
use uplift_result::ResultFile;
use uplift_structure::Quantity;
use uplift_uniform_risk::{StudyOfResult, plan_levels};

/// Records in a set.
const SIZES: [u32; 3] = [20, 40, 105];
/// Return periods of overturning, years.
const RETURN_PERIODS: [f64; 3] = [2475.0, 5000.0, 10000.0];
/// Values tried: so many, each 1 % above the one before, about the structure's own.
const VALUES: i32 = 251;
const STEP: f64 = 1.01;
const CONFIDENCE: f64 = 0.9;

type Failure = Box<dyn Error + Send + Sync>;

/// Limits of a value, best estimate between them; infinite beyond the values tried.
struct Band {
    lower: f64,
    best: f64,
    upper: f64,
}

/// The least of `values` from which on every rate is at most the target.
fn least(values: &[f64], per_year: impl Iterator<Item = f64>, target_per_year: f64) -> f64 {
    let missed = per_year.enumerate().filter(|(_, rate)| *rate > target_per_year).map(|(place, _)| place).last();
    missed.map_or(values[0], |place| values.get(place + 1).copied().unwrap_or(f64::INFINITY))
}

/// The band of a set, from what each of its records contributes at each value, 1/yr, `[value][record]`.
fn band(values: &[f64], contributions: &[Vec<f64>], targets: &[f64]) -> Result<Vec<Band>, Failure> {
    let alone: Vec<usize> = (0..contributions[0].len()).collect();
    let units = units(&alone);
    let limits: Vec<[f64; 2]> =
        contributions.iter().map(|of| inferred_mean(of, &units, CONFIDENCE)).collect::<Result<_, _>>()?;
    let mean = |of: &Vec<f64>| of.iter().sum::<f64>() / of.len() as f64;
    let of_target = |&target: &f64| Band {
        lower: least(values, limits.iter().map(|limits| limits[0]), target),
        best: least(values, contributions.iter().map(mean), target),
        upper: least(values, limits.iter().map(|limits| limits[1]), target),
    };
    Ok(targets.iter().map(of_target).collect())
}

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [result, structure, quantity, sets] = &arguments[..] else {
        println!("usage: target_coverage RESULT.h5 STRUCTURE.toml QUANTITY SETS");
        return Ok(());
    };
    let sets: usize = sets.parse()?;
    let quantity = Quantity::ALL.into_iter().find(|of| of.key() == quantity).ok_or("no such quantity")?;
    let structure = uplift_study::Structure::load(Path::new(structure))?;
    let source = StudyOfResult::read(&ResultFile::open(result.as_ref())?, None)?;
    let mut study = source.study.clone();
    study.oscillator.free_vibration = true;
    let restitution = structure.description.restitution.unwrap_or(study.oscillator.restitution);
    let records = source.records()?;
    let own = quantity.value(&structure.description).map_err(|_| "no value")?.ok_or("no value of its own")?;
    let values: Vec<f64> = (0..VALUES).map(|step| own * STEP.powi(step - VALUES / 2)).collect();
    let systems: Vec<System> = values
        .iter()
        .map(|&value| {
            let system =
                quantity.varied(&structure.description, value).map_err(|_| format!("no structure of {value}"))?;
            Ok(System::Oscillator(system.spectral_oscillator(restitution)?))
        })
        .collect::<Result<_, Failure>>()?;
    let targets = RETURN_PERIODS.map(f64::recip);
    let count = records.records.len();
    let drawn = ResamplingPlan::draw(count, &SIZES, sets, 1)?;
    // [size][set]: per cent held, wholly below (unsafe) and wholly above, of the bands of that set
    let mut shares = vec![vec![[0.0_f64; 4]; sets]; SIZES.len()];
    for measure in &source.measures {
        let levels = measure.plan.levels.to_vec();
        let peaks = analyse(&plan_levels(&study, (measure.measure(), &levels), &records, &systems)?, &Unwatched)?;
        for (site, weights) in source.sites.iter().zip(&measure.weights) {
            let per_year = weights.per_year();
            let of_run = |value: usize, record: usize| -> f64 {
                let overturned =
                    peaks.row_m(record, value).iter().zip(&per_year).filter(|(peak, _)| peak.is_infinite());
                overturned.map(|(_, weight)| weight).sum()
            };
            let all: Vec<Vec<f64>> =
                (0..values.len()).map(|value| (0..count).map(|record| of_run(value, record)).collect()).collect();
            let truth = band(&values, &all, &targets)?;
            let told: Vec<f64> = truth.iter().map(|of| of.best).collect();
            println!("{site}, {}: {told:.4?}", measure.measure().label());
            for (position, of_size) in shares.iter_mut().enumerate() {
                let found: Vec<Vec<Band>> = drawn.samples()[position * sets..(position + 1) * sets]
                    .par_iter()
                    .map(|sample| {
                        let times = sample.multiplicities();
                        let of_sample = |of: &Vec<f64>| -> Vec<f64> {
                            let repeated = of.iter().zip(times);
                            repeated.flat_map(|(of, &times)| (0..times).map(move |_| *of)).collect()
                        };
                        band(&values, &all.iter().map(of_sample).collect::<Vec<_>>(), &targets)
                    })
                    .collect::<Result<_, Failure>>()?;
                for (set, bands) in found.iter().enumerate() {
                    for (band, truth) in bands.iter().zip(&truth) {
                        if truth.best <= values[0] || truth.best.is_infinite() {
                            continue;
                        }
                        let [below, above] = [truth.best > band.upper, truth.best < band.lower].map(f64::from);
                        let counts = &mut of_size[set];
                        for (count, of) in counts.iter_mut().zip([1.0 - below - above, below, above, 1.0]) {
                            *count += of;
                        }
                    }
                }
            }
        }
    }
    println!("bands of 90 %, per cent of them (standard error): records in a set, held, too low, too high");
    for (size, of_size) in SIZES.iter().zip(&shares) {
        let told: Vec<String> = (0..3)
            .map(|which| {
                let of_set: Vec<f64> = of_size.iter().map(|of| 100.0 * of[which] / of[3]).collect();
                let mean = of_set.iter().sum::<f64>() / sets as f64;
                let variance = of_set.iter().map(|of| (of - mean).powi(2)).sum::<f64>() / (sets as f64 - 1.0);
                format!("{mean:6.1} ({:.1})", (variance / sets as f64).sqrt())
            })
            .collect();
        println!("{size:6} {}", told.join(" "));
    }
    Ok(())
}
