//! Reading a file of labelled arrays.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use hdf5::types::{FloatSize, IntSize, TypeDescriptor};
use hdf5::{Container, Dataset, File, H5Type, Hyperslab, LocationType, MinorErrorCode, SliceOrIndex};
use uplift_atomic_file::{io_error, require_file};

use super::checksum::Hashed;
use super::error::{LabelledError, reason};
use super::seal::{Opened, Sealed};
use super::{AXES, dimension_scale, text};

/// Deflate cannot pack more than 1032 bytes into one: a file that claims more lies, and is not given the memory.
const GREATEST_COMPRESSION: u64 = 1032;

/// An array with the names of its dimensions.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelledArray<T> {
    /// Names of the axes, one per dimension.
    pub dims: Vec<String>,
    /// Lengths of the axes.
    pub shape: Vec<usize>,
    /// Values, row by row (the last dimension runs fastest).
    pub values: Vec<T>,
}

/// Reads a file written by [`LabelledWriter`](super::LabelledWriter).
///
/// HDF5 sees no byte that is not as it was written: the structure of the file is checked when it is opened, and an
/// array when it is asked for.
pub struct LabelledReader {
    pub(super) file: File,
    sealed: Sealed,
    path: PathBuf,
    bytes: u64,
}

impl LabelledReader {
    /// Opens `path` for reading.
    ///
    /// # Errors
    /// [`LabelledError::File`] where the file is missing, may not be read or is not a file,
    /// [`LabelledError::NotHdf5`], [`LabelledError::Truncated`] and [`LabelledError::Unsealed`] where it is something
    /// else or not whole, [`LabelledError::Damaged`] where its structure is not as it was written,
    /// [`LabelledError::Locked`] where another program is writing to it.
    pub fn open(path: &Path) -> Result<Self, LabelledError> {
        let metadata = fs::metadata(path).map_err(io_error(path, "open the file"))?;
        require_file(path, &metadata)?;
        let file = fs::File::open(path).map_err(io_error(path, "open the file"))?;
        let sealed = match Sealed::open(file).map_err(io_error(path, "read the file"))? {
            Opened::Sealed(sealed) => sealed,
            Opened::Broken => return Err(LabelledError::Damaged { path: path.to_owned(), object: None }),
            Opened::Missing => return Err(unsealed(path)),
        };
        let owned = path.to_owned();
        let file = File::open(path).map_err(|error| {
            if error.contains_minor(MinorErrorCode::CantLockFile) {
                LabelledError::Locked { path: owned.clone() }
            } else {
                LabelledError::Hdf5 { path: owned.clone(), action: "open", object: "/".into(), reason: reason(&error) }
            }
        })?;
        // what took its place since was not looked at
        if !sealed.is_still_at(path) {
            return Err(LabelledError::Replaced { path: owned });
        }
        Ok(Self { file, sealed, path: owned, bytes: metadata.len() })
    }

