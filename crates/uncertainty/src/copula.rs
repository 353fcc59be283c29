//! How several quantities go together.

use statrs::distribution::{ContinuousCDF, Normal};

use crate::UncertaintyError;

/// Gaussian copula: uniform numbers that are correlated as normal ones of a given correlation matrix.
///
/// `u = Φ(L Φ⁻¹(v))`, with the Cholesky factor L of the matrix. A coefficient is that of the underlying normal
/// quantities: of normal ones it is their own, of lognormal ones their logarithms'.
///
/// # Source
/// R. B. Nelsen, An Introduction to Copulas, 2nd edition, Springer 2006, Section 2.3.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussianCopula {
    dimensions: usize,
    /// Lower triangle of the factor, row after row, `[row][column <= row]`.
    factor: Vec<Vec<f64>>,
    /// Quantities that depend on each other, directly or through others; one alone is a group of itself.
    groups: Vec<Vec<usize>>,
}

impl GaussianCopula {
    /// Of `dimensions` quantities, correlated in pairs: two positions and their coefficient between −1 and 1; those
    /// that are not named are independent.
    ///
    /// # Errors
    /// A pair of one quantity, of one that is not there, or given twice; a coefficient out of range; a matrix that is
    /// not positive definite.
    pub fn new(dimensions: usize, pairs: &[(usize, usize, f64)]) -> Result<Self, UncertaintyError> {
        let mut matrix = vec![vec![0.0; dimensions]; dimensions];
        let mut group_of: Vec<usize> = (0..dimensions).collect();
        for (index, &(first, second, coefficient)) in pairs.iter().enumerate() {
            let same = |other: &(usize, usize, f64)| {
                (other.0, other.1) == (first, second) || (other.0, other.1) == (second, first)
            };
            if first == second || first.max(second) >= dimensions || pairs[..index].iter().any(same) {
                return Err(UncertaintyError::Pair { first, second });
            }
            if !(coefficient > -1.0 && coefficient < 1.0) {
                let (name, requirement) = ("the correlation", "above -1 and below 1");
                return Err(UncertaintyError::OutOfRange { name, value: coefficient, requirement });
            }
            matrix[first][second] = coefficient;
            matrix[second][first] = coefficient;
            if coefficient != 0.0 {
                let (kept, joined) = (group_of[first], group_of[second]);
                group_of.iter_mut().filter(|group| **group == joined).for_each(|group| *group = kept);
            }
        }
        let factor = cholesky(matrix)?;
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for index in 0..dimensions {
            match groups.iter_mut().find(|group| group_of[group[0]] == group_of[index]) {
                Some(group) => group.push(index),
                None => groups.push(vec![index]),
            }
        }
        Ok(Self { dimensions, factor, groups })
    }

    /// Number of quantities.
    pub fn dimensions(&self) -> usize {
        self.dimensions
    }

    /// Quantities that depend on each other, by their positions; groups are independent, and one alone is a group.
    pub fn groups(&self) -> &[Vec<usize>] {
        &self.groups
    }

    /// Correlates independent uniform numbers, one a quantity. A quantity that is alone keeps its number, to the bit.
    pub fn correlated(&self, uniform: &[f64]) -> Vec<f64> {
        let mut correlated = uniform.to_vec();
        let unit = Normal::standard();
        for group in self.groups.iter().filter(|group| group.len() > 1) {
            for &row in group {
                let terms = group.iter().filter(|column| **column <= row);
                let sum: f64 = terms.map(|&column| self.factor[row][column] * unit.inverse_cdf(uniform[column])).sum();
                correlated[row] = unit.cdf(sum);
            }
        }
        correlated
    }
}

/// Lower triangular factor of a matrix of 1 on the diagonal, whose diagonal entries are overwritten.
fn cholesky(matrix: Vec<Vec<f64>>) -> Result<Vec<Vec<f64>>, UncertaintyError> {
    /// Least square of a diagonal entry: below it quantities are the same but for rounding.
    const LEAST: f64 = 1e-12;
    let mut factor: Vec<Vec<f64>> = Vec::with_capacity(matrix.len());
    for (row, of_row) in matrix.into_iter().enumerate() {
        let mut entries: Vec<f64> = Vec::with_capacity(row + 1);
        for column in 0..row {
            let before: f64 = entries.iter().zip(&factor[column]).map(|(a, b)| a * b).sum();
            entries.push((of_row[column] - before) / factor[column][column]);
        }
        let square = 1.0 - entries.iter().map(|entry| entry * entry).sum::<f64>();
        if !(square > LEAST) {
            return Err(UncertaintyError::NotPositiveDefinite);
        }
        entries.push(square.sqrt());
        factor.push(entries);
    }
    Ok(factor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Sampling, unit_cube};

    #[test]
    fn correlations_that_contradict_each_other_are_refused() {
        // three that cannot all be opposed
        let opposed = [(0, 1, -0.6), (1, 2, -0.6), (0, 2, -0.6)];
        assert_eq!(GaussianCopula::new(3, &opposed), Err(UncertaintyError::NotPositiveDefinite));
        assert!(GaussianCopula::new(3, &opposed.map(|(a, b, of)| (a, b, 0.8 * of))).is_ok());
        for pairs in [&[(0, 0, 0.5)][..], &[(0, 3, 0.5)], &[(0, 1, 0.5), (1, 0, 0.5)]] {
            assert!(matches!(GaussianCopula::new(3, pairs), Err(UncertaintyError::Pair { .. })), "{pairs:?}");
        }
        assert!(matches!(GaussianCopula::new(2, &[(0, 1, 1.0)]), Err(UncertaintyError::OutOfRange { .. })));
    }

    #[test]
    fn groups_are_those_that_depend_on_each_other() {
        let groups = |pairs: &[(usize, usize, f64)]| GaussianCopula::new(4, pairs).unwrap().groups().to_vec();
        assert_eq!(groups(&[(1, 2, 0.0)]), [vec![0], vec![1], vec![2], vec![3]]);
        assert_eq!(groups(&[(3, 1, 0.5), (1, 0, 0.2)]), [vec![0, 1, 3], vec![2]]);
    }

    /// The correlation of the normal scores of many points is the coefficient; a quantity alone keeps its bits.
    #[test]
    fn points_have_the_correlations_asked_for() {
        let copula = GaussianCopula::new(3, &[(0, 2, 0.7)]).unwrap();
        let unit = Normal::standard();
        let points = unit_cube(Sampling::Sobol, (4096, 3), 1).unwrap();
        let mut product = 0.0;
        for point in points.chunks_exact(3) {
            let correlated = copula.correlated(point);
            assert_eq!(correlated[1].to_bits(), point[1].to_bits());
            product += unit.inverse_cdf(correlated[0]) * unit.inverse_cdf(correlated[2]) / 4096.0;
        }
        assert!((product - 0.7).abs() < 0.01, "{product}");
    }
}
