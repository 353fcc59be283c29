//! The sections `[pgv]`, `[pga]` and `[measures.…]`: intensity measures, each with its keys, levels and units.

use serde::{Serialize, Serializer};
use uplift_hazard::CurveUnit;
use uplift_motion::IntensityMeasure;
use uplift_plausible::{CUMULATIVE_LEVEL, DISPLACEMENT_LEVEL, PGA_LEVEL, PGV_LEVEL, Range, SA_LEVEL};

use crate::grid::{Grid, GridRule};
use crate::keys::{Key, SectionKeys, grid};
use crate::reading::{MEASURES, Rule, Section};

pub(super) const PGV_KEYS: SectionKeys = SectionKeys::new("pgv", &[&PGV_LEVELS]);
pub(super) const PGA_KEYS: SectionKeys = SectionKeys::new("pga", &[&PGA_LEVELS]);
/// `sa_1s` is shown for every spectral acceleration.
pub(super) const SA_KEYS: SectionKeys = SectionKeys::new("measures.sa_1s", &[&SA_LEVELS]);
pub(super) const PGD_KEYS: SectionKeys = SectionKeys::new("measures.pgd", &[&PGD_LEVELS]);
pub(super) const SI_KEYS: SectionKeys = SectionKeys::new("measures.si", &[&SI_LEVELS]);
pub(super) const CAV_KEYS: SectionKeys = SectionKeys::new("measures.cav", &[&CAV_LEVELS]);
pub(super) const ARIAS_KEYS: SectionKeys = SectionKeys::new("measures.arias", &[&ARIAS_LEVELS]);

/// Chapter 4's 75 levels, and nine below, without which half of the risk at 50 % in 50 years lies below the first one
/// in weak seismicity (docs/method.md, section 3).
const PGV_LEVELS: Key<GridRule> = levels("levels_cm_s", PGV_LEVEL)
    .with_default(&["0.1:0.1:0.9", "1:0.5:20", "25:5:200"])
    .meaning("levels of peak ground velocity that records are scaled to, cm/s, a grid");
const PGA_LEVELS: Key<GridRule> =
    levels("levels_g", PGA_LEVEL).with_default(ACCELERATIONS).meaning("levels of peak ground acceleration, g, a grid");
const SA_LEVELS: Key<GridRule> = levels("levels_g", SA_LEVEL)
    .with_default(ACCELERATIONS)
    .meaning("levels of a spectral acceleration, or of an average one, g, a grid");
const PGD_LEVELS: Key<GridRule> = levels("levels_cm", DISPLACEMENT_LEVEL)
    .with_default(&["0.1:0.1:0.9", "1:0.5:20", "25:5:200"])
    .meaning("levels of peak ground displacement, cm, a grid");
const SI_LEVELS: Key<GridRule> = levels("levels_cm", DISPLACEMENT_LEVEL)
    .with_default(&["0.5:0.5:4.5", "5:2.5:100", "125:25:1000"])
    .meaning("levels of the spectrum intensity, cm, a grid");
const CAV_LEVELS: Key<GridRule> = levels("levels_cm_s", CUMULATIVE_LEVEL)
    .with_default(&["1:1:9", "10:10:200", "250:50:3000"])
    .meaning("levels of the cumulative absolute velocity, cm/s, a grid");
/// They go further than others: the intensity grows with the square of the factor.
const ARIAS_LEVELS: Key<GridRule> = levels("levels_cm_s", CUMULATIVE_LEVEL)
    .with_default(&[
        "0.001:0.001:0.009",
        "0.01:0.01:0.09",
        "0.1:0.1:0.9",
        "1:1:9",
        "10:10:90",
        "100:100:900",
        "1000:1000:5000",
    ])
    .meaning("levels of the Arias intensity, cm/s, a grid");
const ACCELERATIONS: &[&str] = &["0.001", "0.0025:0.0025:0.0225", "0.025:0.005:0.195", "0.2:0.05:2"];

const fn levels(name: &'static str, plausible: Range) -> Key<GridRule> {
    grid(name, GridRule { unit: plausible.unit, each: Rule::Within(plausible), least_count: 2 })
}

/// An intensity measure with its levels.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasurePlan {
    /// The measure.
    pub measure: IntensityMeasure,
    /// Levels in [`IntensityMeasure::unit`], cm/s for PGV, g for PGA and spectral accelerations; at least two.
    pub levels: Grid,
    /// Whether they are the default levels, cut to what the hazard curves cover.
    pub is_cut: bool,
}

/// What a study file says about one measure. The section that switches it on, the key of its curve in a site and that
/// of its factor in a conversion are [`IntensityMeasure::key`].
pub(super) struct MeasureKeys {
    pub(super) levels: Key<GridRule>,
    /// Units that a hazard curve may have; the first one unless it names another.
    pub(super) units: &'static [CurveUnit],
}

