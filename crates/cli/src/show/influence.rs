//! Which records carry the spectra, and which intensities make the risk.

use std::io::Write;

use uplift::influence::InfluenceReport;
use uplift::text::{metres, risk_in_words, spectrum_words, table};

use super::shown_path;
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The report for people; a quiet terminal gets the tables alone.
pub(crate) fn print_influence(report: &InfluenceReport, terminal: &Terminal) -> Result<(), CommandError> {
    let out = &mut output();
    let name = risk_in_words(report.poe, report.years);
    print_records(out, report, &name)?;
    print_intensities(out, report, &name)?;
    if !terminal.is_quiet() {
        writeln!(out, "\nAll of it: /influence and /disaggregation in {}", shown_path(&report.result).display())?;
        writeln!(out, "           {}", shown_path(&report.table).display())?;
    }
    Ok(())
}

/// The measure of a spectrum, and whether it is repaired.
type Spectrum<'a> = (&'a str, bool);

/// The site of a row where it is not that of the row above: rows follow each other by measure, then by site.
fn shown_site<'a>(above: &mut Option<(Spectrum<'a>, &'a str)>, of: Spectrum<'a>, site: &'a str) -> String {
    let same = above.replace((of, site)) == Some((of, site));
    if same { String::new() } else { site.to_owned() }
}

fn print_records(out: &mut impl Write, report: &InfluenceReport, name: &str) -> Result<(), CommandError> {
    writeln!(
        out,
        "\nRecords that carry the spectra of {name}: change of the ordinates without the record, per cent,\n\
         on average over the strengths that rock, and at most"
    )?;
    let mut above = None;
    let of_poe = report.records.iter().filter(|row| row.poe.to_bits() == report.poe.to_bits());
    let rows: Vec<Vec<String>> = of_poe
        .map(|row| {
            vec![
                shown_site(&mut above, (row.im, row.repaired), &row.site),
                spectrum_words(row.im, row.repaired),
                row.record.clone(),
                format!("{:+.1}", row.mean_change_pct),
                format!("{:+.0}", row.largest_change_pct),
                format!("{:.3}", row.at_strength),
            ]
        })
        .collect();
    if rows.is_empty() {
        writeln!(out, "none: the set has one record, or nothing rocks")?;
        return Ok(());
    }
    writeln!(out, "{}", table(&["site", "im", "record", "average", "at most", "at strength"], &rows))?;
    Ok(())
}

fn print_intensities(out: &mut impl Write, report: &InfluenceReport, name: &str) -> Result<(), CommandError> {
    writeln!(
        out,
        "\nIntensities that make the risk of {name}: levels below which 5, 50 and 95 % of it lie, and its shares \
         outside the stripes"
    )?;
    let level = |level: f64| if level.is_nan() { "-".to_owned() } else { format!("{level:.3}") };
    let percent = |share: f64| if share.is_nan() { "-".to_owned() } else { format!("{:.1} %", 100.0 * share) };
    let mut above = None;
    let rows: Vec<Vec<String>> = report
        .intensities
        .iter()
        .map(|row| {
            vec![
                shown_site(&mut above, (row.im, row.repaired), &row.site),
                format!("{}, {}", spectrum_words(row.im, row.repaired), row.unit),
                format!("{:.3}", row.strength),
                metres(row.u_m),
                level(row.level_05),
                level(row.level_50),
                level(row.level_95),
                percent(row.share_below_stripes),
                percent(row.share_above_stripes),
            ]
        })
        .collect();
    let header = ["site", "im", "strength", "u, m", "5 %", "50 %", "95 %", "below", "above"];
    writeln!(out, "{}", table(&header, &rows))?;
    Ok(())
}
