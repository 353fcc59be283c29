//! An array that is written a few rows at a time.

use hdf5::{Dataset, H5Type, Hyperslab, SliceOrIndex};
use ndarray::ArrayView;
use sha2::{Digest, Sha256};

use super::checksum::{CHECKSUM, Hashed, hexadecimal};
use super::error::LabelledError;
use super::writer::LabelledWriter;
use super::{attribute, writer};

/// An array whose rows along its first axis arrive one after the other: memory holds no more than a chunk of them.
///
/// The file is byte for byte that of an array written at once.
pub struct GrowingArray<T> {
    path: String,
    dims: Vec<String>,
    shape: Vec<usize>,
    dataset: Dataset,
    hash: Sha256,
    rows_at_once: usize,
    waiting: Vec<T>,
    written_rows: usize,
}

impl<T> GrowingArray<T> {
    /// At least 1: no axis is empty.
    fn values_of_a_row(&self) -> usize {
        self.shape[1..].iter().product()
    }
}

impl LabelledWriter {
    /// Begins an array over the axes `dims`, see [`LabelledWriter::array`]. [`LabelledWriter::append`] gives it its
    /// values, [`LabelledWriter::complete`] ends it.
    ///
    /// # Errors
    /// As [`LabelledWriter::array`]; [`LabelledError::Misuse`] also without `dims`.
    pub fn grow<T: H5Type>(
        &mut self,
        path: &str,
        dims: &[&str],
        unit: &str,
        long_name: &str,
    ) -> Result<GrowingArray<T>, LabelledError> {
        if dims.is_empty() {
            return Err(self.misuse(path, "a single number has no rows".into()));
        }
        let shape = self.shape(path, dims)?;
        self.prepare(path, dims)?;
        let dataset = self.create_dataset::<T>(path, &shape, Some(unit), long_name)?;
        let rows_at_once = writer::chunk_shape(&shape, size_of::<T>())[0];
        Ok(GrowingArray {
            path: path.to_owned(),
            dims: dims.iter().map(ToString::to_string).collect(),
            shape,
            dataset,
            hash: Sha256::new(),
            rows_at_once,
            waiting: Vec::new(),
            written_rows: 0,
        })
    }

    /// Appends whole rows to an array.
    ///
    /// # Errors
    /// [`LabelledError::Misuse`] where they are more than the array has, [`LabelledError::Hdf5`] where the disk is
    /// full.
    #[allow(private_bounds)]
    pub fn append<T: H5Type + Hashed + Copy>(
        &mut self,
        array: &mut GrowingArray<T>,
        values: &[T],
    ) -> Result<(), LabelledError> {
        let row = array.values_of_a_row();
        let given = array.written_rows * row + array.waiting.len() + values.len();
        if given > array.shape[0] * row {
            return Err(self.misuse(&array.path, format!("{given} values for the shape {:?}", array.shape)));
        }
        for value in values {
            value.enter(&mut array.hash);
        }
        array.waiting.extend_from_slice(values);
        while array.waiting.len() >= array.rows_at_once * row {
            self.write_rows(array, array.rows_at_once)?;
        }
        Ok(())
    }

    /// Ends an array of which every row was appended.
    ///
    /// # Errors
    /// [`LabelledError::Misuse`] where rows are missing; [`LabelledError::Hdf5`] where the disk is full.
    #[allow(private_bounds)]
    pub fn complete<T: H5Type + Hashed>(&mut self, mut array: GrowingArray<T>) -> Result<(), LabelledError> {
        let left = array.waiting.len() / array.values_of_a_row();
        if left > 0 {
            self.write_rows(&mut array, left)?;
        }
        let rows = array.shape[0];
        if array.written_rows != rows || !array.waiting.is_empty() {
            return Err(self.misuse(&array.path, format!("{} rows of {rows} were written", array.written_rows)));
        }
        let checksum = hexadecimal(&array.hash.finalize());
        let ended = attribute::write(&array.dataset, CHECKSUM, &checksum.into()).and_then(|()| array.dataset.flush());
        self.check(ended, "write", &array.path)?;
        let dims: Vec<&str> = array.dims.iter().map(String::as_str).collect();
        self.attach(&array.path, &dims, &array.dataset)
    }

    /// Writes the first so many rows of those that wait.
    fn write_rows<T: H5Type>(&mut self, array: &mut GrowingArray<T>, rows: usize) -> Result<(), LabelledError> {
        let (from, count) = (array.written_rows, rows * array.values_of_a_row());
        let shape: Vec<usize> = std::iter::once(rows).chain(array.shape[1..].iter().copied()).collect();
        let mut place: Vec<SliceOrIndex> = vec![(from..from + rows).into()];
        place.extend(shape[1..].iter().map(|&length| SliceOrIndex::from(0..length)));
        let written = ArrayView::from_shape(shape, &array.waiting[..count])
            .map_err(|error| hdf5::Error::from(error.to_string()))
            .and_then(|values| array.dataset.write_slice(values, Hyperslab::from(place)));
        self.check(written, "write", &array.path)?;
        array.waiting.drain(..count);
        array.written_rows += rows;
        Ok(())
    }
}
