//! Whether the record set has the site's hazard.

use uplift::result::StoredConsistency;
use uplift::text::{Table, risk_name};

use super::TitledTable;
use crate::figures::FigureSource;

/// The levels of the measure that records are not scaled to; none where no site has hazard curves of two measures.
pub(super) fn consistency(source: &FigureSource) -> Option<TitledTable> {
    let all = &source.consistency;
    let is_repaired = all.iter().any(|of| of.u_m.is_some());
    let sites = 0..source.stored.sites.len();
    let looked_at = |of: &StoredConsistency, site: usize| of.rate_per_year.block([site]).iter().any(|r| !r.is_nan());
    let poes = all.first().map_or(&[][..], |of| &of.poes);
    let verdict = |of: &StoredConsistency, site: usize| match of.verdict[site].as_str() {
        "" => "no verdict".to_owned(),
        verdict => verdict.to_owned(),
    };
    let places = all.iter().zip(&source.least_effective).flat_map(|of| sites.clone().map(move |site| (of, site)));
    let table = Table::from_rows(places.filter(|&((of, _), site)| looked_at(of, site)))
        .left("site", |(_, site)| &source.stored.sites[site])
        .left("scaled to", |((of, _), _)| of.scaled_to.label())
        .left("compared", |((of, _), _)| of.other.label())
        .left("verdict", |((of, _), site)| verdict(of, site))
        .each(poes.iter().enumerate(), |table, (at, &poe)| {
            let heading = format!("ratio, {}", risk_name(poe, all[0].years));
            table.right(heading, |((of, _), site)| two_decimals(of.ratio.block([site])[at]))
        })
        .right("bias", |((of, _), site)| two_decimals(of.bias[site]))
        .right("largest |ln|", |((of, _), site)| two_decimals(of.max[site]))
        .when(is_repaired, |table| {
            table.right("effective records, least", |((_, least), site)| effective(least.as_deref(), site))
        });
    let repair = if is_repaired {
        "If inconsistent, use the repaired spectra or other records."
    } else {
        "If inconsistent, use other records or uplift consistency --repair."
    };
    let note = format!(
        "Level of the other measure in the scaled records over the site's; bias: mean over the rates compared. {repair}"
    );
    TitledTable::new("consistency-table", "Hazard consistency", note, table).unless_empty()
}

/// A ratio or a logarithm; a dash where there is none.
fn two_decimals(value: f64) -> String {
    if value.is_finite() { format!("{value:.2}") } else { "–".to_owned() }
}

/// The fewest effective records at a site after a repair.
fn effective(least: Option<&[f64]>, site: usize) -> String {
    match least.map(|least| least[site]) {
        Some(least) if least.is_finite() => format!("{least:.0}"),
        _ => "–".to_owned(),
    }
}
