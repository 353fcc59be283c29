//! What the report shows of uniform risk spectra.

use uplift::UpliftError;
use uplift::influence::{level_of_share, rank_records};
use uplift::result::{MeasureSpectra, ResultFile, StoredSpectra};
use uplift::text::{Table, TableOf, kind_of_risks, metres, nearest, risk_in_words, risk_name, two_digits};
use uplift::uniform_risk::BandOf;

use super::consistency::consistency;
use super::displacements::{Kind, Row, rows};
use super::{Content, Part, TitledTable, drawn};
use crate::figures::{Extent, FigureSource};

/// Strengths in the tables of displacements.
const SHOWN_STRENGTHS: [f64; 3] = [0.1, 0.2, 0.4];
/// Strength in the table of intensity levels.
const TAKEN_APART: f64 = 0.2;
/// Sites in the first table.
const FIRST_SITES: usize = 9;
/// What stands above columns of displacements.
const UPLIFTS_AT: &str = "at uplift strength η";
/// In place of what is of other probabilities than those of the page.
const INFLUENCE_LEFT_OUT: &str = "Influence is left out: uplift influence found it for the probabilities of the study.";
/// What tables say of repaired spectra.
const REPAIRED: &str = "Repaired: from records weighted to match the site's hazard.";

pub(super) fn content(file: &ResultFile) -> Result<Content, UpliftError> {
    let source = FigureSource::read(file)?;
    let figures = source.figures(Extent::Main)?;
    let stored = &source.stored;
    let rows = rows(file, &source, &shown_strengths(&source))?;
    let mut spectra = drawn(figures.answer)?;
    let lead = (!spectra.is_empty()).then(|| spectra.remove(0));
    spectra.extend(drawn(figures.confidence)?);
    let parts = vec![
        Part {
            key: "confidence",
            title: "Confidence",
            note: "",
            figures: spectra,
            tables: [Some(all(&source, &rows)), consistency(&source), spread(&source)].into_iter().flatten().collect(),
        },
        Part {
            key: "causes",
            title: "Sources of the risk",
            note: if file.is_at_target_risks() && file.has_influence() { INFLUENCE_LEFT_OUT } else { "" },
            figures: drawn(figures.causes)?,
            tables: [intensities(&source), records(&source)].into_iter().flatten().collect(),
        },
        Part {
            key: "compute",
            title: "Fitted curves",
            note: "",
            figures: drawn(figures.fits)?,
            tables: vec![coefficients(&source.spectra)],
        },
    ];
    let mut facts = vec![("Seed", stored.seed.to_string()), ("Uplift strengths", stored.strengths.len().to_string())];
    if file.is_at_target_risks() {
        facts.push(("Probabilities", "read after the run, from the analyses of the result".to_owned()));
    }
    Ok(Content {
        subject: "Uniform risk spectra",
        place: match &source.spectra.sites[..] {
            sites if sites.len() <= FIRST_SITES => sites.join(", "),
            sites => format!("{} sites", sites.len()),
        },
        oscillator: Some(file.stored_study()?.oscillator.in_words()),
        lead,
        summary: first(&source, &rows),
        facts,
        parts,
        source: Some(source),
    })
}

/// The first table: displacements by the first measure, of one site at every probability, of several at the rarest;
/// none without spectra.
fn first(source: &FigureSource, rows: &[Row]) -> Option<TitledTable> {
    let spectra = &source.spectra;
    let (measure, poe) = (spectra.measures.first()?.measure, source.rarest());
    let is_one = spectra.sites.len() == 1;
    let is_shown = |row: &&Row| row.measure == measure && (is_one || row.poe == poe && row.site < FIRST_SITES);
    let rows: Vec<&Row> = rows.iter().filter(is_shown).collect();
    let risk = |poe: usize| risk_in_words(spectra.poes[poe], spectra.years);
    let of_risk = if is_one { String::new() } else { format!(" of {}", risk(poe)) };
    let title =
        format!("Displacement, m,{of_risk} by {} (90 % confidence band{})", measure.label(), source.band_of[0].words());
    let is_repaired = rows.iter().any(|row| row.kind == Kind::Repaired);
    let is_cut = spectra.sites.len() > FIRST_SITES;
    let cut = if is_cut { "The first sites; all are in the table of all displacements. " } else { "" };
    let note = format!("{cut}{}", if is_repaired { REPAIRED } else { "" });
    let name = |row: &Row| {
        let name = if is_one { risk(row.poe) } else { spectra.sites[row.site].clone() };
        row.kind.words(&name)
    };
    let table = Table::from_rows(rows.iter().copied()).left(if is_one { "probability" } else { "site" }, name);
    Some(over_strengths(source, ("summary", title, &note), table))
}

