//! From a figure to SVG, and to the places of its panels.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "pixels of a drawing: whole numbers far below any limit"
)]

use plotters::prelude::*;
use serde::Serialize;

use super::figure::{Figure, Panel};
use super::legend::{Entry, draw_swatch, legend};
use super::panel::{PanelPlace, draw_panel};
use super::stroke::{Area, Failure, UNITS, ZOOM, dashed, font};
use super::typeset::{plain, typeset};

/// How a figure is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Look {
    /// How wide it is.
    pub width: Width,
    /// Whether its title stands in it; a journal wants it in the caption alone.
    pub title: bool,
}

/// How wide a figure is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Width {
    /// One column of a journal, 90 mm.
    Single,
    /// Both columns, 190 mm.
    Double,
    /// As wide as a journal asks for, mm.
    Millimetres(u16),
}

/// A figure of less than this has its panels below each other, mm.
const TWO_COLUMNS_MM: u16 = 140;

impl Width {
    /// Pixels at 96 to the inch.
    fn pixels(self) -> u32 {
        match self {
            Self::Single => 340,
            Self::Double => 718,
            Self::Millimetres(width) => (f64::from(width) / 25.4 * 96.0).round() as u32,
        }
    }

    /// Panels in a row, of so many that a figure would have.
    fn columns(self, wanted: usize) -> usize {
        match self {
            Self::Single => 1,
            Self::Millimetres(width) if width < TWO_COLUMNS_MM => 1,
            Self::Double | Self::Millimetres(_) => wanted,
        }
    }
}

/// A drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// The SVG document.
    pub svg: String,
    /// Width and height, pixels.
    pub size: (u32, u32),
    /// Where its panels are, in their order.
    pub places: Vec<PanelPlace>,
}

/// A name in the legend, and the line or area that stands before it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Swatch {
    /// The name.
    pub name: String,
    /// The SVG document.
    pub svg: String,
}

/// Pixels between the lines of a legend, above the first and below a title.
const ROW: u32 = 17;
const MARGIN: u32 = 6;
const TITLE: u32 = 18;
/// Width and height of a panel drawn by itself, and of a swatch, pixels.
const PANEL: (u32, u32) = (360, 270);
const SWATCH: (u32, u32) = (24, 12);

/// Draw `figure`.
///
/// # Errors
/// What the drawing library cannot do, in its words; none is known.
pub fn svg(figure: &Figure, look: Look) -> Result<Drawing, String> {
    let width = look.width;
    let columns = width.columns(figure.columns.clamp(1, figure.panels.len().max(1)));
    let rows = figure.panels.len().div_ceil(columns).max(1);
    let names = legend(figure);
    let wide = width.pixels() * ZOOM;
    let panel_height = (f64::from(width.pixels()) / columns as f64 * 0.72).clamp(190.0, 380.0) as u32 * ZOOM;
    let title = if look.title { TITLE } else { 0 };
    let legend_rows = legend_layout(&names, wide).last().map_or(0, |place| place.1 / (ROW * ZOOM) as i32 + 1);
    let remark = u32::from(!figure.remark.is_empty());
    let head = (MARGIN + title + ROW * (legend_rows as u32 + remark)) * ZOOM;
    let size = (wide, head + panel_height * rows as u32);
    let mut places = Vec::new();
    let svg = document(size, |root| {
        draw_head(root, figure, title, &names)?;
        let (_, below) = root.split_vertically(head);
        for (panel, area) in figure.panels.iter().zip(below.split_evenly((rows, columns))) {
            places.push(draw_panel(&area, panel)?);
        }
        Ok(())
    })?;
    Ok(Drawing { svg, size: (size.0 / ZOOM, size.1 / ZOOM), places })
}

/// Draw `panel` by itself, for a page that places panels and legend.
///
/// # Errors
/// As [`svg`].
pub fn panel_svg(panel: &Panel) -> Result<Drawing, String> {
    let mut places = Vec::new();
    let svg = document((PANEL.0 * ZOOM, PANEL.1 * ZOOM), |root| {
        places.push(draw_panel(root, panel)?);
        Ok(())
    })?;
    Ok(Drawing { svg, size: PANEL, places })
}

/// The legend of `figure`, for a page that places it.
///
/// # Errors
/// As [`svg`].
pub fn swatches(figure: &Figure) -> Result<Vec<Swatch>, String> {
    let swatch = |entry: Entry| {
        let svg = document((SWATCH.0 * ZOOM, SWATCH.1 * ZOOM), |root| draw_swatch(root, &entry, (UNITS, 0)))?;
        Ok(Swatch { name: entry.name, svg })
    };
    legend(figure).into_iter().map(swatch).collect()
}

/// A drawing of `size` units as an SVG document, white below what `draw` draws.
fn document(size: (u32, u32), draw: impl FnOnce(&Area<'_>) -> Result<(), Failure>) -> Result<String, String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE)
            .map_err(Failure::from)
            .and_then(|()| draw(&root))
            .and_then(|()| Ok(root.present()?))
            .map_err(|error| error.to_string())?;
    }
    // a page shows pixels, the drawing goes on in its units
    let units = format!("width=\"{}\" height=\"{}\"", size.0, size.1);
    let pixels = format!("width=\"{}\" height=\"{}\"", size.0 / ZOOM, size.1 / ZOOM);
    Ok(typeset(&dashed(text.replacen(&units, &pixels, 1))))
}

/// Left edge and top of each entry, units.
fn legend_layout(entries: &[Entry], wide: u32) -> Vec<(i32, i32)> {
    let (mut x, mut y) = (10 * UNITS, 0);
    entries
        .iter()
        .map(|entry| {
            let length = (42 + text_width(&plain(&entry.name))) * UNITS;
            if x > 10 * UNITS && x + length > wide as i32 {
                (x, y) = (10 * UNITS, y + ROW as i32 * UNITS);
            }
            let place = (x, y);
            x += length;
            place
        })
        .collect()
}

/// About how wide a text of the legend is, pixels: that of the widest usual font without serifs.
fn text_width(text: &str) -> i32 {
    let width = |letter: char| match letter {
        'i' | 'j' | 'l' | 't' | 'f' | 'r' | 'I' | ' ' | '.' | ',' | ':' | '(' | ')' | '/' => 4,
        'm' | 'w' | 'M' | 'W' | '%' | '=' => 10,
        letter if letter.is_uppercase() || letter == 'Γ' => 8,
        _ => 7,
    };
    text.chars().map(width).sum()
}

fn draw_head(root: &Area<'_>, figure: &Figure, title: u32, entries: &[Entry]) -> Result<(), Failure> {
    if title > 0 {
        let style = font(9.0).style(FontStyle::Bold);
        root.draw(&Text::new(figure.title.clone(), (8 * UNITS, MARGIN as i32 * UNITS), style))?;
    }
    let mut below = (MARGIN + title) as i32 * UNITS;
    let first = below;
    for (entry, (x, y)) in entries.iter().zip(legend_layout(entries, root.dim_in_pixel().0)) {
        let top = first + y;
        draw_swatch(root, entry, (x, top))?;
        root.draw(&Text::new(entry.name.clone(), (x + 27 * UNITS, top), font(8.0)))?;
        below = top + ROW as i32 * UNITS;
    }
    if !figure.remark.is_empty() {
        let style = font(8.0).style(FontStyle::Italic).color(&RGBColor(170, 60, 0));
        root.draw(&Text::new(figure.remark.clone(), (8 * UNITS, below), style))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
