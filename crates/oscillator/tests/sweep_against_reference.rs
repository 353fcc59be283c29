//! The fast solver against the readable one.

use proptest::prelude::*;
use uplift_oscillator::problems::{shaped_noise, symmetric_ricker_pulse};
use uplift_oscillator::{Excitation, FreeVibration, GroundMotion, Oscillator, PostUplift, Sweep, respond};

const G: f64 = 9.806_65;

fn post_uplift() -> impl Strategy<Value = PostUplift> {
    prop_oneof![
        3 => Just(PostUplift::Zero),
        1 => (0.011_f64..2.0).prop_map(|capacity_m| PostUplift::Negative { capacity_m }),
        1 => prop_oneof![0.1_f64..50.0, (1.0_f64..5.0).prop_map(|digits| 10_f64.powf(digits))]
            .prop_map(|stiffness_per_s2| PostUplift::Positive { stiffness_per_s2 }),
    ]
}

/// How much relative changes by 1e-10 of the scale, of the uplift displacement, of the restitution and of every
/// sample for itself change the peak, relative to that change: the conditioning of this very run. The scale alone
/// does not tell: a system of strength zero hardly notices it, and yet its impacts multiply what rounding does, at
/// any time and in any direction.
fn amplification(oscillator: &Oscillator, excitation: &Excitation<'_>, after: FreeVibration) -> f64 {
    let peak = |record: &[f64], scale: f64, u_up: f64, restitution: f64| {
        let changed = Oscillator::new(
            oscillator.strength(),
            G,
            oscillator.uplift_displacement_m() * u_up,
            oscillator.restitution() * restitution,
            oscillator.post_uplift(),
        );
        let excitation = Excitation::new(excitation.dt_s(), record).unwrap().scaled(excitation.scale() * scale);
        respond(&changed.unwrap(), &excitation.unwrap(), after).peak_displacement_m
    };
    let (less, more) = (1.0 - 1e-10, 1.0 + 1e-10);
    let record = excitation.acceleration_m_s2();
    let middle = peak(record, 1.0, 1.0, 1.0);
    let mut changed = vec![
        peak(record, less, 1.0, 1.0),
        peak(record, more, 1.0, 1.0),
        peak(record, 1.0, less, 1.0),
        peak(record, 1.0, more, 1.0),
        peak(record, 1.0, 1.0, less),
    ];
    for seed in 1..=4 {
        let signs = shaped_noise(1.0, record.len(), seed);
        let jittered: Vec<f64> =
            record.iter().zip(signs).map(|(a, sign)| a * (1.0 + 1e-10_f64.copysign(sign))).collect();
        changed.push(peak(&jittered, 1.0, 1.0, 1.0));
    }
    changed
        .into_iter()
        // infinite where only one of both overturns
        .map(|changed| if changed == middle { 0.0 } else { (changed - middle).abs() / (1e-10 * middle.min(changed)) })
        .fold(0.0, f64::max)
}

