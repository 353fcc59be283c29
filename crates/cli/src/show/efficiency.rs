//! Which intensity measure to trust, in tables and in words.

use std::io::Write;

use uplift::efficiency::{EfficiencyReport, EfficiencyRow, Miss, Trend};
use uplift::text::{Table, nearest};
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
        const DISPLACEMENT: fn(&EfficiencyRow) -> f64 = |row| row.dispersion_level;
        const INITIATION: fn(&EfficiencyRow) -> f64 = |row| row.dispersion_initiation;
        let told = self.rows().find(|row| row.is_told());
        let own = self.by_scatter(DISPLACEMENT, |rows| !rows[0].is_told());
        if let [(best, _), others @ ..] = &own[..]
            && !others.is_empty()
        {
            let result = typed_path(&self.report.stored.path);
            let names: Vec<&str> = others.iter().map(|(row, _)| row.im).collect();
            let scatter: Vec<String> = own.iter().map(|(_, mean)| number(*mean, 2)).collect();
            let less = self.strengths_of_less_scatter(best, names[0], DISPLACEMENT);
            let less = if less.is_empty() { String::new() } else { format!("; not at strength {}", less.join(", ")) };
            write!(out, "{} scatters less than {} ({}{less})", best.im, names.join(" and "), scatter.join(", "))?;
            let measure = best.im.parse().map(IntensityMeasure::key).unwrap_or_default();
            let remedy = match &best.misses {
                None => format!("Use: uplift spectrum {result} --measure {measure}"),
                Some(Miss { other, site, times, is_tried, is_repaired, .. }) => {
                    write!(out, ", but its records miss the site's hazard: {times} times the {other} of {site}")?;
                    match (is_repaired, is_tried) {
                        (true, _) => format!("Use: uplift spectrum {result} --repaired --measure {measure}"),
                        (false, true) => format!("See why: uplift consistency {result} --details"),
                        (false, false) => format!("Repair: uplift consistency {result} --repair"),
                    }
                }
            };
            writeln!(out, "\n{remedy}")?;
        }
        if let Some(told) = told {
            writeln!(out, "+ has no hazard curve in this study: from the runs scaled to {}", told.scaled_to)?;
        }
        let least = [("displacement", DISPLACEMENT), ("initiation", INITIATION)].map(|(what, of)| {
            match self.by_scatter(of, |_| true).first() {
                Some((row, mean)) => format!("{what} {} ({})", label(row), number(*mean, 2)),
                None => format!("{what} not known from these stripes"),
            }
        });
        writeln!(out, "Least scatter of all {}: {}", self.measures.len(), least.join(", "))?;
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
            .right("scatter, displacement", |rows| number(self.mean(rows, DISPLACEMENT), 2))
            .right("scatter, initiation", |rows| number(self.mean(rows, INITIATION), 2))
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

    /// The mean of a scatter at the strengths shown; NaN where it is known at none.
    fn mean(&self, rows: &[EfficiencyRow], of: fn(&EfficiencyRow) -> f64) -> f64 {
        let known: Vec<f64> =
            self.strengths.iter().map(|&at| of(&rows[at])).filter(|value| value.is_finite()).collect();
        known.iter().sum::<f64>() / known.len() as f64
    }

    /// The strengths shown at which the measure called `other` scatters less than the `best`.
    fn strengths_of_less_scatter(
        &self,
        best: &EfficiencyRow,
        other: &str,
        of: fn(&EfficiencyRow) -> f64,
    ) -> Vec<String> {
        let rows = |im: &str| self.measures.iter().find(|rows| rows[0].im == im && !rows[0].is_told());
        let (Some(best), Some(other)) = (rows(best.im), rows(other)) else { return Vec::new() };
        let less = self.strengths.iter().filter(|&&at| of(&other[at]) < of(&best[at]));
        less.map(|&at| self.report.stored.strengths[at].to_string()).collect()
    }

    /// The measures that are `wanted` and whose mean scatter is known, the least first.
    fn by_scatter(
        &self,
        of: fn(&EfficiencyRow) -> f64,
        wanted: impl Fn(&[EfficiencyRow]) -> bool,
    ) -> Vec<(&EfficiencyRow, f64)> {
        let wanted = self.measures.iter().filter(|rows| wanted(rows));
        let mut found: Vec<(&EfficiencyRow, f64)> = wanted.map(|rows| (&rows[0], self.mean(rows, of))).collect();
        found.retain(|(_, mean)| mean.is_finite());
        found.sort_by(|(_, a), (_, b)| a.total_cmp(b));
        found
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
