//! What bands are made of.

use uplift_bootstrap::ResamplingPlan;
use uplift_uniform_risk::consistency::Reweighing;
use uplift_uniform_risk::{QuotedUnits, StoredStripes};

use super::bands::BandSettings;

/// What bands are made of.
pub(super) struct Source<'a> {
    pub(super) stored: &'a StoredStripes,
    /// What weighs the records of its repaired spectra anew; none where it has none.
    pub(super) reweighing: Option<&'a Reweighing>,
    /// The draws.
    pub(super) plan: &'a ResamplingPlan,
    /// Whose scatter the bands of the truth are of, where records are not drawn by earthquake, `[measure]`.
    pub(super) quoted: &'a [QuotedUnits],
    /// What kind of bands.
    pub(super) settings: &'a BandSettings,
}
