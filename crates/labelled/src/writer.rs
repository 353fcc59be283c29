//! Writing a file of labelled arrays.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use hdf5::types::VarLenUnicode;
use hdf5::{Dataset, File, H5Type, Location, LocationType, ObjectReference1};
use uplift_atomic_file::{AtomicFile, io_error};

use super::attribute::{self, AttributeValue};
use super::checksum::{CHECKSUM, Hashed, sha256};
use super::dimension_scale::{self, LONGEST_NAME, RESERVED};
use super::error::{LabelledError, reason};
use super::native::ScaleUse;
use super::reader::Number;
use super::seal::{Extent, seal};
use super::{AXES, text};

/// Arrays above this size are stored in compressed chunks, smaller ones in one piece.
const COMPRESS_ABOVE_BYTES: usize = 64 * 1024;
/// Chunks are at most about this large: small beside the library's chunk cache.
const CHUNK_BYTES: usize = 256 * 1024;
/// Past level 4 the time grows and the size hardly shrinks.
const DEFLATE_LEVEL: u8 = 4;

/// Writes a file of labelled arrays, which is in place only after [`LabelledWriter::finish`].
///
/// Dropped before, it leaves no trace, and a file that was there already stays as it was.
pub struct LabelledWriter {
    // Before `place`: the file is closed before it is removed.
    pub(super) file: File,
    place: AtomicFile,
    pub(super) axes: BTreeMap<String, Axis>,
    links: BTreeSet<String>,
    /// Arrays that lie in chunks.
    chunks: Vec<String>,
}

pub(super) struct Axis {
    length: usize,
    reference: ObjectReference1,
    uses: Vec<ScaleUse>,
}

impl LabelledWriter {
    /// Starts a file that will lie at `path`; folders above it are made.
    ///
    /// # Errors
    /// [`LabelledError::File`] where `path` is a folder or a device, or the folder cannot be made or written to.
    pub fn create(path: &Path) -> Result<Self, LabelledError> {
        let place = AtomicFile::reserve(path)?;
        if hdf5_locks() {
            place.hand_over_lock();
        }
        let file = File::with_options()
            // Format of HDF5 1.8 (2008): every reader knows it, and its checksums show damage.
            // No lock: nobody else knows the hidden name, and a child process would inherit and hold the lock.
            .with_fapl(|access| access.libver_v18().file_locking(false))
            .with_fcpl(|creation| creation.obj_track_times(false))
            .create(place.partial())
            .map_err(|error| hdf5_error(place.target(), "create", "the file", &error))?;
        let mut writer = Self { file, place, axes: BTreeMap::new(), links: BTreeSet::new(), chunks: Vec::new() };
        writer.group(AXES)?;
        Ok(writer)
    }

    /// Makes the group `path` and those above it, where they do not exist yet.
    ///
    /// # Errors
    /// [`LabelledError::Hdf5`] where the disk is full, [`LabelledError::Misuse`] where `path` is no path of a group.
    pub fn group(&mut self, path: &str) -> Result<(), LabelledError> {
        self.check_path(path)?;
        for (end, _) in path.match_indices('/').skip(1).chain([(path.len(), "")]) {
            let group = &path[..end];
            match self.file.loc_type_by_name(group) {
                Ok(LocationType::Group) => {}
                Ok(_) => return Err(self.misuse(path, format!("{group} is an array"))),
                Err(_) => {
                    let created = self.file.create_group_builder().obj_track_times(false).create(group);
                    self.check(created, "create", group)?;
                }
            }
        }
        Ok(())
    }

    /// Sets the attribute `name` of the group or array `object`; one of the same name is overwritten.
    ///
    /// # Errors
    /// [`LabelledError::Misuse`] where `object` does not exist yet or the name or text cannot be stored,
    /// [`LabelledError::Hdf5`] where the disk is full.
    pub fn attribute(
        &mut self,
        object: &str,
        name: &str,
        value: impl Into<AttributeValue>,
    ) -> Result<(), LabelledError> {
        if name.is_empty() || RESERVED.contains(&name) {
            return Err(self.misuse(object, format!("{name:?} cannot be the name of an attribute")));
        }
        let Some(location) = location(&self.file, object) else {
            return Err(self.misuse(object, "write the array or group before its attributes".into()));
        };
        self.check(attribute::write(&location, name, &value.into()), "write the attributes of", object)
    }

