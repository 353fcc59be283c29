//! One step of the motion as a Taylor series, in whose coefficients the nonlinear equation of motion is a recurrence.
//!
//! In the frame of the corner on which the block stands, x = |θ| ≥ 0, both signs of Eq. 2.1 read
//!
//! ẍ = −p² (sin ψ + A cos ψ), ψ = α − x, A = ±üg/g,
//!
//! with the upper sign on the positive corner. With v = ẋ, S = sin ψ and C = cos ψ, so that Ṡ = −C v and Ċ = S v, the
//! coefficients of all five follow from those before, a product being a convolution:
//!
//! * (k+1) vₖ₊₁ = −p² h (Sₖ + Σ Aⱼ Cₖ₋ⱼ), (k+1) xₖ₊₁ = h vₖ,
//! * (k+1) Sₖ₊₁ = −h Σ Cⱼ vₖ₋ⱼ, (k+1) Cₖ₊₁ = h Σ Sⱼ vₖ₋ⱼ,
//!
//! for powers of s = time/h. One sine and one cosine a step; no stages, no interpolant: the step is its own dense
//! output. The series goes on until two terms running are below half a rounding of its largest, or, at [`ORDER`], the
//! step is shortened until they are.
//!
//! # Source
//! E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, Section I.8 (recursive
//! Taylor coefficients).

pub(crate) mod side_by_side;

use crate::sine::sine_and_cosine;
use uplift_taylor::{DEGREE, Forcing, LEAST_ORDER, ORDER, TRUNCATION, stretch, value};

/// 1/(k + 1).
const INVERSE: [f64; ORDER + 1] = {
    let mut table = [1.0; ORDER + 1];
    let mut k = 0;
    while k <= ORDER {
        table[k] = 1.0 / (k + 1) as f64;
        k += 1;
    }
    table
};

/// The motion on a step, in powers of s from 0 to 1.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    /// Length of the step \[s\], at most what was asked.
    pub(crate) step_s: f64,
    x: [f64; DEGREE + 1],
    v: [f64; ORDER + 1],
    sine: [f64; ORDER + 1],
    cosine: [f64; ORDER + 1],
    order: usize,
}

impl Series {
    /// Of no step yet.
    pub(crate) const EMPTY: Self = Self {
        step_s: 0.0,
        x: [0.0; DEGREE + 1],
        v: [0.0; ORDER + 1],
        sine: [0.0; ORDER + 1],
        cosine: [0.0; ORDER + 1],
        order: 0,
    };

    /// Makes it the motion from the rotation `x` and velocity `v`, with p² and α, under `forcing` in units of g on a
    /// step of `step_s`.
    pub(crate) fn expand(&mut self, x: f64, v: f64, forcing: &Forcing, step_s: f64, p_squared: f64, alpha: f64) {
        let h = step_s;
        let Self { x: xs, v: vs, sine, cosine, .. } = self;
        (xs[0], vs[0]) = (x, v);
        (sine[0], cosine[0]) = sine_and_cosine(alpha - x);
        let a = forcing.coefficients();
        let mut largest = v.abs();
        let mut order = 0;
        for k in 0..ORDER {
            let of_rate = h * INVERSE[k];
            let moment = if k == 0 && x == 0.0 {
                // as a difference of tangents it vanishes exactly at uplift
                cosine[0] * (sine[0] / cosine[0] + a[0])
            } else {
                sine[k] + a.iter().zip(cosine[..=k].iter().rev()).map(|(a, c)| a * c).sum::<f64>()
            };
            vs[k + 1] = -p_squared * of_rate * moment;
            let (mut ds, mut dc) = (0.0, 0.0);
            for ((s, c), v) in sine[..=k].iter().zip(&cosine[..=k]).zip(vs[..=k].iter().rev()) {
                ds -= c * v;
                dc += s * v;
            }
            (sine[k + 1], cosine[k + 1]) = (of_rate * ds, of_rate * dc);
            xs[k + 1] = of_rate * vs[k];
            largest = largest.max(vs[k + 1].abs());
            order = k + 1;
            if order >= LEAST_ORDER && vs[order].abs().max(vs[order - 1].abs()) <= TRUNCATION * largest {
                break;
            }
        }
        xs[order + 1] = h * INVERSE[order] * vs[order];
        (self.step_s, self.order) = (h, order);
        while let Some(ratio) = self.excess() {
            self.shorten(ratio);
        }
    }

