//! A structure as written in a TOML file.
//!
//! # Keys
//! Every kind takes a geometry, and may give `uplift_displacement_m` (0.0005 if left out), `gravity_m_s2` (9.80665) and
//! the coefficient of `restitution` at an impact, which no rule needs but an analysis does. The geometry is `width_m`
//! and `height_m`, or a slenderness (`slenderness_rad` or `slenderness_deg`) and one of `size_m` (the semi-diagonal
//! `R`), `height_m`, `width_m`. A `point-mass` and a `body` give the height of their mass centre, `centre_height_m`, in
//! place of `height_m`. A tendon is anchored in the `"foundation"` or at the `"column"`.
//!
//! | kind | Table 3.1 | further keys |
//! |---|---|---|
//! | `point-mass` | row 1 | `mass_kg` |
//! | `block` | row 4, or row 2 with `displacement_of = "centre"` | `mass_kg` |
//! | `body` | row 3 | `mass_kg`, `moment_of_inertia_kg_m2` about the pivot corner |
//! | `frame` | row 5 without tendons | `columns`, `column_mass_kg` (each), `deck_mass_kg` |
//! | `restrained-frame` | row 5 | those of `frame`, `tendon_stiffness_n_m` (a column's), `tendon_anchorage` |
//! | `curved-frame` | row 6 | those of `frame`, `curvature_radius_m`, `extended_width_m` |
//!
//! # Examples
//! A block followed at its top:
//! ```
//! # let text = r#"
//! kind = "block"
//! width_m = 1.0
//! height_m = 10.0
//! mass_kg = 25000.0
//! # "#;
//! # let system = toml::from_str::<uplift_structure::StructureDescription>(text)?.resolve().unwrap();
//! # assert_eq!((system.table_row(), system.warnings().len()), (4, 0));
//! # Ok::<(), toml::de::Error>(())
//! ```
//! A column of some other shape by slenderness and size, with its moment of inertia about the pivot:
//! ```
//! # let text = r#"
//! kind = "body"
//! slenderness_deg = 8.0
//! size_m = 4.0
//! mass_kg = 12000.0
//! moment_of_inertia_kg_m2 = 230000.0
//! uplift_displacement_m = 0.001
//! # "#;
//! # let system = toml::from_str::<uplift_structure::StructureDescription>(text)?.resolve().unwrap();
//! # assert_eq!(system.table_row(), 3);
//! # Ok::<(), toml::de::Error>(())
//! ```
//! A mass on a light mast:
//! ```
//! # let text = r#"
//! kind = "point-mass"
//! width_m = 1.2
//! centre_height_m = 6.0
//! mass_kg = 8000.0
//! # "#;
//! # let system = toml::from_str::<uplift_structure::StructureDescription>(text)?.resolve().unwrap();
//! # assert_eq!(system.table_row(), 1);
//! # Ok::<(), toml::de::Error>(())
//! ```
//! A bridge that is free to rock:
//! ```
//! # let text = r#"
//! kind = "frame"
//! columns = 4
//! width_m = 1.6
//! height_m = 9.6
//! column_mass_kg = 48000.0
//! deck_mass_kg = 900000.0
//! # "#;
//! # let system = toml::from_str::<uplift_structure::StructureDescription>(text)?.resolve().unwrap();
//! # assert_eq!(system.table_row(), 5);
//! # Ok::<(), toml::de::Error>(())
//! ```
//! The same with a tendon and disc springs in each column:
//! ```
//! # let text = r#"
//! kind = "restrained-frame"
//! columns = 4
//! width_m = 1.6
//! height_m = 9.6
//! column_mass_kg = 48000.0
//! deck_mass_kg = 900000.0
//! tendon_stiffness_n_m = 3.0e6
//! tendon_anchorage = "column"
//! # "#;
//! # let system = toml::from_str::<uplift_structure::StructureDescription>(text)?.resolve().unwrap();
//! # assert_eq!(system.table_row(), 5);
//! # Ok::<(), toml::de::Error>(())
//! ```
//! The same with curved ends:
//! ```
//! # let text = r#"
//! kind = "curved-frame"
//! columns = 4
//! width_m = 1.6
//! height_m = 9.6
//! column_mass_kg = 48000.0
//! deck_mass_kg = 900000.0
//! curvature_radius_m = 2.4
//! extended_width_m = 3.6
//! # "#;
//! # let system = toml::from_str::<uplift_structure::StructureDescription>(text)?.resolve().unwrap();
//! # assert_eq!((system.table_row(), system.warnings().len()), (6, 0));
//! # Ok::<(), toml::de::Error>(())
//! ```

