//! Which intensity measure to trust, in tables and in words.

use std::io::Write;

use uplift::efficiency::{EfficiencyReport, EfficiencyRow, Miss, Trend};
use uplift::text::{Table, nearest, rounded};
use uplift_motion::IntensityMeasure;

use super::alarms::print_synthetic;
use super::{print_more, shown_path, typed_path};
use crate::error::CommandError;
use crate::terminal::{Terminal, output};

/// Strengths shown.
const SHOWN_STRENGTHS: [f64; 5] = [0.05, 0.1, 0.2, 0.4, 0.8];
/// Below this a slope is hardly chance.
const SIGNIFICANT: f64 = 0.05;

/// The report for people; a quiet terminal gets the tables alone.
pub(crate) fn print_efficiency(report: &EfficiencyReport, terminal: &Terminal) -> Result<(), CommandError> {
    let out = &mut output();
    let shown = nearest(&report.stored.strengths, &SHOWN_STRENGTHS);
    let measures: Vec<&[EfficiencyRow]> = report.rows.chunks(report.stored.strengths.len()).collect();
    let shown = Shown { report, measures, strengths: shown };
    shown.print_reading(out)?;
    if terminal.shows_details() {
        shown.print_scatter(out)?;
        shown.print_trends(out)?;
    }
    print_synthetic(out, report.stored.synthetic, terminal)?;
    if !terminal.is_quiet() {
        writeln!(out, "\nResult   /efficiency and /sufficiency in {}", shown_path(&report.stored.path).display())?;
        writeln!(out, "Table    {}", shown_path(&report.table).display())?;
    }
    print_more(out, terminal)
}

/// What is shown of a report: a row a measure, a column a strength.
struct Shown<'a> {
    report: &'a EfficiencyReport,
    /// The rows of each measure, `[measure][strength]`.
    measures: Vec<&'a [EfficiencyRow]>,
    /// Positions of the strengths shown.
    strengths: Vec<usize>,
}

fn number(value: f64, digits: usize) -> String {
    if value.is_finite() { format!("{value:.digits$}") } else { "-".to_owned() }
}

/// The name of the measure, marked where the study has no levels of it.
fn label(row: &EfficiencyRow) -> String {
    format!("{}{}", row.im, if row.is_told() { " +" } else { "" })
}

