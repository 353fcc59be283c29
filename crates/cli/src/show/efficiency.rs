//! Which intensity measure to trust, in tables and in words.

use std::io::Write;

use uplift::efficiency::{EfficiencyReport, EfficiencyRow, Trend};
use uplift::text::{nearest, table};

use super::shown_path;
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// Strengths shown.
const SHOWN_STRENGTHS: [f64; 5] = [0.05, 0.1, 0.2, 0.4, 0.8];
/// Below this a slope is hardly chance.
const SIGNIFICANT: f64 = 0.05;

/// The report for people; a quiet terminal gets the tables alone.
pub(crate) fn print_efficiency(report: &EfficiencyReport, terminal: &Terminal) -> Result<(), CommandError> {
    let out = &mut output();
    let shown = nearest(&report.strengths, &SHOWN_STRENGTHS);
    let measures: Vec<&[EfficiencyRow]> = report.rows.chunks(report.strengths.len()).collect();
    print_scatter(out, report, &measures, &shown)?;
    print_trends(out, report, &measures, &shown)?;
    if !terminal.is_quiet() {
        print_reading(out, report, &measures, &shown)?;
        writeln!(out, "\nAll of it: /efficiency and /sufficiency in {}", shown_path(&report.result).display())?;
        writeln!(out, "           {}", shown_path(&report.table).display())?;
    }
    Ok(())
}

fn number(value: f64, digits: usize) -> String {
    if value.is_finite() { format!("{value:.digits$}") } else { "-".to_owned() }
}

fn print_scatter(
    out: &mut impl Write,
    report: &EfficiencyReport,
    measures: &[&[EfficiencyRow]],
    shown: &[usize],
) -> Result<(), CommandError> {
    writeln!(
        out,
        "\nEfficiency: scatter (logarithmic) of the displacement at a given level once the structure rocks, of the \
         level at which it\nbegins to rock, and the stripes whose scatter does not exist because too many runs overturn"
    )?;
    let mut header = vec!["strength".to_owned()];
    for rows in measures {
        header.extend([format!("{} rocking", rows[0].im), "initiation".to_owned(), "undefined".to_owned()]);
    }
    let rows: Vec<Vec<String>> = shown
        .iter()
        .map(|&index| {
            let mut cells = vec![format!("{:.3}", report.strengths[index])];
            for row in measures.iter().map(|rows| &rows[index]) {
                cells.push(number(row.dispersion_rocking, 2));
                cells.push(number(row.dispersion_initiation, 3));
                cells.push(format!("{} %", number(100.0 * row.undefined_share, 0)));
            }
            cells
        })
        .collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    writeln!(out, "{}", table(&header, &rows))?;
    Ok(())
}

fn print_trends(
    out: &mut impl Write,
    report: &EfficiencyReport,
    measures: &[&[EfficiencyRow]],
    shown: &[usize],
) -> Result<(), CommandError> {
    writeln!(
        out,
        "\nSufficiency: p-value of the trend of a record's mean residual with what the record is (below \
         {SIGNIFICANT}, marked *: the measure\nleaves something out), one observation a record"
    )?;
    if report.covariates.is_empty() {
        writeln!(out, "nothing is known of the records: give magnitude and rrup_km in the manifest")?;
        return Ok(());
    }
    let mut header = vec!["strength".to_owned()];
    for rows in measures {
        header.extend(report.covariates.iter().map(|covariate| format!("{} {covariate}", rows[0].im)));
    }
    let rows: Vec<Vec<String>> = shown
        .iter()
        .map(|&index| {
            let mut cells = vec![format!("{:.3}", report.strengths[index])];
            for row in measures.iter().map(|rows| &rows[index]) {
                cells.extend(report.covariates.iter().map(|covariate| p_value(&row.trends[covariate])));
            }
            cells
        })
        .collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    writeln!(out, "{}", table(&header, &rows))?;
    Ok(())
}

fn p_value(trend: &Trend) -> String {
    trend.p_value.map_or_else(
        || "-  ".to_owned(),
        |p_value| {
            let mark = if p_value < SIGNIFICANT { '*' } else { ' ' };
            let shown = if p_value < 0.001 { "<0.001".to_owned() } else { format!("{p_value:.3}") };
            format!("{shown} {mark}")
        },
    )
}

fn print_reading(
    out: &mut impl Write,
    report: &EfficiencyReport,
    measures: &[&[EfficiencyRow]],
    shown: &[usize],
) -> Result<(), CommandError> {
    writeln!(out, "\nIn words:")?;
    if let [first, second] = measures {
        for (what, rocking) in [("the displacement of a rocking structure", true), ("the onset of rocking", false)] {
            let of = |row: &EfficiencyRow| if rocking { row.dispersion_rocking } else { row.dispersion_initiation };
            let wins: Vec<bool> = shown
                .iter()
                .map(|&index| (of(&first[index]), of(&second[index])))
                .filter(|(first, second)| first.is_finite() && second.is_finite())
                .map(|(first, second)| first < second)
                .collect();
            let count = wins.iter().filter(|&&win| win).count();
            let (a, b) = (first[0].im, second[0].im);
            let said = match count {
                _ if wins.is_empty() => format!("for {what} the stripes do not tell which is more efficient"),
                all if all == wins.len() => format!("{a} is the more efficient for {what}, at every strength shown"),
                0 => format!("{b} is the more efficient for {what}, at every strength shown"),
                some => format!(
                    "{a} is the more efficient for {what} at {some} of the {} strengths shown, {b} at the others",
                    wins.len()
                ),
            };
            writeln!(out, "  {said}")?;
        }
    }
    writeln!(
        out,
        "  a measure serves a risk analysis only if hazard curves of it can be had: for PGV and PGA ground motion \
         models and maps exist"
    )?;
    if report.records < 30 {
        writeln!(out, "  with {} records a p-value finds only strong trends", report.records)?;
    }
    Ok(())
}
