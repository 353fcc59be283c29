//! The models of a structure, and the analyses that show whether they overturn.

use uplift_engine::analysis::{Analysed, LabelledPlan, Work};
use uplift_ida::System;
use uplift_inputs::RecordSet;
use uplift_job::JobError;
use uplift_spectra::nudges;
use uplift_structure::UncertainQuantity;
use uplift_study::{Structure, Uncertainty, UniformRiskStudy};
use uplift_uniform_risk::{SpectraOfResult, StudyOfResult, plan_stripes};

use super::options::OverturningOptions;
use crate::error::DesignError;
use crate::models::{block, kind, oscillator};
use crate::opening::{ShakenRecords, choose_measure, records_and_pairs, required};
use crate::own_structure::{OwnLevels, OwnMotion, OwnPeaks, OwnStructure, falls};
use crate::uncertain::Uncertain;

/// Place of the equivalent oscillator among the models.
pub(super) const OSCILLATOR: usize = 0;

/// Peaks of the only system of an analysis, m, `[record, level]`, where the scale factors of all levels have factors on
/// them, of which this is the one at `factor`.
pub(crate) fn peaks_m(analysed: &Analysed, levels: usize, factor: usize) -> Vec<f64> {
    let records = 0..analysed.peaks.axes().motions;
    records.flat_map(|record| &analysed.peaks.row_m(record, 0)[factor * levels..][..levels]).copied().collect()
}

/// The models of a structure, and the records that shake them.
pub(crate) struct OverturningAnalysis<'a> {
    structure: &'a Structure,
    /// The study of the result, with what happens after the end of a record.
    pub(super) study: UniformRiskStudy,
    pub(crate) records: ShakenRecords,
    pub(crate) measures: Vec<&'a SpectraOfResult>,
    /// The oscillator, then the block, each with the origin of its restitution.
    pub(crate) models: Vec<(System, &'static str)>,
    /// The frame itself, with its levels, `[measure]`; none of a structure without one.
    pub(super) frame: Option<(OwnStructure, Vec<OwnLevels>)>,
    /// Why the structure itself is left out.
    pub(super) without_own: Option<String>,
    /// The structures that it may be; none where all of it is known.
    pub(crate) uncertain: Option<Uncertain<'a>>,
}

impl<'a> OverturningAnalysis<'a> {
    /// Of `structure` under the records of a result; `notes` gets what its oscillator cannot tell.
    pub(crate) fn from_structure(
        structure: &'a Structure,
        source: &'a StudyOfResult,
        options: &OverturningOptions,
        notes: &mut Vec<String>,
    ) -> Result<Self, DesignError> {
        let measures = match options.measure {
            Some(measure) => vec![choose_measure(source, Some(measure))?],
            None => source.measures.iter().collect(),
        };
        let mut models = vec![oscillator(structure, &source.study, options.restitution, notes)?];
        let motion = OwnMotion::from_structure(structure, options.proxy);
        let found = records_and_pairs(source, options.manifest.as_deref(), OwnMotion::takes_pairs(&motion))?;
        let (records, pairs) = required(found, "overturning")?;
        let mut study = source.study.clone();
        // what is lost when a record ends has overturned, whoever looks
        study.oscillator.free_vibration = true;
        let (mut frame, mut without_own) = (None, None);
        if motion == Ok(Some(OwnMotion::AsBlock)) {
            match block(structure, options.restitution)? {
                Ok((block, origin)) => models.push((System::Block(block), origin)),
                Err(reason) => without_own = Some(reason),
            }
            if let Some(reason) = block_leaves_the_ground(&models, &study, &measures, &records.set)? {
                models.truncate(OSCILLATOR + 1);
                without_own = Some(reason);
            }
        } else {
            let (found, reason) = OwnStructure::or_reason(structure, (motion, pairs), options.restitution)?;
            without_own = reason;
            let with_levels = |frame: OwnStructure| {
                let levels = measures.iter().map(|of| frame.levels(&records.set, of)).collect::<Vec<_>>();
                (frame, levels)
            };
            frame = found.map(with_levels);
            if let Some((of, levels)) = &frame {
                for (measure, levels) in measures.iter().zip(levels) {
                    let falls = of.leaves_the_ground(&records.set, (measure.measure(), levels))?;
                    without_own = without_own.or(falls);
                }
            }
            frame = frame.filter(|_| without_own.is_none());
        }
        let uncertain = uncertain_structures(structure, options.restitution, (&models[OSCILLATOR].0, records.count()))?;
        Ok(Self { structure, study, records, measures, models, frame, without_own, uncertain })
    }

