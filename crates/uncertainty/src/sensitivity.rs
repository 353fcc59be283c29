//! Which share of a result's variance each factor makes.

use crate::UncertaintyError;
use crate::random::Stream;

const ROWS: &[u8; 24] = b"uplift sobol'  bootstrap";

/// A number with its standard error, from resampled rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// Sobol' indices of one factor: shares of the variance of a result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SobolIndices {
    /// First order, `V(E(f|x_i))/V`: what would go, on average, if the factor were known.
    pub first_order: Estimate,
    /// Total, `E(V(f|x_~i))/V`: what would stay, on average, if all others were known.
    pub total: Estimate,
}

/// Sobol' indices of independent factors, `[factor]`; none where the results do not vary, or are not finite.
///
/// - `a`, `b`: results at the rows of two independent samples of all factors, `[row]`.
/// - `mixed`: results at the rows of the first sample with one factor taken from the second, `[factor][row]`.
/// - `replicates`: how often rows are drawn again for the errors. Rows of a Sobol' sample are not independent: the
///   errors are then on the safe side.
///
/// First order by Saltelli et al. (2010), `mean(f_b (f_ab − f_a))/V`, with the mean of all results taken off first;
/// total by Jansen (1999), `mean((f_a − f_ab)²)/(2 V)`. Estimates scatter, and may lie below 0 or above 1.
///
/// # Errors
/// Other numbers of results than rows.
///
/// # Source
/// A. Saltelli et al., Comput. Phys. Commun. 181 (2010), 259–270; M. J. W. Jansen, Comput. Phys. Commun. 117 (1999),
/// 35–43.
pub fn sobol_indices(
    a: &[f64],
    b: &[f64],
    mixed: &[Vec<f64>],
    (replicates, seed): (usize, u64),
) -> Result<Option<Vec<SobolIndices>>, UncertaintyError> {
    let rows = a.len();
    for found in mixed.iter().map(Vec::len).chain([b.len()]) {
        if found != rows {
            return Err(UncertaintyError::Results { found, expected: rows });
        }
    }
    let Ok(count) = u32::try_from(rows) else { return Ok(None) };
    let all: Vec<usize> = (0..rows).collect();
    let Some(values) = indices_from_rows(a, b, mixed, &all) else { return Ok(None) };
    let (mut kept, mut sums) = (0.0, vec![[[0.0; 2]; 2]; mixed.len()]);
    for replicate in 0..replicates {
        let mut stream = Stream::new(ROWS, seed, replicate as u64);
        let drawn: Vec<usize> = (0..rows).map(|_| stream.below(count)).collect();
        // rows that are all alike have no shares
        let Some(of_replicate) = indices_from_rows(a, b, mixed, &drawn) else { continue };
        kept += 1.0;
        for ((sums, drawn), own) in sums.iter_mut().zip(of_replicate).zip(&values) {
            for which in 0..2 {
                let change = drawn[which] - own[which];
                sums[which][0] += change;
                sums[which][1] += change * change;
            }
        }
    }
    let estimate = |value: f64, [sum, squares]: [f64; 2]| {
        let variance = (squares - sum * sum / kept) / (kept - 1.0);
        Estimate { value, standard_error: variance.max(0.0).sqrt() }
    };
    let of_factor = |([first, total], [of_first, of_total]): (&[f64; 2], &[[f64; 2]; 2])| SobolIndices {
        first_order: estimate(*first, *of_first),
        total: estimate(*total, *of_total),
    };
    Ok(Some(values.iter().zip(&sums).map(of_factor).collect()))
}

/// First order and total, `[factor]`, from the rows `drawn`; none where the results do not vary, or are not finite.
fn indices_from_rows(a: &[f64], b: &[f64], mixed: &[Vec<f64>], drawn: &[usize]) -> Option<Vec<[f64; 2]>> {
    let count = drawn.len() as f64;
    let mean = drawn.iter().map(|&row| a[row] + b[row]).sum::<f64>() / (2.0 * count);
    let square = |value: f64| (value - mean) * (value - mean);
    let variance = drawn.iter().map(|&row| square(a[row]) + square(b[row])).sum::<f64>() / (2.0 * count);
    // what differs by rounding alone does not vary
    let least = (1e-12 * mean) * (1e-12 * mean);
    if !(variance.is_finite() && variance > least) {
        return None;
    }
    let of_factor = |mixed: &Vec<f64>| {
        let first: f64 = drawn.iter().map(|&row| (b[row] - mean) * (mixed[row] - a[row])).sum();
        let total: f64 = drawn.iter().map(|&row| (a[row] - mixed[row]) * (a[row] - mixed[row])).sum();
        [first / (count * variance), total / (2.0 * count * variance)]
    };
    let shares: Vec<[f64; 2]> = mixed.iter().map(of_factor).collect();
    shares.iter().flatten().all(|share| share.is_finite()).then_some(shares)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_vary_has_no_shares() {
        let mixed = [vec![2.0; 4]];
        assert_eq!(sobol_indices(&[2.0; 4], &[2.0; 4], &mixed, (10, 1)), Ok(None));
        let infinite = [f64::INFINITY, 1.0, 2.0, 3.0];
        assert_eq!(sobol_indices(&infinite, &[2.0; 4], &mixed, (10, 1)), Ok(None));
        // of a structure that only the third sample has
        let beyond = [vec![2.0, 1.0, f64::INFINITY, 4.0]];
        assert_eq!(sobol_indices(&[1.0, 2.0, 3.0, 4.0], &[4.0, 2.0, 5.0, 1.0], &beyond, (10, 1)), Ok(None));
        let short = sobol_indices(&[2.0; 4], &[2.0; 3], &mixed, (10, 1));
        assert_eq!(short, Err(UncertaintyError::Results { found: 3, expected: 4 }));
    }

    /// A factor that makes everything and one that makes nothing: with the second taken over nothing changes, with the
    /// first the results are those of the second sample.
    #[test]
    fn a_factor_that_makes_all() {
        let (a, b) = ([1.0, 5.0, 3.0, 3.0], [4.0, 2.0, 5.0, 1.0]);
        let found = sobol_indices(&a, &b, &[b.to_vec(), a.to_vec()], (100, 1)).unwrap().unwrap();
        assert_eq!((found[1].first_order.value, found[1].total.value), (0.0, 0.0));
        assert_eq!((found[1].first_order.standard_error, found[1].total.standard_error), (0.0, 0.0));
        // the mean is 3, the variance 18/8; b (b − a) = 3 + 3 + 4 + 4 without the mean, (a − b)² = 9 + 9 + 4 + 4
        assert!((found[0].first_order.value - 14.0 / 9.0).abs() < 1e-15);
        assert!((found[0].total.value - 26.0 / 18.0).abs() < 1e-15);
    }
}
