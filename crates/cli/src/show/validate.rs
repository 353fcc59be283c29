//! A validation in lines and tables.

use std::io::Write;

use uplift::text::{Table, share};
use uplift::validate::{GroupReport, PRule, ValidateReport};
use uplift_validation::{Pairs, Quantiles};

use super::alarms::print_lines;
use super::structure::print_notes;
use super::{print_files, print_more, shown_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// Of what is not defined.
const NONE: &str = "-";

/// Test and medians of each group; in detail all tests, sizes of differences, distances and notes.
pub(crate) fn print_validation(report: &ValidateReport, terminal: &Terminal) -> Result<(), CommandError> {
    let mut out = output();
    print_answer(&mut out, report)?;
    if terminal.shows_details() {
        print_details(&mut out, report)?;
    }
    print_lines(&mut out, &report.doubts, true)?;
    print_more(&mut out, terminal)?;
    drop(out);
    print_files(&report.files, terminal)
}

/// Whether each group's peaks are distributed alike, by a test and by their medians.
fn print_answer(out: &mut impl Write, report: &ValidateReport) -> Result<(), CommandError> {
    let unit = if report.unit.is_empty() { String::new() } else { format!(", {}", report.unit) };
    let table = Table::from_rows(&report.groups)
        .left("group", ValidateReport::name)
        .right("n", |group| group.measured)
        .right("D", |group| digits(group.kolmogorov_smirnov.distance))
        .right("p", |group| digits(group.kolmogorov_smirnov.p_exact))
        .right("evidence of a difference", |group| group.evidence.words())
        .right(format!("median measured{unit}"), |group| median(group.median_measured, group.median_measured_above))
        .right("computed", |group| median(group.median_computed, group.median_computed_above))
        .right("error", |group| group.median_error.map_or_else(dash, signed));
    writeln!(out, "{table}")?;
    if report.key.is_empty() {
        writeln!(out, "Two samples, not joined: --key COLUMN joins rows of the same motion")?;
    }
    let of = &report.unmatched;
    let left_out = |only: &[String], blank: &[String]| only.len() + blank.len();
    let measured = left_out(&of.measured_only, &of.measured_blank);
    let computed = left_out(&of.computed_only, &of.computed_blank);
    if measured + computed > 0 {
        writeln!(out, "Left out {measured} measured and {computed} computed rows, without a partner or a value")?;
    }
    Ok(())
}

fn print_details(mut out: &mut impl Write, report: &ValidateReport) -> Result<(), CommandError> {
    writeln!(out, "\nmeasured   {}", shown_path(&report.measured).display())?;
    writeln!(out, "computed   {}", shown_path(&report.computed).display())?;
    let joined = if report.key.is_empty() {
        "two samples, not joined".to_owned()
    } else {
        format!("pairs by {}", report.key.join(", "))
    };
    writeln!(out, "peaks      {}, {joined}; - is not defined, above all with collapses", report.value)?;
    print_tests(&mut out, report)?;
    print_sizes(&mut out, report)?;
    print_distances(&mut out, report)?;
    print_notes(out, &report.notes)
}

fn print_tests(out: &mut impl Write, report: &ValidateReport) -> Result<(), CommandError> {
    let permuted = report.groups.iter().any(|group| group.p_permutation.is_some());
    let at_limits = report.groups.iter().any(|group| group.censored.is_some());
    let sizes = |group: &GroupReport| match (group.measured, group.computed) {
        (measured, computed) if measured == computed => measured.to_string(),
        (measured, computed) => format!("{measured}, {computed}"),
    };
    let p_exact = |group: &GroupReport| {
        let ties = if group.kolmogorov_smirnov.has_ties { "=" } else { "" };
        format!("{}{ties}", digits(group.kolmogorov_smirnov.p_exact))
    };
    let table = Table::from_rows(&report.groups)
        .left("Kolmogorov-Smirnov", ValidateReport::name)
        .right("n", sizes)
        .right("D", |group| digits(group.kolmogorov_smirnov.distance))
        .right("p exact", p_exact)
        .right("Kolmogorov", |group| digits(group.kolmogorov_smirnov.p_kolmogorov))
        .right("kstest2", |group| digits(group.kolmogorov_smirnov.p_kstest2))
        .right("Holm", |group| digits(group.p_holm))
        .right("evidence", |group| group.evidence.words())
        .right(format!("sees at {}", report.significance), |group| {
            group.detectable_factor.map_or_else(dash, |factor| format!("a factor of {factor:.2}"))
        })
        .when(permuted, |table| table.right("p swaps", |group| or_dash(group.p_permutation)))
        .when(at_limits, |table| {
            table.right("D at limits", |group| or_dash(group.censored.map(|of| of.ks_distance_at_limits)))
        });
    writeln!(out, "\n{table}")?;
    let rule = match report.p_rule {
        PRule::Exact => "the exact p",
        PRule::Kolmogorov => "Kolmogorov's p",
        PRule::Kstest2 => "kstest2's p",
    };
    writeln!(
        out,
        "evidence   against equal distributions, by {rule} (Table 6.1); \"sees\": the factor between the medians that \
         the test finds with 80 %"
    )?;
    if report.groups.iter().any(|group| group.kolmogorov_smirnov.has_ties) {
        writeln!(out, "=          equal peaks: this p is too large rather than too small")?;
    }
    Ok(())
}

fn print_sizes(out: &mut impl Write, report: &ValidateReport) -> Result<(), CommandError> {
    let (measured, computed) = (format!("measured, {}", report.unit), format!("computed, {}", report.unit));
    let mut header =
        vec!["medians and pairs", measured.trim_end_matches(", "), computed.trim_end_matches(", "), "e50", "error"];
    header.push("5 to 95 %");
    let are_pairs = !report.key.is_empty();
    if are_pairs {
        header.extend(["bias", "5 to 95 %", "dispersion", "5 to 95 %", "Pearson", "Spearman", "in 1.5", "in 2"]);
    }
    let rows = report.groups.iter().map(|group| {
        let mut cells = vec![ValidateReport::name(group)];
        cells.extend([
            median(group.median_measured, group.median_measured_above),
            median(group.median_computed, group.median_computed_above),
        ]);
        cells.extend([group.e50.map(share), group.median_error.map(signed)].map(|cell| cell.unwrap_or(dash())));
        cells.push(band(group.median_error_band, signed));
        if let Some(pairs) = &group.pairs {
            cells.extend(pair_cells(group, pairs));
        }
        cells
    });
    writeln!(out, "\n{}", Table::new(header, rows))?;
    if are_pairs {
        writeln!(
            out,
            "bias       mean of ln(computed/measured), dispersion their standard deviation; \"in 2\": pairs within a \
             factor of 2"
        )?;
    }
    Ok(())
}

fn pair_cells(group: &GroupReport, pairs: &Pairs) -> Vec<String> {
    let bands = group.pair_bands;
    let number = |value: f64| without_sign_of_zero(format!("{value:.3}"));
    vec![
        pairs.log_bias.map_or_else(dash, number),
        band(bands.and_then(|bands| bands.log_bias), number),
        pairs.log_dispersion.map_or_else(dash, number),
        band(bands.and_then(|bands| bands.log_dispersion), number),
        pairs.pearson.map_or_else(dash, number),
        pairs.spearman.map_or_else(dash, number),
        share(pairs.within_1_5),
        share(pairs.within_2),
    ]
}

fn print_distances(out: &mut impl Write, report: &ValidateReport) -> Result<(), CommandError> {
    let wasserstein = format!("Wasserstein, {}", report.unit);
    let mut header = vec!["other tests", "AD midrank", "AD right", "CvM", "p", "Mann-Whitney U", "p"];
    header.extend([wasserstein.trim_end_matches(", "), "energy", "collapses measured", "computed"]);
    let are_pairs = !report.key.is_empty();
    if are_pairs {
        header.extend(["both", "one"]);
    }
    let rows = report.groups.iter().map(|group| {
        let (darling, mises, whitney) = (&group.anderson_darling, &group.cramer_von_mises, &group.mann_whitney);
        let mut cells = vec![ValidateReport::name(group)];
        cells.extend([darling.midrank, darling.right, mises.statistic, mises.p].map(digits));
        cells.extend([format!("{}", whitney.statistic), digits(whitney.p)]);
        cells.extend([group.wasserstein, group.energy].map(or_dash));
        cells.extend([group.measured_collapses, group.computed_collapses].map(|count| count.to_string()));
        if let Some(pairs) = &group.pairs {
            let counts = pairs.collapses;
            cells.extend([counts.both, counts.measured_only + counts.computed_only].map(|count| count.to_string()));
        }
        cells
    });
    Ok(writeln!(out, "\n{}", Table::new(header, rows))?)
}

fn dash() -> String {
    NONE.to_owned()
}

/// Three significant digits or so.
fn digits(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-3 { format!("{value:.1e}") } else { format!("{value:.3}") }
}

/// A median, or what it is above.
fn median(known: Option<f64>, above: Option<f64>) -> String {
    above.map_or_else(|| or_dash(known), |above| format!(">{above:.4}"))
}

/// What is rounded to nothing has no sign.
fn without_sign_of_zero(text: String) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|byte| !(b'1'..=b'9').contains(&byte)) => rest.to_owned(),
        _ => text,
    }
}

fn or_dash(value: Option<f64>) -> String {
    value.map_or_else(dash, |value| without_sign_of_zero(format!("{value:.4}")))
}

fn signed(value: f64) -> String {
    match format!("{:+.0} %", 100.0 * value) {
        _ if value.is_infinite() => "∞".to_owned(),
        zero if zero == "-0 %" => "+0 %".to_owned(),
        text => text,
    }
}

fn band(band: Option<Quantiles>, shown: impl Fn(f64) -> String) -> String {
    band.map_or_else(dash, |band| format!("{} … {}", shown(band.q05), shown(band.q95)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_rounded_to_nothing_has_no_sign_and_a_bound_says_so() {
        assert_eq!(or_dash(Some(-1e-6)), "0.0000");
        assert_eq!(or_dash(Some(-0.5)), "-0.5000");
        assert_eq!([signed(-1e-6), signed(-0.02), signed(f64::INFINITY)], ["+0 %", "-2 %", "∞"]);
        assert_eq!(
            [median(None, Some(0.08)), median(Some(0.08), None), median(None, None)],
            [">0.0800", "0.0800", "-"]
        );
    }
}
