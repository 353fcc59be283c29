//! From a rocking structure to the oscillator it is equivalent to, and from that oscillator's demand to a design.
//!
//! Equations, tables and sections are those of Reggiani Manzo's dissertation, Chapters 2, 3, 5 and 6.
//!
//! | module | what is in it |
//! |---|---|
//! | [`geometry`] | width, height, slenderness and size of a block or column |
//! | [`block`] | solitary bodies: Table 3.1, rows 1 to 4 |
//! | [`frame`] | columns under a deck, free or restrained by tendons: row 5, Eq. 6.1 and 6.2 |
//! | [`curved`] | columns with curved extensions of their ends: row 6 |
//! | [`equivalent`] | the oscillator all of them lead to (Eq. 3.1–3.4) |
//! | [`rigid`] | the solitary block that rotates exactly as a structure does (Section 2.4.3) |
//! | [`rule`] | equal displacement and equal energy: from the ZSBE demand to the structure's (Eq. 3.8–3.11, 3.14) |
//! | [`design`](mod@design) | required capacity and check of Section 3.4.5 (Eq. 3.15) |
//! | [`description`] | a structure as written in a TOML file |
//!
//! # From a spectrum to a structure
//! A spectrum gives the displacement of a ZSBE oscillator under the ground motion itself. Table 3.1's oscillator is
//! driven by `Γ` times that motion (Eq. 3.4). Since all forces scale together, its displacement is exactly `Γ` times
//! that of the oscillator of strength `η/Γ` and uplift displacement `u_up/Γ` under the motion itself, and `η/Γ = α` in
//! every row: a rigid structure uplifts at `α g`. So:
//!
//! 1. read the spectrum at [`EquivalentSystem::spectral_strength`];
//! 2. multiply by `Γ`: [`EquivalentSystem::zero_stiffness_demand_m`];
//! 3. apply a [`Rule`] and compare with the capacity: [`Check`].
//!
//! ```
//! use uplift_structure::{Check, Rule, StructureDescription};
//!
//! let description: StructureDescription = toml::from_str(r#"
//!     kind = "restrained-frame"
//!     columns = 4
//!     width_m = 1.6
//!     height_m = 9.6
//!     column_mass_kg = 48000.0
//!     deck_mass_kg = 900000.0
//!     tendon_stiffness_n_m = 3.0e6       # of each column's tendon and spring, in series
//!     tendon_anchorage = "column"
//!     uplift_displacement_m = 0.0005
//! "#)?;
//! let bridge = description.resolve().map_err(|mistakes| mistakes[0].clone())?;
//! let ordinate_m = 0.40; // read from a spectrum at bridge.spectral_strength()
//! let demand_m = bridge.zero_stiffness_demand_m(ordinate_m)?;
//! let check = Check::from_system(&bridge, Rule::EqualEnergy, 2.5, demand_m)?;
//! assert!(check.is_satisfied());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Where the dissertation is incomplete or in error
//! | where | text | here |
//! |---|---|---|
//! | Table 3.1 | `α` in figures; Section 3.5 has `f_up/(m g) = tan α` | `α = atan(b/h)`, linearised as in Table 3.1 |
//! | row 5 | `EA`, no anchorage of the tendon | `k_res`, [`Anchorage`]; the row is `EA = 2h k_res`, in the foundation |
//! | row 6 | `ρ` undefined, `m` without `N` | `ρ = r/(2h)`, `m` of all columns; see [`curved`] |
//! | row 6 | the bound `2R' sin α'` | reached: `ũ_cap` is the bound, and a warning says that the loop is trilinear |
//! | Eq. 3.2 | `u_cap − u` | `u_cap − abs(u)` |
//! | Eq. 3.11 | no lower end of its domain | `γ = 1` up to `u_up`, where nothing has uplifted |
//! | Section 3.4.5 | `1 − (N EA/m_b) α²` | `1 − (N EA/(m_b g)) α²` |
//! | Section 3.4.5 | `u_dem,EE = γ_ED u_dem,ZS`, `u_dem,ED = γ_EE u_dem,ZS` | the other way round |
//! | Tables 3.5–3.7 | `u_dem,ED` | `u_dem,EE` |
//!
//! Units are SI: metres, kilograms, newtons, radians. Everything is linearised for slender bodies, as in Table 3.1;
//! a [`Warning`] says where a body is stocky.

pub mod block;
pub mod curved;
pub mod description;
pub mod design;
pub mod equivalent;
mod error;
pub mod frame;
pub mod geometry;
pub mod realization;
pub mod rigid;
pub mod rule;
pub mod variation;
mod warning;

pub use block::{Block, Body, PointMass, Reference};
pub use curved::CurvedFrame;
pub use description::{Allowed, Kind, StructureDescription};
pub use design::{Check, design};
pub use equivalent::{Conditions, EquivalentSystem, NO_CAPACITY, NO_CAPACITY_REASON, PostUpliftForce};
pub use error::{StructureError, not_negative, positive, require};
pub use frame::{Anchorage, Frame, RestrainedFrame};
pub use geometry::Geometry;
pub use realization::{Realization, UncertainQuantity};
pub use rigid::RotatingBlock;
pub use rule::{Capacity, Demand, Rule, relative_error};
pub use variation::Quantity;
pub use warning::Warning;
