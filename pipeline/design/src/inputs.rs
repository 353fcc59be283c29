//! What a job on a structure reads, so that it writes over none of it.

use std::path::{Path, PathBuf};

use uplift_inputs::manifest::record_files;
use uplift_result::ResultFile;
use uplift_study::{AnyStudy, Structure};

/// The structure, the result, the manifest that is given in place of the study's, and the files that the result was
/// made from, where they still are; of a result that cannot be opened it is said later.
pub(super) fn inputs(structure: &Structure, result: &Path, manifest: Option<&Path>) -> Vec<PathBuf> {
    let of_study = || {
        let study = AnyStudy::UniformRisk(Box::new(ResultFile::open(result).ok()?.stored_study().ok()?));
        Some(study.inputs().into_iter().map(Path::to_owned).collect::<Vec<_>>())
    };
    let mut inputs = vec![structure.file.clone(), result.to_owned()];
    inputs.extend(manifest.map(Path::to_owned));
    inputs.extend(of_study().unwrap_or_default());
    let records: Vec<PathBuf> = inputs.iter().skip(2).flat_map(|path| record_files(path)).collect();
    inputs.extend(records);
    inputs
}