use serde::Deserialize;
use uplift_plausible::{UPLIFT_DISPLACEMENT, Unlikely};

use crate::block::{Block, Body, PointMass, Reference};
use crate::curved::CurvedFrame;
use crate::equivalent::{Conditions, EquivalentSystem};
use crate::error::StructureError;
use crate::frame::{Anchorage, Frame, RestrainedFrame};
use crate::geometry::Geometry;

mod audit;
mod unusual;

pub use audit::Allowed;

/// Kind of rocking structure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// All mass at a point: row 1.
    PointMass,
    /// Rectangular block: rows 2 and 4.
    Block,
    /// Body of given moment of inertia: row 3.
    Body,
    /// Columns under a deck: row 5 without tendons.
    Frame,
    /// Columns under a deck with tendons: row 5.
    RestrainedFrame,
    /// Columns with curved ends under a deck: row 6.
    CurvedFrame,
}

impl Kind {
    /// Every kind, in the order of Table 3.1.
    pub const ALL: [Self; 6] =
        [Self::PointMass, Self::Block, Self::Body, Self::Frame, Self::RestrainedFrame, Self::CurvedFrame];

    /// The kind as written in a description.
    pub fn name(self) -> &'static str {
        match self {
            Self::PointMass => "point-mass",
            Self::Block => "block",
            Self::Body => "body",
            Self::Frame => "frame",
            Self::RestrainedFrame => "restrained-frame",
            Self::CurvedFrame => "curved-frame",
        }
    }

    fn is_frame(self) -> bool {
        matches!(self, Self::Frame | Self::RestrainedFrame | Self::CurvedFrame)
    }

    /// True where the height of the mass centre is given, not that of the body.
    pub(crate) fn is_by_centre(self) -> bool {
        matches!(self, Self::PointMass | Self::Body)
    }
}

/// A structure as written: which keys belong to which kind is listed in the [module documentation](self).
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StructureDescription {
    /// Kind of structure.
    pub kind: Kind,
    /// Width `2b` of the block or column, m.
    pub width_m: Option<f64>,
    /// Height `2h` of the block or column, m.
    pub height_m: Option<f64>,
    /// Height `h` of the mass centre, m.
    pub centre_height_m: Option<f64>,
    /// Slenderness `α`, rad.
    pub slenderness_rad: Option<f64>,
    /// Slenderness `α`, degrees.
    pub slenderness_deg: Option<f64>,
    /// Size `R`: distance from the pivot corner to the mass centre, m.
    pub size_m: Option<f64>,
    /// Mass of a solitary body, kg.
    pub mass_kg: Option<f64>,
    /// Moment of inertia `I_o` about the pivot corner, kg m².
    pub moment_of_inertia_kg_m2: Option<f64>,
    /// Point of a block whose displacement is followed; the top if left out.
    pub displacement_of: Option<Reference>,
    /// Number of columns.
    pub columns: Option<u32>,
    /// Mass of one column, kg.
    pub column_mass_kg: Option<f64>,
    /// Mass of the deck, kg.
    pub deck_mass_kg: Option<f64>,
    /// Stiffness of the tendon and spring of one column, in series, N/m.
    pub tendon_stiffness_n_m: Option<f64>,
    /// Where the tendons are fixed.
    pub tendon_anchorage: Option<Anchorage>,
    /// Radius of the curved extensions, m.
    pub curvature_radius_m: Option<f64>,
    /// Width of a column end with its extensions, m.
    pub extended_width_m: Option<f64>,
    /// Uplift displacement `u_up`, m; 0.0005 if left out.
    pub uplift_displacement_m: Option<f64>,
    /// Period with closed joints, s, in place of the uplift displacement: `u_up = f̃_up/m̃ (T/2π)²` (Section 3.5).
    pub period_s: Option<f64>,
    /// Acceleration of gravity, m/s²; 9.80665 if left out.
    pub gravity_m_s2: Option<f64>,
    /// Velocity after over before an impact; whoever analyses the structure chooses where it is left out.
    pub restitution: Option<f64>,
}

