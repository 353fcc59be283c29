//! Record sets, curves and stripes of Chapter 4, and the demands of a few oscillators.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use uplift_consistency::{RecordSet, ScaledAnalysis, Seismology, SetRecord};
use uplift_fragility::Stripes;
use uplift_hazard::{CsvOptions, Extrapolation, HazardCurve, rate_from_probability, read_path};
use uplift_ida::{Plan, StripeRecord, System, Unwatched, analyse};
use uplift_motion::{IntensityMeasure, RecordPair, STANDARD_GRAVITY_M_S2};
use uplift_oscillator::Oscillator;
use uplift_risk::PooledDemand;

/// Strengths whose spectra by both measures are compared.
pub(crate) const STRENGTHS: [f64; 8] = [0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0];

/// Those whose ordinates are compared one by one: 0.05, 0.1, 0.2, 0.4, 0.8.
pub(crate) const ONE_BY_ONE: [usize; 5] = [0, 1, 2, 4, 6];

/// The measure that a set is scaled to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ScaledTo {
    Pgv,
    Pga,
}

impl ScaledTo {
    pub(crate) const BOTH: [Self; 2] = [Self::Pgv, Self::Pga];

    /// Chapter 4's levels: 75 of PGV in cm/s, 82 of PGA in g.
    pub(crate) fn levels(self) -> Vec<f64> {
        // divided, so that each is the double nearest to its decimal
        let steps = |from: u32, to: u32, divisor: f64| (from..=to).map(move |i| f64::from(i) / divisor);
        match self {
            Self::Pgv => steps(2, 40, 2.0).chain(steps(5, 40, 0.2)).collect(),
            Self::Pga => {
                let parts = steps(1, 9, 400.0).chain(steps(5, 39, 200.0)).chain(steps(4, 40, 20.0));
                [0.001].into_iter().chain(parts).collect()
            }
        }
    }

    pub(crate) fn measure(self) -> IntensityMeasure {
        match self {
            Self::Pgv => IntensityMeasure::Pgv,
            Self::Pga => IntensityMeasure::Pga,
        }
    }

    fn other(self) -> IntensityMeasure {
        match self {
            Self::Pgv => IntensityMeasure::Pga,
            Self::Pga => IntensityMeasure::Pgv,
        }
    }
}

/// 2, 10 and 50 % in 50 years, 1/yr.
pub(crate) fn targets() -> Vec<f64> {
    [0.02, 0.1, 0.5].map(|probability| rate_from_probability(probability, 50.0).unwrap()).to_vec()
}

/// The hazard of both measures at a site.
pub(crate) struct Site {
    pub(crate) pgv: HazardCurve,
    pub(crate) pga: HazardCurve,
}

impl Site {
    /// A site of the project.
    pub(crate) fn from_project(name: &str) -> Self {
        Self::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../hazard").join(name.to_lowercase()))
    }

    /// A site with the curves that the project had before, which most golden numbers are for.
    pub(crate) fn former(name: &str) -> Self {
        Self::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/curves").join(name.to_lowercase()))
    }

    fn read(folder: &Path) -> Self {
        let (pgv, pga) = (&folder.join("pgv.csv"), &folder.join("pga.csv"));
        let curve = |path, measure: &str, unit: &str| read_path(path, &CsvOptions::new(measure, unit)).unwrap().curve;
        Self { pgv: curve(pgv, "PGV", "cm/s"), pga: curve(pga, "PGA", "g") }
    }

    pub(crate) fn analysis<'a>(&'a self, set: &'a RecordSet, scaled_to: ScaledTo) -> ScaledAnalysis<'a> {
        let other = if scaled_to == ScaledTo::Pgv { &self.pga } else { &self.pgv };
        self.analysis_with(set, scaled_to, other)
    }

    /// With another hazard of the other measure.
    pub(crate) fn analysis_with<'a>(
        &self,
        set: &'a RecordSet,
        scaled_to: ScaledTo,
        other: &'a HazardCurve,
    ) -> ScaledAnalysis<'a> {
        let own = if scaled_to == ScaledTo::Pgv { &self.pgv } else { &self.pga };
        ScaledAnalysis::new(set, &scaled_to.levels(), own, other, &targets(), Extrapolation::Refuse).unwrap()
    }
}

/// The first components of `pairs`, scaled to one measure.
pub(crate) fn record_set(pairs: &[RecordPair], scaled_to: ScaledTo) -> RecordSet {
    let mut events = BTreeMap::new();
    let mut records = Vec::new();
    for (index, pair) in pairs.iter().enumerate() {
        let next = events.len();
        let event = pair.metadata.get("event").map(|event| *events.entry(event.clone()).or_insert(next));
        let number = |key: &str| pair.metadata.get(key).and_then(|text| text.parse().ok());
        let value = |measure: IntensityMeasure| measure.pair_value(pair, STANDARD_GRAVITY_M_S2);
        records.push(SetRecord {
            scaled_to: value(scaled_to.measure()),
            other: value(scaled_to.other()),
            pair: index,
            event,
            seismology: Seismology {
                magnitude: number("magnitude"),
                distance_km: number("rrup_km"),
                vs30_m_s: number("vs30"),
            },
        });
    }
    RecordSet::new(records).unwrap()
}

/// Peak displacements of oscillators at their defaults under the first components, m, `[strength][record, level]`.
pub(crate) fn demands_m(pairs: &[RecordPair], scaled_to: ScaledTo, strengths: &[f64]) -> Vec<Vec<f64>> {
    let records = pairs
        .iter()
        .map(|pair| StripeRecord {
            id: &pair.id,
            accelerogram: &pair.h1,
            intensity: scaled_to.measure().pair_value(pair, STANDARD_GRAVITY_M_S2),
        })
        .collect();
    let systems: Vec<System> =
        strengths.iter().map(|&strength| System::Oscillator(Oscillator::zsbe(strength).unwrap())).collect();
    let levels = scaled_to.levels();
    let peaks = analyse(&Plan::stripes(records, &systems, &levels, true).unwrap(), &Unwatched).unwrap();
    (0..strengths.len()).map(|index| peaks.system_m(index)).collect()
}

/// Demands of one oscillator, pooled.
pub(crate) fn pooled(demands_m: &[f64], scaled_to: ScaledTo) -> PooledDemand {
    PooledDemand::new(&Stripes::new(&scaled_to.levels(), demands_m).unwrap()).unwrap()
}

/// The folder of real records, which may not be distributed.
pub(crate) fn records_folder() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/records");
    let folder = std::env::var_os("UPLIFT_RECORDS").map_or(beside, PathBuf::from);
    folder.join("manifest.csv").is_file().then_some(folder)
}
