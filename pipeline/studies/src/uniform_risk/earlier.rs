//! The stripes of an earlier result, as far as they are those of this study.

use std::collections::HashMap;
use std::path::Path;

use uplift_engine::checkpoint::oscillator_key;
use uplift_ida::{Axes, Cells};
use uplift_inputs::{Record, RecordSet, motion_keys};
use uplift_labelled::{LabelledError, LabelledReader};
use uplift_result::declared::measure_names;
use uplift_result::layout::attribute::stripes::OSCILLATOR_KEY;
use uplift_result::layout::axis;
use uplift_result::{FACTORS, IMPACTS, INTENSITY, MOTION_KEYS, PEAKS, ResultFile, intensity_names};
use uplift_study::{MeasurePlan, UniformRiskStudy};

use crate::error::StudiesError;

/// An earlier result at the place of the one to come.
pub struct EarlierStripes {
    reader: LabelledReader,
}

impl EarlierStripes {
    /// The result at `path`; none if there is none, or one that is not as it was written.
    pub fn open(path: &Path) -> Option<Self> {
        LabelledReader::open(path).ok().map(|reader| Self { reader })
    }

    /// Puts into `cells` what the file knows of the stripes that `study` asks for with `measure`: cells of the same
    /// motion, intensity, oscillator, strength and level, by the same version of the solver.
    ///
    /// # Errors
    /// A file that is damaged, or of another layout: it knows nothing.
    pub fn fill(
        &self,
        study: &UniformRiskStudy,
        measure: &MeasurePlan,
        set: &RecordSet,
        motions: &[String],
        cells: &mut Cells,
    ) -> Result<(), LabelledError> {
        let reader = &self.reader;
        let names = measure_names(measure.measure);
        if !reader.exists(&PEAKS.group(&names)) || OSCILLATOR_KEY.read(reader, &names)? != oscillator_key(study) {
            return Ok(());
        }
        if reader.exists(&FACTORS.first_path(&names)) {
            return Ok(()); // its factors are not those of the levels
        }
        let stored_motions = reader.array::<String>(&MOTION_KEYS.first_path(&[]))?.values;
        let intensities = reader.array::<f64>(&INTENSITY.first_path(&intensity_names(measure.measure)))?.values;
        let positions = |values: &[f64]| -> HashMap<u64, usize> {
            values.iter().enumerate().map(|(index, value)| (value.to_bits(), index)).collect()
        };
        let strengths = reader.axis::<f64>(axis::STRENGTH.name)?;
        let levels = reader.axis::<f64>(&axis::STRIPE_LEVEL.for_measure(measure.measure))?;
        let edp_m = reader.array::<f64>(&PEAKS.first_path(&names))?;
        let impacts = reader.array::<u32>(&IMPACTS.first_path(&names))?;
        let stored = Axes { motions: stored_motions.len(), systems: strengths.len(), scales: levels.len() };
        let shape = [stored.motions, stored.systems, stored.scales];
        if edp_m.shape != shape || impacts.shape != shape || intensities.len() != stored.motions {
            return Ok(());
        }
        let records: HashMap<(&str, u64), usize> = (stored_motions.iter().zip(&intensities).enumerate())
            .map(|(index, (motion, intensity))| ((motion.as_str(), intensity.to_bits()), index))
            .collect();
        let (of_strength, of_level) = (positions(&strengths), positions(&levels));
        for (record, (motion, asked)) in motions.iter().zip(&set.records).enumerate() {
            let intensity = asked.intensity(measure.measure).to_bits();
            let Some(&from_record) = records.get(&(motion.as_str(), intensity)) else { continue };
            for (strength, value) in study.strengths.iter().enumerate() {
                let Some(&from_strength) = of_strength.get(&value.to_bits()) else { continue };
                for (level, value) in measure.levels.iter().enumerate() {
                    let Some(&from_level) = of_level.get(&value.to_bits()) else { continue };
                    let index = stored.cell([from_record, from_strength, from_level]);
                    cells.set([record, strength, level], edp_m.values[index], impacts.values[index]);
                }
            }
        }
        Ok(())
    }
}

/// Whether the result in `file` was computed from these `records` as the manifest describes them: the motions, what
/// they are scaled by, and their metadata.
///
/// # Errors
/// A file that is damaged or of another kind.
pub fn is_of_records(file: &ResultFile, study: &UniformRiskStudy, records: &[Record]) -> Result<bool, StudiesError> {
    let kept = file.records()?;
    let same = |kept: &[f64], own: &dyn Fn(&Record) -> f64| {
        kept.iter().map(|value| value.to_bits()).eq(records.iter().map(|record| own(record).to_bits()))
    };
    let mut is_same = kept.motion_sha256 == motion_keys(records)
        && same(&kept.pga_g, &|record| record.pga_g)
        && same(&kept.pgv_cm_s, &|record| record.pgv_cm_s)
        && same(&kept.magnitude, &|record| record.number("magnitude"))
        && same(&kept.rrup_km, &|record| record.number("rrup_km"))
        && same(&kept.vs30, &|record| record.number("vs30"));
    for plan in &study.measures {
        is_same &= file.oscillator_key(plan.measure)? == oscillator_key(study);
    }
    Ok(is_same)
}
