//! Against scipy 1.17.1 (`ks_2samp`, `kstwo.sf`, `anderson_ksamp`, `cramervonmises_2samp`, `mannwhitneyu` with
//! `method="asymptotic"`, `energy_distance`, `wasserstein_distance`, `pearsonr`, `spearmanr`), the printed p of Table
//! 6.2 and what is known by hand.
#![allow(clippy::unwrap_used)]

use proptest::prelude::*;
use uplift_validation::{
    AndersonDarling, BandRule, Collapses, CramerVonMises, Evidence, KolmogorovSmirnov, MannWhitney, Pairs, Resampling,
    Sample, bands, bootstrap_band, detectable_factor, dkw_half_width, energy_distance, greenwood_band, holm_adjusted,
    kstest2_p, median_ratio_band, permutation_p, wasserstein_distance,
};

const INF: f64 = f64::INFINITY;

fn sample(values: &[f64]) -> Sample {
    Sample::new(values.to_vec()).unwrap()
}

fn close(ours: f64, expected: f64) {
    assert!((ours - expected).abs() <= 1e-10 * expected.abs(), "{ours} {expected}");
}

struct Golden {
    samples: [Sample; 2],
    /// D, exact p, p by `kstwo.sf` with n m/(n + m) rounded.
    ks: [f64; 3],
    /// Midrank, right.
    ad: [f64; 2],
    /// Statistic, p.
    cvm: [f64; 2],
    mw: [f64; 2],
}

fn goldens() -> [Golden; 3] {
    let plain = [
        [0.0213, 0.0487, 0.0532, 0.0711, 0.0912, 0.1123, 0.1348, 0.1777, 0.2231, 0.0391, 0.0624, 0.0833].as_slice(),
        &[0.0301, 0.0449, 0.0703, 0.0925, 0.1402, 0.1525, 0.1931, 0.2507, 0.3105],
    ];
    let ties = [
        [1, 2, 2, 3, 3, 3, 4, 5, 5, 7, 8, 9, 9, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20].map(f64::from).to_vec(),
        [2, 3, 3, 5, 6, 6, 6, 9, 10, 12, 13, 13, 16, 21, 22, 23, 24, 25, 26, 27, 28, 29].map(f64::from).to_vec(),
    ];
    let collapses = [[0.05, 0.09, 0.12, INF, 0.3, 0.07].as_slice(), &[0.06, 0.08, INF, INF, 0.25, 0.11, 0.14]];
    [
        Golden {
            samples: plain.map(sample),
            ks: [0.388_888_888_888_888_9, 0.344_582_043_343_653_33, 0.339_653_128_757_472_67],
            ad: [0.146_729_138_318_543_42, 0.145_455_752_227_578_28],
            cvm: [0.199_735_449_735_449_77, 0.291_072_704_385_397_9],
            mw: [37.0, 0.240_954_668_701_570_12],
        },
        Golden {
            samples: ties.map(|values| sample(&values)),
            ks: [0.409_090_909_090_909_1, 0.035_468_144_382_520_786, 0.035_361_397_103_430_45],
            ad: [2.504_806_839_657_181_4, 2.324_217_763_902_185],
            cvm: [0.439_796_515_863_472_23, 0.057_018_729_245_089_994],
            mw: [164.0, 0.044_193_873_973_794_26],
        },
        Golden {
            samples: collapses.map(sample),
            ks: [0.238_095_238_095_238_08, 0.962_703_962_703_962_7, 0.982_507_288_629_737_7],
            ad: [-1.051_154_786_542_254_1, -1.063_128_549_811_602_5],
            // equal values: by the limit
            cvm: [0.054_945_054_945_055_194, 0.952_144_601_018_840_2],
            mw: [17.0, 0.615_125_914_752_179],
        },
    ]
}

