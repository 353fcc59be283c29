//! Files that a job is asked to write: what may give way to them, and where they may go.

use std::io::Read;
use std::path::Path;

use crate::error::UpliftError;

/// Bytes of a file in which this program names itself, where it wrote it.
const HEAD: u64 = 4096;

/// Refuses to write over a file that another program wrote.
///
/// # Errors
/// [`UpliftError::Usage`] where there is one at `output`.
pub fn refuse_foreign(output: &Path) -> Result<(), UpliftError> {
    let mut head = Vec::new();
    let read = std::fs::File::open(output).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    if read.is_ok() && !head.windows(7).any(|word| word == b"uplift ") {
        return Err(UpliftError::Usage(format!(
            "{} is there already, and was not written by this program: give another name",
            output.display()
        )));
    }
    Ok(())
}

/// Refuses to write over one of the `inputs`, by whatever path.
///
/// # Errors
/// [`UpliftError::Usage`] where `output` is one of them.
pub fn refuse_overwriting(output: &Path, inputs: &[impl AsRef<Path>]) -> Result<(), UpliftError> {
    let same = |input: &Path| matches!((output.canonicalize(), input.canonicalize()), (Ok(a), Ok(b)) if a == b);
    if inputs.iter().any(|input| same(input.as_ref())) {
        return Err(UpliftError::Usage(format!("{} would overwrite an input: give another name", output.display())));
    }
    Ok(())
}

/// Makes a folder for what is to be written, and those above it.
///
/// # Errors
/// A place where no folder can be.
pub fn provide_folder(folder: &Path) -> Result<(), UpliftError> {
    std::fs::create_dir_all(folder)
        .map_err(|error| UpliftError::input(format!("{} cannot be made: {error}", folder.display())))
}
