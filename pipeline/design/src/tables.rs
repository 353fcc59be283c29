//! Collapse fragility and risk as CSV.

mod uncertain;

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_ida::OSCILLATOR;
use uplift_job::outputs;
use uplift_job::table::{ColumnsOf, write_table};

use super::certainty::Bands;
use super::overturning::{CollapseReport, OverturningReport, SiteRisk};
use super::uncertain::{UncertainFinding, UncertaintyReport};
use crate::error::DesignError;
use crate::risk_columns::{FREQUENCIES, TAIL_SHARES};
use uncertain::add_limits;

/// The table of risks beside that of the fragility.
pub(super) fn risk_path(fragility: &Path) -> PathBuf {
    fragility.with_extension("risk.csv")
}

/// Writes the fragility to `path`, and the risk beside it.
pub(super) fn write_tables(path: &Path, report: &OverturningReport) -> Result<(), DesignError> {
    let line = outputs::marked(format_args!(
        "overturning of {} ({}); result {}; records: {}",
        report.structure.name,
        report.structure.kind,
        report.source.result.display(),
        report.source.record_set
    ));
    write_table(path, &line, fragility(report))?;
    Ok(write_table(&risk_path(path), &line, risk(report))?)
}

/// A row a measure, model and level.
fn fragility(report: &OverturningReport) -> Vec<Column> {
    // the rows of a measure follow each other, one a model
    let of_models = report.overturning.iter().zip(report.models.iter().cycle());
    let rows = of_models.flat_map(|(found, of)| (0..found.levels.len()).map(move |at| (found, of.restitution, at)));
    let rounding = |found: &CollapseReport, at: usize, end: usize| Some(found.overturned_rounding.as_ref()?[at][end]);
    ColumnsOf::new(rows)
        .with("im", |(found, ..)| found.im)
        .with("unit", |(found, ..)| found.unit)
        .with("level", |(found, _, at)| found.levels[at])
        .with("model", |(found, ..)| found.model)
        .with("restitution", |(_, restitution, _)| restitution)
        .with("overturned", |(found, _, at)| found.overturned[at])
        .with("records", |(found, ..)| found.records)
        .with("share", |(found, _, at)| f64::from(found.overturned[at]) / f64::from(found.records))
        .with("lognormal", |(found, _, at)| found.fit.map(|fit| fit.fragility.probability(found.levels[at])))
        .with("overturned_rounding_lowest", |(found, _, at)| rounding(found, at, 0))
        .with("overturned_rounding_highest", |(found, _, at)| rounding(found, at, 1))
        .build()
}

/// A row a site, measure and model.
fn risk(report: &OverturningReport) -> Vec<Column> {
    let rows: Vec<(&SiteRisk, &CollapseReport, usize)> = report.by_site().collect();
    let mut columns = ColumnsOf::new(rows.iter().copied())
        .with("site", |(site, ..)| site.site.as_str())
        .with("im", |(_, found, _)| found.im)
        .with("model", |(_, found, _)| found.model)
        .each(FREQUENCIES, |columns, (name, of)| columns.with(name, |(site, ..)| of(&site.risk)))
        .with("years", |_| report.years)
        .with("probability", |(site, ..)| site.risk.probability)
        .each(TAIL_SHARES, |columns, (name, of)| columns.with(name, |(site, ..)| of(&site.risk)))
        .with("theta", |(_, found, _)| found.theta)
        .with("beta", |(_, found, _)| found.beta)
        .with("maf_lognormal_per_year", |(site, ..)| site.lognormal_per_year)
        .with("maf_rounding_lowest_per_year", |(site, ..)| Some(site.per_year_rounding?.lowest))
        .with("maf_rounding_highest_per_year", |(site, ..)| Some(site.per_year_rounding?.highest));
    if rows.iter().any(|(site, ..)| site.repaired.is_some()) {
        columns = columns.with("maf_consistent_per_year", |(site, ..)| site.repaired.map(|risk| risk.per_year));
    }
    if let Some(limit) = report.limit {
        columns = columns
            .with("limit_m", |_| limit.displacement_m)
            .with("maf_beyond_limit_per_year", |(site, ..)| site.beyond_limit.map(|beyond| beyond.risk.per_year));
    }
    let mut columns = columns.build();
    let mut add = |name: &str, bands: &dyn Fn(&SiteRisk) -> Option<Bands>| {
        for (place, whose) in Bands::WHOSE.into_iter().enumerate() {
            let limits = rows.iter().map(|(site, ..)| bands(site)?.each()[place]).collect::<Vec<_>>();
            add_limits(&mut columns, &format!("{name}_{whose}"), &limits);
        }
    };
    add("maf", &|site| site.bands);
    add("maf_lognormal", &|site| site.lognormal_bands);
    add("maf_beyond_limit", &|site| site.beyond_limit?.bands);
    if let Some(uncertainty) = &report.uncertainty {
        let found: Vec<_> = rows.iter().map(|(_, row, place)| found_of(uncertainty, (*place, row))).collect();
        columns.extend(uncertain::columns(uncertainty, &found));
    }
    columns
}

/// What `report` finds in a row of the risks; none for the block, which takes no account of what is not known.
fn found_of<'a>(report: &'a UncertaintyReport, (place, row): (usize, &CollapseReport)) -> Option<&'a UncertainFinding> {
    let is_of_row = |site: &str, im: &str| site == row.sites[place].site && im == row.im;
    report
        .results
        .iter()
        .find(|result| row.model == OSCILLATOR && is_of_row(&result.site, result.im))
        .map(|of| &of.found)
}
