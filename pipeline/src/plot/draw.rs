//! From a figure to SVG, and to the places of its panels.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "pixels of a drawing: whole numbers far below any limit"
)]

use plotters::prelude::*;

use super::figure::{Figure, Tone};
use super::panel::{PanelPlace, draw_panel};
use super::stroke::{Area, FONT, Failure, colour, draw_line};

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

#[cfg(test)]
mod tests;
