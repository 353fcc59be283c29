//! The envelope q(t): how the intensity of the motion grows and fades.

use super::marginal::gamma_quantile;
use super::parameters::round_parameter;
use crate::STANDARD_GRAVITY_M_S2;
use statrs::distribution::{Continuous, Gamma};
use std::f64::consts::FRAC_2_PI;

/// The motion ends when this fraction of its Arias intensity has come.
const END: f64 = 0.999;

/// Envelope whose square is a gamma density in time.
///
/// q(t)² = (2/π) Iₐ g² p(t), p the gamma density of shape k and scale θ, so that a process q(t) u(t)
/// with u of unit variance has the expected Arias intensity Iₐ.
#[derive(Debug)]
pub(super) struct Envelope {
    density: Gamma,
    scale_s: f64,
    /// (2/π) Iₐ g² \[m²/s³\].
    energy: f64,
    /// Time of 99.9 % of the Arias intensity \[s\].
    pub(super) end_s: f64,
}

impl Envelope {
    /// The envelope with the time `d5_95_s` \[s\] between 5 and 95 % and the time `t_mid_s` \[s\] of
    /// 45 % of the Arias intensity `arias_s_g` \[s·g\].
    ///
    /// `None` where no such envelope starts from zero (shape k ≤ 1: a middle too early for the
    /// duration). Shape and scale are rounded like the parameters.
    pub(super) fn new(arias_s_g: f64, d5_95_s: f64, t_mid_s: f64) -> Option<Self> {
        let shape = round_parameter(shape(d5_95_s / t_mid_s)?);
        let scale_s = round_parameter(t_mid_s / gamma_quantile(shape, 0.45));
        Some(Self {
            density: Gamma::new(shape, 1.0).ok()?,
            scale_s,
            energy: FRAC_2_PI * arias_s_g * STANDARD_GRAVITY_M_S2 * STANDARD_GRAVITY_M_S2,
            end_s: scale_s * gamma_quantile(shape, END),
        })
    }

    /// q(t) \[m/s²\] at `time_s` \[s\].
    pub(super) fn at(&self, time_s: f64) -> f64 {
        // The library's density overflows for shapes near 150, its logarithm does not.
        let density = self.density.ln_pdf(time_s / self.scale_s).exp();
        (self.energy * density / self.scale_s).sqrt()
    }
}

/// The shape k > 1 at which (Q95 − Q5)/Q45, falling with k, is `ratio`; the scale cancels.
fn shape(ratio: f64) -> Option<f64> {
    let ratio_of =
        |shape: f64| (gamma_quantile(shape, 0.95) - gamma_quantile(shape, 0.05)) / gamma_quantile(shape, 0.45);
    // From k = 1 to k = e^9: ratios 4.92 to 0.036. The marginals give no less than 5/40.
    let (mut low, mut high) = (0.0_f64, 9.0_f64);
    if !(ratio_of(low.exp()) > ratio && ratio_of(high.exp()) < ratio) {
        return None;
    }
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if ratio_of(middle.exp()) > ratio {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(low.exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fractions of the Arias intensity at the times asked for, by the trapezoidal rule.
    #[test]
    fn meets_intensity_duration_and_middle() {
        for (d, t_mid) in [(13.0, 7.0), (5.5, 30.0), (40.0, 12.0), (6.0, 1.5), (6.0, 22.3)] {
            let envelope = Envelope::new(0.1, d, t_mid).unwrap();
            let dt = 1e-3;
            let mut arias = vec![0.0];
            let mut time = 0.0;
            while time < 4.0 * envelope.end_s {
                let pair = envelope.at(time).powi(2) + envelope.at(time + dt).powi(2);
                let step = 0.25 * std::f64::consts::PI * pair * dt / STANDARD_GRAVITY_M_S2.powi(2);
                arias.push(arias[arias.len() - 1] + step);
                time += dt;
            }
            let total = arias[arias.len() - 1];
            assert!((total - 0.1).abs() < 1e-5, "{d} {t_mid}: {total}");
            let time_of = |fraction: f64| arias.partition_point(|&a| a < fraction * total) as f64 * dt;
            assert!((time_of(0.45) - t_mid).abs() < 3e-3);
            assert!((time_of(0.95) - time_of(0.05) - d).abs() < 5e-3);
            assert!((time_of(0.999) - envelope.end_s).abs() < 0.02 * envelope.end_s);
        }
    }

    #[test]
    fn shape_of_the_exponential_is_the_limit() {
        // k = 1: (ln 20 − ln(20/19))/ln(20/11) = 4.9253.
        let limit = 19.0_f64.ln() / (20.0_f64 / 11.0).ln();
        assert!(shape(limit * 1.000_1).is_none());
        assert!((shape(limit * 0.999_9).unwrap() - 1.0).abs() < 1e-3);
        // Many terms: normal, (Q95 − Q5)/Q45 → 3.2897/√k.
        let k = shape(0.1).unwrap();
        assert!((3.2897 / k.sqrt() / 0.1 - 1.0).abs() < 0.01, "{k}");
    }
}
