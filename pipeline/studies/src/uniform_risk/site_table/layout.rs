//! A site as it stands in the tables and on the map: what rows, columns and properties are called.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use uplift_inputs::{ListedSite, SiteList};
use uplift_job::table::neutral;
use uplift_job::text::nearest;
use uplift_result::layout::axis::STRENGTH;
use uplift_result::{BandKind, SITE_CONSISTENCY, SITE_FLAGS, regression};
use uplift_study::UniformRiskStudy;
use uplift_uniform_risk::SiteSpectra;

use super::cube::CubeRows;
use super::repair::RepairedSite;
use super::shape::{PROBLEM, Shape, SiteValues, SpectrumArray};

/// Strengths of which a map shows ordinates, unless the study names some.
pub const SHOWN_ON_MAP: [f64; 3] = [0.1, 0.2, 0.4];
/// How the line of a site on the map begins.
pub(super) const FEATURE: &str = "{\"type\":\"Feature\",";
/// Columns of both tables that say what a spectrum is of.
const OF_SPECTRUM: [&str; 6] = ["site", "longitude", "latitude", "im", "poe", "years"];
/// Position of the verdict, a text, among the numbers of [`SITE_CONSISTENCY`].
const VERDICT: usize = 2;
/// Position of the flag among the ordinates of a table, numbers.
const FLAG: usize = 1;

/// What the rows and properties are called.
#[derive(Clone)]
pub struct SiteTableLayout {
    years: f64,
    /// In the table.
    strengths: Vec<f64>,
    /// `[export, poe]`, as they are in [`SiteValues`].
    spectra: Vec<SpectrumNames>,
    /// Names of the cells carried along, as keys of JSON.
    carried: Vec<String>,
    pub(super) has_texts: bool,
    /// What there is of each site.
    pub(super) shape: Shape,
}

#[derive(Clone)]
struct SpectrumNames {
    /// Of the measure.
    label: &'static str,
    poe: f64,
    /// Such as `pgv_2pct_50yr`.
    key: String,
    /// What the map shows: name, such as `pgv_2pct_50yr_u_m_at_0.2`, quantity and place of its strength.
    properties: Vec<(String, SpectrumArray, usize)>,
}

/// A site as it stands in the files.
pub struct SiteRow {
    pub(super) text: Option<SiteText>,
    pub(super) rows: CubeRows,
}

/// A site as it stands in the tables and on the map.
pub(super) struct SiteText {
    pub(super) spectra: String,
    pub(super) coefficients: String,
    pub(super) feature: String,
}

impl SiteTableLayout {
    pub(super) fn new(study: &UniformRiskStudy, list: &SiteList) -> Self {
        let chosen = study.site_table.as_ref().and_then(|table| table.strengths.as_ref()).map(|chosen| {
            let is_chosen = |&index: &usize| chosen.contains(&study.strengths[index]);
            (0..study.strengths.len()).filter(is_chosen).collect::<Vec<usize>>()
        });
        let is_chosen = chosen.is_some();
        let in_table = chosen.unwrap_or_else(|| (0..study.strengths.len()).collect());
        let strengths: Vec<f64> = in_table.iter().map(|&index| study.strengths[index]).collect();
        let on_map = if is_chosen { (0..strengths.len()).collect() } else { nearest(&strengths, &SHOWN_ON_MAP) };
        let map_labels = strength_labels(on_map.iter().map(|&place| strengths[place]));
        let on_map: Vec<(usize, String)> = on_map.into_iter().zip(map_labels).collect();
        let (years, shape) = (study.risk.years, Shape::new(study, list, in_table));
        let (mut spectra, mut taken) = (Vec::new(), BTreeSet::from(["name", PROBLEM].map(str::to_owned)));
        for (export, &poe) in list.exports.iter().flat_map(|export| study.risk.poe.iter().map(move |poe| (export, poe)))
        {
            let key = format!("{}_{}pct_{years}yr", export.measure.key(), (poe * 1e10).round() / 1e8);
            let mut properties = Vec::new();
            for kind in shape.kinds() {
                for (place, label) in &on_map {
                    let name = |own: SpectrumArray| format!("{key}{}_{}_at_{label}", kind.suffix, own.name());
                    properties.extend(shape.spectra(kind).map(|own| (name(own), own, *place)));
                }
            }
            properties.extend(Shape::fits(BandKind::PLAIN).map(|own| (format!("{key}_{}", own.name()), own, 0)));
            taken.extend(properties.iter().map(|(name, ..)| name.clone()));
            spectra.push(SpectrumNames { label: export.measure.label(), poe, key, properties });
        }
        let carried = distinct(&list.carried, &mut taken).iter().map(|name| json_text(name)).collect();
        Self { years, strengths, spectra, carried, has_texts: study.output.csv, shape }
    }

