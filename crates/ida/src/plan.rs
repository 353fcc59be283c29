//! Records, oscillators and levels, checked before the first analysis.

use uplift_motion::Accelerogram;
use uplift_oscillator::{Excitation, Oscillator};

use crate::error::IdaError;

/// A record as the stripes need it: one component, and the intensity that the scale factors refer to.
#[derive(Debug, Clone, Copy)]
pub struct StripeRecord<'a> {
    /// Identifier, for messages.
    pub id: &'a str,
    /// The component that shakes the planar model.
    pub accelerogram: &'a Accelerogram,
    /// Intensity measure of the unscaled record, of both components (Eq. 4.5, 4.6), in the unit of the levels.
    pub intensity: f64,
}

/// A checked plan.
#[derive(Debug, Clone)]
pub struct Plan<'a> {
    pub(crate) records: Vec<StripeRecord<'a>>,
    pub(crate) oscillators: &'a [Oscillator],
    pub(crate) levels: &'a [f64],
    pub(crate) with_free_peak: bool,
}

impl<'a> Plan<'a> {
    /// Plan the stripes.
    ///
    /// * `records` — with their unscaled intensities
    /// * `oscillators` — one a strength
    /// * `levels` — intensity levels of the stripes, ascending, in the unit of the records' intensities
    /// * `with_free_peak` — whether the first peak of the free vibration after a record counts
    ///
    /// # Errors
    /// An empty axis, levels that do not ascend, a record of zero intensity.
    pub fn new(
        records: Vec<StripeRecord<'a>>,
        oscillators: &'a [Oscillator],
        levels: &'a [f64],
        with_free_peak: bool,
    ) -> Result<Self, IdaError> {
        check_axes(&records, ("strengths", oscillators.len()), levels)?;
        for record in &records {
            excitation(record)?;
        }
        Ok(Self { records, oscillators, levels, with_free_peak })
    }

    /// Number of nonlinear time histories in the plan.
    pub fn analyses(&self) -> u64 {
        (self.records.len() * self.oscillators.len() * self.levels.len()) as u64
    }
}

/// Refuses an empty axis, levels that do not ascend, and records that cannot be scaled; `systems` is what shakes, by name and number.
pub(crate) fn check_axes(
    records: &[StripeRecord<'_>],
    systems: (&'static str, usize),
    levels: &[f64],
) -> Result<(), IdaError> {
    for (what, length) in [("records", records.len()), systems, ("levels", levels.len())] {
        if length == 0 {
            return Err(IdaError::Empty { what });
        }
    }
    let mut before = 0.0;
    for (index, &value) in levels.iter().enumerate() {
        if !(value.is_finite() && value > before) {
            return Err(IdaError::Levels { index, value, before });
        }
        before = value;
    }
    for record in records {
        if !(record.intensity.is_finite() && record.intensity > 0.0) {
            return Err(IdaError::Unscalable { record: record.id.to_owned(), value: record.intensity });
        }
    }
    Ok(())
}

pub(crate) fn excitation<'a>(record: &StripeRecord<'a>) -> Result<Excitation<'a>, IdaError> {
    Excitation::new(record.accelerogram.dt_s(), record.accelerogram.acceleration_m_s2())
        .map_err(|source| IdaError::Oscillator { record: record.id.to_owned(), source })
}
