//! The place of a result file, checked before anything is computed.

use std::io::Read;
use std::path::{Path, PathBuf};

use uplift_atomic_file::open_file;
use uplift_job::JobError;
use uplift_job::outputs::{beside, is_same_file, place_to_try, wrong_ending};
use uplift_job::study_run::RunOptions;
use uplift_labelled::{LabelledError, LabelledReader, LabelledWriter};
use uplift_study::AnyStudy;

use super::layout::attribute::{Attribute, root};
use super::provenance::place_of;
use crate::error::ResultError;
use crate::what_counts;

/// First bytes of every HDF5 file.
const HDF5_SIGNATURE: [u8; 8] = *b"\x89HDF\r\n\x1a\n";

/// Check that a result can be written to `path` and replaces nothing but an earlier HDF5 file: a slip of the keyboard
/// must not cost a study, a record or a hazard curve.
///
/// # Errors
/// A folder that cannot be written, or a file there that is no HDF5 file.
pub fn check_target(path: &Path) -> Result<(), ResultError> {
    check_replaceable(path, false)
}

/// Check that the result of `study` can be written where `options` say, and replaces nothing but an earlier result;
/// none of the `inputs` in any case.
///
/// # Errors
/// [`JobError::Usage`] for a name that is not one of a result, and a place that is an input; else as
/// [`check_target`].
pub fn check_place(study: &AnyStudy, options: &RunOptions, inputs: &[PathBuf]) -> Result<(), ResultError> {
    let path = options.result_file(&study.output().file);
    let name = path.display();
    if let Some(reason) = wrong_ending(path, &["h5"]) {
        return Err(JobError::Usage(format!("a result is an HDF5 file: {reason}")).into());
    }
    if inputs.iter().any(|input| is_same_file(path, input)) {
        return Err(
            JobError::Usage(format!("{name} would overwrite an input: give the result another name (-o)")).into()
        );
    }
    // files that the result replaces go there, whatever is forced
    let earlier = beside(path, "earlier");
    if earlier.exists() && !earlier.is_dir() {
        return Err(JobError::Usage(format!(
            "{} is a file, and earlier results of {name} go into a folder of this name: rename that file, or the \
             result (-o)",
            earlier.display()
        ))
        .into());
    }
    check_replaceable(path, options.force)
}

/// Why an earlier result in the place of that of `study` is another's, so that only --force overwrites it: of
/// another study file, or of this one with other values in the place of the file's. None where there is nothing to
/// lose: the study file as it is now, edited or not, or the same numbers.
///
/// # Errors
/// A study that cannot be written.
pub fn replaces_another(study: &AnyStudy, options: &RunOptions) -> Result<Option<String>, ResultError> {
    let path = options.result_file(&study.output().file);
    // whatever else is there was looked at by `check_place`
    let Some(earlier) = LabelledReader::open(path).ok().filter(|_| !options.force) else { return Ok(None) };
    let text = |attribute: &Attribute<String>| attribute.read(&earlier, &[]).unwrap_or_default();
    if what_counts(&text(&root::STUDY_TOML)) == what_counts(&study.to_toml()?) {
        return Ok(None);
    }
    let name = path.display();
    if !is_of_file(&text, study, &options.study_file) {
        let other = text(&root::STUDY_FILE);
        return Ok(Some(format!("{name} is the result of another study ({other})")));
    }
    let sorted = |mut all: Vec<String>| {
        all.sort();
        all
    };
    let own = sorted(options.overrides.clone());
    // what an earlier version wrote does not say
    let kept = root::OVERRIDES.read(&earlier, &[]).map(|all| sorted(all.lines().map(str::to_owned).collect()));
    Ok(kept.ok().filter(|kept| *kept != own).map(|kept| {
        let said = |all: &[String]| match all {
            [] => "without --set".to_owned(),
            all => format!("with --set {}", all.join(" --set ")),
        };
        format!("{name} is the result of this study {}, this run is {}", said(&kept), said(&own))
    }))
}

/// Whether an earlier result is of this study file, which may have changed since: of the same place, or of the same
/// name with the same title.
fn is_of_file(text: &impl Fn(&Attribute<String>) -> String, study: &AnyStudy, file: &Path) -> bool {
    let place = place_of(file);
    let same_place = !place.is_empty() && text(&root::STUDY_PLACE) == place;
    let (kept, title) = (text(&root::STUDY_FILE), text(&root::TITLE));
    let same_name = Path::new(&kept).file_name() == file.file_name();
    same_place || (same_name && !title.is_empty() && title == study.title())
}

/// Refuses what lies at `path` and is no result; one that cannot be opened is a result that was damaged, which gives
/// way.
fn check_replaceable(path: &Path, force: bool) -> Result<(), ResultError> {
    drop(LabelledWriter::create(&place_to_try(path))?);
    let refused = |what: &str| {
        JobError::input(format!(
            "{}: exists and {what}, so it is not overwritten: give another name (-o), or --force",
            path.display()
        ))
    };
    if force || !path.exists() {
        return Ok(());
    }
    if !is_hdf5(path) {
        return Err(refused("is not an HDF5 file").into());
    }
    match LabelledReader::open(path) {
        Ok(reader) if root::PROGRAM.read(&reader, &[]).is_ok_and(|program| program == "uplift") => Ok(()),
        Ok(_) => Err(refused("is an HDF5 file of another program").into()),
        // another program's, or one of ours that another program has written to
        Err(LabelledError::Unsealed { .. }) => {
            Err(refused("is an HDF5 file without the checksum of this program").into())
        }
        Err(error @ (LabelledError::File(_) | LabelledError::Locked { .. })) => Err(error.into()),
        Err(_) => Ok(()),
    }
}

/// Whether the file at `path` begins as an HDF5 file does.
pub fn is_hdf5(path: &Path) -> bool {
    let mut first = [0; 8];
    let read = open_file(path).is_ok_and(|mut file| file.read_exact(&mut first).is_ok());
    read && first == HDF5_SIGNATURE
}
