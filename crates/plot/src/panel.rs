//! One panel: its axes, map, bands and lines.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "pixels of a drawing: whole numbers far below any limit"
)]

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, ValueFormatter};
use plotters::prelude::*;
use serde::Serialize;

use super::figure::{Axis, Marks, Panel, Scale, Series};
use super::frame::{Frame, runs};
use super::map::draw_map;
use super::stroke::{Area, Failure, ZOOM, colour, draw_line, draw_mark, font, width};
use super::ticks::{Labels, ticks};

/// Where the plotting area of a panel lies, in the units of the drawing's view box, and what its ends mean.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PanelPlace {
    /// Left and right edge.
    pub x_pixels: (i32, i32),
    /// Upper and lower edge.
    pub y_pixels: (i32, i32),
    /// Values at the left and right edge.
    pub x_range: (f64, f64),
    /// Values at the lower and upper edge.
    pub y_range: (f64, f64),
    /// Division of the axes.
    pub x_scale: Scale,
    /// Division of the axes.
    pub y_scale: Scale,
}

/// So many letters of a tick have room beside the name of their axis.
const LETTERS_OF_A_TICK: usize = 7;

/// An axis with its own ticks, in positions.
struct Ticked {
    ends: (f64, f64),
    ticks: Vec<f64>,
    labels: Labels,
}

impl Ranged for Ticked {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, position: &f64, (from, to): (i32, i32)) -> i32 {
        let share = (position - self.ends.0) / (self.ends.1 - self.ends.0);
        from + (share * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        // a hint with few points asks for the bold lines, which are all there are
        if hint.max_num_points() == 0 { Vec::new() } else { self.ticks.clone() }
    }

    fn range(&self) -> Range<f64> {
        self.ends.0..self.ends.1
    }
}

impl ValueFormatter<f64> for Ticked {
    fn format_ext(&self, position: &f64) -> String {
        self.labels.text(*position)
    }
}

/// Ends of an axis that takes the range of its values, as positions; none without any that has one.
fn spanned(scale: Scale, values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (least, most) = values
        .filter_map(|value| scale.position(value))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| (least.min(value), most.max(value)));
    let ends = match scale {
        Scale::Linear if least >= 0.0 => (0.0, if most > 0.0 { 1.05 * most } else { 1.0 }),
        Scale::Linear => {
            let margin = 0.05 * (most - least).max(1e-12);
            (least - margin, most + margin)
        }
        Scale::Log => {
            let margin = (0.04 * (most - least)).max(0.05);
            (least - margin, most + margin)
        }
    };
    (least.is_finite() && most.is_finite()).then_some(ends)
}

/// Ends of an axis as positions: those that it has, else those of its values.
fn ends(axis: &Axis, values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    if let Some((from, to)) = axis.range
        && let (Some(from), Some(to)) = (axis.scale.position(from), axis.scale.position(to))
    {
        return Some((from, to));
    }
    spanned(axis.scale, values)
}

fn x_ends(panel: &Panel) -> Option<(f64, f64)> {
    let lines = panel.series.iter().flat_map(|series| series.points.iter().map(|point| point.0));
    let bands = panel.bands.iter().flat_map(|band| band.points.iter().map(|point| point.0));
    ends(&panel.x, lines.chain(bands).chain(panel.map.iter().flat_map(|map| map.x.iter().copied())))
}

fn y_ends(panel: &Panel) -> Option<(f64, f64)> {
    let lines = panel.series.iter().flat_map(|series| series.points.iter().map(|point| point.1));
    let bands = panel.bands.iter().flat_map(|band| band.points.iter().flat_map(|point| [point.1, point.2]));
    ends(&panel.y, lines.chain(bands).chain(panel.map.iter().flat_map(|map| map.y.iter().copied())))
}

/// Gives the panels one range of the vertical axis, that of all of them: what lies higher in one than in another is
/// larger. Panels that measure something else keep theirs.
pub fn share_y(panels: &mut [Panel]) {
    let Some(Axis { label, scale, .. }) = panels.first().map(|panel| panel.y.clone()) else { return };
    if panels.iter().any(|panel| panel.y.label != label || panel.y.scale != scale) {
        return;
    }
    let all = panels.iter().filter_map(y_ends).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
    let Some((from, to)) = all else { return };
    for panel in panels {
        panel.y.range = Some((scale.value(from), scale.value(to)));
    }
}

