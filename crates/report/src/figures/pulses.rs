//! Rocking spectra under wavelets (Figures 2.2 to 2.7).

use uplift_block::{BlockResponse, Overturning, RickerShape, SpectrumPoint};

use super::spanned;
use uplift::pulses::{PulsePlan, PulseSpectra, Spectrum, wavelet};
use uplift_plot::{Axis, Figure, Hatch, Map, Panel, Region, Series, Tone};

const FREQUENCY: &str = "size-frequency parameter ω_{p}/p";
const ACCELERATION: &str = "acceleration a_{p}/(g tan α)";
const HALF_WIDTH: &str = "half-width b ω_{p}²/a_{p}";
const DISPLACEMENT: &str = "displacement u_{max} ω_{p}²/a_{p}";
/// A block that rotates or moves by less has not uplifted: rounding may lift one whose ground is as strong as it is.
const MOVES: f64 = 1e-9;
/// Lower ends of the areas of equal rotation θmax/α and displacement.
const ROTATIONS: [f64; 8] = [MOVES, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0];
const DISPLACEMENTS: [f64; 9] = [MOVES, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// The figures of `spectra`, which `plan` asked for.
pub fn pulse_figures(plan: &PulsePlan, spectra: &[PulseSpectra]) -> Vec<Figure> {
    let block = format!("a block of slenderness α = {} rad", plan.slenderness_rad);
    let block = plan.restitution.map_or(format!("{block} and Housner's restitution"), |r| {
        format!("{block} and a coefficient of restitution of {r}")
    });
    let figure = |id: &str, title: &str, caption: String, panel: &dyn Fn(&PulseSpectra) -> Panel| Figure {
        columns: spectra.len(),
        ..Figure::new(id, title, caption, spectra.iter().map(panel).collect())
    };
    let pulse = &plan.blocks;
    vec![
        figure(
            "rotation",
            "Largest rotation θ_{max}/α",
            format!("Largest rotation of {block} under Ricker wavelets; hatched where it overturns (Fig. 2.2)."),
            &|of| map(of.shape, &of.by_frequency, FREQUENCY, &ROTATIONS, |point| point.rotation),
        ),
        figure(
            "displacement",
            "Largest displacement u_{max} ω_{p}²/a_{p}",
            format!(
                "Largest displacement of the top of {block} under Ricker wavelets; hatched where it overturns (Fig. \
                 2.3). It depends on the acceleration far more than on the size."
            ),
            &|of| map(of.shape, &of.by_frequency, FREQUENCY, &DISPLACEMENTS, |point| point.displacement),
        ),
        figure(
            "over-acceleration",
            "Displacement over acceleration",
            format!(
                "Largest displacement of the top of {block} under Ricker wavelets, for several sizes; no line where it \
                 overturns (Fig. 2.4)."
            ),
            &|of| over_acceleration(of.shape, &of.over_acceleration),
        ),
        figure(
            "over-frequency",
            "Displacement over the size-frequency parameter",
            format!(
                "Largest displacement of the top of {block} under Ricker wavelets, for several accelerations; no line \
                 where it overturns (Fig. 2.5)."
            ),
            &|of| over_frequency(of.shape, &of.over_frequency),
        ),
        figure(
            "over-size",
            "Displacement over the size of blocks",
            format!(
                "Largest displacement of the top of blocks under Ricker wavelets of a_p = {} g; no line where they \
                 overturn (Fig. 2.6).",
                pulse.amplitude_g
            ),
            &|of| over_size(of, pulse.period_s(of.shape)),
        ),
        figure(
            "by-half-width",
            "Displacement u_{max} ω_{p}²/a_{p} by half-width",
            format!(
                "Largest displacement of the top of {block} under Ricker wavelets; hatched where it overturns (Fig. \
                 2.7). The line is a base 2b of nine times a_p/ω_p²."
            ),
            &|of| by_half_width(of.shape, &of.by_half_width),
        ),
    ]
}

fn map(shape: RickerShape, spectrum: &Spectrum, size: &str, levels: &[f64], value: fn(&SpectrumPoint) -> f64) -> Panel {
    let (sizes, accelerations) = (&spectrum.plan.sizes, &spectrum.plan.accelerations);
    let region = |name: &str, way, tone, hatch| Region {
        name: name.to_owned(),
        inside: spectrum.points.iter().map(|point| point.overturning == way).collect(),
        tone,
        hatch,
    };
    let map = Map {
        x: sizes.clone(),
        y: accelerations.clone(),
        values: spectrum.points.iter().map(value).collect(),
        levels: levels.iter().copied().zip(level_names(levels)).collect(),
        regions: vec![
            region("overturns after impact", Overturning::AfterImpact, Tone::Distinct(1), Hatch::Rising),
            region("overturns without impact", Overturning::WithoutImpact, Tone::Distinct(4), Hatch::Falling),
        ],
    };
    let (x, y) = (spanned(Axis::linear(size), sizes), spanned(Axis::linear(ACCELERATION), accelerations));
    Panel { map: Some(map), ..Panel::lines(wavelet(shape), x, y, Vec::new()) }
}

/// What the areas between levels are called.
fn level_names(levels: &[f64]) -> Vec<String> {
    let bound = |index: usize| levels.get(index).filter(|&&level| level > MOVES);
    (0..levels.len())
        .map(|index| match (bound(index), bound(index + 1)) {
            (None, Some(upper)) => format!("below {upper}"),
            (Some(lower), Some(upper)) => format!("{lower} to {upper}"),
            (Some(lower), None) => format!("{lower} and more"),
            (None, None) => "moves".to_owned(),
        })
        .collect()
}

fn displacements<'a>(points: impl Iterator<Item = (f64, &'a SpectrumPoint)>) -> Vec<(f64, f64)> {
    points.map(|(at, point)| (at, point.displacement)).collect()
}

