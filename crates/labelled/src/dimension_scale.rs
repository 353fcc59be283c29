//! HDF5 dimension scales: the attributes that tie an array's dimensions to the axes.
//!
//! # Source
//! The HDF Group, "HDF5 Dimension Scale Specification and Design Notes": `CLASS` and `NAME` mark a scale,
//! `DIMENSION_LIST` on an array refers to the scale of each dimension, `REFERENCE_LIST` on a scale refers back,
//! `DIMENSION_LABELS` names.

use hdf5::types::{FixedAscii, VarLenArray};
use hdf5::{Dataset, File, Location, ObjectReference, ObjectReference1, ReferencedObject};

use super::native::{ScaleUse, null_terminated_text};
use super::{attribute, text};

const CLASS: &str = "CLASS";
const NAME: &str = "NAME";
const DIMENSION_LIST: &str = "DIMENSION_LIST";
const DIMENSION_LABELS: &str = "DIMENSION_LABELS";
const REFERENCE_LIST: &str = "REFERENCE_LIST";

/// Attributes that belong to the mechanism and not to the user.
pub(super) const RESERVED: [&str; 5] = [CLASS, NAME, DIMENSION_LIST, DIMENSION_LABELS, REFERENCE_LIST];

/// Longest name of an axis.
pub(super) const LONGEST_NAME: usize = 63;

/// Makes `dataset` the scale `name` (ASCII, at most [`LONGEST_NAME`] characters).
pub(super) fn mark(dataset: &Dataset, name: &str) -> hdf5::Result<()> {
    fixed_text(dataset, CLASS, "DIMENSION_SCALE")?;
    fixed_text(dataset, NAME, name)
}

/// Whether `location` is marked as a dimension scale.
pub(super) fn is_marked(location: &Location) -> bool {
    location.attr(CLASS).is_ok()
}

/// Ties dimension `i` of `dataset` to the scale `scales[i]`, whose name is `names[i]`.
pub(super) fn attach(dataset: &Dataset, names: &[&str], scales: &[ObjectReference1]) -> hdf5::Result<()> {
    let list: Vec<VarLenArray<ObjectReference1>> = scales.iter().map(|scale| VarLenArray::from([*scale])).collect();
    attribute::list(dataset, DIMENSION_LIST, &list)?;
    attribute::text_list(dataset, DIMENSION_LABELS, names)
}

/// Notes on a scale every dimension that runs along it.
pub(super) fn note_uses(scale: &Dataset, uses: &[ScaleUse]) -> hdf5::Result<()> {
    attribute::list(scale, REFERENCE_LIST, uses)
}

/// The name of the scale along each dimension of `dataset`; `None` where a dimension has none.
pub(super) fn names(file: &File, dataset: &Dataset) -> hdf5::Result<Option<Vec<String>>> {
    if dataset.ndim() == 0 {
        return Ok(Some(Vec::new()));
    }
    let Ok(attribute) = dataset.attr(DIMENSION_LIST) else { return Ok(None) };
    let list = attribute.read_raw::<VarLenArray<ObjectReference1>>()?;
    if list.len() != dataset.ndim() {
        return Ok(None);
    }
    let mut names = Vec::with_capacity(list.len());
    for references in &list {
        let Some(reference) = references.first() else { return Ok(None) };
        let ReferencedObject::Dataset(scale) = reference.dereference(file)? else { return Ok(None) };
        match text::read(&*scale.attr(NAME)?)?.as_deref() {
            Some([name]) => names.push(name.clone()),
            _ => return Ok(None),
        }
    }
    Ok(Some(names))
}

fn fixed_text(dataset: &Dataset, name: &str, value: &str) -> hdf5::Result<()> {
    let value = FixedAscii::<{ LONGEST_NAME + 1 }>::from_ascii(value).map_err(|error| error.to_string())?;
    dataset.new_attr_builder().empty_as(&null_terminated_text(value.len())?).create(name)?.write_scalar(&value)
}
