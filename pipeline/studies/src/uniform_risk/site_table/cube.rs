//! The file of the arrays of many sites, written some sites at a time.

use std::path::{Path, PathBuf};

use uplift_inputs::SiteList;
use uplift_job::outputs::{SITES_KIND, mark};
use uplift_labelled::{AttributeValue, GrowingArray, LabelledReader, LabelledWriter};
use uplift_result::layout::attribute::{root, sites as attribute};
use uplift_result::layout::axis::{MEASURE, POE, SITE, STRENGTH};
use uplift_result::{
    NO_ORDINATE, SITE_CONSISTENCY, SITE_FLAGS, SITE_NAMES, SITE_PLACES, SITE_PROBLEMS, SiteArrays, SiteSpectrum,
};
use uplift_study::UniformRiskStudy;

use super::shape::{Shape, SiteValues};
use crate::error::StudiesError;

/// The file while it is being written.
pub(super) struct Cube {
    path: PathBuf,
    writer: LabelledWriter,
    /// In the order of [`CubeRows::floats`].
    arrays: Vec<GrowingArray<f64>>,
    flags: GrowingArray<u8>,
    problems: Vec<String>,
    /// Of the axes of the problems.
    lengths: [(&'static str, usize); 3],
}

/// Some sites as they stand in the file.
#[derive(Debug, Default)]
pub(super) struct CubeRows {
    /// Those of [`Shape::floats`], then those of [`Shape::consistency`].
    floats: Vec<Vec<f64>>,
    flags: Vec<u8>,
    problems: Vec<String>,
}

impl CubeRows {
    /// One site.
    pub(super) fn new(site: SiteValues<'_>, shape: &Shape) -> Self {
        let flags_of = |spectrum: &Option<SiteSpectrum>| match spectrum {
            Some(spectrum) => spectrum.flags.iter().map(|flag| flag.number()).collect(),
            None => vec![NO_ORDINATE; shape.strengths.len()],
        };
        let mut floats: Vec<Vec<f64>> = shape.floats().map(|own| own.values(&site, shape)).collect();
        for own in shape.consistency() {
            floats.push(site.consistency.iter().filter_map(|of| own.number(of, 0)).collect());
        }
        Self { floats, flags: site.plain.iter().flat_map(flags_of).collect(), problems: site.problems }
    }

    /// The sites of the file in `reader`, one of these arrays.
    pub(super) fn read(reader: &LabelledReader, shape: &Shape) -> Result<Self, StudiesError> {
        let of_spectra = shape.floats().map(|own| own.group.path(own.quantity, own.names()));
        let of_sites = shape.consistency().map(|own| SITE_CONSISTENCY.path(own, &SITE_NAMES));
        let floats = of_spectra.chain(of_sites).map(|path| Ok(reader.array::<f64>(&path)?.values));
        Ok(Self {
            floats: floats.collect::<Result<_, StudiesError>>()?,
            flags: reader.array::<u8>(&SITE_FLAGS.first_path(&SITE_NAMES))?.values,
            problems: reader.array::<String>(&SITE_PROBLEMS.first_path(&SITE_NAMES))?.values,
        })
    }
}

impl Cube {
    /// Begins the file beside `result` of the sites that `list` is asked for; `line` says where the numbers come from.
    pub(super) fn create(
        result: &Path,
        study: &UniformRiskStudy,
        list: &SiteList,
        shape: &Shape,
        line: &str,
    ) -> Result<Self, StudiesError> {
        let path = SiteArrays::path(result);
        let mut writer = LabelledWriter::create(&path)?;
        root::PROGRAM.write(&mut writer, &[], mark())?;
        root::KIND.write(&mut writer, &[], SITES_KIND)?;
        attribute::PROVENANCE.write(&mut writer, &SITE_NAMES, line)?;
        attribute::YEARS.write(&mut writer, &SITE_NAMES, study.risk.years)?;
        let sites = &list.sites[list.range.clone()];
        let names: Vec<String> = sites.iter().map(|site| site.name.to_string()).collect();
        SITE.write_texts(&mut writer, &[], &names)?;
        let measures: Vec<String> = list.exports.iter().map(|export| export.measure.key().to_owned()).collect();
        MEASURE.write_texts(&mut writer, &[], &measures)?;
        POE.write(&mut writer, &[("<years>", &study.risk.years.to_string())], &study.risk.poe)?;
        let strengths: Vec<f64> = shape.strengths.iter().map(|&index| study.strengths[index]).collect();
        STRENGTH.write(&mut writer, &[], &strengths)?;
        let lengths = [(SITE.name, sites.len()), (MEASURE.name, shape.measures), (POE.name, shape.poes)];
        let places: Vec<[f64; 2]> = sites.iter().map(|site| [site.longitude_deg, site.latitude_deg]).collect();
        SITE_PLACES.write_rows(&mut writer, &SITE_NAMES, &lengths, places.iter().map(Some))?;
        let mut arrays = Vec::new();
        for own in shape.floats() {
            arrays.push(own.group.grow(own.quantity, &mut writer, own.names())?);
        }
        for own in shape.consistency() {
            arrays.push(SITE_CONSISTENCY.grow(own, &mut writer, &SITE_NAMES)?);
        }
        let flags = SITE_FLAGS.grow(&SITE_FLAGS.quantities[0], &mut writer, &SITE_NAMES)?;
        Ok(Self { path, writer, arrays, flags, problems: Vec::new(), lengths })
    }

    /// Appends some sites.
    pub(super) fn write(&mut self, rows: CubeRows) -> Result<(), StudiesError> {
        for (array, values) in self.arrays.iter_mut().zip(&rows.floats) {
            self.writer.append(array, values)?;
        }
        self.writer.append(&mut self.flags, &rows.flags)?;
        self.problems.extend(rows.problems);
        Ok(())
    }

    /// Sets what was found of the sites, and the checksums of the `tables` of a slice.
    pub(super) fn sign(&mut self, findings: &str, tables: impl Into<AttributeValue>) -> Result<(), StudiesError> {
        attribute::FINDINGS.write(&mut self.writer, &SITE_NAMES, findings)?;
        Ok(self.writer.attribute("/", attribute::TABLES.name, tables)?)
    }

    /// Puts the file in its place, and says where that is.
    pub(super) fn finish(self) -> Result<PathBuf, StudiesError> {
        let Self { path, mut writer, arrays, flags, problems, lengths } = self;
        for array in arrays {
            writer.complete(array)?;
        }
        writer.complete(flags)?;
        SITE_PROBLEMS.write_rows(&mut writer, &SITE_NAMES, &lengths, problems.iter().map(Some))?;
        writer.finish()?;
        Ok(path)
    }
}
