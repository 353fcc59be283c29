//! Columns of a table of risks for a structure that is not known exactly.

use polars::prelude::Column;

use crate::certainty::Bands;
use crate::uncertain::{
    AleatoryResult, EpistemicResult, PERCENTILES, Spread, UncertainFinding, UncertaintyReport, VarianceShare,
};

/// What columns are made of.
type OfBranches = fn(&EpistemicResult) -> Spread;
type OfShare = fn(&VarianceShare) -> f64;

/// The columns that `report` adds to rows that follow each other so: `found` of each, none of a row that it is not of.
pub(super) fn columns(report: &UncertaintyReport, found: &[Option<&UncertainFinding>]) -> Vec<Column> {
    let kind: Vec<Option<&str>> = found.iter().map(|found| found.map(|_| report.kind)).collect();
    let mut columns = vec![Column::new("uncertainty".into(), kind)];
    let mut add = |name: String, of: &dyn Fn(&UncertainFinding) -> Option<f64>| {
        let values: Vec<Option<f64>> = found.iter().map(|found| found.and_then(of)).collect();
        columns.push(Column::new(name.into(), values));
    };
    add("maf_uncertain_per_year".to_owned(), &|found| Some(found.mean()));
    // where no run shows it, what it is at most: a count of none is no proof of never
    add("at_most_uncertain_per_year".to_owned(), &UncertainFinding::at_most_per_year);
    if report.kind == "aleatory" {
        let bands = |of: &AleatoryResult| [of.by_record, of.by_earthquake, of.with_hazard];
        for (place, whose) in Bands::WHOSE.into_iter().enumerate() {
            let limits: Vec<Option<[f64; 2]>> = found.iter().map(|found| bands((*found)?.aleatory()?)[place]).collect();
            add_limits(&mut columns, &format!("maf_uncertain_{whose}"), &limits);
        }
        return columns;
    }
    let spreads: [(&str, OfBranches); 2] = [("structure", |of| of.by_structure), ("all", |of| of.by_all)];
    for (whose, spread) in spreads {
        add(format!("maf_{whose}_mean_per_year"), &|found| Some(spread(found.epistemic()?).mean));
        for (place, name) in PERCENTILES.into_iter().enumerate() {
            let of = |found: &UncertainFinding| Some(spread(found.epistemic()?).percentiles[place]);
            add(format!("maf_{whose}_{name}_per_year"), &of);
        }
    }
    for factor in factors(found) {
        let numbers: [(&str, OfShare); 4] = [
            ("total_share", |of| of.total),
            ("total_share_error", |of| of.total_error),
            ("first_order_share", |of| of.first_order),
            ("first_order_share_error", |of| of.first_order_error),
        ];
        for (name, number) in numbers {
            let of = |found: &UncertainFinding| {
                found.epistemic()?.shares.iter().find(|share| share.factor == factor).map(number)
            };
            add(format!("{name}_{}", in_name(factor)), &of);
        }
    }
    columns
}

/// What variances are shared out among, each once, by name: the order of the shares is another in every row.
fn factors<'a>(found: &[Option<&'a UncertainFinding>]) -> Vec<&'a str> {
    let shares = found.iter().filter_map(|found| found.as_ref()?.epistemic()).flat_map(|of| &of.shares);
    let mut factors: Vec<&str> = shares.map(|share| share.factor.as_str()).collect();
    factors.sort_unstable();
    factors.dedup();
    factors
}

/// A factor as a part of the name of a column: `strength_and_capacity`, `records_by_earthquake`.
fn in_name(factor: &str) -> String {
    factor.replace(',', "").replace(' ', "_")
}

/// Adds the limits of a band of frequencies; no columns of one that is never told.
pub(super) fn add_limits(columns: &mut Vec<Column>, name: &str, limits: &[Option<[f64; 2]>]) {
    if limits.iter().all(Option::is_none) {
        return;
    }
    for (place, end) in ["lower", "upper"].into_iter().enumerate() {
        let values: Vec<Option<f64>> = limits.iter().map(|limits| Some((*limits)?[place])).collect();
        columns.push(Column::new(format!("{name}_{end}_per_year").into(), values));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_stand_in_names_that_need_no_quotes() {
        assert_eq!(in_name("records, by earthquake"), "records_by_earthquake");
        assert_eq!(in_name("strength and uplift displacement"), "strength_and_uplift_displacement");
    }
}