    /// Positions of the strengths in the table of spectra.
    pub(super) fn in_table(&self) -> &[usize] {
        &self.shape.strengths
    }

    pub(super) fn spectra_columns(&self) -> Vec<String> {
        let mut own: Vec<String> = self.shape.ordinates.iter().map(SpectrumArray::column).collect();
        own.insert(FLAG, SITE_FLAGS.quantities[0].name.to_owned());
        OF_SPECTRUM.into_iter().chain([STRENGTH.name]).map(str::to_owned).chain(own).collect()
    }

    pub(super) fn coefficient_columns(&self, carried: &[String]) -> Vec<String> {
        let mut columns = OF_SPECTRUM.map(str::to_owned).to_vec();
        columns.extend(Shape::fits(BandKind::PLAIN).map(|own| own.column()));
        columns.extend([regression::BOUND_ACTIVE.name, PROBLEM].map(str::to_owned));
        if self.shape.is_repaired {
            columns.extend(repaired_columns());
        }
        columns.extend(distinct(carried, &mut columns.iter().cloned().collect()));
        columns
    }

    /// A site with its spectra in each export, or why it has none, and with its repair by each where the study asks
    /// for one.
    pub fn row(
        &self,
        site: &ListedSite,
        spectra: &[Result<SiteSpectra, String>],
        repaired: Option<&[RepairedSite]>,
    ) -> SiteRow {
        let values = SiteValues::new(&self.shape, spectra, repaired.unwrap_or_default());
        let text = self.has_texts.then(|| self.text(site, &values));
        SiteRow { text, rows: CubeRows::new(values, &self.shape) }
    }

    fn text(&self, site: &ListedSite, values: &SiteValues<'_>) -> SiteText {
        let mut text = SiteText { spectra: String::new(), coefficients: String::new(), feature: String::new() };
        let place = format!("{},{:?},{:?}", cell(&site.name), site.longitude_deg, site.latitude_deg);
        let mut tail = String::new();
        let mut carried = String::new();
        for (key, value) in self.carried.iter().zip(site.carried()) {
            let _ = write!(tail, ",{}", cell(value));
            let _ = write!(carried, ",{key}:{}", json_cell(value));
        }
        let mut problems: Vec<String> = Vec::new();
        let mut properties = String::new();
        for (at, names) in self.spectra.iter().enumerate() {
            let (spectrum, problem) = (values.plain[at].as_ref(), &values.problems[at]);
            match spectrum {
                Some(_) if !problem.is_empty() => problems.push(format!("{}: {problem}", names.key)),
                None if at % self.shape.poes == 0 => problems.push(format!("{}: {problem}", names.label)),
                _ => {}
            }
            let head = format!("{place},{},{:?},{:?}", names.label, names.poe, self.years);
            let flags = spectrum.iter().flat_map(|spectrum| &spectrum.flags);
            for (place, (strength, flag)) in self.strengths.iter().zip(flags).enumerate() {
                let _ = write!(text.spectra, "{head},{strength:?}");
                for (column, own) in self.shape.ordinates.iter().enumerate() {
                    let _ = write!(text.spectra, ",{}", number(own.value(values, at, place)));
                    if column + 1 == FLAG {
                        let _ = write!(text.spectra, ",{}", flag.word());
                    }
                }
                text.spectra.push('\n');
            }
            let fit = spectrum.map(|spectrum| spectrum.fit).filter(|fit| fit.curve().is_some());
            let numbers = Shape::fits(BandKind::PLAIN).map(|own| number(own.value(values, at, 0)));
            let mut cells: Vec<String> = numbers.collect();
            cells.extend([fit.map_or_else(String::new, |fit| fit.bound_active.to_string()), cell(problem)]);
            if self.shape.is_repaired {
                cells.extend(repaired_cells(values, at, self.shape.poes));
            }
            let _ = writeln!(text.coefficients, "{head},{}{tail}", cells.join(","));
            for (name, own, place) in &names.properties {
                let _ = write!(properties, ",\"{name}\":{}", json_number(own.value(values, at, *place)));
            }
        }
        let problem = if problems.is_empty() { "null".to_owned() } else { json_text(&problems.join("; ")) };
        // east of 180° is west of it, as RFC 7946 counts
        let longitude = if site.longitude_deg > 180.0 { site.longitude_deg - 360.0 } else { site.longitude_deg };
        let _ = write!(
            text.feature,
            "{FEATURE}\"geometry\":{{\"type\":\"Point\",\"coordinates\":[{longitude:?},{:?}]}},\"properties\":{{\"name\":{}{properties},\"{PROBLEM}\":{problem}{carried}}}}}",
            site.latitude_deg,
            json_text(&site.name),
        );
        text
    }
}

