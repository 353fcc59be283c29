//! The structure itself beside the oscillator that stands for it: a frame that can wobble, in space and in a plane, or
//! the block that rotates as it does.
//!
//! `uplift risk` shakes a frame at every level of the study. Where it stands beside its oscillator it is shaken at
//! [`LEVELS`] levels at most, evenly spaced in the logarithm of the intensity, from the highest at which the horizontal
//! components of no record lift it: the same ones whatever is asked, so that a frame has one rate. A block takes a
//! small part of the time, and is shaken at all of them.

use serde::Serialize;
use uplift_alarms::OwnRisk;
use uplift_block::RockingBlock;
use uplift_engine::analysis::{Analysed, LabelledPlan};
use uplift_fragility::Stripes as Stripe;
use uplift_frame::{ColumnShape, Model, RockingFrame};
use uplift_ida::{Plan, ShakenFrame, StripeRecord, System, WOBBLING_FRAME};
use uplift_inputs::{Record, RecordSet, rocking_frame};
use uplift_job::text::{cost_in_words, counted};
use uplift_motion::{Accelerogram, IntensityMeasure, RecordPair};
use uplift_risk::{PooledDemand, SiteWeights, StripeWeights};
use uplift_statics::RestrainedColumns;
use uplift_study::Structure;
use uplift_uniform_risk::{EventRisk, SpectraOfResult, plan_motions, with_components};

use super::certainty::{DemandBands, Scatter, demand_bands};
use super::hazard::Hazard;
use super::limit::{FrameLimit, LimitRisk};
use super::models::block;
use super::opening::{Place, ShakenRecords};
use super::pairs::{Pairs, verticals};
use super::risk::{OVERTURNING_M, bounded, own_risk, risk_of_exceeding};
use super::rules::OwnCheck;
use crate::error::DesignError;

/// Most levels at which a frame is shaken beside its oscillator.
const LEVELS: usize = 28;

/// What the models of a frame leave out.
pub(super) fn what_frames_leave_out(structure: &Structure) -> String {
    format!(
        "{}, and its deck does not turn; the planar one is shaken by one component alone, which is \
         unconservative (Section 6.2.3)",
        loss(structure)
    )
}

/// What the wobbling model of a frame loses, in words.
pub(super) fn loss(structure: &Structure) -> String {
    match structure.wobbling_restitution {
        None => "the wobbling model loses no energy by impact or friction".to_owned(),
        Some(kept) => {
            format!("the wobbling model keeps {kept} of its velocity past the upright (wobbling_restitution)")
        }
    }
}

/// Why a frame that can wobble is left out, ...
pub(super) const STOPPED: &str = "its motion ends where flat springs stop the columns (when_flat = \"stop\")";

/// ... and why one is under records whose ground falls under it.
pub(super) fn falls(falling: &[String]) -> Option<String> {
    let first = falling.first()?;
    Some(match falling.len() {
        1 => format!("the ground falls as fast as gravity under {first}, where no model of it holds"),
        many => {
            format!("the ground falls as fast as gravity under {many} records, where no model of it holds: {first}, …")
        }
    })
}

/// The structure itself, as a design shows it: a frame that can wobble, or a block.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OwnReport {
    /// Levels at which it was shaken, in the unit of the measure.
    pub levels: Vec<f64>,
    /// Levels of the study.
    #[serde(skip)]
    pub levels_of_study: usize,
    /// What it must not pass before it overturns; none where there is nothing.
    pub limit: Option<FrameLimit>,
    /// How often its proxy, the equivalent oscillator, moves as far as that.
    pub proxy_beyond_limit: Option<LimitRisk>,
    /// Nonlinear time histories.
    pub analyses: u64,
    /// Wobbling under both components, then in the plane of the study's component; or the block alone.
    pub models: Vec<OwnModel>,
}

/// One model of the structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OwnModel {
    /// `wobbling frame`, `planar frame` or `block`.
    pub model: &'static str,
    /// Velocity after over before an impact.
    pub restitution: f64,
    /// Travel of the deck, or of the point of a block that its file follows, at the target rate, m; infinite where it
    /// overturns more often.
    pub demand_m: f64,
    /// 90 % bands; none of a single record.
    pub bands: Option<DemandBands>,
    /// The displacement capacity is exceeded; none for a structure without one.
    pub beyond_capacity: Option<EventRisk>,
    /// It passes its limit; none of one without.
    pub beyond_limit: Option<LimitRisk>,
    /// It overturns.
    pub overturning: EventRisk,
    /// The capacity held against the demand; none for a structure without one.
    pub check: Option<OwnCheck>,
}

