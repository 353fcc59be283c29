//! Preliminary design of a free rocking structure by the equal displacement rule (Section 2.4.3).

use crate::error::{StructureError, positive};
use crate::rule::checked_safety_factor;

/// A point of a size-independent demand spectrum (`2H = ∞`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectrumPoint {
    /// Slenderness as a tangent, `tan α = b/h`.
    pub tangent: f64,
    /// Displacement demand of the top, m: for a solitary block 3/2 times the ordinate of the ZSBE spectrum at
    /// `η = tan α` (row 4).
    pub demand_m: f64,
}

/// What Section 2.4.3 leads to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlendernessDesign {
    /// `tan α_k`: where the capacity line `2H tan α` meets the spectrum.
    pub critical_tangent: f64,
    /// `tan α_D = FS tan α_k`.
    pub design_tangent: f64,
    /// Demand of the spectrum at the design slenderness, m.
    pub demand_m: f64,
    /// Capacity at the design slenderness, `2H tan α_D`, m: the width of the block.
    pub capacity_m: f64,
}

impl SlendernessDesign {
    /// Margin: capacity less demand, m.
    pub fn margin_m(&self) -> f64 {
        self.capacity_m - self.demand_m
    }

    /// Demand over capacity, `u/(2b)`.
    pub fn utilisation(&self) -> f64 {
        self.demand_m / self.capacity_m
    }
}

/// Slenderness of a block of height `2H` (m): the intersection of capacity line and spectrum, times a safety
/// factor (2.5 in the text).
///
/// For a frame, `2H` is [`Frame::equivalent_block_height_m`](crate::Frame::equivalent_block_height_m). The spectrum is
/// linear between its points. Where it meets the capacity line more than once, the largest `tan α` counts: to the right
/// of it every block stands.
///
/// The text calls the factor 2.5 a safety factor: it multiplies the slenderness, so capacity over demand at the design
/// point is larger than 2.5 wherever the spectrum falls.
///
/// # Errors
/// The spectrum must have two points or more with rising tangents and finite demands, meet the capacity line, and reach
/// the design slenderness.
pub fn design_slenderness(
    spectrum: &[SpectrumPoint],
    height_m: f64,
    safety_factor: f64,
) -> Result<SlendernessDesign, StructureError> {
    let height_m = positive("height_m", height_m, "m")?;
    let safety_factor = checked_safety_factor(safety_factor)?;
    check(spectrum)?;
    let critical_tangent = intersection(spectrum, height_m)?;
    let design_tangent = safety_factor * critical_tangent;
    let demand_m = read(spectrum, design_tangent)?;
    Ok(SlendernessDesign { critical_tangent, design_tangent, demand_m, capacity_m: height_m * design_tangent })
}

fn check(spectrum: &[SpectrumPoint]) -> Result<(), StructureError> {
    let refuse = |index: usize, requirement| {
        let SpectrumPoint { tangent, demand_m } = spectrum[index];
        Err(StructureError::SpectrumPoint { index, tangent, demand_m, requirement })
    };
    if spectrum.len() < 2 {
        return Err(StructureError::TooFewPoints { points: spectrum.len() });
    }
    for (index, point) in spectrum.iter().enumerate() {
        if !(point.tangent >= 0.0 && point.tangent.is_finite()) {
            return refuse(index, "tan α must be finite and not negative");
        }
        if !(point.demand_m >= 0.0 && point.demand_m.is_finite()) {
            return refuse(index, "the demand must be finite and not negative");
        }
        if index > 0 && point.tangent <= spectrum[index - 1].tangent {
            return refuse(index, "tan α must rise from point to point");
        }
    }
    Ok(())
}

/// Largest `tan α` at which the demand equals the capacity `2H tan α`.
fn intersection(spectrum: &[SpectrumPoint], height_m: f64) -> Result<f64, StructureError> {
    let shortfall_m = |point: &SpectrumPoint| point.demand_m - height_m * point.tangent;
    let last = spectrum[spectrum.len() - 1];
    if shortfall_m(&last) > 0.0 {
        return Err(StructureError::NeverStands { last_tangent: last.tangent, capacity_m: height_m * last.tangent });
    }
    // a spectrum that starts at the origin touches the line there: that is not a structure
    let touches = |point: &SpectrumPoint| shortfall_m(point) >= 0.0 && point.tangent > 0.0 || shortfall_m(point) > 0.0;
    let Some(left) = spectrum.iter().rposition(touches) else {
        let first = spectrum[0];
        return Err(StructureError::StandsThroughout {
            first_tangent: first.tangent,
            capacity_m: height_m * first.tangent,
        });
    };
    let (a, over_m) = (spectrum[left], shortfall_m(&spectrum[left]));
    let Some(b) = spectrum.get(left + 1).filter(|_| over_m > 0.0) else { return Ok(a.tangent) };
    let share = over_m / (over_m - shortfall_m(b));
    Ok(a.tangent + share * (b.tangent - a.tangent))
}

/// The spectrum's demand at a slenderness at or above the first point, m.
fn read(spectrum: &[SpectrumPoint], tangent: f64) -> Result<f64, StructureError> {
    let Some(right) = spectrum.iter().position(|point| point.tangent >= tangent) else {
        let last_tangent = spectrum[spectrum.len() - 1].tangent;
        return Err(StructureError::BeyondSpectrum { design_tangent: tangent, last_tangent });
    };
    let b = spectrum[right];
    let Some(a) = right.checked_sub(1).map(|left| spectrum[left]) else { return Ok(b.demand_m) };
    let share = (tangent - a.tangent) / (b.tangent - a.tangent);
    Ok(a.demand_m + share * (b.demand_m - a.demand_m))
}
