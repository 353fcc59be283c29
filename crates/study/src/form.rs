//! The resolved study in the shape of a study file.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Serialize;
use uplift_hazard::ComponentDefinition;
use uplift_motion::{Combination, Component, IntensityMeasure};

use super::grid::Grid;
use super::hazard::Hazard;
use super::resolved::{
    Contour, CurveFile, CurveKind, Extrapolate, IntervalKind, Output, RecordSource, ResolvedStudy, Uplifted,
};
use super::selection::RecordSelection;
use super::site_table::SiteTableForm;

/// The words of a study file for choices, each in one place for reading and writing.
pub(super) const COMPONENTS: [(&str, Component); 4] =
    [("h1", Component::H1), ("h2", Component::H2), ("both", Component::Both), ("random", Component::Random)];
pub(super) const COMBINATIONS: [(&str, Combination); 3] = [
    ("geometric-mean", Combination::GeometricMean),
    ("rotd50", Combination::RotD50),
    ("rotd100", Combination::RotD100),
];
pub(super) const DEFINITIONS: [(&str, ComponentDefinition); 6] = [
    ("geometric mean", ComponentDefinition::GeometricMean),
    ("GMRotI50", ComponentDefinition::GmRotI50),
    ("RotD50", ComponentDefinition::RotD50),
    ("RotD100", ComponentDefinition::RotD100),
    ("larger", ComponentDefinition::Larger),
    ("arbitrary", ComponentDefinition::Arbitrary),
];
pub(super) const CONTOURS: [(&str, Contour); 2] = [("exact", Contour::Exact), ("grid", Contour::Grid)];
pub(super) const EXTRAPOLATIONS: [(&str, Extrapolate); 2] =
    [("refuse", Extrapolate::Refuse), ("loglog", Extrapolate::Loglog)];
pub(super) const INTERVALS: [(&str, IntervalKind); 2] =
    [("percentile", IntervalKind::Percentile), ("bca", IntervalKind::Bca)];

fn word<T: PartialEq>(choices: &[(&'static str, T)], value: &T) -> &'static str {
    choices.iter().find_map(|(word, choice)| (choice == value).then_some(*word)).unwrap_or_default()
}

#[derive(Serialize)]
pub(super) struct Form<'a> {
    title: &'a str,
    seed: u64,
    gravity_m_s2: f64,
    records: RecordsForm<'a>,
    oscillator: OscillatorForm,
    strengths: StrengthsForm<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pgv: Option<PgvForm<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pga: Option<PgaForm<'a>>,
    risk: RiskForm<'a>,
    #[serde(skip_serializing_if = "HazardForm::is_empty")]
    hazard: HazardForm,
    sites: Vec<SiteForm<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    site_table: Option<SiteTableForm<'a>>,
    regression: RegressionForm,
    bootstrap: BootstrapForm<'a>,
    output: OutputForm<'a>,
}

#[derive(Serialize)]
struct RecordsForm<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    manifest: Option<&'a Path>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tag: Option<&'a str>,
    component: &'static str,
    intensity: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    first: Option<u64>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    select: BTreeMap<&'static str, CriterionForm>,
    #[serde(skip_serializing_if = "Option::is_none")]
    synthetic: Option<SyntheticForm>,
}

#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum CriterionForm {
    Range(String),
    PulseLike(bool),
}

#[derive(Serialize)]
pub(super) struct SyntheticForm {
    pub(super) pairs: u64,
    pub(super) seed: u64,
}

#[derive(Serialize)]
struct OscillatorForm {
    uplift_displacement_m: f64,
    restitution: f64,
    free_vibration: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    capacity_m: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    post_uplift_stiffness_per_s2: Option<f64>,
}

#[derive(Serialize)]
struct StrengthsForm<'a> {
    values: &'a Grid,
}

#[derive(Serialize)]
struct PgvForm<'a> {
    levels_cm_s: &'a Grid,
}

#[derive(Serialize)]
struct PgaForm<'a> {
    levels_g: &'a Grid,
}

#[derive(Serialize)]
struct RiskForm<'a> {
    poe: &'a [f64],
    years: f64,
    contour: &'static str,
    thresholds_m: &'a Grid,
    maf_surface: bool,
    extrapolate: &'static str,
}

#[derive(Serialize)]
struct HazardForm {
    #[serde(skip_serializing_if = "Option::is_none")]
    component: Option<&'static str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    conversions: Vec<ConversionForm>,
}

#[derive(Serialize)]
struct ConversionForm {
    from: &'static str,
    to: &'static str,
    #[serde(flatten)]
    factors: BTreeMap<&'static str, f64>,
}

#[derive(Serialize)]
struct SiteForm<'a> {
    name: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pgv: Option<CurveForm<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pga: Option<CurveForm<'a>>,
}

#[derive(Serialize)]
struct CurveForm<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<&'a Path>,
    unit: &'static str,
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    years: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    branches: Vec<BranchForm<'a>>,
}

#[derive(Serialize)]
struct BranchForm<'a> {
    name: &'a str,
    weight: f64,
    file: &'a Path,
}

#[derive(Serialize)]
struct RegressionForm {
    strength_above: f64,
}

#[derive(Serialize)]
struct BootstrapForm<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    sizes: Option<&'a [u32]>,
    replicates: u64,
    confidence: f64,
    interval: &'static str,
    simultaneous: bool,
    strength_above: f64,
}

