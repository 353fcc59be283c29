//! The numbers of each figure as a tidy table.

use polars::prelude::Column;
use uplift_block::{Overturning, SpectrumPoint};
use uplift_job::table::ColumnsOf;

use super::compute::{PulseSpectra, Spectrum};
use super::plan::wavelet;

/// Names of Figures 2.2 to 2.7, and of their tables.
pub const PULSE_FIGURES: [&str; 6] =
    ["rotation", "displacement", "over-acceleration", "over-frequency", "over-size", "by-half-width"];
/// A column of every table.
pub(super) const WAVELET_COLUMN: &str = "wavelet";

/// The numbers of a figure.
#[derive(Debug)]
pub struct PulseTable {
    /// Name of the figure.
    pub id: &'static str,
    /// The columns.
    pub columns: Vec<Column>,
}

/// The tables of Figures 2.2 to 2.7, named as the figures are. What overturns is infinite.
pub fn tables(spectra: &[PulseSpectra]) -> Vec<PulseTable> {
    const ROTATION: &str = "theta_max_over_alpha";
    const DISPLACEMENT: &str = "u_max_omega_p2_over_a_p";
    const FREQUENCY: &str = "omega_p_over_p";
    const HALF_WIDTH: &str = "b_omega_p2_over_a_p";
    let displacement = |point: &SpectrumPoint| point.displacement;
    let table = |id, size, name, spectrum: fn(&PulseSpectra) -> &Spectrum, value: fn(&SpectrumPoint) -> f64| {
        PulseTable { id, columns: columns(spectra, size, name, spectrum, value) }
    };
    let [rotations, displacements, over_acceleration, over_frequency, over_size, by_half_width] = PULSE_FIGURES;
    vec![
        table(rotations, FREQUENCY, ROTATION, |of| &of.by_frequency, |point| point.rotation),
        table(displacements, FREQUENCY, DISPLACEMENT, |of| &of.by_frequency, displacement),
        table(over_acceleration, FREQUENCY, DISPLACEMENT, |of| &of.over_acceleration, displacement),
        table(over_frequency, FREQUENCY, DISPLACEMENT, |of| &of.over_frequency, displacement),
        PulseTable { id: over_size, columns: blocks(spectra) },
        table(by_half_width, HALF_WIDTH, DISPLACEMENT, |of| &of.by_half_width, displacement),
    ]
}

fn word(overturning: Overturning) -> &'static str {
    match overturning {
        Overturning::None => "none",
        Overturning::WithoutImpact => "without impact",
        Overturning::AfterImpact => "after impact",
    }
}

fn columns(
    spectra: &[PulseSpectra],
    size_name: &str,
    value_name: &str,
    spectrum: fn(&PulseSpectra) -> &Spectrum,
    value: fn(&SpectrumPoint) -> f64,
) -> Vec<Column> {
    let rows = spectra.iter().flat_map(|of| spectrum(of).rows().map(move |row| (of.shape, row)));
    ColumnsOf::new(rows)
        .with(WAVELET_COLUMN, |(shape, _)| wavelet(shape))
        .with(size_name, |(_, (size, ..))| size)
        .with("a_p_over_g_tan_alpha", |(_, (_, acceleration, _))| acceleration)
        .with(value_name, |(_, (.., point))| value(point))
        .with("impacts", |(_, (.., point))| point.impacts)
        .with("overturning", |(_, (.., point))| word(point.overturning))
        .build()
}

fn blocks(spectra: &[PulseSpectra]) -> Vec<Column> {
    let rows = spectra.iter().flat_map(|of| {
        of.blocks.slendernesses_rad.iter().enumerate().flat_map(move |(index, &slenderness_rad)| {
            of.blocks.over_sizes(index).map(move |block| (of.shape, slenderness_rad, block))
        })
    });
    ColumnsOf::new(rows)
        .with(WAVELET_COLUMN, |(shape, ..)| wavelet(shape))
        .with("alpha_rad", |(_, slenderness_rad, _)| slenderness_rad)
        .with("size_r_m", |(.., (size_m, _))| size_m)
        .with("u_max_m", |(.., (_, response))| response.displacement_m)
        .with("impacts", |(.., (_, response))| response.impacts)
        .with("overturning", |(.., (_, response))| word(response.overturning))
        .build()
}