    /// By what the content of the file is known: two files with the same are equal, byte for byte.
    pub fn identity(&self) -> &str {
        self.sealed.identity()
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the file has a group or array at `path`.
    pub fn exists(&self, path: &str) -> bool {
        self.file.loc_type_by_name(path).is_ok()
    }

    /// Names of the arrays and groups in `group`, sorted; the links to its axes are left out.
    ///
    /// # Errors
    /// [`LabelledError::Missing`] where there is no such group, [`LabelledError::WrongType`] where it is an array.
    pub fn children(&self, group: &str) -> Result<Vec<String>, LabelledError> {
        self.require(group, LocationType::Group, "a group")?;
        let mut names = self.check(self.file.group(group).and_then(|group| group.member_names()), group)?;
        if group != AXES {
            names.retain(|name| !self.is_axis_link(group, name));
        }
        names.sort();
        Ok(names)
    }

    /// The number or text in the attribute `name` of `object`.
    ///
    /// # Errors
    /// [`LabelledError::Missing`] or [`LabelledError::WrongType`].
    pub fn attribute<T: Value>(&self, object: &str, name: &str) -> Result<T, LabelledError> {
        match <[T; 1]>::try_from(self.attributes(object, name)?) {
            Ok([value]) => Ok(value),
            Err(values) => {
                let found = format!("a list of {} {}", values.len(), T::SEVERAL);
                Err(self.wrong(&attribute_label(object, name), found, T::ONE))
            }
        }
    }

    /// The list of numbers or texts in the attribute `name` of `object`.
    ///
    /// # Errors
    /// [`LabelledError::Missing`] or [`LabelledError::WrongType`].
    pub fn attributes<T: Value>(&self, object: &str, name: &str) -> Result<Vec<T>, LabelledError> {
        T::read(self, &self.container(object, name)?, &attribute_label(object, name))
    }

    /// Values of the axis `name`.
    ///
    /// # Errors
    /// As [`LabelledReader::array`].
    pub fn axis<T: Value>(&self, name: &str) -> Result<Vec<T>, LabelledError> {
        let path = format!("{AXES}/{name}");
        T::read(self, &*self.dataset(&path)?, &path)
    }

    /// Reads the array of numbers or texts at `path`; single precision is widened to double.
    ///
    /// # Errors
    /// [`LabelledError::Missing`] where there is none, [`LabelledError::WrongType`] where it is a group, holds another
    /// kind of values or has no axes, [`LabelledError::Hdf5`] where the file is damaged.
    pub fn array<T: Value>(&self, path: &str) -> Result<LabelledArray<T>, LabelledError> {
        let dataset = self.dataset(path)?;
        let shape = dataset.shape();
        let values = T::read(self, &dataset, path)?;
        let Some(dims) = self.check(dimension_scale::names(&self.file, &dataset), path)? else {
            return Err(self.wrong(path, "an array whose dimensions have no names".into(), "an array over named axes"));
        };
        Ok(LabelledArray { dims, shape, values })
    }

    /// The values of the array of numbers at `path` along its first axis, at these places of its `other` axes: memory
    /// holds no more of an array that is large.
    ///
    /// # Errors
    /// As [`LabelledReader::array`]; [`LabelledError::Hdf5`] also where the array has no such places.
    pub fn along_first_axis(&self, path: &str, other: &[usize]) -> Result<Vec<f64>, LabelledError> {
        let dataset = self.dataset(path)?;
        let places = other.iter().map(|&place| SliceOrIndex::from(place));
        let selection: Vec<SliceOrIndex> = std::iter::once(SliceOrIndex::from(..)).chain(places).collect();
        let values = dataset.read_slice_1d::<f64, _>(Hyperslab::from(selection));
        Ok(self.check(values, path)?.to_vec())
    }

    /// The array at `path`, whose bytes are as they were written.
    pub(super) fn dataset(&self, path: &str) -> Result<Dataset, LabelledError> {
        self.require(path, LocationType::Dataset, "an array")?;
        let dataset = self.check(self.file.dataset(path), path)?;
        if self.sealed.is_sound(path, dataset.is_chunked()).map_err(io_error(&self.path, "read the file"))? {
            return Ok(dataset);
        }
        Err(LabelledError::Damaged { path: self.path.clone(), object: Some(path.to_owned()) })
    }

    /// The attribute `name` of `object`.
    fn container(&self, object: &str, name: &str) -> Result<Container, LabelledError> {
        let found = match self.file.loc_type_by_name(object) {
            Ok(LocationType::Group) => self.file.group(object).and_then(|group| group.attr(name)),
            Ok(LocationType::Dataset) => self.file.dataset(object).and_then(|dataset| dataset.attr(name)),
            _ => return Err(self.missing(object.to_owned())),
        };
        found.map(|attribute| Container::clone(&attribute)).map_err(|_| self.missing(attribute_label(object, name)))
    }

    pub(super) fn values<T: Number>(&self, container: &Container, object: &str) -> Result<Vec<T>, LabelledError> {
        let found = self.check(container.dtype().and_then(|datatype| datatype.to_descriptor()), object)?;
        if !T::TYPES.contains(&found) {
            return Err(self.wrong(object, format!("of type {found}"), T::WANTED));
        }
        self.require_space(container, object)?;
        self.check(container.read_raw(), object)
    }

    pub(super) fn texts(&self, container: &Container, object: &str) -> Result<Vec<String>, LabelledError> {
        self.require_space(container, object)?;
        match self.check(text::read(container), object)? {
            Some(texts) => Ok(texts),
            None => Err(self.wrong(object, "no text".into(), "text")),
        }
    }

    /// Refuses an array that claims more than its file can hold, before memory is taken for it.
    fn require_space(&self, container: &Container, object: &str) -> Result<(), LabelledError> {
        let element = self.check(container.dtype(), object)?.size();
        let claimed =
            container.shape().iter().try_fold(element, |bytes, &length| bytes.checked_mul(length)).map(|b| b as u64);
        if claimed.is_some_and(|claimed| claimed <= self.bytes.saturating_mul(GREATEST_COMPRESSION)) {
            return Ok(());
        }
        Err(LabelledError::Hdf5 {
            path: self.path.clone(),
            action: "read",
            object: object.to_owned(),
            reason: format!("its shape {:?} does not fit into a file of {} bytes", container.shape(), self.bytes),
        })
    }

    fn require(&self, path: &str, kind: LocationType, wanted: &'static str) -> Result<(), LabelledError> {
        match self.file.loc_type_by_name(path) {
            Ok(found) if found == kind => Ok(()),
            Ok(LocationType::Group) => Err(self.wrong(path, "a group".into(), wanted)),
            Ok(_) => Err(self.wrong(path, "an array".into(), wanted)),
            Err(_) => Err(self.missing(path.to_owned())),
        }
    }

    fn is_axis_link(&self, group: &str, name: &str) -> bool {
        self.exists(&format!("{AXES}/{name}"))
            && self
                .file
                .dataset(&format!("{}/{name}", group.trim_end_matches('/')))
                .is_ok_and(|dataset| dimension_scale::is_marked(&dataset))
    }

    pub(super) fn check<T>(&self, result: hdf5::Result<T>, object: &str) -> Result<T, LabelledError> {
        result.map_err(|error| LabelledError::Hdf5 {
            path: self.path.clone(),
            action: "read",
            object: object.to_owned(),
            reason: reason(&error),
        })
    }

    fn missing(&self, object: String) -> LabelledError {
        LabelledError::Missing { path: self.path.clone(), object }
    }

    pub(super) fn wrong(&self, object: &str, found: String, wanted: &'static str) -> LabelledError {
        LabelledError::WrongType { path: self.path.clone(), object: object.to_owned(), found, wanted }
    }
}

/// First bytes of every HDF5 file.
const SIGNATURE: &[u8] = b"\x89HDF\r\n\x1a\n";
/// Bytes of the first block of a file that are looked at.
const FIRST_BLOCK: u64 = 64;

/// What is wrong with the file at `path`, which has no seal.
pub(super) fn unsealed(path: &Path) -> LabelledError {
    let (mut first, mut bytes) = (Vec::new(), 0);
    let read = fs::File::open(path).and_then(|file| {
        bytes = file.metadata()?.len();
        file.take(FIRST_BLOCK).read_to_end(&mut first)
    });
    let path = path.to_owned();
    match read {
        Err(source) => io_error(&path, "read the file")(source).into(),
        Ok(_) if !first.starts_with(SIGNATURE) => LabelledError::NotHdf5 { path, bytes },
        // shorter than its first block is cut short too
        Ok(_) if stated_length(&first).is_none_or(|stated| bytes < stated) => LabelledError::Truncated { path, bytes },
        Ok(_) => LabelledError::Unsealed { path },
    }
}

/// How long an HDF5 file is by its first block (with addresses of 8 bytes, as all have that are not very old).
fn stated_length(first: &[u8]) -> Option<u64> {
    let at = match first.get(8)? {
        0 => 40,
        1 => 44,
        _ => 28,
    };
    Some(u64::from_le_bytes(first.get(at..at + 8)?.try_into().ok()?))
}

fn attribute_label(object: &str, name: &str) -> String {
    format!("attribute {name:?} of {object}")
}

/// A number or a text in a file.
pub trait Value: Sized {
    /// One of them, in words.
    const ONE: &'static str;
    /// Several of them, in a word.
    const SEVERAL: &'static str;