fn over_acceleration(shape: RickerShape, spectrum: &Spectrum) -> Panel {
    let line = |(index, frequency): (usize, &f64)| {
        let points = displacements(spectrum.over_accelerations(index));
        Series::line(format!("ω_{{p}}/p = {frequency}"), points, Tone::Distinct(index))
    };
    let series = spectrum.plan.sizes.iter().enumerate().map(line).collect();
    let x = spanned(Axis::linear(ACCELERATION), &spectrum.plan.accelerations);
    Panel::lines(wavelet(shape), x, Axis::linear(DISPLACEMENT), series)
}

fn over_frequency(shape: RickerShape, spectrum: &Spectrum) -> Panel {
    let line = |(index, acceleration): (usize, &f64)| {
        let points = displacements(spectrum.over_sizes(index));
        Series::line(format!("a_{{p}}/(g tan α) = {acceleration}"), points, Tone::Distinct(index))
    };
    let series = spectrum.plan.accelerations.iter().enumerate().map(line).collect();
    let x = spanned(Axis::linear(FREQUENCY), &spectrum.plan.sizes);
    Panel::lines(wavelet(shape), x, Axis::linear(DISPLACEMENT), series)
}

fn over_size(spectra: &PulseSpectra, period_s: f64) -> Panel {
    let blocks = &spectra.blocks;
    let line = |(index, slenderness_rad): (usize, &f64)| {
        let at = |(size_m, response): (f64, &BlockResponse)| (size_m, response.displacement_m);
        let points = blocks.over_sizes(index).map(at).collect();
        Series::line(format!("α = {slenderness_rad} rad"), points, Tone::Distinct(index))
    };
    let series = blocks.slendernesses_rad.iter().enumerate().map(line).collect();
    let x = spanned(Axis::log("size parameter R, m"), &blocks.sizes_m);
    Panel::lines(
        format!("{}, T_{{p}} = {period_s} s", wavelet(spectra.shape)),
        x,
        Axis::linear(super::DISPLACEMENT),
        series,
    )
}

fn by_half_width(shape: RickerShape, spectrum: &Spectrum) -> Panel {
    let mut panel = map(shape, spectrum, HALF_WIDTH, &DISPLACEMENTS, |point| point.displacement);
    let ends = spectrum.plan.accelerations.iter().map(|&acceleration| (4.5, acceleration)).collect();
    panel.series.push(Series::line("2b = 9 a_{p}/ω_{p}²", ends, Tone::Distinct(3)));
    panel
}
