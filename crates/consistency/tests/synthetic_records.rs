//! The embedded synthetic set at Montreux, against an independent prototype: runs on any machine.
// digits as they are printed
#![allow(clippy::unreadable_literal)]

use uplift_consistency::Warning;
use uplift_motion::synthetic::{SyntheticSetOptions, generate};

use crate::common::{STRENGTHS, ScaledTo, Site, demands_m, pooled, record_set, targets};
use crate::golden::{Row, agree, both_ways, compare, compare_ordinates, needs_nothing};

#[test]
fn the_synthetic_set_at_montreux() {
    let pairs = generate(&SyntheticSetOptions { seed: 1, pairs: 105, ..SyntheticSetOptions::default() }).unwrap();
    let site = Site::former("Montreux");
    let rows = [
        Row {
            implied: [0.22437, 0.11, 0.040776],
            over_site: [0.8791, 0.7981, 0.7076],
            bias_rms_max: [0.8161, 0.2272, 0.3684],
            exponents: [3.0147, 2.1700, 1.0393, -0.2008],
            effective: [91.03, 66.63, 45.26],
            least_effective: 42.99,
            largest_share: 0.07335,
        },
        Row {
            implied: [24.535, 12.718, 5.1115],
            over_site: [1.62, 1.685, 1.794],
            bias_rms_max: [1.68, 0.5206, 0.5997],
            exponents: [-4.8807, -3.9787, -3.4647, -3.0627],
            effective: [31.86, 25.97, 17.81],
            least_effective: 16.94,
            largest_share: 0.1854,
        },
    ];
    let ordinates_m = [[0.072762, 0.031648, 0.01306, 0.0046962], [0.073373, 0.03242, 0.012595, 0.0048483]];
    let (mut all_demands, mut all_repaired, mut all_stripes) = (Vec::new(), Vec::new(), Vec::new());
    for ((scaled_to, row), ordinates_m) in ScaledTo::BOTH.into_iter().zip(&rows).zip(&ordinates_m) {
        let set = record_set(&pairs, scaled_to);
        let name = format!("Montreux by {}", scaled_to.measure());
        let analysis = site.analysis(&set, scaled_to);
        let repaired = compare(&name, &analysis, row);
        let demands: Vec<_> =
            demands_m(&pairs, scaled_to, &STRENGTHS[..5]).iter().map(|of_one| pooled(of_one, scaled_to)).collect();
        compare_ordinates(&name, &repaired, &demands, targets()[0], ordinates_m);
        let few = repaired.warnings.iter().any(|warning| matches!(warning, Warning::FewEffective { .. }));
        assert_eq!(few, scaled_to == ScaledTo::Pga, "{:?}", repaired.warnings);
        needs_nothing(&set, &site, scaled_to, &demands);
        all_demands.push(demands);
        all_repaired.push(repaired);
        all_stripes.push(analysis.stripes().clone());
    }
    let stripes = [&all_stripes[0], &all_stripes[1]];
    let (demands, repaired) = (all_demands.try_into().unwrap(), all_repaired.try_into().unwrap());
    agree(&both_ways(&demands, stripes, &repaired, &targets()));
}