    /// Oscillator and block, then the models of the frame, each with what it is and the origin of its restitution.
    pub(crate) fn models(&self) -> impl Iterator<Item = (&System, &'static str, &'static str)> {
        let of_frame = self.frame.iter().flat_map(|(frame, _)| frame.models().zip(frame.restitution_from()));
        let of_frame = of_frame.map(|((model, kind), origin)| (model, kind, *origin));
        self.models.iter().map(|(model, origin)| (model, self.kind(model), *origin)).chain(of_frame)
    }

    /// What a model is, a word for tables.
    pub(crate) fn kind(&self, model: &System) -> &'static str {
        kind(model, self.structure)
    }

    /// The peaks of the frame by each measure, with its levels; their stripes are the next of those
    /// `analysed`. None of a structure without one.
    pub(crate) fn frame_peaks(
        &self,
        analysed: &mut impl Iterator<Item = Analysed>,
    ) -> Vec<(&'a SpectraOfResult, &OwnLevels, OwnPeaks)> {
        let Some((frame, levels)) = &self.frame else { return Vec::new() };
        let measures = self.measures.iter().zip(levels);
        measures
            .map_while(|(&measure, levels)| {
                let own: Vec<_> = analysed.by_ref().take(frame.models().count()).collect();
                (!own.is_empty()).then(|| (measure, levels, frame.peaks(&own)))
            })
            .collect()
    }

    /// The stripes of each model by each measure, the models running fastest, with each of the `factors` on all scale
    /// factors in turn. After all of them those of the frame, one a measure and model, and those of the structures
    /// that it may be, one a measure.
    pub(crate) fn work(&self, title: &str, factors: &[f64]) -> Result<Work<'_>, DesignError> {
        let mut plans = Vec::new();
        let ShakenRecords { set, motions } = &self.records;
        for measure in &self.measures {
            for (model, _) in &self.models {
                let plan = plan_stripes(&self.study, &measure.plan, set, std::slice::from_ref(model))?;
                let plan = plan.multiplied(factors)?;
                let label = format!("{}, {}", measure.measure().label(), self.kind(model));
                plans.push(LabelledPlan { label, remark: None, plan, motions, known: None });
            }
        }
        for (place, measure) in self.measures.iter().enumerate() {
            let Some((frame, levels)) = &self.frame else { break };
            plans.extend(frame.plans(&self.records, (measure.measure(), &levels[place]))?);
        }
        if let Some(uncertain) = &self.uncertain {
            for measure in &self.measures {
                let label = measure.measure().label();
                plans.push(uncertain.plan((label, &self.study), &measure.plan, &self.records)?);
            }
        }
        Ok(Work::new(title, plans))
    }
}

/// Factors on every scale factor: 1, and for the sensitivity to rounding those of its neighbours some roundings away.
pub(super) fn factors(sensitivity: bool) -> Vec<f64> {
    let neighbours = nudges();
    [1.0].iter().chain(neighbours.iter().filter(|_| sensitivity)).copied().collect()
}

/// Why the block among `models` cannot be shaken: its records, scaled, let it leave the ground.
fn block_leaves_the_ground(
    models: &[(System, &'static str)],
    study: &UniformRiskStudy,
    measures: &[&SpectraOfResult],
    set: &RecordSet,
) -> Result<Option<String>, DesignError> {
    let verticals: Vec<_> = set.records.iter().filter_map(|record| record.vertical.as_ref()).collect();
    let verticals: Vec<_> = verticals.iter().map(|vertical| &vertical.accelerogram).collect();
    let Some(gravity_m_s2) = models.iter().find_map(|(model, _)| model.gravity_m_s2()) else { return Ok(None) };
    for measure in measures.iter().filter(|_| !verticals.is_empty()) {
        // the oscillator feels no vertical motion
        let plan = plan_stripes(study, &measure.plan, set, std::slice::from_ref(&models[OSCILLATOR].0))?;
        let falling = plan.multiplied(&factors(true))?.falling(&verticals, gravity_m_s2);
        if let Some(reason) = falls(&falling) {
            return Ok(Some(reason));
        }
    }
    Ok(None)
}

/// The structures that `structure` may be, whose `oscillator` is that of the structure as described; none where all of
/// it is known.
///
/// # Errors
/// A structure that cannot be; one restitution for all where the file says that it is uncertain.
fn uncertain_structures<'a>(
    structure: &'a Structure,
    for_both: Option<f64>,
    (oscillator, records): (&System, usize),
) -> Result<Option<Uncertain<'a>>, DesignError> {
    let is_uncertain = |of: &Uncertainty| of.quantities.contains(&UncertainQuantity::Restitution);
    if for_both.is_some() && structure.uncertainty.as_ref().is_some_and(is_uncertain) {
        return Err(JobError::Usage(format!(
            "--restitution: {} says that the restitution is uncertain: leave the option out, or \
             [uncertainty.restitution]",
            structure.file.display()
        ))
        .into());
    }
    Uncertain::from_structure(structure, oscillator.restitution(), records)
}
