//! The files of many sites, written site by site.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use uplift_atomic_file::{AtomicFile, io_error};
use uplift_inputs::{ListedSite, SiteList};
use uplift_job::JobError;
use uplift_job::checksum::checksum_of_file;
use uplift_job::outputs::beside;
use uplift_job::table::{neutral, write_metadata};
use uplift_job::text::nearest;
use uplift_labelled::LabelledReader;
use uplift_regression::ExponentialFit;
use uplift_result::flag_word;
use uplift_risk::Ordinate;
use uplift_study::{Repair, UniformRiskStudy};
use uplift_uniform_risk::SiteSpectra;

use super::consistent;
use super::cube::{Cube, CubeRows, FINDINGS, PROVENANCE, Shape, TABLES, cube_path};
use super::repair::SiteConsistency;
use crate::error::StudiesError;

/// Strengths of which a map shows ordinates, unless the study names some.
pub const SHOWN_ON_MAP: [f64; 3] = [0.1, 0.2, 0.4];
/// Position of the map among the three files of text.
const MAP: usize = 2;
/// How the line of a site on the map begins.
const FEATURE: &str = "{\"type\":\"Feature\",";
/// Columns of the spectra, before their bands.
const SPECTRA: [&str; 9] = ["site", "longitude", "latitude", "im", "poe", "years", "strength", "u_m", "flag"];
/// Columns of the coefficients, before those of the study's own table.
const COEFFICIENTS: [&str; 12] =
    ["site", "longitude", "latitude", "im", "poe", "years", "c0_m", "c1", "c2_m", "rmse_m", "bound_active", "problem"];

/// The tables beside the result file `result`: spectra, coefficients, and both as a map.
pub fn site_table_paths(result: &Path) -> [PathBuf; 3] {
    ["sites.csv", "sites.coefficients.csv", "sites.geojson"].map(|ending| beside(result, ending))
}

/// The files of many sites while they are being written; those not finished are removed.
pub struct SiteTableFiles {
    cube: Cube,
    /// None where the study wants no tables.
    texts: Option<Texts>,
    layout: SiteTableLayout,
    /// Whether they are of a slice, of which a join has to know that they are whole.
    is_slice: bool,
}

/// The two tables and the map.
struct Texts {
    paths: [PathBuf; 3],
    files: [GrowingFile; 3],
    features: u64,
    /// Where the numbers come from.
    line: String,
    /// Names of the columns of the two tables.
    columns: [Vec<String>; 2],
}

/// What the rows and properties are called.
#[derive(Debug, Clone)]
pub struct SiteTableLayout {
    years: f64,
    strengths: Vec<f64>,
    /// Positions of the strengths in the table of spectra.
    in_table: Vec<usize>,
    /// Positions of the strengths on the map, all of them in the table.
    on_map: Vec<usize>,
    /// Their names.
    map_labels: Vec<String>,
    /// `[export]`.
    measures: Vec<MeasureNames>,
    /// Names of the cells carried along, as keys of JSON.
    carried: Vec<String>,
    /// Whether there are repaired spectra beside the plain ones.
    is_repaired: bool,
    has_bands: bool,
    has_texts: bool,
    /// Of the arrays.
    shape: Shape,
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
    text: Option<SiteText>,
    rows: CubeRows,
}

/// A site as it stands in the tables and on the map.
struct SiteText {
    spectra: String,
    coefficients: String,
    feature: String,
}

impl SiteTableFiles {
    /// Begin the files beside the result file `result`; `line` says where the numbers come from. They are in their
    /// places only after [`finish`](Self::finish).
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn create(result: &Path, study: &UniformRiskStudy, list: &SiteList, line: &str) -> Result<Self, StudiesError> {
        let layout = SiteTableLayout::new(study, list);
        let cube = Cube::create(&cube_path(result), study, list, &layout.shape, line)?;
        let texts = layout.has_texts.then(|| Texts::create(result, &layout, &list.carried, line)).transpose()?;
        let is_slice = study.site_table.as_ref().is_some_and(|table| table.slice.is_some());
        Ok(Self { cube, texts, layout, is_slice })
    }

    /// What the rows and properties are called.
    pub fn layout(&self) -> &SiteTableLayout {
        &self.layout
    }

