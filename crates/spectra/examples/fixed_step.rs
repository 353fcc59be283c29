//! What a fixed step makes of the medians of Section 3.4.5: central differences at a tenth of the sampling interval,
//! impacts at the end of the step in which they happen, beside the exact solution and its noise, all of them to the end
//! of the record. The program itself steps nowhere.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

#[path = "../tests/real_records/real.rs"]
mod real;

use uplift_ida::{System, Unwatched, analyse};
use uplift_motion::IntensityMeasure::{Pga, Pgv};
use uplift_motion::STANDARD_GRAVITY_M_S2;
use uplift_oscillator::Oscillator;
use uplift_spectra::{Motion, NoiseSweep, Noisy, ScaledBy, Scaling, percentile};

const UPLIFT_M: f64 = 0.0005;
const RESTITUTION: f64 = 0.95;

/// Peak displacement, m, of the zero-stiffness oscillator by central differences with `steps` steps a sample.
fn stepped_m(strength: f64, motion: &Motion<'_>, scale: f64, steps: u32) -> f64 {
    let force_m_s2 = |u: f64| strength * STANDARD_GRAVITY_M_S2 * (u / UPLIFT_M).clamp(-1.0, 1.0);
    let dt_s = motion.accelerogram.dt_s() / f64::from(steps);
    let ground = |pair: &[f64], step: u32| scale * (pair[0] + (pair[1] - pair[0]) * f64::from(step) / f64::from(steps));
    let samples = motion.accelerogram.acceleration_m_s2();
    let (mut u, mut v, mut peak_m) = (0.0_f64, 0.0, 0.0_f64);
    let mut a = -ground(&samples[..2], 0);
    for pair in samples.windows(2) {
        for step in 1..=steps {
            let before = u;
            let half = v + 0.5 * dt_s * a;
            u += dt_s * half;
            a = -ground(pair, step) - force_m_s2(u);
            v = half + 0.5 * dt_s * a;
            if before.abs() > UPLIFT_M && (u.abs() <= UPLIFT_M || u * before < 0.0) {
                v *= RESTITUTION;
            }
            peak_m = peak_m.max(u.abs());
        }
    }
    peak_m
}

fn main() {
    let Some(sets) = real::real_sets() else { return println!("no real records (set UPLIFT_RECORDS)") };
    let strengths: Vec<f64> =
        NoiseSweep::new(0.01, 21).unwrap().factors().iter().map(|factor| factor * (1.6_f64 / 9.6).tan()).collect();
    let systems: Vec<_> = strengths.iter().map(|eta| System::Oscillator(Oscillator::zsbe(*eta).unwrap())).collect();
    println!(
        "medians, m: exact (lowest to highest within 1 % of strength) | a tenth of the sampling interval | a whole one"
    );
    for set in &sets {
        let set = set.motions();
        for by in ScaledBy::ALL {
            for (measure, multiple) in
                [Pga, Pgv].into_iter().flat_map(|measure| [0.5, 1.0, 2.0].map(|to| (measure, to)))
            {
                let scaling = Scaling::To { measure, multiple, by };
                let all = analyse(&set.plan(&[scaling], &systems, false).unwrap(), &Unwatched).unwrap();
                let exact: Vec<f64> =
                    (0..systems.len()).map(|system| percentile(&all.over_motions_m(system, 0), 50.0)).collect();
                let stepped = |steps| {
                    let medians = strengths.iter().map(|strength| {
                        let factors = set.factors(scaling);
                        let peaks = set.motions().iter().zip(factors).map(|(m, f)| stepped_m(*strength, m, f, steps));
                        percentile(&peaks.collect::<Vec<_>>(), 50.0)
                    });
                    Noisy::of(&medians.collect::<Vec<_>>())
                };
                let show = |noisy: Noisy| format!("{:.3} ({:.3} to {:.3})", noisy.value, noisy.lowest, noisy.highest);
                let columns = [Noisy::of(&exact), stepped(10), stepped(1)].map(show).join(" | ");
                println!("{} by {}, {scaling}: {columns}", set.name(), by.key());
            }
        }
    }
}
