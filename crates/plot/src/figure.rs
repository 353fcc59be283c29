//! What a figure shows. Its texts may have raised and lowered parts: `u_{max}`, `10^{−3}` ([`plain`](super::plain)).

use serde::Serialize;

/// So many computed values, and fewer, are marked along a line.
const FEW: usize = 30;

/// One figure: panels side by side with a common legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name in files and links, e.g. `urs-pgv`.
    pub id: String,
    /// Title.
    pub title: String,
    /// What it shows, in a sentence or two.
    pub caption: String,
    /// A remark inside the figure, e.g. that the records are synthetic; empty for none.
    pub remark: String,
    /// The panels, drawn in rows of [`Figure::columns`].
    pub panels: Vec<Panel>,
    /// Panels in a row.
    pub columns: usize,
}

/// Lines, bands and a map over two axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Title, e.g. the name of a site.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// A map, drawn below everything.
    pub map: Option<Map>,
    /// Areas, drawn below the lines.
    pub bands: Vec<Band>,
    /// Lines.
    pub series: Vec<Series>,
}

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Name and unit, e.g. `strength f_{up}/(m g)`.
    pub label: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Ends; none to take those of the data.
    pub range: Option<(f64, f64)>,
}

/// How an axis is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By decades.
    Log,
}

/// How prominent something is: an own colour and dash for each number, or grey in the background.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// One of the told-apart colours; they repeat after seven.
    Distinct(usize),
    /// One of the same colours, thin and full, for what stands beside a line of that colour.
    Thin(usize),
    /// Thin and grey, for many lines that need no names.
    Faint,
    /// A step of a ramp from light to dark, for values in their order.
    Shade {
        /// Which step, from 0.
        step: usize,
        /// How many there are.
        of: usize,
    },
}

/// Whether points are marked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marks {
    /// A line alone.
    None,
    /// Dots alone.
    Only,
    /// Hollow dots alone, for points that are less sure.
    Rings,
    /// A line with a dot at each of its points.
    Both,
}

/// A line.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend; empty for none.
    pub name: String,
    /// Points; one that is not finite, or not above zero on a logarithmic axis, interrupts the line.
    pub points: Vec<(f64, f64)>,
    /// Colour and dash.
    pub tone: Tone,
    /// Marks.
    pub marks: Marks,
}

/// An area between two lines.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// Name in the legend; empty for none.
    pub name: String,
    /// (x, lower, upper).
    pub points: Vec<(f64, f64, f64)>,
    /// Colour.
    pub tone: Tone,
}

/// A value over two axes: areas between levels, and regions where there is no value.
///
/// It reaches from the first to the last value of each axis; the axes of its panel want that range.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// Values of the horizontal axis, increasing.
    pub x: Vec<f64>,
    /// Values of the vertical axis, increasing.
    pub y: Vec<f64>,
    /// Values `[y, x]`; one that is not finite counts as above every level.
    pub values: Vec<f64>,
    /// Lower ends of the areas, increasing, and what the areas are called. Below the first nothing is drawn.
    pub levels: Vec<(f64, String)>,
    /// Hatched regions, drawn over the areas.
    pub regions: Vec<Region>,
}

/// A part of a map without a value.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// Name in the legend.
    pub name: String,
    /// Which points of the map it holds, `[y, x]`.
    pub inside: Vec<bool>,
    /// Colour of the hatching.
    pub tone: Tone,
    /// Direction of the hatching.
    pub hatch: Hatch,
}

/// Direction of a hatching, which tells regions apart in grey.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hatch {
    /// As a slash.
    Rising,
    /// As a backslash.
    Falling,
}

impl Figure {
    /// A figure without a remark, two panels in a row.
    pub fn new(
        id: impl Into<String>,
        title: impl Into<String>,
        caption: impl Into<String>,
        panels: Vec<Panel>,
    ) -> Self {
        let columns = panels.len().min(2);
        Self { id: id.into(), title: title.into(), caption: caption.into(), remark: String::new(), panels, columns }
    }

    /// The same figure with a remark.
    #[must_use]
    pub fn with_remark(self, remark: impl Into<String>) -> Self {
        Self { remark: remark.into(), ..self }
    }
}

impl Panel {
    /// Lines over two axes.
    pub fn lines(title: impl Into<String>, x: Axis, y: Axis, series: Vec<Series>) -> Self {
        Self { title: title.into(), x, y, map: None, bands: Vec::new(), series }
    }
}

impl Axis {
    /// A linear axis that takes the range of the data.
    pub fn linear(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Linear, range: None }
    }

    /// A logarithmic axis that takes the range of the data.
    pub fn log(label: impl Into<String>) -> Self {
        Self { label: label.into(), scale: Scale::Log, range: None }
    }

    /// The same axis between two values.
    #[must_use]
    pub fn between(self, from: f64, to: f64) -> Self {
        Self { range: Some((from, to)), ..self }
    }
}

impl Series {
    /// A line with a name.
    pub fn line(name: impl Into<String>, points: Vec<(f64, f64)>, tone: Tone) -> Self {
        Self { name: name.into(), points, tone, marks: Marks::None }
    }

    /// Dots without a line.
    pub fn dots(name: impl Into<String>, points: Vec<(f64, f64)>, tone: Tone) -> Self {
        Self { name: name.into(), points, tone, marks: Marks::Only }
    }

    /// A line through computed values, which are marked where they are few: between them nothing was computed.
    pub fn sampled(name: impl Into<String>, points: Vec<(f64, f64)>, tone: Tone) -> Self {
        let marks = if points.len() <= FEW { Marks::Both } else { Marks::None };
        Self { name: name.into(), points, tone, marks }
    }
}

impl Scale {
    /// Position of a value along the axis before it is stretched: itself, or its decimal logarithm; none where it has
    /// none.
    pub(super) fn position(self, value: f64) -> Option<f64> {
        match self {
            Self::Linear => value.is_finite().then_some(value),
            Self::Log => (value > 0.0 && value.is_finite()).then(|| value.log10()),
        }
    }

    /// The value at a position.
    pub(super) fn value(self, position: f64) -> f64 {
        match self {
            Self::Linear => position,
            Self::Log => 10.0_f64.powf(position),
        }
    }
}
