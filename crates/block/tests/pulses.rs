//! Blocks under Ricker wavelets: limits, similarity, convergence, spectra.

use uplift_block::{
    BlockError, FreeRocking, Overturning, PulseSpectrumPlan, RickerPulse, RickerShape, RockingBlock, SizeMeasure,
    pulse_spectrum, respond,
};

const SHAPES: [RickerShape; 2] = [RickerShape::Symmetric, RickerShape::Antisymmetric];
const G: f64 = 9.806_65;

/// Section 2.5: as α → 0 with H → ∞, `u_max` → 3/2 PGD; the deviation goes with α.
#[test]
fn the_slender_limit_is_three_halves_of_the_ground_displacement() {
    for shape in SHAPES {
        let pulse = RickerPulse::new(shape, 0.5 * G, 1.0).unwrap();
        let limit = 1.5 * pulse.peak_ground_displacement_m();
        let deviations: Vec<f64> = [1e-3, 1e-4, 1e-5]
            .iter()
            .map(|alpha| {
                let block = RockingBlock::new(1e9, *alpha).unwrap();
                respond(&block, pulse, FreeRocking::FirstPeak).unwrap().displacement_m / limit - 1.0
            })
            .collect();
        println!("{shape:?}: u_max/(3/2 PGD) - 1 = {deviations:?}");
        assert!(deviations[2].abs() < 1e-3, "{shape:?} {deviations:?}");
        assert!(deviations.windows(2).all(|d| (5.0..20.0).contains(&(d[0] / d[1]))), "{shape:?} {deviations:?}");
    }
}

/// θmax/α and `u_max` ωₚ²/aₚ depend on α, ωₚ/p and aₚ/(g tan α) alone (Eq. 2.6 and 2.12), whatever the block's size.
#[test]
fn similar_blocks_under_similar_pulses() {
    for shape in SHAPES {
        for (frequency, acceleration) in [(4.0, 1.5), (6.0, 4.0), (10.0, 8.0)] {
            let results: Vec<[f64; 2]> = [0.5, 3.0, 800.0]
                .iter()
                .map(|size| {
                    let block = RockingBlock::new(*size, 0.1).unwrap();
                    let omega = frequency * block.frequency_parameter_rad_s();
                    let amplitude = acceleration * block.uplift_acceleration_m_s2();
                    let pulse = RickerPulse::new(shape, amplitude, std::f64::consts::TAU / omega).unwrap();
                    let response = respond(&block, pulse, FreeRocking::FirstPeak).unwrap();
                    [response.rotation_rad, response.displacement_m * omega * omega / amplitude]
                })
                .collect();
            assert!(results[0][0].is_finite() && results[0][0] > 0.0);
            for other in &results[1..] {
                for i in 0..2 {
                    assert!((other[i] / results[0][i] - 1.0).abs() < 1e-12, "{shape:?} {results:?}");
                }
            }
        }
    }
}

/// A sampled wavelet is the analytic one up to the square of the time step.
#[test]
fn sampled_wavelets_converge_to_the_analytic_one() {
    let block = RockingBlock::new(5.0, 0.2).unwrap();
    for shape in SHAPES {
        let pulse = RickerPulse::new(shape, 0.6 * G, 0.9).unwrap();
        let analytic = respond(&block, pulse, FreeRocking::FirstPeak).unwrap();
        assert!(analytic.rotation_rad.is_finite());
        let deviations: Vec<f64> = [400, 800, 1600]
            .iter()
            .map(|n| {
                let sampled = respond(&block, &pulse.sampled(*n).unwrap(), FreeRocking::FirstPeak).unwrap();
                (sampled.rotation_rad / analytic.rotation_rad - 1.0).abs()
            })
            .collect();
        println!("{shape:?}: {deviations:?}");
        assert!(deviations[2] < 1e-4);
        assert!(deviations.windows(2).all(|d| (3.8..4.2).contains(&(d[0] / d[1]))), "{shape:?} {deviations:?}");
    }
}

fn plan(size_measure: SizeMeasure, sizes: Vec<f64>, accelerations: Vec<f64>) -> PulseSpectrumPlan {
    let shape = RickerShape::Symmetric;
    PulseSpectrumPlan { shape, slenderness_rad: 0.1, restitution: None, size_measure, sizes, accelerations }
}

fn steps(first: f64, last: f64, count: u32) -> Vec<f64> {
    (0..count).map(|i| first + (last - first) * f64::from(i) / f64::from(count - 1)).collect()
}

#[test]
fn a_spectrum_is_the_same_for_any_number_of_threads() {
    let plan = plan(SizeMeasure::Frequency, steps(0.5, 12.0, 24), steps(0.5, 10.0, 20));
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| pulse_spectrum(&plan)).unwrap()
    };
    let one = on(1);
    assert_eq!(one, on(3));
    assert_eq!(one.points().len(), 480);
    assert_eq!(one.point(23, 19), one.points().last());
    assert_eq!((one.point(24, 0), one.point(0, 20)), (None, None));
}

