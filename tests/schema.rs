//! `uplift schema`: what it prints accepts every study and structure that comes with the program, and refuses mistakes.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::common::{SmallStudy, command};
use crate::python::{python, repository};

/// The schema of `of`, as the program prints it, in a file.
fn schema(folder: &Path, of: &str) -> PathBuf {
    let output = command(folder).args(["schema", of]).output().unwrap();
    assert!(output.status.success());
    let path = folder.join(format!("{of}.schema.json"));
    std::fs::write(&path, output.stdout).unwrap();
    path
}

fn validate(python: &Path, schema: &Path, files: &[PathBuf]) -> Output {
    let arguments = ["-m", "check_jsonschema", "--schemafile"];
    Command::new(python).args(arguments).arg(schema).args(files).output().unwrap()
}

/// The file of a library among the studies.
pub(crate) const LIBRARY: &str = "rocking-library.toml";

/// The TOML files of a folder of `configs`.
fn toml_files(folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(repository().join(folder)).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let is_study = |path: &PathBuf| !path.ends_with(LIBRARY) && path.extension().is_some_and(|own| own == "toml");
    paths.filter(is_study).collect()
}

#[test]
fn every_config_satisfies_the_schema_and_a_mistake_does_not() {
    let Some(python) = python() else { return };
    let small = SmallStudy::new();
    let folder = small.path();
    let [study, structure] = ["study", "structure"].map(|of| schema(folder, of));
    for (schema, folders) in [(&study, &["configs"][..]), (&structure, &["configs/structures", "configs/shake-table"])]
    {
        let files: Vec<PathBuf> = folders.iter().flat_map(|folder| toml_files(folder)).collect();
        assert!(!files.is_empty());
        let output = validate(&python, schema, &files);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    }
    let library = schema(folder, "library");
    let output = validate(&python, &library, &[repository().join("configs").join(LIBRARY)]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    let cases = [
        (&library, "[block]\nsize_m = -1\n", false),
        (&study, "[oscillator]\nrestitution = 0.95\n[strengths]\nvalues = \"0:1/100:1\"\n", true),
        (&study, "[oscillator]\nrestitutoin = 0.95\n", false),
        (&study, "[oscillator]\nrestitution = 1.5\n", false),
        (&study, "kind = \"displacement spectra\"\n[bootstrap]\nreplicates = 100\n", false),
        (&structure, "kind = \"pear\"\n", false),
    ];
    for (schema, text, is_sound) in cases {
        let file = folder.join("case.toml");
        std::fs::write(&file, text).unwrap();
        let output = validate(&python, schema, &[file]);
        assert_eq!(output.status.success(), is_sound, "{text}{}", String::from_utf8_lossy(&output.stdout));
    }
}
