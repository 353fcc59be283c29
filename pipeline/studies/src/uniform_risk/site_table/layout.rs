//! A site as it stands in the tables and on the map: what rows, columns and properties are called.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use uplift_inputs::{ListedSite, SiteList};
use uplift_job::table::neutral;
use uplift_job::text::nearest;
use uplift_regression::ExponentialFit;
use uplift_risk::Ordinate;
use uplift_study::UniformRiskStudy;
use uplift_uniform_risk::{QUOTED_LIMITS, SiteSpectra, SiteSpread};

use super::consistent;
use super::cube::{CubeRows, SPREAD, Shape};
use super::repair::SiteConsistency;

/// Strengths of which a map shows ordinates, unless the study names some.
pub const SHOWN_ON_MAP: [f64; 3] = [0.1, 0.2, 0.4];
/// How the line of a site on the map begins.
pub(super) const FEATURE: &str = "{\"type\":\"Feature\",";
/// Columns of the spectra, before their bands.
const SPECTRA: [&str; 9] = ["site", "longitude", "latitude", "im", "poe", "years", "strength", "u_m", "flag"];
/// Columns of the coefficients before and after those of [`FIT`]; then come those of the study's own table.
const COEFFICIENTS: [&[&str]; 2] =
    [&["site", "longitude", "latitude", "im", "poe", "years"], &["bound_active", "problem"]];