    /// Append a site.
    ///
    /// # Errors
    /// A disk that is full, for instance.
    pub fn write(&mut self, site: SiteRow) -> Result<(), StudiesError> {
        self.cube.write(site.rows)?;
        if let (Some(texts), Some(text)) = (&mut self.texts, &site.text) {
            texts.write(text)?;
        }
        Ok(())
    }

    /// Append the sites of the slice whose result is at `slice`; returns what was found of them.
    ///
    /// # Errors
    /// Files of the slice that are missing or not as they were written.
    pub(super) fn write_slice(&mut self, slice: &Path, digest: &str) -> Result<String, StudiesError> {
        let path = cube_path(slice);
        let again = |path: &Path, why: &str| {
            let (file, slice) = (path.display(), slice.display());
            JobError::input(format!("{file}: {why}: repeat the run of {slice} with --again"))
        };
        let reader = LabelledReader::open(&path).map_err(|error| again(&path, &error.to_string()))?;
        if !reader.attribute_text("/", PROVENANCE)?.contains(&format!("study digest {digest};")) {
            return Err(again(&path, "is not of this result").into());
        }
        if let Some(texts) = &mut self.texts {
            let tables = reader.attribute_texts("/", TABLES)?;
            for (number, path) in site_table_paths(slice).iter().enumerate() {
                if checksum_of_file(path).ok().as_ref() != tables.get(number) {
                    return Err(again(path, "is missing, or was changed since it was written").into());
                }
                texts.copy(number, path)?;
            }
        }
        self.cube.write(CubeRows::read(&reader, &self.layout.shape)?)?;
        Ok(reader.attribute_text("/", FINDINGS)?)
    }

    /// Put the files in their places, with what was found of their sites.
    ///
    /// # Errors
    /// A disk that is full, for instance; earlier files are then as they were.
    pub fn finish(self, findings: &str) -> Result<Vec<PathBuf>, StudiesError> {
        let Self { mut cube, mut texts, is_slice, .. } = self;
        let mut checksums = Vec::new();
        if let Some(texts) = &mut texts {
            texts.complete()?;
            if is_slice {
                checksums = texts.checksums()?;
            }
        }
        cube.attribute(FINDINGS, findings)?;
        cube.attribute(TABLES, checksums)?;
        let mut paths = vec![cube.finish()?];
        if let Some(texts) = texts {
            texts.files.into_iter().try_for_each(GrowingFile::put_in_place)?;
            paths.extend(texts.paths);
        }
        Ok(paths)
    }
}

impl Texts {
    fn create(result: &Path, layout: &SiteTableLayout, carried: &[String], line: &str) -> Result<Self, StudiesError> {
        let paths = site_table_paths(result);
        let [spectra, coefficients, map] = &paths;
        let files = [GrowingFile::create(spectra)?, GrowingFile::create(coefficients)?, GrowingFile::create(map)?];
        let columns = [layout.spectra_columns(), layout.coefficient_columns(carried)];
        let mut texts = Self { paths, files, features: 0, line: line.to_owned(), columns };
        for number in 0..texts.columns.len() {
            let header = texts.header(number);
            texts.files[number].write(&header)?;
        }
        texts.files[MAP].write(&format!(
            "{{\"type\":\"FeatureCollection\",\n\"provenance\":{},\n\"features\":[",
            json_text(line)
        ))?;
        Ok(texts)
    }

    /// The first line of a table.
    fn header(&self, table: usize) -> String {
        let cells: Vec<String> = self.columns[table].iter().map(|name| cell(name)).collect();
        format!("{}\n", cells.join(","))
    }

    fn write(&mut self, site: &SiteText) -> Result<(), StudiesError> {
        self.files[0].write(&site.spectra)?;
        self.files[1].write(&site.coefficients)?;
        self.write_feature(&site.feature)
    }

    fn write_feature(&mut self, feature: &str) -> Result<(), StudiesError> {
        self.files[MAP].write(if self.features == 0 { "\n" } else { ",\n" })?;
        self.features += 1;
        self.files[MAP].write(feature)
    }

    /// Appends what the file of a slice at `path` holds behind its head.
    fn copy(&mut self, number: usize, path: &Path) -> Result<(), StudiesError> {
        let read = |error| io_error(path, "read the file")(error);
        let mut file = BufReader::new(File::open(path).map_err(read)?);
        if number == MAP {
            for line in file.lines() {
                let line = line.map_err(read)?;
                // one feature a line: a line break within a text is escaped
                if line.starts_with(FEATURE) {
                    self.write_feature(line.strip_suffix(',').unwrap_or(&line))?;
                }
            }
            return Ok(());
        }
        let mut head = vec![0; self.header(number).len()];
        file.read_exact(&mut head).map_err(read)?;
        let own = &mut self.files[number];
        std::io::copy(&mut file, &mut own.writer).map_err(io_error(own.place.target(), "write the file"))?;
        Ok(())
    }

