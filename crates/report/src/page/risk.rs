//! What the report shows of uniform risk spectra.

use super::answer::{answer, significant};
use super::consistency;
use super::{Content, Part, TitledTable};
use crate::figures::FigureSource;
use uplift::UpliftError;
use uplift::influence::{level_of_share, rank_records};
use uplift::result::{MeasureBands, ResultFile, StoredBands, StoredSpectra, StoredSpectraBands, StoredStripes};
use uplift::text::{Table, kind_of_risks, metres, nearest, per_cent, risk_in_words, risk_name, spectrum_words};

/// Strengths in the table of displacements, and in that of intensities.
const SHOWN_STRENGTHS: [f64; 5] = [0.05, 0.1, 0.2, 0.3, 0.4];
const TAKEN_APART: [f64; 3] = [0.1, 0.2, 0.4];
/// What stands above columns of displacements.
const UPLIFTS_AT: &str = "displacement, m, of a structure that uplifts at";
/// In place of what is of other probabilities than those of the page.
const INFLUENCE_LEFT_OUT: &str = "Which records and intensities carry the spectra is left out: uplift influence found \
                                  it for the probabilities of the study, and this page is of others.";
/// What Table 4.1 says of repaired spectra.
const REPAIRED_BANDS: &str = " Those of repaired spectra have weights of their own in every resample.";

/// What rows of Table 4.1 are of where a site's weighted hazard curves are drawn too.
const WITH_CURVES: &str = "with hazard curves";
/// What Table 4.1 says of them.
const JOINT_BANDS: &str = " With hazard curves: over the records and the site's weighted hazard curves together.";

/// What the table of displacements says of repaired spectra.
const REPAIRED: &str = " Repaired: of records weighted so that they bring the site's hazard of both measures, where as \
                        they are they do not.";
/// Records of each spectrum in the table of influence.
const NAMED_RECORDS: usize = 3;

pub(super) fn content(file: &ResultFile) -> Result<Content, UpliftError> {
    let source = FigureSource::read(file)?;
    let figures = source.figures()?;
    let stored = &source.stored;
    let mut parts = vec![
        Part {
            key: "answer",
            title: "Displacements to survive",
            note: String::new(),
            tables: vec![summary(&source)],
            figures: figures.answer,
            details: Vec::new(),
        },
        Part {
            key: "confidence",
            title: "How sure it is",
            // it is of the rarest probability of the study
            note: if file.is_asked() { String::new() } else { how_sure(&file.precision()) },
            tables: Vec::new(),
            figures: figures.confidence,
            details: source
                .bands
                .iter()
                .map(|bands| confidence(&source.spectra, bands))
                .chain(spread(&source))
                .collect(),
        },
        Part {
            key: "causes",
            title: "Where it comes from",
            note: if file.is_asked() && file.has_influence() { INFLUENCE_LEFT_OUT } else { "" }.to_owned(),
            tables: Vec::new(),
            figures: figures.causes,
            details: [intensities(&source), records(&source)].into_iter().flatten().collect(),
        },
        Part {
            key: "compute",
            title: "To compute with",
            note: String::new(),
            tables: vec![coefficients(&source.spectra)],
            figures: figures.fits,
            details: Vec::new(),
        },
    ];
    if let Some(part) = consistency::part(&source, figures.consistency) {
        // before where it comes from
        parts.insert(2, part);
    }
    let mut facts = vec![("Seed", stored.seed.to_string())];
    if file.is_asked() {
        facts.push(("Probabilities", "asked for after the run, from the stripes of the result".to_owned()));
    }
    Ok(Content {
        subject: "Uniform risk spectra",
        extent: format!(
            "{}, {} uplift strengths, {} site{}.",
            ground_motions(stored),
            stored.strengths.len(),
            stored.sites.len(),
            if stored.sites.len() == 1 { "" } else { "s" }
        ),
        answer: answer(&source),
        facts,
        parts,
        source: Some(source),
    })
}

/// How many ground motions there are, in words: azimuths and structures make several records of a pair.
fn ground_motions(stored: &StoredStripes) -> String {
    let (records, pairs) = (stored.records.len(), stored.units.firsts().count());
    if records == pairs {
        format!("{records} ground motions")
    } else {
        format!("{pairs} pairs of ground motions, of which {records} records are made")
    }
}

/// Whether the records are enough, by every measure.
fn how_sure(precision: &[String]) -> String {
    let sentences: Vec<String> = precision.iter().map(|sentence| format!("{sentence}.")).collect();
    sentences.join(" ")
}

/// The strength at an index as the acceleration at which structures uplift.
fn acceleration(stored: &StoredSpectra, eta: usize) -> String {
    format!("{:.2} g", stored.strengths[eta])
}

