//! The tests of a shaking table.

use std::io::Write;

use uplift::result::ShakeTable;
use uplift::table::TestsTable;
use uplift::text::{Table, metres_or_overturns};
use uplift_validation::Sample;

use crate::error::CommandError;

/// What stands for the displacement of a frame that overturns.
const OVERTURNS: &str = "overturns";

/// Medians and fractiles of each class at each level.
pub(super) fn print_tests(out: &mut impl Write, found: &ShakeTable) -> Result<(), CommandError> {
    writeln!(
        out,
        "\nPeak displacement U of the deck of {}, m; {} excitations{}",
        found.structure,
        found.excitations.len(),
        if found.synthetic { " (synthetic records)" } else { "" }
    )?;
    let classes = found.classes();
    let mut rows = Vec::new();
    for (index, level) in found.levels.iter().enumerate() {
        let all = (classes.len() != 1).then_some(None);
        for class in all.into_iter().chain(classes.iter().copied().map(Some)) {
            let of_class = found.tests_at_level(index).filter(|(one, _)| class.is_none_or(|class| one.class == class));
            let (mut u_m, mut still) = (Vec::new(), 0);
            for (_, test) in of_class {
                u_m.push(test.u_m);
                still += usize::from(test.u_m == 0.0);
            }
            let Ok(sample) = Sample::new(u_m) else { continue };
            let mut cells = vec![level.name.clone(), class.unwrap_or("all").to_owned(), sample.len().to_string()];
            cells.extend([0.16, 0.5, 0.84].map(|share| metres_or_overturns(fractile(&sample, share))));
            cells.extend([still.to_string(), sample.collapses().to_string()]);
            rows.push(cells);
        }
    }
    let header = ["level", "class", "tests", "16 %", "50 %", "84 %", "never uplift", "overturn"];
    Ok(writeln!(out, "{}", Table::new(header, rows))?)
}

/// Every test in the order of its response, beside a printed order.
pub(super) fn print_order(out: &mut impl Write, found: &TestsTable) -> Result<(), CommandError> {
    writeln!(out, "records: {}; structure: {}", found.record_set, found.structure)?;
    let or = |value: Option<f64>, none: &str, factor: f64, decimals: usize| {
        value.map_or_else(|| none.to_owned(), |value| format!("{:.decimals$}", factor * value))
    };
    let table = Table::from_rows(&found.rows)
        .left("order", |row| row.order)
        .right("level", |row| &row.level)
        .right("excitation", |row| &row.exc_id)
        .right("class", |row| &row.class)
        .right("U, m", |row| or(row.u_m, OVERTURNS, 1.0, 4))
        .right("drift, %", |row| or(row.drift, "-", 100.0, 2))
        .right("T, kN", |row| or(row.tendon_n, "-", 1e-3, 2))
        .right("base shear, kN", |row| or(row.base_shear_n, "-", 1e-3, 2))
        .when(found.agreement.is_some(), |table| {
            table.bar("printed", |row| row.reference.map_or_else(|| "-".to_owned(), |place| place.to_string()))
        });
    writeln!(out, "{table}")?;
    if let Some(agreement) = &found.agreement {
        let shown = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.3}"));
        let levels: Vec<String> = agreement
            .by_level
            .iter()
            .map(|(name, tests, found)| format!("{name} {} of {tests}", shown(*found)))
            .collect();
        writeln!(
            out,
            "both orders: Spearman {} of {} tests ({}); {} tests of the reference are not among these",
            shown(agreement.spearman),
            agreement.tests,
            levels.join(", "),
            agreement.reference_only
        )?;
    }
    Ok(())
}

/// The smallest value that at least this share of the tests does not exceed.
fn fractile(sample: &Sample, share: f64) -> f64 {
    let values = sample.sorted();
    values.iter().copied().find(|value| sample.cdf(*value) >= share).unwrap_or(f64::INFINITY)
}
