//! Pulse-like ground motions: the classifier of Shahi and Baker (2014), for both horizontal components.
//!
//! A strong pulse in the velocity, as forward directivity near a fault makes it, carries much of a
//! motion's energy in one or two cycles. The classifier looks for it in every horizontal
//! orientation at once:
//!
//! 1. Both velocities (integrals from rest, no baseline correction) are transformed with the
//!    fourth-order Daubechies wavelet, at 51 scales equally spaced from a pseudo-period of 0.25 s to
//!    15 s, and at all times. The transform is linear, so that c₁ cos θ + c₂ sin θ is the
//!    coefficient in the orientation θ, and √(c₁² + c₂²) the largest in any.
//! 2. The largest is a potential pulse; its orientation is that of (c₁, c₂). Within 10/25 of its
//!    scale before and after it all coefficients are struck off, and the largest of the others is
//!    the next, up to five.
//! 3. For each, the velocity is turned to its orientation, its scale refined between the
//!    neighbouring ones, and ten wavelets of that scale are taken out of the velocity one by one,
//!    each where the residual's coefficient is largest within 10/25 of the scale around the first.
//!    Their sum is the pulse. Its period is the wavelet's pseudo-period, 1.4 times its scale.
//! 4. With the ratios residual/original of peak velocity (PGV ratio) and of Σ v² (energy ratio),
//!    PC = 0.63 PGV ratio + 0.777 energy ratio, and the PGV of the turned velocity in cm/s, the
//!    pulse indicator is
//!    PI = 9.384 (0.76 − PC − 0.0616 PGV)(PC + 6.914·10⁻⁴ PGV − 1.072) − 6.179.
//! 5. The pulse is late where 17 % or more of the motion's Σ v² came before the pulse had 5 % of
//!    its own. The motion is pulse-like where one of the five has PI > 0 and is not late; the first
//!    such, in the order of their strength, is reported, else the strongest of all.
//!
//! # What differs from the authors' program
//!
//! The steps and numbers above are those of the program that Shahi published with the paper
//! (`shreyshahi/PulseClassification`); like it, the scales are whole numbers of samples. It writes
//! the indicator as a quadratic form in centred variables, of which the paper's product is the
//! rounding; this crate uses the paper's, and a test compares the two. It transforms at every
//! sample; here the search steps by 1/32 of the scale or less, climbs to the sample from there, and
//! extracts at 1/96 of the scale or less. Its energies are those of the low-pass half of one step of
//! a discrete wavelet transform, here Σ v² at the samples: a velocity has next to nothing in the
//! other half. Its velocity is a plain sum, here the trapezoidal one.
//!
//! On 138 real pairs a plain transcription of the program gives the same class every time (27
//! pulse-like), and the same period within 4 % (most within 1 %) for 26 of the 27. In the other it
//! takes the first potential pulse, this crate the second, as the first is at the limit of lateness.
//! Twice the resolution of the search and twenty times that of the extraction change no class of them.
//!
//! # What it does not say
//!
//! A pulse is not a cause: basins, site response and fling make pulses too. Other classifiers draw
//! the line elsewhere. In particular the near-field set of FEMA P695 takes its classes from Baker
//! (2007), who looked at the fault-normal component only, with other ratios and thresholds.
//!
//! # Speed
//!
//! The transform is a direct convolution, as its step grows with the scale. A pair too weak for any
//! pulse (see [`LEAST_PGV_CM_S`]) is spared four of the five extractions. On the 138 real pairs, 46 s
//! long on average, it takes 11 ms a pair on one core (release build), about in proportion to the
//! length: under a minute for 5,000 such pairs.

mod extract;
mod search;
mod transform;
mod wavelet;

use crate::accelerogram::Accelerogram;
use crate::error::MotionError;
use crate::peaks::{integral, largest_magnitude};
use extract::extract;
use search::{Peak, Scalogram};
use transform::Resolution;

/// Potential pulses looked at.
const CANDIDATES: usize = 5;