#[test]
fn tests_of_two_samples() {
    for Golden { samples: [one, other], ks, ad, cvm, mw } in goldens() {
        let found = KolmogorovSmirnov::from_samples(&one, &other);
        close(found.distance, ks[0]);
        close(found.p_exact, ks[1]);
        close(found.p_kolmogorov, ks[2]);
        let found = AndersonDarling::from_samples(&one, &other);
        close(found.midrank, ad[0]);
        close(found.right, ad[1]);
        let found = CramerVonMises::from_samples(&one, &other);
        close(found.statistic, cvm[0]);
        close(found.p, cvm[1]);
        let found = MannWhitney::from_samples(&one, &other);
        close(found.statistic, mw[0]);
        close(found.p, mw[1]);
    }
    let [plain, ties, collapses] = goldens().map(|golden| golden.samples);
    close(energy_distance(&plain[0], &plain[1]).unwrap(), 0.146_169_189_977_797_43);
    close(wasserstein_distance(&plain[0], &plain[1]).unwrap(), 0.050_494_444_444_444_45);
    close(energy_distance(&ties[0], &ties[1]).unwrap(), 1.649_696_972_643_224_5);
    close(wasserstein_distance(&ties[0], &ties[1]).unwrap(), 5.563_241_106_719_367);
    assert_eq!(energy_distance(&collapses[0], &collapses[1]), None);
    assert_eq!(wasserstein_distance(&collapses[0], &collapses[1]), None);
    close(CramerVonMises::from_samples(&plain[0], &plain[1]).p_limit, 0.282_433_640_998_765_8);
}

/// A small p keeps its digits: `ks_2samp(range(40), [v + 39.5 for v in range(35)], method="exact")`.
#[test]
fn far_apart() {
    let one: Vec<f64> = (0..40).map(f64::from).collect();
    let other: Vec<f64> = (0..35).map(|v| f64::from(v) + 39.5).collect();
    let found = KolmogorovSmirnov::from_samples(&sample(&one), &sample(&other));
    close(found.p_exact, 6.796_666_933_313_428e-22);
    // two orders of 75!/(40! 35!) have a distance of 1
    assert_eq!(found.distance, 1.0);
}

/// The printed p of Table 6.2 decode to D = k/n for samples of n: by the formula to two digits, and by no other k.
#[test]
fn table_6_2_is_decoded() {
    let sets = [
        (92, 9, 0.75),
        (88, 15, 0.14),
        (25, 9, 0.06),
        (24, 4, 0.86),
        (25, 5, 0.65),
        (23, 5, 0.59),
        (42, 9, 0.26),
        (41, 10, 0.15),
    ];
    for (n, k, printed) in sets {
        let rounded = |k: u32| (100.0 * kstest2_p(n, n, f64::from(k) / n as f64)).round() / 100.0;
        assert_eq!(rounded(k), printed, "{n} {k}");
        assert_eq!((0..=u32::try_from(n).unwrap()).filter(|k| rounded(*k) == printed).count(), 1, "{n}");
    }
    // with the sizes of all tests but none left out the third does not
    assert!((0..=26).all(|k: u32| ((100.0 * kstest2_p(26, 26, f64::from(k) / 26.0)).round() - 6.0).abs() > 0.5));
    let words = |p| Evidence::from_p(p).words();
    assert_eq!([0.001, 0.02, 0.059, 0.139].map(words), ["very strong", "strong", "medium to weak", "small or none"]);
}

/// Exact p of equal samples of n, by counting (Table 6.2's eight sets).
#[test]
fn exact_p_of_the_sets_of_table_6_2() {
    let sets = [(92, 9, 0.774), (88, 15, 0.155), (25, 9, 0.078), (24, 4, 0.902), (23, 5, 0.660), (41, 10, 0.175)];
    for (n, k, expected) in sets {
        // the first k of the second sample lie below all of the first, the rest alternate
        let one: Vec<f64> = (0..n).map(f64::from).collect();
        let other: Vec<f64> = (0..n).map(|i| f64::from(i) + 0.5 - f64::from(k)).collect();
        let found = KolmogorovSmirnov::from_samples(&sample(&one), &sample(&other));
        close(found.distance, f64::from(k) / f64::from(n));
        assert!((found.p_exact - expected).abs() < 0.001, "{n}: {}", found.p_exact);
    }
}

