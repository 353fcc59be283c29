//! From a figure to SVG, and to the places of its panels.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "pixels of a drawing: whole numbers far below any limit"
)]

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, ValueFormatter};
use plotters::prelude::*;
use serde::Serialize;

use super::figure::{Axis, Figure, Marks, Panel, Scale, Series, Tone};
use super::ticks::{label, ticks};

/// Okabe and Ito's colours but for yellow, which is too light for a line on white.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(0, 0, 0),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
];
/// Dash and gap of each colour, pixels; none for a full line.
const DASHES: [Option<(i32, i32)>; 7] =
    [None, Some((7, 3)), Some((2, 2)), Some((10, 4)), None, Some((5, 2)), Some((3, 4))];
const FONT: &str = "sans-serif";

/// How wide a figure is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Width {
    /// One column of a journal, 90 mm.
    Single,
    /// Both columns, 190 mm.
    Double,
}

impl Width {
    /// Pixels at 96 to the inch.
    fn pixels(self) -> u32 {
        match self {
            Self::Single => 340,
            Self::Double => 718,
        }
    }
}

/// A drawn figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// The SVG document.
    pub svg: String,
    /// Width and height, pixels.
    pub size: (u32, u32),
    /// Where its panels are, in their order.
    pub places: Vec<PanelPlace>,
}

/// Where the plotting area of a panel lies, pixels, and what its ends mean.
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

/// Draw `figure`.
///
/// # Errors
/// What the drawing library cannot do, in its words; none is known.
pub fn svg(figure: &Figure, width: Width) -> Result<Drawing, String> {
    let columns = match width {
        Width::Single => 1,
        Width::Double => figure.columns.clamp(1, figure.panels.len().max(1)),
    };
    let rows = figure.panels.len().div_ceil(columns).max(1);
    let names = legend(figure);
    let wide = width.pixels();
    let panel_height = (f64::from(wide) / columns as f64 * 0.72).clamp(190.0, 380.0) as u32;
    let legend_rows = legend_layout(&names, wide).last().map_or(0, |entry| entry.1 / 16 + 1);
    let head = 24 + 16 * legend_rows as u32 + if figure.remark.is_empty() { 0 } else { 15 };
    let size = (wide, head + panel_height * rows as u32);
    let mut text = String::new();
    let mut places = Vec::new();
    let fail = |error: &dyn std::fmt::Display| error.to_string();
    {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE).map_err(|error| fail(&error))?;
        draw_head(&root, figure, &names, head).map_err(|error| fail(&error))?;
        let (_, below) = root.split_vertically(head);
        for (panel, area) in figure.panels.iter().zip(below.split_evenly((rows, columns))) {
            places.push(draw_panel(&area, panel).map_err(|error| fail(&error))?);
        }
        root.present().map_err(|error| fail(&error))?;
    }
    Ok(Drawing { svg: text, size, places })
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Failure = Box<dyn std::error::Error>;

/// What the legend names: each name once.
fn legend(figure: &Figure) -> Vec<(String, Tone, bool)> {
    let mut names: Vec<(String, Tone, bool)> = Vec::new();
    for panel in &figure.panels {
        let lines = panel.series.iter().map(|series| (&series.name, series.tone, false));
        let bands = panel.bands.iter().map(|band| (&band.name, band.tone, true));
        for (name, tone, band) in lines.chain(bands) {
            if !name.is_empty() && names.iter().all(|(known, ..)| known != name) {
                names.push((name.clone(), tone, band));
            }
        }
    }
    names
}

/// Left edge and top of each entry.
fn legend_layout(names: &[(String, Tone, bool)], wide: u32) -> Vec<(i32, i32)> {
    let (mut x, mut y) = (10, 0);
    names
        .iter()
        .map(|(name, ..)| {
            let length = 40 + 6 * name.chars().count() as i32;
            if x > 10 && x + length > wide as i32 {
                (x, y) = (10, y + 16);
            }
            let place = (x, y);
            x += length;
            place
        })
        .collect()
}

fn colour(tone: Tone) -> RGBColor {
    match tone {
        Tone::Distinct(index) => COLOURS[index % COLOURS.len()],
        Tone::Faint => RGBColor(205, 205, 205),
    }
}

fn dash(tone: Tone) -> Option<(i32, i32)> {
    match tone {
        Tone::Distinct(index) => DASHES[index % DASHES.len()],
        Tone::Faint => None,
    }
}