    /// Writes the axis `name` with values in `unit` ("1" where there is none).
    ///
    /// # Errors
    /// As [`LabelledWriter::axis_text`].
    pub fn axis<T: Number>(
        &mut self,
        name: &str,
        values: &[T],
        unit: &str,
        long_name: &str,
    ) -> Result<(), LabelledError> {
        self.write_axis(name, values, Some(unit), long_name)
    }

    /// Writes the axis `name` of identifiers, e.g. sites or records.
    ///
    /// # Errors
    /// [`LabelledError::Misuse`] where the name is used already, is none (lower-case ASCII letters, digits and
    /// underscores, a letter first) or there are no values; [`LabelledError::Hdf5`] where the disk is full.
    pub fn axis_text(&mut self, name: &str, values: &[String], long_name: &str) -> Result<(), LabelledError> {
        let values = self.encode(name, values)?;
        self.write_axis(name, &values, None, long_name)
    }

    /// Writes an array of numbers over the axes `dims`, values row by row (the last dimension runs fastest), in `unit`.
    ///
    /// The group that holds the array is made where it does not exist. Without `dims` the array is a single number.
    ///
    /// # Errors
    /// [`LabelledError::Misuse`] where an axis does not exist or is named twice, the number of values is not the
    /// product of the axes' lengths, or the path is taken; [`LabelledError::Hdf5`] where the disk is full.
    pub fn array<T: Number>(
        &mut self,
        path: &str,
        dims: &[&str],
        values: &[T],
        unit: &str,
        long_name: &str,
    ) -> Result<(), LabelledError> {
        self.write_array(path, dims, values, Some(unit), long_name)
    }

    /// Writes an array of texts, see [`LabelledWriter::array`].
    ///
    /// # Errors
    /// As [`LabelledWriter::array`]; [`LabelledError::Misuse`] also where a text holds a null character.
    pub fn array_text(
        &mut self,
        path: &str,
        dims: &[&str],
        values: &[String],
        long_name: &str,
    ) -> Result<(), LabelledError> {
        let values = self.encode(path, values)?;
        self.write_array(path, dims, &values, None, long_name)
    }

    /// Completes the file, brings it to the disk and puts it in place of any older one.
    ///
    /// # Errors
    /// [`LabelledError::Hdf5`] or [`LabelledError::File`] where the disk is full or fails; an older file is then
    /// untouched.
    pub fn finish(self) -> Result<(), LabelledError> {
        for (name, axis) in self.axes.iter().filter(|(_, axis)| !axis.uses.is_empty()) {
            let path = format!("{AXES}/{name}");
            let noted = self.file.dataset(&path).and_then(|scale| dimension_scale::note_uses(&scale, &axis.uses));
            self.check(noted, "write", &path)?;
        }
        let chunks = self.chunks.iter().map(|path| Ok((path.clone(), self.extents(path)?)));
        let chunks = chunks.collect::<Result<_, LabelledError>>()?;
        // Most of what the library has to say about a full disk it says here, not when an array is written.
        self.check(self.file.flush(), "write", "the end of the file")?;
        let Self { file, place, .. } = self;
        file.close().map_err(|error| hdf5_error(place.target(), "close", "the file", &error))?;
        let sealed = std::fs::File::options().read(true).write(true).open(place.partial());
        sealed
            .and_then(|mut file| seal(&mut file, chunks))
            .map_err(io_error(place.target(), "write the end of the file"))?;
        Ok(place.replace()?)
    }

    fn write_axis<T: H5Type + Hashed>(
        &mut self,
        name: &str,
        values: &[T],
        unit: Option<&str>,
        long_name: &str,
    ) -> Result<(), LabelledError> {
        let path = format!("{AXES}/{name}");
        if !is_axis_name(name) {
            return Err(self.misuse(&path, "an axis is named by lower-case letters, digits and underscores".into()));
        }
        if values.is_empty() {
            return Err(self.misuse(&path, "an axis needs values".into()));
        }
        let dataset = self.dataset(&path, &[values.len()], values, unit, long_name)?;
        self.check(dimension_scale::mark(&dataset, name), "write", &path)?;
        let reference = self.check(self.file.reference(&path), "refer to", &path)?;
        self.axes.insert(name.to_owned(), Axis { length: values.len(), reference, uses: Vec::new() });
        Ok(())
    }

