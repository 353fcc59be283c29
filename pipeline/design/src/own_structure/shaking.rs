//! At which levels the structure itself is shaken, and what comes of it.
//!
//! `uplift risk` shakes a frame at every level of the study. A frame in space that stands beside its oscillator is
//! shaken at [`LEVELS`] levels at most, evenly spaced in the logarithm of the intensity, from the highest at which the
//! horizontal components of no record lift it: the same ones whatever is asked, so that it has one rate. What moves in
//! a plane alone takes a small part of the time, and is shaken at all of them.

use uplift_engine::analysis::{Analysed, LabelledPlan};
use uplift_ida::{Plan, StripeRecord, System};
use uplift_inputs::{Record, RecordSet};
use uplift_job::text::{cost_in_words, counted};
use uplift_motion::{Accelerogram, IntensityMeasure, RecordPair};
use uplift_uniform_risk::{SpectraOfResult, plan_motions, with_components};

use super::OwnStructure;
use crate::error::DesignError;
use crate::opening::ShakenRecords;
use crate::pairs::verticals;

/// Most levels at which a frame in space is shaken beside its oscillator.
const LEVELS: usize = 28;

impl OwnStructure {
    /// Why it cannot be shaken by a measure at `levels`: its records, scaled, let it leave the ground.
    pub(crate) fn leaves_the_ground(
        &self,
        set: &RecordSet,
        (measure, levels): (IntensityMeasure, &OwnLevels),
    ) -> Result<Option<String>, DesignError> {
        let at = (measure, &levels.values[..]);
        let (stripes, verticals) = match &self.pairs {
            Some(pairs) => (pairs.level(set, at, &self.in_space)?, pairs.verticals(set, 1)),
            None => (along_records(set, at, &self.in_plane)?, verticals(set, 1).collect()),
        };
        let gravity_m_s2 = self.in_plane.iter().find_map(System::gravity_m_s2).filter(|_| !verticals.is_empty());
        Ok(gravity_m_s2.and_then(|gravity_m_s2| falls(&stripes.falling(&verticals, gravity_m_s2))))
    }

    /// The levels at which it is shaken: a frame in space from the last one on at which both components of no pair lift
    /// it, thinned; what moves in a plane at all.
    pub(crate) fn levels(&self, set: &RecordSet, measure: &SpectraOfResult) -> OwnLevels {
        let levels = &measure.plan.levels;
        let (Some(System::Frame(shaken)), Some(pairs)) = (self.in_space.first(), &self.pairs) else {
            return OwnLevels { places: (0..levels.len()).collect(), values: levels.to_vec() };
        };
        let (of, threshold_m_s2) = (measure.measure(), shaken.frame.uplift_acceleration_m_s2());
        let largest = |pair: &RecordPair| {
            let [one, other] = [&pair.h1, &pair.h2].map(Accelerogram::acceleration_m_s2);
            one.iter().zip(other).map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max)
        };
        let per_amplitude = |(index, pair): (usize, &RecordPair)| largest(pair) / pairs.amplitude(set, of, index);
        let most = pairs.all.iter().enumerate().map(per_amplitude).fold(0.0, f64::max);
        let stands = |level: &f64| most * of.amplitude(*level) < threshold_m_s2;
        let places = sparse(levels, levels.iter().rposition(stands).unwrap_or(0));
        OwnLevels { values: places.iter().map(|&place| levels[place]).collect(), places }
    }

    /// The stripes of each of its [models](Self::models) at `levels` of a measure.
    pub(crate) fn plans<'a>(
        &'a self,
        records: &'a ShakenRecords,
        (measure, levels): (IntensityMeasure, &OwnLevels),
    ) -> Result<Vec<LabelledPlan<'a>>, DesignError> {
        let at = (measure, &levels.values[..]);
        let of = |plan: Plan<'a>, kind: &str, what: &str, motions: &'a [String]| {
            let label = format!("{}, {kind}", measure.label());
            let axes = plan.axes();
            let factors = [counted(axes.motions, what), counted(axes.scales, "level")];
            let is_costly = matches!(plan.systems().first(), Some(System::Frame(_)));
            let remark = is_costly.then(|| (label.clone(), cost_in_words(&factors, plan.analyses())));
            LabelledPlan { remark, label, plan, motions, known: None }
        };
        let mut plans = Vec::new();
        if let Some(pairs) = &self.pairs {
            plans.push(of(pairs.shaking(&records.set, at, &self.in_space)?, self.kinds[0], "pair", &pairs.keys));
        }
        let kind = self.kinds[self.in_space.len()];
        plans.push(of(in_the_plane_of_records(&records.set, at, &self.in_plane)?, kind, "record", &records.motions));
        Ok(plans)
    }

    /// What the stripes of [`plans`](Self::plans) came to, of the first models alone where the others were not shaken:
    /// the peaks, m, `[record, level]`.
    pub(crate) fn peaks(&self, analysed: &[Analysed]) -> OwnPeaks {
        let per_pair = self.pairs.as_ref().map_or(1, |pairs| pairs.per_pair);
        let of = |(place, ((system, kind), analysed)): (usize, ((&System, &'static str), &Analysed))| {
            // all records of a pair are one run in space
            let per_motion = if place < self.in_space.len() { per_pair } else { 1 };
            let records = 0..analysed.peaks.axes().motions * per_motion;
            let peaks_m = records.flat_map(|record| analysed.peaks.row_m(record / per_motion, 0));
            (kind, system.restitution(), peaks_m.map(|peak_m| self.factor * peak_m).collect())
        };
        let models = self.models().zip(analysed);
        OwnPeaks { analyses: analysed.iter().map(|of| of.analyses).sum(), models: models.enumerate().map(of).collect() }
    }
}

/// Peaks of the models of a structure, the one that decides first.
#[derive(Debug)]
pub(crate) struct OwnPeaks {
    pub(super) analyses: u64,
    /// Each with its restitution, m, `[record, level]`.
    pub(super) models: Vec<(&'static str, f64, Vec<f64>)>,
}

impl OwnPeaks {
    /// Those of each model.
    pub(crate) fn each(&self) -> impl Iterator<Item = (&'static str, &[f64])> {
        self.models.iter().map(|(model, _, peaks_m)| (*model, &peaks_m[..]))
    }
}

/// Levels at which a structure is shaken itself.
#[derive(Debug, Clone, Default)]
pub(crate) struct OwnLevels {
    /// Their positions among those of the study.
    pub(crate) places: Vec<usize>,
    /// In the unit of the measure.
    pub(crate) values: Vec<f64>,
}

/// What moves in a plane under the records of a study, as these see their pairs.
pub(crate) fn in_the_plane_of_records<'a>(
    set: &'a RecordSet,
    at: (IntensityMeasure, &[f64]),
    planar: &'a [System],
) -> Result<Plan<'a>, DesignError> {
    Ok(with_components(along_records(set, at, planar)?, set)?)
}

