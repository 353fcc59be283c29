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

/// The default levels of `measure` that lie from `least` to `most`, as a study writes them: key and grid. None where all of them do, or
/// hardly any.
pub fn levels_within(measure: IntensityMeasure, least: f64, most: f64) -> Option<(String, String)> {
    let keys = MEASURES.iter().find(|keys| keys.measure == measure)?;
    let mut parts = Vec::new();
    let mut cut = false;
    for text in keys.default_levels {
        let numbers: Vec<f64> = text.split(':').filter_map(|number| number.parse().ok()).collect();
        let part = match numbers[..] {
            [value] => (least <= value && value <= most).then(|| text.to_string()),
            [start, step, stop] => {
                // ends move by whole steps, so that the levels stay those of the default
                let from = ((least - start) / step).ceil().max(0.0);
                let to = ((most.min(stop) - start) / step + 1e-9).floor();
                let at = |steps: f64| ((start + steps * step) * 1e6).round() / 1e6;
                cut |= from > 0.0 || at(to) < stop;
                (from < to).then(|| format!("{}:{step}:{}", at(from), at(to)))
            }
            _ => None,
        };
        cut |= part.is_none();
        parts.extend(part);
    }
    let quoted: Vec<String> = parts.iter().map(|part| format!("\"{part}\"")).collect();
    let range = |part: &String| part.contains(':');
    (cut && parts.iter().any(range))
        .then(|| (format!("{}.{}", keys.section, keys.levels), format!("[{}]", quoted.join(", "))))
}

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
