//! Points that fill the unit cube evenly.

use crate::UncertaintyError;
use crate::random::Stream;
use crate::sobol::{DIRECTIONS, scrambled_sobol};

/// How points are placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sampling {
    /// In every dimension one point in each of as many slices as there are points, in random order.
    ///
    /// # Source
    /// M. D. `McKay`, R. J. Beckman, W. J. Conover, Technometrics 21 (1979), 239–245.
    LatinHypercube,
    /// Sobol' points, scrambled: even in several dimensions at once; best with a power of two of them.
    #[default]
    Sobol,
}

impl Sampling {
    /// Every way.
    pub const ALL: [Self; 2] = [Self::LatinHypercube, Self::Sobol];

    /// Its word.
    pub fn key(self) -> &'static str {
        match self {
            Self::LatinHypercube => "latin-hypercube",
            Self::Sobol => "sobol",
        }
    }
}

/// Most dimensions of Sobol' points.
pub const MOST_DIMENSIONS: usize = DIRECTIONS.len() + 1;

const LATIN_HYPERCUBE: &[u8; 24] = b"uplift  latin  hypercube";

/// Points of the open unit cube, `[point, dimension]`, row-major; `(points, dimensions)` of them.
///
/// The numbers depend on nothing but the seed and the way: those of a dimension not on how many others there are, and
/// the first Sobol' points not on how many follow.
///
/// # Errors
/// No points or dimensions, too many of them.
pub fn unit_cube(
    sampling: Sampling,
    (points, dimensions): (usize, usize),
    seed: u64,
) -> Result<Vec<f64>, UncertaintyError> {
    let fail = |requirement| Err(UncertaintyError::Sample { points, dimensions, requirement });
    let Ok(count @ 1..=0x0100_0000) = u32::try_from(points) else { return fail("1 to 2^24 points are drawn") };
    if dimensions == 0 || (sampling == Sampling::Sobol && dimensions > MOST_DIMENSIONS) {
        return fail("there are Sobol' points for 1 to 13 dimensions");
    }
    let column = |dimension: usize| match sampling {
        Sampling::LatinHypercube => latin(count, seed, dimension as u64),
        Sampling::Sobol => scrambled_sobol(count, dimension, seed),
    };
    let columns: Vec<Vec<f64>> = (0..dimensions).map(column).collect();
    Ok((0..points).flat_map(|point| columns.iter().map(move |column| column[point])).collect())
}

/// One dimension of a Latin hypercube: a random order of the slices, and a random place in each.
fn latin(count: u32, seed: u64, dimension: u64) -> Vec<f64> {
    let mut stream = Stream::new(LATIN_HYPERCUBE, seed, dimension);
    let mut slices: Vec<u32> = (0..count).collect();
    for last in (1..count).rev() {
        slices.swap(last as usize, stream.below(last + 1));
    }
    slices.into_iter().map(|slice| (f64::from(slice) + stream.unit()) / f64::from(count)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_slice_of_every_dimension_has_one_point() {
        for sampling in Sampling::ALL {
            let points = unit_cube(sampling, (256, 10), 7).unwrap();
            for dimension in 0..10 {
                let mut slices = [0; 256];
                for point in points.chunks_exact(10) {
                    assert!(point[dimension] > 0.0 && point[dimension] < 1.0);
                    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 256")]
                    let slice = (256.0 * point[dimension]) as usize;
                    slices[slice] += 1;
                }
                assert!(slices.iter().all(|&points| points == 1), "{sampling:?}, dimension {dimension}");
            }
        }
    }

    /// Pinned: whoever changes the points changes every published band.
    #[test]
    fn points_depend_on_their_seed_and_nothing_else() {
        for sampling in Sampling::ALL {
            let few = unit_cube(sampling, (64, 2), 3).unwrap();
            let more = unit_cube(sampling, (64, 5), 3).unwrap();
            assert!(few.chunks_exact(2).zip(more.chunks_exact(5)).all(|(few, more)| few == &more[..2]));
            assert_ne!(few, unit_cube(sampling, (64, 2), 4).unwrap());
        }
        let first = unit_cube(Sampling::Sobol, (8, 3), 3).unwrap();
        assert_eq!(unit_cube(Sampling::Sobol, (64, 3), 3).unwrap()[..24], first);
    }

    #[test]
    fn what_cannot_be_drawn_is_refused() {
        for size in [(0, 2), (4, 0), (4, MOST_DIMENSIONS + 1)] {
            assert!(matches!(unit_cube(Sampling::Sobol, size, 1), Err(UncertaintyError::Sample { .. })));
        }
        assert!(unit_cube(Sampling::Sobol, (4, MOST_DIMENSIONS), 1).is_ok());
        assert_eq!(MOST_DIMENSIONS, 13);
    }
}