impl OwnReport {
    /// The model that decides: the wobbling frame, or the block.
    pub fn decisive(&self) -> &OwnModel {
        &self.models[0]
    }

    /// What it is in a word: `frame` or `block`.
    pub fn noun(&self) -> &'static str {
        if self.decisive().model == WOBBLING_FRAME { "frame" } else { self.decisive().model }
    }

    /// The limit, where passing it and not overturning tells how often the structure fails.
    pub fn governing_limit(&self) -> Option<FrameLimit> {
        let own = self.decisive();
        self.limit.filter(|_| own.beyond_limit.is_some_and(|limit| limit.governs(&own.overturning)))
    }
}

/// What moves in a plane under the records of a study, as these see their pairs.
pub(super) fn in_the_plane_of_records<'a>(
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

/// The wobbling frame of `structure`, with the rest and the loss that its file has.
pub(super) fn wobbling(frame: &RockingFrame, structure: &Structure) -> System {
    System::Frame(Box::new(ShakenFrame {
        frame: frame.clone(),
        model: Model::Wobbling,
        restitution: structure.wobbling_restitution.unwrap_or(1.0),
        rest_amplitude_rad: structure.rest_amplitude_rad,
    }))
}

/// A frame in a plane, whose rest is proved.
pub(super) fn planar(frame: &RockingFrame, restitution: f64) -> System {
    System::Frame(Box::new(ShakenFrame {
        frame: frame.clone(),
        model: Model::Planar,
        restitution,
        rest_amplitude_rad: None,
    }))
}

/// The structure itself: a frame that can wobble, by both models, or the block that rotates as it does.
#[derive(Debug)]
pub(super) struct OwnStructure {
    /// The frame in space; none of a block.
    in_space: Vec<System>,
    in_plane: Vec<System>,
    /// Where the restitution of each comes from, in this order.
    restitution_from: Vec<&'static str>,
    /// How far the structure goes where its model goes 1 m: of a block whose centre is followed half as far.
    factor: f64,
    /// What it must not pass before it overturns.
    pub(super) limit: Option<FrameLimit>,
    /// What shakes it in space; none of a block.
    pairs: Option<Pairs>,
}

impl OwnStructure {
    /// Whether a structure is a frame that can wobble: on cylinders.
    pub(super) fn wobbles(structure: &Structure) -> bool {
        let frame = structure.rocking_frame().and_then(Result::ok);
        frame.is_some_and(|frame| frame.shape() == ColumnShape::Cylinder)
    }

    /// Whether it is one that can be shaken to the end: flat springs that stop the columns end its motion.
    pub(super) fn can_be_shaken(structure: &Structure) -> bool {
        let stops = |columns: &RestrainedColumns| columns.restrainer().is_some_and(|held| held.limit_m().is_some());
        Self::wobbles(structure) && !structure.columns.as_ref().is_some_and(stops)
    }

    /// The frame of `structure` where there are `pairs` to shake it, else the block; or why no block rotates as it
    /// does.
    pub(super) fn from_structure(
        structure: &Structure,
        pairs: Option<Pairs>,
    ) -> Result<Result<Self, String>, DesignError> {
        match pairs {
            Some(pairs) => Ok(Ok(Self::frame(structure, pairs)?)),
            None => Ok(block(structure, None)?.map(|(block, origin)| Self::block(structure, block, origin))),
        }
    }

    /// The frame of `structure`, to be shaken by `pairs`.
    pub(super) fn frame(structure: &Structure, pairs: Pairs) -> Result<Self, DesignError> {
        let frame = rocking_frame(structure)?;
        let own = structure.description.restitution;
        let (restitution, restitution_from) =
            own.map_or_else(|| (frame.momentum_restitution(), "momentum"), |own| (own, "the structure file"));
        Ok(Self {
            limit: FrameLimit::from_structure(structure, Some(frame.columns())),
            in_space: vec![wobbling(&frame, structure)],
            in_plane: vec![planar(&frame, restitution)],
            restitution_from: vec![
                structure.wobbling_restitution.map_or("the model loses no energy", |_| "the structure file"),
                restitution_from,
            ],
            factor: 1.0,
            pairs: Some(pairs),
        })
    }

