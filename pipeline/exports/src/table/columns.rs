//! What the columns of a structure have: the quantities of Table 5.1 and Section 6.3, ours beside a reference.

use std::path::PathBuf;

use serde::Serialize;
use uplift_job::ReferenceTable;
use uplift_laboratory::pushover::{axial_load_ratio, capacity, pushed};
use uplift_statics::{EventKind, Parts, RestrainedColumns, Restrainer, Spring, TendonPath};
use uplift_study::Structure;

use super::options::TableOptions;
use crate::error::ExportsError;

/// Drift ratio up to which the force is searched for its peak, that of the last slope of Table 5.1.
const LARGEST_DRIFT: f64 = 0.15;
/// Steps up to there.
const DRIFT_STEPS: u32 = 1500;

/// A quantity of the columns.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ColumnsRow {
    /// Its name, with its unit.
    pub quantity: String,
    /// Stiffness (N/m) of the linear restrainer, held in the column's axis, that stands in place of the structure's
    /// own; none with its own.
    pub stiffness_n_m: Option<f64>,
    /// Ours; none where the columns do not have it.
    pub value: Option<f64>,
    /// The reference's.
    pub reference: Option<f64>,
    /// What the reference says of its number: what it was computed with, or that it was measured.
    pub source: Option<String>,
}

impl ColumnsRow {
    /// How much ours is more than the reference; none where either is missing, or the reference is 0.
    pub fn difference(&self) -> Option<f64> {
        let (ours, theirs) = self.value.zip(self.reference)?;
        (theirs != 0.0).then(|| ours / theirs - 1.0)
    }
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

/// Computes the quantities, and reads the reference's: a table with the columns `quantity` and `value`, and where they
/// are wanted `stiffness_n_m`, of a linear restrainer in place of the structure's, and `source`. A quantity may have
/// several rows.
pub(super) fn read(options: &TableOptions) -> Result<ColumnsTable, ExportsError> {
    let structure = Structure::load(&options.result)?;
    let columns = pushed(&structure, 0)?;
    let own = quantities(&structure, &columns)?;
    let mut rows: Vec<ColumnsRow> = own
        .iter()
        .map(|(quantity, value)| ColumnsRow {
            quantity: (*quantity).to_owned(),
            stiffness_n_m: None,
            value: *value,
            reference: None,
            source: None,
        })
        .collect();
    if let Some(path) = &options.reference {
        let table = ReferenceTable::read(path)?;
        if !table.has("quantity") || !table.has("value") {
            return Err(table.fail("the reference of a structure has the columns quantity and value").into());
        }
        for index in 0..table.rows() {
            let quantity = table.text("quantity", index);
            if !own.iter().any(|(name, _)| *name == quantity) {
                let known: Vec<&str> = own.iter().map(|(name, _)| *name).collect();
                return Err(table
                    .fail(format!("row {}: {quantity} is not one of {}", index + 1, known.join(", ")))
                    .into());
            }
            let stiffness_n_m = match table.text("stiffness_n_m", index).as_str() {
                "" => None,
                _ => Some(table.number("stiffness_n_m", index)?),
            };
            let ours = match stiffness_n_m {
                None => own.clone(),
                Some(stiffness_n_m) => {
                    let law = Restrainer::new(Parts::linear(stiffness_n_m))
                        .map_err(|error| table.fail(format!("row {}: {error}", index + 1)))?;
                    quantities(&structure, &columns.clone().with_restrainer(law, TendonPath::Column)?)?
                }
            };
            let row = ColumnsRow {
                value: ours.into_iter().find(|(name, _)| *name == quantity).and_then(|(_, value)| value),
                stiffness_n_m,
                reference: Some(table.number("value", index)?),
                source: Some(table.text("source", index)).filter(|source| !source.is_empty()),
                quantity,
            };
            place(&mut rows, row);
        }
    }
    let compared = options.reference.is_some();
    Ok(ColumnsTable { structure: structure.name(), file: structure.file, rows, compared })
}

/// Puts a row with a reference where its quantity stands without one, else behind the last of its quantity.
fn place(rows: &mut Vec<ColumnsRow>, row: ColumnsRow) {
    let own = rows.iter_mut().find(|other| other.quantity == row.quantity && other.reference.is_none());
    match own {
        Some(own) if row.stiffness_n_m.is_none() => *own = row,
        _ => {
            let last = rows.iter().rposition(|other| other.quantity == row.quantity);
            rows.insert(last.map_or(rows.len(), |last| last + 1), row);
        }
    }
}

/// The drift ratio, up to that of the last slope of Table 5.1, at which the force is largest; none where the springs
/// stop the columns before that.
fn drift_at_peak(columns: &RestrainedColumns) -> Option<f64> {
    let height_m = columns.geometry().height_m();
    let mut peak = (f64::NEG_INFINITY, 0.0);
    for step in 0..=DRIFT_STEPS {
        let drift = LARGEST_DRIFT * f64::from(step) / f64::from(DRIFT_STEPS);
        let force_n = columns.at_displacement(drift * height_m).ok()?.force_n;
        if force_n > peak.0 {
            peak = (force_n, drift);
        }
    }
    Some(peak.1)
}

/// Names and values, in the order of the text.
fn quantities(
    structure: &Structure,
    columns: &RestrainedColumns,
) -> Result<Vec<(&'static str, Option<f64>)>, ExportsError> {
    let capacity = capacity(columns)?;
    let bare = columns.without_stoppers()?;
    let twice_m = 2.0 * columns.geometry().width_m();
    let exact = bare.capacity();
    let linear = bare.linear(capacity.linear_stiffness_n_m)?;
    let slope = |columns: &RestrainedColumns| columns.slope_between_drifts_n_m(0.03, 0.15).ok();
    let event = |kind| columns.first(kind).map(|event| event.state);
    let restrainer = columns.restrainer();
    let parts = restrainer.map(Restrainer::parts);
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
        ("deck_weight_n", Some(f64::from(columns.columns()) * columns.top_load_n())),
        ("uplift_force_n", Some(columns.uplift_force_n())),
        ("drift_at_peak", drift_at_peak(columns)),
        ("slope_3_to_15_percent_n_m", slope(columns)),
        ("stiffness_for_twice_the_width_n_m", Some(linear.stiffness_for_capacity_n_m(twice_m))),
        ("critical_stiffness_n_m", Some(capacity.critical_stiffness_n_m)),
        ("tendon_stiffness_n_m", restrainer.and_then(|held| held.parts().tendon).map(|tendon| tendon.stiffness_n_m)),
        ("tendon_yield_n", parts.and_then(|parts| parts.tendon?.yield_n)),
        ("stopper_yield_n", parts.and_then(|parts| parts.stopper?.yield_n)),
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
        ("axial_load_ratio", axial_load_ratio(structure, columns)),
    ])
}
