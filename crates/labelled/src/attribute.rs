//! Attributes: small facts on a group or an array.

use hdf5::types::VarLenUnicode;
use hdf5::{H5Type, Location};

use super::text;

/// The value of an attribute.
#[derive(Clone, Debug, PartialEq)]
pub enum AttributeValue {
    /// UTF-8 text of any length.
    Text(String),
    /// A number.
    F64(f64),
    /// A count or a signed integer.
    I64(i64),
    /// An unsigned integer, e.g. a seed.
    U64(u64),
    /// A list of numbers.
    F64Array(Vec<f64>),
    /// A list of integers.
    I64Array(Vec<i64>),
    /// A list of texts.
    TextArray(Vec<String>),
}

macro_rules! from {
    ($($source:ty => $variant:ident),+ $(,)?) => {
        $(impl From<$source> for AttributeValue {
            fn from(value: $source) -> Self {
                Self::$variant(value.into())
            }
        })+
    };
}
from!(
    &str => Text, String => Text, f64 => F64, i64 => I64, i32 => I64, u32 => I64, u64 => U64,
    Vec<f64> => F64Array, &[f64] => F64Array, Vec<i64> => I64Array, &[i64] => I64Array,
    Vec<String> => TextArray, &[String] => TextArray,
);

/// Writes an attribute; one of the same name is overwritten.
pub(super) fn write(location: &Location, name: &str, value: &AttributeValue) -> hdf5::Result<()> {
    if location.attr(name).is_ok() {
        location.delete_attr(name)?;
    }
    match value {
        AttributeValue::Text(value) => scalar(location, name, &text::encode(value)?),
        AttributeValue::F64(value) => scalar(location, name, value),
        AttributeValue::I64(value) => scalar(location, name, value),
        AttributeValue::U64(value) => scalar(location, name, value),
        AttributeValue::F64Array(values) => list(location, name, values),
        AttributeValue::I64Array(values) => list(location, name, values),
        AttributeValue::TextArray(values) => text_list(location, name, values),
    }
}

/// Writes a list of texts as an attribute.
pub(super) fn text_list<S: AsRef<str>>(location: &Location, name: &str, values: &[S]) -> hdf5::Result<()> {
    let values: Vec<VarLenUnicode> =
        values.iter().map(|value| text::encode(value.as_ref())).collect::<Result<_, _>>()?;
    list(location, name, &values)
}

/// Writes a list of values as an attribute.
pub(super) fn list<T: H5Type>(location: &Location, name: &str, values: &[T]) -> hdf5::Result<()> {
    location.new_attr::<T>().shape(values.len()).create(name)?.write_raw::<_, T>(values)
}

fn scalar<T: H5Type>(location: &Location, name: &str, value: &T) -> hdf5::Result<()> {
    location.new_attr::<T>().create(name)?.write_scalar(value)
}
