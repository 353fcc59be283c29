//! Text in and out of HDF5.

use std::str::FromStr;

use hdf5::types::{FixedAscii, FixedUnicode, TypeDescriptor, VarLenAscii, VarLenUnicode};
use hdf5::{Container, H5Type};

/// The longest fixed-length text that is read; texts of this layer are of variable length.
const FIXED_TEXT: usize = 256;

/// Variable-length UTF-8, null-terminated: the one kind of text that every reader shows as text.
pub(super) fn encode(text: &str) -> hdf5::Result<VarLenUnicode> {
    VarLenUnicode::from_str(text).map_err(|_| format!("the text {text:?} holds a null character").into())
}

/// Reads every text of an array or attribute; `None` where it holds something else than text.
pub(super) fn read(container: &Container) -> hdf5::Result<Option<Vec<String>>> {
    let texts = match container.dtype()?.to_descriptor()? {
        TypeDescriptor::VarLenUnicode => read_as::<VarLenUnicode>(container, VarLenUnicode::as_bytes)?,
        TypeDescriptor::VarLenAscii => read_as::<VarLenAscii>(container, VarLenAscii::as_bytes)?,
        TypeDescriptor::FixedAscii(size) if size <= FIXED_TEXT => {
            read_as::<FixedAscii<FIXED_TEXT>>(container, FixedAscii::as_bytes)?
        }
        TypeDescriptor::FixedUnicode(size) if size <= FIXED_TEXT => {
            read_as::<FixedUnicode<FIXED_TEXT>>(container, FixedUnicode::as_bytes)?
        }
        _ => return Ok(None),
    };
    Ok(Some(texts))
}

// Through bytes: a file may claim UTF-8 and hold something else.
fn read_as<T: H5Type>(container: &Container, bytes: impl Fn(&T) -> &[u8]) -> hdf5::Result<Vec<String>> {
    container
        .read_raw::<T>()?
        .iter()
        .map(|text| String::from_utf8(bytes(text).to_vec()).map_err(|_| hdf5::Error::from("a text is not valid UTF-8")))
        .collect()
}
