//! Sobol' points, scrambled.

use crate::random::{Stream, TWO_TO_32};

/// Of each dimension but the first: the coefficients of its primitive polynomial between the highest and the lowest,
/// and its initial direction numbers.
///
/// # Source
/// S. Joe, F. Y. Kuo, SIAM J. Sci. Comput. 30 (2008), 2635–2654: dimensions 2 to 13 of their set of 21,201.
pub(crate) const DIRECTIONS: [(u32, &[u32]); 12] = [
    (0, &[1]),
    (1, &[1, 3]),
    (1, &[1, 3, 1]),
    (2, &[1, 1, 1]),
    (1, &[1, 1, 3, 3]),
    (4, &[1, 3, 5, 13]),
    (2, &[1, 1, 5, 5, 17]),
    (4, &[1, 1, 5, 5, 5]),
    (7, &[1, 1, 7, 11, 19]),
    (11, &[1, 1, 5, 1, 1]),
    (13, &[1, 1, 1, 3, 11]),
    (14, &[1, 3, 5, 5, 31]),
];

const SCRAMBLING: &[u8; 24] = b"uplift  sobol scrambling";

/// Direction numbers of a dimension, the first bit highest.
fn directions(dimension: usize) -> [u32; 32] {
    let mut numbers = [0; 32];
    let Some((coefficients, initial)) = dimension.checked_sub(1).map(|place| DIRECTIONS[place]) else {
        // the first dimension: the radical inverse in base 2
        for (bit, number) in numbers.iter_mut().enumerate() {
            *number = 1 << (31 - bit);
        }
        return numbers;
    };
    let degree = initial.len();
    for bit in 0..32 {
        numbers[bit] = if bit < degree {
            initial[bit] << (31 - bit)
        } else {
            let mut number = numbers[bit - degree] ^ (numbers[bit - degree] >> degree);
            for term in 1..degree {
                if (coefficients >> (degree - 1 - term)) & 1 == 1 {
                    number ^= numbers[bit - term];
                }
            }
            number
        };
    }
    numbers
}

/// The first `count` points of one dimension, as 32 bits after the point: in the order of the Gray code.
fn sobol(count: u32, directions: &[u32; 32]) -> impl Iterator<Item = u32> {
    let mut point = 0;
    (0..count).map(move |index| {
        if index > 0 {
            point ^= directions[index.trailing_zeros() as usize];
        }
        point
    })
}

/// One dimension of scrambled Sobol' points, between 0 and 1: a random linear scrambling of the digits and a random
/// shift, which keep the points as even as they are and make every single one uniform.
///
/// # Source
/// J. Matoušek, J. Complexity 14 (1998), 527–556.
pub(crate) fn scrambled_sobol(count: u32, dimension: usize, seed: u64) -> Vec<f64> {
    let mut stream = Stream::new(SCRAMBLING, seed, dimension as u64);
    // a direction number has its leading digit at some place: the digits below it are drawn
    let columns: [u32; 32] = std::array::from_fn(|digit| {
        let own = 1_u32 << (31 - digit);
        own | (stream.bits() & (own - 1))
    });
    let shift = stream.bits();
    let scrambled = directions(dimension).map(|number| {
        let digits = (0..32).filter(|digit| (number >> (31 - digit)) & 1 == 1);
        digits.fold(0, |sum, digit| sum ^ columns[digit])
    });
    sobol(count, &scrambled).map(|point| (f64::from(point ^ shift) + 0.5) / TWO_TO_32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the definition: the first points of the first two dimensions, in the order of the Gray code.
    #[test]
    fn the_first_points() {
        let points = |dimension: usize| -> Vec<f64> {
            sobol(8, &directions(dimension)).map(|point| f64::from(point) / TWO_TO_32).collect()
        };
        assert_eq!(points(0), [0.0, 0.5, 0.75, 0.25, 0.375, 0.875, 0.625, 0.125]);
        assert_eq!(points(1), [0.0, 0.5, 0.25, 0.75, 0.375, 0.875, 0.125, 0.625]);
    }

    /// Sobol's property A: of every 2^d points one lies in each of the 2^d octants of all d dimensions, as the
    /// numbers of Joe and Kuo have it; scrambling keeps it.
    #[test]
    fn every_octant_has_a_point() {
        let dimensions = DIRECTIONS.len() + 1;
        let count = 1 << dimensions;
        let columns: Vec<Vec<f64>> = (0..dimensions).map(|dimension| scrambled_sobol(count, dimension, 5)).collect();
        let mut seen = vec![false; 1 << dimensions];
        for point in 0..count as usize {
            let octant = columns.iter().fold(0, |octant, column| 2 * octant + usize::from(column[point] >= 0.5));
            seen[octant] = true;
        }
        assert!(seen.iter().all(|&seen| seen));
    }

    /// The error of the mean of a smooth function falls nearly as 1/N^1.5, not as 1/√N.
    #[test]
    fn means_converge_faster_than_by_chance() {
        let error = |count: u32, seed: u64| {
            let columns: Vec<Vec<f64>> = (0..6).map(|dimension| scrambled_sobol(count, dimension, seed)).collect();
            let product =
                |point: usize| columns.iter().map(|column| 1.0 + 0.5 * (column[point] - 0.5)).product::<f64>();
            (0..count as usize).map(product).sum::<f64>() / f64::from(count) - 1.0
        };
        let root_mean_square = |count: u32| ((0..32).map(|seed| error(count, seed).powi(2)).sum::<f64>() / 32.0).sqrt();
        let [few, many] = [64, 4096].map(root_mean_square);
        // by chance: 0.36/√N, 0.045 and 0.0056
        assert!(few < 0.01 && many < few / 64.0, "{few} {many}");
    }
}
