//! The place of a result file, checked before anything is computed.

use std::io::Read;
use std::path::Path;

use crate::error::UpliftError;
use uplift_labelled::{LabelledReader, LabelledWriter};

/// First bytes of every HDF5 file.
const HDF5_SIGNATURE: [u8; 8] = *b"\x89HDF\r\n\x1a\n";

/// Check that a result can be written to `path` and replaces nothing but an earlier HDF5 file: a slip of the keyboard
/// must not cost a study, a record or a hazard curve.
///
/// # Errors
/// A folder that cannot be written, or a file there that is no HDF5 file.
pub fn check_target(path: &Path) -> Result<(), UpliftError> {
    drop(LabelledWriter::create(path)?);
    if path.exists() && !is_hdf5(path) {
        return Err(UpliftError::input(format!(
            "{}: is there already and is not an HDF5 file; it is left as it is: give the result file another name \
             (-o), or remove that one",
            path.display()
        )));
    }
    // one that cannot be opened is a result that was damaged: it gives way
    if let Ok(reader) = LabelledReader::open(path)
        && !reader.attribute_text("/", "program").is_ok_and(|program| program == "uplift")
    {
        return Err(UpliftError::input(format!(
            "{}: is there already and is an HDF5 file of another program; it is left as it is: give the result file \
             another name (-o), or remove that one",
            path.display()
        )));
    }
    Ok(())
}

/// Whether the file at `path` begins as an HDF5 file does.
pub fn is_hdf5(path: &Path) -> bool {
    let mut first = [0; 8];
    let read = std::fs::File::open(path).and_then(|mut file| file.read_exact(&mut first));
    read.is_ok() && first == HDF5_SIGNATURE
}