impl StructureDescription {
    /// The equivalent oscillator, or every mistake of the description.
    ///
    /// Mistakes of single quantities (missing, out of range, not for this kind) and of the choice of geometry are
    /// listed together; one that takes several correct quantities to see, such as a capacity below the uplift
    /// displacement, is found once those are mended.
    ///
    /// # Errors
    /// At least one mistake, each with key, value, unit and what to do.
    pub fn resolve(&self) -> Result<EquivalentSystem, Vec<StructureError>> {
        let mistakes = audit::mistakes(self);
        if mistakes.is_empty() { self.equivalent().map_err(|mistake| vec![mistake]) } else { Err(mistakes) }
    }

    /// What the number of this `key` may be by itself; none of a key that has no number.
    pub fn allowed(key: &str) -> Option<Allowed> {
        audit::allowed(key)
    }

    /// Whether neither the uplift displacement is given nor what it follows from.
    pub fn assumes_uplift_displacement(&self) -> bool {
        self.uplift_displacement_m.is_none() && self.period_s.is_none()
    }

    /// The numbers that can be but are unlikely, mistakes of unit mostly; of a description that
    /// [`resolve`](Self::resolve) takes.
    pub fn unlikely(&self) -> Vec<Unlikely> {
        unusual::unlikely(self)
    }

    fn equivalent(&self) -> Result<EquivalentSystem, StructureError> {
        let conditions = self.conditions()?;
        let system = self.equivalent_under(conditions)?;
        let Some(period_s) = self.period_s else { return Ok(system) };
        // force and mass do not depend on it
        let uplift_m = system.uplift_force_n() / system.mass_kg() * (period_s / std::f64::consts::TAU).powi(2);
        let uplift_m = UPLIFT_DISPLACEMENT.check("uplift_displacement_m (from period_s)", uplift_m);
        let uplift_m = uplift_m.map_err(StructureError::Implausible)?;
        self.equivalent_under(Conditions::new(conditions.gravity_m_s2(), uplift_m)?)
    }

    fn equivalent_under(&self, conditions: Conditions) -> Result<EquivalentSystem, StructureError> {
        match self.kind {
            Kind::PointMass => self.point_mass()?.equivalent(conditions),
            Kind::Block => self.block()?.equivalent(self.displacement_of.unwrap_or_default(), conditions),
            Kind::Body => self.body()?.equivalent(conditions),
            Kind::Frame => self.frame()?.equivalent(conditions),
            Kind::RestrainedFrame => {
                let stiffness_n_m = self.need("tendon_stiffness_n_m", self.tendon_stiffness_n_m)?;
                let anchorage = self.tendon_anchorage.ok_or(StructureError::MissingAnchorage)?;
                RestrainedFrame::new(self.frame()?, stiffness_n_m, anchorage)?.equivalent(conditions)
            }
            Kind::CurvedFrame => {
                let radius_m = self.need("curvature_radius_m", self.curvature_radius_m)?;
                let extended_width_m = self.need("extended_width_m", self.extended_width_m)?;
                CurvedFrame::new(self.frame()?, radius_m, extended_width_m)?.equivalent(conditions)
            }
        }
    }

