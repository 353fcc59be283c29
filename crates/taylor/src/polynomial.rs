//! Sign changes of a polynomial on [0, 1], without missing one: Bernstein form, Descartes' rule of signs, bisection.
//!
//! A polynomial has no more sign changes on an interval than the sequence of its Bernstein coefficients there, and as
//! many up to an even number. None or one is therefore certain; in between the interval is halved (de Casteljau). A
//! touch of zero without a change of sign, a double root, ends at the depth limit and does not count.

use std::ops::ControlFlow;

/// Largest degree.
pub const DEGREE: usize = 25;

/// How far one bound must be above another for roundings not to matter.
pub(crate) const CERTAIN: f64 = 1.0 + 1e-12;

/// What may be zero but for roundings, in parts of the sum of all terms.
const ROUNDING: f64 = 1e-12;

/// Halvings of the interval before two roots are one touch.
const DEPTH: u32 = 48;

/// Σ cₖ sᵏ.
#[inline]
pub fn value(c: &[f64], s: f64) -> f64 {
    c.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

/// The first sign change in (0, 1) of the polynomial of coefficients `c`, lowest power first.
pub fn first_sign_change(c: &[f64]) -> Option<f64> {
    let mut first = None;
    let _ = sign_changes(c, &mut |s| {
        first = Some(s);
        ControlFlow::Break(())
    });
    first
}

/// Calls `visit` with every sign change in (0, 1), ascending, until it breaks. A zero at an end of
/// the interval does not count.
pub fn sign_changes(c: &[f64], visit: &mut impl FnMut(f64) -> ControlFlow<()>) -> ControlFlow<()> {
    if c.len() < 2 {
        return ControlFlow::Continue(());
    }
    let end = value(c, 1.0);
    match crosses(c, end) {
        Some(true) => return visit(solve(c, [0.0, 1.0], [c[0], end], c[0].signum())),
        Some(false) => return ControlFlow::Continue(()),
        None => {}
    }
    let bernstein = to_bernstein(c);
    search(c, &bernstein[..c.len()], [0.0, 1.0], DEPTH, visit)
}

/// Whether the polynomial, which is `end` at 1, changes sign once in (0, 1), or not at all, if its own coefficients say
/// so. Where it rises, falls or bends to one side throughout, so do its Bernstein coefficients. Unless an end is zero
/// to rounding, ends of different signs then mean one change; ends of one sign mean none if it rises or falls, or bends
/// away from zero.
fn crosses(c: &[f64], end: f64) -> Option<bool> {
    let [mut size, mut slope, mut bend] = [c[0].abs() + c[1].abs(), 0.0, 0.0];
    for (k, c) in (0_u32..).zip(c).skip(2) {
        let (order, c) = (f64::from(k), c.abs());
        size += c;
        slope += order * c;
        bend += order * (order - 1.0) * c;
    }
    if c[0].abs().min(end.abs()) <= ROUNDING * size {
        return None;
    }
    let second = c.get(2).map_or(0.0, |c| 2.0 * c);
    let is_monotonic = c[1].abs() > CERTAIN * slope;
    let is_bent = second.abs() > CERTAIN * (bend - second.abs());
    let crosses = c[0].is_sign_positive() != end.is_sign_positive();
    (is_monotonic || is_bent && (crosses || c[0] * second < 0.0)).then_some(crosses)
}

fn search(
    c: &[f64],
    bernstein: &[f64],
    [lo, hi]: [f64; 2],
    depth: u32,
    visit: &mut impl FnMut(f64) -> ControlFlow<()>,
) -> ControlFlow<()> {
    match variations(bernstein) {
        0 => return ControlFlow::Continue(()),
        1 => {
            let values = [lo, hi].map(|s| value(c, s));
            return visit(solve(c, [lo, hi], values, leading_sign(bernstein.iter())));
        }
        _ if depth == 0 => return ControlFlow::Continue(()),
        _ => {}
    }
    let mut left = [0.0; DEGREE + 1];
    let mut right = [0.0; DEGREE + 1];
    let n = bernstein.len();
    let (left, right) = (&mut left[..n], &mut right[..n]);
    right.copy_from_slice(bernstein);
    for (i, left) in left.iter_mut().enumerate() {
        *left = right[0];
        for j in 0..n - 1 - i {
            right[j] = 0.5 * (right[j] + right[j + 1]);
        }
    }
    let middle = 0.5 * (lo + hi);
    search(c, left, [lo, middle], depth - 1, visit)?;
    // a root exactly there is an end of both halves, and inside neither
    if right[0] == 0.0 && leading_sign(left.iter().rev()) * leading_sign(right.iter()) < 0.0 {
        visit(middle)?;
    }
    search(c, right, [middle, hi], depth - 1, visit)
}

/// C(n,k), one from the other.
static BINOMIALS: [[f64; DEGREE + 1]; DEGREE + 1] = {
    let mut table = [[1.0; DEGREE + 1]; DEGREE + 1];
    let mut n = 0;
    while n <= DEGREE {
        let mut k = 0;
        while k < n {
            table[n][k + 1] = table[n][k] * ((n - k) as f64 / (k + 1) as f64);
            k += 1;
        }
        n += 1;
    }
    table
};

/// bᵢ = Σₖ C(i,k)/C(n,k) cₖ, by sums alone: the cₖ/C(n,k) are the forward differences of the bᵢ.
fn to_bernstein(c: &[f64]) -> [f64; DEGREE + 1] {
    let n = c.len() - 1;
    let mut b = [0.0; DEGREE + 1];
    for ((b, c), binomial) in b.iter_mut().zip(c).zip(&BINOMIALS[n]) {
        *b = c / binomial;
    }
    for first in (0..n).rev() {
        for i in first + 1..=n {
            b[i] += b[i - 1];
        }
    }
    b
}

/// Changes of sign along the sequence, zeros left out.
fn variations(b: &[f64]) -> usize {
    let mut last = 0.0;
    let mut count = 0;
    for &b in b.iter().filter(|b| **b != 0.0) {
        count += usize::from(b * last < 0.0 || (b.signum() != last && last != 0.0));
        last = b.signum();
    }
    count
}

/// First s in (0, 1) at which a function that begins at zero or above it falls to zero. The zero that it may begin at
/// is divided out, and a function that cannot reach zero is not searched.
pub fn first_zero(c: &[f64]) -> Option<f64> {
    let lead = c.iter().position(|c| *c != 0.0)?;
    let c = &c[lead..];
    let rest: f64 = c[1..].iter().map(|c| c.abs()).sum();
    if c[0] > rest {
        return None;
    }
    // most functions that fall to zero fall all the time: the signs at both ends say all
    let bend: f64 = c.iter().enumerate().skip(2).map(|(k, c)| k as f64 * c.abs()).sum();
    let end = value(c, 1.0);
    match (c.len() > 1 && c[1].abs() > CERTAIN * bend, c[0] * end) {
        (true, product) if product < 0.0 => Some(solve(c, [0.0, 1.0], [c[0], end], c[0].signum())),
        (true, product) if product > 0.0 => None,
        _ => first_sign_change(c),
    }
}

/// Sign of the first that is not zero; 0 if all are.
pub fn leading_sign<'a>(mut c: impl Iterator<Item = &'a f64>) -> f64 {
    c.find(|c| **c != 0.0).map_or(0.0, |c| c.signum())
}

