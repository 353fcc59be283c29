//! The motion in time.

/// Why a row of a history is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Moment {
    /// A sample of the ground motion, or a step of free motion.
    Sample,
    /// The frame begins to rock, from rest.
    Uplift,
    /// Just after an impact, on the other corners, or after a passage through the apex.
    Impact,
    /// The frame has come to rest.
    Rest,
    /// It lies, or is certain to: the last row.
    Overturned,
}

/// A moment of a motion.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct HistoryRow {
    /// Time, s.
    pub time_s: f64,
    /// Rotation `θ` of the columns, rad; in a plane negative where they lean against its direction.
    pub rotation_rad: f64,
    /// Direction `φ` of the lean, from x towards y, rad.
    pub direction_rad: f64,
    /// `θ̇`, rad/s.
    pub velocity_rad_s: f64,
    /// `φ̇`, rad/s.
    pub turning_rad_s: f64,
    /// Travel `U_x` of the deck, m.
    pub displacement_x_m: f64,
    /// Travel `U_y` of the deck, m.
    pub displacement_y_m: f64,
    /// Rise of the deck, m.
    pub rise_m: f64,
    /// Force of a restrainer, N; 0 without.
    pub tendon_n: f64,
    /// Deformation of its springs, m; 0 without.
    pub spring_m: f64,
    /// Total acceleration of the deck in x, m/s².
    pub deck_acceleration_x_m_s2: f64,
    /// The same in y, m/s².
    pub deck_acceleration_y_m_s2: f64,
    /// The same upwards, gravity not counted, m/s².
    pub deck_acceleration_z_m_s2: f64,
    /// What happens.
    pub moment: Moment,
}

/// A motion in time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct History {
    /// Rows, in ascending time.
    pub rows: Vec<HistoryRow>,
}

/// Receives the moments of a motion.
pub(crate) trait Observer {
    /// Whether rows are wanted: they cost.
    const KEEPS: bool;
    /// Whether more than the largest rotation is wanted: components, the deck's acceleration, the least rotation.
    const FOLLOWS_ALL: bool;
    fn observe(&mut self, row: HistoryRow);
}

/// Keeps nothing; follows all, or nothing but the rotation.
pub(crate) struct Unobserved<const ALL: bool>;

impl<const ALL: bool> Observer for Unobserved<ALL> {
    const KEEPS: bool = false;
    const FOLLOWS_ALL: bool = ALL;
    fn observe(&mut self, _: HistoryRow) {}
}

impl Observer for History {
    const KEEPS: bool = true;
    const FOLLOWS_ALL: bool = true;
    fn observe(&mut self, mut row: HistoryRow) {
        // an event next to the end of a segment may be a rounding beyond it
        row.time_s = self.rows.last().map_or(row.time_s, |last| row.time_s.max(last.time_s));
        self.rows.push(row);
    }
}