/// Figure 2.2 as the text describes it: nothing below aₚ = g tan α, larger blocks are harder to overturn, both ways of
/// overturning exist, and a block may survive a stronger pulse than one that overturns it.
#[test]
fn a_spectrum_shows_what_the_text_says() {
    for shape in SHAPES {
        let plan =
            PulseSpectrumPlan { shape, ..plan(SizeMeasure::Frequency, steps(0.25, 12.0, 48), steps(0.9, 12.0, 75)) };
        let spectrum = pulse_spectrum(&plan).unwrap();
        let at = |size: usize, acceleration: usize| *spectrum.point(size, acceleration).unwrap();
        assert!((0..48).all(|size| at(size, 0).rotation == 0.0 && at(size, 0).displacement == 0.0));
        assert!((0..48).all(|size| at(size, 1).rotation > 0.0));
        let overturned = |size| (0..75).filter(|a| at(size, *a).overturning != Overturning::None).count();
        assert!(overturned(0) > 65, "{}", overturned(0));
        assert_eq!(overturned(47), 0);
        for way in [Overturning::WithoutImpact, Overturning::AfterImpact] {
            assert!(spectrum.points().iter().any(|point| point.overturning == way), "{shape:?} {way:?}");
        }
        for point in spectrum.points() {
            match point.overturning {
                Overturning::None => assert!(point.rotation.is_finite() && point.displacement.is_finite()),
                way => {
                    assert_eq!([point.rotation, point.displacement], [f64::INFINITY; 2]);
                    assert_eq!(way == Overturning::WithoutImpact, point.impacts == 0);
                }
            }
        }
        let survives_stronger = (0..48).any(|size| {
            (1..75).any(|a| at(size, a).overturning == Overturning::None && at(size, a - 1).rotation == f64::INFINITY)
        });
        assert!(survives_stronger, "{shape:?}");
    }
}

/// Section 2.3.2: a base 2b of roughly nine times the length scale aₚ/ωₚ² is enough for any acceleration; Figure 2.7's
/// measure is Figure 2.3's at other points.
#[test]
fn a_base_of_nine_length_scales_is_enough() {
    for shape in SHAPES {
        let plan =
            PulseSpectrumPlan { shape, ..plan(SizeMeasure::HalfWidth, vec![1.0, 4.5, 5.5], steps(1.1, 20.0, 60)) };
        let spectrum = pulse_spectrum(&plan).unwrap();
        let overturned = |size| (0..60).filter(|a| spectrum.point(size, *a).unwrap().rotation.is_infinite()).count();
        println!("{shape:?}: b wp2/ap = 1, 4.5, 5.5: {:?} of 60 overturn", [0, 1, 2].map(overturned));
        assert!(overturned(0) > 10 && overturned(2) == 0, "{shape:?} {:?}", [0, 1, 2].map(overturned));
        let size = plan.sizes[1];
        let frequency = (size * plan.accelerations[7] / (0.75 * 0.1_f64.cos())).sqrt();
        let same = PulseSpectrumPlan {
            size_measure: SizeMeasure::Frequency,
            sizes: vec![frequency],
            accelerations: vec![plan.accelerations[7]],
            ..plan.clone()
        };
        assert_eq!(pulse_spectrum(&same).unwrap().point(0, 0), spectrum.point(1, 7));
    }
}

#[test]
fn refuses_what_is_no_spectrum() {
    let error = |plan: &PulseSpectrumPlan| pulse_spectrum(plan).unwrap_err().to_string();
    let good = plan(SizeMeasure::Frequency, vec![1.0], vec![1.0]);
    assert_eq!(
        error(&PulseSpectrumPlan { sizes: vec![], ..good.clone() }),
        "the spectrum has no sizes: give at least one"
    );
    assert!(error(&PulseSpectrumPlan { accelerations: vec![0.0], ..good.clone() }).contains("acceleration is 0"));
    assert!(error(&PulseSpectrumPlan { sizes: vec![1.0, f64::NAN], ..good.clone() }).contains("size is NaN"));
    assert!(error(&PulseSpectrumPlan { restitution: Some(2.0), ..good.clone() }).contains("restitution r is 2"));
    assert!(
        error(&PulseSpectrumPlan { slenderness_rad: 1.5, ..good.clone() }).contains("slenderness alpha is 1.5 rad")
    );
    assert!(matches!(
        pulse_spectrum(&PulseSpectrumPlan { sizes: vec![3e-6], ..good }),
        Err(BlockError::TooLong { .. })
    ));
}
