//! A resolved study of displacement spectra in the shape of a study file.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;

use super::super::form::{CriterionForm, OutputForm, SyntheticForm, select_form};
use super::super::grid::Grid;
use super::super::resolve::DISPLACEMENT_SPECTRA;
use super::super::resolved::RecordSource;
use super::structures::HOUSNER;
use super::{DesignPlan, Designed, DisplacementStudy, Structures};

#[derive(Serialize)]
pub(super) struct Form<'a> {
    kind: &'static str,
    title: &'a str,
    gravity_m_s2: f64,
    records: RecordsForm<'a>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    record_sets: Vec<SetForm<'a>>,
    scaling: ScalingForm,
    spectrum: SpectrumForm<'a>,
    #[serde(flatten)]
    structures: StructuresForm<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    design: Option<DesignForm>,
    output: OutputForm<'a>,
}

#[derive(Serialize)]
struct RecordsForm<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    manifest: Option<&'a Path>,
    #[serde(skip_serializing_if = "Option::is_none")]
    first: Option<u64>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    select: BTreeMap<&'static str, CriterionForm>,
    #[serde(skip_serializing_if = "Option::is_none")]
    synthetic: Option<SyntheticForm>,
}

#[derive(Serialize)]
struct SetForm<'a> {
    name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    tag: Option<&'a str>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    leave_out: &'a [String],
}

#[derive(Serialize)]
struct ScalingForm {
    to: Vec<String>,
    by: Vec<&'static str>,
}

#[derive(Serialize)]
struct SpectrumForm<'a> {
    percentiles: &'a Grid,
}

#[derive(Serialize)]
#[serde(untagged)]
enum StructuresForm<'a> {
    Oscillators { oscillator: OscillatorForm<'a>, strengths: ValuesForm<'a> },
    Blocks { block: BlockForm<'a>, slenderness: ValuesForm<'a> },
}

#[derive(Serialize)]
struct OscillatorForm<'a> {
    uplift_displacement_m: &'a Grid,
    capacity_m: &'a [f64],
    restitution: f64,
    free_vibration: bool,
}

#[derive(Serialize)]
struct BlockForm<'a> {
    height_m: &'a Grid,
    restitution: RestitutionForm,
}

#[derive(Serialize)]
#[serde(untagged)]
enum RestitutionForm {
    Number(f64),
    Word(&'static str),
}

#[derive(Serialize)]
struct ValuesForm<'a> {
    values: &'a Grid,
}

#[derive(Serialize)]
struct DesignForm {
    #[serde(skip_serializing_if = "Option::is_none")]
    width_m: Option<f64>,
    height_m: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    endless_height_m: Option<f64>,
    safety_factor: f64,
    percentile: f64,
    noise_relative: f64,
    noise_points: usize,
}

impl<'a> Form<'a> {
    pub(super) fn of(study: &'a DisplacementStudy) -> Self {
        let (manifest, synthetic) = match &study.records.source {
            RecordSource::Manifest { manifest, .. } => (Some(manifest.as_path()), None),
            &RecordSource::Synthetic { pairs, seed } => (None, Some(SyntheticForm { pairs, seed })),
        };
        Self {
            kind: DISPLACEMENT_SPECTRA,
            title: &study.title,
            gravity_m_s2: study.gravity_m_s2,
            records: RecordsForm {
                manifest,
                first: study.records.first,
                select: select_form(&study.records.select),
                synthetic,
            },
            record_sets: (study.record_sets.iter())
                .map(|set| SetForm { name: &set.name, tag: set.tag.as_deref(), leave_out: &set.leave_out })
                .collect(),
            scaling: ScalingForm {
                to: study.scaling.to.iter().map(ToString::to_string).collect(),
                by: study.scaling.by.iter().map(|by| by.key()).collect(),
            },
            spectrum: SpectrumForm { percentiles: &study.percentiles },
            structures: StructuresForm::of(&study.structures),
            design: study.design.as_ref().map(DesignForm::of),
            output: OutputForm::of(&study.output),
        }
    }
}

impl<'a> StructuresForm<'a> {
    fn of(structures: &'a Structures) -> Self {
        match structures {
            Structures::Oscillators(family) => Self::Oscillators {
                oscillator: OscillatorForm {
                    uplift_displacement_m: &family.uplift_displacement_m,
                    capacity_m: &family.capacity_m,
                    restitution: family.restitution,
                    free_vibration: family.free_vibration,
                },
                strengths: ValuesForm { values: &family.strengths },
            },
            Structures::Blocks(family) => Self::Blocks {
                block: BlockForm {
                    height_m: &family.height_m,
                    restitution: family.restitution.map_or(RestitutionForm::Word(HOUSNER), RestitutionForm::Number),
                },
                slenderness: ValuesForm { values: &family.slendernesses },
            },
        }
    }
}

impl DesignForm {
    fn of(design: &DesignPlan) -> Self {
        let (width_m, height_m, endless_height_m) = match design.designed {
            Designed::Bridge { width_m, height_m } => (Some(width_m), height_m, None),
            Designed::Block { height_m, endless_height_m } => (None, height_m, Some(endless_height_m)),
        };
        Self {
            width_m,
            height_m,
            endless_height_m,
            safety_factor: design.safety_factor,
            percentile: design.percentile,
            noise_relative: design.noise_relative,
            noise_points: design.noise_points,
        }
    }
}