/// The name of a number of a fit, and where it is.
type OfFit = (&'static str, fn(&ExponentialFit) -> f64);
/// What tables, map and arrays have of a fit.
pub(super) const FIT: [OfFit; 4] =
    [("c0_m", |fit| fit.c0), ("c1", |fit| fit.c1), ("c2_m", |fit| fit.c2), ("rmse_m", |fit| fit.rmse)];

/// What the rows and properties are called.
#[derive(Debug, Clone)]
pub struct SiteTableLayout {
    years: f64,
    strengths: Vec<f64>,
    /// Positions of the strengths on the map, all of them in the table.
    on_map: Vec<usize>,
    /// Their names.
    map_labels: Vec<String>,
    /// `[export]`.
    measures: Vec<MeasureNames>,
    /// Names of the cells carried along, as keys of JSON.
    carried: Vec<String>,
    pub(super) has_texts: bool,
    /// What there is of each site.
    pub(super) shape: Shape,
}

#[derive(Debug, Clone)]
struct MeasureNames {
    label: &'static str,
    /// `[poe]`.
    poes: Vec<PoeNames>,
}

#[derive(Debug, Clone)]
struct PoeNames {
    poe: f64,
    /// Such as `pgv_2pct_50yr`.
    key: String,
}

/// Ordinates of one probability, and their bands at the strengths in the table.
type Spectrum<'a> = (&'a [Ordinate], &'a [[f64; 2]]);

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
        let in_table = chosen.clone().unwrap_or_else(|| (0..study.strengths.len()).collect());
        let on_map = chosen.unwrap_or_else(|| nearest(&study.strengths, &SHOWN_ON_MAP));
        let map_labels = strength_labels(on_map.iter().map(|&index| study.strengths[index]));
        let years = study.risk.years;
        let measure_names = |key: &str, label| MeasureNames {
            label,
            poes: (study.risk.poe.iter())
                .map(|&poe| PoeNames { poe, key: format!("{key}_{}pct_{years}yr", (poe * 1e10).round() / 1e8) })
                .collect(),
        };
        let shape = Shape::new(study, list, in_table);
        let mut layout = Self {
            years,
            strengths: study.strengths.to_vec(),
            on_map,
            map_labels,
            measures: (list.exports.iter())
                .map(|export| measure_names(export.measure.key(), export.measure.label()))
                .collect(),
            carried: Vec::new(),
            has_texts: study.output.csv,
            shape,
        };
        let mut taken = layout.property_names();
        layout.carried = distinct(&list.carried, &mut taken).iter().map(|name| json_text(name)).collect();
        layout
    }

    /// Positions of the strengths in the table of spectra.
    pub(super) fn in_table(&self) -> &[usize] {
        &self.shape.strengths
    }

    pub(super) fn spectra_columns(&self) -> Vec<String> {
        let mut columns = SPECTRA.to_vec();
        if self.shape.has_bands {
            columns.extend(QUOTED_LIMITS);
        }
        if self.shape.is_repaired {
            columns.extend(&consistent::SPECTRA[..if self.shape.has_bands { 3 } else { 1 }]);
        }
        if self.shape.has_spread {
            columns.extend(SPREAD);
        }
        columns.into_iter().map(str::to_owned).collect()
    }

    pub(super) fn coefficient_columns(&self, carried: &[String]) -> Vec<String> {
        let [before, behind] = COEFFICIENTS;
        let plain = before.iter().copied().chain(FIT.map(|(name, _)| name)).chain(behind.iter().copied());
        let repaired = consistent::coefficients().filter(|_| self.shape.is_repaired);
        let own: Vec<String> = plain.map(str::to_owned).chain(repaired).collect();
        let carried = distinct(carried, &mut own.iter().cloned().collect());
        own.into_iter().chain(carried).collect()
    }

    /// The properties of a feature but for cells carried along.
    fn property_names(&self) -> BTreeSet<String> {
        let mut names: BTreeSet<String> = ["name", "problem"].map(str::to_owned).into();
        for names_of_poe in self.measures.iter().flat_map(|measure| &measure.poes) {
            names.extend(FIT.map(|(name, _)| format!("{}_{name}", names_of_poe.key)));
            for infix in ["", "_consistent"].into_iter().take(1 + usize::from(self.shape.is_repaired)) {
                let of_strength = |place| self.map_values((place, None)).map(move |(quantity, _)| (quantity, place));
                let own = (0..self.on_map.len()).flat_map(of_strength);
                names.extend(own.map(|(quantity, place)| self.property((names_of_poe, infix), quantity, place)));
            }
        }
        names
    }

    /// A site with its spectra in each export, or why it has none, and with what consistency says of each where the
    /// study asks for a repair.
    pub fn row(
        &self,
        site: &ListedSite,
        spectra: &[Result<SiteSpectra, String>],
        consistency: Option<&[SiteConsistency]>,
    ) -> SiteRow {
        let text = self.has_texts.then(|| self.text(site, spectra, consistency));
        SiteRow { text, rows: self.shape.rows(spectra, consistency) }
    }

    fn text(
        &self,
        site: &ListedSite,
        spectra: &[Result<SiteSpectra, String>],
        consistency: Option<&[SiteConsistency]>,
    ) -> SiteText {
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
        for (export, (names, spectra)) in self.measures.iter().zip(spectra).enumerate() {
            let consistency = consistency.map(|of_exports| &of_exports[export]);
            if let Err(reason) = spectra {
                problems.push(format!("{}: {reason}", names.label));
            }
            for (row, poe) in names.poes.iter().enumerate() {
                let spectrum = spectra.as_ref().ok().map(|spectra| spectra.at_poe(row));
                let fit = spectra.as_ref().ok().and_then(|spectra| spectra.fits[row].as_ref().ok());
                let head = format!("{place},{},{:?},{:?}", names.label, poe.poe, self.years);
                let repaired = consistency.and_then(|own| own.spectra.as_ref().ok()).map(|own| own.at_poe(row));
                let spread_m = spectra.as_ref().map_or(&[][..], |spectra| spectra.spread_at_poe(row));
                self.spectrum_rows(&mut text.spectra, &head, (spectrum, repaired), spread_m);
                let problem = problem(spectra, row);
                if !problem.is_empty() && spectrum.is_some() {
                    problems.push(format!("{}: {problem}", poe.key));
                }
                let own = coefficient_cells(fit);
                let of_repair = consistency.map(|own| consistent::coefficient_cells(own, row)).unwrap_or_default();
                let _ = writeln!(text.coefficients, "{head},{own},{}{of_repair}{tail}", cell(&problem));
                properties += &self.map_properties((poe, ""), spectrum);
                if self.shape.is_repaired {
                    properties += &self.map_properties((poe, "_consistent"), repaired);
                }
                for (name, value) in FIT {
                    let _ = write!(properties, ",\"{}_{name}\":{}", poe.key, json_number(fit.map(value)));
                }
            }
        }
        let problem = if problems.is_empty() { "null".to_owned() } else { json_text(&problems.join("; ")) };
        // east of 180° is west of it, as RFC 7946 counts
        let longitude = if site.longitude_deg > 180.0 { site.longitude_deg - 360.0 } else { site.longitude_deg };
        let _ = write!(
            text.feature,
            "{FEATURE}\"geometry\":{{\"type\":\"Point\",\"coordinates\":[{longitude:?},{:?}]}},\"properties\":{{\"name\":{}{properties},\"problem\":{problem}{carried}}}}}",
            site.latitude_deg,
            json_text(&site.name),
        );
        text
    }

    fn spectrum_rows(
        &self,
        rows: &mut String,
        head: &str,
        (spectrum, repaired): (Option<Spectrum<'_>>, Option<Spectrum<'_>>),
        spread_m: &[SiteSpread],
    ) {
        let Some((ordinates, bands_m)) = spectrum else { return };
        for (place, &index) in self.shape.strengths.iter().enumerate() {
            let Ordinate { displacement_m, flag, .. } = ordinates[index];
            let _ = write!(rows, "{head},{:?},{displacement_m:?},{}", self.strengths[index], flag.word());
            for limit_m in bands_m.get(place).into_iter().flatten() {
                let _ = write!(rows, ",{}", number(*limit_m));
            }
            if self.shape.is_repaired {
                let u_m = repaired.map_or(f64::NAN, |(ordinates, _)| ordinates[index].displacement_m);
                let _ = write!(rows, ",{}", number(u_m));
            }
            if self.shape.is_repaired && self.shape.has_bands {
                let [lower_m, upper_m] = repaired.map_or([f64::NAN; 2], |(_, bands_m)| bands_m[place]);
                let _ = write!(rows, ",{},{}", number(lower_m), number(upper_m));
            }
            if self.shape.has_spread {
                let unknown = [f64::NAN; SPREAD.len()];
                for value_m in spread_m.get(place).unwrap_or(&unknown) {
                    let _ = write!(rows, ",{}", number(*value_m));
                }
            }
            rows.push('\n');
        }
    }

    /// The properties of a spectrum at the strengths of the map, null where there is none.
    fn map_properties(&self, (poe, infix): (&PoeNames, &str), spectrum: Option<Spectrum<'_>>) -> String {
        let mut properties = String::new();
        for place in 0..self.on_map.len() {
            for (quantity, value_m) in self.map_values((place, spectrum)) {
                let _ = write!(
                    properties,
                    ",\"{}\":{}",
                    self.property((poe, infix), quantity, place),
                    json_number(value_m)
                );
            }
        }
        properties
    }

    /// What the map shows at one of its strengths: the ordinate, and the limits of its band.
    fn map_values(
        &self,
        (place, spectrum): (usize, Option<Spectrum<'_>>),
    ) -> impl Iterator<Item = (&'static str, Option<f64>)> {
        let strength = self.on_map[place];
        let in_table = self.shape.strengths.iter().position(|own| *own == strength);
        let band_m = spectrum.zip(in_table).and_then(|((_, bands_m), place)| bands_m.get(place).copied());
        let limits = [0, 1].map(|at| (QUOTED_LIMITS[at], band_m.map(|of| of[at])));
        let ordinate_m = spectrum.map(|(ordinates, _)| ordinates[strength].displacement_m);
        [("u_m", ordinate_m)].into_iter().chain(limits.into_iter().filter(move |_| self.shape.has_bands))
    }

    /// The name of a quantity at one of the strengths of the map, such as `pgv_2pct_50yr_u_m_at_0.2`.
    fn property(&self, (poe, infix): (&PoeNames, &str), quantity: &str, place: usize) -> String {
        format!("{}{infix}_{quantity}_at_{}", poe.key, self.map_labels[place])
    }
}

