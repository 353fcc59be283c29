//! What holds for every oscillator and every ground motion.

use proptest::prelude::*;
use uplift_oscillator::problems::{shaped_noise, symmetric_ricker_pulse};
use uplift_oscillator::{
    EventKind, Excitation, FreeVibration, Oscillator, PostUplift, Response, respond, respond_with_history,
};

const G: f64 = 9.806_65;

fn post_uplift() -> impl Strategy<Value = PostUplift> {
    prop_oneof![
        Just(PostUplift::Zero),
        (0.05_f64..2.0).prop_map(|capacity_m| PostUplift::Negative { capacity_m }),
        (0.1_f64..50.0).prop_map(|stiffness_per_s2| PostUplift::Positive { stiffness_per_s2 }),
    ]
}

fn free_vibration() -> impl Strategy<Value = FreeVibration> {
    prop_oneof![Just(FreeVibration::None), Just(FreeVibration::FirstPeak), Just(FreeVibration::Seconds(1.234))]
}

fn scaled_post_uplift(post_uplift: PostUplift, c: f64) -> PostUplift {
    match post_uplift {
        PostUplift::Negative { capacity_m } => PostUplift::Negative { capacity_m: c * capacity_m },
        other => other,
    }
}

fn run(oscillator: &Oscillator, dt_s: f64, record: &[f64], scale: f64, after: FreeVibration) -> Response {
    respond(oscillator, &Excitation::new(dt_s, record).unwrap().scaled(scale).unwrap(), after)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    // u(t; c a_g, η, u_up) = c u(t; a_g, η/c, u_up/c); a power of two for c keeps every digit, chaotic or not.
    #[test]
    fn similarity_to_the_bit(
        seed in any::<u64>(), strength in 0.0_f64..1.0, restitution in 0.0_f64..=1.0, exponent in -3_i32..4,
        post_uplift in post_uplift(), after in free_vibration(), dt_s in 0.002_f64..0.03,
    ) {
        let c = 2.0_f64.powi(exponent);
        let record = shaped_noise(8.0, 400, seed);
        let scaled = scaled_post_uplift(post_uplift, c);
        let large = Oscillator::new(strength * c, G, 0.0005 * c, restitution, scaled).unwrap();
        let small = Oscillator::new(strength, G, 0.0005, restitution, post_uplift).unwrap();
        let a = run(&large, dt_s, &record, c, after);
        let b = run(&small, dt_s, &record, 1.0, after);
        prop_assert_eq!(a.peak_displacement_m, c * b.peak_displacement_m);
        prop_assert_eq!(
            (a.impacts, a.uplifts, a.overturned, a.time_of_peak_s),
            (b.impacts, b.uplifts, b.overturned, b.time_of_peak_s)
        );
    }

    // Turning the ground motion round turns the response round, to the bit; leading zeros only delay it.
    #[test]
    fn sign_symmetry_and_delay(
        seed in any::<u64>(), strength in 0.0_f64..1.0, post_uplift in post_uplift(), after in free_vibration(),
    ) {
        let oscillator = Oscillator::new(strength, G, 0.0005, 0.95, post_uplift).unwrap();
        let mut record = shaped_noise(8.0, 300, seed);
        record[0] = 0.0;
        let plain = run(&oscillator, 0.007_812_5, &record, 1.0, after);
        let turned = run(&oscillator, 0.007_812_5, &record, -1.0, after);
        prop_assert_eq!(plain.peak_displacement_m, turned.peak_displacement_m);
        prop_assert_eq!(plain.end_displacement_m, -turned.end_displacement_m);
        prop_assert_eq!((plain.impacts, plain.time_of_peak_s), (turned.impacts, turned.time_of_peak_s));

        let delayed: Vec<f64> = std::iter::repeat_n(0.0, 40).chain(record.iter().copied()).collect();
        let late = run(&oscillator, 0.007_812_5, &delayed, 1.0, after);
        prop_assert_eq!((late.peak_displacement_m, late.impacts), (plain.peak_displacement_m, plain.impacts));
        if plain.peak_displacement_m > 0.0 && !plain.overturned {
            prop_assert!((late.time_of_peak_s - plain.time_of_peak_s - 40.0 * 0.007_812_5).abs() < 1e-9);
        }
    }

    // The ground is linear between samples, so samples put between them change nothing but rounding.
    #[test]
    fn splitting_intervals_changes_nothing(
        period_s in 0.3_f64..2.0, strength in 0.03_f64..0.5, parts in 2_usize..6, post_uplift in post_uplift(),
    ) {
        let oscillator = Oscillator::new(strength, G, 0.0005, 0.95, post_uplift).unwrap();
        let record = symmetric_ricker_pulse(6.0, period_s, 0.02, 151);
        let mut fine = vec![record[0]];
        for pair in record.windows(2) {
            fine.extend((1..=parts).map(|i| pair[0] + (pair[1] - pair[0]) * i as f64 / parts as f64));
        }
        let whole = run(&oscillator, 0.02, &record, 1.0, FreeVibration::FirstPeak);
        let split = run(&oscillator, 0.02 / parts as f64, &fine, 1.0, FreeVibration::FirstPeak);
        prop_assert_eq!(whole.overturned, split.overturned);
        // near the brink of overturning, or after many impacts, rounding grows
        if !whole.overturned && whole.impacts < 12 {
            let error = (whole.peak_displacement_m - split.peak_displacement_m).abs();
            prop_assert!(error < 1e-7 * whole.peak_displacement_m, "{:?} {:?}", whole, split);
        }
    }

    // Below uplift the system is linear and undamped, whatever comes after uplift.
    #[test]
    fn linear_below_uplift(
        seed in any::<u64>(), strength in 0.2_f64..1.0, c in 0.05_f64..0.95, post_uplift in post_uplift(),
    ) {
        let oscillator = Oscillator::new(strength, G, 0.0005, 0.95, post_uplift).unwrap();
        let record = shaped_noise(1.0, 500, seed);
        let one = run(&oscillator, 0.01, &record, 1.0, FreeVibration::FirstPeak);
        // the scale at which the peak reaches 99.9 % of the uplift displacement
        let limit = if one.uplifts == 0 { 0.999 * 0.0005 / one.peak_displacement_m } else { return Ok(()) };
        let full = run(&oscillator, 0.01, &record, limit, FreeVibration::FirstPeak);
        let part = run(&oscillator, 0.01, &record, c * limit, FreeVibration::FirstPeak);
        prop_assert_eq!((full.uplifts, full.impacts), (0, 0));
        prop_assert!((full.peak_displacement_m - 0.999 * 0.0005).abs() < 1e-12);
        let error = (part.peak_displacement_m - c * full.peak_displacement_m).abs();
        prop_assert!(error < 1e-12 * full.peak_displacement_m);
    }

    // In free motion the energy changes at impacts alone, each of which takes the share 1 − r_c² of the kinetic energy.
    #[test]
    fn energy_in_free_motion(
        seed in any::<u64>(), strength in 0.02_f64..0.6, restitution in 0.3_f64..=1.0, post_uplift in post_uplift(),
    ) {
        let oscillator = Oscillator::new(strength, G, 0.0005, restitution, post_uplift).unwrap();
        let record = shaped_noise(8.0, 200, seed);
        let excitation = Excitation::new(0.01, &record).unwrap();
        let (_, history) = respond_with_history(&oscillator, &excitation, FreeVibration::Seconds(3.0));
        let a = oscillator.uplift_acceleration_m_s2();
        let energy = |u: f64, v: f64| {
            let beyond = (u.abs() - 0.0005).max(0.0);
            let k = match post_uplift {
                PostUplift::Zero => 0.0,
                PostUplift::Negative { capacity_m } => -a / (capacity_m - 0.0005),
                PostUplift::Positive { stiffness_per_s2 } => stiffness_per_s2,
            };
            0.5 * v * v + 0.5 * a / 0.0005 * u.abs().min(0.0005).powi(2) + a * beyond + 0.5 * k * beyond * beyond
        };
        for event in &history.events {
            let factor = if event.kind == EventKind::Impact { restitution } else { 1.0 };
            prop_assert_eq!(event.velocity_after_m_s, factor * event.velocity_before_m_s);
            prop_assert_eq!(event.displacement_m.abs(), 0.0005);
        }
        let free: Vec<_> = history.samples.iter().filter(|s| s.time_s >= excitation.duration_s()).collect();
        for pair in free.windows(2) {
            let lost: f64 = history.events.iter()
                .filter(|e| e.time_s > pair[0].time_s && e.time_s <= pair[1].time_s)
                .map(|e| 0.5 * (e.velocity_before_m_s.powi(2) - e.velocity_after_m_s.powi(2)))
                .sum();
            let before = energy(pair[0].displacement_m, pair[0].velocity_m_s);
            let after = energy(pair[1].displacement_m, pair[1].velocity_m_s);
            let allowed = 1e-10 * (before.abs() + a * 0.0005);
            prop_assert!((before - lost - after).abs() <= allowed, "{before} {lost} {after}");
        }
    }

    // Whatever the numbers, a run ends and returns a peak that is not NaN.
    #[test]
    fn never_nan(
        record in prop::collection::vec(
            prop_oneof![-50.0_f64..50.0, Just(0.0), -1e12_f64..1e12, -1e-12_f64..1e-12], 2..60
        ),
        strength in prop_oneof![0.0_f64..1.0, Just(0.0), 0.0_f64..1e3, 0.0_f64..1e-6],
        u_up in prop_oneof![Just(0.0005), 1e-9_f64..1.0],
        restitution in prop_oneof![Just(0.0), Just(1.0), 0.0_f64..1.0],
        dt_s in prop_oneof![0.001_f64..0.05, 1e-6_f64..1.0], post_uplift in post_uplift(), after in free_vibration(),
    ) {
        let post_uplift = match post_uplift {
            PostUplift::Negative { capacity_m } => PostUplift::Negative { capacity_m: capacity_m + u_up },
            other => other,
        };
        let oscillator = Oscillator::new(strength, G, u_up, restitution, post_uplift).unwrap();
        let response = run(&oscillator, dt_s, &record, 1.0, after);
        prop_assert!(response.peak_displacement_m >= 0.0, "{:?}", response);
        prop_assert!(response.impacts <= response.uplifts);
    }
}

