//! The kinds of study, and a study of any of them.

use std::path::Path;

use serde::Serialize;

use crate::displacement::{self, DisplacementStudy};
use crate::keys::SectionKeys;
use crate::reading::{Paths, Section};
use crate::sections::output::Output;
use crate::sections::top;
use crate::shake_table::{self, ShakeTableStudy};
use crate::uniform_risk::{self, CurveFile, SiteTable, UniformRiskStudy};
use crate::warning::Warning;

/// What a study is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Uniform risk spectra (Chapter 4).
    UniformRisk,
    /// Displacement spectra of record sets (Chapters 2 and 3).
    Displacement,
    /// The tests of a shaking table (Chapter 6).
    ShakeTable,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Self; 3] = [Self::UniformRisk, Self::Displacement, Self::ShakeTable];

    /// Its word: the value of the key `kind` of a study file, and of the attribute `kind` of a result.
    pub const fn key(self) -> &'static str {
        match self {
            Self::UniformRisk => "uniform risk spectra",
            Self::Displacement => "displacement spectra",
            Self::ShakeTable => "shake table",
        }
    }

    /// Its keys, section by section.
    pub(crate) const fn keys(self) -> &'static [SectionKeys] {
        match self {
            Self::UniformRisk => &uniform_risk::KEYS,
            Self::Displacement => &displacement::KEYS,
            Self::ShakeTable => &shake_table::KEYS,
        }
    }

    /// Reads the key `kind`; uniform risk where it is not given.
    pub(crate) fn read(root: &mut Section<'_>) -> Option<Self> {
        root.read(&top::KIND)
    }
}

/// A resolved study of any kind.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum AnyStudy {
    /// Of uniform risk spectra.
    UniformRisk(Box<UniformRiskStudy>),
    /// Of displacement spectra.
    Displacement(Box<DisplacementStudy>),
    /// Of a shaking table.
    ShakeTable(Box<ShakeTableStudy>),
}

impl AnyStudy {
    /// Reads a whole study by its kind; none where something is wrong.
    pub(crate) fn read(mut root: Section<'_>, paths: &Paths) -> Option<Self> {
        match Kind::read(&mut root)? {
            Kind::UniformRisk => uniform_risk::read(root, paths).map(|study| Self::UniformRisk(Box::new(study))),
            Kind::Displacement => displacement::read(root, paths).map(|study| Self::Displacement(Box::new(study))),
            Kind::ShakeTable => shake_table::read(root, paths).map(|study| Self::ShakeTable(Box::new(study))),
        }
    }

    /// What it is of.
    pub fn kind(&self) -> Kind {
        match self {
            Self::UniformRisk(_) => Kind::UniformRisk,
            Self::Displacement(_) => Kind::Displacement,
            Self::ShakeTable(_) => Kind::ShakeTable,
        }
    }

    /// Free text.
    pub fn title(&self) -> &str {
        match self {
            Self::UniformRisk(study) => &study.title,
            Self::Displacement(study) => &study.title,
            Self::ShakeTable(study) => &study.title,
        }
    }

    /// What is written where.
    pub fn output(&self) -> &Output {
        match self {
            Self::UniformRisk(study) => &study.output,
            Self::Displacement(study) => &study.output,
            Self::ShakeTable(study) => &study.output,
        }
    }

    /// The files that it names to be read: manifest, records of levels, hazard curves, tables and exports of sites, a
    /// structure.
    pub fn inputs(&self) -> Vec<&Path> {
        match self {
            Self::UniformRisk(study) => {
                let curves = study.sites.iter().flat_map(|site| site.curves.iter().flat_map(CurveFile::files));
                let of_sites = study.site_table.iter().flat_map(SiteTable::files);
                study.records.files().chain(curves).chain(of_sites).collect()
            }
            Self::Displacement(study) => study.records.manifest().into_iter().collect(),
            Self::ShakeTable(study) => {
                let tables = study.excitations.as_deref().into_iter().chain(study.records.manifest());
                tables.chain([study.structure.as_path()]).collect()
            }
        }
    }

    /// What is allowed but probably not meant.
    pub fn warnings(&self) -> &[Warning] {
        match self {
            Self::UniformRisk(study) => &study.warnings,
            Self::Displacement(study) => &study.warnings,
            Self::ShakeTable(study) => &study.warnings,
        }
    }
}

/// Writes every one of these alike.
macro_rules! written_as_toml {
    ($($study:ty),*) => {
        $(impl $study {
            /// The study as TOML, complete and loadable; the warnings are left out, since loading finds them again.
            ///
            /// # Errors
            ///
            /// Where TOML cannot hold a value; a study that was loaded has none such.
            pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
                toml::to_string(self)
            }
        })*
    };
}

written_as_toml!(AnyStudy, UniformRiskStudy, DisplacementStudy, ShakeTableStudy);