fn draw_head(root: &Area<'_>, figure: &Figure, names: &[(String, Tone, bool)], head: u32) -> Result<(), Failure> {
    root.draw(&Text::new(figure.title.clone(), (8, 6), (FONT, 13).into_font().style(FontStyle::Bold)))?;
    for ((name, tone, band), (x, y)) in names.iter().zip(legend_layout(names, root.dim_in_pixel().0)) {
        let middle = 24 + y + 6;
        if *band {
            root.draw(&Rectangle::new([(x, middle - 4), (x + 22, middle + 4)], colour(*tone).mix(0.25).filled()))?;
        } else {
            draw_line(root, &[(x, middle), (x + 22, middle)], *tone, 2)?;
        }
        root.draw(&Text::new(name.clone(), (x + 27, 24 + y), (FONT, 11).into_font()))?;
    }
    if !figure.remark.is_empty() {
        let style = (FONT, 11).into_font().style(FontStyle::Italic).color(&RGBColor(170, 60, 0));
        root.draw(&Text::new(figure.remark.clone(), (8, head as i32 - 15), style))?;
    }
    Ok(())
}

/// A polyline in pixels, dashed as its tone asks.
fn draw_line(area: &Area<'_>, points: &[(i32, i32)], tone: Tone, thick: u32) -> Result<(), Failure> {
    let style = colour(tone).stroke_width(thick);
    match dash(tone) {
        None => area.draw(&PathElement::new(points.to_vec(), style))?,
        Some((length, gap)) => {
            for piece in dashes(points, f64::from(length), f64::from(gap)) {
                area.draw(&PathElement::new(piece, style))?;
            }
        }
    }
    Ok(())
}

/// The pieces of a dashed polyline.
fn dashes(points: &[(i32, i32)], length: f64, gap: f64) -> Vec<Vec<(i32, i32)>> {
    let mut pieces = Vec::new();
    let (mut drawing, mut left) = (true, length);
    let mut piece = vec![points[0]];
    for pair in points.windows(2) {
        let (mut from, to) = ((f64::from(pair[0].0), f64::from(pair[0].1)), pair[1]);
        let to_point = (f64::from(to.0), f64::from(to.1));
        let mut rest = (to_point.0 - from.0).hypot(to_point.1 - from.1);
        while rest > left {
            let share = left / rest;
            from = (from.0 + share * (to_point.0 - from.0), from.1 + share * (to_point.1 - from.1));
            rest -= left;
            let pixel = (from.0.round() as i32, from.1.round() as i32);
            if drawing {
                piece.push(pixel);
                pieces.push(std::mem::take(&mut piece));
            }
            piece = vec![pixel];
            drawing = !drawing;
            left = if drawing { length } else { gap };
        }
        left -= rest;
        if drawing {
            piece.push(to);
        }
    }
    if drawing && piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

/// An axis with its own ticks, in positions.
struct Ticked {
    scale: Scale,
    ends: (f64, f64),
    ticks: Vec<f64>,
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
        label(self.scale, *position)
    }
}

/// Ends of an axis as positions.
fn ends(axis: &Axis, values: impl Iterator<Item = f64>) -> (f64, f64) {
    if let Some((from, to)) = axis.range
        && let (Some(from), Some(to)) = (axis.scale.position(from), axis.scale.position(to))
    {
        return (from, to);
    }
    let (least, most) = values
        .filter_map(|value| axis.scale.position(value))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| (least.min(value), most.max(value)));
    match axis.scale {
        _ if !(least.is_finite() && most.is_finite()) => (0.0, 1.0),
        Scale::Linear if least >= 0.0 => (0.0, if most > 0.0 { 1.05 * most } else { 1.0 }),
        Scale::Linear => {
            let margin = 0.05 * (most - least).max(1e-12);
            (least - margin, most + margin)
        }
        Scale::Log => {
            let margin = (0.04 * (most - least)).max(0.05);
            (least - margin, most + margin)
        }
    }
}

