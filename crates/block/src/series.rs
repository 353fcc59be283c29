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

use uplift_taylor::{DEGREE, Forcing, LEAST_ORDER, ORDER, TRUNCATION, stretch, value};

/// The motion on a step, in powers of s from 0 to 1.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    /// Length of the step \[s\], at most what was asked.
    pub(crate) step_s: f64,
    x: [f64; DEGREE + 1],
    v: [f64; ORDER + 1],
    order: usize,
}

impl Series {
    /// The motion from the rotation `x` and velocity `v`, with p² and α, under `forcing` in units of g
    /// on a step of `step_s`.
    pub(crate) fn expand(x: f64, v: f64, forcing: &Forcing, step_s: f64, p_squared: f64, alpha: f64) -> Self {
        let h = step_s;
        let mut xs = [0.0; DEGREE + 1];
        let mut vs = [0.0; ORDER + 1];
        let mut sine = [0.0; ORDER + 1];
        let mut cosine = [0.0; ORDER + 1];
        (xs[0], vs[0]) = (x, v);
        (sine[0], cosine[0]) = (alpha - x).sin_cos();
        let a = forcing.coefficients();
        let mut largest = v.abs();
        let mut order = 0;
        for k in 0..ORDER {
            let inverse = 1.0 / (k + 1) as f64;
            let moment = if k == 0 {
                // as a difference of tangents it vanishes exactly at uplift
                cosine[0] * (sine[0] / cosine[0] + a[0])
            } else {
                sine[k] + a.iter().zip(cosine[..=k].iter().rev()).map(|(a, c)| a * c).sum::<f64>()
            };
            vs[k + 1] = -p_squared * h * inverse * moment;
            let (mut ds, mut dc) = (0.0, 0.0);
            for j in 0..=k {
                ds -= cosine[j] * vs[k - j];
                dc += sine[j] * vs[k - j];
            }
            (sine[k + 1], cosine[k + 1]) = (h * inverse * ds, h * inverse * dc);
            xs[k + 1] = h * inverse * vs[k];
            largest = largest.max(vs[k + 1].abs());
            order = k + 1;
            if order >= LEAST_ORDER && vs[order].abs().max(vs[order - 1].abs()) <= TRUNCATION * largest {
                break;
            }
        }
        xs[order + 1] = h / (order + 1) as f64 * vs[order];
        let mut series = Self { step_s: h, x: xs, v: vs, order };
        while let Some(ratio) = series.excess() {
            series.shorten(ratio);
        }
        series
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
        stretch(&mut self.x, ratio);
        stretch(&mut self.v, ratio);
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
    #![allow(clippy::print_stdout)]
    use super::*;

    /// v²/2 + p² cos(α − x) is constant without shaking: at the end of a step as long as the series allows, and inside.
    #[test]
    fn a_step_conserves_energy_to_rounding() {
        for (x, v, alpha, p2) in [(0.05, 0.3, 0.2, 4.0), (0.0, 1e-6, 0.1, 1.0), (0.9, -2.0, 0.5, 30.0)] {
            let series = Series::expand(x, v, &Forcing::none(), 10.0, p2, alpha);
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
        let series = Series::expand(0.5e-9, 0.0, &forcing, h, p * p, alpha);
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
            let series = Series::expand(0.02, v, &forcing, 0.01, 0.75 * 9.8 / size, 0.2);
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
        let whole = Series::expand(0.02, 0.1, &forcing, h, p2, alpha);
        assert_eq!(whole.step_s, h);
        let (x, v) = Series::expand(0.02, 0.1, &forcing.stretched(0.5), 0.5 * h, p2, alpha).at(1.0);
        let second = forcing.stretched(0.5).beginning_at(forcing.value(0.5));
        let halves = Series::expand(x, v, &second, 0.5 * h, p2, alpha).at(1.0);
        assert!((whole.at(1.0).0 - halves.0).abs() < 1e-16, "{:?} {halves:?}", whole.at(1.0));
        assert!((whole.at(1.0).1 - halves.1).abs() < 3e-16);
    }
}
