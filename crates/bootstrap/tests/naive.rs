//! The bootstrap against the plain way: write the drawn records out, count fragilities, integrate, invert, sort.

use uplift_bootstrap::{Band, BootstrapError, Replicates, ResamplingPlan, left_out, weighted_replicates, without_each};
use uplift_fragility::Stripes;
use uplift_hazard::{Extrapolation, HazardCurve};
use uplift_risk::{PooledDemand, RecordSample, RiskCurve, RunWeights, StripeWeights, mean_annual_frequency};

const LEVELS_CM_S: [f64; 8] = [2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0];
const RECORDS: usize = 14;
const TARGETS: [f64; 3] = [4.04e-4, 2.1e-3, 0.0139];

/// Demands of 14 records: rising with the level, scattered from record to record, some zero, some overturned.
fn demands() -> Vec<f64> {
    let mut edp_m = Vec::new();
    for record in 0..RECORDS {
        let factor = 0.4 + 0.13 * ((record * 5) % RECORDS) as f64;
        for (level, im) in LEVELS_CM_S.iter().enumerate() {
            edp_m.push(match (record, level) {
                (3 | 8, 0) => 0.0,
                (11, 7) => f64::INFINITY,
                // a tie between two records
                (6 | 7, 4) => 0.05,
                _ => 1e-3 * factor * im * (1.0 + 0.2 * ((record * 3 + level) % 4) as f64),
            });
        }
    }
    edp_m
}

fn weights() -> [StripeWeights; 2] {
    [1.0, 3.0].map(|factor| {
        let im: Vec<f64> = (0..12).map(|i| 2.0_f64.powi(i - 1)).collect();
        let maf = im.iter().map(|im| 0.4 * factor * im.powf(-1.6)).collect();
        let curve = HazardCurve::new("PGV", "cm/s", "power law", im, maf).unwrap();
        StripeWeights::from_hazard(&curve, &LEVELS_CM_S, Extrapolation::Refuse).unwrap()
    })
}

/// The ordinate of records written out: the smallest demand c, or 0, with λ(c) ≤ target.
fn plain_ordinate(edp_m: &[f64], weights: &StripeWeights, target: f64) -> f64 {
    let stripes = Stripes::new(&LEVELS_CM_S, edp_m).unwrap();
    let mut candidates: Vec<f64> = edp_m.iter().copied().filter(|edp| edp.is_finite()).collect();
    candidates.push(0.0);
    candidates.sort_by(f64::total_cmp);
    let met = |&c: &f64| mean_annual_frequency(&stripes, weights, c).unwrap() <= target;
    candidates.into_iter().find(met).unwrap_or(f64::INFINITY)
}

#[test]
fn bands_are_those_of_the_plain_way() {
    let edp_m = demands();
    let demand = PooledDemand::new(&Stripes::new(&LEVELS_CM_S, &edp_m).unwrap()).unwrap();
    let weights = weights();
    let plan = ResamplingPlan::draw(RECORDS, &[5, 14, 40], 60, 2).unwrap();
    let sites: Vec<&StripeWeights> = weights.iter().collect();
    let replicates = Replicates::from_plan(&demand, &sites, &TARGETS, &plan).unwrap();

    for (site, weights) in weights.iter().enumerate() {
        for (size_index, &size) in plan.sizes().iter().enumerate() {
            for (target_index, &target) in TARGETS.iter().enumerate() {
                let mut plain: Vec<f64> = plan.samples()[size_index * 60..(size_index + 1) * 60]
                    .iter()
                    .map(|sample| {
                        let mut written = Vec::new();
                        for (record, &count) in sample.multiplicities().iter().enumerate() {
                            for _ in 0..count {
                                written.extend_from_slice(&edp_m[record * 8..record * 8 + 8]);
                            }
                        }
                        assert_eq!(written.len(), size as usize * 8);
                        plain_ordinate(&written, weights, target)
                    })
                    .collect();
                assert_eq!(replicates.ordinates_m(site, target_index, size_index), plain);

                plain.sort_by(f64::total_cmp);
                let mut sorted = replicates.ordinates_m(site, target_index, size_index).to_vec();
                sorted.sort_by(f64::total_cmp);
                let band = Band::percentile(&sorted, 0.9);
                // numpy's definition: positions 0.05 · 59 = 2.95, 29.5 and 56.05
                let at = |index: usize, part: f64| plain[index] * (1.0 - part) + plain[index + 1] * part;
                for (found, expected) in
                    [(band.lower_m, at(2, 0.95)), (band.median_m, at(29, 0.5)), (band.upper_m, at(56, 0.05))]
                {
                    let alike = found == expected || (found - expected).abs() < 1e-12 || expected.is_nan();
                    assert!(alike, "{found} {expected}");
                }
            }
        }
    }
}