fn draw_panel(area: &Area<'_>, panel: &Panel) -> Result<PanelPlace, Failure> {
    let (x_scale, y_scale) = (panel.x.scale, panel.y.scale);
    let xs = panel.series.iter().flat_map(|series| series.points.iter().map(|point| point.0));
    let ys = panel.series.iter().flat_map(|series| series.points.iter().map(|point| point.1));
    let band_xs = panel.bands.iter().flat_map(|band| band.points.iter().map(|point| point.0));
    let band_ys = panel.bands.iter().flat_map(|band| band.points.iter().flat_map(|point| [point.1, point.2]));
    let (x0, x1) = ends(&panel.x, xs.chain(band_xs));
    let (y0, y1) = ends(&panel.y, ys.chain(band_ys));
    let (wide, high) = area.dim_in_pixel();
    let x_ticks = ticks(x_scale, x0, x1, (wide as usize / 48).clamp(3, 8));
    let y_ticks = ticks(y_scale, y0, y1, (high as usize / 45).clamp(3, 8));

    let mut chart = ChartBuilder::on(area)
        .margin(6)
        .margin_right(12)
        .caption(&panel.title, (FONT, 12).into_font())
        .x_label_area_size(34)
        .y_label_area_size(52)
        .build_cartesian_2d(
            Ticked { scale: x_scale, ends: (x0, x1), ticks: x_ticks },
            Ticked { scale: y_scale, ends: (y0, y1), ticks: y_ticks },
        )?;
    chart
        .configure_mesh()
        .x_desc(&panel.x.label)
        .y_desc(&panel.y.label)
        .axis_desc_style((FONT, 11))
        .label_style((FONT, 10))
        .bold_line_style(RGBColor(225, 225, 225))
        .light_line_style(TRANSPARENT)
        .draw()?;
    let (x_pixels, y_pixels) = chart.plotting_area().get_pixel_range();
    let frame = Frame { x: (x0, x1), y: (y0, y1), x_pixels: x_pixels.clone(), y_pixels: y_pixels.clone() };
    let plot = area.clone();
    let (left, top) = plot.get_base_pixel();
    let shifted =
        |points: Vec<(i32, i32)>| -> Vec<(i32, i32)> { points.into_iter().map(|(x, y)| (x - left, y - top)).collect() };

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
        x_range: (value(x_scale, x0), value(x_scale, x1)),
        y_range: (value(y_scale, y0), value(y_scale, y1)),
        x_scale,
        y_scale,
    })
}

fn value(scale: Scale, position: f64) -> f64 {
    match scale {
        Scale::Linear => position,
        Scale::Log => 10.0_f64.powf(position),
    }
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
    if series.marks == Marks::Only {
        for (x, y) in series.points.iter().filter_map(positions).filter(|&(x, y)| frame.holds(x, y)) {
            for pixel in shifted(vec![frame.pixel(x, y)]) {
                plot.draw(&Circle::new(pixel, 2, colour(series.tone).filled()))?;
            }
        }
        return Ok(());
    }
    let thick = if series.tone == Tone::Faint { 1 } else { 2 };
    for run in runs(&series.points, positions) {
        for piece in frame.clip(&run) {
            draw_line(plot, &shifted(piece), series.tone, thick)?;
        }
    }
    Ok(())
}

/// The points that have positions, in runs without a gap.
fn runs<P, T>(points: &[P], position: impl Fn(&P) -> Option<T>) -> Vec<Vec<T>> {
    let mut runs = Vec::new();
    let mut run = Vec::new();
    for point in points {
        match position(point) {
            Some(found) => run.push(found),
            None => runs.push(std::mem::take(&mut run)),
        }
    }
    runs.push(run);
    runs.retain(|run| run.len() > 1);
    runs
}

/// The plotting area.
struct Frame {
    x: (f64, f64),
    y: (f64, f64),
    x_pixels: Range<i32>,
    y_pixels: Range<i32>,
}

impl Frame {
    fn holds(&self, x: f64, y: f64) -> bool {
        (self.x.0..=self.x.1).contains(&x) && (self.y.0..=self.y.1).contains(&y)
    }

    /// The pixel of a position, held inside the frame.
    fn pixel(&self, x: f64, y: f64) -> (i32, i32) {
        let share = |value: f64, (from, to): (f64, f64)| ((value - from) / (to - from)).clamp(0.0, 1.0);
        let along =
            |range: &Range<i32>, share: f64| f64::from(range.start) + share * f64::from(range.end - range.start);
        let pixel_x = along(&self.x_pixels, share(x, self.x));
        let pixel_y = along(&self.y_pixels, 1.0 - share(y, self.y));
        (pixel_x.round() as i32, pixel_y.round() as i32)
    }

    /// The parts of a line inside the frame, in pixels.
    fn clip(&self, points: &[(f64, f64)]) -> Vec<Vec<(i32, i32)>> {
        let mut pieces: Vec<Vec<(i32, i32)>> = Vec::new();
        let mut joined = false;
        for pair in points.windows(2) {
            let Some((from, to)) = self.inside(pair[0], pair[1]) else {
                joined = false;
                continue;
            };
            let (a, b) = (self.pixel(from.0, from.1), self.pixel(to.0, to.1));
            match pieces.last_mut() {
                Some(piece) if joined => piece.push(b),
                _ => pieces.push(vec![a, b]),
            }
            joined = to == pair[1];
        }
        pieces
    }