/// Two samples of the same acceleration (m/s²), the sampling interval being the duration: a constant
/// push that ends with a jump.
///
/// Pushing a ZSBE system with `a_g = −A` moves it by `u(T)` until the push ends; by energy its free peak is then
/// `u_up/2 + (A/(η g)) u(T)`.
fn constant_push(acceleration_m_s2: f64) -> [f64; 2] {
    [acceleration_m_s2; 2]
}

// Pushed by a_g = −A for T seconds, then free: by energy the peak is u_up/2 + (A/η g) u(T). With η g = 1, A = 2, the
// attached phase ends where (A/ω²)(1 − cos ωt) = u_up, that is cos ωt = 1/2 and v = √3/2 · A/ω; then ü = A − η g = 1.
#[test]
fn constant_push_by_hand() {
    let (u_up, t_s) = (0.0005_f64, 0.4);
    let omega = (1.0_f64 / u_up).sqrt();
    let oscillator = Oscillator::new(1.0 / G, G, u_up, 0.95, PostUplift::Zero).unwrap();
    let after_uplift = t_s - std::f64::consts::FRAC_PI_3 / omega;
    let at_end = u_up + 3.0_f64.sqrt() / omega * after_uplift + 0.5 * after_uplift * after_uplift;
    let expected = 0.5 * u_up + 2.0 * at_end;
    let got = run(&oscillator, t_s, &constant_push(-2.0), 1.0, FreeVibration::FirstPeak);
    assert!((got.peak_displacement_m - expected).abs() < 1e-14, "{} {expected}", got.peak_displacement_m);
    assert_eq!((got.impacts, got.uplifts), (0, 1));
}

