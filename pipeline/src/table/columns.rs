//! What the columns of a structure have: the quantities of Table 5.1 and Section 6.3, ours beside a reference.

use std::path::PathBuf;

use serde::Serialize;
use uplift_statics::{EventKind, RestrainedColumns, Spring, TendonPath};
use uplift_study::Structure;

use super::TableOptions;
use super::reference::ReferenceTable;
use crate::error::UpliftError;
use crate::pushover::{PushoverOptions, PushoverReport, pushover};

/// A quantity of the columns.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ColumnsRow {
    /// Its name, with its unit.
    pub quantity: String,
    /// Ours; none where the columns do not have it.
    pub value: Option<f64>,
    /// The reference's.
    pub reference: Option<f64>,
}

/// The quantities of a structure's columns.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ColumnsTable {
    /// Name of the structure.
    pub structure: String,
    /// Its file.
    pub file: PathBuf,
    /// The rows.
    pub rows: Vec<ColumnsRow>,
    /// Whether a reference was given.
    pub compared: bool,
}

/// Computes the quantities, and reads the reference's: a table with the columns `quantity` and `value`.
pub(super) fn read(options: &TableOptions) -> Result<ColumnsTable, UpliftError> {
    let structure = Structure::load(&options.result)?;
    let report = pushover(&structure, &PushoverOptions::default(), &crate::Silent)?;
    let mut rows: Vec<ColumnsRow> = quantities(&report)?
        .into_iter()
        .map(|(quantity, value)| ColumnsRow { quantity: quantity.to_owned(), value, reference: None })
        .collect();
    if let Some(path) = &options.reference {
        let table = ReferenceTable::read(path)?;
        if !table.has("quantity") || !table.has("value") {
            return Err(table.fail("the reference of a structure has the columns quantity and value"));
        }
        for index in 0..table.rows() {
            let quantity = table.text("quantity", index);
            let value = table.number("value", index)?;
            let Some(row) = rows.iter_mut().find(|row| row.quantity == quantity) else {
                let known: Vec<&str> = rows.iter().map(|row| row.quantity.as_str()).collect();
                return Err(table.fail(format!("row {}: {quantity} is not one of {}", index + 1, known.join(", "))));
            };
            row.reference = Some(value);
        }
    }
    let compared = options.reference.is_some();
    Ok(ColumnsTable { structure: structure.name(), file: structure.file, rows, compared })
}

/// Names and values, in the order of the text.
fn quantities(report: &PushoverReport) -> Result<Vec<(&'static str, Option<f64>)>, UpliftError> {
    let columns = &report.pushed;
    let capacity = &report.capacity;
    let bare = columns.without_stoppers()?;
    let exact = bare.capacity();
    let twice_m = 2.0 * report.width_m;
    let linear = bare.linear(capacity.linear_stiffness_n_m)?;
    let slope = |columns: &RestrainedColumns| columns.slope_between_drifts_n_m(0.03, 0.15).ok();
    let event = |kind| columns.first(kind).map(|event| event.state);
    let restrainer = columns.restrainer();
    let stack = restrainer.and_then(|held| match held.parts().spring {
        Spring::Discs(stack) => Some(stack),
        Spring::Rigid | Spring::Linear { .. } => None,
    });
    let at_capacity = exact.and_then(|found| bare.at_rotation(found.rotation_rad).ok());
    let centred = match (restrainer, columns.path()) {
        (Some(_), TendonPath::Shifted { .. }) => {
            let held = bare.restrainer().cloned();
            held.map(|held| bare.clone().with_restrainer(held, TendonPath::Column)).transpose()?
        }
        _ => None,
    };
    let centred_capacity = centred.as_ref().and_then(RestrainedColumns::capacity);
    let spring_secant =
        |spring_m: Option<f64>| stack.zip(spring_m).map(|(stack, spring_m)| stack.law().force_n(spring_m) / spring_m);
    let secant_at_45_mm = restrainer.and_then(|held| held.at(0.045).ok()).map(|state| state.force_n / 0.045);
    Ok(vec![
        ("uplift_force_n", Some(report.uplift_force_n)),
        ("slope_3_to_15_percent_n_m", slope(columns)),
        ("stiffness_for_twice_the_width_n_m", Some(linear.stiffness_for_capacity_n_m(twice_m))),
        ("critical_stiffness_n_m", Some(capacity.critical_stiffness_n_m)),
        ("tendon_stiffness_n_m", restrainer.and_then(|held| held.parts().tendon).map(|tendon| tendon.stiffness_n_m)),
        ("stack_flat_deformation_m", stack.map(|stack| stack.flat_deformation_m())),
        ("stack_flat_force_n", stack.map(|stack| stack.flat_force_n())),
        ("secant_at_45_mm_n_m", secant_at_45_mm),
        ("capacity_m", exact.map(|found| found.displacement_m)),
        ("linear_capacity_m", linear.capacity_m()),
        ("secant_at_capacity_n_m", exact.and_then(|found| found.secant_n_m)),
        ("spring_at_capacity_m", exact.and_then(|found| found.spring_m)),
        ("spring_secant_at_capacity_n_m", spring_secant(exact.and_then(|found| found.spring_m))),
        ("tendon_at_capacity_n", at_capacity.map(|state| state.tendon_n)),
        ("capacity_of_centred_tendon_m", centred_capacity.map(|found| found.displacement_m)),
        ("secant_of_centred_tendon_n_m", centred_capacity.and_then(|found| found.secant_n_m)),
        ("spring_of_centred_tendon_m", centred_capacity.and_then(|found| found.spring_m)),
        ("spring_secant_of_centred_tendon_n_m", spring_secant(centred_capacity.and_then(|found| found.spring_m))),
        ("tendon_touches_at_m", event(EventKind::TendonTouches).map(|state| state.displacement_m)),
        ("stopper_engages_at_m", event(EventKind::StopperEngages).map(|state| state.displacement_m)),
        ("tendon_when_stopper_engages_n", event(EventKind::StopperEngages).map(|state| state.tendon_n)),
        ("tendon_when_stopper_yields_n", event(EventKind::StopperYields).map(|state| state.tendon_n)),
        ("tendon_yields_at_drift", event(EventKind::TendonYields).map(|state| state.drift)),
        ("axial_load_ratio", report.axial_load_ratio),
    ])
}