    fn block(structure: &Structure, block: RockingBlock, origin: &'static str) -> Self {
        // both are about to fall there
        let factor = structure.system.capacity_m().map_or(1.0, |own_m| own_m / (2.0 * block.half_width_m()));
        Self {
            limit: FrameLimit::from_structure(structure, None),
            in_space: Vec::new(),
            in_plane: vec![System::Block(block)],
            restitution_from: vec![origin],
            factor,
            pairs: None,
        }
    }

    /// Why it cannot be shaken by a measure at `levels`: its records, scaled, let it leave the ground.
    pub(super) fn leaves_the_ground(
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

    /// Its models, each with the origin of its restitution; the one that decides first.
    pub(super) fn models(&self) -> impl Iterator<Item = (&System, &'static str)> {
        self.in_space.iter().chain(&self.in_plane).zip(self.restitution_from.iter().copied())
    }

    /// The levels at which it is shaken: a block at all, a frame from the last one on at which no pair of components
    /// lifts it.
    pub(super) fn levels(&self, set: &RecordSet, measure: &SpectraOfResult) -> OwnLevels {
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
    pub(super) fn plans<'a>(
        &'a self,
        records: &'a ShakenRecords,
        (measure, levels): (IntensityMeasure, &OwnLevels),
    ) -> Result<Vec<LabelledPlan<'a>>, DesignError> {
        let at = (measure, &levels.values[..]);
        let of = |plan: Plan<'a>, what: &str, motions: &'a [String]| {
            let label = format!("{}, {}", measure.label(), plan.systems().first().map_or("", System::kind));
            let axes = plan.axes();
            let factors = [counted(axes.motions, what), counted(axes.scales, "level")];
            // a block costs next to nothing
            let remark = self.pairs.as_ref().map(|_| (label.clone(), cost_in_words(&factors, plan.analyses())));
            LabelledPlan { remark, label, plan, motions, known: None }
        };
        let mut plans = Vec::new();
        if let Some(pairs) = &self.pairs {
            plans.push(of(pairs.shaking(&records.set, at, &self.in_space)?, "pair", &pairs.keys));
        }
        plans.push(of(in_the_plane_of_records(&records.set, at, &self.in_plane)?, "record", &records.motions));
        Ok(plans)
    }

    /// What the stripes of [`plans`](Self::plans) came to, of the first models alone where the others were not shaken:
    /// the peaks, m, `[record, level]`.
    pub(super) fn peaks(&self, analysed: &[Analysed]) -> OwnPeaks {
        let per_pair = self.pairs.as_ref().map_or(1, |pairs| pairs.per_pair);
        let of = |(place, (system, analysed)): (usize, (&System, &Analysed))| {
            // all records of a pair are one run in space
            let per_motion = if place < self.in_space.len() { per_pair } else { 1 };
            let records = 0..analysed.peaks.axes().motions * per_motion;
            let peaks_m = records.flat_map(|record| analysed.peaks.row_m(record / per_motion, 0));
            (system.kind(), system.restitution(), peaks_m.map(|peak_m| self.factor * peak_m).collect())
        };
        let models = self.models().map(|(system, _)| system).zip(analysed);
        OwnPeaks { analyses: analysed.iter().map(|of| of.analyses).sum(), models: models.enumerate().map(of).collect() }
    }

    /// Becomes what another structure is, to be shaken by the same pairs; stays as it is where no block rotates as that
    /// does, and says why.
    pub(super) fn change(&mut self, structure: &Structure) -> Result<Option<String>, DesignError> {
        match Self::from_structure(structure, self.pairs.take())? {
            Ok(other) => *self = other,
            Err(reason) => return Ok(Some(reason)),
        }
        Ok(None)
    }
}

