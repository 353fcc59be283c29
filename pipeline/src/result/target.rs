//! The place of a result file, checked before anything is computed.

use std::io::Read;
use std::path::{Path, PathBuf};

use uplift_atomic_file::open_file;
use uplift_labelled::{LabelledError, LabelledReader, LabelledWriter};
use uplift_study::AnyStudy;

use super::provenance::place_of;
use crate::error::UpliftError;
use crate::frame::RunOptions;
use crate::outputs::{is_same_file, wrong_ending};
use crate::result_of::what_counts;

/// First bytes of every HDF5 file.
const HDF5_SIGNATURE: [u8; 8] = *b"\x89HDF\r\n\x1a\n";

/// Check that a result can be written to `path` and replaces nothing but an earlier HDF5 file: a slip of the keyboard
/// must not cost a study, a record or a hazard curve.
///
/// # Errors
/// A folder that cannot be written, or a file there that is no HDF5 file.
pub fn check_target(path: &Path) -> Result<(), UpliftError> {
    check_replaceable(path, false).map(drop)
}

/// Check that the result of `study` can be written where `options` say, and replaces nothing but an earlier result of
/// this study, or of whichever study where the place is this study's own or it is forced; none of the `inputs` in any
/// case.
///
/// # Errors
/// [`UpliftError::Usage`] for a name that is not one of a result, and a place that is an input or has a result of
/// another study; else as [`check_target`].
pub(crate) fn check_place(study: &AnyStudy, options: &RunOptions, inputs: &[PathBuf]) -> Result<(), UpliftError> {
    let path = options.result_file(&study.output().file);
    let name = path.display();
    if let Some(reason) = wrong_ending(path, &["h5"]) {
        return Err(UpliftError::Usage(format!("a result is an HDF5 file: {reason}")));
    }
    if inputs.iter().any(|input| is_same_file(path, input)) {
        return Err(UpliftError::Usage(format!("{name} would overwrite an input: give the result another name (-o)")));
    }
    let Some(earlier) = check_replaceable(path, options.force)? else { return Ok(()) };
    let stem = |path: &Path| path.file_stem().map(ToOwned::to_owned);
    let is_own_place = options.output.is_none() && stem(path) == stem(&options.study_file);
    if options.force || is_own_place || is_of_study(&earlier, study, &options.study_file)? {
        return Ok(());
    }
    let other = earlier.attribute_text("/", "study_file").unwrap_or_default();
    Err(UpliftError::Usage(format!(
        "{name} is the result of another study ({other}): give the result another name (-o), or --force to replace it"
    )))
}

/// Whether an earlier result is of the study at hand, which may have changed since: of the same file, of one of the
/// same name with the same title, or of one that says the same.
fn is_of_study(earlier: &LabelledReader, study: &AnyStudy, file: &Path) -> Result<bool, UpliftError> {
    let text = |name: &str| earlier.attribute_text("/", name).unwrap_or_default();
    let (kept, title) = (text("study_file"), text("title"));
    let place = place_of(file);
    let same_place = !place.is_empty() && text("study_place") == place;
    let same_name = Path::new(&kept).file_name() == file.file_name();
    let same_title = !title.is_empty() && title == study.title();
    Ok(same_place || (same_name && same_title) || what_counts(&text("study_toml")) == what_counts(&study.to_toml()?))
}

/// What there is to be replaced at `path`, if it can be opened; one that cannot is a result that was damaged, which
/// gives way.
fn check_replaceable(path: &Path, force: bool) -> Result<Option<LabelledReader>, UpliftError> {
    drop(LabelledWriter::create(path)?);
    let refused = |what: &str| {
        UpliftError::input(format!(
            "{}: is there already and {what}; it is left as it is: give the result file another name (-o), or \
             --force to replace that one",
            path.display()
        ))
    };
    if force || !path.exists() {
        return Ok(None);
    }
    if !is_hdf5(path) {
        return Err(refused("is not an HDF5 file"));
    }
    match LabelledReader::open(path) {
        Ok(reader) if reader.attribute_text("/", "program").is_ok_and(|program| program == "uplift") => {
            Ok(Some(reader))
        }
        Ok(_) => Err(refused("is an HDF5 file of another program")),
        // another program's, or one of ours that another program has written to
        Err(LabelledError::Unsealed { .. }) => Err(refused("is an HDF5 file without the checksum of this program")),
        Err(error @ (LabelledError::File(_) | LabelledError::Locked { .. })) => Err(error.into()),
        Err(_) => Ok(None),
    }
}

/// Whether the file at `path` begins as an HDF5 file does.
pub fn is_hdf5(path: &Path) -> bool {
    let mut first = [0; 8];
    let read = open_file(path).is_ok_and(|mut file| file.read_exact(&mut first).is_ok());
    read && first == HDF5_SIGNATURE
}
