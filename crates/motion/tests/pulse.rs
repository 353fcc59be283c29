//! The pulse classifier on pulses made by formula and on real records.
//!
//! The records may not be redistributed: the test looks for them where the variable
//! `UPLIFT_RECORDS` points, else beside the repository, and is skipped where they are absent.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::time::Instant;

use proptest::prelude::*;
use uplift_motion::{
    Accelerogram, MotionError, PulseClassification, ReadOptions, classify_pulse, may_be_pulse_like, read_path,
};

use crate::golden::{records_folder, rows};

/// Numbers that look independent and uniform in [-1, 1): `SplitMix64`.
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = (state ^ (state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// The pulse of Mavroeidis and Papageorgiou (2003): amplitude 1, centred at zero.
fn pulse(t_s: f64, period_s: f64, cycles: f64, phase: f64) -> f64 {
    if t_s.abs() > 0.5 * cycles * period_s {
        return 0.0;
    }
    0.5 * (1.0 + (TAU * t_s / (cycles * period_s)).cos()) * (TAU * t_s / period_s + phase).cos()
}

/// The accelerogram with the velocity `velocity_m_s`, by central differences.
fn with_velocity(dt_s: f64, velocity_m_s: &[f64]) -> Accelerogram {
    let at = |index: usize| velocity_m_s.get(index).copied().unwrap_or(0.0);
    let slope = |i: usize| (at(i + 1) - if i > 0 { at(i - 1) } else { 0.0 }) / (2.0 * dt_s);
    Accelerogram::new(dt_s, (0..velocity_m_s.len()).map(slope).collect()).unwrap()
}

/// A pulse at 8 s of 40 s towards `orientation_deg`, over noise of `noise_m_s` in both components
/// that fades in and out as an earthquake does.
#[derive(Debug, Clone, Copy)]
struct Made {
    dt_s: f64,
    amplitude_m_s: f64,
    period_s: f64,
    phase: f64,
    orientation_deg: f64,
    noise_m_s: f64,
    seed: u64,
}

/// A strong pulse, without noise.
const STRONG: Made =
    Made { dt_s: 0.01, amplitude_m_s: 1.0, period_s: 2.0, phase: 0.5, orientation_deg: 70.0, noise_m_s: 0.0, seed: 1 };

impl Made {
    fn velocities(&self) -> [Vec<f64>; 2] {
        let (sine, cosine) = self.orientation_deg.to_radians().sin_cos();
        let mut noise = noise(self.seed);
        let mut samples = |share: f64| {
            let mut smooth = 0.0;
            let mut sample = |i: u32| {
                let t_s = f64::from(i) * self.dt_s;
                // Of some 3 Hz and above.
                smooth += (noise() - smooth) * (20.0 * self.dt_s);
                let envelope = t_s / 10.0 * (1.0 - t_s / 10.0).exp();
                self.amplitude_m_s * share * pulse(t_s - 8.0, self.period_s, 2.0, self.phase)
                    + self.noise_m_s * envelope * smooth
            };
            (0..).map_while(|i| (f64::from(i) * self.dt_s < 40.0).then(|| sample(i))).collect::<Vec<_>>()
        };
        [samples(cosine), samples(sine)]
    }

    fn classified(&self) -> PulseClassification {
        let [h1, h2] = self.velocities().map(|velocity| with_velocity(self.dt_s, &velocity));
        classify_pulse(&h1, &h2).unwrap()
    }
}

/// Distance of two orientations \[degrees\], at most 90.
fn between_deg(a: f64, b: f64) -> f64 {
    let apart = (a - b).rem_euclid(180.0);
    apart.min(180.0 - apart)
}

fn made() -> impl Strategy<Value = Made> {
    let numbers = (0.8..1.5_f64, 0.8..6.0_f64, 0.0..TAU, 0.0..180.0_f64, any::<u64>());
    (prop::sample::select(vec![0.005, 0.01, 0.02]), numbers).prop_map(
        |(dt_s, (amplitude_m_s, period_s, phase, orientation_deg, seed))| Made {
            dt_s,
            amplitude_m_s,
            period_s,
            phase,
            orientation_deg,
            noise_m_s: 0.15,
            seed,
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn a_pulse_in_noise_is_found_with_its_period_and_orientation(made in made()) {
        let found = made.classified();
        prop_assert!(found.is_pulse_like && !found.late && found.indicator > 0.0, "{found:?}");
        prop_assert!((found.period_s / made.period_s - 1.0).abs() < 0.25, "{} {found:?}", made.period_s);
        prop_assert!(between_deg(found.orientation_deg, made.orientation_deg) < 5.0, "{found:?}");
        prop_assert!((0.0..180.0).contains(&found.orientation_deg));
        prop_assert!(found.pgv_ratio < 0.7 && found.energy_ratio < 0.5, "{found:?}");
    }

    /// The same ground motion recorded by instruments that stand at another angle.
    #[test]
    fn turned_axes_turn_the_orientation_only(made in made(), turn_deg in 0.0..360.0_f64, strong in any::<bool>()) {
        let made = if strong { made } else { Made { amplitude_m_s: 0.1, ..made } };
        let [v1, v2] = made.velocities();
        let (sine, cosine) = turn_deg.to_radians().sin_cos();
        let turned = |of_1: f64, of_2: f64| {
            let velocity: Vec<f64> = v1.iter().zip(&v2).map(|(v1, v2)| of_1 * v1 + of_2 * v2).collect();
            with_velocity(made.dt_s, &velocity)
        };
        let before = made.classified();
        let after = classify_pulse(&turned(cosine, sine), &turned(-sine, cosine)).unwrap();
        prop_assert_eq!(after.is_pulse_like, before.is_pulse_like);
        prop_assert_eq!(after.late, before.late);
        prop_assert!(between_deg(after.orientation_deg, before.orientation_deg - turn_deg) < 1e-6);
        for (after, before) in [
            (after.indicator, before.indicator),
            (after.period_s, before.period_s),
            (after.pgv_ratio, before.pgv_ratio),
            (after.energy_ratio, before.energy_ratio),
            (after.peak_velocity_m_s, before.peak_velocity_m_s),
        ] {
            prop_assert!((after - before).abs() < 1e-6 * before.abs().max(1.0), "{after} {before}");
        }
    }
}

#[test]
fn the_same_pulse_is_no_pulse_when_it_is_weak_or_late() {
    let made = STRONG;
    let strong = made.classified();
    assert!(strong.is_pulse_like, "{strong:?}");
    assert_eq!(strong, made.classified());
    // Weak: the ratios stay, the class goes.
    let weak = Made { amplitude_m_s: 0.2, ..made }.classified();
    assert!(!weak.is_pulse_like && !weak.late, "{weak:?}");
    // 20 cm/s is too weak for any pulse, a little more is not
    let may_be = |amplitude_m_s: f64| {
        let [h1, h2] = Made { amplitude_m_s, ..made }.velocities().map(|velocity| with_velocity(0.01, &velocity));
        may_be_pulse_like(&h1, &h2)
    };
    assert_eq!([0.2, 0.21, 0.25].map(may_be), [false, false, true]);
    assert!((weak.pgv_ratio - strong.pgv_ratio).abs() < 1e-12 && weak.period_s == strong.period_s, "{weak:?}");
    // Late: a fifth of the energy comes in fast waves, none of which is taken for the pulse, before it.
    let late = |share: f64| {
        let [mut v1, v2] = made.velocities();
        for (i, v) in v1.iter_mut().enumerate().take(600) {
            *v += share * (i as f64 * 0.01 * TAU * 8.0).sin();
        }
        let [h1, h2] = [v1, v2].map(|velocity| with_velocity(0.01, &velocity));
        classify_pulse(&h1, &h2).unwrap()
    };
    assert!(late(0.05).is_pulse_like);
    let late = late(0.9);
    assert!(late.late && late.indicator > 0.0 && !late.is_pulse_like, "{late:?}");
}

#[test]
fn white_noise_has_no_pulse() {
    for seed in 0..60 {
        let mut noise = noise(seed);
        // White velocity of up to 1 m/s, 30 s.
        let mut white = || (0..3000).map(|_| noise()).collect::<Vec<_>>();
        let motion = |velocity: Vec<f64>| with_velocity(0.01, &velocity);
        let found = classify_pulse(&motion(white()), &motion(white())).unwrap();
        assert!(!found.is_pulse_like, "{seed}: {found:?}");
    }
}

#[test]
fn a_pair_without_motion_and_pairs_beyond_physics() {
    let still = Accelerogram::new(0.01, vec![0.0; 100]).unwrap();
    let found = classify_pulse(&still, &still).unwrap();
    assert!(!found.is_pulse_like && (found.indicator + 8.213).abs() < 1e-3 && found.peak_velocity_m_s == 0.0);
    assert_eq!((found.period_s, found.pgv_ratio, found.energy_ratio), (0.0, 1.0, 1.0));
    // Two samples, huge samples, huge and tiny steps: an answer, soon.
    for dt_s in [1e-300, 1e-9, 0.01, 1e6, 1e300] {
        for size in [1e-300, 1.0, 1e300] {
            for count in [2, 3, 1000] {
                let motion = |sign: f64| {
                    let samples = (0..count).map(|i| size * sign * (f64::from(i) * 0.1).sin());
                    Accelerogram::new(dt_s, samples.collect()).unwrap()
                };
                let start = Instant::now();
                assert!(
                    !classify_pulse(&motion(1.0), &motion(-1.0)).unwrap().is_pulse_like || (size, dt_s) == (1.0, 0.01)
                );
                assert!(start.elapsed().as_secs() < 5, "{dt_s} {size} {count}");
            }
        }
    }
}

#[test]
fn lengths_may_differ_and_time_steps_may_not() {
    let made = Made { phase: 0.0, orientation_deg: 30.0, noise_m_s: 0.1, seed: 3, ..STRONG };
    let [h1, long] = made.velocities().map(|velocity| with_velocity(0.01, &velocity));
    let samples = |motion: &Accelerogram| motion.acceleration_m_s2()[..3000].to_vec();
    let short = [&h1, &long].map(|motion| Accelerogram::new(0.01, samples(motion)).unwrap());
    let both = classify_pulse(&short[0], &short[1]).unwrap();
    assert!(both.is_pulse_like);
    assert_eq!(classify_pulse(&h1, &short[1]).unwrap(), both);
    assert_eq!(classify_pulse(&short[0], &long).unwrap(), both);

    let other = Accelerogram::new(0.02, samples(&h1)).unwrap();
    let error = classify_pulse(&h1, &other).unwrap_err();
    assert!(matches!(error, MotionError::UnequalTimeSteps { h1_s: 0.01, h2_s: 0.02 }));
    let message = error.to_string();
    assert!(message.contains("0.01 s and 0.02 s") && message.contains("resample"), "{message}");
}

/// Record sequence numbers and periods \[s\] of the real records that are pulse-like to a plain
/// transcription of the authors' program (transform at every sample by FFT), run on the same files;
/// it finds no pulse in the others.
const PULSE_LIKE: [(u32, f64); 27] = [
    // FEMA P695, near-field set with pulses.
    (181, 3.773),
    (182, 4.375),
    (292, 3.273),
    (723, 2.394),
    (802, 4.571),
    (821, 2.660),
    (828, 2.996),
    (879, 5.124),
    (1063, 1.246),
    (1086, 2.436),
    (1165, 5.369),
    (1503, 5.740),
    (1529, 9.632),
    (1605, 5.943),
    // Near-field set without pulses.
    (126, 4.278),
    (825, 4.844),
    (1004, 0.931),
    (1176, 4.949),
    (2114, 3.157),
    // Far-field set.
    (174, 7.959),
    (725, 2.870),
    (767, 2.639),
    (900, 7.504),
    (1148, 7.791),
    (1244, 5.341),
    (1485, 9.338),
    (1602, 0.882),
];

struct Real {
    rsn: u32,
    tags: Vec<String>,
    found: PulseClassification,
}

/// Every pair of the manifest, classified.
fn real_records() -> Option<Vec<Real>> {
    let folder = records_folder()?;
    let manifest = std::fs::read_to_string(folder.join("manifest.csv")).unwrap();
    let mut seconds = 0.0;
    let record = |row: BTreeMap<String, String>| {
        let read = |file: &str| read_path(&folder.join(&row[file]), &ReadOptions::default()).unwrap();
        let [h1, h2] = ["file_h1", "file_h2"].map(read);
        let start = Instant::now();
        let found = classify_pulse(&h1, &h2).unwrap();
        seconds += start.elapsed().as_secs_f64();
        Real { rsn: row["rsn"].parse().unwrap(), tags: row["set_tags"].split(' ').map(str::to_owned).collect(), found }
    };
    let records: Vec<Real> = rows(&manifest).into_iter().map(record).collect();
    println!("{:.1} ms a pair", 1e3 * seconds / records.len() as f64);
    Some(records)
}

#[test]
fn real_records_have_the_class_and_period_of_the_authors_program() {
    let Some(records) = real_records() else {
        println!("skipped: no record folder (set UPLIFT_RECORDS)");
        return;
    };
    assert_eq!(records.len(), 138);
    let mut counts = BTreeMap::<&str, (usize, usize)>::new();
    for Real { rsn, tags, found } in &records {
        for tag in tags {
            let (pulses, all) = counts.entry(tag).or_default();
            *pulses += usize::from(found.is_pulse_like);
            *all += 1;
        }
        let expected = PULSE_LIKE.iter().find(|(pulse_like, _)| pulse_like == rsn);
        assert_eq!(found.is_pulse_like, expected.is_some(), "RSN {rsn}: {found:?}");
        if let Some((_, period_s)) = expected {
            // One sample in the time of the strongest wavelet, which the program rounds another way, moves
            // the best scale by a few per cent where the time step is long. In RSN 126 the first of two
            // pulses comes after 16 % of the energy by the program, after 17 % and so too late here.
            let tolerance = if *rsn == 126 { 0.16 } else { 0.04 };
            let deviation = (found.period_s / period_s - 1.0).abs();
            assert!(deviation < tolerance, "RSN {rsn}: {} s, expected {period_s} s", found.period_s);
        }
    }
    println!("pulse-like, of all: {counts:?}");
    // FEMA P695 took its near-field classes from Baker (2007), by the fault-normal component alone. All of
    // its pulses are pulses here. So are five of the 14 it lists without pulse, as the later classifier
    // looks in every orientation and weighs the ratios with the peak velocity: its authors' program says
    // the same of all five. The far-field set was chosen by distance, not by the absence of pulses.
    assert_eq!(counts["nfp"], (14, 14));
    assert_eq!(counts["nf"], (5, 14));
    assert_eq!(counts["ff"], (8, 22));
    // The ordinary set has none, as it should.
    assert_eq!(counts["ord105"], (0, 105));
}
