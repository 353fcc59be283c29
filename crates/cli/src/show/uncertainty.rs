//! An uncertain structure as an engineer reads it: its risk with a band, and what that owes to what.

use std::io::Write;

use uplift::structure::{QuantityReport, UncertainFinding, UncertaintyReport};
use uplift::text::{Table, per_cent, short, thousands};

use crate::error::CommandError;

/// Quantities, answers, and what they owe to what.
pub(super) fn print_uncertainty(out: &mut impl Write, report: &UncertaintyReport) -> Result<(), CommandError> {
    let kind = kind_in_words(report.kind);
    writeln!(
        out,
        "\nWhat is not known of the structure ({kind}): {} structures, {}, seed {}, {} analyses",
        thousands(report.structures as u64),
        report.sampling,
        report.seed,
        thousands(report.analyses)
    )?;
    print_quantities(out, &report.quantities)?;
    for result in &report.results {
        writeln!(out, "{}", result.in_words())?;
    }
    if report.results.iter().any(|result| matches!(result.found, UncertainFinding::Epistemic(_))) {
        writeln!(
            out,
            "A share is of the variance: what would stay if all else were known, and alone what would go if only that \
             were (docs/method.md, section 19)"
        )?;
    }
    Ok(())
}

/// The key of a kind with what it means.
pub(super) fn kind_in_words(kind: &str) -> &'static str {
    match kind {
        "aleatory" => "aleatory, structures of each record",
        _ => "epistemic, every structure a branch",
    }
}

/// A row for each, and what was cut off.
pub(super) fn print_quantities(out: &mut impl Write, quantities: &[QuantityReport]) -> Result<(), CommandError> {
    let table = Table::of(quantities)
        .left(
            "quantity",
            |of| if of.unit.is_empty() { of.name.to_owned() } else { format!("{}, {}", of.name, of.unit) },
        )
        .right("distribution", |of| of.distribution)
        .each(["5 %", "16 %", "50 %", "84 %", "95 %"].into_iter().enumerate(), |table, (at, heading)| {
            table.right(heading, |of| short(of.percentiles[at]))
        })
        .right("correlated with", |of| match of.correlated_with.as_slice() {
            [] => "-".to_owned(),
            names => names.join(", "),
        });
    writeln!(out, "{table}")?;
    for quantity in quantities.iter().filter(|quantity| quantity.cut_off_share > 0.0) {
        writeln!(
            out,
            "{}: {} of the distribution lies where it cannot be, and is cut off",
            quantity.quantity,
            per_cent(quantity.cut_off_share)
        )?;
    }
    Ok(())
}
