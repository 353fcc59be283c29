//! The problem with the linear coefficients removed: the best error that one exponent allows.

/// Points in the variables of the search, without units and without large numbers.
///
/// The abscissa x ∈ [0, 1] is the distance from the end where the exponential is largest, over the range of strengths;
/// the model is amplitude · exp(−s x) + offset, offset ≥ 0, s > 0, whose exponential never exceeds 1.
pub(crate) struct Reduced {
    pub(crate) x: Vec<f64>,
    pub(crate) u: Vec<f64>,
    mean: f64,
}

/// Least-squares solution for one decay s.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Solution {
    pub(crate) s: f64,
    pub(crate) amplitude: f64,
    pub(crate) offset: f64,
    /// The offset is held at 0; without the bound it would be negative.
    pub(crate) bound_active: bool,
    /// Sum of squared residuals.
    pub(crate) sse: f64,
    /// Its derivative with respect to s, the linear coefficients following.
    pub(crate) slope: f64,
}

impl Reduced {
    pub(crate) fn new(x: Vec<f64>, u: Vec<f64>) -> Self {
        let mean = u.iter().sum::<f64>() / u.len() as f64;
        Self { x, u, mean }
    }

    /// The best amplitude and offset for decay `s`: the free solution, or where its offset is negative the one on the
    /// bound. (With one bound on a strictly convex problem these two cases are all.)
    ///
    /// The error is differentiable in s through the change of case, and since both coefficients are optimal only the
    /// exponential's own dependence on s counts: dE/ds = 2 Σ r · amplitude · x exp(−s x), r the residual.
    pub(crate) fn solve(&self, s: f64) -> Solution {
        let n = self.x.len() as f64;
        // exp − 1 keeps the digits that a small s needs.
        let decay: Vec<f64> = self.x.iter().map(|&x| (-s * x).exp_m1()).collect();
        let decay_mean = decay.iter().sum::<f64>() / n;
        let (mut square, mut product) = (0.0, 0.0);
        for (&d, &u) in decay.iter().zip(&self.u) {
            let centred = d - decay_mean;
            square += centred * centred;
            product += centred * (u - self.mean);
        }
        let free = product / square;
        let free_offset = self.mean - free * (1.0 + decay_mean);
        let bound_active = free_offset < 0.0;
        let (amplitude, offset) = if bound_active { (self.through_zero(&decay), 0.0) } else { (free, free_offset) };

        let (mut sse, mut slope) = (0.0, 0.0);
        for ((&d, &u), &x) in decay.iter().zip(&self.u).zip(&self.x) {
            let residual =
                if bound_active { u - amplitude * (1.0 + d) } else { (u - self.mean) - amplitude * (d - decay_mean) };
            sse += residual * residual;
            slope += residual * (1.0 + d) * x;
        }
        Solution { s, amplitude, offset, bound_active, sse, slope: 2.0 * amplitude * slope }
    }

    /// Best amplitude without an offset.
    fn through_zero(&self, decay: &[f64]) -> f64 {
        let (square, product) = decay.iter().zip(&self.u).fold((0.0, 0.0), |(square, product), (&d, &u)| {
            let phi = 1.0 + d;
            (square + phi * phi, product + phi * u)
        });
        product / square
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wavy() -> Reduced {
        let x: Vec<f64> = (0..20).map(|i| f64::from(i) / 19.0).collect();
        let u = x.iter().map(|x| (-3.0 * x).exp() + 0.1 * (17.0 * x).sin() - 0.05).collect();
        Reduced::new(x, u)
    }

    #[test]
    fn slope_is_the_derivative_of_the_error_in_both_cases() {
        let problem = wavy();
        let mut cases = [false; 2];
        for s in [0.3, 1.0, 2.0, 4.0, 8.0, 20.0] {
            let h = 1e-5 * s;
            let numeric = (problem.solve(s + h).sse - problem.solve(s - h).sse) / (2.0 * h);
            let at = problem.solve(s);
            assert!((at.slope - numeric).abs() < 1e-8 * (1.0 + numeric.abs()), "{s}: {} {numeric}", at.slope);
            cases[usize::from(at.bound_active)] = true;
        }
        assert_eq!(cases, [true; 2], "both cases occur");
    }

    #[test]
    fn no_admissible_neighbour_is_better() {
        let problem = wavy();
        for s in [0.3, 2.0, 20.0] {
            let best = problem.solve(s);
            let error = |amplitude: f64, offset: f64| -> f64 {
                let residual = |(x, u): (&f64, &f64)| u - amplitude * (-s * x).exp() - offset;
                problem.x.iter().zip(&problem.u).map(|point| residual(point).powi(2)).sum()
            };
            assert!((error(best.amplitude, best.offset) - best.sse).abs() < 1e-14);
            for (da, db) in
                [(1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-3), (1e-3, 1e-3), (-1e-3, 1e-3), (0.0, -1e-3), (1e-3, -1e-3)]
            {
                if best.offset + db >= 0.0 {
                    assert!(error(best.amplitude + da, best.offset + db) > best.sse);
                }
            }
        }
    }
}