    /// Stiffness of the tendon and spring of each column that would give a restrained frame the displacement capacity
    /// `capacity_m` (m), N/m: the last step of Section 3.4.5. Zero where the columns have it by themselves; none for a
    /// structure of another kind.
    ///
    /// # Errors
    /// A mistake of the description, which [`resolve`](Self::resolve) lists with all others; a capacity that is not
    /// finite and positive.
    pub fn tendon_stiffness_for_capacity_n_m(&self, capacity_m: f64) -> Result<Option<f64>, StructureError> {
        let Some(anchorage) = self.tendon_anchorage.filter(|_| self.kind == Kind::RestrainedFrame) else {
            return Ok(None);
        };
        self.frame()?.tendon_stiffness_for_capacity_n_m(capacity_m, anchorage, self.conditions()?).map(Some)
    }

    /// A quantity that [`audit`] has checked.
    fn need<T>(&self, key: &'static str, value: Option<T>) -> Result<T, StructureError> {
        value.ok_or(StructureError::Missing { key, unit: "", kind: self.kind.name() })
    }

    pub(crate) fn point_mass(&self) -> Result<PointMass, StructureError> {
        PointMass::new(self.geometry()?, self.need("mass_kg", self.mass_kg)?)
    }

    pub(crate) fn block(&self) -> Result<Block, StructureError> {
        Block::new(self.geometry()?, self.need("mass_kg", self.mass_kg)?)
    }

    pub(crate) fn body(&self) -> Result<Body, StructureError> {
        let moment_of_inertia_kg_m2 = self.need("moment_of_inertia_kg_m2", self.moment_of_inertia_kg_m2)?;
        Body::new(self.geometry()?, self.need("mass_kg", self.mass_kg)?, moment_of_inertia_kg_m2)
    }

    pub(crate) fn frame(&self) -> Result<Frame, StructureError> {
        Frame::new(
            self.geometry()?,
            self.need("columns", self.columns)?,
            self.need("column_mass_kg", self.column_mass_kg)?,
            self.need("deck_mass_kg", self.deck_mass_kg)?,
        )
    }

    fn conditions(&self) -> Result<Conditions, StructureError> {
        let default = Conditions::default();
        Conditions::new(
            self.gravity_m_s2.unwrap_or(default.gravity_m_s2()),
            self.uplift_displacement_m.unwrap_or(default.uplift_displacement_m()),
        )
    }

    /// The geometry.
    ///
    /// # Errors
    /// Any but exactly one of the accepted combinations, or an invalid length.
    pub fn geometry(&self) -> Result<Geometry, StructureError> {
        let height_m =
            if self.kind.is_by_centre() { self.centre_height_m.map(|centre_m| 2.0 * centre_m) } else { self.height_m };
        let slenderness_rad = match (self.slenderness_rad, self.slenderness_deg) {
            (Some(_), Some(_)) => return Err(audit::geometry_mistake(self)),
            (rad, deg) => rad.or(deg.map(f64::to_radians)),
        };
        match (slenderness_rad, self.width_m, height_m, self.size_m) {
            (None, Some(width_m), Some(height_m), None) => Geometry::from_width_and_height(width_m, height_m),
            (Some(slenderness_rad), None, None, Some(size_m)) => {
                Geometry::from_slenderness_and_size(slenderness_rad, size_m)
            }
            (Some(slenderness_rad), None, Some(height_m), None) => {
                Geometry::from_slenderness_and_height(slenderness_rad, height_m)
            }
            (Some(slenderness_rad), Some(width_m), None, None) => {
                Geometry::from_slenderness_and_width(slenderness_rad, width_m)
            }
            _ => Err(audit::geometry_mistake(self)),
        }
    }
}
