//! What is recorded of a motion beside its peak.

/// Why a row of a history is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Moment {
    /// A sample of the record, an end of a segment of the pulse, a step of free rocking.
    Sample,
    /// The block begins to rock, from rest.
    Uplift,
    /// Just before an impact: the rotation is zero, the velocity that of the old corner.
    BeforeImpact,
    /// Just after it, on the other corner.
    AfterImpact,
    /// The block has come to rest.
    Rest,
    /// The block lies on its side, or is certain to: the last row.
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

/// Receives every moment of a motion; [`Unobserved`] ignores them at no cost.
pub(crate) trait Observer {
    fn observe(&mut self, row: HistoryRow);
}

/// Keeps nothing.
pub(crate) struct Unobserved;

impl Observer for Unobserved {
    fn observe(&mut self, _: HistoryRow) {}
}

impl Observer for History {
    fn observe(&mut self, mut row: HistoryRow) {
        // an event next to the end of a segment may be a rounding beyond it
        row.time_s = self.rows.last().map_or(row.time_s, |last| row.time_s.max(last.time_s));
        self.rows.push(row);
    }
}