const NO_EXPONENTIAL: &str = "the spectrum is not a decaying exponential: its coefficients mean nothing one by one";

/// What is wrong with the spectrum of a probability or its fit; empty where nothing is.
pub(super) fn problem(spectra: &Result<SiteSpectra, String>, poe: usize) -> String {
    match spectra.as_ref().map(|spectra| spectra.fits[poe].as_ref()) {
        Err(reason) => reason.clone(),
        Ok(Err(reason)) => format!("no fit: {reason}"),
        Ok(Ok(fit)) if fit.at_search_limit => NO_EXPONENTIAL.to_owned(),
        Ok(Ok(_)) => String::new(),
    }
}

/// The cells from `c0_m` to `bound_active`.
fn coefficient_cells(fit: Option<&ExponentialFit>) -> String {
    let cells = FIT.map(|(_, value)| format!("{},", fit_number(fit, value)));
    cells.concat() + &fit.map_or_else(String::new, |fit| fit.bound_active.to_string())
}

/// A number of a fit; nothing where there is none.
pub(super) fn fit_number(fit: Option<&ExponentialFit>, value: fn(&ExponentialFit) -> f64) -> String {
    number(fit.map_or(f64::NAN, value))
}

/// A number of a table; nothing where it is not known.
pub(super) fn number(value: f64) -> String {
    if value.is_nan() { String::new() } else { format!("{value:?}") }
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
        let mut taken = COEFFICIENTS.concat().into_iter().map(str::to_owned).collect();
        assert_eq!(distinct(&names, &mut taken), ["vs30", "table_problem", "table_vs30"]);
    }
}
