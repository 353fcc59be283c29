//! An uncertain structure as an engineer reads it: its risk with a band, and what that owes to what.

use std::io::Write;

use uplift::structure::{QuantityReport, UncertainFinding, UncertaintyReport};
use uplift::text::{self, Table, per_cent, short, thousands, two_digits};
use uplift_structure::NO_CAPACITY;

use crate::error::CommandError;

/// Answers in short; `print_uncertainty` has the rest of them.
const SHOWN: usize = 3;

/// The risks and demands of a structure that is not known exactly, with bands of all that is not known of them.
pub(super) fn print_uncertain_answers(out: &mut impl Write, report: &UncertaintyReport) -> Result<(), CommandError> {
    for result in report.results.iter().take(SHOWN) {
        let is_rate = result.unit == "1/yr";
        let shown = |value: f64| if is_rate { text::rate(value) } else { two_digits(value) };
        let (value, at_most, band) = match &result.found {
            UncertainFinding::Epistemic(found) => {
                let [lower, .., upper] = found.by_all.percentiles;
                (found.by_structure.mean, found.by_structure.at_most_per_year, Some([lower, upper]))
            }
            UncertainFinding::Aleatory(found) => (found.value, found.at_most_per_year, found.by_record),
        };
        let value = match at_most {
            Some(bound) => format!("< {}", text::rate(bound)),
            None if is_rate && value == 0.0 => NO_CAPACITY.to_owned(),
            None => shown(value),
        };
        let is_banded = at_most.is_none() && value != NO_CAPACITY;
        let unit = if value == NO_CAPACITY {
            ""
        } else if is_rate {
            " per year"
        } else {
            " m"
        };
        let band = band
            .filter(|_| is_banded)
            .map_or_else(String::new, |[lower, upper]| format!(" (90 % band {} to {})", shown(lower), shown(upper)));
        let of = format!("{}, {}, {}", result.of, result.site, result.im);
        writeln!(out, "Uncertain oscillator, {of}: {value}{unit}{band}")?;
    }
    let more = report.results.len().saturating_sub(SHOWN);
    if more > 0 { Ok(writeln!(out, "          {more} more: --details")?) } else { Ok(()) }
}

/// Quantities, answers, and what they owe to what.
pub(super) fn print_uncertainty(out: &mut impl Write, report: &UncertaintyReport) -> Result<(), CommandError> {
    let kind = kind_in_words(report.kind);
    writeln!(
        out,
        "\nUncertain structure ({kind}): {} structures, {}, seed {}, {} analyses",
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
            "Shares of the variance: what remains if everything else is certain; alone: what goes if only this is \
             certain (docs/method.md, section 19)"
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
    let table = Table::from_rows(quantities)
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
            "{}: {} of the distribution is outside the possible range, and is cut off",
            quantity.quantity,
            per_cent(quantity.cut_off_share)
        )?;
    }
    Ok(())
}