pub(super) fn draw_panel(area: &Area<'_>, panel: &Panel) -> Result<PanelPlace, Failure> {
    let (x_scale, y_scale) = (panel.x.scale, panel.y.scale);
    let (x0, x1) = x_ends(panel).unwrap_or((0.0, 1.0));
    let (y0, y1) = y_ends(panel).unwrap_or((0.0, 1.0));
    let (wide, high) = area.dim_in_pixel();
    let x_ticks = ticks(x_scale, x0, x1, ((wide / ZOOM) as usize / 48).clamp(3, 8));
    let y_ticks = ticks(y_scale, y0, y1, ((high / ZOOM) as usize / 45).clamp(3, 8));

    let (x_labels, y_labels) = (Labels::from_positions(x_scale, &x_ticks), Labels::from_positions(y_scale, &y_ticks));
    // the name of an axis lies beside its numbers, not over them
    let beside = 46 + 5 * y_labels.longest(&y_ticks).saturating_sub(LETTERS_OF_A_TICK) as u32;

    let mut chart = ChartBuilder::on(area)
        .margin(6 * ZOOM)
        .margin_left(16 * ZOOM)
        .margin_right(12 * ZOOM)
        .caption(&panel.title, font(8.0).style(FontStyle::Bold))
        .x_label_area_size(34 * ZOOM)
        .y_label_area_size(beside * ZOOM)
        .build_cartesian_2d(
            Ticked { ends: (x0, x1), labels: x_labels, ticks: x_ticks },
            Ticked { ends: (y0, y1), labels: y_labels, ticks: y_ticks },
        )?;
    chart
        .configure_mesh()
        .x_desc(&panel.x.label)
        .y_desc(&panel.y.label)
        .axis_desc_style(font(8.0))
        .label_style(font(7.0))
        .set_all_tick_mark_size(4 * ZOOM)
        .axis_style(BLACK.stroke_width(ZOOM))
        .bold_line_style(RGBColor(228, 228, 228).stroke_width(ZOOM / 2))
        .light_line_style(TRANSPARENT)
        .draw()?;
    let (x_pixels, y_pixels) = chart.plotting_area().get_pixel_range();
    let frame = Frame { x: (x0, x1), y: (y0, y1), x_pixels: x_pixels.clone(), y_pixels: y_pixels.clone() };
    let plot = area.clone();
    let (left, top) = plot.get_base_pixel();
    let shifted =
        |points: Vec<(i32, i32)>| -> Vec<(i32, i32)> { points.into_iter().map(|(x, y)| (x - left, y - top)).collect() };

    if let Some(map) = &panel.map {
        draw_map(&plot, map, (x_scale, y_scale), &frame, &shifted)?;
    }
    for band in &panel.bands {
        for run in runs(&band.points, |&(x, low, high)| {
            Some((x_scale.position(x)?, band_position(y_scale, low, y0)?, band_position(y_scale, high, y0)?))
        }) {
            let upper = run.iter().map(|&(x, _, high)| frame.pixel(x, high));
            let lower = run.iter().rev().map(|&(x, low, _)| frame.pixel(x, low));
            let outline = shifted(upper.chain(lower).collect());
            plot.draw(&Polygon::new(outline, colour(band.tone).mix(0.22)))?;
        }
    }
    for series in &panel.series {
        draw_series(&plot, series, (x_scale, y_scale), &frame, &shifted)?;
    }
    Ok(PanelPlace {
        x_pixels: (x_pixels.start, x_pixels.end),
        y_pixels: (y_pixels.start, y_pixels.end),
        x_range: (x_scale.value(x0), x_scale.value(x1)),
        y_range: (y_scale.value(y0), y_scale.value(y1)),
        x_scale,
        y_scale,
    })
}

/// A limit of a band: zero lies at the foot of a logarithmic axis, infinity far above.
fn band_position(scale: Scale, value: f64, foot: f64) -> Option<f64> {
    match value {
        value if value == f64::INFINITY => Some(f64::MAX),
        value if value <= 0.0 && scale == Scale::Log => Some(foot),
        value => scale.position(value),
    }
}

fn draw_series(
    plot: &Area<'_>,
    series: &Series,
    (x_scale, y_scale): (Scale, Scale),
    frame: &Frame,
    shifted: &impl Fn(Vec<(i32, i32)>) -> Vec<(i32, i32)>,
) -> Result<(), Failure> {
    let positions = |&(x, y): &(f64, f64)| Some((x_scale.position(x)?, y_scale.position(y)?));
    if series.marks != Marks::None {
        for (x, y) in series.points.iter().filter_map(positions).filter(|&(x, y)| frame.holds(x, y)) {
            for pixel in shifted(vec![frame.pixel(x, y)]) {
                draw_mark(plot, pixel, series.tone, series.marks)?;
            }
        }
    }
    if matches!(series.marks, Marks::Only | Marks::Rings) {
        return Ok(());
    }
    let thick = width(series.tone);
    for run in runs(&series.points, positions) {
        for piece in frame.clip(&run) {
            draw_line(plot, &shifted(piece), series.tone, thick)?;
        }
    }
    Ok(())
}
