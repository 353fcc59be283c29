//! Values over several axes, row by row.

use std::fmt;
use std::ops::{Index, IndexMut};

/// Values over `N` axes, row by row: the last axis runs fastest.
///
/// ```
/// use uplift_job::Array;
/// // [site, poe, strength]
/// let u_m = Array::new([1, 2, 3], vec![0.3, 0.2, 0.1, 0.6, 0.4, 0.2])?;
/// assert_eq!(u_m[[0, 1, 2]], 0.2);
/// assert_eq!(u_m.block([0, 1]), [0.6, 0.4, 0.2]);
/// let spectra: Vec<_> = u_m.blocks().map(|([site, poe], u_m)| (site, poe, u_m[0])).collect();
/// assert_eq!(spectra, [(0, 0, 0.3), (0, 1, 0.6)]);
/// # Ok::<(), uplift_job::ShapeError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Array<const N: usize, T = f64> {
    shape: [usize; N],
    values: Vec<T>,
}

/// Values that are not as many as their axes ask for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShapeError {
    shape: Vec<usize>,
    values: usize,
}

impl fmt::Display for ShapeError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} values do not fill axes of the lengths {:?}", self.values, self.shape)
    }
}

impl std::error::Error for ShapeError {}

impl<const N: usize, T> Array<N, T> {
    /// The `values` over axes of the lengths `shape`.
    ///
    /// # Errors
    /// Too many or too few values.
    pub fn new(shape: [usize; N], values: Vec<T>) -> Result<Self, ShapeError> {
        let expected = shape.iter().try_fold(1_usize, |product, &length| product.checked_mul(length));
        if expected == Some(values.len()) {
            Ok(Self { shape, values })
        } else {
            Err(ShapeError { shape: shape.to_vec(), values: values.len() })
        }
    }

    /// The array whose value at each place is what `value` says of it; asked for row by row.
    pub fn from_fn(shape: [usize; N], value: impl FnMut([usize; N]) -> T) -> Self {
        Self { shape, values: (0..shape.iter().product()).map(|index| place(&shape, index)).map(value).collect() }
    }

    /// Lengths of the axes.
    pub fn shape(&self) -> [usize; N] {
        self.shape
    }

    /// All values, row by row.
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// All values, row by row.
    pub fn into_values(self) -> Vec<T> {
        self.values
    }

    /// The values at these places of the first `M` axes, row by row over the axes left.
    ///
    /// # Panics
    /// If a place is outside its axis, which is a bug of the caller.
    pub fn block<const M: usize>(&self, at: [usize; M]) -> &[T] {
        const { assert!(M <= N, "more places than axes") }
        let first = at.iter().zip(&self.shape).fold(0, |first, (&place, &length)| {
            assert!(place < length, "{at:?} is outside of {:?}", self.shape);
            first * length + place
        });
        let length = self.block_length(M);
        &self.values[first * length..(first + 1) * length]
    }

    /// Every block of the first `M` axes with its place, in order.
    pub fn blocks<const M: usize>(&self) -> impl Iterator<Item = ([usize; M], &[T])> {
        const { assert!(M <= N, "more places than axes") }
        let leading: [usize; M] = std::array::from_fn(|axis| self.shape[axis]);
        let length = self.block_length(M);
        (0..leading.iter().product())
            .map(move |index| (place(&leading, index), &self.values[index * length..(index + 1) * length]))
    }

    /// The array of what `of` makes of each value.
    pub fn map<U>(&self, of: impl FnMut(&T) -> U) -> Array<N, U> {
        Array { shape: self.shape, values: self.values.iter().map(of).collect() }
    }

    /// Values behind each place of the first `axes` axes.
    fn block_length(&self, axes: usize) -> usize {
        self.shape[axes..].iter().product()
    }
}

impl<const N: usize, T> Index<[usize; N]> for Array<N, T> {
    type Output = T;

    fn index(&self, at: [usize; N]) -> &T {
        &self.block(at)[0]
    }
}

/// The value at an index into [`values`](Array::values).
impl<const N: usize, T> Index<usize> for Array<N, T> {
    type Output = T;

    fn index(&self, index: usize) -> &T {
        &self.values[index]
    }
}

impl<const N: usize, T> IndexMut<usize> for Array<N, T> {
    fn index_mut(&mut self, index: usize) -> &mut T {
        &mut self.values[index]
    }
}

/// The place on axes of the lengths `shape` of the value at `index`.
fn place<const M: usize>(shape: &[usize; M], mut index: usize) -> [usize; M] {
    let mut place = [0; M];
    for axis in (0..M).rev() {
        place[axis] = index % shape[axis];
        index /= shape[axis];
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_blocks_and_values_agree() {
        let shape = [2, 3, 4];
        let array = Array::from_fn(shape, |[i, j, k]| 100 * i + 10 * j + k);
        assert_eq!(array, Array::new(shape, array.values().to_vec()).unwrap());
        for ([i, j], row) in array.blocks() {
            assert_eq!(row, array.block([i, j]));
            for (k, &value) in row.iter().enumerate() {
                assert_eq!(value, 100 * i + 10 * j + k);
                assert_eq!(array[[i, j, k]], value);
            }
        }
        assert_eq!(array.blocks::<2>().count(), 6);
        assert_eq!(array.block([1])[4..8], [110, 111, 112, 113]);
        assert_eq!(array.block([]), array.values());
        assert_eq!(array.map(|value| value % 10)[[1, 2, 3]], 3);
    }

    #[test]
    fn empty_axes_have_no_blocks() {
        let array: Array<3> = Array::new([0, 2, 3], Vec::new()).unwrap();
        assert_eq!(array.blocks::<2>().count(), 0);
        let array: Array<2> = Array::new([3, 0], Vec::new()).unwrap();
        assert_eq!(
            array.blocks().map(|([row], values)| (row, values.len())).collect::<Vec<_>>(),
            [(0, 0), (1, 0), (2, 0)]
        );
    }

    #[test]
    fn too_few_and_too_many_are_refused() {
        assert!(Array::new([2, 2], vec![1.0; 3]).is_err());
        assert!(Array::new([usize::MAX, 2], vec![1.0; 3]).is_err());
        let error = Array::new([2, 2], vec![1.0; 5]).unwrap_err();
        assert_eq!(error.to_string(), "5 values do not fill axes of the lengths [2, 2]");
    }

    #[test]
    #[should_panic(expected = "outside")]
    fn a_place_outside_is_a_bug() {
        let _ = Array::from_fn([2, 2], |_| 0)[[0, 2]];
    }
}