impl MeasureKeys {
    pub(super) fn from_measure(measure: IntensityMeasure) -> Self {
        const ACCELERATION: &[CurveUnit] = &[CurveUnit::G, CurveUnit::MPerS2, CurveUnit::CmPerS2];
        const LENGTH: &[CurveUnit] = &[CurveUnit::Cm, CurveUnit::M];
        const CUMULATIVE: &[CurveUnit] = &[CurveUnit::CmPerS, CurveUnit::MPerS, CurveUnit::GS];
        let (levels, units): (_, &[CurveUnit]) = match measure {
            IntensityMeasure::Pgv => (PGV_LEVELS, &[CurveUnit::CmPerS, CurveUnit::MPerS]),
            IntensityMeasure::Pga => (PGA_LEVELS, ACCELERATION),
            IntensityMeasure::Sa(_) | IntensityMeasure::AvgSa { .. } => (SA_LEVELS, ACCELERATION),
            IntensityMeasure::Pgd => (PGD_LEVELS, LENGTH),
            IntensityMeasure::SpectrumIntensity => (SI_LEVELS, LENGTH),
            IntensityMeasure::Cav => (CAV_LEVELS, CUMULATIVE),
            // what cannot be scaled to has levels nowhere; its name is refused where it is read
            IntensityMeasure::Arias | IntensityMeasure::D575 | IntensityMeasure::D595 => (ARIAS_LEVELS, CUMULATIVE),
        };
        Self { levels, units }
    }
}

/// The section of a measure: its own where it is of Chapter 4.
pub(super) fn section_of(measure: IntensityMeasure) -> String {
    let key = measure.key();
    if measure.is_of_chapter_4() { key.to_owned() } else { format!("{MEASURES}.{key}") }
}

/// The sections of the measures, as a study file has them.
pub(super) fn write<S: Serializer>(plans: &[MeasurePlan], serializer: S) -> Result<S::Ok, S::Error> {
    /// The section of one measure.
    struct Levels<'a>(&'a MeasurePlan);
    impl Serialize for Levels<'_> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.collect_map([(MeasureKeys::from_measure(self.0.measure).levels.name, &self.0.levels)])
        }
    }
    /// One of them, or the section of those that Chapter 4 has not.
    enum Part<'a> {
        Measure(Levels<'a>),
        Further(Vec<&'a MeasurePlan>),
    }
    impl Serialize for Part<'_> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            match self {
                Self::Measure(levels) => levels.serialize(serializer),
                Self::Further(plans) => {
                    serializer.collect_map(plans.iter().map(|plan| (plan.measure.key(), Levels(plan))))
                }
            }
        }
    }
    let (own, further): (Vec<&MeasurePlan>, Vec<&MeasurePlan>) =
        plans.iter().partition(|plan| plan.measure.is_of_chapter_4());
    let own = own.into_iter().map(|plan| (plan.measure.key(), Part::Measure(Levels(plan))));
    let further = (!further.is_empty()).then_some((MEASURES, Part::Further(further)));
    serializer.collect_map(own.chain(further))
}

/// The measures that keys of `section` are the names of, in their order; those of Chapter 4 whether they are there or
/// not.
pub(super) fn named(section: &Section<'_>) -> Vec<IntensityMeasure> {
    let further = section.keys().filter_map(|key| {
        let measure: IntensityMeasure = key.parse().ok()?;
        (measure.key() == key && !measure.is_of_chapter_4()).then_some(measure)
    });
    let mut named: Vec<IntensityMeasure> = IntensityMeasure::OF_CHAPTER_4.into_iter().chain(further).collect();
    named.sort_unstable();
    named
}

/// The sections of measures that the document has, each with its measure.
fn sections<'a>(root: &mut Section<'a>) -> Vec<(IntensityMeasure, Section<'a>)> {
    let mut sections = Vec::new();
    for measure in IntensityMeasure::OF_CHAPTER_4 {
        if root.field(measure.key()).is_some() {
            sections.push((measure, root.section(measure.key())));
        }
    }
    let mut further = root.section(MEASURES);
    for measure in named(&further) {
        if measure.is_of_chapter_4() {
            let key = measure.key();
            // asked for only where it is there: it has no place here
            if let Some(field) = further.keys().any(|there| there == key).then(|| further.field(key)).flatten() {
                field.mistake(format!("[{MEASURES}.{key}] is [{key}]"), format!("head the section with [{key}]"));
            }
            continue;
        }
        let Some(field) = further.field(measure.key()) else { continue };
        if measure.can_be_scaled_to() {
            sections.push((measure, field.section()));
        } else {
            field.mistake(cannot_be_scaled_to(measure), "leave the section out");
        }
    }
    further.finish();
    sections
}

/// Why a study cannot be analysed by a duration.
pub(super) fn cannot_be_scaled_to(measure: IntensityMeasure) -> String {
    format!("no factor changes the {} of a record, so none can be scaled to a level of it", measure.long_name())
}

/// Reads the sections of the measures: which the document has, and their plans where nothing is wrong with them.
pub(super) fn read(root: &mut Section<'_>) -> (Vec<IntensityMeasure>, Option<Vec<MeasurePlan>>) {
    let sections = sections(root);
    if sections.is_empty() {
        // what is not understood among the further ones is told by itself
        if root.section(MEASURES).keys().next().is_none() {
            root.mistake(
                "",
                "the study has no intensity measure",
                "add a section [pgv], a section [pga], or both; it may be empty; or [measures.sa_1s] and the like",
            );
        }
        return (Vec::new(), None);
    }
    let switched_on = sections.iter().map(|(measure, _)| *measure).collect();
    let mut plans = Some(Vec::new());
    for (measure, mut section) in sections {
        let keys = MeasureKeys::from_measure(measure);
        let levels = section.read(&keys.levels);
        section.finish();
        match (&mut plans, levels) {
            (Some(plans), Some(levels)) => plans.push(MeasurePlan { measure, levels, is_cut: false }),
            _ => plans = None,
        }
    }
    (switched_on, plans)
}
