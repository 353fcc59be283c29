//! From a figure to SVG, and to the places of its panels.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "pixels of a drawing: whole numbers far below any limit"
)]

use plotters::prelude::*;

use super::figure::{Figure, Hatch, Marks, Tone};
use super::map::{draw_hatch, hatching};
use super::panel::{PanelPlace, draw_panel};
use super::stroke::{Area, FAINT_LINE, FONT, Failure, LINE, UNITS, ZOOM, colour, dashed, draw_line, draw_mark};

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
    let wide = width.pixels() * ZOOM;
    let panel_height = (f64::from(width.pixels()) / columns as f64 * 0.72).clamp(190.0, 380.0) as u32 * ZOOM;
    let legend_rows = legend_layout(&names, wide).last().map_or(0, |place| place.1 / (16 * UNITS) + 1);
    let head = (24 + 16 * legend_rows as u32 + if figure.remark.is_empty() { 0 } else { 15 }) * ZOOM;
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
    // the page shows pixels, the drawing goes on in its units
    let pixels = (size.0 / ZOOM, size.1 / ZOOM);
    let units = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    let text = dashed(text.replacen(&units, &format!("width=\"{}\" height=\"{}\"", pixels.0, pixels.1), 1));
    Ok(Drawing { svg: text, size: pixels, places })
}

/// A name in the legend and what stands before it.
struct Entry {
    name: String,
    tone: Tone,
    kind: Kind,
}

#[derive(Clone, Copy)]
enum Kind {
    Line,
    Marks(Marks),
    Area,
    Level,
    Region(Hatch),
}

/// What the legend names: each name once.
fn legend(figure: &Figure) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for panel in &figure.panels {
        let lines = panel.series.iter().map(|series| {
            let kind = if series.marks == Marks::None { Kind::Line } else { Kind::Marks(series.marks) };
            (&series.name, series.tone, kind)
        });
        let bands = panel.bands.iter().map(|band| (&band.name, band.tone, Kind::Area));
        let levels = panel.map.iter().flat_map(|map| {
            let of = map.levels.len();
            map.levels.iter().enumerate().map(move |(step, (_, name))| (name, Tone::Shade { step, of }, Kind::Level))
        });
        let regions = panel
            .map
            .iter()
            .flat_map(|map| map.regions.iter().map(|region| (&region.name, region.tone, Kind::Region(region.hatch))));
        for (name, tone, kind) in lines.chain(bands).chain(levels).chain(regions) {
            if !name.is_empty() && entries.iter().all(|known| known.name != *name) {
                entries.push(Entry { name: name.clone(), tone, kind });
            }
        }
    }
    entries
}

/// Left edge and top of each entry, units.
fn legend_layout(entries: &[Entry], wide: u32) -> Vec<(i32, i32)> {
    let (mut x, mut y) = (10 * UNITS, 0);
    entries
        .iter()
        .map(|entry| {
            let length = (42 + 6 * entry.name.chars().count() as i32) * UNITS;
            if x > 10 * UNITS && x + length > wide as i32 {
                (x, y) = (10 * UNITS, y + 16 * UNITS);
            }
            let place = (x, y);
            x += length;
            place
        })
        .collect()
}

fn draw_head(root: &Area<'_>, figure: &Figure, entries: &[Entry], head: u32) -> Result<(), Failure> {
    let title = (FONT, 13 * ZOOM).into_font().style(FontStyle::Bold);
    root.draw(&Text::new(figure.title.clone(), (8 * UNITS, 6 * UNITS), title))?;
    for (Entry { name, tone, kind }, (x, y)) in entries.iter().zip(legend_layout(entries, root.dim_in_pixel().0)) {
        let top = 24 * UNITS + y;
        let (middle, right) = (top + 6 * UNITS, x + 22 * UNITS);
        match kind {
            Kind::Area => {
                let corners = [(x, middle - 4 * UNITS), (right, middle + 4 * UNITS)];
                root.draw(&Rectangle::new(corners, colour(*tone).mix(0.25).filled()))?;
            }
            Kind::Level => {
                let corners = [(x, middle - 4 * UNITS), (right, middle + 4 * UNITS)];
                root.draw(&Rectangle::new(corners, colour(*tone).filled()))?;
            }
            Kind::Region(hatch) => {
                let (top, bottom) = (middle - 4 * UNITS, middle + 4 * UNITS);
                for ends in hatching(*hatch, x..right, top..bottom, |_| true) {
                    draw_hatch(root, ends.to_vec(), *tone)?;
                }
                root.draw(&Rectangle::new([(x, top), (right, bottom)], colour(*tone).stroke_width(FAINT_LINE)))?;
            }
            Kind::Marks(marks) => draw_mark(root, (x + 11 * UNITS, middle), *tone, *marks)?,
            Kind::Line => draw_line(root, &[(x, middle), (right, middle)], *tone, LINE)?,
        }
        root.draw(&Text::new(name.clone(), (x + 27 * UNITS, top), (FONT, 11 * ZOOM).into_font()))?;
    }
    if !figure.remark.is_empty() {
        let style = (FONT, 11 * ZOOM).into_font().style(FontStyle::Italic).color(&RGBColor(170, 60, 0));
        root.draw(&Text::new(figure.remark.clone(), (8 * UNITS, head as i32 - 15 * UNITS), style))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