/// At or below this peak velocity \[cm/s\] no pulse indicator is above zero, whatever the residual.
///
/// With α = 0.76 − 0.0616 PGV and β = 1.072 − 6.914·10⁻⁴ PGV the indicator is
/// 9.384 (PC − α)(β − PC) − 6.179, at most 9.384 ((β − α)/2)² − 6.179. That is above zero only
/// where β − α > 2 √(6.179/9.384) = 1.62291, and β − α = 0.312 + 0.0609086 PGV.
const LEAST_PGV_CM_S: f64 = 21.52;

/// Two time steps that differ by less than this part of them are the same, written differently.
const SAME_STEP: f64 = 1e-6;

/// What the classifier says about a pair of horizontal components.
///
/// The numbers are those of the pulse found, or of the strongest potential pulse where none is.
/// A pair without motion has ratios of one, the indicator that goes with them, and zeros.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PulseClassification {
    /// Whether the motion is pulse-like: [`indicator`](Self::indicator) above zero and not
    /// [`late`](Self::late).
    pub is_pulse_like: bool,
    /// Pulse indicator PI.
    pub indicator: f64,
    /// Pulse period, the pseudo-period of the wavelet \[s\].
    pub period_s: f64,
    /// Orientation of the pulse, from the first component towards the second, from 0 up to 180
    /// \[degrees\].
    pub orientation_deg: f64,
    /// Peak velocity without the pulse over that with it, in the pulse's orientation.
    pub pgv_ratio: f64,
    /// Σ v² without the pulse over that with it, in the pulse's orientation.
    pub energy_ratio: f64,
    /// Peak ground velocity in the pulse's orientation \[m/s\].
    pub peak_velocity_m_s: f64,
    /// Whether much of the motion comes before the pulse, so that directivity did not make it.
    pub late: bool,
}

/// Classifies the ground motion with the horizontal components `h1` and `h2`, at right angles to
/// each other, as pulse-like or not.
///
/// The components start together; where one is longer, its end is cut. (Components that were
/// trimmed apart are not synchronous: their class and period mostly hold, as one of the two
/// mostly has the pulse, but their orientation says little.)
///
/// # Errors
///
/// [`MotionError::UnequalTimeSteps`] unless the time steps are equal.
///
/// # Source
///
/// S. K. Shahi and J. W. Baker (2014), "An efficient algorithm to identify strong-velocity pulses
/// in multicomponent ground motions", Bulletin of the Seismological Society of America 104(5),
/// 2456–2466, doi 10.1785/0120130191, and the authors' program.
pub fn classify_pulse(h1: &Accelerogram, h2: &Accelerogram) -> Result<PulseClassification, MotionError> {
    classify_at(h1, h2, Resolution::DEFAULT)
}

/// Whether the motion is strong enough to be pulse-like at all: where it is not, [`classify_pulse`]
/// says no, whatever the shape of the motion, and need not be asked.
///
/// Its peak velocity in every direction is above the 21.52 cm/s below which no indicator is above zero.
pub fn may_be_pulse_like(h1: &Accelerogram, h2: &Accelerogram) -> bool {
    let count = h1.len().min(h2.len());
    is_strong(&[h1, h2].map(|motion| velocity_m_s(motion, count)))
}

fn is_strong(velocities: &[Vec<f64>; 2]) -> bool {
    let largest =
        velocities[0].iter().zip(&velocities[1]).fold(0.0, |largest: f64, (v1, v2)| largest.max(v1.hypot(*v2)));
    100.0 * largest > LEAST_PGV_CM_S
}

fn classify_at(
    h1: &Accelerogram,
    h2: &Accelerogram,
    resolution: Resolution,
) -> Result<PulseClassification, MotionError> {
    let dt_s = h1.dt_s();
    if (h2.dt_s() - dt_s).abs() > SAME_STEP * dt_s {
        return Err(MotionError::UnequalTimeSteps { h1_s: dt_s, h2_s: h2.dt_s() });
    }
    let count = h1.len().min(h2.len());
    let velocities = [h1, h2].map(|motion| velocity_m_s(motion, count));
    let candidates = if is_strong(&velocities) { CANDIDATES } else { 1 };

    let mut scalogram = Scalogram::new(&velocities, dt_s, resolution);
    let mut strongest = None;
    for _ in 0..candidates {
        let Some(peak) = scalogram.take_peak() else { break };
        let found = analyse(&velocities, dt_s, &peak, resolution);
        if found.is_pulse_like {
            return Ok(found);
        }
        strongest.get_or_insert(found);
    }
    Ok(strongest.unwrap_or(PulseClassification {
        is_pulse_like: false,
        indicator: indicator(1.0, 1.0, 0.0),
        period_s: 0.0,
        orientation_deg: 0.0,
        pgv_ratio: 1.0,
        energy_ratio: 1.0,
        peak_velocity_m_s: 0.0,
        late: false,
    }))
}

