//! A frame and its proxies under the pairs of a study: the plans, and their peaks record by record.

use uplift_engine::analysis::{Analysed, LabelledPlan, Work};
use uplift_frame::{ColumnShape, FrameError, Model, RockingFrame};
use uplift_ida::{Peaks, ShakenFrame, StripeRecord, System};
use uplift_inputs::{Record, rocking_frame};
use uplift_job::checksum::motion_key;
use uplift_job::text::thousands;
use uplift_motion::{Accelerogram, Component, Direction, Horizontal, RecordPair};
use uplift_study::{Structure, UniformRiskStudy};
use uplift_uniform_risk::{SpectraOfResult, StudyOfResult, plan_stripes, seen, shaken_upwards, stripes_of};

use super::super::opening::{ShakenRecords, required};
use super::super::sweep::{OF_STUDY, OWN, Sweep};
use crate::error::DesignError;

/// A frame with everything that it is shaken by and compared to.
pub(super) struct FrameAnalysis {
    pub(super) frame: RockingFrame,
    /// Velocity after over before an impact of the planar model, and where that comes from.
    pub(super) restitution: (f64, &'static str),
    pub(super) records: ShakenRecords,
    pub(super) pairs: Vec<RecordPair>,
    study: UniformRiskStudy,
    /// The wobbling frame; none where it is not computed.
    wobbling: Vec<System>,
    planar: Vec<System>,
    /// The study's oscillator of zero stiffness at the structure's strength, and the structure's own.
    oscillators: Vec<System>,
    /// Keys of the motions of pairs and of their components.
    keys: [Vec<String>; 2],
}

/// Peaks of every model, m, `[record, level]`.
pub(super) struct Demands {
    pub(super) wobbling_m: Option<Vec<f64>>,
    pub(super) planar_m: Vec<f64>,
    pub(super) zero_stiffness_m: Vec<f64>,
    pub(super) oscillator_m: Vec<f64>,
    /// Of every pair and level the wobbling peak, and the larger of the planar ones under its two components, m.
    pub(super) directions_m: Vec<[f64; 2]>,
    pub(super) analyses: u64,
}

impl FrameAnalysis {
    /// The frame of `structure` by the model `wanted`, and by the planar one in any case.
    pub(super) fn from_structure(
        structure: &Structure,
        source: &StudyOfResult,
        wanted: Option<Model>,
    ) -> Result<Self, DesignError> {
        let (set, pairs) = required(source.records_and_pairs(), "the risk of a frame")?;
        let frame = rocking_frame(structure)?;
        let own = structure.description.restitution;
        let restitution = own.map_or((frame.momentum_restitution(), "momentum"), |own| (own, "the structure file"));
        let of = |model: Model, restitution: f64| {
            System::Frame(Box::new(ShakenFrame { frame: frame.clone(), model, restitution }))
        };
        let wobbling = match (wanted, frame.shape()) {
            (Some(Model::Wobbling), ColumnShape::Rectangle) => return Err(FrameError::RectangleWobbles.into()),
            (Some(Model::Planar), _) | (None, ColumnShape::Rectangle) => vec![],
            (None | Some(Model::Wobbling), ColumnShape::Cylinder) => vec![of(Model::Wobbling, 1.0)],
        };
        let sweep = Sweep::from_structure(structure, &source.study)?;
        let oscillators =
            [OF_STUDY, OWN].map(|place| System::Oscillator(sweep.oscillators[place].clone())).into_iter().collect();
        let both = |pair: &RecordPair| [&pair.h1, &pair.h2].map(motion_key);
        let components: Vec<String> = pairs.iter().flat_map(both).collect();
        let joint = components.chunks(2).map(|pair| pair.join(" and ")).collect();
        Ok(Self {
            planar: vec![of(Model::Planar, restitution.0)],
            frame,
            restitution,
            keys: [joint, components],
            records: ShakenRecords::from_set(set),
            pairs,
            study: source.study.clone(),
            wobbling,
            oscillators,
        })
    }

    /// Peaks of the frame itself, m, `[run, level]`: of a wobbling frame one run a pair, whichever components of it are
    /// records.
    pub(super) fn once_a_run(&self, demands: &Demands) -> Vec<f64> {
        let Some(wobbling_m) = &demands.wobbling_m else { return demands.planar_m.clone() };
        let levels = wobbling_m.len() / self.records.count().max(1);
        wobbling_m.chunks_exact(levels.max(1)).step_by(self.per_pair()).flatten().copied().collect()
    }

    /// Pairs that move along one line, so that a second component is missing.
    pub(super) fn without_second(&self) -> Vec<&str> {
        self.pairs.iter().filter(|pair| pair.h1 == pair.h2).map(|pair| pair.id.as_str()).collect()
    }

    /// Records of a pair.
    fn per_pair(&self) -> usize {
        self.study.records.component.records_per_pair()
    }

    /// The pair of every record.
    pub(super) fn pair_of(&self) -> Vec<usize> {
        (0..self.records.count()).map(|record| record / self.per_pair()).collect()
    }

    /// Whether the records of the study are no components of pairs, but pairs seen from azimuths.
    fn is_rotated(&self) -> bool {
        matches!(self.study.records.component, Component::Rotated(_))
    }

    /// The vertical component of every pair, each so `many` times; none where the study does not ask for it.
    fn verticals(&self, many: usize) -> Vec<&Accelerogram> {
        let of_pair =
            self.records.set.records.iter().step_by(self.per_pair()).filter_map(|record| record.vertical.as_ref());
        of_pair.flat_map(|vertical| std::iter::repeat_n(&vertical.accelerogram, many)).collect()
    }

