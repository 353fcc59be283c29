//! What a run returns.

/// What happens after the last sample, when the ground has come to rest.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum FreeVibration {
    /// The run ends with the record.
    None,
    /// The first peak of the free motion counts, in closed form: no later one is larger, since
    /// impacts only take energy.
    #[default]
    FirstPeak,
    /// The motion is followed for this many seconds more.
    Seconds(f64),
}

/// The response of one oscillator to one excitation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// Largest `abs(u)`, m: `+∞` if the system overturned, never NaN.
    pub peak_displacement_m: f64,
    /// Time of the peak, s from the start of the record; of the overturning if it overturned.
    pub time_of_peak_s: f64,
    /// Impacts: times that `abs(u)` came down to the uplift displacement.
    pub impacts: u32,
    /// Uplifts: times that `abs(u)` rose above the uplift displacement.
    pub uplifts: u32,
    /// True if a negative-stiffness system can no longer return.
    pub overturned: bool,
    /// Displacement at the end of the run, m (of the record, where only the first free peak was asked for).
    pub end_displacement_m: f64,
    /// Velocity at the end of the run, m/s.
    pub end_velocity_m_s: f64,
}
