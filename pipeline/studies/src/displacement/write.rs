//! The result of a study of displacement spectra, written as docs/hdf5-layout.md describes it.

use std::collections::BTreeSet;
use std::path::Path;

use uplift_inputs::{NamedSet, RecordSets, SetRecord};
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::layout::{attribute, axis};
use uplift_result::{
    BOUNDS, MOTIONS, Provenance, ROUNDED_SPECTRA, RULES, SET_SPECTRA, SPECTRA, SetSpectra, StoredMotion,
    StoredStructures,
};
use uplift_spectra::{Motion, MotionSet, Noisy};
use uplift_study::{DisplacementStudy, Kind, Structures};

use super::{design_rows as design, printed};
use crate::displacement::Designs;
use crate::error::StudiesError;

/// All that a study of displacement spectra computed.
#[derive(Debug)]
pub struct DisplacementOutcome<'a> {
    /// The study.
    pub study: &'a DisplacementStudy,
    /// Its records, in sets.
    pub records: &'a RecordSets,
    /// The motions of each set.
    pub sets: &'a [MotionSet<'a>],
    /// The spectra of each set.
    pub spectra: &'a [SetSpectra],
    /// The printed ordinates of each set with their range over scale factors that differ by rounding, over `[way, line,
    /// percentile, printed abscissa]`, m.
    pub rounding: &'a [Vec<Noisy>],
    /// The design examples, if it has some.
    pub designs: Option<&'a Designs>,
    /// Nonlinear time histories of the spectra.
    pub analyses: u64,
    /// Wall time for these, s.
    pub seconds: f64,
    /// What a reader should know before using the numbers.
    pub warnings: &'a [String],
    /// Where the numbers come from.
    pub provenance: &'a Provenance,
}

impl DisplacementOutcome<'_> {
    /// Lengths of the axes of all arrays but for motions.
    fn lengths(&self, structures: &StoredStructures) -> Vec<(&'static str, usize)> {
        let DisplacementStudy { scaling, percentiles, structures: of_study, .. } = self.study;
        let ([abscissa, printed_axis], abscissae) = (structures.abscissa_axes(), of_study.abscissa());
        let mut lengths = structures.line_axes();
        lengths.extend([
            (axis::RECORD_SET.name, self.sets.len()),
            (axis::SCALING.name, scaling.to.len()),
            (axis::SCALED_BY.name, scaling.by.len()),
            (axis::PERCENTILE.name, percentiles.len()),
            (abscissa, abscissae.len()),
            (printed_axis, printed(abscissae).len()),
            (axis::RULE.name, RULES.len()),
            (axis::BOUND.name, BOUNDS.len()),
        ]);
        lengths
    }
}

/// Write `outcome` to `path`, atomically: an earlier file survives a failure.
///
/// # Errors
/// Whatever keeps the file from being written, a full disk for instance.
pub(crate) fn write_displacements(path: &Path, outcome: &DisplacementOutcome<'_>) -> Result<(), StudiesError> {
    let mut writer = LabelledWriter::create(path)?;
    write_root(&mut writer, outcome)?;
    let structures = StoredStructures::from(&outcome.study.structures);
    let (names, lengths) = (structures.names(), outcome.lengths(&structures));
    write_axes(&mut writer, outcome)?;
    SPECTRA.write_rows(&mut writer, &names, &lengths, outcome.spectra.iter().map(Some))?;
    ROUNDED_SPECTRA.write_rows(&mut writer, &names, &lengths, outcome.rounding.iter().map(Some))?;
    attribute::spectra::ANALYSES.write(&mut writer, &[], outcome.analyses)?;
    attribute::spectra::SECONDS.write(&mut writer, &[], outcome.seconds)?;
    let mut taken = BTreeSet::new();
    for ((set, motions), spectra) in outcome.records.sets.iter().zip(outcome.sets).zip(outcome.spectra) {
        let axis = axis::motion(&set.name, &mut taken);
        let names = [&names[..], &[("<set>", &set.name), ("<motion>", &axis)]].concat();
        let lengths = [&lengths[..], &[(&axis, motions.motions().len())]].concat();
        let ids: Vec<String> = motions.motions().iter().map(|motion| motion.id.clone()).collect();
        axis::MOTION.write_texts(&mut writer, &names, &ids)?;
        SET_SPECTRA.write(&mut writer, &names, &lengths, spectra)?;
        let stored = stored_motions(outcome.records, set, motions);
        MOTIONS.write_rows(&mut writer, &names, &lengths, stored.iter().map(Some))?;
        attribute::set::RECORDS.write(&mut writer, &names, set.members.len() as u64)?;
        attribute::set::TAG.write(&mut writer, &names, set.tag.as_str())?;
        attribute::set::MEDIAN_PGA_G.write(&mut writer, &names, motions.median_pga_g())?;
        attribute::set::MEDIAN_PGV_CM_S.write(&mut writer, &names, motions.median_pgv_cm_s())?;
    }
    if let (Some(designs), Some(plan)) = (outcome.designs, &outcome.study.design) {
        design::write(&mut writer, outcome.study, plan, designs, &lengths)?;
    }
    writer.finish()?;
    Ok(())
}