/// Velocity at the first `count` samples \[m/s\], from rest.
fn velocity_m_s(motion: &Accelerogram, count: usize) -> Vec<f64> {
    integral(&motion.acceleration_m_s2()[..count], motion.dt_s())
}

/// Takes the pulse at `peak` out and judges it.
fn analyse(velocities: &[Vec<f64>; 2], dt_s: f64, peak: &Peak, resolution: Resolution) -> PulseClassification {
    let [c1, c2] = peak.coefficients;
    let length = c1.hypot(c2);
    let (cosine, sine) = (c1 / length, c2 / length);
    let turned = velocities[0].iter().zip(&velocities[1]).map(|(v1, v2)| cosine * v1 + sine * v2);
    let turned: Vec<f64> = turned.collect();
    let extraction = extract(&turned, dt_s, peak, resolution);

    let peak_velocity_m_s = largest_magnitude(turned.iter().copied());
    let pgv_ratio = largest_magnitude(extraction.residual.iter().copied()) / peak_velocity_m_s;
    let energy_ratio = energy(&extraction.residual) / energy(&turned);
    let indicator = indicator(pgv_ratio, energy_ratio, 100.0 * peak_velocity_m_s);
    let late = is_late(&turned, &extraction.residual);
    let degrees = c2.atan2(c1).to_degrees().rem_euclid(180.0);
    PulseClassification {
        is_pulse_like: indicator > 0.0 && !late,
        indicator,
        period_s: extraction.period_s,
        // A tiny negative angle is 180 when rounded.
        orientation_deg: if degrees < 180.0 { degrees } else { 0.0 },
        pgv_ratio,
        energy_ratio,
        peak_velocity_m_s,
        late,
    }
}

fn indicator(pgv_ratio: f64, energy_ratio: f64, pgv_cm_s: f64) -> f64 {
    let pc = 0.63 * pgv_ratio + 0.777 * energy_ratio;
    9.384 * (0.76 - pc - 0.0616 * pgv_cm_s) * (pc + 6.914e-4 * pgv_cm_s - 1.072) - 6.179
}

fn energy(signal: &[f64]) -> f64 {
    signal.iter().map(|value| value * value).sum()
}

