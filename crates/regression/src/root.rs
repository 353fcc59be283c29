//! Root of a continuous function in a bracket.

/// Where `f` crosses zero from below, for f(`low`) < 0 ≤ f(`high`), to the resolution of the numbers.
///
/// The ITP method: a step of false position, pulled towards the middle just enough that the number of evaluations never
/// exceeds bisection's by more than one, while smooth functions need about ten.
///
/// # Source
/// I. F. D. Oliveira and R. H. C. Takahashi (2020), ACM Transactions on Mathematical Software 47 (1), 5.
pub(crate) fn rising_root(mut f: impl FnMut(f64) -> f64, low: (f64, f64), high: (f64, f64)) -> f64 {
    let ((mut a, mut fa), (mut b, mut fb)) = (low, high);
    debug_assert!(a < b && fa < 0.0 && fb >= 0.0);
    let tolerance = 2.0 * f64::EPSILON * a.abs().max(b.abs());
    let width = b - a;
    let mut radius = tolerance * (width / (2.0 * tolerance)).log2().ceil().max(0.0).exp2() * 2.0;
    while b - a > 2.0 * tolerance {
        let middle = f64::midpoint(a, b);
        let secant = (fb * a - fa * b) / (fb - fa);
        let towards_middle = (middle - secant).signum();
        let truncation = 0.2 / width * (b - a) * (b - a);
        let truncated =
            if truncation <= (middle - secant).abs() { secant + towards_middle * truncation } else { middle };
        let reach = (radius - (b - a) / 2.0).max(0.0);
        let projected = if (truncated - middle).abs() <= reach { truncated } else { middle - towards_middle * reach };
        // Rounding, or an infinite slope, may throw the step out of the bracket.
        let x = if projected > a && projected < b { projected } else { middle };
        if x <= a || x >= b {
            break;
        }
        let fx = f(x);
        if fx >= 0.0 {
            (b, fb) = (x, fx);
        } else {
            (a, fa) = (x, fx);
        }
        if fx == 0.0 {
            return x;
        }
        radius /= 2.0;
    }
    f64::midpoint(a, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solve(f: impl Fn(f64) -> f64, a: f64, b: f64) -> (f64, usize) {
        let mut calls = 0;
        let root = rising_root(
            |x| {
                calls += 1;
                f(x)
            },
            (a, f(a)),
            (b, f(b)),
        );
        (root, calls)
    }

    #[test]
    fn roots_known_exactly() {
        let (root, calls) = solve(|x| x * x - 2.0, 1.0, 2.0);
        assert!((root - 2.0_f64.sqrt()).abs() < 1e-15 * 2.0);
        assert!(calls <= 15, "{calls}");
        let (root, calls) = solve(|x| x.exp() - 5.0, 0.0, 10.0);
        assert!((root - 5.0_f64.ln()).abs() < 1e-14);
        assert!(calls <= 20, "{calls}");
    }

    #[test]
    fn hard_functions_cost_no_more_than_bisection() {
        for f in [|x: f64| if x < 0.3 { -1.0 } else { 1e-9 }, |x: f64| (x - 0.3).powi(9), |x: f64| (x - 0.3).cbrt()] {
            let (root, calls) = solve(f, 0.1, 1.0);
            assert!((root - 0.3).abs() < 1e-15, "{root}");
            assert!(calls <= 54, "{calls}");
        }
    }
}
