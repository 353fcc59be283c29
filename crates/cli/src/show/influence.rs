//! Which records carry the spectra, and which intensities make the risk.

use std::io::Write;

use uplift::influence::{InfluenceReport, IntensityShares};
use uplift::text::{Table, risk_in_words, spectrum_words, two_digits};

use super::alarms::print_synthetic;
use super::{print_more, shown_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// The worst record and the intensities of each site by the first measure; in detail all of them. A quiet terminal gets
/// the tables alone.
pub(crate) fn print_influence(report: &InfluenceReport, terminal: &Terminal) -> Result<(), CommandError> {
    let out = &mut output();
    print_records(out, report, terminal)?;
    print_intensities(out, report, terminal)?;
    print_synthetic(out, report.synthetic, terminal)?;
    if !terminal.is_quiet() {
        print_more(out, terminal)?;
        writeln!(out, "\nResult   /influence and /disaggregation in {}", shown_path(&report.result).display())?;
        writeln!(out, "Table    {}", shown_path(&report.table).display())?;
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

/// Of rows that follow each other by measure and site, one a site by the first measure, `pick`ed of so many; all of
/// them in detail.
fn shown<'a, R>(
    rows: Vec<&'a R>,
    spectrum: fn(&R) -> Spectrum<'_>,
    site: fn(&R) -> &str,
    (pick, terminal): (fn(usize) -> usize, &Terminal),
) -> Vec<&'a R> {
    if terminal.shows_details() {
        return rows;
    }
    let of_site = |a: &&R, b: &&R| spectrum(a) == spectrum(b) && site(a) == site(b);
    let of_sites = rows.chunk_by(of_site).map(|of_site| of_site[pick(of_site.len())]);
    of_sites.filter(|row| spectrum(row) == spectrum(rows[0])).collect()
}

fn print_records(out: &mut impl Write, report: &InfluenceReport, terminal: &Terminal) -> Result<(), CommandError> {
    let of_poe = report.records.iter().filter(|row| row.poe.to_bits() == report.poe.to_bits());
    // the one of the largest influence is the first
    let rows = shown(of_poe.collect(), |row| (row.im, row.repaired), |row| &row.site, (|_| 0, terminal));
    writeln!(
        out,
        "Change of the displacement if the most influential record is left out, per cent, {}",
        risk_in_words(report.poe, report.years)
    )?;
    let mut above = None;
    let table = Table::from_rows(rows)
        .left("site", |row| shown_site(&mut above, (row.im, row.repaired), &row.site))
        .right("im", |row| spectrum_words(row.im, row.repaired))
        .right("record", |row| &row.record)
        .right("average", |row| format!("{:+.1}", row.mean_change_pct))
        .each(report.records.first(), |table, first| {
            table.right(format!("at {:.3}", first.strength), |row| {
                if row.change_pct.is_finite() { format!("{:+.1}", row.change_pct) } else { "none".to_owned() }
            })
        })
        .right("largest (strength)", |row| format!("{:+.0} ({:.3})", row.largest_change_pct, row.at_strength));
    if table.is_empty() {
        writeln!(out, "none: the set has one record, or nothing rocks")?;
        return Ok(());
    }
    writeln!(out, "{table}")?;
    Ok(())
}

fn print_intensities(out: &mut impl Write, report: &InfluenceReport, terminal: &Terminal) -> Result<(), CommandError> {
    // of the strengths that were looked at the middle one
    let rows = shown(
        report.intensities.iter().collect(),
        |row| (row.im, row.repaired),
        |row| &row.site,
        (|strengths| strengths / 2, terminal),
    );
    writeln!(
        out,
        "\nIntensities below which 5, 50 and 95 % of the risk lie, and the share outside the analysed levels"
    )?;
    // a level outside the stripes is known to be no more than that
    let outside = |row: &IntensityShares, share: f64, value: f64| match two_digits(value) {
        text if row.share_above_stripes > 1.0 - share => format!("> {text}"),
        text if row.share_below_stripes > share => format!("< {text}"),
        text => text,
    };
    let percent = |share: f64| if share.is_nan() { "-".to_owned() } else { format!("{:.1} %", 100.0 * share) };
    let mut above = None;
    let table = Table::from_rows(rows)
        .left("site", |row| shown_site(&mut above, (row.im, row.repaired), &row.site))
        .right("im", |row| format!("{}, {}", spectrum_words(row.im, row.repaired), row.unit))
        .right("strength", |row| format!("{:.3}", row.strength))
        .right("u, m", |row| two_digits(row.u_m))
        .right("5 %", |row| outside(row, 0.05, row.level_05))
        .right("50 %", |row| outside(row, 0.5, row.level_50))
        .right("95 %", |row| outside(row, 0.95, row.level_95))
        .right("below", |row| percent(row.share_below_stripes))
        .right("above", |row| percent(row.share_above_stripes));
    writeln!(out, "{table}")?;
    Ok(())
}