fn summary(source: &FigureSource) -> TitledTable {
    let stored = &source.spectra;
    let shown = nearest(&stored.strengths, &SHOWN_STRENGTHS);
    let places = stored.measures.iter().flat_map(|of| of.u_m.blocks::<2>().map(|(at, _)| at));
    let mut rows = Vec::new();
    let mut is_repaired = false;
    for ([site, poe], spectrum) in places.zip(stored.rows()) {
        let label = spectrum.measure.label();
        rows.push((spectrum.site, label.to_owned(), spectrum.poe, spectrum.u_m));
        if let Some(u_m) = source.repaired(spectrum.measure, site) {
            rows.push((spectrum.site, spectrum_words(label, true), spectrum.poe, u_m.block([site, poe])));
            is_repaired = true;
        }
    }
    let repaired = if is_repaired { REPAIRED } else { "" };
    let note = format!(
        "What a structure goes beyond with the stated probability, if it uplifts at the stated acceleration.{repaired}"
    );
    let table = Table::of(&rows)
        .left("site", |(site, ..)| site)
        .left("measure", |(_, measure, ..)| measure)
        .left("probability", |&(_, _, poe, _)| risk_in_words(poe, stored.years))
        .each(shown, |table, eta| table.right(acceleration(stored, eta), |(.., u_m)| metres(u_m[eta])));
    TitledTable { group: UPLIFTS_AT, ..TitledTable::new("summary", "Displacement in metres", note, table) }
}

/// How far the spectra lie apart over what is not known; none where all of it is.
fn spread(source: &FigureSource) -> Option<TitledTable> {
    let stored = &source.spectra;
    let shown = nearest(&stored.strengths, &SHOWN_STRENGTHS);
    let places = source.spreads.iter().flat_map(|of| (0..stored.poes.len()).map(move |poe| (of, poe)));
    let table = Table::of(places)
        .left("site", |(of, _)| &stored.sites[of.site])
        .left("measure", |(of, _)| of.measure.label())
        .left("probability", |(_, poe)| risk_name(stored.poes[poe], stored.years))
        .left("over", |(of, _)| of.over.words())
        .each(shown, |table, eta| {
            table.right(acceleration(stored, eta), |(of, poe)| {
                let [_, lower, .., upper] = of.limits_m(poe);
                format!("{} to {}", metres(lower[eta]), metres(upper[eta]))
            })
        });
    let note = "5 to 95 % fractiles over weighted hazard curves, and over structures that may be: one of them holds, \
                and nobody knows which. What the records leave open is not in it.";
    let table = TitledTable::new("spread", "Spectra over what is not known", note, table);
    TitledTable { group: UPLIFTS_AT, ..table }.unless_empty()
}

/// Which levels make the risk of the rarest probability; none before `uplift influence`.
fn intensities(source: &FigureSource) -> Option<TitledTable> {
    let stored = &source.stored;
    let (poe, shown) = (source.rarest(), nearest(&stored.strengths, &TAKEN_APART));
    let mut rows = Vec::new();
    for (influence, measure) in source.influences() {
        for (site, name) in stored.sites.iter().enumerate() {
            for &strength in &shown {
                let shares = influence.shares.block([site, poe, strength]);
                let level = |share: f64| significant(level_of_share(&measure.levels, shares, share));
                let mut row =
                    vec![name.clone(), format!("{}, {}", influence.measure.label(), influence.measure.unit())];
                row.push(format!("{:.2}", stored.strengths[strength]));
                row.extend([0.05, 0.5, 0.95].map(level));
                row.extend([shares.first(), shares.last()].map(|share| percentage(share.copied())));
                rows.push(row);
            }
        }
    }
    let header =
        ["site", "measure", "strength, g", "5 % below", "half below", "95 % below", "below all, %", "above all, %"];
    let note = format!(
        "Levels of the measure below which 5 %, half and 95 % of the risk at the ordinate of {} lie, and what of it \
         comes from below and above all analysed levels.",
        risk_in_words(stored.poes[poe], stored.years)
    );
    let table = Table::new(header, rows).with_left(2);
    TitledTable::new("intensities", "Intensities that make the risk", note, table).unless_empty()
}

/// Which records carry the spectra of the rarest probability; none before `uplift influence`.
fn records(source: &FigureSource) -> Option<TitledTable> {
    let stored = &source.stored;
    let poe = source.rarest();
    let mut rows = Vec::new();
    for (influence, measure) in source.influences() {
        let Some(without_m) = &influence.without_m else { continue };
        for (site, name) in stored.sites.iter().enumerate() {
            for of in rank_records(stored, &measure.exact_m, without_m, [site, poe]).iter().take(NAMED_RECORDS) {
                rows.push(vec![
                    name.clone(),
                    influence.measure.label().to_owned(),
                    stored.units.name(of.record).to_owned(),
                    format!("{:+.1}", 100.0 * of.mean_change),
                    format!("{:+.1}", 100.0 * of.largest_change),
                    format!("{:.3}", of.strength),
                ]);
            }
        }
    }
    let note = format!(
        "Change of the spectrum of {} if one record is left out, on average over the strengths that rock, and where it \
         is largest.",
        risk_in_words(stored.poes[poe], stored.years)
    );
    let header = ["site", "measure", "record left out", "mean change, %", "largest, %", "at strength, g"];
    let table = Table::new(header, rows).with_left(3);
    TitledTable::new("records", "Records that carry the spectra", note, table).unless_empty()
}

