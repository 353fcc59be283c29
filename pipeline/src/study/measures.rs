//! The intensity measures that a study file can name, each with its keys, levels and units.

use uplift_motion::IntensityMeasure;

use super::grid::{Grid, GridRule};
use super::reader::{ABOVE_ZERO, Ledger, Section};
use super::resolved::{CurveUnit, MeasurePlan};

/// What a study file says about one measure.
pub(super) struct MeasureKeys {
    pub(super) measure: IntensityMeasure,
    /// The section that switches it on, and the key of its curve in a site.
    pub(super) section: &'static str,
    levels: &'static str,
    default_levels: &'static [&'static str],
    /// Unit of a hazard curve, unless it names another of `units`.
    pub(super) default_unit: CurveUnit,
    pub(super) units: &'static [(&'static str, CurveUnit)],
}

/// The measures, in the order of the results.
pub(super) const MEASURES: [MeasureKeys; 2] = [
    MeasureKeys {
        measure: IntensityMeasure::Pgv,
        section: "pgv",
        levels: "levels_cm_s",
        // 75 levels
        default_levels: &["1:0.5:20", "25:5:200"],
        default_unit: CurveUnit::CmPerS,
        units: &[("cm/s", CurveUnit::CmPerS), ("m/s", CurveUnit::MPerS)],
    },
    MeasureKeys {
        measure: IntensityMeasure::Pga,
        section: "pga",
        levels: "levels_g",
        // 82 levels
        default_levels: &["0.001", "0.0025:0.0025:0.0225", "0.025:0.005:0.195", "0.2:0.05:2"],
        default_unit: CurveUnit::G,
        units: &[("g", CurveUnit::G), ("m/s2", CurveUnit::MPerS2), ("cm/s2", CurveUnit::CmPerS2)],
    },
];

/// Which measures the document has sections of.
pub(super) fn switched_on(root: &mut Section<'_>) -> Vec<IntensityMeasure> {
    MEASURES.iter().filter(|keys| root.field(keys.section).is_some()).map(|keys| keys.measure).collect()
}

/// Reads the sections of the measures.
pub(super) fn read(root: &mut Section<'_>, ledger: &Ledger) -> Option<Vec<MeasurePlan>> {
    if switched_on(root).is_empty() {
        root.mistake(
            "",
            "the study has no intensity measure",
            "add a section [pgv], a section [pga], or both; it may be empty",
        );
        return None;
    }
    let mut plans = Some(Vec::new());
    for keys in &MEASURES {
        let Some(field) = root.field(keys.section) else {
            continue;
        };
        let rule = GridRule { unit: keys.measure.unit(), each: ABOVE_ZERO, least_count: 2 };
        let mut section = field.section();
        let levels = Grid::of_key(&mut section, keys.levels, rule, keys.default_levels, ledger);
        section.finish();
        match (&mut plans, levels) {
            (Some(plans), Some(levels)) => plans.push(MeasurePlan { measure: keys.measure, levels }),
            _ => plans = None,
        }
    }
    plans
}
