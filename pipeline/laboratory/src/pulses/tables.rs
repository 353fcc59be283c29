//! The numbers of each figure as a tidy table.

use polars::prelude::Column;
use uplift_block::{Overturning, SpectrumPoint};

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
    let (mut wavelets, mut overturnings) = (Vec::new(), Vec::new());
    let (mut sizes, mut accelerations, mut values, mut impacts) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for of_shape in spectra {
        for (size, acceleration, point) in spectrum(of_shape).rows() {
            wavelets.push(wavelet(of_shape.shape));
            sizes.push(size);
            accelerations.push(acceleration);
            values.push(value(point));
            impacts.push(point.impacts);
            overturnings.push(word(point.overturning));
        }
    }
    vec![
        Column::new(WAVELET_COLUMN.into(), wavelets),
        Column::new(size_name.into(), sizes),
        Column::new("a_p_over_g_tan_alpha".into(), accelerations),
        Column::new(value_name.into(), values),
        Column::new("impacts".into(), impacts),
        Column::new("overturning".into(), overturnings),
    ]
}

fn blocks(spectra: &[PulseSpectra]) -> Vec<Column> {
    let (mut wavelets, mut overturnings) = (Vec::new(), Vec::new());
    let (mut slendernesses, mut sizes, mut values, mut impacts) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for PulseSpectra { shape, blocks, .. } in spectra {
        for (index, &slenderness_rad) in blocks.slendernesses_rad.iter().enumerate() {
            for (size_m, response) in blocks.over_sizes(index) {
                wavelets.push(wavelet(*shape));
                slendernesses.push(slenderness_rad);
                sizes.push(size_m);
                values.push(response.displacement_m);
                impacts.push(response.impacts);
                overturnings.push(word(response.overturning));
            }
        }
    }
    vec![
        Column::new(WAVELET_COLUMN.into(), wavelets),
        Column::new("alpha_rad".into(), slendernesses),
        Column::new("size_r_m".into(), sizes),
        Column::new("u_max_m".into(), values),
        Column::new("impacts".into(), impacts),
        Column::new("overturning".into(), overturnings),
    ]
}