/// The columns of coefficients that a repair adds.
fn repaired_columns() -> Vec<String> {
    let mut columns: Vec<String> = SITE_CONSISTENCY.quantities.iter().map(|own| own.name.to_owned()).collect();
    columns.insert(VERDICT, "verdict".to_owned());
    columns.extend(Shape::fits(BandKind::REPAIRED).map(|own| own.column()));
    columns.push("no_repair".to_owned());
    columns
}

/// The cells in them of the spectrum at a position among those of a site, which are of so many probabilities.
fn repaired_cells(site: &SiteValues<'_>, at: usize, poes: usize) -> Vec<String> {
    let consistency = site.consistency[at / poes];
    let numbers = SITE_CONSISTENCY.quantities.iter().map(|own| number(own.number(consistency, 0)));
    let mut cells: Vec<String> = numbers.collect();
    cells.insert(VERDICT, consistency.verdict.to_owned());
    cells.extend(Shape::fits(BandKind::REPAIRED).map(|own| number(own.value(site, at, 0))));
    cells.push(cell(&site.no_repair[at]));
    cells
}

/// A number of a table; nothing where it is not known.
pub(super) fn number(value: Option<f64>) -> String {
    value.filter(|value| !value.is_nan()).map_or_else(String::new, |value| format!("{value:?}"))
}

/// A cell of a table, in quotes where its content could be taken for the table's structure.
pub(super) fn cell(text: &str) -> String {
    let text = neutral(text);
    let quoted = text.contains([',', '"', '\n', '\r']) || text.starts_with('#');
    if quoted { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.into_owned() }
}

pub(super) fn json_text(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// A number of JSON, which has neither infinity nor NaN.
pub(super) fn json_number(value: Option<f64>) -> String {
    value.filter(|value| value.is_finite()).map_or_else(|| "null".to_owned(), |value| format!("{value:?}"))
}

/// A cell carried along: a number where it is written as JSON writes one, so that 0012 stays text.
fn json_cell(text: &str) -> String {
    match serde_json::from_str::<serde_json::Number>(text) {
        Ok(_) => text.to_owned(),
        Err(_) if text.is_empty() => "null".to_owned(),
        Err(_) => json_text(text),
    }
}

/// Names of the strengths on the map: four decimals where these tell them apart, else all digits.
fn strength_labels(strengths: impl Iterator<Item = f64>) -> Vec<String> {
    let strengths: Vec<f64> = strengths.collect();
    let short = |strength: &f64| ((strength * 1e4).round() / 1e4).to_string();
    let labels: Vec<String> = strengths.iter().map(short).collect();
    let distinct: BTreeSet<&String> = labels.iter().collect();
    if distinct.len() == labels.len() { labels } else { strengths.iter().map(ToString::to_string).collect() }
}

/// Names that no other has: `table_` goes before those that are taken.
fn distinct(names: &[String], taken: &mut BTreeSet<String>) -> Vec<String> {
    let distinct = names.iter().map(|name| {
        let mut name = name.trim().to_owned();
        while !taken.insert(name.clone()) {
            name.insert_str(0, "table_");
        }
        name
    });
    distinct.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_survive_a_table_and_json() {
        for (text, csv, json) in [
            ("Sion", "Sion", "\"Sion\""),
            ("Sion, \"old\"", "\"Sion, \"\"old\"\"\"", "\"Sion, \\\"old\\\"\""),
            ("0012", "0012", "\"0012\""),
            ("-1.5e3", "-1.5e3", "-1.5e3"),
            ("nan", "nan", "\"nan\""),
            ("", "", "null"),
            ("#1", "\"#1\"", "\"#1\""),
            ("=1+1", "'=1+1", "\"=1+1\""),
        ] {
            assert_eq!((cell(text).as_str(), json_cell(text).as_str()), (csv, json));
        }
        assert_eq!(
            [json_number(Some(f64::INFINITY)), json_number(Some(1e-9)), json_number(None)],
            ["null", "1e-9", "null"]
        );
    }

    #[test]
    fn names_are_distinct() {
        assert_eq!(strength_labels([0.1, 1.0 / 3.0].into_iter()), ["0.1", "0.3333"]);
        assert_eq!(strength_labels([0.1, 0.100_001].into_iter()), ["0.1", "0.100001"]);
        let names = ["vs30", "problem", "vs30"].map(str::to_owned);
        let mut taken = [PROBLEM.to_owned()].into();
        assert_eq!(distinct(&names, &mut taken), ["vs30", "table_problem", "table_vs30"]);
    }
}
