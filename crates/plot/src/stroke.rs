//! Colours, dashes and polylines.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "pixels of a drawing: whole numbers far below any limit"
)]

use plotters::coord::Shift;
use plotters::prelude::*;

use super::figure::{Marks, Tone};

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
/// Dash and gap of each colour, in pixels; none for a full line.
const DASHES: [Option<(i32, i32)>; 7] =
    [None, Some((7, 3)), Some((2, 2)), Some((10, 4)), None, Some((5, 2)), Some((3, 4))];
/// A ramp of falling lightness through the same colours, so that its order shows in grey too.
const RAMP: [(f64, f64, f64); 4] =
    [(250.0, 244.0, 190.0), (86.0, 180.0, 160.0), (0.0, 100.0, 160.0), (16.0, 24.0, 64.0)];
/// A font of so many points, a point being 1/72 inch. A journal's column is drawn at its width, so that these are the
/// points of the printed page: none below 7.
pub(super) fn font(points: f64) -> FontDesc<'static> {
    // the library divides the size by 1.24 for an SVG
    ("sans-serif", 1.24 * points * 96.0 / 72.0 * f64::from(ZOOM)).into_font()
}
/// Units of the drawing to a pixel: the library draws in whole units, which must be too fine to be seen.
pub(super) const ZOOM: u32 = 8;
/// The same, signed.
pub(super) const UNITS: i32 = ZOOM as i32;
/// Width of a line, and of one in the background, units.
pub(super) const LINE: u32 = 3 * ZOOM / 2;
pub(super) const FAINT_LINE: u32 = 3 * ZOOM / 4;

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Failure = Box<dyn std::error::Error>;

pub(super) fn colour(tone: Tone) -> RGBColor {
    match tone {
        Tone::Distinct(index) | Tone::Thin(index) => COLOURS[index % COLOURS.len()],
        Tone::Faint => RGBColor(205, 205, 205),
        Tone::Shade { step, of } => shade(step as f64 / of.saturating_sub(1).max(1) as f64),
    }
}

/// How wide a line is, units. Only those of the full width have dashes: see [`dashed`].
pub(super) fn width(tone: Tone) -> u32 {
    if matches!(tone, Tone::Faint | Tone::Thin(_)) { FAINT_LINE } else { LINE }
}

/// The colour at a share of the ramp.
fn shade(share: f64) -> RGBColor {
    let place = share.clamp(0.0, 1.0) * (RAMP.len() - 1) as f64;
    let below = (place.floor() as usize).min(RAMP.len() - 2);
    let (from, to, part) = (RAMP[below], RAMP[below + 1], place - below as f64);
    let mixed = |from: f64, to: f64| (from + part * (to - from)).round() as u8;
    RGBColor(mixed(from.0, to.0), mixed(from.1, to.1), mixed(from.2, to.2))
}

/// A dot, a smaller one upon a line, or a ring with the line below it covered.
pub(super) fn draw_mark(area: &Area<'_>, at: (i32, i32), tone: Tone, marks: Marks) -> Result<(), Failure> {
    match marks {
        Marks::None => {}
        Marks::Only => area.draw(&Circle::new(at, 2 * UNITS, colour(tone).filled()))?,
        Marks::Both => area.draw(&Circle::new(at, 3 * UNITS / 2, colour(tone).filled()))?,
        Marks::Rings => {
            area.draw(&Circle::new(at, 3 * UNITS, WHITE.filled()))?;
            area.draw(&Circle::new(at, 3 * UNITS, colour(tone).stroke_width(LINE)))?;
        }
    }
    Ok(())
}

/// A polyline in units, `thick` units wide; [`dashed`] gives it its dashes.
pub(super) fn draw_line(area: &Area<'_>, points: &[(i32, i32)], tone: Tone, thick: u32) -> Result<(), Failure> {
    area.draw(&PathElement::new(points.to_vec(), colour(tone).stroke_width(thick)))?;
    Ok(())
}

/// The drawing with the lines of each tone dashed, which the library cannot do.
pub(super) fn dashed(svg: String) -> String {
    COLOURS.iter().zip(DASHES).fold(svg, |svg, (RGBColor(red, green, blue), dash)| {
        let Some((length, gap)) = dash else { return svg };
        let line = format!("stroke=\"#{red:02X}{green:02X}{blue:02X}\" stroke-width=\"{LINE}\"");
        svg.replace(&line, &format!("{line} stroke-dasharray=\"{} {}\"", length * UNITS, gap * UNITS))
    })
}
