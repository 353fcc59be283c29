//! Stacks of disc springs: in series where they alternate, in parallel where they lie in one another.

use crate::cubic::Cubic;
use crate::disc::DiscSpring;
use crate::error::{StaticsError, require};

/// `n` packets in alternate sense, each of `i` discs in the same sense: `F(d) = i F1(d/n)`. Friction between the discs
/// of a packet is not counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscStack {
    disc: DiscSpring,
    parallel: u32,
    series: u32,
}

impl DiscStack {
    /// From the disc, the number `n` of packets in `series` and the number `i` of discs in `parallel` in each.
    ///
    /// # Errors
    /// Both numbers must be at least 1, and a disc in series with others must not snap through.
    pub fn new(disc: DiscSpring, series: u32, parallel: u32) -> Result<Self, StaticsError> {
        require(series >= 1, "springs", f64::from(series), "", "at least 1")?;
        require(parallel >= 1, "parallel", f64::from(parallel), "", "at least 1")?;
        if series > 1 && disc.snaps_through() {
            return Err(StaticsError::SnapThrough { ratio: disc.snap_ratio() });
        }
        Ok(Self { disc, parallel, series })
    }

    /// The same stack of a material so many times as stiff.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self { disc: self.disc.scaled(factor), ..*self }
    }

    /// The disc.
    pub fn disc(&self) -> &DiscSpring {
        &self.disc
    }

    /// Discs in each packet, `i`.
    pub fn parallel(&self) -> u32 {
        self.parallel
    }

    /// Packets, `n`.
    pub fn series(&self) -> u32 {
        self.series
    }

    /// All discs, `i n`.
    pub fn discs(&self) -> u64 {
        u64::from(self.parallel) * u64::from(self.series)
    }

    /// Force over deformation `d`; meant for deformations from 0 to [`flat_deformation_m`](Self::flat_deformation_m).
    pub fn law(&self) -> Cubic {
        self.disc.law().stacked(self.parallel, self.series)
    }

    /// Deformation at which the stack is flat, `n h0`, m.
    pub fn flat_deformation_m(&self) -> f64 {
        f64::from(self.series) * self.disc.flat_deflection_m()
    }

    /// Force at which the stack is flat, N.
    pub fn flat_force_n(&self) -> f64 {
        f64::from(self.parallel) * self.disc.flat_force_n()
    }

    /// Height of the unloaded stack, `n (h0 + i t)`, m, with `t'` for `t` in all discs but one of a packet where they
    /// have contact flats: `n (l0 + (i − 1) t')`.
    pub fn free_height_m(&self) -> f64 {
        let dimensions = self.disc.dimensions();
        let thickness_m = dimensions.reduced_thickness_m.unwrap_or(dimensions.thickness_m);
        let one_m = dimensions.cone_height_m + dimensions.thickness_m;
        f64::from(self.series) * (one_m + f64::from(self.parallel - 1) * thickness_m)
    }
}
