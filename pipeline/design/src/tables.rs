//! Collapse fragility and risk as CSV.

mod uncertain;

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_job::table::write_table;
use uplift_spectra::Noisy;
use uplift_uniform_risk::EventRisk;

use super::certainty::Bands;
use super::overturning::{CollapseReport, OverturningReport};
use super::uncertain::{UncertainFinding, UncertaintyReport};
use crate::error::DesignError;

/// Names of the percentiles of what is not known exactly, in their order.
pub(super) const PERCENTILES: [&str; 5] = ["p05", "p16", "p50", "p84", "p95"];

/// The table of risks beside that of the fragility.
pub(super) fn risk_path(fragility: &Path) -> PathBuf {
    fragility.with_extension("risk.csv")
}

/// Writes the fragility to `path`, and the risk beside it.
pub(super) fn write_tables(path: &Path, report: &OverturningReport) -> Result<(), DesignError> {
    let line = format!(
        "uplift {} ({}); overturning of {} ({}); result {}; records: {}",
        uplift_job::VERSION,
        uplift_job::COMMIT,
        report.structure.name,
        report.structure.kind,
        report.source.result.display(),
        report.source.record_set
    )
    .replace(['\n', '\r'], " ");
    write_table(path, &line, fragility(report))?;
    Ok(write_table(&risk_path(path), &line, risk(report))?)
}

/// A row a measure, model and level.
fn fragility(report: &OverturningReport) -> Vec<Column> {
    let (mut im, mut unit, mut level, mut model, mut restitution) = (vec![], vec![], vec![], vec![], vec![]);
    let (mut overturned, mut records, mut share, mut fitted) = (vec![], vec![], vec![], vec![]);
    let (mut fewest, mut most) = (vec![], vec![]);
    // the rows of a measure follow each other, one a model
    for (found, of) in report.overturning.iter().zip(report.models.iter().cycle()) {
        let counts = found.overturned.iter().zip(&found.overturned_rounding);
        for (&at, (&count, &[least, greatest])) in found.levels.iter().zip(counts) {
            im.push(found.im);
            unit.push(found.unit);
            level.push(at);
            model.push(found.model);
            restitution.push(of.restitution);
            overturned.push(count);
            fewest.push(least);
            most.push(greatest);
            records.push(found.records);
            share.push(f64::from(count) / f64::from(found.records));
            fitted.push(found.fit.map(|fit| fit.fragility.probability(at)));
        }
    }
    vec![
        Column::new("im".into(), im),
        Column::new("unit".into(), unit),
        Column::new("level".into(), level),
        Column::new("model".into(), model),
        Column::new("restitution".into(), restitution),
        Column::new("overturned".into(), overturned),
        Column::new("records".into(), records),
        Column::new("share".into(), share),
        Column::new("lognormal".into(), fitted),
        Column::new("overturned_rounding_lowest".into(), fewest),
        Column::new("overturned_rounding_highest".into(), most),
    ]
}

/// A row a site, measure and model.
fn risk(report: &OverturningReport) -> Vec<Column> {
    let sites = report.overturning.first().map_or(0, |found| found.sites.len());
    let rows: Vec<(usize, &CollapseReport)> =
        (0..sites).flat_map(|site| report.overturning.iter().map(move |found| (site, found))).collect();
    let name: Vec<&str> = rows.iter().map(|(site, found)| found.sites[*site].site.as_str()).collect();
    let text = |value: fn(&CollapseReport) -> &'static str| -> Vec<&'static str> {
        rows.iter().map(|(_, found)| value(found)).collect()
    };
    let of_fit = |value: fn(&CollapseReport) -> Option<f64>| -> Vec<Option<f64>> {
        rows.iter().map(|(_, found)| value(found)).collect()
    };
    let of = |value: fn(&EventRisk) -> f64| -> Vec<f64> {
        rows.iter().map(|(site, found)| value(&found.sites[*site].risk)).collect()
    };
    let rounding = |end: fn(&Noisy) -> f64| -> Vec<f64> {
        rows.iter().map(|(site, found)| end(&found.sites[*site].per_year_rounding)).collect()
    };
    let bound: Vec<Option<f64>> = rows.iter().map(|(site, found)| found.sites[*site].risk.at_most_per_year).collect();
    let repaired: Vec<Option<f64>> =
        rows.iter().map(|(site, found)| found.sites[*site].repaired.map(|risk| risk.per_year)).collect();
    let by_fit: Vec<Option<f64>> = rows.iter().map(|(site, found)| found.sites[*site].lognormal_per_year).collect();
    let mut columns = vec![
        Column::new("site".into(), name),
        Column::new("im".into(), text(|found| found.im)),
        Column::new("model".into(), text(|found| found.model)),
        Column::new("maf_per_year".into(), of(|risk| risk.per_year)),
        // where no run overturns, the frequency that it has at most: a count of none is no proof of never
        Column::new("at_most_per_year".into(), bound),
        Column::new("years".into(), vec![report.years; rows.len()]),
        Column::new("probability".into(), of(|risk| risk.probability)),
        Column::new("lower_tail_share".into(), of(|risk| risk.lower_tail_share)),
        Column::new("upper_tail_share".into(), of(|risk| risk.upper_tail_share)),
        Column::new("theta".into(), of_fit(|found| found.theta)),
        Column::new("beta".into(), of_fit(|found| found.beta)),
        Column::new("maf_lognormal_per_year".into(), by_fit),
        Column::new("maf_rounding_lowest_per_year".into(), rounding(|of| of.lowest)),
        Column::new("maf_rounding_highest_per_year".into(), rounding(|of| of.highest)),
    ];
    if repaired.iter().any(Option::is_some) {
        columns.push(Column::new("maf_consistent_per_year".into(), repaired));
    }
    for (place, whose) in Bands::WHOSE.into_iter().enumerate() {
        let limits = rows.iter().map(|(site, found)| found.sites[*site].bands?.each()[place]).collect::<Vec<_>>();
        add_limits(&mut columns, &format!("maf_{whose}"), &limits);
    }
    if let Some(uncertainty) = &report.uncertainty {
        let found: Vec<_> = rows.iter().map(|(site, row)| found_of(uncertainty, (*site, row))).collect();
        columns.extend(uncertain::columns(uncertainty, &found));
    }
    columns
}

/// Adds the limits of a band of frequencies; no columns of one that is never told.
fn add_limits(columns: &mut Vec<Column>, name: &str, limits: &[Option<[f64; 2]>]) {
    if limits.iter().all(Option::is_none) {
        return;
    }
    for (place, end) in ["lower", "upper"].into_iter().enumerate() {
        let values: Vec<Option<f64>> = limits.iter().map(|limits| Some((*limits)?[place])).collect();
        columns.push(Column::new(format!("{name}_{end}_per_year").into(), values));
    }
}

/// What `report` finds in a row of the risks; none for the block, which takes no account of what is not known.
fn found_of<'a>(report: &'a UncertaintyReport, (place, row): (usize, &CollapseReport)) -> Option<&'a UncertainFinding> {
    let is_of_row = |site: &str, im: &str| site == row.sites[place].site && im == row.im;
    report
        .results
        .iter()
        .find(|result| row.model == "oscillator" && is_of_row(&result.site, result.im))
        .map(|of| &of.found)
}
