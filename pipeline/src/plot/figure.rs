//! What a figure shows.

use serde::Serialize;

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

/// Lines and bands over two axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// Title, e.g. the name of a site.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Areas, drawn below the lines.
    pub bands: Vec<Band>,
    /// Lines.
    pub series: Vec<Series>,
}

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Name and unit, e.g. `strength f_up/(m g)`.
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
    /// Thin and grey, for many lines that need no names.
    Faint,
}

/// Whether points are marked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marks {
    /// A line alone.
    None,
    /// Dots alone.
    Only,
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
}

impl Scale {
    /// Position of a value along the axis before it is stretched: itself, or its decimal logarithm; none where it has none.
    pub(super) fn position(self, value: f64) -> Option<f64> {
        match self {
            Self::Linear => value.is_finite().then_some(value),
            Self::Log => (value > 0.0 && value.is_finite()).then(|| value.log10()),
        }
    }
}
