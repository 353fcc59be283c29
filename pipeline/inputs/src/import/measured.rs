//! What a pair of components measures.

use uplift_motion::{
    Accelerogram, Combination, PulseClassification, RecordPair, classify_pulse, geometric_mean, may_be_pulse_like,
};

/// Measures of a pair; of those of single components the geometric mean.
#[derive(Debug, Clone)]
pub struct PairMeasures {
    /// PGA (g) and PGV (cm/s) in every combination that can be had, in the order of [`Combination::ALL`].
    pub peaks: Vec<Option<[f64; 2]>>,
    /// Peak ground displacement, cm.
    pub pgd_cm: f64,
    /// Arias intensity, m/s.
    pub arias_m_s: f64,
    /// Cumulative absolute velocity, m/s.
    pub cav_m_s: f64,
    /// Significant durations D5-75 and D5-95, s.
    pub durations_s: [f64; 2],
    /// Velocity at the end as a share of the PGV, the larger one of the two components.
    pub residual_velocity_share: f64,
    /// Whether there is a velocity pulse; none where it was not sought or cannot be judged.
    pub pulse_like: Option<bool>,
    /// The pulse, or the strongest motion that could be one; none also where the motion is too weak for any.
    pub pulse: Option<PulseClassification>,
}

impl PairMeasures {
    /// Measures `pair`; `gravity_m_s2` makes g of accelerations, `pulses` tells whether a velocity pulse is sought.
    pub fn from_pair(pair: &RecordPair, gravity_m_s2: f64, pulses: bool) -> Self {
        let peaks = Combination::all_peaks_of(pair).map(|peaks| {
            let peaks = peaks?;
            Some([peaks.pga_g(gravity_m_s2), peaks.pgv_cm_s()])
        });
        let strong = may_be_pulse_like(&pair.h1, &pair.h2);
        let pulse = if pulses && strong { classify_pulse(&pair.h1, &pair.h2).ok() } else { None };
        let mean = |of: &dyn Fn(&Accelerogram) -> f64| geometric_mean(of(&pair.h1), of(&pair.h2));
        let residual = |motion: &Accelerogram| motion.residual_velocity_m_s().abs() / motion.pgv_m_s();
        Self {
            peaks: peaks.to_vec(),
            pgd_cm: 100.0 * mean(&Accelerogram::pgd_m),
            arias_m_s: mean(&|motion| motion.arias_intensity_m_s(gravity_m_s2)),
            cav_m_s: mean(&Accelerogram::cumulative_absolute_velocity_m_s),
            durations_s: [mean(&Accelerogram::d5_75_s), mean(&Accelerogram::d5_95_s)],
            residual_velocity_share: residual(&pair.h1).max(residual(&pair.h2)),
            pulse_like: if pulses && !strong { Some(false) } else { pulse.map(|pulse| pulse.is_pulse_like) },
            pulse,
        }
    }
}
