//! Rocking spectra of a rigid block under Ricker wavelets (Sections 2.2 and 2.3): what is asked for, computed, written
//! as tables and summed up.

mod compute;
mod plan;
mod run;
mod tables;

pub use compute::{BlockResponses, PulseSpectra, Spectrum, compute};
pub use plan::{BlockPlan, PulsePlan, wavelet};
pub use run::{PulseOptions, PulseReport, Summary, pulses, summary};
pub use tables::{PULSE_FIGURES, PulseTable, tables};
