//! The full time history of a run, on demand.

/// A sample of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Time from the start of the record, s.
    pub time_s: f64,
    /// Displacement relative to the ground, m.
    pub displacement_m: f64,
    /// Velocity relative to the ground, m/s.
    pub velocity_m_s: f64,
}

/// What happens when the displacement crosses `±u_up`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventKind {
    /// `abs(u)` rises above the uplift displacement; free of loss.
    Uplift,
    /// `abs(u)` comes down to it; the velocity is multiplied by the coefficient of restitution.
    Impact,
}

/// An uplift or an impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Time from the start of the record, s.
    pub time_s: f64,
    /// Uplift or impact.
    pub kind: EventKind,
    /// Displacement, m: `+u_up` or `−u_up`.
    pub displacement_m: f64,
    /// Velocity just before, m/s.
    pub velocity_before_m_s: f64,
    /// Velocity just after, m/s.
    pub velocity_after_m_s: f64,
}

/// Samples at the instants of the record and the events between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct History {
    /// The motion at every sample of the record and, where asked for, of the free vibration after it.
    pub samples: Vec<Sample>,
    /// Every uplift and impact, in time order.
    pub events: Vec<Event>,
}

/// Receives the samples and events of a run; `()` ignores them at no cost.
pub(crate) trait Observer {
    fn sample(&mut self, sample: Sample);
    fn event(&mut self, event: Event);
}

impl Observer for () {
    fn sample(&mut self, _: Sample) {}
    fn event(&mut self, _: Event) {}
}

impl Observer for History {
    fn sample(&mut self, sample: Sample) {
        self.samples.push(sample);
    }
    fn event(&mut self, event: Event) {
        self.events.push(event);
    }
}
