//! The files of many sites, written site by site.

use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use uplift_atomic_file::{AtomicFile, io_error};
use uplift_inputs::SiteList;
use uplift_job::JobError;
use uplift_job::checksum::checksum_of_file;
use uplift_job::outputs::{SITE_COEFFICIENTS, SITE_SPECTRA, beside};
use uplift_job::table::write_metadata;
use uplift_labelled::LabelledReader;
use uplift_result::layout::attribute::sites as attribute;
use uplift_result::{SITE_NAMES, SiteArrays};
use uplift_study::UniformRiskStudy;

use super::cube::{Cube, CubeRows};
use super::layout::{FEATURE, SiteRow, SiteTableLayout, SiteText, cell, json_text};
use crate::error::StudiesError;

/// Position of the map among the three files of text.
const MAP: usize = 2;
/// The tables beside the result file `result`: spectra, coefficients, and both as a map.
pub fn site_table_paths(result: &Path) -> [PathBuf; 3] {
    [SITE_SPECTRA, SITE_COEFFICIENTS, "sites.geojson"].map(|ending| beside(result, ending))
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

impl SiteTableFiles {
    /// Begin the files beside the result file `result`; `line` says where the numbers come from. They are in their
    /// places only after [`finish`](Self::finish).
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn create(result: &Path, study: &UniformRiskStudy, list: &SiteList, line: &str) -> Result<Self, StudiesError> {
        let layout = SiteTableLayout::new(study, list);
        let cube = Cube::create(result, study, list, &layout.shape, line)?;
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
        let path = SiteArrays::path(slice);
        let again = |path: &Path, why: &str| {
            let (file, slice) = (path.display(), slice.display());
            JobError::input(format!("{file}: {why}: repeat the run of {slice} with --again"))
        };
        let reader = LabelledReader::open(&path)
            .map_err(|error| JobError::input(format!("{error}: repeat the run of {} with --again", slice.display())))?;
        if !SiteArrays::is_of_digest(&reader, digest)? {
            return Err(again(&path, "is not of this result").into());
        }
        if let Some(texts) = &mut self.texts {
            let tables = reader.attributes::<String>("/", attribute::TABLES.name)?;
            for (number, path) in site_table_paths(slice).iter().enumerate() {
                if checksum_of_file(path).ok().as_ref() != tables.get(number) {
                    return Err(again(path, "is missing, or was changed since it was written").into());
                }
                texts.copy(number, path)?;
            }
        }
        self.cube.write(CubeRows::read(&reader, &self.layout.shape)?)?;
        Ok(attribute::FINDINGS.read(&reader, &SITE_NAMES)?)
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
        cube.sign(findings, checksums)?;
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