#[derive(Serialize)]
pub(super) struct OutputForm<'a> {
    file: &'a Path,
    csv: bool,
}

impl<'a> Form<'a> {
    pub(super) fn of(study: &'a ResolvedStudy) -> Self {
        let levels = |measure: IntensityMeasure| {
            let mut plans = study.measures.iter();
            Some(&plans.find(|plan| plan.measure == measure)?.levels)
        };
        let curve = |curve: &'a CurveFile| CurveForm {
            file: curve.file.as_deref(),
            unit: curve.unit.symbol(),
            kind: match curve.kind {
                CurveKind::Maf => "maf",
                CurveKind::Poe { .. } => "poe",
            },
            years: match curve.kind {
                CurveKind::Maf => None,
                CurveKind::Poe { years } => Some(years),
            },
            branches: (curve.branches.iter())
                .map(|branch| BranchForm { name: &branch.name, weight: branch.weight, file: &branch.file })
                .collect(),
        };
        Self {
            title: &study.title,
            seed: study.seed,
            gravity_m_s2: study.gravity_m_s2,
            records: RecordsForm::of(study),
            oscillator: OscillatorForm::of(study),
            strengths: StrengthsForm { values: &study.strengths },
            pgv: levels(IntensityMeasure::Pgv).map(|levels_cm_s| PgvForm { levels_cm_s }),
            pga: levels(IntensityMeasure::Pga).map(|levels_g| PgaForm { levels_g }),
            risk: RiskForm {
                poe: &study.risk.poe,
                years: study.risk.years,
                contour: word(&CONTOURS, &study.risk.contour),
                thresholds_m: &study.risk.thresholds_m,
                maf_surface: study.risk.maf_surface,
                extrapolate: word(&EXTRAPOLATIONS, &study.risk.extrapolate),
            },
            hazard: HazardForm::of(&study.hazard),
            sites: (study.sites.iter())
                .map(|site| SiteForm {
                    name: &site.name,
                    pgv: site.curve(IntensityMeasure::Pgv).map(curve),
                    pga: site.curve(IntensityMeasure::Pga).map(curve),
                })
                .collect(),
            site_table: SiteTableForm::of(study),
            regression: RegressionForm { strength_above: study.regression.strength_above },
            bootstrap: BootstrapForm {
                sizes: study.bootstrap.sizes.as_deref(),
                replicates: study.bootstrap.replicates,
                confidence: study.bootstrap.confidence,
                interval: word(&INTERVALS, &study.bootstrap.interval),
                simultaneous: study.bootstrap.simultaneous,
                strength_above: study.bootstrap.strength_above,
            },
            output: OutputForm::of(&study.output),
        }
    }
}

impl<'a> RecordsForm<'a> {
    fn of(study: &'a ResolvedStudy) -> Self {
        let (manifest, tag, synthetic) = match &study.records.source {
            RecordSource::Manifest { manifest, tag } => (Some(manifest.as_path()), tag.as_deref(), None),
            &RecordSource::Synthetic { pairs, seed } => (None, None, Some(SyntheticForm { pairs, seed })),
        };
        Self {
            manifest,
            tag,
            component: word(&COMPONENTS, &study.records.component),
            intensity: word(&COMBINATIONS, &study.records.intensity),
            first: study.records.first,
            select: select_form(&study.records.select),
            synthetic,
        }
    }
}

/// The section `[records.select]`.
pub(super) fn select_form(select: &RecordSelection) -> BTreeMap<&'static str, CriterionForm> {
    let ranges =
        select.ranges.iter().map(|(criterion, range)| (criterion.key, CriterionForm::Range(range.to_string())));
    let pulse_like = select.pulse_like.map(|truth| ("pulse_like", CriterionForm::PulseLike(truth)));
    ranges.chain(pulse_like).collect()
}

impl<'a> OutputForm<'a> {
    pub(super) fn of(output: &'a Output) -> Self {
        Self { file: &output.file, csv: output.csv }
    }
}

impl HazardForm {
    fn of(hazard: &Hazard) -> Self {
        let conversions = hazard.conversions.iter().map(|conversion| ConversionForm {
            from: word(&DEFINITIONS, &conversion.from),
            to: word(&DEFINITIONS, &conversion.to),
            factors: conversion.factors.iter().map(|&(measure, factor)| (measure.key(), factor)).collect(),
        });
        Self {
            component: hazard.component.as_ref().map(|component| word(&DEFINITIONS, component)),
            conversions: conversions.collect(),
        }
    }

    fn is_empty(&self) -> bool {
        self.component.is_none() && self.conversions.is_empty()
    }
}

impl OscillatorForm {
    fn of(study: &ResolvedStudy) -> Self {
        let oscillator = &study.oscillator;
        let (capacity_m, stiffness) = match oscillator.uplifted {
            Uplifted::ZeroStiffness => (None, None),
            Uplifted::NegativeStiffness { capacity_m } => (Some(capacity_m), None),
            Uplifted::PositiveStiffness { stiffness_per_s2 } => (None, Some(stiffness_per_s2)),
        };
        Self {
            uplift_displacement_m: oscillator.uplift_displacement_m,
            restitution: oscillator.restitution,
            free_vibration: oscillator.free_vibration,
            capacity_m,
            post_uplift_stiffness_per_s2: stiffness,
        }
    }
}
