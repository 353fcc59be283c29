//! How sure the spectra are: confidence bands from resampled records (Section 4.5, Table 4.1).

mod bands;
mod checkpoint;
mod write;

pub use bands::{BandSettings, Bands, JointBands, StrengthBands, bands_of_strength, gather_bands};
pub use checkpoint::{Checkpoint, Finished};
pub use write::{BandsFile, band_paths, write_bands};