fn compare(
    oscillator: &Oscillator,
    dt_s: f64,
    record: &[f64],
    scale: f64,
    with_free_peak: bool,
) -> Result<bool, TestCaseError> {
    let excitation = Excitation::new(dt_s, record).unwrap();
    let ground = GroundMotion::new(excitation);
    let fast = Sweep::new(oscillator, &ground, with_free_peak).peak(scale);
    let after = if with_free_peak { FreeVibration::FirstPeak } else { FreeVibration::None };
    let scaled = excitation.scaled(scale).unwrap();
    let exact = respond(oscillator, &scaled, after);
    if exact.peak_displacement_m == 0.0 {
        prop_assert_eq!(fast.displacement_m, 0.0);
        return Ok(true);
    }
    let amplification = amplification(oscillator, &scaled, after);
    if !(amplification < 1e6) {
        return Ok(false); // chaotic, or on the brink of overturning: rounding decides
    }
    if exact.overturned {
        prop_assert_eq!(fast.displacement_m, f64::INFINITY);
        return Ok(true);
    }
    let error = (fast.displacement_m - exact.peak_displacement_m).abs() / exact.peak_displacement_m;
    let allowed = 1e-12 * amplification.max(10.0);
    prop_assert!(error <= allowed, "{:?} {:?} error {} of {}", fast, exact, error, allowed);
    Ok(true)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn noise(
        seed in any::<u64>(), strength in prop_oneof![0.0_f64..0.1, 0.1_f64..1.0, Just(0.0)],
        scale in prop_oneof![0.01_f64..1.0, 1.0_f64..10.0, -2.0_f64..0.0],
        post_uplift in post_uplift(), restitution in 0.0_f64..=1.0,
        dt_s in prop_oneof![Just(0.005), Just(0.01), 0.002_f64..0.025],
        u_up in prop_oneof![3 => Just(0.0005), 1 => (-6.0_f64..-2.0).prop_map(|digits| 10_f64.powf(digits))],
        samples in 2_usize..700, with_free_peak in any::<bool>(),
    ) {
        let oscillator = Oscillator::new(strength, G, u_up, restitution, post_uplift).unwrap();
        compare(&oscillator, dt_s, &shaped_noise(4.0, samples, seed), scale, with_free_peak)?;
    }

    #[test]
    fn pulses(
        period_s in 0.1_f64..3.0, strength in 0.001_f64..1.0, scale in 0.05_f64..20.0,
        u_up in prop_oneof![Just(0.0005), 1e-5_f64..0.1],
        post_uplift in post_uplift(), dt_s in 0.002_f64..0.02, with_free_peak in any::<bool>(),
    ) {
        let post_uplift = match post_uplift {
            PostUplift::Negative { capacity_m } => PostUplift::Negative { capacity_m: capacity_m + u_up },
            other => other,
        };
        let oscillator = Oscillator::new(strength, G, u_up, 0.95, post_uplift).unwrap();
        let record = symmetric_ricker_pulse(2.0, period_s, dt_s, 801);
        compare(&oscillator, dt_s, &record, scale, with_free_peak)?;
    }
}

// A test that skips chaotic runs must show that it does not skip them all.
#[test]
fn most_runs_are_judged() {
    let (mut judged, mut runs, mut impacts) = (0, 0, 0);
    for seed in 0..40 {
        let record = shaped_noise(4.0, 1500, seed);
        for strength in [0.02, 0.1, 0.3, 0.8] {
            for scale in [0.3, 1.0, 4.0] {
                let oscillator = Oscillator::zsbe(strength).unwrap();
                judged += u32::from(compare(&oscillator, 0.01, &record, scale, true).unwrap());
                runs += 1;
                let ground = GroundMotion::new(Excitation::new(0.01, &record).unwrap());
                impacts += Sweep::new(&oscillator, &ground, true).peak(scale).impacts;
            }
        }
    }
    println!("{judged} of {runs} runs judged, {impacts} impacts");
    assert!(judged * 10 > runs * 8, "{judged} of {runs}");
    assert!(impacts > 10 * runs);
}

// Strength zero with a post-uplift stiffness: no force while attached, so the system drifts to the boundary after the
// record, is stopped by the stiffness and no linear response bounds it.
#[test]
fn drift_after_the_record_reaches_the_boundary() {
    let post_uplift = PostUplift::Positive { stiffness_per_s2: 0.1 };
    let oscillator = Oscillator::new(0.0, G, 0.0005, 0.5, post_uplift).unwrap();
    let record = [0.1, 0.3];
    compare(&oscillator, 0.002, &record, 1.0, true).unwrap();
    // v = 0.4 mm/s at the end of the record; the rest by energy: k d²/2 = v²/2
    let ground = GroundMotion::new(Excitation::new(0.002, &record).unwrap());
    let peak = Sweep::new(&oscillator, &ground, true).peak(1.0).displacement_m;
    assert!((peak - 0.0005 - 0.0004 / 0.1_f64.sqrt()).abs() < 1e-12, "{peak}");
    assert_eq!(Sweep::new(&oscillator, &ground, true).peak(0.0).displacement_m, 0.0);
}
