//! Whether the record set brings the site's hazard, and what to do where it does not.

use uplift::result::StoredConsistency;
use uplift::text::risk_name;

use super::{Part, Table};
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

fn table(source: &FigureSource) -> Table {
    let all = &source.consistency;
    let is_repaired = all.iter().any(|of| of.u_m.is_some());
    let mut header = ["site", "scaled to", "shows", "verdict"].map(str::to_owned).to_vec();
    if let Some(of) = all.first() {
        let over = |&poe: &f64| format!("over the site's, {}", risk_name(poe, of.years));
        header.extend(of.poes.iter().map(over));
    }
    header.extend(["bias", "largest |ln|"].map(str::to_owned));
    if is_repaired {
        header.push("effective records, least".to_owned());
    }
    let row = |of: &StoredConsistency, site: usize| {
        let verdict = of.verdict[site].as_str();
        let mut row = vec![
            source.stored.sites[site].clone(),
            of.scaled_to.label().to_owned(),
            of.other.label().to_owned(),
            if verdict.is_empty() { "no verdict" } else { verdict }.to_owned(),
        ];
        row.extend(of.ratio.block([site]).iter().copied().chain([of.bias[site], of.max[site]]).map(two_decimals));
        if is_repaired {
            row.push(effective(of, site));
        }
        row
    };
    let sites = 0..source.stored.sites.len();
    let looked_at = |of: &StoredConsistency, site: usize| of.rate_per_year.block([site]).iter().any(|r| !r.is_nan());
    let rows = all.iter().flat_map(|of| {
        let row = &row;
        sites.clone().filter(move |&site| looked_at(of, site)).map(move |site| row(of, site))
    });
    let repair = if is_repaired {
        "There, use the spectra of weighted records that stand beside them, where the set could be weighted; few \
         effective records make them less sure, and records on the side that the set lacks are the better cure."
    } else {
        "There, ask for weighted records by uplift consistency --repair, or choose records that bring it."
    };
    Table {
        id: "what-is-brought".to_owned(),
        title: "What the record set brings of the other measure".to_owned(),
        note: format!(
            "Level of the measure that records are not scaled to: what they bring over what the hazard curve of the \
             site says, at each risk and on average over the rates compared (bias), and the \
             largest deviation of its logarithm. Where the verdict is inconsistent the spectra are true of the \
             records, and not of the site. {repair}"
        ),
        group: String::new(),
        header,
        text_columns: 4,
        rows: rows.collect(),
    }
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
