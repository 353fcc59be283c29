//! What the repair adds to the table of coefficients of many sites.

use uplift_result::{BandKind, SITE_CONSISTENCY};

use super::layout::{cell, number};
use super::shape::{Shape, SiteValues};

/// Position of the verdict, a text, among the numbers of [`SITE_CONSISTENCY`].
const VERDICT: usize = 2;

/// The columns.
pub(super) fn columns() -> Vec<String> {
    let mut columns: Vec<String> = SITE_CONSISTENCY.quantities.iter().map(|own| own.name.to_owned()).collect();
    columns.insert(VERDICT, "verdict".to_owned());
    columns.extend(Shape::fits(BandKind::REPAIRED).map(|own| own.column()));
    columns.push("no_repair".to_owned());
    columns
}

/// The cells of the spectrum at a position among those of a site, which are of so many probabilities.
pub(super) fn cells(site: &SiteValues<'_>, at: usize, poes: usize) -> Vec<String> {
    let consistency = site.consistency[at / poes];
    let numbers = SITE_CONSISTENCY.quantities.iter().map(|own| number(own.number(consistency, 0)));
    let mut cells: Vec<String> = numbers.collect();
    cells.insert(VERDICT, consistency.verdict.to_owned());
    cells.extend(Shape::fits(BandKind::REPAIRED).map(|own| number(own.value(site, at, 0))));
    cells.push(cell(&site.no_repair[at]));
    cells
}
