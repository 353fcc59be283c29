//! The structure itself beside the oscillator that stands for it: a frame that can wobble, in space and in a plane, one
//! that rocks in a plane alone, or the block that rotates as the structure does.

mod report;
mod shaking;

use uplift_block::RockingBlock;
use uplift_frame::{ColumnShape, FrameError, Model, RockingFrame};
use uplift_ida::{ShakenFrame, System};
use uplift_statics::RestrainedColumns;
use uplift_study::Structure;

pub(super) use self::report::OwnQuestion;
pub use self::report::{OwnModel, OwnReport};
pub(super) use self::shaking::{OwnLevels, OwnPeaks, falls, in_the_plane_of_records};
use crate::error::DesignError;
use crate::limit::FrameLimit;
use crate::models::{block, chosen, kind, travel_over_block};
use crate::pairs::Pairs;

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

/// Why a frame is left out.
const STOPPED: &str = "its motion ends where flat springs stop the columns (when_flat = \"stop\")";

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

/// How a structure is shaken itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum OwnMotion {
    /// As a frame on cylinders, under both components of every pair.
    InSpace,
    /// As a frame whose columns do not wobble, under each record.
    InPlane,
    /// As the block that it is, or that rotates as it does.
    AsBlock,
}

impl OwnMotion {
    /// Of `structure`, unless its oscillator is to be analysed `alone`; none where that is all there is.
    ///
    /// # Errors
    /// Why a frame is none that is shaken to the end.
    pub(super) fn from_structure(structure: &Structure, alone: bool) -> Result<Option<Self>, String> {
        if alone {
            return Ok(None);
        }
        let motion = match (structure.rocking_frame(), &structure.block) {
            (Some(Ok(frame)), _) if frame.shape() == ColumnShape::Cylinder => Self::InSpace,
            (_, Some(_)) => return Ok(Some(Self::AsBlock)),
            (Some(Ok(_)), None) => Self::InPlane,
            (Some(Err(error)), None) => return Err(no_frame(&error)),
            (None, None) => return Ok(None),
        };
        // flat springs that stop the columns end the motion
        let stops = |columns: &RestrainedColumns| columns.restrainer().is_some_and(|held| held.limit_m().is_some());
        if structure.columns.as_ref().is_some_and(stops) { Err(STOPPED.to_owned()) } else { Ok(Some(motion)) }
    }

    /// Whether the pairs of the study shake it.
    pub(super) fn takes_pairs(motion: &Result<Option<Self>, String>) -> bool {
        *motion == Ok(Some(Self::InSpace))
    }
}

/// The structure itself: a frame, by one model or two, or the block that rotates as it does.
#[derive(Debug)]
pub(super) struct OwnStructure {
    /// The frame in space; none of what moves in a plane alone.
    in_space: Vec<System>,
    in_plane: Vec<System>,
    /// Where the restitution of each comes from, in this order.
    restitution_from: Vec<&'static str>,
    /// How far the structure goes where its model goes 1 m: of a block whose centre is followed half as far.
    factor: f64,
    /// What it must not pass before it overturns.
    pub(super) limit: Option<FrameLimit>,
    /// What shakes it in space; none of what moves in a plane alone.
    pairs: Option<Pairs>,
    /// What each model is, in the same order.
    kinds: Vec<&'static str>,
}

/// Why a structure has no frame that rocks.
fn no_frame(error: &FrameError) -> String {
    format!("no frame of these dimensions rocks: {error}")
}

impl OwnStructure {
    /// Whether a model of it is analysed by some command beside its oscillator.
    pub(super) fn has_model(structure: &Structure) -> bool {
        structure.block.is_some() || structure.rocking_frame().is_some()
    }

    /// Of `structure`, to be shaken in space by `pairs`, with one restitution `for_all` models in a plane where it is
    /// given; or why none of its dimensions rocks.
    pub(super) fn from_structure(
        structure: &Structure,
        (motion, pairs): (OwnMotion, Option<Pairs>),
        for_all: Option<f64>,
    ) -> Result<Result<Self, String>, DesignError> {
        match (motion, structure.rocking_frame()) {
            (OwnMotion::InSpace | OwnMotion::InPlane, Some(frame)) => Ok(frame
                .map_err(|error| no_frame(&error))
                .map(|frame| Self::frame(structure, &frame, (pairs, for_all)))),
            _ => Ok(block(structure, for_all)?.map(|(block, origin)| Self::block(structure, block, origin))),
        }
    }

    /// The same of how the structure is shaken, with why it is not although that is asked for.
    pub(super) fn or_reason(
        structure: &Structure,
        (motion, pairs): (Result<Option<OwnMotion>, String>, Option<Pairs>),
        for_all: Option<f64>,
    ) -> Result<(Option<Self>, Option<String>), DesignError> {
        let found = match motion {
            Ok(None) => return Ok((None, None)),
            Ok(Some(motion)) => Self::from_structure(structure, (motion, pairs), for_all)?,
            Err(reason) => Err(reason),
        };
        Ok(found.map_or_else(|reason| (None, Some(reason)), |itself| (Some(itself), None)))
    }

    /// The `frame` of a structure, to be shaken by `pairs` too.
    fn frame(structure: &Structure, frame: &RockingFrame, (pairs, for_all): (Option<Pairs>, Option<f64>)) -> Self {
        let (restitution, restitution_from) =
            chosen(structure, for_all).unwrap_or_else(|| (frame.momentum_restitution(), "momentum"));
        let of_wobbling = structure.wobbling_restitution.map_or("the model loses no energy", |_| "the structure file");
        let in_space: Vec<System> = pairs.iter().map(|_| wobbling(frame, structure)).collect();
        let in_plane = vec![planar(frame, restitution)];
        Self {
            limit: FrameLimit::from_structure(structure, Some(frame.columns())),
            restitution_from: in_space.iter().map(|_| of_wobbling).chain([restitution_from]).collect(),
            kinds: in_space.iter().chain(&in_plane).map(System::kind).collect(),
            in_space,
            in_plane,
            factor: 1.0,
            pairs,
        }
    }

    fn block(structure: &Structure, block: RockingBlock, origin: &'static str) -> Self {
        let factor = travel_over_block(structure, &block);
        let block = System::Block(block);
        Self {
            limit: FrameLimit::from_structure(structure, None),
            in_space: Vec::new(),
            kinds: vec![kind(&block, structure)],
            in_plane: vec![block],
            restitution_from: vec![origin],
            factor,
            pairs: None,
        }
    }

    /// Whether it is a frame under both components.
    pub(super) fn wobbles(&self) -> bool {
        !self.in_space.is_empty()
    }

    /// Its models, the one that decides first, each with what it is, a word for tables.
    pub(super) fn models(&self) -> impl Iterator<Item = (&System, &'static str)> {
        self.in_space.iter().chain(&self.in_plane).zip(self.kinds.iter().copied())
    }

    /// Where the restitution of each comes from, in this order.
    pub(super) fn restitution_from(&self) -> &[&'static str] {
        &self.restitution_from
    }

    /// Becomes what another structure of the same motion is, to be shaken by the same pairs; stays as it is where no
    /// block rotates as that does, and says why.
    pub(super) fn change(&mut self, structure: &Structure, motion: OwnMotion) -> Result<Option<String>, DesignError> {
        match Self::from_structure(structure, (motion, self.pairs.take()), None)? {
            Ok(other) => *self = other,
            Err(reason) => return Ok(Some(reason)),
        }
        Ok(None)
    }
}