    /// The stripes of every model by one measure.
    pub(super) fn work<'a>(&'a self, measure: &SpectraOfResult, title: &str) -> Result<Work<'a>, DesignError> {
        let plan = &measure.plan;
        // both records of a pair have the intensity of the pair
        let intensity = |pair: usize| self.records.set.records[pair * self.per_pair()].intensity(plan.measure);
        let amplitude = |pair: usize| plan.measure.amplitude(intensity(pair));
        let mut plans = Vec::new();
        if !self.wobbling.is_empty() {
            let record = |(index, pair): (usize, &'a RecordPair)| StripeRecord {
                id: &pair.id,
                accelerogram: &pair.h1,
                intensity: amplitude(index),
            };
            let records = self.pairs.iter().enumerate().map(record).collect();
            let stripes = stripes_of((plan.measure, &plan.levels), records, &self.wobbling, true)?;
            let stripes = stripes.across(self.pairs.iter().map(|pair| &pair.h2).collect())?;
            plans.push(labelled(shaken_upwards(stripes, self.verticals(1))?, "pairs", &self.keys[0]));
        }
        let of_pair = |(index, pair): (usize, &'a RecordPair)| {
            let intensity = amplitude(index);
            [&pair.h1, &pair.h2].map(|accelerogram| StripeRecord { id: &pair.id, accelerogram, intensity })
        };
        let components = self.pairs.iter().enumerate().flat_map(of_pair).collect();
        let stripes = stripes_of((plan.measure, &plan.levels), components, &self.planar, true)?;
        plans.push(labelled(shaken_upwards(stripes, self.verticals(2))?, "components", &self.keys[1]));
        if self.is_rotated() {
            let record = |record: &'a Record| StripeRecord {
                id: &record.id,
                accelerogram: &record.accelerogram,
                intensity: plan.measure.amplitude(record.intensity(plan.measure)),
            };
            let records = self.records.set.records.iter().map(record).collect();
            let stripes = stripes_of((plan.measure, &plan.levels), records, &self.planar, true)?;
            plans.push(labelled(seen(stripes, &self.records.set)?, "rotated records", &self.records.motions));
        }
        let oscillators = plan_stripes(&self.study, plan, &self.records.set, &self.oscillators)?;
        plans.push(labelled(oscillators, "records", &self.records.motions));
        Ok(Work::new(title, plans))
    }

    /// What the plans of [`work`](Self::work) came to.
    pub(super) fn demands(&self, analysed: Vec<Analysed>) -> Demands {
        let analyses = analysed.iter().map(|of| of.analyses).sum();
        let mut peaks = analysed.into_iter().map(|of| of.peaks);
        let wobbling = if self.wobbling.is_empty() { None } else { peaks.next() };
        let planar = peaks.next();
        let rotated = if self.is_rotated() { peaks.next() } else { None };
        let oscillators = peaks.next();
        let levels = planar.as_ref().map_or(0, |peaks| peaks.axes().scales);
        let over_records = |peaks: Option<&Peaks>, system: usize, motion_of: &dyn Fn(usize) -> usize| -> Vec<f64> {
            let Some(peaks) = peaks else { return Vec::new() };
            (0..self.records.count())
                .flat_map(|record| peaks.row_m(motion_of(record), system).iter().copied())
                .collect()
        };
        let pair = |record: usize| record / self.per_pair();
        let is_second =
            |record: usize| self.records.set.records[record].direction == Direction::Component(Horizontal::H2);
        let component = |record: usize| 2 * pair(record) + usize::from(is_second(record));
        let direction = |wobbling: &Peaks, planar: &Peaks, pair: usize, level: usize| {
            let [one, other] = [0, 1].map(|second| planar.at_m([2 * pair + second, 0, level]));
            [wobbling.at_m([pair, 0, level]), one.max(other)]
        };
        let directions_m = wobbling.as_ref().zip(planar.as_ref()).map(|(wobbling, planar)| {
            let cells = (0..self.pairs.len()).flat_map(|pair| (0..levels).map(move |level| (pair, level)));
            cells.map(|(pair, level)| direction(wobbling, planar, pair, level)).collect()
        });
        Demands {
            planar_m: match &rotated {
                Some(rotated) => over_records(Some(rotated), 0, &|record| record),
                None => over_records(planar.as_ref(), 0, &component),
            },
            zero_stiffness_m: over_records(oscillators.as_ref(), 0, &|record| record),
            oscillator_m: over_records(oscillators.as_ref(), 1, &|record| record),
            directions_m: directions_m.unwrap_or_default(),
            wobbling_m: wobbling.map(|peaks| over_records(Some(&peaks), 0, &pair)),
            analyses,
        }
    }
}

/// A plan with its name: that of its first system.
fn labelled<'a>(plan: uplift_ida::Plan<'a>, what: &str, motions: &'a [String]) -> LabelledPlan<'a> {
    let label = plan.systems().first().map_or("", System::kind).to_owned();
    let axes = plan.axes();
    let text = format!(
        "{} {what} x {} systems x {} levels = {} analyses",
        axes.motions,
        axes.systems,
        axes.scales,
        thousands(plan.analyses())
    );
    LabelledPlan { remark: Some((label.clone(), text)), label, plan, motions, known: None }
}