/// The root between `lo` and `hi`, where the sign changes once, from `sign`, and the values are `at_lo` and `at_hi`:
/// Newton, kept inside by bisection.
fn solve(c: &[f64], [mut lo, mut hi]: [f64; 2], [at_lo, at_hi]: [f64; 2], sign: f64) -> f64 {
    let mut s = {
        let chord = lo + (hi - lo) * at_lo / (at_lo - at_hi);
        if chord > lo && chord < hi { chord } else { 0.5 * (lo + hi) }
    };
    for _ in 0..100 {
        let (mut f, mut slope) = (0.0, 0.0);
        for c in c.iter().rev() {
            slope = slope * s + f;
            f = f * s + c;
        }
        if f == 0.0 {
            return s;
        }
        if f.signum() == sign {
            lo = s;
        } else {
            hi = s;
        }
        let newton = s - f / slope;
        let next = if newton > lo && newton < hi { newton } else { 0.5 * (lo + hi) };
        if (next - s).abs() <= 0.5 * f64::EPSILON * s {
            return next;
        }
        s = next;
    }
    s
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn all(c: &[f64]) -> Vec<f64> {
        let mut roots = Vec::new();
        let _ = sign_changes(c, &mut |s| {
            roots.push(s);
            ControlFlow::Continue(())
        });
        roots
    }

    fn product(roots: &[f64]) -> Vec<f64> {
        roots.iter().fold(vec![1.0], |c, root| {
            let mut next = vec![0.0; c.len() + 1];
            for (k, c) in c.iter().enumerate() {
                next[k + 1] += c;
                next[k] -= root * c;
            }
            next
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn what_the_coefficients_say_is_what_the_search_finds(
            c in prop::collection::vec(-1.0..1.0_f64, 2..12),
            decay in 0.01..1.0_f64,
        ) {
            let c: Vec<f64> = (0..).zip(&c).map(|(k, c)| c * decay.powi(k)).collect();
            let mut found = Vec::new();
            let _ = search(&c, &to_bernstein(&c)[..c.len()], [0.0, 1.0], DEPTH, &mut |s| {
                found.push(s);
                ControlFlow::Continue(())
            });
            prop_assert_eq!(all(&c), found);
        }
    }

    #[test]
    fn roots_at_the_ends_and_touches_are_none() {
        assert_eq!(all(&[0.0, 1.0]), []);
        assert_eq!(all(&product(&[1.0])), []);
        assert_eq!(all(&product(&[0.25, 0.25])), []); // exact in binary
        assert_eq!(all(&product(&[0.25, 0.25, 0.25])), [0.25]);
        assert_eq!(all(&product(&[0.5])), [0.5]);
        let three = all(&product(&[0.25, 0.5, 0.75])); // the second where the interval is halved
        assert!(three.iter().zip([0.25, 0.5, 0.75]).all(|(s, root)| (s - root).abs() < 1e-15), "{three:?}");
        assert_eq!(three.len(), 3);
        assert_eq!(all(&[0.0; 6]), []);
    }

    #[test]
    fn a_pair_of_roots_a_millionth_apart_is_seen() {
        let roots = all(&product(&[0.3, 0.300_001, 2.0]));
        assert_eq!(roots.len(), 2, "{roots:?}");
        assert!((roots[0] - 0.3).abs() < 1e-9 && (roots[1] - 0.300_001).abs() < 1e-9, "{roots:?}");
    }

    proptest! {
        #[test]
        fn every_root_inside_is_found(gaps in prop::collection::vec(0.05..0.4_f64, 1..8), start in -1.0..0.5_f64) {
            let roots: Vec<f64> = gaps.iter().scan(start, |s, gap| { *s += gap; Some(*s) }).collect();
            prop_assume!(roots.iter().all(|r| r.abs() > 1e-6 && (r - 1.0).abs() > 1e-6));
            let inside: Vec<f64> = roots.iter().copied().filter(|r| (0.0..1.0).contains(r)).collect();
            let found = all(&product(&roots));
            prop_assert_eq!(found.len(), inside.len());
            for (found, root) in found.iter().zip(&inside) {
                prop_assert!((found - root).abs() < 1e-9);
            }
            prop_assert_eq!(first_sign_change(&product(&roots)), found.first().copied());
        }
    }
}