/// The same along each record alone.
fn along_records<'a>(
    set: &'a RecordSet,
    (measure, levels): (IntensityMeasure, &[f64]),
    planar: &'a [System],
) -> Result<Plan<'a>, DesignError> {
    let record = |record: &'a Record| StripeRecord {
        id: &record.id,
        accelerogram: &record.accelerogram,
        intensity: measure.amplitude(record.intensity(measure)),
    };
    Ok(plan_motions((measure, levels), set.records.iter().map(record).collect(), planar, true)?)
}

/// Why a structure is left out under records whose ground falls under it.
pub(crate) fn falls(falling: &[String]) -> Option<String> {
    let first = falling.first()?;
    Some(match falling.len() {
        1 => format!("the ground falls as fast as gravity under {first}, where no model of it holds"),
        many => {
            format!("the ground falls as fast as gravity under {many} records, where no model of it holds: {first}, …")
        }
    })
}

/// At most [`LEVELS`] of the levels from the `first` on, evenly spaced in their logarithm; all where they are few.
fn sparse(levels: &[f64], first: usize) -> Vec<usize> {
    let last = levels.len() - 1;
    if levels.len() <= LEVELS {
        return (0..levels.len()).collect();
    }
    if last - first < LEVELS {
        return (first..=last).collect();
    }
    let [from, to] = [levels[first], levels[last]].map(f64::ln);
    let nearest = |step: usize| {
        let wanted = from + (to - from) * step as f64 / (LEVELS - 1) as f64;
        let distance = |place: &usize| (levels[*place].ln() - wanted).abs();
        (first..=last).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(last)
    };
    let mut places: Vec<usize> = (0..LEVELS).map(nearest).collect();
    places.dedup();
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_levels_are_thinned_evenly_and_few_are_kept() {
        let few: Vec<f64> = (1..=28).map(f64::from).collect();
        assert_eq!(sparse(&few, 9), (0..28).collect::<Vec<_>>());
        let many: Vec<f64> = (0..200).map(|step| 1.05_f64.powi(step)).collect();
        let thin = sparse(&many, 37);
        assert_eq!((thin.len(), thin[0], thin[27]), (LEVELS, 37, 199));
        assert!(thin.windows(2).all(|pair| pair[1] == pair[0] + 6), "{thin:?}");
        assert_eq!(sparse(&many, 180), (180..200).collect::<Vec<_>>());
    }
}