    /// Everything is written, and stands beside the places of the files.
    fn complete(&mut self) -> Result<(), StudiesError> {
        self.files[MAP].write("\n]}\n")?;
        for file in &mut self.files {
            file.flush()?;
        }
        for (path, names) in self.paths.iter().zip(&self.columns) {
            write_metadata(path, &self.line, names.iter().map(String::as_str))?;
        }
        Ok(())
    }

    fn checksums(&self) -> Result<Vec<String>, StudiesError> {
        self.files.iter().map(|file| Ok(checksum_of_file(file.place.partial())?)).collect()
    }
}

impl SiteTableLayout {
    fn new(study: &UniformRiskStudy, list: &SiteList) -> Self {
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
        let shape = Shape::new(study, list, &in_table);
        let mut layout = Self {
            years,
            strengths: study.strengths.to_vec(),
            in_table,
            on_map,
            map_labels,
            measures: (list.exports.iter())
                .map(|export| measure_names(export.measure.key(), export.measure.label()))
                .collect(),
            carried: Vec::new(),
            is_repaired: study.consistency.repair == Repair::Weights,
            has_bands: study.site_table.as_ref().is_some_and(|table| table.bands),
            has_texts: study.output.csv,
            shape,
        };
        let mut taken = layout.property_names();
        layout.carried = distinct(&list.carried, &mut taken).iter().map(|name| json_text(name)).collect();
        layout
    }

    /// Positions of the strengths in the table of spectra.
    pub(super) fn in_table(&self) -> &[usize] {
        &self.in_table
    }

    fn spectra_columns(&self) -> Vec<String> {
        let mut columns = SPECTRA.to_vec();
        if self.has_bands {
            columns.extend(["lower_m", "upper_m"]);
        }
        if self.is_repaired {
            columns.extend(&consistent::SPECTRA[..if self.has_bands { 3 } else { 1 }]);
        }
        columns.into_iter().map(str::to_owned).collect()
    }

    fn coefficient_columns(&self, carried: &[String]) -> Vec<String> {
        let repaired = consistent::COEFFICIENTS.into_iter().filter(|_| self.is_repaired);
        let own: Vec<String> = COEFFICIENTS.into_iter().chain(repaired).map(str::to_owned).collect();
        let carried = distinct(carried, &mut own.iter().cloned().collect());
        own.into_iter().chain(carried).collect()
    }

