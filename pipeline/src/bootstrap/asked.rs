//! The bands of a result at risks that it is asked for after its bootstrap: from the draws that it keeps.

use rayon::prelude::*;
use uplift_ida::Watch;

use super::bands::{BandSettings, Bands, StrengthBands, bands_of_strength, gather_bands};
use super::write::percent;
use crate::error::UpliftError;
use crate::events::{Events, Progress};
use crate::result::{BandMethod, MeasureBands, ResultFile, StoredBands};

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
        let mut measures = Vec::new();
        for measure in &stored.measures {
            let strengths = stored.strengths.len();
            let progress = Progress::begin(events, measure.measure.label(), "strengths", strengths as u64);
            let of_strength = |strength| {
                if progress.cancelled() {
                    return Err(UpliftError::Interrupted);
                }
                let bands = bands_of_strength(&stored, measure, strength, &plan, &settings);
                progress.finished(1);
                bands.map_err(|error| error.in_file(&stored.path))
            };
            let bands = (0..strengths).into_par_iter().map(of_strength).collect::<Result<Vec<StrengthBands>, _>>()?;
            let bands: Vec<&StrengthBands> = bands.iter().collect();
            measures.push(stored_bands(gather_bands(&stored, measure, &plan, &settings, &bands)));
        }
        Ok(self.with_bands(StoredBands { sizes: plan.sizes().to_vec(), confidence, measures }))
    }
}

/// Bands as a result has them.
fn stored_bands(bands: Bands) -> MeasureBands {
    MeasureBands {
        measure: bands.measure,
        error_of_median: percent(&bands.error_of_median),
        range_of_interval: percent(&bands.range_of_interval),
        limits_m: [bands.lower_m, bands.median_m, bands.upper_m],
    }
}