impl Shown<'_> {
    /// A table with a row a measure and a column a strength shown.
    fn table(&self, cell: impl Fn(&EfficiencyRow) -> String) -> Table {
        Table::from_rows(&self.measures)
            .left("measure", |rows| label(&rows[0]))
            .each(&self.strengths, |table, &at| {
                table.right(format!("{:.3}", self.report.stored.strengths[at]), |rows| cell(&rows[at]))
            })
            .build()
    }

    fn print_scatter(&self, out: &mut impl Write) -> Result<(), CommandError> {
        writeln!(
            out,
            "\nEfficiency: logarithmic scatter of the level that causes a displacement, and rank, by strength; the\n\
             median over displacements from uplift to the largest that all records reach"
        )?;
        let ranked = |row: &EfficiencyRow| match row.rank {
            Some(rank) => format!("{} ({rank})", number(row.dispersion_level, 2)),
            None => "-".to_owned(),
        };
        writeln!(out, "{}", self.table(ranked))?;
        writeln!(
            out,
            "\nScatter of the displacement at a given level once the structure rocks, over the levels at hand"
        )?;
        writeln!(out, "{}", self.table(|row| number(row.dispersion_rocking, 2)))?;
        let undefined = |row: &EfficiencyRow| format!("{} %", number(100.0 * row.undefined_share, 0));
        if self.rows().any(|row| row.undefined_share > 0.0) {
            writeln!(out, "\nStripes without a scatter, because too many runs overturn")?;
            writeln!(out, "{}", self.table(undefined))?;
        }
        writeln!(out, "\nScatter of the level at which it begins to rock")?;
        writeln!(out, "{}", self.table(|row| number(row.dispersion_initiation, 3)))?;
        if let Some(told) = self.rows().find(|row| row.is_told()) {
            writeln!(out, "+ from runs scaled to {}, at levels that all records reach", told.scaled_to)?;
        }
        Ok(())
    }

    /// The rows that are shown.
    fn rows(&self) -> impl Iterator<Item = &EfficiencyRow> {
        self.measures.iter().flat_map(|rows| self.strengths.iter().map(|&index| &rows[index]))
    }

    fn print_trends(&self, out: &mut impl Write) -> Result<(), CommandError> {
        writeln!(
            out,
            "\nSufficiency: p-value of the trend of a record's mean residual with what the record is (below \
             {SIGNIFICANT}, marked *: the measure\nleaves something out), one observation a record"
        )?;
        if self.report.covariates.is_empty() {
            writeln!(out, "the manifest has no properties of the records: add magnitude and rrup_km")?;
        }
        for covariate in &self.report.covariates {
            writeln!(out, "{covariate}\n{}", self.table(|row| p_value(&row.trends[covariate])))?;
        }
        Ok(())
    }

    fn print_reading(&self, out: &mut impl Write) -> Result<(), CommandError> {
        let own: Vec<&[EfficiencyRow]> = self.measures.iter().filter(|rows| !rows[0].is_told()).copied().collect();
        if let (2.., Some((name, measure, others))) = (own.len(), self.winner(&own, |row| row.dispersion_level)) {
            let result = typed_path(&self.report.stored.path);
            match own.iter().find_map(|rows| rows[0].misses.as_ref().filter(|_| rows[0].im == name)) {
                None => writeln!(out, "Use {name}{others}: uplift spectrum {result} --measure {measure}")?,
                Some(Miss { other, site, times, is_tried, is_repaired, .. }) => {
                    writeln!(
                        out,
                        "{name} scatters least, but its records miss the site's hazard: {times} times the {other} of \
                         {site}"
                    )?;
                    if *is_repaired {
                        writeln!(out, "Use: uplift spectrum {result} --repaired --measure {measure}")?;
                    } else if *is_tried {
                        writeln!(out, "See why: uplift consistency {result} --details")?;
                    } else {
                        writeln!(out, "Repair: uplift consistency {result} --repair")?;
                    }
                }
            }
        }
        if let Some(told) = self.rows().find(|row| row.is_told()) {
            writeln!(out, "+ has no hazard curve in this study: from the runs scaled to {}", told.scaled_to)?;
        }
        for (what, of) in [
            ("the displacement", (|row| row.dispersion_level) as fn(&EfficiencyRow) -> f64),
            ("initiation", |row| row.dispersion_initiation),
        ] {
            let best = self.winner(&self.measures, of).map(|(name, _, others)| name + &others);
            writeln!(out, "Best for {what}: {}", best.as_deref().unwrap_or("these stripes do not show it"))?;
        }
        let mean = |rows: &[EfficiencyRow], of: fn(&EfficiencyRow) -> f64| {
            let known: Vec<f64> =
                self.strengths.iter().map(|&at| of(&rows[at])).filter(|value| value.is_finite()).collect();
            number(known.iter().sum::<f64>() / known.len() as f64, 2)
        };
        let insufficient = |rows: &[EfficiencyRow]| {
            let is_trend = |&&at: &&usize, name: &str| {
                rows[at].trends.get(name).and_then(|of| of.p_value).is_some_and(|p| p < SIGNIFICANT)
            };
            let with = self.report.covariates.iter().filter(|name| self.strengths.iter().any(|at| is_trend(&at, name)));
            let names: Vec<&str> = with.map(|name| &**name).collect();
            if names.is_empty() { "none".to_owned() } else { names.join(", ") }
        };
        let table = Table::from_rows(&self.measures)
            .left("measure", |rows| label(&rows[0]))
            .right("scatter, displacement", |rows| mean(rows, |row| row.dispersion_level))
            .right("scatter, initiation", |rows| mean(rows, |row| row.dispersion_initiation))
            .right("trend with", |rows| insufficient(rows));
        writeln!(out, "\n{table}")?;
        if let Some(first) = self.report.stored.measures.first() {
            writeln!(out, "displacement: all measures in the runs scaled to {}", first.measure.label())?;
        }
        if self.report.stored.records.len() < 30 {
            writeln!(out, "With {} records only strong trends are found.", self.report.stored.records.len())?;
        }
        Ok(())
    }

    /// Which of `measures` scatters least at most of the strengths shown, its key, and the others that do at some.
    fn winner(&self, measures: &[&[EfficiencyRow]], of: fn(&EfficiencyRow) -> f64) -> Option<(String, String, String)> {
        let best = |&index: &usize| {
            let known = measures.iter().filter(|rows| of(&rows[index]).is_finite());
            known.min_by(|a, b| of(&a[index]).total_cmp(&of(&b[index]))).map(|rows| &rows[index])
        };
        let winners: Vec<&EfficiencyRow> = self.strengths.iter().filter_map(best).collect();
        let wins = |row: &EfficiencyRow| winners.iter().filter(|of| of.im == row.im).count();
        // of as many wins the first
        let first = winners.iter().rev().max_by_key(|row| wins(row))?;
        let others: Vec<String> = winners
            .chunk_by(|a, b| a.im == b.im)
            .filter(|of| of[0].im != first.im)
            .map(|of| {
                let strengths: Vec<String> = of.iter().map(|row| rounded(row.strength, 3).to_string()).collect();
                format!("{} at strength {}", label(of[0]), strengths.join(", "))
            })
            .collect();
        let key = first.im.parse().map(IntensityMeasure::key).unwrap_or_default();
        let others = if others.is_empty() { String::new() } else { format!(" ({})", others.join("; ")) };
        Some((label(first), key.to_owned(), others))
    }
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
