//! The sections `[pgv]` and `[pga]`: intensity measures, each with its keys, levels and units.

use serde::{Serialize, Serializer};
use uplift_hazard::CurveUnit;
use uplift_motion::IntensityMeasure;
use uplift_plausible::{PGA_LEVEL, PGV_LEVEL, Range};

use super::lower_levels::levels_key;
use crate::grid::{Grid, GridRule};
use crate::keys::{Key, SectionKeys};
use crate::reading::{Rule, Section};

pub(super) const PGV_KEYS: SectionKeys = SectionKeys {
    section: "pgv",
    keys: &[Key {
        names: &["levels_cm_s"],
        meaning: "levels of peak ground velocity that records are scaled to, cm/s, a grid",
        default: "`[\"0.1:0.1:0.9\", \"1:0.5:20\", \"25:5:200\"]`, 84 levels",
        range: "1e-5 to 10000; at least 2",
    }],
};
pub(super) const PGA_KEYS: SectionKeys = SectionKeys {
    section: "pga",
    keys: &[Key {
        names: &["levels_g"],
        meaning: "levels of peak ground acceleration, g, a grid",
        default: "`[0.001, \"0.0025:0.0025:0.0225\", \"0.025:0.005:0.195\", \"0.2:0.05:2\"]`, 82 levels",
        range: "1e-7 to 1000; at least 2",
    }],
};

/// An intensity measure with its levels.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasurePlan {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Levels in [`IntensityMeasure::unit`], cm/s for PGV and g for PGA; at least two.
    pub levels: Grid,
}

/// What a study file says about one measure. The section that switches it on, the key of its curve in a site and that
/// of its factor in a conversion are [`IntensityMeasure::key`].
pub(super) struct MeasureKeys {
    pub(super) levels: &'static str,
    default_levels: &'static [&'static str],
    plausible: Range,
    /// Units that a hazard curve may have; the first one unless it names another.
    pub(super) units: &'static [CurveUnit],
}

impl MeasureKeys {
    pub(super) fn of(measure: IntensityMeasure) -> Self {
        match measure {
            IntensityMeasure::Pgv => Self {
                levels: "levels_cm_s",
                // 84 levels: Chapter 4's 75, and nine below, without which half of the risk at 50 % in 50 years lies
                // below the first one in weak seismicity (docs/method.md, section 3)
                default_levels: &["0.1:0.1:0.9", "1:0.5:20", "25:5:200"],
                plausible: PGV_LEVEL,
                units: &[CurveUnit::CmPerS, CurveUnit::MPerS],
            },
            IntensityMeasure::Pga => Self {
                levels: "levels_g",
                // 82 levels
                default_levels: &["0.001", "0.0025:0.0025:0.0225", "0.025:0.005:0.195", "0.2:0.05:2"],
                plausible: PGA_LEVEL,
                units: &[CurveUnit::G, CurveUnit::MPerS2, CurveUnit::CmPerS2],
            },
        }
    }
}

/// The sections of the measures, as a study file has them.
pub(super) fn write<S: Serializer>(plans: &[MeasurePlan], serializer: S) -> Result<S::Ok, S::Error> {
    struct Levels<'a>(&'a MeasurePlan);
    impl Serialize for Levels<'_> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.collect_map([(MeasureKeys::of(self.0.measure).levels, &self.0.levels)])
        }
    }
    serializer.collect_map(plans.iter().map(|plan| (plan.measure.key(), Levels(plan))))
}

/// The default levels of `measure` that lie from `least` to `most`, as a study writes them: key and grid. None where
/// all of them do, or hardly any.
pub fn levels_within(measure: IntensityMeasure, least: f64, most: f64) -> Option<(String, String)> {
    let keys = MeasureKeys::of(measure);
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
    (cut && parts.iter().any(range)).then(|| (levels_key(measure), format!("[{}]", quoted.join(", "))))
}

/// Which measures the document has sections of.
pub(super) fn switched_on(root: &mut Section<'_>) -> Vec<IntensityMeasure> {
    IntensityMeasure::ALL.into_iter().filter(|measure| root.field(measure.key()).is_some()).collect()
}

/// Reads the sections of the measures.
pub(super) fn read(root: &mut Section<'_>) -> Option<Vec<MeasurePlan>> {
    let switched_on = switched_on(root);
    if switched_on.is_empty() {
        root.mistake(
            "",
            "the study has no intensity measure",
            "add a section [pgv], a section [pga], or both; it may be empty",
        );
        return None;
    }
    let mut plans = Some(Vec::new());
    for measure in switched_on {
        let keys = MeasureKeys::of(measure);
        let rule = GridRule { unit: measure.unit(), each: Rule::Within(keys.plausible), least_count: 2 };
        let mut section = root.section(measure.key());
        let levels = Grid::of_key(&mut section, keys.levels, rule, keys.default_levels);
        section.finish();
        match (&mut plans, levels) {
            (Some(plans), Some(levels)) => plans.push(MeasurePlan { measure, levels }),
            _ => plans = None,
        }
    }
    plans
}