#[test]
fn leaving_a_record_out_is_a_set_without_it() {
    let edp_m = demands();
    let demand = PooledDemand::new(&Stripes::new(&LEVELS_CM_S, &edp_m).unwrap()).unwrap();
    let [weights, _] = weights();
    let without_each = |demand: &PooledDemand| {
        without_each(demand, &weights, &TARGETS, &left_out(demand.record_count()).unwrap()).unwrap()
    };
    let found = without_each(&demand);
    assert!(found.len() == TARGETS.len() && found.iter().all(|of_target| of_target.len() == RECORDS));
    for (target, of_target) in TARGETS.iter().zip(&found) {
        for (record, found_m) in of_target.iter().enumerate() {
            let mut others = edp_m.clone();
            others.drain(record * 8..record * 8 + 8);
            assert_eq!(*found_m, plain_ordinate(&others, &weights, *target));
        }
    }
    let one = PooledDemand::new(&Stripes::new(&LEVELS_CM_S, &edp_m[..8]).unwrap()).unwrap();
    assert_eq!(without_each(&one), vec![Vec::<f64>::new(); TARGETS.len()]);
}

#[test]
fn one_record_and_one_replicate_are_defined() {
    let edp_m = &demands()[..8];
    let demand = PooledDemand::new(&Stripes::new(&LEVELS_CM_S, edp_m).unwrap()).unwrap();
    let [weights, _] = weights();
    let plan = ResamplingPlan::draw(1, &[1, 7], 1, 9).unwrap();
    let replicates = Replicates::from_plan(&demand, &[&weights], &TARGETS, &plan).unwrap();
    for (index, &target) in TARGETS.iter().enumerate() {
        let expected = plain_ordinate(edp_m, &weights, target);
        for size in 0..2 {
            assert_eq!(replicates.ordinates_m(0, index, size), [expected]);
            let band = Band::percentile(&[expected], 0.9);
            assert_eq!((band.lower_m, band.median_m, band.upper_m), (expected, expected, expected));
        }
    }
}

// Draws of all records at hand of one and the same demand leave nothing to scatter.
#[test]
fn a_set_that_never_moves_has_bands_of_zero() {
    let demand = PooledDemand::new(&Stripes::new(&LEVELS_CM_S, &[0.0; 24]).unwrap()).unwrap();
    let [weights, _] = weights();
    let plan = ResamplingPlan::draw(3, &[3], 20, 1).unwrap();
    let replicates = Replicates::from_plan(&demand, &[&weights], &TARGETS, &plan).unwrap();
    assert!(replicates.ordinates_m(0, 0, 0).iter().all(|&ordinate| ordinate == 0.0));
}

/// Shares that depend on record, level and draw: m (1 + record · level) over their sum.
fn shares_of(sample: &RecordSample, shares: &mut [f64]) {
    for (level, row) in shares.chunks_exact_mut(RECORDS).enumerate() {
        for (record, (share, &count)) in row.iter_mut().zip(sample.multiplicities()).enumerate() {
            *share = f64::from(count) * (1.0 + (record * level) as f64);
        }
        let sum: f64 = row.iter().sum();
        for share in row {
            *share /= sum;
        }
    }
}

#[test]
fn weighted_replicates_are_each_their_own_curve() {
    // two oscillators, the second twice as strong
    let edp_m = demands();
    let halved: Vec<f64> = edp_m.iter().map(|edp_m| 0.5 * edp_m).collect();
    let pooled = |edp_m: &[f64]| PooledDemand::new(&Stripes::new(&LEVELS_CM_S, edp_m).unwrap()).unwrap();
    let demands = [pooled(&edp_m), pooled(&halved)];
    let [_, stripes] = weights();
    let plan = ResamplingPlan::draw(RECORDS, &[5, 14], 13, 2).unwrap();
    let samples: Vec<RecordSample> = plan.samples().iter().cloned().chain(left_out(RECORDS).unwrap()).collect();
    let of = |samples: &[RecordSample]| {
        weighted_replicates(&demands, &stripes, &TARGETS, samples, |sample, shares| {
            shares_of(sample, shares);
            Ok::<(), BootstrapError>(())
        })
        .unwrap()
    };
    let found = of(&samples);
    let mut shares = vec![0.0; LEVELS_CM_S.len() * RECORDS];
    for (index, sample) in samples.iter().enumerate() {
        shares_of(sample, &mut shares);
        let weights = RunWeights::new(&stripes, &shares).unwrap();
        for (strength, demand) in demands.iter().enumerate() {
            let curve = RiskCurve::weighted(demand, &weights).unwrap();
            for (target_index, &target) in TARGETS.iter().enumerate() {
                let expected = curve.exact_ordinate(target).unwrap().displacement_m;
                let place = (strength * TARGETS.len() + target_index) * samples.len() + index;
                assert_eq!(found[place], expected, "sample {index}, strength {strength}");
            }
        }
    }
    // in portions the same
    assert_eq!(of(&samples[3..4])[4], found[4 * samples.len() + 3]);
    let refused = weighted_replicates(&demands, &stripes, &TARGETS, &samples, |_, shares| {
        shares.fill(0.5);
        Ok::<(), BootstrapError>(())
    });
    assert!(matches!(refused, Err(BootstrapError::Risk(_))), "{refused:?}");
}

#[test]
fn each_record_is_left_out_once() {
    let samples = left_out(3).unwrap();
    let multiplicities: Vec<&[u32]> = samples.iter().map(RecordSample::multiplicities).collect();
    assert_eq!(multiplicities, [[0, 1, 1], [1, 0, 1], [1, 1, 0]]);
    assert!(left_out(1).unwrap().is_empty() && left_out(0).unwrap().is_empty());
}
