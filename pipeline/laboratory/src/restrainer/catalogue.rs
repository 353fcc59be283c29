//! A catalogue of disc springs: a table that a user brings.

use std::path::Path;

use uplift_job::{JobError, ReferenceTable};
use uplift_statics::{CatalogueDisc, DiscDimensions};

use crate::error::LaboratoryError;

/// Most discs; no maker has more.
const MOST_DISCS: usize = 100_000;

/// How far cone height, free height and thickness may be from going together, m: what rounding leaves of each.
const ROUNDING_M: f64 = 0.06e-3;

/// Reads discs: `outer_diameter_mm`, `inner_diameter_mm`, `thickness_mm`, `cone_height_mm` or `free_height_mm`; where
/// they are known `reduced_thickness_mm`, `mass_kg`, `price` and a `name`.
///
/// # Errors
/// A file that is no such table, and every row that is no disc.
pub(super) fn read(file: &Path) -> Result<Vec<CatalogueDisc>, LaboratoryError> {
    let table = ReferenceTable::read_as("catalogue", file)?;
    let lacking: Vec<&str> = ["outer_diameter_mm", "inner_diameter_mm", "thickness_mm"]
        .into_iter()
        .filter(|name| !table.has(name))
        .chain((!table.has("cone_height_mm") && !table.has("free_height_mm")).then_some("cone_height_mm"))
        .collect();
    if !lacking.is_empty() {
        return Err(table.fail(format!("it has no column {}: lengths are in mm", lacking.join(", "))).into());
    }
    if table.rows() > MOST_DISCS {
        return Err(table.fail(format!("{} discs: at most {MOST_DISCS}", table.rows())).into());
    }
    let (mut discs, mut wrong) = (Vec::new(), Vec::new());
    for row in 0..table.rows() {
        match disc(&table, row) {
            Ok(disc) => discs.push(disc),
            Err(error) => wrong.push(error.to_string()),
        }
    }
    if !wrong.is_empty() {
        return Err(JobError::Inputs(wrong).into());
    }
    if discs.is_empty() {
        return Err(table.fail("it has no disc").into());
    }
    Ok(discs)
}

fn disc(table: &ReferenceTable, row: usize) -> Result<CatalogueDisc, LaboratoryError> {
    let length_m = |column: &str| table.number::<f64>(column, row).map(|mm| 1e-3 * mm);
    let given = |column: &str| table.has(column) && !table.text(column, row).is_empty();
    let optional = |column: &str| given(column).then(|| table.number::<f64>(column, row)).transpose();
    let thickness_m = length_m("thickness_mm")?;
    let cone_height_m =
        if given("cone_height_mm") { length_m("cone_height_mm")? } else { length_m("free_height_mm")? - thickness_m };
    if given("cone_height_mm") && given("free_height_mm") {
        let free_height_m = length_m("free_height_mm")?;
        if !((free_height_m - thickness_m - cone_height_m).abs() <= ROUNDING_M) {
            return Err(table
                .fail(format!(
                    "row {}: free_height_mm {} is not thickness_mm {} and cone_height_mm {} together",
                    row + 1,
                    table.text("free_height_mm", row),
                    table.text("thickness_mm", row),
                    table.text("cone_height_mm", row)
                ))
                .into());
        }
    }
    let dimensions = DiscDimensions {
        outer_diameter_m: length_m("outer_diameter_mm")?,
        inner_diameter_m: length_m("inner_diameter_mm")?,
        thickness_m,
        cone_height_m,
        reduced_thickness_m: optional("reduced_thickness_mm")?.map(|mm| 1e-3 * mm),
    };
    let name = if given("name") {
        table.text("name", row)
    } else {
        format!(
            "{}/{}/{}",
            table.text("outer_diameter_mm", row),
            table.text("inner_diameter_mm", row),
            table.text("thickness_mm", row)
        )
    };
    Ok(CatalogueDisc::new(name, dimensions, optional("mass_kg")?, optional("price")?)
        .map_err(|error| table.fail(format!("row {}: {error}", row + 1)))?)
}
