//! What `uplift design` and `uplift overturning` share: a structure, and the result whose records and hazard it meets.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::{Value, json};
use uplift_structure::{EquivalentSystem, PostUplift};

use crate::error::CommandError;
use crate::show::shown_path;
use uplift::inputs::RecordSet;
use uplift::result::{ResultFile, StudyOfResult};
use uplift::structure::EventRisk;
use uplift_study::Structure;

#[derive(Debug, Args)]
pub(super) struct StructureArguments {
    /// Structure file (TOML), for instance configs/structures/pier.toml
    structure: PathBuf,
    /// Result file of `uplift run`: its spectra, and the records and hazard that they were made from
    #[arg(long, value_name = "RESULT")]
    urs: PathBuf,
    /// Manifest of the records, where it is no longer where the study says
    #[arg(long, value_name = "CSV")]
    manifest: Option<PathBuf>,
}

impl StructureArguments {
    /// Files that are read.
    pub(super) fn inputs(&self) -> Vec<&Path> {
        [&self.structure, &self.urs].into_iter().chain(&self.manifest).map(PathBuf::as_path).collect()
    }

    /// Structure and result.
    pub(super) fn read(&self) -> Result<(Structure, StudyOfResult), CommandError> {
        let structure = Structure::load(&self.structure)?;
        Ok((structure, ResultFile::open(&self.urs)?.study(self.manifest.as_deref())?))
    }

    /// The records of the result; none where they cannot be read, with the reason, unless a manifest was given for them.
    pub(super) fn records(&self, source: &StudyOfResult) -> Result<Result<RecordSet, String>, CommandError> {
        match source.records() {
            Err(reason) if self.manifest.is_some() => Err(CommandError::input(reason)),
            other => Ok(other),
        }
    }
}

/// Position of the site `wanted`; of the only one where none is.
pub(super) fn site_index(source: &StudyOfResult, wanted: Option<&str>) -> Result<usize, CommandError> {
    let found = match wanted {
        Some(wanted) => source.sites.iter().position(|site| site.eq_ignore_ascii_case(wanted)),
        None => (source.sites.len() == 1).then_some(0),
    };
    found.ok_or_else(|| CommandError::Usage(format!("--site: the result has {}", source.sites.join(", "))))
}

/// Position of the measure `wanted`; of the first where none is, which is PGV if the result has it.
pub(super) fn measure_index(
    source: &StudyOfResult,
    wanted: Option<uplift_motion::IntensityMeasure>,
) -> Result<usize, CommandError> {
    let found = match wanted {
        Some(wanted) => source.measures.iter().position(|measure| measure.measure() == wanted),
        None => (!source.measures.is_empty()).then_some(0),
    };
    found.ok_or_else(|| {
        let known: Vec<&str> = source.measures.iter().map(|measure| measure.measure().key()).collect();
        CommandError::Usage(format!("--measure: the result has {}", known.join(", ")))
    })
}

/// A number with a few digits, in powers of ten where it is very large or small.
pub(super) fn short(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        let digits = 5_usize.saturating_sub(format!("{:.0}", value.abs().trunc()).len()).max(1);
        format!("{value:.digits$}")
    } else {
        format!("{value:.3e}")
    }
}

/// The structure in words: what is it, and which oscillator is it equivalent to; with its restitution where there is one to tell.
pub(super) fn lines(structure: &Structure, restitution: Option<f64>) -> Vec<String> {
    let system = &structure.system;
    let (kind, file) = (structure.description.kind.name(), shown_path(&structure.file).display());
    let mut lines = vec![
        format!("structure  {}: {kind}, Table 3.1 row {} ({file})", structure.name(), system.table_row()),
        format!("           equivalent mass          {} kg", short(system.mass_kg())),
        format!("           force at uplift          {} N", short(system.uplift_force_n())),
        format!("           strength f_up/(m g)      {:.4}", system.strength()),
        format!("           factor on the motion     {:.4}", system.participation()),
        format!("           strength of the spectrum {:.4}", system.spectral_strength()),
        format!("           uplift displacement      {} m", system.conditions().uplift_displacement_m()),
    ];
    lines.extend(restitution.map(|restitution| format!("           restitution              {restitution}")));
    lines.push(match system.post_uplift() {
        PostUplift::Negative { capacity_m } => format!("           displacement capacity    {capacity_m:.4} m"),
        PostUplift::Zero => "           displacement capacity    none: the force stays".to_owned(),
        PostUplift::Positive { stiffness_n_m } => {
            format!("           displacement capacity    none: the force rises, by {} N/m", short(stiffness_n_m))
        }
    });
    lines.extend(system.warnings().iter().map(|warning| format!("warning    {warning}")));
    lines
}

/// The structure for programs.
pub(super) fn structure_json(structure: &Structure, restitution: Option<f64>) -> Value {
    let system = &structure.system;
    let warnings: Vec<String> = system.warnings().iter().map(ToString::to_string).collect();
    json!({
        "file": structure.file,
        "kind": structure.description.kind.name(),
        "table_3_1_row": system.table_row(),
        "mass_kg": system.mass_kg(),
        "uplift_force_n": system.uplift_force_n(),
        "strength": system.strength(),
        "participation": system.participation(),
        "spectral_strength": system.spectral_strength(),
        "uplift_displacement_m": system.conditions().uplift_displacement_m(),
        "restitution": restitution,
        "capacity_m": capacity_m(system),
        "post_uplift_stiffness_n_m": system.post_uplift_stiffness_n_m(),
        "warnings": warnings,
    })
}

/// The displacement capacity, m; none for a structure that has none.
pub(super) fn capacity_m(system: &EquivalentSystem) -> Option<f64> {
    match system.post_uplift() {
        PostUplift::Negative { capacity_m } => Some(capacity_m),
        PostUplift::Zero | PostUplift::Positive { .. } => None,
    }
}

/// Frequency, probability and return period in words.
pub(super) fn risk_cells(risk: &EventRisk) -> [String; 3] {
    if risk.per_year == 0.0 {
        return ["never".to_owned(), "-".to_owned(), "-".to_owned()];
    }
    let years = 1.0 / risk.per_year;
    [
        format!("{:.3e}", risk.per_year),
        format!("{:.3} %", 100.0 * risk.probability),
        if years < 1e7 { format!("{years:.0}") } else { format!("{years:.1e}") },
    ]
}

/// The same for programs.
pub(super) fn risk_json(risk: &EventRisk) -> Value {
    json!({
        "per_year": risk.per_year,
        "probability": risk.probability,
        "lower_tail_share": risk.lower_tail_share,
        "upper_tail_share": risk.upper_tail_share,
    })
}

/// A number that JSON can hold.
pub(super) fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
