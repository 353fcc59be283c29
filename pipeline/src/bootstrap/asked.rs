//! The bands of a result at risks that it is asked for after its bootstrap: from the draws that it keeps.

use super::bands::{BandSettings, Bands, RepairedBands, SpectraBands};
use super::compute::{Source, compute};
use super::write::percent;
use crate::consistency::Reweighing;
use crate::error::UpliftError;
use crate::events::Events;
use crate::result::{
    BandMethod, MeasureBands, ResultFile, StoredBands, StoredJointBands, StoredRepairedBands, StoredSpectraBands,
};

impl ResultFile {
    /// The same result with bands at the risks that it was asked for ([`at`](Self::at)), made of the draws of its
    /// bootstrap, to the bit as a bootstrap of these risks makes them. Without a bootstrap there are none, and `events`
    /// hear of it.
    ///
    /// # Errors
    /// A file that is damaged; [`UpliftError::Interrupted`] where `events` say so.
    pub fn resampled(self, events: &dyn Events) -> Result<Self, UpliftError> {
        if !self.is_asked() {
            return Ok(self);
        }
        let Some(plan) = self.resampling_plan()? else {
            events.note(&format!(
                "no confidence bands: {} keeps no draws; `uplift bootstrap` makes them, for any probability",
                self.path().display()
            ));
            return Ok(self);
        };
        let BandMethod { confidence, interval, strength_above } = self.band_method()?;
        let settings = BandSettings { confidence, interval, simultaneous: false, strength_above };
        let stored = self.stripes()?;
        // where the bootstrap made bands of repaired spectra as well
        let reweighing = if self.has_repaired_bands() { Reweighing::of_result(&self)? } else { None };
        let (reweighing, pair_of) = (reweighing.as_ref(), &self.pair_of()?);
        let source = Source { stored: &stored, reweighing, plan: &plan, pair_of, settings: &settings };
        let measures = compute(&source, None, events)?.into_iter().map(stored_bands).collect();
        Ok(self.with_bands(StoredBands { sizes: plan.sizes().to_vec(), unit: plan.unit(), confidence, measures }))
    }
}

/// Bands as a result has them.
fn stored_bands(bands: Bands) -> MeasureBands {
    let stored = |bands: SpectraBands| StoredSpectraBands {
        error_of_median: percent(&bands.error_of_median),
        range_of_interval: percent(&bands.range_of_interval),
        limits_m: [bands.lower_m, bands.median_m, bands.upper_m],
        joint: bands.joint.map(|joint| StoredJointBands {
            range_of_interval: percent(&joint.range_of_interval),
            limits_m: joint.limits_m,
            failed: joint.failed,
        }),
    };
    let repaired =
        bands.repaired.map(|RepairedBands { bands, failed }| StoredRepairedBands { bands: stored(bands), failed });
    MeasureBands { measure: bands.measure, plain: stored(bands.plain), inferred: Some(bands.inferred), repaired }
}
