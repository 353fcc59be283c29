//! A figure on the page: its panels and its legend apart, so that they find their places on any screen, and the values
//! that can be read off.

use serde::Serialize;
use uplift::UpliftError;
use uplift::text::visible;
use uplift_plot::{Figure, Marks, Panel, PanelPlace, Swatch, panel_svg, plain, swatches};

use crate::files::refused;

/// A figure with the values that can be read off it. Titles, captions and names have raised and lowered parts.
#[derive(Debug, Serialize)]
pub(super) struct DrawnFigure {
    id: String,
    title: String,
    caption: String,
    legend: Vec<Swatch>,
    /// The panels as SVG.
    drawings: Vec<String>,
    /// What can be read off each.
    panels: Vec<ReadablePanel>,
}

/// A panel whose values can be read off; its texts are plain.
#[derive(Debug, Serialize)]
struct ReadablePanel {
    place: PanelPlace,
    title: String,
    x: String,
    y: String,
    lines: Vec<ReadableLine>,
}

/// A line whose values can be read off.
#[derive(Debug, Serialize)]
struct ReadableLine {
    name: String,
    points: Vec<(f64, f64)>,
}

impl DrawnFigure {
    /// `figure`, drawn.
    ///
    /// # Errors
    /// A figure that the drawing library does not draw.
    pub(super) fn new(figure: &Figure) -> Result<Self, UpliftError> {
        let (mut drawings, mut panels) = (Vec::new(), Vec::new());
        for panel in &figure.panels {
            let drawing = panel_svg(panel).map_err(|reason| refused(&figure.id, reason))?;
            drawings.push(visible(&drawing.svg).into_owned());
            panels.extend(drawing.places.into_iter().map(|place| readable(panel, place)));
        }
        Ok(Self {
            id: figure.id.clone(),
            title: figure.title.clone(),
            caption: figure.caption.clone(),
            legend: swatches(figure).map_err(|reason| refused(&figure.id, reason))?,
            drawings,
            panels,
        })
    }
}

fn readable(panel: &Panel, place: PanelPlace) -> ReadablePanel {
    let is_line = |marks: Marks| matches!(marks, Marks::None | Marks::Both);
    let named = panel.series.iter().filter(|series| !series.name.is_empty());
    let lines = named.filter(|series| is_line(series.marks) && series.points.len() > 2).map(|series| ReadableLine {
        name: plain(&series.name),
        points: series
            .points
            .iter()
            .filter(|point| point.0.is_finite() && point.1.is_finite())
            .map(|&(x, y)| (short(x), short(y)))
            .collect(),
    });
    ReadablePanel {
        place,
        title: plain(&panel.title),
        x: plain(&panel.x.label),
        y: plain(&panel.y.label),
        lines: lines.collect(),
    }
}

/// A number to the five digits that a reader takes off a curve.
fn short(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}
