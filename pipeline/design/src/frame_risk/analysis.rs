//! A frame and its proxies under the pairs of a study: the plans, and their peaks record by record.

use uplift_engine::analysis::{Analysed, LabelledPlan, Work};
use uplift_frame::{ColumnShape, FrameError, Model, RockingFrame};
use uplift_ida::{Peaks, StripeRecord, System};
use uplift_inputs::rocking_frame;
use uplift_job::checksum::motion_key;
use uplift_job::text::{cost_in_words, counted};
use uplift_motion::{Component, Direction, Horizontal, RecordPair};
use uplift_study::{Structure, UniformRiskStudy};
use uplift_uniform_risk::{SpectraOfResult, StudyOfResult, plan_motions, plan_stripes, with_verticals};

use super::super::opening::{ShakenRecords, required};
use super::super::own_structure::{self, in_the_plane_of_records};
use super::super::pairs::Pairs;
use super::super::sweep::{OF_STUDY, OWN, Sweep};
use crate::error::DesignError;

/// A frame with everything that it is shaken by and compared to.
pub(super) struct FrameAnalysis {
    pub(super) frame: RockingFrame,
    /// Velocity after over before an impact of the planar model, and where that comes from.
    pub(super) restitution: (f64, &'static str),
    pub(super) records: ShakenRecords,
    pub(super) pairs: Pairs,
    study: UniformRiskStudy,
    /// The wobbling frame; none where it is not computed.
    wobbling: Vec<System>,
    planar: Vec<System>,
    /// The study's oscillator of zero stiffness at the structure's strength, and the structure's own.
    oscillators: Vec<System>,
    /// Keys of the components of the pairs.
    component_keys: Vec<String>,
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
        let wobbling = match (wanted, frame.shape()) {
            (Some(Model::Wobbling), ColumnShape::Rectangle) => return Err(FrameError::RectangleWobbles.into()),
            (Some(Model::Planar), _) | (None, ColumnShape::Rectangle) => vec![],
            (None | Some(Model::Wobbling), ColumnShape::Cylinder) => vec![own_structure::wobbling(&frame, structure)],
        };
        let sweep = Sweep::from_structure(structure, &source.study, false)?;
        let oscillators =
            [OF_STUDY, OWN].map(|place| System::Oscillator(sweep.oscillators[place].clone())).into_iter().collect();
        let both = |pair: &RecordPair| [&pair.h1, &pair.h2].map(motion_key);
        let component_keys = pairs.iter().flat_map(both).collect();
        Ok(Self {
            planar: vec![own_structure::planar(&frame, restitution.0)],
            frame,
            restitution,
            component_keys,
            records: ShakenRecords::from_set(set),
            pairs: Pairs::new(pairs, source.study.records.component.records_per_pair()),
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
        wobbling_m.chunks_exact(levels.max(1)).step_by(self.pairs.per_pair).flatten().copied().collect()
    }

    /// Pairs that move along one line, so that a second component is missing.
    pub(super) fn without_second(&self) -> Vec<&str> {
        self.pairs.all.iter().filter(|pair| pair.h1 == pair.h2).map(|pair| pair.id.as_str()).collect()
    }

    /// The pair of every record.
    pub(super) fn pair_of(&self) -> Vec<usize> {
        (0..self.records.count()).map(|record| record / self.pairs.per_pair).collect()
    }

    /// Whether the planar frame is shaken by the records of the study: nothing else needs the components of pairs, or
    /// the records are none, but pairs seen from azimuths.
    fn is_along_records(&self) -> bool {
        self.wobbling.is_empty() || matches!(self.study.records.component, Component::Rotated(_))
    }

    /// The stripes of every model by one measure.
    pub(super) fn work<'a>(&'a self, measure: &SpectraOfResult, title: &str) -> Result<Work<'a>, DesignError> {
        let plan = &measure.plan;
        let (set, at) = (&self.records.set, (plan.measure, &plan.levels[..]));
        let mut plans = Vec::new();
        if !self.wobbling.is_empty() {
            plans.push(labelled(self.pairs.shaking(set, at, &self.wobbling)?, "pair", &self.pairs.keys));
            let of_pair = |(index, pair): (usize, &'a RecordPair)| {
                let intensity = self.pairs.amplitude(set, plan.measure, index);
                [&pair.h1, &pair.h2].map(|accelerogram| StripeRecord { id: &pair.id, accelerogram, intensity })
            };
            let components = self.pairs.all.iter().enumerate().flat_map(of_pair).collect();
            let stripes = plan_motions(at, components, &self.planar, true)?;
            let stripes = with_verticals(stripes, self.pairs.verticals(set, 2))?;
            plans.push(labelled(stripes, "component", &self.component_keys));
        }
        if self.is_along_records() {
            let stripes = in_the_plane_of_records(set, at, &self.planar)?;
            plans.push(labelled(stripes, "record", &self.records.motions));
        }
        let oscillators = plan_stripes(&self.study, plan, &self.records.set, &self.oscillators)?;
        plans.push(labelled(oscillators, "record", &self.records.motions));
        Ok(Work::new(title, plans))
    }

    /// What the plans of [`work`](Self::work) came to.
    pub(super) fn demands(&self, analysed: Vec<Analysed>) -> Demands {
        let analyses = analysed.iter().map(|of| of.analyses).sum();
        let mut peaks = analysed.into_iter().map(|of| of.peaks);
        let wobbling = if self.wobbling.is_empty() { None } else { peaks.next() };
        let planar = if self.wobbling.is_empty() { None } else { peaks.next() };
        let along_records = if self.is_along_records() { peaks.next() } else { None };
        let oscillators = peaks.next();
        let levels = planar.as_ref().map_or(0, |peaks| peaks.axes().scales);
        let over_records = |peaks: Option<&Peaks>, system: usize, motion_of: &dyn Fn(usize) -> usize| -> Vec<f64> {
            let Some(peaks) = peaks else { return Vec::new() };
            (0..self.records.count())
                .flat_map(|record| peaks.row_m(motion_of(record), system).iter().copied())
                .collect()
        };
        let pair = |record: usize| record / self.pairs.per_pair;
        let is_second =
            |record: usize| self.records.set.records[record].direction == Direction::Component(Horizontal::H2);
        let component = |record: usize| 2 * pair(record) + usize::from(is_second(record));
        let direction = |wobbling: &Peaks, planar: &Peaks, pair: usize, level: usize| {
            let [one, other] = [0, 1].map(|second| planar.at_m([2 * pair + second, 0, level]));
            [wobbling.at_m([pair, 0, level]), one.max(other)]
        };
        let directions_m = wobbling.as_ref().zip(planar.as_ref()).map(|(wobbling, planar)| {
            let cells = (0..self.pairs.all.len()).flat_map(|pair| (0..levels).map(move |level| (pair, level)));
            cells.map(|(pair, level)| direction(wobbling, planar, pair, level)).collect()
        });
        Demands {
            planar_m: match &along_records {
                Some(peaks) => over_records(Some(peaks), 0, &|record| record),
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
    let factors = [counted(axes.motions, what), counted(axes.systems, "system"), counted(axes.scales, "level")];
    let text = cost_in_words(&factors, plan.analyses());
    LabelledPlan { remark: Some((label.clone(), text)), label, plan, motions, known: None }
}