    /// By what to shorten the step if the last two terms are not negligible beside the largest.
    fn excess(&self) -> Option<f64> {
        let size = |v: &[f64]| v.iter().fold(0.0_f64, |largest, v| largest.max(v.abs()));
        let tail = size(&self.v[self.order - 1..=self.order]);
        let allowed = TRUNCATION * size(self.v());
        (tail > allowed).then(|| 0.9 * (allowed / tail).powf(1.0 / self.order as f64))
    }

    fn shorten(&mut self, ratio: f64) {
        self.step_s *= ratio;
        stretch(&mut self.x[..self.order + 2], ratio);
        stretch(&mut self.v[..=self.order], ratio);
    }

    /// Coefficients of the rotation.
    pub(crate) fn x(&self) -> &[f64] {
        &self.x[..self.order + 2]
    }

    /// Coefficients of the velocity.
    pub(crate) fn v(&self) -> &[f64] {
        &self.v[..=self.order]
    }

    /// Rotation and velocity at s.
    pub(crate) fn at(&self, s: f64) -> (f64, f64) {
        (value(self.x(), s), value(self.v(), s))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expanded(x: f64, v: f64, forcing: &Forcing, step_s: f64, p_squared: f64, alpha: f64) -> Series {
        let mut series = Series::EMPTY;
        series.expand(x, v, forcing, step_s, p_squared, alpha);
        series
    }

    /// v²/2 + p² cos(α − x) is constant without shaking: at the end of a step as long as the series allows, and inside.
    #[test]
    fn a_step_conserves_energy_to_rounding() {
        for (x, v, alpha, p2) in [(0.05, 0.3, 0.2, 4.0), (0.0, 1e-6, 0.1, 1.0), (0.9, -2.0, 0.5, 30.0)] {
            let series = expanded(x, v, &Forcing::none(), 10.0, p2, alpha);
            assert!(series.step_s * p2.sqrt() > 0.2, "{}", series.step_s);
            let energy = |(x, v): (f64, f64)| 0.5 * v * v - 2.0 * p2 * (0.5 * (alpha - x)).sin().powi(2);
            for s in [0.25, 0.5, 1.0] {
                let change = energy(series.at(s)) - energy((x, v));
                assert!(change.abs() < 2e-15 * p2, "{change:e} at {s}");
            }
        }
    }

    /// With α, A and x so small that the equation is linear: ẍ = p² (x − α − A).
    #[test]
    fn a_step_of_the_linear_limit_is_a_hyperbolic_cosine() {
        let (alpha, p, h) = (1e-9, 1.5, 0.4);
        let mut forcing = Forcing::none();
        forcing = forcing.beginning_at(-3e-9);
        let series = expanded(0.5e-9, 0.0, &forcing, h, p * p, alpha);
        assert_eq!(series.step_s, h);
        let exact = -2e-9 + 2.5e-9 * (p * h).cosh();
        assert!((series.at(1.0).0 / exact - 1.0).abs() < 1e-15);
    }

    #[test]
    fn an_interval_of_a_record_takes_a_low_order() {
        let mut forcing = Forcing::default();
        forcing.push(-0.3);
        forcing.push(0.05);
        for (size, v) in [(1.0, 1.0), (10.0, 0.3), (500.0, 0.01)] {
            let series = expanded(0.02, v, &forcing, 0.01, 0.75 * 9.8 / size, 0.2);
            println!("R = {size} m: order {}", series.order);
            assert!((4..=10).contains(&series.order) && series.step_s == 0.01);
        }
    }

    #[test]
    fn splitting_a_step_changes_nothing() {
        let mut forcing = Forcing::default();
        forcing.push(-0.3);
        forcing.push(0.1);
        let (p2, alpha, h) = (3.0, 0.25, 0.3);
        let whole = expanded(0.02, 0.1, &forcing, h, p2, alpha);
        assert_eq!(whole.step_s, h);
        let (x, v) = expanded(0.02, 0.1, &forcing.stretched(0.5), 0.5 * h, p2, alpha).at(1.0);
        let second = forcing.stretched(0.5).beginning_at(forcing.value(0.5));
        let halves = expanded(x, v, &second, 0.5 * h, p2, alpha).at(1.0);
        assert!((whole.at(1.0).0 - halves.0).abs() < 1e-16, "{:?} {halves:?}", whole.at(1.0));
        assert!((whole.at(1.0).1 - halves.1).abs() < 3e-16);
    }
}
