//! Every displacement of a result against the solvers called one by one.

use uplift_block::{FreeRocking, RockingBlock, respond};
use uplift_motion::synthetic::{SyntheticSetOptions, generate};
use uplift_motion::{Accelerogram, RecordPair, STANDARD_GRAVITY_M_S2 as G};
use uplift_oscillator::{Excitation, GroundMotion, Oscillator, PostUplift, Sweep};

use super::{BLOCKS, OSCILLATORS, array, close, read};
use crate::common::SmallStudy;

/// The motions of the synthetic set, and the geometric mean of the peaks of each record, given a peak.
fn motions(pairs: &[RecordPair]) -> Vec<&Accelerogram> {
    pairs.iter().flat_map(|pair| [&pair.h1, &pair.h2]).collect()
}

fn geometric_means(pairs: &[RecordPair], peak: fn(&Accelerogram) -> f64) -> Vec<f64> {
    pairs.iter().map(|pair| (peak(&pair.h1) * peak(&pair.h2)).sqrt()).collect()
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    0.5 * (sorted[(sorted.len() - 1) / 2] + sorted[sorted.len() / 2])
}

#[test]
fn displacements_of_oscillators_are_those_of_single_runs() {
    let study = SmallStudy::with(OSCILLATORS);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q"]).ok();
    let reader = read(&study, "r.h5");
    let u_m = array(&reader, "/sets/synthetic/u_m");
    assert_eq!(u_m.dims, ["scaling", "scaled_by", "uplift_displacement", "capacity", "strength", "motion_synthetic"]);
    assert_eq!(u_m.shape, [3, 2, 2, 2, 5, 6]);
    let factor = array(&reader, "/sets/synthetic/factor").values;

    let pairs = generate(&SyntheticSetOptions { pairs: 3, seed: 1, ..SyntheticSetOptions::default() }).unwrap();
    let peaks: [fn(&Accelerogram) -> f64; 2] = [Accelerogram::pga_m_s2, Accelerogram::pgv_m_s];
    let ground_motions: Vec<GroundMotion<'_>> = motions(&pairs)
        .into_iter()
        .map(|motion| GroundMotion::new(Excitation::new(motion.dt_s(), motion.acceleration_m_s2()).unwrap()))
        .collect();
    let (mut overturned, mut at) = (0, 0);
    for (scaling, multiple) in [0.0, 2.0, 4.0].into_iter().enumerate() {
        for by_record in [false, true] {
            let factor_of = |motion: usize| {
                let Some(peak) = scaling.checked_sub(1).map(|which| peaks[which]) else { return 1.0 };
                let of_records = geometric_means(&pairs, peak);
                let own = if by_record { of_records[motion / 2] } else { peak(motions(&pairs)[motion]) };
                multiple * median(&of_records) / own
            };
            for motion in 0..6 {
                let place = (scaling * 2 + usize::from(by_record)) * 6 + motion;
                assert!(close(factor[place], factor_of(motion), 1e-12), "{scaling} {by_record} {motion}");
            }
            for uplift_m in [0.0005, 0.005] {
                for post_uplift in [PostUplift::Negative { capacity_m: 0.02 }, PostUplift::Zero] {
                    for strength in [0.0, 0.02, 0.1, 0.2, 0.3] {
                        let oscillator = Oscillator::new(strength, G, uplift_m, 0.95, post_uplift).unwrap();
                        for (motion, ground_motion) in ground_motions.iter().enumerate() {
                            let factor = factor[(scaling * 2 + usize::from(by_record)) * 6 + motion];
                            let single = Sweep::new(&oscillator, ground_motion, true).peak(factor).displacement_m;
                            assert_eq!(u_m.values[at].to_bits(), single.to_bits(), "{oscillator:?} {motion}");
                            overturned += usize::from(single.is_infinite());
                            at += 1;
                        }
                    }
                }
            }
        }
    }
    assert_eq!(at, u_m.values.len());
    assert!(overturned > 20 && !u_m.values.iter().any(|value| value.is_nan()), "{overturned}");
}

#[test]
fn displacements_of_blocks_are_those_of_single_runs() {
    let study = SmallStudy::with(BLOCKS);
    study.uplift(&["run", "study.toml", "-o", "r.h5", "-q", "--set", "gravity_m_s2=9.7"]).ok();
    let reader = read(&study, "r.h5");
    let u_m = array(&reader, "/sets/synthetic/u_m");
    assert_eq!(u_m.dims, ["scaling", "scaled_by", "height", "slenderness", "motion_synthetic"]);
    assert_eq!(u_m.shape, [2, 1, 2, 7, 4]);
    let pairs = generate(&SyntheticSetOptions { pairs: 2, seed: 1, ..SyntheticSetOptions::default() }).unwrap();
    let pgv = geometric_means(&pairs, Accelerogram::pgv_m_s);
    let slenderness = reader.axis::<f64>("slenderness").unwrap();
    let factor = array(&reader, "/sets/synthetic/factor").values;
    let mut at = 0;
    for scaled in [true, false] {
        for height_m in [0.5, 1000.0] {
            for tangent in &slenderness {
                let block = RockingBlock::from_height(height_m, tangent.atan()).unwrap().with_gravity(9.7).unwrap();
                for (motion, accelerogram) in motions(&pairs).into_iter().enumerate() {
                    let factor = factor[usize::from(!scaled) * 4 + motion];
                    let expected = if scaled { median(&pgv) / pgv[motion / 2] } else { 1.0 };
                    assert!(close(factor, expected, 1e-12), "{factor} {expected}");
                    let shaken = accelerogram.scaled(factor).unwrap();
                    let single = respond(&block, &shaken, FreeRocking::FirstPeak).unwrap().displacement_m;
                    assert_eq!(u_m.values[at].to_bits(), single.to_bits(), "{block:?} {motion}");
                    at += 1;
                }
            }
        }
    }
    // the slenderest small block overturns, the largest blocks do not
    assert!(u_m.values[..4].iter().any(|value| value.is_infinite()), "{:?}", &u_m.values[..4]);
    let critical = array(&reader, "/spectra/critical");
    assert_eq!(critical.shape, [1, 2, 1, 2, 2]);
    assert!(critical.values[1] >= 0.02 && critical.values[2..4].iter().all(|value| value.is_nan()), "{critical:?}");
}