    fn write_array<T: H5Type + Hashed>(
        &mut self,
        path: &str,
        dims: &[&str],
        values: &[T],
        unit: Option<&str>,
        long_name: &str,
    ) -> Result<(), LabelledError> {
        let shape = self.shape(path, dims)?;
        if shape.iter().product::<usize>() != values.len() {
            let reason = format!("{} values for the shape {shape:?} of {dims:?}", values.len());
            return Err(self.misuse(path, reason));
        }
        self.prepare(path, dims)?;
        let dataset = self.dataset(path, &shape, values, unit, long_name)?;
        self.attach(path, dims, &dataset)
    }

    /// Makes room for an array at `path`: its group, with the axes visible in it.
    pub(super) fn prepare(&mut self, path: &str, dims: &[&str]) -> Result<(), LabelledError> {
        let group = path.rsplit_once('/').map_or("", |(group, _)| group);
        if !group.is_empty() {
            self.group(group)?;
        }
        dims.iter().try_for_each(|dim| self.link(group, dim))
    }

    /// Ties the array at `path` to its axes.
    pub(super) fn attach(&mut self, path: &str, dims: &[&str], dataset: &Dataset) -> Result<(), LabelledError> {
        if dims.is_empty() {
            return Ok(());
        }
        let scales: Vec<ObjectReference1> =
            dims.iter().filter_map(|dim| self.axes.get(*dim)).map(|axis| axis.reference).collect();
        self.check(dimension_scale::attach(dataset, dims, &scales), "write", path)?;
        let reference = self.check(self.file.reference(path), "refer to", path)?;
        for (dimension, dim) in (0..).zip(dims) {
            if let Some(axis) = self.axes.get_mut(*dim) {
                axis.uses.push(ScaleUse { dataset: reference, dimension });
            }
        }
        Ok(())
    }

    /// Lengths of the axes `dims` of an array that is to lie at `path`.
    pub(super) fn shape(&self, path: &str, dims: &[&str]) -> Result<Vec<usize>, LabelledError> {
        self.check_path(path)?;
        if dims.iter().collect::<BTreeSet<_>>().len() < dims.len() {
            return Err(self.misuse(path, format!("an axis is named twice in {dims:?}")));
        }
        dims.iter()
            .map(|dim| match self.axes.get(*dim) {
                Some(axis) => Ok(axis.length),
                None => Err(self.misuse(path, format!("there is no axis {dim:?}: write it before the array"))),
            })
            .collect()
    }

    /// Makes the axis `dim` visible in `group` ("" for the root).
    fn link(&mut self, group: &str, dim: &str) -> Result<(), LabelledError> {
        let (axis, link) = (format!("{AXES}/{dim}"), format!("{group}/{dim}"));
        if group == AXES || self.links.contains(&link) {
            return Ok(());
        }
        if self.file.link_exists(&link) {
            return Err(self.misuse(&link, format!("the axis {dim:?} must be visible under this name")));
        }
        self.check(self.file.link_hard(&axis, &link), "link", &link)?;
        self.links.insert(link);
        Ok(())
    }

    /// Writes an array or axis with its attributes.
    fn dataset<T: H5Type + Hashed>(
        &mut self,
        path: &str,
        shape: &[usize],
        values: &[T],
        unit: Option<&str>,
        long_name: &str,
    ) -> Result<Dataset, LabelledError> {
        let dataset = self.create_dataset::<T>(path, shape, unit, long_name)?;
        let write = || {
            dataset.write_raw::<_, T>(values)?;
            attribute::write(&dataset, CHECKSUM, &sha256(values).into())?;
            // Closing writes what the library has kept back, and tells nobody when that fails: flush, which does tell.
            dataset.flush()
        };
        self.check(write(), "write", path)?;
        Ok(dataset)
    }

