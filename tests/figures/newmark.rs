//! What a time-step method makes of single peaks (docs/method.md, section 1.5): Newmark's average acceleration,
//! iterated to convergence, at a tenth of the sampling interval.

use uplift_motion::synthetic::{SyntheticSetOptions, generate};
use uplift_motion::{Accelerogram, IntensityMeasure, STANDARD_GRAVITY_M_S2, scale_factor};
use uplift_oscillator::{Excitation, FreeVibration, Oscillator, respond};

use super::marks::hold;
use super::{quantile, range};

const UPLIFT_M: f64 = 0.0005;
const RESTITUTION: f64 = 0.95;
const STEPS: usize = 10;

/// Peak displacement, m, to the end of the record; an impact at the end of the step in which the displacement falls
/// below that of uplift.
fn stepped_m(strength: f64, motion: &Accelerogram, scale: f64) -> f64 {
    let force_m_s2 = |u: f64| strength * STANDARD_GRAVITY_M_S2 * (u / UPLIFT_M).clamp(-1.0, 1.0);
    let dt_s = motion.dt_s() / STEPS as f64;
    let samples = motion.acceleration_m_s2();
    let (mut u, mut v, mut a, mut peak_m) = (0.0_f64, 0.0, -scale * samples[0], 0.0_f64);
    for pair in samples.windows(2) {
        for step in 1..=STEPS {
            let ground = scale * (pair[0] + (pair[1] - pair[0]) * step as f64 / STEPS as f64);
            let known = u + dt_s * v + 0.25 * dt_s * dt_s * (a - ground);
            let mut next = u;
            // the force changes little within a step: each round brings two digits or more
            for _ in 0..50 {
                let better = known - 0.25 * dt_s * dt_s * force_m_s2(next);
                let change = (better - next).abs();
                next = better;
                if change <= 1e-15 * next.abs() {
                    break;
                }
            }
            let after = -ground - force_m_s2(next);
            v += 0.5 * dt_s * (a + after);
            if u.abs() > UPLIFT_M && (next.abs() <= UPLIFT_M || next * u < 0.0) {
                v *= RESTITUTION;
            }
            (u, a) = (next, after);
            peak_m = peak_m.max(u.abs());
        }
    }
    peak_m
}

/// One run that uplifts.
struct Run {
    strength: f64,
    impacts: u32,
    /// Relative error of the stepped peak.
    error: f64,
}

/// Every third record of the embedded set at the strengths and levels of section 1.5.
fn runs() -> Vec<Run> {
    let mut runs = Vec::new();
    for pair in generate(&SyntheticSetOptions::default()).unwrap().iter().step_by(3) {
        let pgv_cm_s = IntensityMeasure::Pgv.pair_value(pair, STANDARD_GRAVITY_M_S2);
        let excitation = Excitation::new(pair.h1.dt_s(), pair.h1.acceleration_m_s2()).unwrap();
        for strength in [0.05, 0.1, 0.2, 0.3, 0.5, 0.8] {
            let oscillator = Oscillator::zsbe(strength).unwrap();
            for level_cm_s in [5.0, 10.0, 20.0, 30.0, 50.0, 100.0, 200.0] {
                let scale = scale_factor(level_cm_s, pgv_cm_s).unwrap();
                let exact = respond(&oscillator, &excitation.scaled(scale).unwrap(), FreeVibration::None);
                if exact.peak_displacement_m > UPLIFT_M {
                    let error = stepped_m(strength, &pair.h1, scale) / exact.peak_displacement_m - 1.0;
                    runs.push(Run { strength, impacts: exact.impacts, error });
                }
            }
        }
    }
    runs
}

/// A percentage, with a decimal where it is small.
fn per_cent(relative: f64) -> String {
    let percent = 100.0 * relative;
    if percent < 9.95 { format!("{percent:.1} %") } else { format!("{percent:.0} %") }
}

#[test]
#[ignore = "long: make test-long"]
fn errors_of_newmarks_method() {
    let runs = runs();
    let errors = |of: &dyn Fn(&Run) -> bool| -> [f64; 2] {
        let sizes: Vec<f64> = runs.iter().filter(|run| of(run)).map(|run| run.error.abs()).collect();
        [0.5, 0.9].map(|level| quantile(&sizes, level))
    };
    let mut computed = vec![("newmark.runs".to_owned(), runs.len().to_string())];
    let mut row = |name: &str, [median, p90]: [f64; 2]| {
        computed.push((format!("newmark.{name}.median"), per_cent(median)));
        computed.push((format!("newmark.{name}.p90"), per_cent(p90)));
    };
    row("all", errors(&|_| true));
    row("few", errors(&|run| run.impacts < 20));
    row("many", errors(&|run| run.impacts >= 100));
    let of_strength = |strength: f64| errors(&|run: &Run| (run.strength - strength).abs() < 1e-9);
    for strength in [0.05, 0.1, 0.2, 0.3, 0.5, 0.8] {
        row(&strength.to_string(), of_strength(strength));
    }
    let between = |place: usize| range([0.2, 0.3, 0.5].map(|strength| 100.0 * of_strength(strength)[place]));
    let ([median_low, median_high], [p90_low, p90_high]) = (between(0), between(1));
    let signed: Vec<f64> = runs.iter().map(|run| run.error).collect();
    // what rounds to zero has no sign
    let tenths = (1000.0 * quantile(&signed, 0.5)).round() / 10.0 + 0.0;
    computed.extend([
        ("newmark.between.median".to_owned(), format!("{median_low:.0} to {median_high:.0} %")),
        ("newmark.between.p90".to_owned(), format!("{p90_low:.0} to {p90_high:.0} %")),
        ("newmark.signed".to_owned(), format!("{tenths:.1} %").replace('-', "−")),
    ]);
    hold("newmark", &computed);
}
