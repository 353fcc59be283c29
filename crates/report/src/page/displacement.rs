//! What the report shows of displacement spectra.

use super::{Content, Part, TitledTable, drawn};
use crate::figures::{Extent, displacement_figures};
use uplift::UpliftError;
use uplift::result::{DesignRow, ResultFile, StoredDesign, StoredDisplacements, StoredStructures};
use uplift::text::{Table, thousands};

pub(super) fn content(file: &ResultFile) -> Result<Content, UpliftError> {
    let stored = file.displacements()?;
    let designs = file.design()?.map(|design| designs(&stored, &design)).unwrap_or_default();
    let mut figures = drawn(displacement_figures(file, &stored, Extent::Main)?)?;
    let lead = (!figures.is_empty()).then(|| figures.remove(0));
    let parts = vec![Part { key: "spectra", title: "Spectra and designs", note: "", figures, tables: designs }];
    let (structures, abscissas) = match stored.structures {
        StoredStructures::Oscillators { .. } => ("oscillators", "uplift strengths"),
        StoredStructures::Blocks { .. } => ("rocking blocks", "slendernesses"),
    };
    Ok(Content {
        subject: "Displacement spectra",
        place: stored.sets.iter().map(|set| set.name.as_str()).collect::<Vec<_>>().join(", "),
        oscillator: None,
        lead,
        summary: Some(sets(&stored)),
        facts: vec![
            (
                "Structures",
                format!("{} {structures} of {} {abscissas}", stored.structures.lines(), stored.abscissas.len()),
            ),
            ("Scalings", stored.scalings.join(", ")),
            ("Analyses", thousands(stored.analyses)),
        ],
        parts,
        source: None,
    })
}

fn sets(stored: &StoredDisplacements) -> TitledTable {
    let table = Table::from_rows(&stored.sets)
        .left("set", |set| &set.name)
        .right("records", |set| set.records)
        .right("motions", |set| 2 * set.records)
        .right("median PGA, g", |set| format!("{:.3}", set.median_pga_g))
        .right("median PGV, cm/s", |set| format!("{:.1}", set.median_pgv_cm_s));
    let note = format!(
        "Multiples refer to the medians of the geometric means (Eq. 2.16, 2.17). Figures: motions scaled by {}, \
         smallest uplift displacement.{}",
        stored.scaled_by.first().map_or("", String::as_str),
        stored.rounding.as_ref().map_or_else(String::new, |rounding| {
            let abscissas: Vec<String> = rounding.abscissas.iter().map(|at| format!("{at:.3}")).collect();
            format!(" The effect of rounding was examined at {}.", abscissas.join(", "))
        })
    );
    TitledTable::new("sets", "Record sets", note, table)
}

/// A table a set and rule: a row a quantity and way of scaling, a column a scaling.
fn designs(stored: &StoredDisplacements, design: &StoredDesign) -> Vec<TitledTable> {
    let StoredDesign { safety_factor, percentile, noise_points, noise_relative, .. } = design;
    let note = format!(
        "FS = {safety_factor}; percentile {percentile}. In brackets: lowest and highest over {noise_points} points, \
         from {} to {} times the abscissa.",
        1.0 - noise_relative,
        1.0 + noise_relative
    );
    let same = |a: &DesignRow, b: &DesignRow| a.record_set == b.record_set && a.rule == b.rule;
    design
        .rows
        .chunk_by(same)
        .enumerate()
        .map(|(index, of_table)| {
            let first = &of_table[0];
            let rule = match first.rule {
                Some("ED") => ": equal displacement",
                Some(_) => ": equal energy",
                None => "",
            };
            let mut cells: Vec<Vec<String>> = Vec::new();
            for of_quantity in of_table.chunk_by(|a, b| a.quantity == b.quantity) {
                for by in &stored.scaled_by {
                    let own = of_quantity.iter().filter(|row| row.scaled_by == *by);
                    let row =
                        [of_quantity[0].quantity.clone(), by.clone()].into_iter().chain(own.map(DesignRow::ranged));
                    cells.push(row.collect());
                }
            }
            let header =
                ["quantity", "scaled by"].into_iter().map(str::to_owned).chain(stored.scalings.iter().cloned());
            let table = Table::new(header, cells).with_left(2);
            let title = format!("Design example, {}{rule}", first.record_set);
            TitledTable::new(&format!("design-{}", index + 1), title, format!("{note}{}", rounding(of_table)), table)
        })
        .collect()
}

/// What the asterisks of a table mean, with what rounding makes of each value; empty without any.
fn rounding(rows: &[DesignRow]) -> String {
    let moved: Vec<String> = rows.iter().filter_map(DesignRow::rounding_words).collect();
    if moved.is_empty() {
        return String::new();
    }
    format!(
        " *: the last digits are not significant (rounding). Range over scale factors some 1e-15 lower and higher: {}.",
        moved.join("; ")
    )
}