#[test]
fn pairs_with_collapses() {
    let measured = [0.4702, 0.2283, 0.1684, INF, 0.04258, 0.1698];
    let computed = [0.4932, 0.5565, 0.2529, INF, 0.04261, INF];
    let found = Pairs::from_peaks(&measured, &computed).unwrap();
    close(found.log_bias.unwrap(), 0.336_529_903_069_562_6);
    close(found.log_dispersion.unwrap(), 0.411_716_072_376_903_3);
    close(found.pearson.unwrap(), 0.769_202_843_765_391_2);
    close(found.spearman.unwrap(), 0.695_725_242_782_938_2);
    assert_eq!(found.finite, 4);
    assert_eq!(found.collapses, Collapses { both: 1, measured_only: 0, computed_only: 1, none: 4 });
    // 1.05, 2.44, 1.50, both, 1.00, one
    close(found.within_1_5, 3.0 / 6.0);
    close(found.within_2, 4.0 / 6.0);
    assert!(Pairs::from_peaks(&measured, &computed[1..]).is_err());
    assert!(Pairs::from_peaks(&[f64::NAN], &[1.0]).is_err());
}

#[test]
fn bands_by_hand() {
    let twelve: Vec<f64> = (1..=12).map(f64::from).collect();
    let [low, high] = greenwood_band(&sample(&twelve), 5.0);
    let half = 1.959_963_984_540_054 * (5.0_f64 / 12.0 * 7.0 / 12.0 / 12.0).sqrt();
    close(low, 5.0 / 12.0 - half);
    close(high, 5.0 / 12.0 + half);
    assert_eq!(greenwood_band(&sample(&twelve), 0.5), [0.0, 0.0]);
    close(dkw_half_width(24), (40.0_f64.ln() / 48.0).sqrt());
    assert_eq!(BandRule::Greenwood.at(&sample(&twelve), 5.0), [low, high]);
    let [low, high] = BandRule::Dkw.at(&sample(&twelve), 5.0);
    close(low, 5.0 / 12.0 - dkw_half_width(12));
    close(high, 5.0 / 12.0 + dkw_half_width(12));
    assert_eq!(BandRule::Dkw.at(&sample(&twelve), 0.5)[0], 0.0);
    // scipy.stats.binom.ppf([0.025, 0.975], 12, 5/12) = 2, 8
    assert_eq!(bootstrap_band(&sample(&twelve), 5.0), [2.0 / 12.0, 8.0 / 12.0]);
    assert_eq!([0.5, 12.0].map(|x| BandRule::Bootstrap.at(&sample(&twelve), x)), [[0.0; 2], [1.0; 2]]);
    let holm = holm_adjusted(&[0.01, 0.04, 0.03, 0.5]);
    for (ours, expected) in holm.iter().zip([0.04, 0.09, 0.09, 0.5]) {
        close(*ours, expected);
    }
    assert_eq!(holm_adjusted(&[0.9, 0.8]), [1.0, 1.0]);
}

/// Resampled pairs of a constant ratio have that ratio in every replicate.
#[test]
fn resampling_a_constant_ratio() {
    let measured: Vec<f64> = (1..=15).map(|i| 0.01 * f64::from(i)).collect();
    let computed: Vec<f64> = measured.iter().map(|value| 1.25 * value).collect();
    let few = Resampling { replicates: 500, seed: 7, ..Resampling::default() };
    let found = bands(&measured, &computed, few).unwrap();
    for (quantiles, expected) in [(found.median_ratio, 0.25), (found.log_bias, 1.25_f64.ln())] {
        let quantiles = quantiles.unwrap();
        for value in [quantiles.q05, quantiles.q50, quantiles.q95] {
            assert!((value - expected).abs() < 1e-14, "{value}");
        }
    }
    assert!(found.log_dispersion.unwrap().q95 < 1e-14);
    assert_eq!(found, bands(&measured, &computed, few).unwrap());
    // unpaired, they vary
    let unpaired = median_ratio_band(&sample(&measured), &sample(&computed), few).unwrap().unwrap();
    assert!(unpaired.q05 < 0.0 && unpaired.q95 > 0.5);
    // all collapsed: nothing to tell
    assert_eq!(median_ratio_band(&sample(&[INF]), &sample(&[INF]), few), Ok(None));
}

