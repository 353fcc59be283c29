//! Tidy tables beside the result file, for spreadsheets and scripts.

use std::path::{Path, PathBuf};

use polars::prelude::Column;
use uplift_job::outputs::{Output, OutputKind, beside};
use uplift_job::table::write_table;
use uplift_result::flag_word;
use uplift_study::UniformRiskStudy;

use super::Outcome;
use super::site_table::site_table_paths;
use crate::error::StudiesError;

/// The tables beside the result file `result`: spectra and coefficients.
pub fn csv_paths(result: &Path) -> [PathBuf; 2] {
    ["urs.csv", "regression.csv"].map(|ending| beside(result, ending))
}

/// All files but the result that a run of `study` with the result at `result` writes.
pub fn tables(study: &UniformRiskStudy, result: &Path) -> Vec<Output> {
    let mut tables = Vec::new();
    if study.output.csv && !study.sites.is_empty() {
        let [spectra, coefficients] = csv_paths(result);
        tables.push(Output::new(spectra, OutputKind::Table("lower_tail_share")));
        tables.push(Output::new(coefficients, OutputKind::Table("rmse_plain_m")));
    }
    if study.site_table.is_some() {
        let [spectra, coefficients, map] = site_table_paths(result);
        tables.push(Output::new(spectra, OutputKind::Table("flag")));
        tables.push(Output::new(coefficients, OutputKind::Table("problem")));
        tables.push(Output::new(map, OutputKind::GeoJson));
    }
    tables
}

/// Write the tables of `outcome` beside the result file `result`, and beside each where it comes from.
///
/// # Errors
/// A file that cannot be written.
pub fn write_csv(result: &Path, outcome: &Outcome<'_>) -> Result<(), StudiesError> {
    let line = outcome.provenance.line(&outcome.study.title, &outcome.records.description);
    let [urs, regression] = csv_paths(result);
    write_table(&urs, &line, spectra_table(outcome))?;
    Ok(write_table(&regression, &line, regression_table(outcome))?)
}

fn spectra_table(outcome: &Outcome<'_>) -> Vec<Column> {
    let study = outcome.study;
    let (mut site, mut im, mut flag) = (Vec::new(), Vec::new(), Vec::new());
    let (mut poe, mut strength, mut u_m, mut lower, mut upper) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for spectra in outcome.spectra {
        for ([site_index, poe_index], spectrum) in spectra.ordinates.blocks() {
            for (ordinate, eta) in spectrum.iter().zip(study.strengths.iter()) {
                site.push(study.sites[site_index].name.as_str());
                im.push(spectra.measure.label());
                poe.push(study.risk.poe[poe_index]);
                strength.push(*eta);
                u_m.push(ordinate.displacement_m);
                flag.push(flag_word(ordinate.flag));
                // zero has no sign in a table
                lower.push(ordinate.lower_tail_share + 0.0);
                upper.push(ordinate.upper_tail_share + 0.0);
            }
        }
    }
    let years = vec![study.risk.years; site.len()];
    vec![
        Column::new("site".into(), site),
        Column::new("im".into(), im),
        Column::new("poe".into(), poe),
        Column::new("years".into(), years),
        Column::new("strength".into(), strength),
        Column::new("u_m".into(), u_m),
        Column::new("flag".into(), flag),
        Column::new("lower_tail_share".into(), lower),
        Column::new("upper_tail_share".into(), upper),
    ]
}

fn regression_table(outcome: &Outcome<'_>) -> Vec<Column> {
    let study = outcome.study;
    let (mut site, mut im, mut poe, mut fits) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for coefficients in outcome.coefficients {
        for ([site_index, poe_index], fit) in coefficients.fits.blocks() {
            site.push(study.sites[site_index].name.as_str());
            im.push(coefficients.measure.label());
            poe.push(study.risk.poe[poe_index]);
            fits.push(fit[0].as_ref().ok());
        }
    }
    let number = |value: fn(&uplift_regression::ExponentialFit) -> f64| -> Vec<Option<f64>> {
        fits.iter().map(|fit| fit.map(value)).collect()
    };
    let years = vec![study.risk.years; site.len()];
    let bound: Vec<Option<bool>> = fits.iter().map(|fit| fit.map(|fit| fit.bound_active)).collect();
    let points: Vec<u32> =
        fits.iter().map(|fit| fit.map_or(0, |fit| u32::try_from(fit.points).unwrap_or(u32::MAX))).collect();
    vec![
        Column::new("site".into(), site),
        Column::new("im".into(), im),
        Column::new("poe".into(), poe),
        Column::new("years".into(), years),
        Column::new("c0_m".into(), number(|fit| fit.c0)),
        Column::new("c1".into(), number(|fit| fit.c1)),
        Column::new("c2_m".into(), number(|fit| fit.c2)),
        Column::new("rmse_m".into(), number(|fit| fit.rmse)),
        Column::new("rmse_plain_m".into(), number(|fit| fit.rmse_plain)),
        Column::new("bound_active".into(), bound),
        Column::new("points".into(), points),
    ]
}
