//! The frame of a structure itself, wobbling and in a plane, beside the oscillator that stands for it.
//!
//! `uplift risk` shakes a frame at every level of the study. Where it stands beside its oscillator it is shaken at
//! [`LEVELS`] levels at most, evenly spaced in the logarithm of the intensity, from the highest at which the horizontal
//! components of no record lift it: the same ones whatever is asked, so that a frame has one rate.

use serde::Serialize;
use uplift_alarms::OwnRisk;
use uplift_engine::analysis::{Analysed, LabelledPlan};
use uplift_fragility::Stripes as Stripe;
use uplift_frame::{ColumnShape, Model, RockingFrame};
use uplift_ida::{Peaks, Plan, ShakenFrame, StripeRecord, System};
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
use super::opening::{Place, ShakenRecords};
use super::pairs::Pairs;
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

/// The frame itself, as a design or the overturning of a structure shows it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrameReport {
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
    /// Wobbling under both components, then in the plane of the study's component.
    pub models: Vec<FrameModel>,
}

/// One model of the frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrameModel {
    /// `wobbling frame` or `planar frame`.
    pub model: &'static str,
    /// Velocity after over before an impact.
    pub restitution: f64,
    /// Travel of the deck at the target rate, m; infinite where it overturns more often.
    pub demand_m: f64,
    /// 90 % bands; none of a single record.
    pub bands: Option<DemandBands>,
    /// The displacement capacity is exceeded; none for a structure without one.
    pub beyond_capacity: Option<EventRisk>,
    /// It passes the limit of the frame; none of one without.
    pub beyond_limit: Option<LimitRisk>,
    /// It overturns.
    pub overturning: EventRisk,
    /// The capacity held against the demand; none for a structure without one.
    pub check: Option<OwnCheck>,
}

impl FrameReport {
    /// The wobbling frame.
    pub fn wobbling(&self) -> &FrameModel {
        &self.models[0]
    }

    /// The limit, where passing it and not overturning tells how often the frame fails.
    pub fn governing_limit(&self) -> Option<FrameLimit> {
        let wobbling = self.wobbling();
        self.limit.filter(|_| wobbling.beyond_limit.is_some_and(|limit| limit.governs(&wobbling.overturning)))
    }
}

/// Planar frames under the records of a study, as these see their pairs.
pub(super) fn in_the_plane_of_records<'a>(
    set: &'a RecordSet,
    (measure, levels): (IntensityMeasure, &[f64]),
    planar: &'a [System],
) -> Result<Plan<'a>, DesignError> {
    let record = |record: &'a Record| StripeRecord {
        id: &record.id,
        accelerogram: &record.accelerogram,
        intensity: measure.amplitude(record.intensity(measure)),
    };
    let stripes = plan_motions((measure, levels), set.records.iter().map(record).collect(), planar, true)?;
    Ok(with_components(stripes, set)?)
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

/// The frame of a structure that can wobble, by both models.
#[derive(Debug)]
pub(super) struct OwnFrame {
    wobbling: Vec<System>,
    planar: Vec<System>,
    /// Where the restitution of the wobbling model comes from, and that of the planar one.
    restitution_from: [&'static str; 2],
    /// What it must not pass before it overturns.
    pub(super) limit: Option<FrameLimit>,
    pub(super) pairs: Pairs,
}

impl OwnFrame {
    /// Whether a structure is a frame that can wobble: on cylinders.
    pub(super) fn is_described(structure: &Structure) -> bool {
        let frame = structure.rocking_frame().and_then(Result::ok);
        frame.is_some_and(|frame| frame.shape() == ColumnShape::Cylinder)
    }

    /// Whether it is one that can be shaken to the end: flat springs that stop the columns end its motion.
    pub(super) fn can_be_shaken(structure: &Structure) -> bool {
        let stops = |columns: &RestrainedColumns| columns.restrainer().is_some_and(|held| held.limit_m().is_some());
        Self::is_described(structure) && !structure.columns.as_ref().is_some_and(stops)
    }

    /// The frame of `structure`, to be shaken by `pairs`.
    pub(super) fn from_structure(structure: &Structure, pairs: Pairs) -> Result<Self, DesignError> {
        let frame = rocking_frame(structure)?;
        let own = structure.description.restitution;
        let (restitution, restitution_from) =
            own.map_or_else(|| (frame.momentum_restitution(), "momentum"), |own| (own, "the structure file"));
        Ok(Self {
            limit: FrameLimit::from_frame(structure, &frame),
            wobbling: vec![wobbling(&frame, structure)],
            planar: vec![planar(&frame, restitution)],
            restitution_from: [
                structure.wobbling_restitution.map_or("the model loses no energy", |_| "the structure file"),
                restitution_from,
            ],
            pairs,
        })
    }

    /// Becomes the frame of another structure, to be shaken by the same pairs.
    pub(super) fn change(&mut self, structure: &Structure) -> Result<(), DesignError> {
        *self = Self::from_structure(structure, std::mem::take(&mut self.pairs))?;
        Ok(())
    }

    /// Why it cannot be shaken by a measure at `levels`: its records, scaled, let it leave the ground.
    pub(super) fn leaves_the_ground(
        &self,
        set: &RecordSet,
        (measure, levels): (IntensityMeasure, &FrameLevels),
    ) -> Result<Option<String>, DesignError> {
        let verticals = self.pairs.verticals(set, 1);
        let (System::Frame(shaken), false) = (&self.wobbling[0], verticals.is_empty()) else { return Ok(None) };
        let stripes = self.pairs.level(set, (measure, &levels.values), &self.wobbling)?;
        Ok(falls(&stripes.falling(&verticals, shaken.frame.gravity_m_s2())))
    }

