//! The structure itself beside the oscillator that stands for it: a frame that can wobble, in space and in a plane, one
//! that rocks in a plane alone, or the block that rotates as the structure does.

mod report;
mod shaking;

use uplift_block::RockingBlock;
use uplift_frame::{ColumnShape, Model, RockingFrame};
use uplift_ida::{ShakenFrame, System};
use uplift_inputs::rocking_frame;
use uplift_statics::RestrainedColumns;
use uplift_structure::Kind;
use uplift_study::Structure;

pub(super) use self::report::OwnQuestion;
pub use self::report::{OwnModel, OwnReport};
pub(super) use self::shaking::{OwnLevels, OwnPeaks, falls, in_the_plane_of_records};
use crate::error::DesignError;
use crate::limit::FrameLimit;
use crate::models::block;
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

/// The kind of the block that rotates as another structure does.
const EQUIVALENT_BLOCK: &str = "equivalent block";

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
    /// Why a frame cannot be shaken to the end.
    pub(super) fn from_structure(structure: &Structure, alone: bool) -> Result<Option<Self>, &'static str> {
        if alone {
            return Ok(None);
        }
        let shape = structure.rocking_frame().and_then(Result::ok).map(|frame| frame.shape());
        let motion = match (shape, &structure.block) {
            (Some(ColumnShape::Cylinder), _) => Self::InSpace,
            (_, Some(_)) => return Ok(Some(Self::AsBlock)),
            (Some(ColumnShape::Rectangle), None) => Self::InPlane,
            (None, None) => return Ok(None),
        };
        // flat springs that stop the columns end the motion
        let stops = |columns: &RestrainedColumns| columns.restrainer().is_some_and(|held| held.limit_m().is_some());
        if structure.columns.as_ref().is_some_and(stops) { Err(STOPPED) } else { Ok(Some(motion)) }
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
    /// Whether its block stands for another structure.
    is_equivalent: bool,
}

impl OwnStructure {
    /// Whether a model of it is analysed by some command beside its oscillator.
    pub(super) fn has_model(structure: &Structure) -> bool {
        structure.block.is_some() || structure.rocking_frame().is_some()
    }

    /// Of `structure`, to be shaken in space by `pairs`; or why no block rotates as it does.
    pub(super) fn from_structure(
        structure: &Structure,
        (motion, pairs): (OwnMotion, Option<Pairs>),
    ) -> Result<Result<Self, String>, DesignError> {
        match motion {
            OwnMotion::InSpace | OwnMotion::InPlane => Ok(Ok(Self::frame(structure, pairs)?)),
            OwnMotion::AsBlock => {
                Ok(block(structure, None)?.map(|(block, origin)| Self::block(structure, block, origin)))
            }
        }
    }

    /// The frame of `structure`, to be shaken by `pairs` too.
    fn frame(structure: &Structure, pairs: Option<Pairs>) -> Result<Self, DesignError> {
        let frame = rocking_frame(structure)?;
        let own = structure.description.restitution;
        let (restitution, restitution_from) =
            own.map_or_else(|| (frame.momentum_restitution(), "momentum"), |own| (own, "the structure file"));
        let of_wobbling = structure.wobbling_restitution.map_or("the model loses no energy", |_| "the structure file");
        let in_space = pairs.as_ref().map(|_| wobbling(&frame, structure));
        Ok(Self {
            limit: FrameLimit::from_structure(structure, Some(frame.columns())),
            restitution_from: in_space.iter().map(|_| of_wobbling).chain([restitution_from]).collect(),
            in_space: in_space.into_iter().collect(),
            in_plane: vec![planar(&frame, restitution)],
            factor: 1.0,
            pairs,
            is_equivalent: false,
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
            is_equivalent: structure.description.kind != Kind::Block,
        }
    }

    /// Whether it is a frame under both components.
    pub(super) fn wobbles(&self) -> bool {
        !self.in_space.is_empty()
    }

    /// The kind of a model of it, a word for tables.
    fn kind(&self, model: &System) -> &'static str {
        match model {
            System::Block(_) if self.is_equivalent => EQUIVALENT_BLOCK,
            _ => model.kind(),
        }
    }

    /// Its models, each with the origin of its restitution; the one that decides first.
    pub(super) fn models(&self) -> impl Iterator<Item = (&System, &'static str)> {
        self.in_space.iter().chain(&self.in_plane).zip(self.restitution_from.iter().copied())
    }

    /// Becomes what another structure of the same motion is, to be shaken by the same pairs; stays as it is where no
    /// block rotates as that does, and says why.
    pub(super) fn change(&mut self, structure: &Structure, motion: OwnMotion) -> Result<Option<String>, DesignError> {
        match Self::from_structure(structure, (motion, self.pairs.take()))? {
            Ok(other) => *self = other,
            Err(reason) => return Ok(Some(reason)),
        }
        Ok(None)
    }
}