/// Whether the velocity has 17 % of its energy or more at the last sample at which the pulse
/// (velocity less residual) has 5 % of its own or less.
fn is_late(velocity: &[f64], residual: &[f64]) -> bool {
    let pulse = || velocity.iter().zip(residual).map(|(v, r)| v - r);
    let limit = 0.05 * pulse().map(|p| p * p).sum::<f64>();
    let total = energy(velocity);
    let (mut of_pulse, mut of_motion) = (0.0, 0.0);
    for (p, v) in pulse().zip(velocity) {
        of_pulse += p * p;
        if of_pulse > limit {
            break;
        }
        of_motion += v * v;
    }
    of_motion >= 0.17 * total
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The indicator as the authors' program writes it, in centred variables.
    fn centred(pgv_ratio: f64, energy_ratio: f64, pgv_cm_s: f64) -> f64 {
        let p = (0.63 * pgv_ratio + 0.777 * energy_ratio - 1.208_421) / 0.246_271_7;
        let v = (pgv_cm_s - 11.588_61) / 18.880_15;
        -7.817 - 0.5679 * p * p - 0.1516 * v * v - 3.0253 * p - 1.7396 * v - 2.7156 * p * v
    }

    #[test]
    fn the_indicator_by_hand() {
        // PC = 0.63/2 + 0.777/4 = 0.50925; with 50 cm/s the factors are −2.82925 and −0.52818.
        let expected = 9.384 * (0.76 - 0.50925 - 3.08) * (0.50925 + 0.03457 - 1.072) - 6.179;
        assert!((indicator(0.5, 0.25, 50.0) - expected).abs() < 1e-12);
        assert!((expected - 7.845).abs() < 1e-3);
    }

    #[test]
    fn the_least_velocity_is_where_the_bound_says() {
        let bound_cm_s = (2.0 * (6.179_f64 / 9.384).sqrt() - (1.072 - 0.76)) / (0.0616 - 6.914e-4);
        assert!((0.0..0.01).contains(&(bound_cm_s - LEAST_PGV_CM_S)), "{bound_cm_s}");
        // A little above it, the best of all residuals has a pulse.
        let above = (0..1400).map(|i| indicator(f64::from(i) * 1e-3, 0.0, bound_cm_s + 0.1));
        assert!(above.fold(f64::MIN, f64::max) > 0.0);
    }

    fn sine(dt_s: f64, count: u32, periods_s: &[(f64, f64)]) -> Accelerogram {
        let value =
            |t_s: f64| periods_s.iter().map(move |(period_s, a)| a * (std::f64::consts::TAU * t_s / period_s).sin());
        let envelope = |t_s: f64| (-((t_s - 7.0) / 4.0).powi(2)).exp();
        let samples = (0..count).map(|i| f64::from(i) * dt_s).map(|t_s| envelope(t_s) * value(t_s).sum::<f64>());
        Accelerogram::new(dt_s, samples.collect()).unwrap()
    }

    #[test]
    fn late_by_hand() {
        // A pulse of two equal samples, all of the residual before it: its first 5 % come with
        // the first of them, when the motion has 16 or 17 of 100 parts.
        let late = |before: f64| {
            let rest = 100.0 - before;
            let velocity = [before.sqrt(), (rest / 2.0).sqrt(), (rest / 2.0).sqrt()];
            is_late(&velocity, &[velocity[0], 0.0, 0.0])
        };
        assert!(!late(16.9));
        assert!(late(17.1));
        // A pulse from the first sample on is never late.
        assert!(!is_late(&[1.0, 1.0], &[0.0, 0.0]));
    }

    #[test]
    fn much_finer_steps_change_no_class_and_no_period() {
        let finer = Resolution { search: 80.0, extraction: 400.0 };
        for (periods_1, periods_2) in [
            (&[(2.0, 3.0), (0.4, 2.0)][..], &[(2.0, -1.0), (0.3, 2.0)][..]),
            (&[(5.0, 1.0), (0.9, 0.5)], &[(4.0, 1.0)]),
            (&[(0.5, 3.0), (0.37, 2.0)], &[(1.0, 1.5), (0.21, 5.0)]),
            (&[(0.3, 0.2)], &[(0.8, 0.3)]),
        ] {
            let [h1, h2] = [sine(0.01, 3000, periods_1), sine(0.01, 3000, periods_2)];
            let [usual, fine] =
                [Resolution::DEFAULT, finer].map(|resolution| classify_at(&h1, &h2, resolution).unwrap());
            assert_eq!((usual.is_pulse_like, usual.late), (fine.is_pulse_like, fine.late), "{usual:?} {fine:?}");
            assert!((usual.period_s / fine.period_s - 1.0).abs() < 0.01, "{usual:?} {fine:?}");
            assert!((usual.indicator - fine.indicator).abs() < 0.3, "{usual:?} {fine:?}");
            assert!((usual.orientation_deg - fine.orientation_deg).abs() < 1.0, "{usual:?} {fine:?}");
        }
    }

    proptest! {
        /// The paper's product against the program's quadratic form, of which it is the rounding.
        #[test]
        fn both_ways_to_write_the_indicator_agree(pgv in 0.0..1.0_f64, energy in 0.0..1.0_f64, cm_s in 0.0..150.0_f64) {
            let [product, quadratic] = [indicator(pgv, energy, cm_s), centred(pgv, energy, cm_s)];
            prop_assert!((product - quadratic).abs() < 0.1 + 0.01 * cm_s, "{product} {quadratic}");
        }

        #[test]
        fn weak_motions_have_no_pulse_whatever_the_residual(pc in 0.0..3.0_f64, cm_s in 0.0..=LEAST_PGV_CM_S) {
            prop_assert!(indicator(pc / 0.63, 0.0, cm_s) <= 0.0);
        }
    }
}