fn percentage(share: Option<f64>) -> String {
    share.filter(|share| share.is_finite()).map_or_else(|| "–".to_owned(), |share| format!("{:.1}", 100.0 * share))
}

fn coefficients(spectra: &StoredSpectra) -> TitledTable {
    let number =
        |value: f64, digits: usize| if value.is_nan() { "no fit".to_owned() } else { format!("{value:.digits$}") };
    let rows: Vec<_> = spectra.rows().collect();
    let table = Table::of(&rows)
        .left("site", |spectrum| spectrum.site)
        .left("measure", |spectrum| spectrum.measure.label())
        .left("probability", |spectrum| risk_name(spectrum.poe, spectra.years))
        .right("c0, m", |spectrum| number(spectrum.fit.c0_m, 4))
        .right("c1", |spectrum| number(spectrum.fit.c1, 4))
        .right("c2, m", |spectrum| number(spectrum.fit.c2_m, 4))
        .right("RMSE, m", |spectrum| number(spectrum.fit.rmse_m, 4));
    let note = format!(
        "u = c0 exp(c1 η) + c2 with c2 not negative, for strengths η above 0.05 or as the study says{}.",
        kind_of_risks(&spectra.poes, spectra.years).map_or_else(String::new, |kind| format!("; {kind}"))
    );
    TitledTable::new("table-4-2", "Coefficients (Table 4.2)", note, table)
}

fn confidence(stored: &StoredSpectra, bands: &StoredBands) -> TitledTable {
    let number = |value: f64, digits: usize| if value.is_nan() { "-".to_owned() } else { format!("{value:.digits$}") };
    let beyond = |of_measure: &MeasureBands, at @ [site, poe, _]: [usize; 3]| -> [String; 2] {
        let found = || {
            let of = stored.measures.iter().find(|own| own.measure == of_measure.measure)?;
            let spectrum = (stored.strengths.as_slice(), of.u_m.block([site, poe]));
            let found = of_measure.inferred.as_ref()?.widest(spectrum, at)?;
            Some([found.truth, found.prediction].map(|[lower, upper]| format!("{lower:+.0} to {upper:+.0}")))
        };
        found().unwrap_or_else(|| ["-", "-"].map(str::to_owned))
    };
    let rows = |of_measure: &MeasureBands| -> Vec<Vec<String>> {
        let row = |at: [usize; 3], measure: String, (error, range): (f64, f64), [truth, another]: [String; 2]| {
            let [site, poe, size] = at;
            vec![
                stored.sites[site].clone(),
                measure,
                risk_name(stored.poes[poe], stored.years),
                bands.sizes[size].to_string(),
                number(error, 1),
                number(range, 0),
                truth,
                another,
            ]
        };
        let label = of_measure.measure.label();
        let mut rows = Vec::new();
        for (at @ [site, _, size], _) in of_measure.plain.error_of_median.blocks::<3>() {
            let mut add = |measure: String, own: &StoredSpectraBands, beyond: [String; 2]| {
                rows.push(row(at, measure.clone(), (own.error_of_median[at], own.range_of_interval[at]), beyond));
                if let Some(joint) = own.joint.as_ref().filter(|joint| !joint.limits_m[1].block(at)[0].is_nan()) {
                    let measure = format!("{measure}, {WITH_CURVES}");
                    rows.push(row(at, measure, (f64::NAN, joint.range_of_interval[at]), ["-", "-"].map(str::to_owned)));
                }
            };
            add(label.to_owned(), &of_measure.plain, beyond(of_measure, at));
            if let Some(own) = of_measure.repaired.as_ref().filter(|own| !own.failed[[site, size]].is_nan()) {
                add(spectrum_words(label, true), &own.bands, ["-", "-"].map(str::to_owned));
            }
        }
        rows
    };
    let note = format!(
        "Error of the median and width of the {} interval over {}, at the strength where each is largest (Eq. 4.9, \
             4.10). Truth: where the spectrum of all records like these lies, and another set: where that of another \
             set of as many lies, each with {} confidence, from the ordinate at the strength where the first is widest \
             in metres.{}{}",
        per_cent(bands.confidence),
        bands.drawn_words(),
        per_cent(bands.confidence),
        if bands.measures.iter().any(|of| of.repaired.is_some()) { REPAIRED_BANDS } else { "" },
        if bands.measures.iter().any(|of| of.plain.joint.is_some()) { JOINT_BANDS } else { "" }
    );
    let header = ["site", "measure", "probability", "records", "e_{median}, %", "r, %", "truth, %", "another set, %"];
    let table = Table::new(header, bands.measures.iter().flat_map(rows)).with_left(3);
    TitledTable::new("table-4-1", "How sure the spectra are (Table 4.1)", note, table)
}
