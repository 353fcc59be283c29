//! Tests of the study file as a whole; text in, resolved study or rendered mistakes out.
mod configs;
mod directions;
mod displacement;
mod grids;
mod library;
mod mistakes;
mod overriding;
mod reference;
mod resolving;
mod restrainers;
mod shake_table;
mod uncertainty;
mod written;

use std::fs;
use std::path::PathBuf;

use miette::{GraphicalReportHandler, GraphicalTheme};
use tempfile::TempDir;

use super::{AnyStudy, DisplacementStudy, Structure, Study, StudyError, UniformRiskStudy};

/// A folder with a study file, two hazard curves and a manifest.
struct Folder {
    folder: TempDir,
}

impl Folder {
    fn new(study: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        for name in ["study.toml", "pgv.csv", "pga.csv", "manifest.csv"] {
            let text = if name == "study.toml" { study } else { "" };
            fs::write(folder.path().join(name), text).unwrap();
        }
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        fs::canonicalize(self.folder.path()).unwrap().join(name)
    }

    fn load(&self, overrides: &[&str]) -> Result<UniformRiskStudy, StudyError> {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        Study::load(&self.path("study.toml"), &overrides)
    }

    fn load_displacement(&self, overrides: &[&str]) -> Result<DisplacementStudy, StudyError> {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        match Study::load_any(&self.path("study.toml"), &overrides)? {
            AnyStudy::Displacement(study) => Ok(*study),
            other => panic!("a study of {}", other.kind().key()),
        }
    }

    /// What a user sees, without the name of the folder.
    fn rendered(&self, error: &StudyError) -> String {
        let shown = render(error);
        shown.replace(&format!("{}/", self.path("").display()).replace("//", "/"), "")
    }
}

/// The error as a terminal without colours shows it.
fn render(error: &StudyError) -> String {
    let mut shown = String::new();
    GraphicalReportHandler::new_themed(GraphicalTheme::unicode_nocolor())
        .with_width(400)
        .render_report(&mut shown, error)
        .unwrap();
    shown
}

fn load(study: &str) -> Result<UniformRiskStudy, StudyError> {
    Folder::new(study).load(&[])
}

fn load_structure(text: &str) -> Result<Structure, StudyError> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("structure.toml");
    fs::write(&file, text).unwrap();
    Structure::load(&file)
}

/// The mistakes of a study as "key: message", in order.
fn mistakes(study: &str, overrides: &[&str]) -> Vec<String> {
    let folder = Folder::new(study);
    let error = folder.load(overrides).unwrap_err();
    let texts = error.mistakes().iter().map(ToString::to_string);
    texts.collect()
}
