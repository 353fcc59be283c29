//! What the report shows of a shaking table.

use super::{Content, Part, Table};
use crate::figures::shake_table_figures;
use uplift::UpliftError;
use uplift::result::{ResultFile, ShakeTable};
use uplift::text::thousands;

pub(super) fn content(file: &ResultFile) -> Result<Content, UpliftError> {
    let table = file.shake_table()?;
    let parts = vec![Part {
        key: "tests",
        title: "Tests",
        note: String::new(),
        tables: Vec::new(),
        figures: shake_table_figures(&table),
        details: vec![tests(&table)],
    }];
    let levels: Vec<String> =
        table.levels.iter().map(|level| format!("{} ({} m/s)", level.name, level.pgv_srss_m_s)).collect();
    Ok(Content {
        subject: "Shaking table",
        extent: format!(
            "{} excitations at the levels {}, of {} at a length scale of {}.",
            table.excitations.len(),
            levels.join(", "),
            table.structure,
            table.length_scale
        ),
        facts: vec![("Analyses", thousands(table.tests.len() as u64))],
        answer: None,
        parts,
        source: None,
    })
}

fn tests(table: &ShakeTable) -> Table {
    let order = table.order();
    let tests = (0..table.levels.len()).flat_map(|level| table.of_level(level).map(move |test| (level, test)));
    let number = |value: f64, factor: f64, decimals: usize| {
        if value.is_finite() { format!("{:.decimals$}", factor * value) } else { "-".to_owned() }
    };
    let mut rows: Vec<(u32, Vec<String>)> = tests
        .zip(order)
        .map(|((level, (excitation, test)), order)| {
            let u = if test.u_m.is_infinite() { "overturns".to_owned() } else { number(test.u_m, 1.0, 4) };
            let cells = vec![
                excitation.exc_id.clone(),
                excitation.class.clone(),
                table.levels[level].name.clone(),
                order.to_string(),
                number(test.factor, 1.0, 3),
                u,
                number(test.drift, 100.0, 2),
                number(test.tendon_n, 1e-3, 2),
                number(test.base_shear_n, 1e-3, 2),
            ];
            (order, cells)
        })
        .collect();
    rows.sort_by_key(|(order, _)| *order);
    let header = ["excitation", "class", "level", "order", "factor", "U, m", "drift, %", "T, kN", "base shear, kN"];
    Table {
        id: "tests".to_owned(),
        title: "Tests in the order of rising response".to_owned(),
        note: "The deck does not turn about the vertical in the model.".to_owned(),
        group: String::new(),
        header: header.map(str::to_owned).to_vec(),
        text_columns: 3,
        rows: rows.into_iter().map(|(_, cells)| cells).collect(),
    }
}