/// Peaks of the models of a structure, the one that decides first.
#[derive(Debug)]
pub(super) struct OwnPeaks {
    analyses: u64,
    /// Each with its restitution, m, `[record, level]`.
    models: Vec<(&'static str, f64, Vec<f64>)>,
}

impl OwnPeaks {
    /// Those of each model.
    pub(super) fn each(&self) -> impl Iterator<Item = (&'static str, &[f64])> {
        self.models.iter().map(|(model, _, peaks_m)| (*model, &peaks_m[..]))
    }
}

/// Levels at which a structure is shaken itself.
#[derive(Debug, Clone, Default)]
pub(super) struct OwnLevels {
    /// Their positions among those of the study.
    pub(super) places: Vec<usize>,
    /// In the unit of the measure.
    pub(super) values: Vec<f64>,
}

/// What is asked of the peaks of a structure at one site.
pub(super) struct OwnQuestion<'a> {
    pub(super) levels: &'a OwnLevels,
    pub(super) place: Place<'a>,
    pub(super) weights: &'a SiteWeights<'a>,
    pub(super) hazard: &'a Hazard<'a>,
    pub(super) scatter: &'a Scatter,
    /// Rate of the demand, 1/yr.
    pub(super) target_per_year: f64,
    /// Years that probabilities refer to.
    pub(super) years: f64,
    /// Displacement capacity of the structure, m.
    pub(super) capacity_m: Option<f64>,
    pub(super) safety_factor: f64,
    pub(super) limit: Option<FrameLimit>,
    pub(super) proxy_beyond_limit: Option<LimitRisk>,
}

impl OwnQuestion<'_> {
    /// Demand, verdict and risks by each model.
    pub(super) fn answer(&self, peaks: &OwnPeaks) -> Result<OwnReport, DesignError> {
        let OwnLevels { places, values: levels } = self.levels;
        let mean: StripeWeights = self.hazard.mean.at_levels(places)?;
        let hazard = self.hazard.at_levels(&mean, places)?;
        let repaired = self.weights.repaired().map(|runs| runs.at_levels(places)).transpose()?;
        let weights = SiteWeights::new(&mean, repaired.as_ref());
        let model = |(model, restitution, peaks_m): &(&'static str, f64, Vec<f64>)| {
            let pool = PooledDemand::new(&Stripe::new(levels, peaks_m)?)?;
            let risk = |threshold_m: f64| -> Result<EventRisk, DesignError> {
                let risk = risk_of_exceeding(&pool, &weights, threshold_m, self.years)?;
                Ok(bounded(risk, &weights, &self.scatter.pairs))
            };
            let demand_m = weights.curve(&pool)?.exact_ordinate(self.target_per_year)?.displacement_m;
            let asked = (self.target_per_year, 1.0, self.capacity_m);
            let bands = demand_bands(&pool, (&hazard, repaired.as_ref()), self.scatter, asked)?;
            let beyond_limit = |limit: FrameLimit| {
                let asked = (limit.displacement_m, self.years);
                LimitRisk::new(&pool, (&hazard, repaired.as_ref()), self.scatter, asked)
            };
            Ok(OwnModel {
                model,
                restitution: *restitution,
                demand_m,
                bands,
                beyond_capacity: self.capacity_m.map(risk).transpose()?,
                beyond_limit: self.limit.map(beyond_limit).transpose()?,
                overturning: risk(OVERTURNING_M)?,
                check: self.capacity_m.map(|capacity_m| OwnCheck::new(capacity_m, demand_m, self.safety_factor)),
            })
        };
        let models = peaks.models.iter().map(model).collect::<Result<_, DesignError>>()?;
        Ok(OwnReport {
            levels: levels.clone(),
            levels_of_study: self.place.measure.plan.levels.len(),
            limit: self.limit,
            proxy_beyond_limit: self.proxy_beyond_limit,
            analyses: peaks.analyses,
            models,
        })
    }
}

impl OwnReport {
    /// Risks of it that may come from outside the levels.
    pub(super) fn own_risks(&self, place: Place<'_>, scatter: &Scatter) -> Vec<OwnRisk> {
        let counts = (scatter.pairs.iter().map(Vec::len).sum(), scatter.pairs.len());
        let of = |model: &OwnModel| {
            let event = format!("overturning of the {}", model.model);
            own_risk((&event, model.overturning), (place.name, place.measure), counts)
        };
        self.models.iter().map(of).collect()
    }
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
