//! A spectrum read between its strengths.

/// A strength between two of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrengthPlace {
    /// The strength.
    pub strength: f64,
    /// Position of the largest strength of the spectrum that is not above it.
    pub left: usize,
    /// Position of the smallest one that is not below it.
    pub right: usize,
    /// How far it lies from the left to the right one, 0 to 1.
    share: f64,
}

impl StrengthPlace {
    /// Where `strength` lies among `strengths`, which ascend; none outside them.
    pub fn among(strengths: &[f64], strength: f64) -> Option<Self> {
        let right = strengths.iter().position(|&value| value >= strength)?;
        let left = if strengths[right] == strength { right } else { right.checked_sub(1)? };
        let (a, b) = (strengths[left], strengths[right]);
        let share = if b > a { (strength - a) / (b - a) } else { 0.0 };
        Some(Self { strength, left, right, share })
    }

    /// The value at the strength, linear between those at its neighbours.
    pub fn between(&self, left: f64, right: f64) -> f64 {
        if self.left == self.right { left } else { left + self.share * (right - left) }
    }
}
