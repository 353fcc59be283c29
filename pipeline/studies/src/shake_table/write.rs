//! The result of a study of a shaking table, written as docs/hdf5-layout.md describes it.

use std::path::Path;

use uplift_labelled::LabelledWriter;
use uplift_result::layout::{attribute, axis};
use uplift_result::{DESIGN_SPECTRUM, DIRECTIONS, Provenance, ShakeTable, TABLE_SPECTRA, TableSpectra};
use uplift_study::{Kind, ShakeTableStudy};

use crate::error::StudiesError;

/// All that a study of a shaking table computed.
#[derive(Debug)]
pub struct ShakeTableOutcome<'a> {
    /// The study.
    pub study: &'a ShakeTableStudy,
    /// The tests.
    pub table: &'a ShakeTable,
    /// Wall time for them, s.
    pub seconds: f64,
    /// What a reader should know before using the numbers.
    pub warnings: &'a [String],
    /// Where the numbers come from.
    pub provenance: &'a Provenance,
}

/// Writes `outcome` to `path`, atomically: an earlier file survives a failure.
///
/// # Errors
/// Whatever keeps the file from being written, a full disk for instance.
pub(crate) fn write_shake_table(path: &Path, outcome: &ShakeTableOutcome<'_>) -> Result<(), StudiesError> {
    let ShakeTableOutcome { study, table, .. } = outcome;
    let mut writer = LabelledWriter::create(path)?;
    let toml = study.to_toml()?;
    let own = (study.title.as_str(), study.gravity_m_s2, toml.as_str());
    outcome.provenance.write(&mut writer, own, (&table.records, table.synthetic), outcome.warnings)?;
    attribute::root::KIND.write(&mut writer, &[], Kind::ShakeTable.key())?;
    let names: Vec<String> = table.levels.iter().map(|level| level.name.clone()).collect();
    let excitations: Vec<String> = table.excitations.iter().map(|one| one.exc_id.clone()).collect();
    axis::LEVEL.write_texts(&mut writer, &[], &names)?;
    axis::EXCITATION.write_texts(&mut writer, &[], &excitations)?;
    table.write(&mut writer)?;
    table.spectra.iter().try_for_each(|spectra| write_spectra(&mut writer, spectra, excitations.len()))?;
    attribute::shake_table::STRUCTURE.write(&mut writer, &[], table.structure.as_str())?;
    attribute::shake_table::LENGTH_SCALE.write(&mut writer, &[], table.length_scale)?;
    attribute::shake_table::ANALYSES.write(&mut writer, &[], table.tests.len() as u64)?;
    attribute::shake_table::SECONDS.write(&mut writer, &[], outcome.seconds)?;
    writer.finish()?;
    Ok(())
}

fn write_spectra(writer: &mut LabelledWriter, spectra: &TableSpectra, excitations: usize) -> Result<(), StudiesError> {
    axis::DIRECTION.write_texts(writer, &[], &DIRECTIONS.map(str::to_owned))?;
    axis::PERIOD.write(writer, &[], &spectra.periods_s)?;
    let periods = (axis::PERIOD.name, spectra.periods_s.len());
    let lengths = [(axis::EXCITATION.name, excitations), (axis::DIRECTION.name, DIRECTIONS.len()), periods];
    TABLE_SPECTRA.write(writer, &[], &lengths, spectra)?;
    spectra.design_m_s2.iter().try_for_each(|design| DESIGN_SPECTRUM.write(writer, &[], &lengths, design))?;
    Ok(())
}
