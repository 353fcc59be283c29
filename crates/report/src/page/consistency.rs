//! Whether the record set brings the site's hazard, and what to do where it does not.

use uplift::result::StoredConsistency;
use uplift::text::{Table, risk_name};

use super::{Part, TitledTable};
use crate::figures::FigureSource;
use uplift_plot::Figure;

/// The part of the page with its `figures`; none where no site has hazard curves of two measures.
pub(super) fn part(source: &FigureSource, figures: Vec<Figure>) -> Option<Part> {
    (!source.consistency.is_empty()).then(|| Part {
        key: "record-set",
        title: "Does the record set bring the site's hazard",
        note: String::new(),
        tables: vec![table(source)],
        figures,
        details: Vec::new(),
    })
}

fn table(source: &FigureSource) -> TitledTable {
    let all = &source.consistency;
    let is_repaired = all.iter().any(|of| of.u_m.is_some());
    let sites = 0..source.stored.sites.len();
    let looked_at = |of: &StoredConsistency, site: usize| of.rate_per_year.block([site]).iter().any(|r| !r.is_nan());
    let poes = all.first().map_or(&[][..], |of| &of.poes);
    let verdict = |(of, site): (&StoredConsistency, usize)| match of.verdict[site].as_str() {
        "" => "no verdict".to_owned(),
        verdict => verdict.to_owned(),
    };
    let places = all.iter().flat_map(|of| sites.clone().map(move |site| (of, site)));
    let table = Table::of(places.filter(|&(of, site)| looked_at(of, site)))
        .left("site", |(_, site)| &source.stored.sites[site])
        .left("scaled to", |(of, _)| of.scaled_to.label())
        .left("shows", |(of, _)| of.other.label())
        .left("verdict", verdict)
        .each(poes.iter().enumerate(), |table, (at, &poe)| {
            let heading = format!("over the site's, {}", risk_name(poe, all[0].years));
            table.right(heading, |(of, site)| two_decimals(of.ratio.block([site])[at]))
        })
        .right("bias", |(of, site)| two_decimals(of.bias[site]))
        .right("largest |ln|", |(of, site)| two_decimals(of.max[site]))
        .when(is_repaired, |table| table.right("effective records, least", |(of, site)| effective(of, site)));
    let repair = if is_repaired {
        "There, use the spectra of weighted records that stand beside them, where the set could be weighted; few \
         effective records make them less sure, and records on the side that the set lacks are the better cure."
    } else {
        "There, ask for weighted records by uplift consistency --repair, or choose records that bring it."
    };
    let note = format!(
        "Level of the measure that records are not scaled to: what they bring over what the hazard curve of the site \
         says, at each risk and on average over the rates compared (bias), and the largest deviation of its \
         logarithm. Where the verdict is inconsistent the spectra are true of the records, and not of the site. \
         {repair}"
    );
    TitledTable::new("what-is-brought", "What the record set brings of the other measure", note, table)
}

/// A ratio or a logarithm; a dash where there is none.
fn two_decimals(value: f64) -> String {
    if value.is_finite() { format!("{value:.2}") } else { "–".to_owned() }
}

/// The fewest effective records at a site after a repair.
fn effective(of: &StoredConsistency, site: usize) -> String {
    match of.least_effective.as_ref().map(|least| least[site]) {
        Some(least) if least.is_finite() => format!("{least:.0}"),
        _ => "–".to_owned(),
    }
}
