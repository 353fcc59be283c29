//! The largest of what is followed, and when.

/// A largest value and its time.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Peak {
    /// The value: m, rad or m/s², as its name says; +∞ of a frame that overturns.
    pub value: f64,
    /// When it is reached first, s; of an overturned frame, when it lies or is lost for certain.
    pub time_s: f64,
}

impl Peak {
    pub(crate) fn raise(&mut self, value: f64, time_s: f64) {
        if value > self.value {
            *self = Self { value, time_s };
        }
    }
}

/// What is followed through a motion.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Peaks {
    /// `θ`, rad.
    pub(crate) rotation: Peak,
    /// Direction of the lean at the peak of `θ`, rad.
    pub(crate) direction_rad: f64,
    /// `|U_x|/2R` and `|U_y|/2R`.
    pub(crate) travel: [Peak; 2],
    /// Total acceleration of the deck, m/s².
    pub(crate) deck: Peak,
    /// Horizontal reaction of deck and columns, N.
    pub(crate) reaction: Peak,
    /// Least `θ` between two peaks, rad.
    pub(crate) least: Option<f64>,
}