// Attached under a constant push the system swings about A/ω² with twice its amplitude, and half a
// period later is back at rest.
#[test]
fn attached_push_by_hand() {
    let oscillator = Oscillator::zsbe(0.5).unwrap();
    let omega = (0.5 * G / 0.0005_f64).sqrt();
    let push = 0.2 * 0.5 * G;
    let got = run(&oscillator, 2.0 * std::f64::consts::PI / omega, &constant_push(push), 1.0, FreeVibration::None);
    assert!((got.peak_displacement_m - 2.0 * push / omega.powi(2)).abs() < 1e-17);
    assert!((got.time_of_peak_s - std::f64::consts::PI / omega).abs() < 1e-9);
    assert!(got.end_displacement_m.abs() < 1e-16 && got.end_velocity_m_s.abs() < 1e-14);
}

// Strength zero: the mass stays where it is and u = −u_g. A full sine of acceleration A sin(2πt/T) moves the ground
// by A T²/2π in all; sampled ten thousand times, piecewise linear, the difference is of order (dt/T)².
#[test]
fn free_mass_moves_by_the_ground_displacement() {
    let n = 10_000;
    let record: Vec<f64> =
        (0..=n).map(|i| 3.0 * (2.0 * std::f64::consts::PI * f64::from(i) / f64::from(n)).sin()).collect();
    let got = run(&Oscillator::zsbe(0.0).unwrap(), 2.0 / f64::from(n), &record, 1.0, FreeVibration::FirstPeak);
    let pgd = 3.0 * 4.0 / (2.0 * std::f64::consts::PI);
    assert!((got.peak_displacement_m / pgd - 1.0).abs() < 1e-7, "{} {pgd}", got.peak_displacement_m);
    assert_eq!((got.impacts, got.uplifts), (0, 0));
}

// A soft system is bounded by a stiffer one only on average, but capacity has a sharp meaning: pushed beyond it, a
// system never returns, and the peak is infinite rather than NaN.
#[test]
fn overturning_is_infinite() {
    let oscillator = Oscillator::new(0.1, G, 0.0005, 0.95, PostUplift::Negative { capacity_m: 0.2 }).unwrap();
    for after in [FreeVibration::FirstPeak, FreeVibration::Seconds(5.0)] {
        let got = run(&oscillator, 0.5, &constant_push(-3.0), 1.0, after);
        assert!(got.overturned && got.peak_displacement_m == f64::INFINITY);
    }
    // stopped at the record's end, nothing is said of what follows
    assert!(!run(&oscillator, 0.5, &constant_push(-3.0), 1.0, FreeVibration::None).overturned);
}