/// The displacements by every measure and probability, a row a spectrum.
fn all(source: &FigureSource, rows: &[Row]) -> TitledTable {
    let spectra = &source.spectra;
    let table = Table::from_rows(rows.iter().filter(|row| row.poe == 0))
        .left("site", |row| &spectra.sites[row.site])
        .left("measure", |row| row.kind.words(row.measure.label()));
    let table = spectra.poes.iter().enumerate().fold(table, |table, (poe, &probability)| {
        let risk = risk_name(probability, spectra.years);
        table.each(shown_strengths(source).into_iter().enumerate(), |table, (place, eta)| {
            table.right(format!("{risk}: {}", strength(spectra, eta)), move |row: &Row| {
                let is_same =
                    |of: &&Row| (of.measure, of.site, of.poe, of.kind) == (row.measure, row.site, poe, row.kind);
                rows.iter().find(is_same).map_or_else(String::new, |of| of.cells[place].clone())
            })
        })
    });
    let kind = kind_of_risks(&spectra.poes, spectra.years).map_or_else(String::new, |kind| format!(", {kind}"));
    let title = format!("All displacements, m (90 % confidence band{kind})");
    let by = |(of, band_of): (&MeasureSpectra, &BandOf)| format!("{}{}", of.measure.label(), band_of.words());
    let bands: Vec<String> = spectra.measures.iter().zip(&source.band_of).map(by).collect();
    let note = format!("Bands: {}.", bands.join(", "));
    let is_told = source.band_of.contains(&BandOf::Earthquakes);
    let note = if is_told { note.as_str() } else { "" };
    TitledTable { group: UPLIFTS_AT, ..TitledTable::new("displacements", title, note, table) }
}

/// A table of displacements: a column for each strength shown.
fn over_strengths(source: &FigureSource, (id, title, note): (&str, String, &str), table: TableOf<&Row>) -> TitledTable {
    let strengths = shown_strengths(source).into_iter().enumerate();
    let table = table.each(strengths, |table, (place, eta)| {
        table.right(strength(&source.spectra, eta), |row| row.cells[place].clone())
    });
    TitledTable { group: UPLIFTS_AT, ..TitledTable::new(id, title, note, table) }
}

/// Positions of the strengths in the tables.
fn shown_strengths(source: &FigureSource) -> Vec<usize> {
    nearest(&source.spectra.strengths, &SHOWN_STRENGTHS)
}

/// The strength at an index, as the heading of a column.
fn strength(stored: &StoredSpectra, eta: usize) -> String {
    format!("{:.2}", stored.strengths[eta])
}

/// Fractiles of the spectra over weighted hazard curves and uncertain structures; none without such.
fn spread(source: &FigureSource) -> Option<TitledTable> {
    let stored = &source.spectra;
    let shown = nearest(&stored.strengths, &SHOWN_STRENGTHS);
    let places = source.spreads.iter().flat_map(|of| (0..stored.poes.len()).map(move |poe| (of, poe)));
    let table = Table::from_rows(places)
        .left("site", |(of, _)| &stored.sites[of.site])
        .left("measure", |(of, _)| of.measure.label())
        .left("probability", |(_, poe)| risk_name(stored.poes[poe], stored.years))
        .left("over", |(of, _)| of.over.words())
        .each(shown, |table, eta| {
            table.right(strength(stored, eta), |(of, poe)| {
                let [_, lower, .., upper] = of.limits_m(poe);
                format!("{} to {}", metres(lower[eta]), metres(upper[eta]))
            })
        });
    let note = "One of the curves or structures is true. The uncertainty of the records is not included.";
    let table = TitledTable::new("spread", "Displacement, m: 5 to 95 % fractiles over what is uncertain", note, table);
    TitledTable { group: UPLIFTS_AT, ..table }.unless_empty()
}

