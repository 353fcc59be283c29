//! A uniform risk spectrum of your own system, here a sliding block: `cargo run -p uplift --example own_system`.
//!
//! Whatever computes the peaks, risk needs them as `[record, level]` alone, one such array a strength.
#![allow(clippy::print_stdout)]

use uplift_fragility::Stripes;
use uplift_hazard::{Extrapolation, HazardCurve, rate_from_probability};
use uplift_motion::synthetic::{SyntheticSetOptions, generate};
use uplift_motion::{Accelerogram, IntensityMeasure, STANDARD_GRAVITY_M_S2 as G, scale_factor};
use uplift_risk::{PooledDemand, RiskCurve, StripeWeights};

/// Largest slip, m, of a block on a rough plane (Newmark, 1965), sample by sample.
///
/// A system that fails returns `f64::INFINITY`.
fn peak_slip_m(friction: f64, motion: &Accelerogram, factor: f64) -> f64 {
    let (mut velocity, mut slip, mut peak) = (0.0_f64, 0.0_f64, 0.0_f64);
    for ground in motion.acceleration_m_s2() {
        let pull = -factor * ground;
        let direction = if velocity == 0.0 { pull } else { velocity };
        let net = pull - (friction * G).copysign(direction);
        let after = velocity + net * motion.dt_s();
        // friction stops a slip, and turns none round
        velocity = if after * direction > 0.0 { after } else { 0.0 };
        slip += velocity * motion.dt_s();
        peak = peak.max(slip.abs());
    }
    peak
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pairs = generate(&SyntheticSetOptions { pairs: 20, ..SyntheticSetOptions::default() })?;
    let levels_cm_s = [2.0, 5.0, 10.0, 20.0, 40.0, 80.0];
    let hazard = HazardCurve::new("PGV", "cm/s", "my site", vec![1.0, 10.0, 100.0], vec![0.3, 0.01, 0.0001])?;
    let weights = StripeWeights::from_hazard(&hazard, &levels_cm_s, Extrapolation::Refuse)?;
    let target_per_year = rate_from_probability(0.1, 50.0)?;
    for friction in [0.02, 0.05, 0.1, 0.2] {
        let mut peaks_m = Vec::new();
        for pair in &pairs {
            for level in levels_cm_s {
                let factor = scale_factor(level, IntensityMeasure::Pgv.pair_value(pair, G))?;
                peaks_m.push(peak_slip_m(friction, &pair.h1, factor));
            }
        }
        let demand = PooledDemand::new(&Stripes::new(&levels_cm_s, &peaks_m)?)?;
        let ordinate = RiskCurve::new(&demand, &weights)?.exact_ordinate(target_per_year)?;
        println!("friction {friction:4.2}: {:.4} m with 10 % in 50 years", ordinate.displacement_m);
    }
    Ok(())
}
