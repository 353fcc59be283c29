//! A uniform risk spectrum read at the strength of a structure.

use serde::Serialize;
use uplift_uniform_risk::StrengthPlace;

/// What a spectrum says of a structure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SpectrumDemand {
    /// The strength at which it is read.
    #[serde(skip)]
    pub strength: f64,
    /// The strengths between which it is read.
    pub between_strengths: (f64, f64),
    /// The ordinate, m.
    pub ordinate_m: f64,
    /// The demand on the structure if its stiffness after uplift were zero, m.
    pub zero_stiffness_demand_m: f64,
}

impl SpectrumDemand {
    /// Reads the spectrum `u_m`, m, over ascending `strengths` for a structure of this `strength` and participation;
    /// none outside them, and beside an ordinate that is censored.
    pub(super) fn read(strengths: &[f64], u_m: &[f64], (strength, participation): (f64, f64)) -> Option<Self> {
        let place = StrengthPlace::among(strengths, strength)?;
        let ordinate_m = place.between(u_m[place.left], u_m[place.right]);
        ordinate_m.is_finite().then_some(Self {
            strength,
            between_strengths: (strengths[place.left], strengths[place.right]),
            ordinate_m,
            zero_stiffness_demand_m: participation * ordinate_m,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spectrum_is_read_between_its_strengths_only() {
        let (strengths, u_m) = ([0.1, 0.2, 0.4], [1.0, 0.5, f64::INFINITY]);
        let at = |strength: f64| SpectrumDemand::read(&strengths, &u_m, (strength, 1.5));
        let read = |strength: f64| at(strength).map(|demand| demand.ordinate_m);
        assert_eq!(read(0.1), Some(1.0));
        assert_eq!(read(0.2), Some(0.5));
        assert_eq!(read(0.125), Some(0.875));
        assert_eq!([read(0.09), read(0.3), read(0.4), read(0.5)], [None; 4]);
        assert_eq!(at(0.15).map(|demand| demand.between_strengths), Some((0.1, 0.2)));
    }
}
