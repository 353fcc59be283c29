//! A world whose truth is known, and a twin of it that is only looked at through scaled records: what the spectra of
//! both are worth, as they are and repaired. `cargo run --release -p uplift-consistency --example twin_world`.
//!
//! The true world has a hazard of PGV, and at each level of PGV a distribution of ln(PGA/PGV) with its own mean and
//! scatter. The records are made to have it by shares of maximum entropy: from them follow the true hazard of PGA and
//! the true spectra. The twin knows both hazard curves, and the records without their shares.
//!
//! The truth is made of the same records: this tests the method, and not whether a set is right.
#![allow(clippy::print_stdout)]

use std::error::Error;

use uplift_consistency::{RecordSet, RepairOptions, ScaledAnalysis, Seismology, SetRecord};
use uplift_fragility::Stripes;
use uplift_hazard::{Extrapolation, HazardCurve, rate_from_probability};
use uplift_ida::{Plan, StripeRecord, System, Unwatched, analyse};
use uplift_motion::synthetic::{SyntheticSetOptions, generate};
use uplift_motion::{IntensityMeasure, RecordPair, STANDARD_GRAVITY_M_S2 as G};
use uplift_oscillator::Oscillator;
use uplift_risk::{PooledDemand, RiskCurve, RunWeights, StripeWeights};

const STRENGTHS: [f64; 6] = [0.05, 0.1, 0.2, 0.3, 0.4, 0.6];

/// Spectra over the true ones, of the ordinates in one class of displacement.
pub(crate) struct Row {
    /// Which spectra.
    pub(crate) name: &'static str,
    /// Geometric mean of the ratios, and root mean square of their logarithm, where the truth is 10 mm and more.
    pub(crate) large: [f64; 2],
    /// The same from 0.5 to 10 mm.
    pub(crate) small: [f64; 2],
}

/// Stripes of a measure, and what oscillators come to at them.
struct Scaled {
    set: RecordSet,
    levels: Vec<f64>,
    /// `[strength]`.
    demands: Vec<PooledDemand>,
}

impl Scaled {
    fn new(
        pairs: &[RecordPair],
        own: IntensityMeasure,
        other: IntensityMeasure,
        levels: Vec<f64>,
    ) -> Result<Self, Box<dyn Error>> {
        let row = |(pair, record): (usize, &RecordPair)| SetRecord {
            scaled_to: own.pair_value(record, G),
            other: other.pair_value(record, G),
            pair,
            event: None,
            seismology: Seismology::default(),
        };
        let set = RecordSet::new(pairs.iter().enumerate().map(row).collect())?;
        let records = pairs
            .iter()
            .map(|pair| StripeRecord { id: &pair.id, accelerogram: &pair.h1, intensity: own.pair_value(pair, G) })
            .collect();
        let systems: Vec<System> = STRENGTHS
            .into_iter()
            .map(|strength| Oscillator::zsbe(strength).map(System::Oscillator))
            .collect::<Result<_, _>>()?;
        let peaks = analyse(&Plan::stripes(records, &systems, &levels, true)?, &Unwatched)?;
        let demand = |strength| -> Result<PooledDemand, Box<dyn Error>> {
            Ok(PooledDemand::new(&Stripes::new(&levels, &peaks.system_m(strength))?)?)
        };
        let demands = (0..STRENGTHS.len()).map(demand).collect::<Result<_, _>>()?;
        Ok(Self { set, levels, demands })
    }

    /// Ordinates `[strength][target]`, m, of records that count alike or with weights.
    fn spectra(
        &self,
        alike: &StripeWeights,
        weights: Option<&RunWeights>,
        targets: &[f64],
    ) -> Result<Vec<f64>, Box<dyn Error>> {
        let mut spectra_m = Vec::new();
        for demand in &self.demands {
            let curve = match weights {
                None => RiskCurve::new(demand, alike)?,
                Some(weights) => RiskCurve::weighted(demand, weights)?,
            };
            spectra_m.extend(curve.exact_ordinates(targets)?.iter().map(|ordinate| ordinate.displacement_m));
        }
        Ok(spectra_m)
    }
}

/// Shares of maximum entropy, p ∝ exp(a z + b z²), by which the z of the records have this mean and standard deviation.
fn shares(z: &[f64], mean: f64, deviation: f64) -> Vec<f64> {
    let (mut a, mut b) = (0.0, 0.0);
    let shares = |a: f64, b: f64| {
        let largest = z.iter().map(|z| a * z + b * z * z).fold(f64::NEG_INFINITY, f64::max);
        let all: Vec<f64> = z.iter().map(|z| (a * z + b * z * z - largest).exp()).collect();
        let total: f64 = all.iter().sum();
        all.into_iter().map(|share| share / total).collect::<Vec<f64>>()
    };
    // Newton's method for both moments, on a convex problem
    for _ in 0..100 {
        let p = shares(a, b);
        let moment = |power: i32| p.iter().zip(z).map(|(p, z)| p * z.powi(power)).sum::<f64>();
        let [m1, m2, m3, m4] = [1, 2, 3, 4].map(moment);
        let residual = [mean - m1, mean * mean + deviation * deviation - m2];
        let (aa, ab, bb) = (m2 - m1 * m1, m3 - m1 * m2, m4 - m2 * m2);
        let determinant = aa * bb - ab * ab;
        a += 0.5 * (bb * residual[0] - ab * residual[1]) / determinant;
        b += 0.5 * (aa * residual[1] - ab * residual[0]) / determinant;
    }
    shares(a, b)
}

