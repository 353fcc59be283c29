//! A result seen at other risks than those of its study: the values that take the place of the stored ones.

use super::file::ResultFile;
use super::{StoredBands, StoredConsistency, StoredSpectra};

/// What a result says of the risks that it was asked for.
pub struct AskedSpectra {
    /// The spectra.
    pub spectra: StoredSpectra,
    /// Whether the records have the hazard of the other measure.
    pub consistency: Vec<StoredConsistency>,
    /// Bands; none until they are made.
    pub bands: Option<StoredBands>,
}

impl ResultFile {
    /// The same result with other spectra: axes, spectra and coefficients are from now on of these.
    #[must_use]
    pub fn with_spectra(mut self, spectra: StoredSpectra) -> Self {
        self.asked = Some(AskedSpectra { spectra, consistency: Vec::new(), bands: None });
        self
    }

    /// The same with what consistency says at the risks that it was asked for.
    #[must_use]
    pub fn with_consistency(mut self, consistency: Vec<StoredConsistency>) -> Self {
        if let Some(asked) = &mut self.asked {
            asked.consistency = consistency;
        }
        self
    }

    /// The same with `bands` at the risks that it was asked for.
    #[must_use]
    pub fn with_bands(mut self, bands: StoredBands) -> Self {
        if let Some(asked) = &mut self.asked {
            asked.bands = Some(bands);
        }
        self
    }

    /// Whether it was asked for other risks than those of its study.
    pub fn is_asked(&self) -> bool {
        self.asked.is_some()
    }
}