    /// Its models, each with the origin of its restitution.
    pub(super) fn models(&self) -> [(&System, &'static str); 2] {
        let [wobbling, planar] = self.restitution_from;
        [(&self.wobbling[0], wobbling), (&self.planar[0], planar)]
    }

    /// The levels at which it is shaken: from the last one on at which no pair of components lifts it.
    pub(super) fn levels(&self, set: &RecordSet, measure: &SpectraOfResult) -> FrameLevels {
        let System::Frame(shaken) = &self.wobbling[0] else { return FrameLevels::default() };
        let (of, threshold_m_s2) = (measure.measure(), shaken.frame.uplift_acceleration_m_s2());
        let largest = |pair: &RecordPair| {
            let [one, other] = [&pair.h1, &pair.h2].map(Accelerogram::acceleration_m_s2);
            one.iter().zip(other).map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max)
        };
        let per_amplitude = |(index, pair): (usize, &RecordPair)| largest(pair) / self.pairs.amplitude(set, of, index);
        let most = self.pairs.all.iter().enumerate().map(per_amplitude).fold(0.0, f64::max);
        let levels = &measure.plan.levels;
        let stands = |level: &f64| most * of.amplitude(*level) < threshold_m_s2;
        let places = sparse(levels, levels.iter().rposition(stands).unwrap_or(0));
        FrameLevels { values: places.iter().map(|&place| levels[place]).collect(), places }
    }

    /// Its stripes at `levels` of a measure: wobbling, then planar.
    pub(super) fn plans<'a>(
        &'a self,
        records: &'a ShakenRecords,
        (measure, levels): (IntensityMeasure, &FrameLevels),
    ) -> Result<[LabelledPlan<'a>; 2], DesignError> {
        let at = (measure, &levels.values[..]);
        let wobbling = self.pairs.shaking(&records.set, at, &self.wobbling)?;
        let planar = in_the_plane_of_records(&records.set, at, &self.planar)?;
        let of = |plan: Plan<'a>, what: &str, motions: &'a [String]| {
            let label = format!("{}, {}", measure.label(), plan.systems().first().map_or("", System::kind));
            let axes = plan.axes();
            let factors = [counted(axes.motions, what), counted(axes.scales, "level")];
            let text = cost_in_words(&factors, plan.analyses());
            LabelledPlan { remark: Some((label.clone(), text)), label, plan, motions, known: None }
        };
        Ok([of(wobbling, "pair", &self.pairs.keys), of(planar, "record", &records.motions)])
    }

    /// What the stripes of [`plans`](Self::plans) came to, of the wobbling model alone where the planar one was not
    /// shaken: the peaks, m, `[record, level]`.
    pub(super) fn peaks(&self, wobbling: &Analysed, planar: Option<&Analysed>) -> FramePeaks {
        let records = wobbling.peaks.axes().motions * self.pairs.per_pair;
        let of = |peaks: &Peaks, motion_of: &dyn Fn(usize) -> usize| -> Vec<f64> {
            (0..records).flat_map(|record| peaks.row_m(motion_of(record), 0).iter().copied()).collect()
        };
        let in_space = (&self.wobbling[0], of(&wobbling.peaks, &|record| record / self.pairs.per_pair));
        let in_plane = planar.map(|planar| (&self.planar[0], of(&planar.peaks, &|record| record)));
        let models = std::iter::once(in_space).chain(in_plane);
        FramePeaks {
            analyses: wobbling.analyses + planar.map_or(0, |planar| planar.analyses),
            models: models.map(|(system, peaks_m)| (system.kind(), system.restitution(), peaks_m)).collect(),
        }
    }
}

/// Peaks of the models of a frame, the wobbling one first.
#[derive(Debug)]
pub(super) struct FramePeaks {
    analyses: u64,
    /// Each with its restitution, m, `[record, level]`.
    models: Vec<(&'static str, f64, Vec<f64>)>,
}

impl FramePeaks {
    /// Those of each model.
    pub(super) fn each(&self) -> impl Iterator<Item = (&'static str, &[f64])> {
        self.models.iter().map(|(model, _, peaks_m)| (*model, &peaks_m[..]))
    }
}

/// Levels at which a frame is shaken.
#[derive(Debug, Clone, Default)]
pub(super) struct FrameLevels {
    /// Their positions among those of the study.
    pub(super) places: Vec<usize>,
    /// In the unit of the measure.
    pub(super) values: Vec<f64>,
}

/// What is asked of the peaks of a frame at one site.
pub(super) struct FrameQuestion<'a> {
    pub(super) levels: &'a FrameLevels,
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

impl FrameQuestion<'_> {
    /// Demand, verdict and risks by both models.
    pub(super) fn answer(&self, peaks: &FramePeaks) -> Result<FrameReport, DesignError> {
        let FrameLevels { places, values: levels } = self.levels;
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
            Ok(FrameModel {
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
        Ok(FrameReport {
            levels: levels.clone(),
            levels_of_study: self.place.measure.plan.levels.len(),
            limit: self.limit,
            proxy_beyond_limit: self.proxy_beyond_limit,
            analyses: peaks.analyses,
            models,
        })
    }
}

impl FrameReport {
    /// Risks of it that may come from outside the levels.
    pub(super) fn own_risks(&self, place: Place<'_>, scatter: &Scatter) -> Vec<OwnRisk> {
        let counts = (scatter.pairs.iter().map(Vec::len).sum(), scatter.pairs.len());
        let of = |model: &FrameModel| {
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
