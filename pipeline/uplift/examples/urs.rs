//! Records and a hazard curve in memory become a uniform risk spectrum: `cargo run -p uplift --example urs`.
#![allow(clippy::print_stdout)]

use uplift_fragility::Stripes;
use uplift_hazard::{Extrapolation, HazardCurve, rate_from_probability};
use uplift_ida::{Plan, StripeRecord, System, Unwatched, analyse};
use uplift_motion::synthetic::{SyntheticSetOptions, generate};
use uplift_motion::{IntensityMeasure, STANDARD_GRAVITY_M_S2 as G};
use uplift_oscillator::{Oscillator, PostUplift};
use uplift_risk::{PooledDemand, RiskCurve, StripeWeights};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // your own records are `Accelerogram::new(dt_s, acceleration_m_s2)`, or files: `uplift_motion::read_path`
    let pairs = generate(&SyntheticSetOptions { pairs: 20, ..SyntheticSetOptions::default() })?;
    let pgv_cm_s = |pair| IntensityMeasure::Pgv.pair_value(pair, G);
    let records = pairs
        .iter()
        .map(|pair| StripeRecord { id: &pair.id, accelerogram: &pair.h1, intensity: pgv_cm_s(pair) })
        .collect();
    let strengths = [0.05, 0.1, 0.2, 0.4];
    let system = |strength| Oscillator::new(strength, G, 0.0005, 0.95, PostUplift::Zero).map(System::Oscillator);
    let systems = strengths.into_iter().map(system).collect::<Result<Vec<_>, _>>()?;
    let levels_cm_s = [2.0, 5.0, 10.0, 20.0, 40.0, 80.0];
    let peaks = analyse(&Plan::stripes(records, &systems, &levels_cm_s, true)?, &Unwatched)?;

    let hazard = HazardCurve::new("PGV", "cm/s", "my site", vec![1.0, 10.0, 100.0], vec![0.3, 0.01, 0.0001])?;
    let weights = StripeWeights::from_hazard(&hazard, &levels_cm_s, Extrapolation::Refuse)?;
    let target_per_year = rate_from_probability(0.1, 50.0)?;
    for (index, strength) in strengths.iter().enumerate() {
        let demand = PooledDemand::new(&Stripes::new(&levels_cm_s, &peaks.system_m(index))?)?;
        let ordinate = RiskCurve::new(&demand, &weights)?.exact_ordinate(target_per_year)?;
        println!("strength {strength:4.2}: {:.4} m with 10 % in 50 years", ordinate.displacement_m);
    }
    Ok(())
}
