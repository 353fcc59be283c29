//! A uniform risk spectrum read at the strength of a structure.

use serde::Serialize;

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

/// Where a spectrum was read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SpectrumReading {
    /// The strengths between which it was read, those of two ordinates that exist.
    pub(super) between: (f64, f64),
    /// The ordinate, m.
    pub(super) ordinate_m: f64,
}

/// Reads a spectrum at `strength`, linear between its strengths; none outside them, and beside an ordinate that is
/// censored.
///
/// * `strengths` — ascending
/// * `u_m` — the ordinates, m
pub(super) fn read_spectrum(strengths: &[f64], u_m: &[f64], strength: f64) -> Option<SpectrumReading> {
    let right = strengths.iter().position(|&value| value >= strength)?;
    let left = if strengths[right] == strength { right } else { right.checked_sub(1)? };
    let (a, b) = (strengths[left], strengths[right]);
    let share = if b > a { (strength - a) / (b - a) } else { 0.0 };
    let ordinate_m = u_m[left] + share * (u_m[right] - u_m[left]);
    ordinate_m.is_finite().then_some(SpectrumReading { between: (a, b), ordinate_m })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spectrum_is_read_between_its_strengths_only() {
        let (strengths, u_m) = ([0.1, 0.2, 0.4], [1.0, 0.5, f64::INFINITY]);
        let read = |strength: f64| read_spectrum(&strengths, &u_m, strength).map(|reading| reading.ordinate_m);
        assert_eq!(read(0.1), Some(1.0));
        assert_eq!(read(0.2), Some(0.5));
        assert_eq!(read(0.125), Some(0.875));
        assert_eq!([read(0.09), read(0.3), read(0.4), read(0.5)], [None; 4]);
        assert_eq!(read_spectrum(&strengths, &u_m, 0.15).map(|reading| reading.between), Some((0.1, 0.2)));
    }
}
