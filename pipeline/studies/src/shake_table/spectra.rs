//! Response spectra of what a table plays (Fig. 6.12).

use uplift_inputs::SetRecord;
use uplift_job::events::{Events, each};
use uplift_result::{Excitation, TableSpectra};
use uplift_study::ShakeTableStudy;

use super::Inputs;
use crate::error::StudiesError;

/// The spectra of every component that is played, and the code's.
///
/// The time of the table runs √λ faster than that of the records, so that an oscillator of the period T on the table
/// peaks as one of the period T √λ does under the record itself.
pub(super) fn spectra(
    study: &ShakeTableStudy,
    inputs: &Inputs,
    events: &dyn Events,
) -> Result<TableSpectra, StudiesError> {
    let periods_s = study.spectra.periods_s.to_vec();
    let of_record_s: Vec<f64> = periods_s.iter().map(|period_s| period_s * study.length_scale.sqrt()).collect();
    let of_pair = |(_, record): (Excitation, &SetRecord)| {
        let mut ordinates_m_s2 = Vec::with_capacity(2 * of_record_s.len());
        for component in [&record.pair.h1, &record.pair.h2] {
            for &period_s in &of_record_s {
                if events.cancelled() {
                    return Vec::new();
                }
                ordinates_m_s2.push(component.spectral_acceleration_m_s2(period_s));
            }
        }
        ordinates_m_s2
    };
    let recorded_m_s2 = each(events, ("spectra", "excitations"), inputs.played(), of_pair)?;
    let design_m_s2 = study.spectra.design.map(|design| {
        let spectrum = design.spectrum(study.gravity_m_s2);
        of_record_s.iter().map(|&period_s| spectrum.acceleration_m_s2(period_s).unwrap_or(f64::NAN)).collect()
    });
    Ok(TableSpectra { periods_s, recorded_m_s2: recorded_m_s2.concat(), design_m_s2 })
}
