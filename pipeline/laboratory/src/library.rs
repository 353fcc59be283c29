//! A library of rocking response: how blocks and oscillators respond to a record set, over intensities normalised by
//! what uplifts them.

mod compute;
mod fits;
mod fragilities;
mod run;
mod systems;
mod tables;

pub use compute::{LevelReport, MeasureReport, SystemReport};
pub use fits::{FitReport, SurfaceReport};
pub use run::{LibraryOptions, LibraryReport, library};
pub use systems::Normalised;