/// What the spectra of the twin are over those of the true world.
pub(crate) fn compare(pairs: &[RecordPair]) -> Result<Vec<Row>, Box<dyn Error>> {
    let (pgv, pga) = (IntensityMeasure::Pgv, IntensityMeasure::Pga);
    let rising =
        |first: f64, ratio: f64, count: i32| (0..count).map(move |i| first * ratio.powi(i)).collect::<Vec<f64>>();
    let by_pgv = Scaled::new(pairs, pgv, pga, rising(0.1, 1.1, 80))?;
    let by_pga = Scaled::new(pairs, pga, pgv, rising(0.001, 1.1, 80))?;
    // strong seismicity, bending down as curves do
    let levels_cm_s = rising(0.05, 1.2, 50);
    let rate = |level: &f64| 0.5 * (1.0 + level / 2.0).powf(-1.1) * (1.0 + level / 60.0).powf(-1.9);
    let hazard_of_pgv =
        HazardCurve::new("PGV", "cm/s", "", levels_cm_s.clone(), levels_cm_s.iter().map(rate).collect())?;
    let targets =
        [0.02, 0.1, 0.5].map(|poe| rate_from_probability(poe, 50.0)).into_iter().collect::<Result<Vec<_>, _>>()?;
    let stripes = StripeWeights::from_hazard(&hazard_of_pgv, &by_pgv.levels, Extrapolation::Refuse)?;

    // the true world: at rare PGV the site's motions have less PGA for it, as strong earthquakes have
    let z: Vec<f64> = by_pgv.set.ratios().iter().map(|ratio| ratio.ln()).collect();
    let centre = z.iter().sum::<f64>() / z.len() as f64;
    let deviation = (z.iter().map(|z| (z - centre).powi(2)).sum::<f64>() / z.len() as f64).sqrt();
    let of_level = |level: &f64| shares(&z, centre + 0.25 - 0.08 * (level / 10.0).ln(), 0.95 * deviation);
    let truth = RunWeights::new(&stripes, &by_pgv.levels.iter().flat_map(of_level).collect::<Vec<f64>>())?;
    let brought: Vec<f64> = by_pgv.set.ratios().iter().flat_map(|q| by_pgv.levels.iter().map(move |x| x * q)).collect();
    let brought = PooledDemand::new(&Stripes::new(&by_pgv.levels, &brought)?)?;
    let implied = RiskCurve::weighted(&brought, &truth)?;
    let levels_g = rising(0.0005, 1.12, 90);
    let rates = levels_g.iter().map(|level| implied.mean_annual_frequency(*level)).collect::<Result<Vec<_>, _>>()?;
    let falling: Vec<usize> = (1..rates.len()).filter(|&i| rates[i] < rates[i - 1] && rates[i] > 1e-7).collect();
    let (im, maf) = falling.into_iter().map(|i| (levels_g[i], rates[i])).unzip();
    let hazard_of_pga = HazardCurve::new("PGA", "g", "", im, maf)?;
    let true_m = by_pgv.spectra(&stripes, Some(&truth), &targets)?;

    let mut rows = Vec::new();
    for (name, repaired, scaled, own, other) in [
        ("by PGV", "by PGV, repaired", &by_pgv, &hazard_of_pgv, &hazard_of_pga),
        ("by PGA", "by PGA, repaired", &by_pga, &hazard_of_pga, &hazard_of_pgv),
    ] {
        let analysis = ScaledAnalysis::new(&scaled.set, &scaled.levels, own, other, &targets, Extrapolation::LogLog)?;
        let weights = analysis.repair(&RepairOptions::default())?.weights;
        for (name, weights) in [(name, None), (repaired, Some(&weights))] {
            let spectra_m = scaled.spectra(analysis.stripes(), weights, &targets)?;
            let class = |from_m: f64, below_m: f64| {
                let ratios = spectra_m.iter().zip(&true_m).filter(|(_, truth)| (from_m..below_m).contains(*truth));
                let logarithms: Vec<f64> = ratios.map(|(found, truth)| (found / truth).ln()).collect();
                let mean = |of: fn(&f64) -> f64| logarithms.iter().map(of).sum::<f64>() / logarithms.len() as f64;
                [mean(|ratio| *ratio).exp(), mean(|ratio| ratio * ratio).sqrt()]
            };
            rows.push(Row { name, large: class(0.01, f64::INFINITY), small: class(0.0005, 0.01) });
        }
    }
    Ok(rows)
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("spectra over the true ones: geometric mean, rms of the logarithm");
    println!("{:<18} {:>14} {:>14}", "", "from 10 mm", "0.5 to 10 mm");
    for Row { name, large, small } in compare(&generate(&SyntheticSetOptions::default())?)? {
        println!("{name:<18} {:>7.2} {:>6.2} {:>7.2} {:>6.2}", large[0], large[1], small[0], small[1]);
    }
    Ok(())
}
