//! What the report shows of a shaking table.

use super::{Content, Part, TitledTable, drawn};
use crate::figures::shake_table_figures;
use uplift::UpliftError;
use uplift::result::{ResultFile, ShakeTable};
use uplift::text::{Table, thousands};

pub(super) fn content(file: &ResultFile) -> Result<Content, UpliftError> {
    let table = file.shake_table()?;
    let mut figures = drawn(shake_table_figures(&table))?;
    let lead = (!figures.is_empty()).then(|| figures.remove(0));
    let parts = vec![Part { key: "tests", title: "Tests", note: "", figures, tables: vec![tests(&table)] }];
    let levels: Vec<String> =
        table.levels.iter().map(|level| format!("{} ({} m/s)", level.name, level.pgv_srss_m_s)).collect();
    Ok(Content {
        subject: "Shaking table",
        place: String::new(),
        oscillator: None,
        lead,
        summary: None,
        facts: vec![
            ("Structure", table.structure.clone()),
            ("Excitations", table.excitations.len().to_string()),
            ("Levels", levels.join(", ")),
            ("Length scale", table.length_scale.to_string()),
            ("Analyses", thousands(table.tests.len() as u64)),
        ],
        parts,
        source: None,
    })
}

fn tests(table: &ShakeTable) -> TitledTable {
    let order = table.order();
    let tests = (0..table.levels.len()).flat_map(|level| table.tests_at_level(level).map(move |test| (level, test)));
    let number = |value: f64, factor: f64, decimals: usize| {
        if value.is_finite() { format!("{:.decimals$}", factor * value) } else { "-".to_owned() }
    };
    let mut tests: Vec<_> = tests.zip(order).map(|((level, of), order)| (level, of, order)).collect();
    tests.sort_by_key(|(.., order)| *order);
    let rows = Table::from_rows(&tests)
        .left("excitation", |(_, (excitation, _), _)| &excitation.exc_id)
        .left("class", |(_, (excitation, _), _)| &excitation.class)
        .left("level", |(level, ..)| &table.levels[*level].name)
        .right("order", |(.., order)| order)
        .right("factor", |(_, (_, test), _)| number(test.factor, 1.0, 3))
        .right("U, m", |(_, (_, test), _)| match test.u_m {
            u_m if u_m.is_infinite() => "overturns".to_owned(),
            u_m => number(u_m, 1.0, 4),
        })
        .right("drift, %", |(_, (_, test), _)| number(test.drift, 100.0, 2))
        .right("T, kN", |(_, (_, test), _)| number(test.tendon_n, 1e-3, 2))
        .right("base shear, kN", |(_, (_, test), _)| number(test.base_shear_n, 1e-3, 2));
    let note = "The modelled deck does not rotate about the vertical.";
    TitledTable::new("tests", "Tests in the order of rising response", note, rows)
}
