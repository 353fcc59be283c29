//! What is kept of a motion beside its peak.

/// Why a row of a history is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Moment {
    /// A sample of the record, an end of a piece of the pulse, a step of free rocking.
    Sample,
    /// The block begins to rock, from rest.
    Uplift,
    /// Just before an impact: the rotation is zero, the velocity that of the old corner.
    BeforeImpact,
    /// Just after it, on the other corner.
    AfterImpact,
    /// The block has come to rest.
    Rest,
    /// The block lies on its side, or is on the way there for certain: the last row.
    Overturned,
}

/// A motion in time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct History {
    /// Rows, in ascending time; two of an impact have the same.
    pub rows: Vec<HistoryRow>,
}

/// A moment of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HistoryRow {
    /// Time \[s\], on the clock of the excitation.
    pub time_s: f64,
    /// Rotation θ \[rad\].
    pub rotation_rad: f64,
    /// Angular velocity \[rad/s\].
    pub velocity_rad_s: f64,
    /// What happens.
    pub moment: Moment,
}

/// Told every moment of a motion; what it does with it costs nothing where it does nothing.
pub(crate) trait Observer {
    fn see(&mut self, row: HistoryRow);
}

/// Keeps nothing.
pub(crate) struct Unobserved;

impl Observer for Unobserved {
    fn see(&mut self, _: HistoryRow) {}
}

impl Observer for History {
    fn see(&mut self, mut row: HistoryRow) {
        // an event next to the end of a piece may be a rounding beyond it
        row.time_s = self.rows.last().map_or(row.time_s, |last| row.time_s.max(last.time_s));
        self.rows.push(row);
    }
}