    /// Makes an array or axis of this `shape` with its `units` and `long_name`, and without values.
    pub(super) fn create_dataset<T: H5Type>(
        &mut self,
        path: &str,
        shape: &[usize],
        unit: Option<&str>,
        long_name: &str,
    ) -> Result<Dataset, LabelledError> {
        if self.file.link_exists(path) {
            return Err(self.misuse(path, "it is there already".into()));
        }
        let create = || {
            let mut builder = self.file.new_dataset::<T>().shape(shape).obj_track_times(false);
            // A variable-length text lies outside the array: there is nothing to compress.
            let text = T::type_descriptor() == VarLenUnicode::type_descriptor();
            if !text && shape.iter().product::<usize>() * size_of::<T>() > COMPRESS_ABOVE_BYTES {
                builder = builder.chunk(chunk_shape(shape, size_of::<T>())).shuffle().deflate(DEFLATE_LEVEL);
            }
            let dataset = builder.create(path)?;
            if let Some(unit) = unit {
                attribute::write(&dataset, "units", &unit.into())?;
            }
            attribute::write(&dataset, "long_name", &long_name.into())?;
            Ok(dataset)
        };
        let dataset = self.check(create(), "write", path)?;
        self.note_chunks(path, &dataset);
        Ok(dataset)
    }

    /// Notes an array whose bytes lie in chunks: the seal is of each.
    pub(super) fn note_chunks(&mut self, path: &str, dataset: &Dataset) {
        if dataset.is_chunked() {
            self.chunks.push(path.to_owned());
        }
    }

    /// Where the chunks of the array at `path` lie.
    fn extents(&self, path: &str) -> Result<Vec<Extent>, LabelledError> {
        let dataset = self.check(self.file.dataset(path), "look at", path)?;
        let mut extents = Vec::new();
        let visited = dataset.chunks_visit(|chunk| {
            extents.push((chunk.addr, chunk.size));
            0
        });
        self.check(visited, "look at", path)?;
        Ok(extents)
    }

    fn encode(&self, object: &str, values: &[String]) -> Result<Vec<VarLenUnicode>, LabelledError> {
        values.iter().map(|value| text::encode(value).map_err(|error| self.misuse(object, error.to_string()))).collect()
    }

    fn check_path(&self, path: &str) -> Result<(), LabelledError> {
        let is_name = |name: &str| !matches!(name, "" | "." | "..") && !name.contains('\0');
        match path.strip_prefix('/') {
            Some(names) if names.split('/').all(is_name) => Ok(()),
            _ => Err(self.misuse(path, "a path is written as /group/name".into())),
        }
    }

    pub(super) fn check<T>(
        &self,
        result: hdf5::Result<T>,
        action: &'static str,
        object: &str,
    ) -> Result<T, LabelledError> {
        result.map_err(|error| hdf5_error(self.place.target(), action, object, &error))
    }

    pub(super) fn misuse(&self, object: &str, reason: String) -> LabelledError {
        LabelledError::Misuse { path: self.place.target().to_owned(), object: object.to_owned(), reason }
    }
}

/// Whether the environment has HDF5 lock every file that it opens, whatever is asked of it.
fn hdf5_locks() -> bool {
    std::env::var("HDF5_USE_FILE_LOCKING").is_ok_and(|word| ["TRUE", "1", "BEST_EFFORT"].contains(&word.as_str()))
}

fn hdf5_error(path: &Path, action: &'static str, object: &str, error: &hdf5::Error) -> LabelledError {
    LabelledError::Hdf5 { path: path.to_owned(), action, object: object.to_owned(), reason: reason(error) }
}

/// The group or array at `path`.
fn location(file: &File, path: &str) -> Option<Location> {
    match file.loc_type_by_name(path).ok()? {
        LocationType::Group => file.group(path).ok().map(|group| Location::clone(&group)),
        LocationType::Dataset => file.dataset(path).ok().map(|dataset| Location::clone(&dataset)),
        _ => None,
    }
}

/// Names that are also names of variables in Python, MATLAB and netCDF.
fn is_axis_name(name: &str) -> bool {
    name.len() <= LONGEST_NAME
        && name.starts_with(|first: char| first.is_ascii_lowercase())
        && name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_')
}

/// Whole trailing dimensions in a chunk, as many as fit into [`CHUNK_BYTES`].
pub(super) fn chunk_shape(shape: &[usize], element_bytes: usize) -> Vec<usize> {
    let mut left = (CHUNK_BYTES / element_bytes).max(1);
    let mut chunk: Vec<usize> = shape
        .iter()
        .rev()
        .map(|&length| {
            let taken = length.min(left);
            left /= taken;
            taken
        })
        .collect();
    chunk.reverse();
    chunk
}

#[cfg(test)]
mod tests;
