//! What a fixed step explains of the dissertation's medians (docs/comparison.md): central differences at a
//! tenth of the sampling interval and at the whole of it, impacts at the end of the step in which they happen, beside
//! the exact solution and its noise, all of them to the end of the record. The program itself steps nowhere.

use std::fmt::Write as _;

use rayon::prelude::*;
use uplift_ida::{System, Unwatched, analyse};
use uplift_motion::IntensityMeasure::{Pga, Pgv};
use uplift_motion::STANDARD_GRAVITY_M_S2;
use uplift_oscillator::Oscillator;
use uplift_spectra::{Motion, MotionSet, NoiseSweep, Noisy, ScaledBy, Scaling, percentile};

use super::design_tables::printed_medians;
use super::marks::hold;
use super::{range, real_record_sets};

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

/// A printed median beside ours: exact, a tenth of the sampling interval, the whole of it; all within 1 % of strength.
struct Compared {
    set: String,
    scaling: Scaling,
    by: ScaledBy,
    printed: f64,
    /// Half a unit of the last printed digit.
    rounding: f64,
    ours: [Noisy; 3],
}

impl Compared {
    fn holds(&self, way: usize) -> bool {
        let ours = self.ours[way];
        (ours.lowest - self.rounding..=ours.highest + self.rounding).contains(&self.printed)
    }

    /// Its row: the ranges, `in` behind those that hold the printed value.
    fn row(&self) -> String {
        let set = self.set.trim_start_matches("near-field ");
        let mut row = format!("| {set}, {}, by {} | {:.3} |", self.scaling, self.by.key(), self.printed);
        for (way, ours) in self.ours.iter().enumerate() {
            let held = if self.holds(way) { " in" } else { "" };
            write!(row, " {:.3}–{:.3}{held} |", ours.lowest, ours.highest).unwrap();
        }
        row
    }
}

/// Medians of a set scaled in one way, exact and stepped.
fn medians(set: &MotionSet<'_>, scaling: Scaling, strengths: &[f64]) -> [Noisy; 3] {
    let systems: Vec<_> = strengths.iter().map(|eta| System::Oscillator(Oscillator::zsbe(*eta).unwrap())).collect();
    let all = analyse(&set.plan(&[scaling], &systems, false).unwrap(), &Unwatched).unwrap();
    let exact: Vec<f64> = (0..systems.len()).map(|system| percentile(&all.over_motions_m(system, 0), 50.0)).collect();
    let factors = set.factors(scaling);
    let stepped = |steps| {
        let median = |strength: &f64| {
            let peaks = set.motions().iter().zip(&factors).map(|(m, f)| stepped_m(*strength, m, *f, steps));
            percentile(&peaks.collect::<Vec<_>>(), 50.0)
        };
        Noisy::from_sweep(&strengths.par_iter().map(median).collect::<Vec<_>>())
    };
    [Noisy::from_sweep(&exact), stepped(10), stepped(1)]
}

/// All 36, by component first.
fn compared() -> Option<Vec<Compared>> {
    let sets = real_record_sets()?;
    let strengths: Vec<f64> =
        NoiseSweep::new(0.01, 21).unwrap().factors().iter().map(|factor| factor * (1.6_f64 / 9.6).tan()).collect();
    let printed = printed_medians();
    let mut compared = Vec::new();
    for by in ScaledBy::ALL {
        for set in sets.motions(STANDARD_GRAVITY_M_S2).unwrap() {
            for (measure, multiple) in [Pga, Pgv].into_iter().flat_map(|im| [0.5, 1.0, 2.0].map(|to| (im, to))) {
                let scaling = Scaling::To { measure, multiple, by };
                let name = format!("{multiple:.1}{}", measure.label());
                compared.push(Compared {
                    set: set.name().to_owned(),
                    scaling,
                    by,
                    printed: printed[&(set.name().to_owned(), name)],
                    rounding: 0.0005,
                    ours: medians(&set, scaling, &strengths),
                });
            }
        }
    }
    Some(compared)
}

/// Largest change, per cent, of a value beside the exact one, in both ways of stepping.
fn largest(compared: &[Compared], of: fn(&Noisy) -> [f64; 2]) -> String {
    let change = |way: usize| {
        let changes = compared.iter().flat_map(|row| {
            let (stepped, exact) = (of(&row.ours[way]), of(&row.ours[0]));
            [0, 1].map(|end| 100.0 * (stepped[end] / exact[end] - 1.0).abs())
        });
        range(changes)[1]
    };
    format!("{:.0} and {:.0} %", change(1), change(2))
}

/// Minutes on a busy machine: three ways, 36 medians of as many as 42 motions at 21 strengths.
#[test]
#[ignore = "minutes: make doc-figures"]
fn medians_with_a_fixed_step() {
    let Some(compared) = compared() else { return };
    let of = |by: ScaledBy| compared.iter().filter(move |row| row.by == by);
    let count = |by, way: usize| of(by).filter(|row| row.holds(way)).count();
    let counts = |by| format!("{}, {} and {}", count(by, 0), count(by, 1), count(by, 2));
    let disagree = compared.iter().filter(|row| (0..3).any(|way| !row.holds(way)));
    let mut table =
        "\n\n| set, scaling | printed | exact | a tenth | the whole interval |\n|---|---|---|---|---|\n".to_owned();
    for row in disagree {
        writeln!(table, "{}", row.row()).unwrap();
    }
    table.push('\n');
    let noise = range(compared.iter().flat_map(|row| {
        let Noisy { value, lowest, highest } = row.ours[0];
        [1.0 - lowest / value, highest / value - 1.0]
    }));
    let mut computed = vec![
        ("table".to_owned(), table),
        ("medians".to_owned(), largest(&compared, |noisy| [noisy.value; 2])),
        ("ends".to_owned(), largest(&compared, |noisy| [noisy.lowest, noisy.highest])),
        ("noise".to_owned(), format!("{:.0} %", 100.0 * noise[1])),
    ];
    for by in ScaledBy::ALL {
        for (name, value) in [("counts", counts(by)), ("ratio", ratio(of(by)))] {
            computed.push((format!("{}.{name}", by.key()), value));
        }
    }
    let computed: Vec<_> = computed.into_iter().map(|(name, value)| (format!("fixed-step.{name}"), value)).collect();
    hold("fixed-step", &computed);
}

/// Ours over the printed medians: geometric mean, and root of the mean square of its logarithm.
fn ratio<'a>(rows: impl Iterator<Item = &'a Compared>) -> String {
    let logarithms: Vec<f64> = rows.map(|row| (row.ours[0].value / row.printed).ln()).collect();
    let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / logarithms.len() as f64;
    let ratio = mean(&mut logarithms.iter().copied()).exp();
    let scatter = mean(&mut logarithms.iter().map(|ln| ln * ln)).sqrt();
    format!("{ratio:.2} ({scatter:.2})")
}