/// Pairs that differ little have a permutation p far below the exact one when all differ to one side: 2/2ⁿ of the swaps
/// have a distance as large, for values far apart.
#[test]
fn permutation_within_pairs() {
    let one = [1.0, 2.0, 3.0, 4.0, 5.0];
    let other = [11.0, 12.0, 13.0, 14.0, 15.0];
    let p = permutation_p(&one, &other, Resampling { replicates: 20_000, seed: 3, ..Resampling::default() }).unwrap();
    assert!((p - 2.0 / 32.0).abs() < 0.006, "{p}");
}

/// At level 0.1 with a dispersion of 0.7, 80 % power needs a factor of about 1.9 for 24 values and 1.55 for 42.
#[test]
fn power_of_the_tests_of_the_dissertation() {
    let few = Resampling { replicates: 2000, seed: 5, ..Resampling::default() };
    for (n, expected) in [(24, 1.9), (42, 1.55)] {
        let factor = detectable_factor((n, n), 0.7, 0.1, few).unwrap().unwrap();
        assert!((factor / expected - 1.0).abs() < 0.05, "{n}: {factor}");
    }
    // two values never reject at 0.1
    assert_eq!(detectable_factor((2, 2), 0.7, 0.1, few).unwrap(), None);
    assert!(detectable_factor((2, 2), 0.0, 0.1, few).is_err());
}

/// The smallest samples have a p of every test: 1, since nothing can be told from two values.
#[test]
fn one_value_each() {
    let (one, other) = (sample(&[0.01]), sample(&[7.5]));
    let found = CramerVonMises::from_samples(&one, &other);
    assert_eq!((found.p, found.p_limit), (1.0, 1.0));
    let found = KolmogorovSmirnov::from_samples(&one, &other);
    assert_eq!((found.distance, found.p_exact), (1.0, 1.0));
    assert_eq!(AndersonDarling::from_samples(&one, &other), AndersonDarling { midrank: 0.0, right: 0.0 });
    assert_eq!(MannWhitney::from_samples(&one, &other).p, 1.0);
}

proptest! {
    /// Monotone maps change no rank statistic, and exchanged samples change no p.
    #[test]
    fn ranks_alone_matter(
        a in prop::collection::vec(0.01..10.0_f64, 1..15), b in prop::collection::vec(0.01..10.0_f64, 1..15),
    ) {
        let map = |values: &[f64]| sample(&values.iter().map(|value| value.ln()).collect::<Vec<f64>>());
        let (one, other) = (sample(&a), sample(&b));
        let (mapped, mapped_other) = (map(&a), map(&b));
        let found = KolmogorovSmirnov::from_samples(&one, &other);
        prop_assert_eq!(found, KolmogorovSmirnov::from_samples(&mapped, &mapped_other));
        let swapped = KolmogorovSmirnov::from_samples(&other, &one);
        prop_assert!((found.p_exact - swapped.p_exact).abs() < 1e-12);
        let exact = CramerVonMises::from_samples(&one, &other);
        prop_assert_eq!(&exact, &CramerVonMises::from_samples(&mapped, &mapped_other));
        let darling = AndersonDarling::from_samples(&one, &other);
        prop_assert!(darling.midrank.is_finite() && darling.right.is_finite());
        for p in [exact.p_limit, found.p_kolmogorov, found.p_kstest2, MannWhitney::from_samples(&one, &other).p] {
            prop_assert!((0.0..=1.0).contains(&p), "{p}");
        }
        prop_assert!(exact.p >= 0.0 && exact.p <= 1.0 && found.p_exact > 0.0 && found.p_exact <= 1.0);
        let u = MannWhitney::from_samples(&one, &other).statistic + MannWhitney::from_samples(&other, &one).statistic;
        prop_assert!((u - (a.len() * b.len()) as f64).abs() < 1e-9);
    }

    /// A sample against itself shows no difference.
    #[test]
    fn nothing_differs_from_itself(a in prop::collection::vec(0.01..10.0_f64, 2..20)) {
        let one = sample(&a);
        let found = KolmogorovSmirnov::from_samples(&one, &one);
        prop_assert_eq!((found.distance, found.p_exact), (0.0, 1.0));
        prop_assert_eq!(wasserstein_distance(&one, &one), Some(0.0));
        prop_assert_eq!(MannWhitney::from_samples(&one, &one).p, 1.0);
    }
}