fn write_root(writer: &mut LabelledWriter, outcome: &DisplacementOutcome<'_>) -> Result<(), StudiesError> {
    let DisplacementOutcome { study, records, .. } = outcome;
    let toml = study.to_toml()?;
    let own = (study.title.as_str(), study.gravity_m_s2, toml.as_str());
    outcome.provenance.write(writer, own, (&records.description, records.synthetic), outcome.warnings)?;
    attribute::root::KIND.write(writer, &[], Kind::Displacement.key())?;
    let structure = match study.structures {
        Structures::Oscillators(_) => "oscillator",
        Structures::Blocks(_) => "block",
    };
    attribute::root::STRUCTURE.write(writer, &[], structure)?;
    Ok(())
}

fn write_axes(writer: &mut LabelledWriter, outcome: &DisplacementOutcome<'_>) -> Result<(), LabelledError> {
    let study = outcome.study;
    let names: Vec<String> = outcome.records.sets.iter().map(|set| set.name.clone()).collect();
    axis::RECORD_SET.write_texts(writer, &[], &names)?;
    let to: Vec<String> = study.scaling.to.iter().map(ToString::to_string).collect();
    axis::SCALING.write_texts(writer, &[], &to)?;
    let by: Vec<String> = study.scaling.by.iter().map(|by| by.key().to_owned()).collect();
    axis::SCALED_BY.write_texts(writer, &[], &by)?;
    let printed_axis = match &study.structures {
        Structures::Oscillators(family) => {
            axis::UPLIFT_DISPLACEMENT.write(writer, &[], &family.uplift_displacement_m)?;
            axis::CAPACITY.write(writer, &[], &family.capacity_m)?;
            axis::STRENGTH.write(writer, &[], &family.strengths)?;
            axis::PRINTED_STRENGTH
        }
        Structures::Blocks(family) => {
            axis::HEIGHT.write(writer, &[], &family.height_m)?;
            axis::SLENDERNESS.write(writer, &[], &family.slendernesses)?;
            axis::PRINTED_SLENDERNESS
        }
    };
    let abscissae = study.structures.abscissa();
    let shown: Vec<f64> = printed(abscissae).into_iter().map(|at| abscissae[at]).collect();
    printed_axis.write(writer, &[], &shown)?;
    axis::PERCENTILE.write(writer, &[], &study.percentiles)?;
    axis::BOUND.write_texts(writer, &[], &BOUNDS.map(str::to_owned))
}

/// What a result holds of the motions of a set: two a record.
pub(super) fn stored_motions(records: &RecordSets, set: &NamedSet, motions: &MotionSet<'_>) -> Vec<StoredMotion> {
    let components = records.records_of(set).flat_map(|record| [(record, 0), (record, 1)]);
    let of = |(motion, (record, which)): (&Motion<'_>, (&SetRecord, usize))| {
        let text = |key: &str| record.pair.metadata.get(key).cloned().unwrap_or_default();
        StoredMotion {
            pga_g: motion.pga_g,
            pgv_cm_s: motion.pgv_cm_s,
            record_pga_g: motion.record_pga_g,
            record_pgv_cm_s: motion.record_pgv_cm_s,
            record: record.pair.id.clone(),
            component: format!("h{}", which + 1),
            event: text("event"),
            station: text("station"),
            magnitude: record.number("magnitude"),
            rrup_km: record.number("rrup_km"),
            vs30: record.number("vs30"),
            dt_s: motion.accelerogram.dt_s(),
            samples: u32::try_from(motion.accelerogram.len()).unwrap_or(u32::MAX),
            checksum: record.checksums[which].clone(),
        }
    };
    motions.motions().iter().zip(components).map(of).collect()
}