    /// The part of a segment inside the frame (Liang and Barsky).
    fn inside(&self, a: (f64, f64), b: (f64, f64)) -> Option<((f64, f64), (f64, f64))> {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for (direction, distance) in
            [(-dx, a.0 - self.x.0), (dx, self.x.1 - a.0), (-dy, a.1 - self.y.0), (dy, self.y.1 - a.1)]
        {
            if direction == 0.0 {
                if distance < 0.0 {
                    return None;
                }
            } else if direction < 0.0 {
                enter = enter.max(distance / direction);
            } else {
                leave = leave.min(distance / direction);
            }
        }
        let at = |share: f64| if share == 1.0 { b } else { (a.0 + share * dx, a.1 + share * dy) };
        (enter <= leave).then(|| (at(enter), at(leave)))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::plot::{Band, png};

    fn figure() -> Figure {
        let line = |name: &str, factor: f64, tone: Tone| {
            Series::line(
                name,
                (0..50).map(|i| (f64::from(i) / 49.0, factor * (-f64::from(i) / 10.0).exp())).collect(),
                tone,
            )
        };
        let mut gap = line("with a gap", 0.5, Tone::Distinct(1));
        gap.points[20].1 = f64::NAN;
        gap.points[30].1 = f64::INFINITY;
        let panel = |y: Axis| Panel {
            title: "<Site & others>".to_owned(),
            x: Axis::linear("strength"),
            y,
            bands: vec![Band {
                name: "band".to_owned(),
                points: vec![(0.0, 0.1, 1.0), (0.5, 0.0, 0.5), (1.0, 0.01, f64::INFINITY)],
                tone: Tone::Distinct(0),
            }],
            series: vec![line("full", 1.0, Tone::Distinct(0)), gap.clone(), line("", 0.2, Tone::Faint)],
        };
        Figure {
            id: "test".to_owned(),
            title: "A test".to_owned(),
            caption: String::new(),
            remark: "synthetic".to_owned(),
            panels: vec![
                panel(Axis::log("u, m")),
                panel(Axis::linear("u, m")),
                panel(Axis::linear("u, m").between(0.2, 0.4)),
            ],
            columns: 2,
        }
    }

    #[test]
    fn everything_lies_within_the_drawing() {
        for width in [Width::Single, Width::Double] {
            let drawing = svg(&figure(), width).unwrap();
            assert_eq!(drawing.places.len(), 3);
            assert!(drawing.svg.contains("&lt;Site &amp; others&gt;") && drawing.svg.contains("synthetic"));
            assert!(!drawing.svg.contains("NaN") && !drawing.svg.contains("inf"));
            // coordinates of lines and areas
            for points in drawing.svg.split("points=\"").skip(1) {
                for point in points.split('"').next().unwrap().split_whitespace() {
                    let (x, y) = point.split_once(',').unwrap();
                    let (x, y): (i32, i32) = (x.parse().unwrap(), y.parse().unwrap());
                    let (wide, high) = (drawing.size.0 as i32, drawing.size.1 as i32);
                    assert!((0..=wide).contains(&x) && (0..=high).contains(&y), "{point}");
                }
            }
        }
    }

    #[test]
    fn a_place_turns_pixels_into_values() {
        let place = &svg(&figure(), Width::Double).unwrap().places[2];
        assert_eq!(place.y_range, (0.2, 0.4));
        assert!(place.x_pixels.1 - place.x_pixels.0 > 200 && place.y_pixels.1 - place.y_pixels.0 > 100);
    }

    #[test]
    fn a_figure_without_numbers_can_be_drawn() {
        let mut figure = figure();
        for panel in &mut figure.panels {
            panel.bands.clear();
            for series in &mut panel.series {
                series.points.iter_mut().for_each(|point| point.1 = f64::NAN);
            }
        }
        assert!(svg(&figure, Width::Double).is_ok());
        figure.panels.clear();
        assert!(svg(&figure, Width::Double).is_ok());
    }

    #[test]
    fn an_image_has_the_resolution_asked_for() {
        let drawing = svg(&figure(), Width::Single).unwrap();
        match png(&drawing.svg, 192.0) {
            Ok(image) => {
                // width and height stand in the header of a PNG
                let number = |at: usize| u32::from_be_bytes(image[at..at + 4].try_into().unwrap());
                assert_eq!((number(16), number(20)), (2 * drawing.size.0, 2 * drawing.size.1));
            }
            Err(error) => assert!(error.to_string().contains("font"), "{error}"),
        }
    }

    #[test]
    fn dashes_have_gaps() {
        assert_eq!(dashes(&[(0, 0), (20, 0)], 5.0, 3.0), [[(0, 0), (5, 0)], [(8, 0), (13, 0)], [(16, 0), (20, 0)]]);
        // a dash goes round a corner
        assert_eq!(dashes(&[(0, 0), (3, 0), (3, 4)], 5.0, 3.0), [vec![(0, 0), (3, 0), (3, 2)]]);
    }
}