    /// The properties of a feature but for cells carried along.
    fn property_names(&self) -> BTreeSet<String> {
        let mut names: BTreeSet<String> = ["name", "problem"].map(str::to_owned).into();
        for names_of_poe in self.measures.iter().flat_map(|measure| &measure.poes) {
            names.extend(COEFFICIENTS_ON_MAP.map(|(ending, _)| format!("{}{ending}", names_of_poe.key)));
            for infix in ["", "_consistent"].into_iter().take(1 + usize::from(self.is_repaired)) {
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
                self.spectrum_rows(&mut text.spectra, &head, spectrum, repaired);
                let problem = problem(spectra, row);
                if !problem.is_empty() && spectrum.is_some() {
                    problems.push(format!("{}: {problem}", poe.key));
                }
                let own = coefficient_cells(fit);
                let of_repair = consistency.map(|own| consistent::coefficient_cells(own, row)).unwrap_or_default();
                let _ = writeln!(text.coefficients, "{head},{own},{}{of_repair}{tail}", cell(&problem));
                properties += &self.map_properties((poe, ""), spectrum);
                if self.is_repaired {
                    properties += &self.map_properties((poe, "_consistent"), repaired);
                }
                for (ending, value) in COEFFICIENTS_ON_MAP {
                    let _ = write!(properties, ",\"{}{ending}\":{}", poe.key, json_number(fit.map(value)));
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
        spectrum: Option<Spectrum<'_>>,
        repaired: Option<Spectrum<'_>>,
    ) {
        let Some((ordinates, bands_m)) = spectrum else { return };
        for (place, &index) in self.in_table.iter().enumerate() {
            let Ordinate { displacement_m, flag, .. } = ordinates[index];
            let _ = write!(rows, "{head},{:?},{displacement_m:?},{}", self.strengths[index], flag_word(flag));
            for limit_m in bands_m.get(place).into_iter().flatten() {
                let _ = write!(rows, ",{}", number(*limit_m));
            }
            if self.is_repaired {
                let u_m = repaired.map_or(f64::NAN, |(ordinates, _)| ordinates[index].displacement_m);
                let _ = write!(rows, ",{}", number(u_m));
            }
            if self.is_repaired && self.has_bands {
                let [lower_m, upper_m] = repaired.map_or([f64::NAN; 2], |(_, bands_m)| bands_m[place]);
                let _ = write!(rows, ",{},{}", number(lower_m), number(upper_m));
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
        let in_table = self.in_table.iter().position(|own| *own == strength);
        let band_m = spectrum.zip(in_table).and_then(|((_, bands_m), place)| bands_m.get(place).copied());
        let limits = [("lower_m", band_m.map(|of| of[0])), ("upper_m", band_m.map(|of| of[1]))];
        let ordinate_m = spectrum.map(|(ordinates, _)| ordinates[strength].displacement_m);
        [("u_m", ordinate_m)].into_iter().chain(limits.into_iter().filter(move |_| self.has_bands))
    }

    /// The name of a quantity at one of the strengths of the map, such as `pgv_2pct_50yr_u_m_at_0.2`.
    fn property(&self, (poe, infix): (&PoeNames, &str), quantity: &str, place: usize) -> String {
        format!("{}{infix}_{quantity}_at_{}", poe.key, self.map_labels[place])
    }
}

const NO_EXPONENTIAL: &str = "the spectrum is no decaying exponential: its coefficients mean nothing one by one";

/// What is wrong with the spectrum of a probability or its fit; empty where nothing is.
pub(super) fn problem(spectra: &Result<SiteSpectra, String>, poe: usize) -> String {
    match spectra.as_ref().map(|spectra| spectra.fits[poe].as_ref()) {
        Err(reason) => reason.clone(),
        Ok(Err(reason)) => format!("no fit: {reason}"),
        Ok(Ok(fit)) if fit.at_search_limit => NO_EXPONENTIAL.to_owned(),
        Ok(Ok(_)) => String::new(),
    }
}

/// Ending of a property with what it holds.
type Coefficient = (&'static str, fn(&ExponentialFit) -> f64);

const COEFFICIENTS_ON_MAP: [Coefficient; 4] =
    [("_c0_m", |fit| fit.c0), ("_c1", |fit| fit.c1), ("_c2_m", |fit| fit.c2), ("_rmse_m", |fit| fit.rmse)];

/// The cells from `c0_m` to `bound_active`.
fn coefficient_cells(fit: Option<&ExponentialFit>) -> String {
    fit.map_or_else(
        || ",,,,".to_owned(),
        |fit| {
            format!(
                "{},{},{},{},{}",
                number(fit.c0),
                number(fit.c1),
                number(fit.c2),
                number(fit.rmse),
                fit.bound_active
            )
        },
    )
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

fn json_text(text: &str) -> String {
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

/// A file that is written bit by bit, and put in its place when it is complete.
#[derive(Debug)]
struct GrowingFile {
    place: AtomicFile,
    writer: BufWriter<File>,
}

impl GrowingFile {
    fn create(path: &Path) -> Result<Self, StudiesError> {
        let place = AtomicFile::reserve(path)?;
        let file = File::options().write(true).open(place.partial()).map_err(io_error(path, "write the file"))?;
        Ok(Self { place, writer: BufWriter::with_capacity(1 << 18, file) })
    }

    fn write(&mut self, text: &str) -> Result<(), StudiesError> {
        Ok(self.writer.write_all(text.as_bytes()).map_err(io_error(self.place.target(), "write the file"))?)
    }

    fn flush(&mut self) -> Result<(), StudiesError> {
        Ok(self.writer.flush().map_err(io_error(self.place.target(), "write the file"))?)
    }

    fn put_in_place(self) -> Result<(), StudiesError> {
        Ok(self.place.replace()?)
    }
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
        let mut taken = COEFFICIENTS.map(str::to_owned).into();
        assert_eq!(distinct(&names, &mut taken), ["vs30", "table_problem", "table_vs30"]);
    }
}