    /// The values of an array or attribute, which is called `object`.
    ///
    /// # Errors
    /// [`LabelledError::WrongType`] where it holds others, [`LabelledError::Hdf5`] where the file is damaged.
    fn read(reader: &LabelledReader, container: &Container, object: &str) -> Result<Vec<Self>, LabelledError>;
}

impl Value for String {
    const ONE: &'static str = "one text";
    const SEVERAL: &'static str = "texts";

    fn read(reader: &LabelledReader, container: &Container, object: &str) -> Result<Vec<Self>, LabelledError> {
        reader.texts(container, object)
    }
}

impl<T: Number> Value for T {
    const ONE: &'static str = "one number";
    const SEVERAL: &'static str = "numbers";

    fn read(reader: &LabelledReader, container: &Container, object: &str) -> Result<Vec<Self>, LabelledError> {
        reader.values(container, object)
    }
}

/// A number in memory and the types in a file that it can take without loss.
#[allow(private_bounds)]
pub trait Number: H5Type + Hashed + Copy {
    /// The types.
    const TYPES: &'static [TypeDescriptor];
    /// Its own, in a word.
    const WANTED: &'static str;
}

macro_rules! number {
    ($($type:ty, $wanted:literal, [$($descriptor:expr),+];)+) => {
        $(impl Number for $type {
            const TYPES: &'static [TypeDescriptor] = &[$($descriptor),+];
            const WANTED: &'static str = $wanted;
        })+
    };
}
number! {
    f64, "float64", [TypeDescriptor::Float(FloatSize::U8), TypeDescriptor::Float(FloatSize::U4)];
    f32, "float32", [TypeDescriptor::Float(FloatSize::U4)];
    u32, "uint32", [TypeDescriptor::Unsigned(IntSize::U4)];
    u8, "uint8", [TypeDescriptor::Unsigned(IntSize::U1)];
    i64, "int64", [TypeDescriptor::Integer(IntSize::U8)];
    u64, "uint64", [TypeDescriptor::Unsigned(IntSize::U8)];
}

#[cfg(test)]
mod tests;