/// The levels that make up the risk of the rarest probability at one strength; none before `uplift influence`.
fn intensities(source: &FigureSource) -> Option<TitledTable> {
    let (stored, poe) = (&source.stored, source.rarest());
    let strength = *nearest(&stored.strengths, &[TAKEN_APART]).first()?;
    let mut rows = Vec::new();
    for (influence, measure) in source.influences() {
        for (site, name) in stored.sites.iter().enumerate() {
            let shares = influence.shares.block([site, poe, strength]);
            let levels = [0.05, 0.5, 0.95].map(|share| two_digits(level_of_share(&measure.levels, shares, share)));
            let measure = format!("{}, {}", influence.measure.label(), influence.measure.unit());
            rows.push([name.clone(), measure].into_iter().chain(levels).collect());
        }
    }
    let header = ["site", "measure", "5 % below", "half below", "95 % below"];
    let note = format!(
        "Levels below which 5 %, half and 95 % of the risk at {} lie, at strength {:.2}.",
        risk_in_words(stored.poes[poe], stored.years),
        stored.strengths[strength]
    );
    let table = Table::new(header, rows).with_left(2);
    TitledTable::new("intensities", "Intensity levels that make up the risk", note, table).unless_empty()
}

/// The record that changes each spectrum of the rarest probability most; none before `uplift influence`.
fn records(source: &FigureSource) -> Option<TitledTable> {
    let (stored, poe) = (&source.stored, source.rarest());
    let mut rows = Vec::new();
    for (influence, measure) in source.influences() {
        for site in 0..stored.sites.len() {
            let ranked = |without_m| rank_records(stored, &measure.exact_m, without_m, [site, poe]).into_iter().next();
            rows.extend(influence.without_m.as_ref().and_then(ranked).map(|of| (site, influence.measure.label(), of)));
        }
    }
    let table = Table::from_rows(&rows)
        .left("site", |(site, ..)| &stored.sites[*site])
        .left("measure", |(_, label, _)| label)
        .left("record", |(.., of)| stored.units.name(of.record))
        .right("mean change, %", |(.., of)| format!("{:+.1}", 100.0 * of.mean_change))
        .right("largest, %", |(.., of)| format!("{:+.1}", 100.0 * of.largest_change))
        .right("at strength", |(.., of)| format!("{:.3}", of.strength));
    let risk = risk_in_words(stored.poes[poe], stored.years);
    let note = format!("Change of the spectrum of {risk} without its most influential record.");
    TitledTable::new("records", "Influence of single records", note, table).unless_empty()
}

fn coefficients(spectra: &StoredSpectra) -> TitledTable {
    let number =
        |value: f64, digits: usize| if value.is_nan() { "no fit".to_owned() } else { format!("{value:.digits$}") };
    let places = (0..spectra.sites.len()).flat_map(|site| (0..spectra.poes.len()).map(move |poe| [site, poe]));
    let table = Table::from_rows(places)
        .left("site", |[site, _]| &spectra.sites[site])
        .left("probability", |[_, poe]| risk_name(spectra.poes[poe], spectra.years))
        .each(&spectra.measures, |table, of| {
            let heading = |symbol: &str| format!("{symbol}, {}", of.measure.label());
            table
                .right(heading("c0, m"), |at| number(of.fits[at].c0_m, 4))
                .right(heading("c1"), |at| number(of.fits[at].c1, 4))
                .right(heading("c2, m"), |at| number(of.fits[at].c2_m, 4))
                .right(heading("RMSE, m"), |at| number(of.fits[at].rmse_m, 4))
        });
    let note = format!(
        "u = c0 exp(c1 η) + c2{}.",
        kind_of_risks(&spectra.poes, spectra.years).map_or_else(String::new, |kind| format!("; {kind}"))
    );
    TitledTable::new("table-4-2", "Coefficients (Table 4.2)", note, table)
}
