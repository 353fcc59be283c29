//! From the displacement of the zero-stiffness (ZSBE) system to that of the negative-stiffness (NSBE) one, and
//! back (Section 3.3.2).

use crate::error::{StructureError, not_negative, positive, require};

/// Uplift displacement and displacement capacity of a system: all that the rules depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capacity {
    uplift_displacement_m: f64,
    capacity_m: f64,
}

impl Capacity {
    /// From `u_up` and `u_cap`, m; the latter may be infinite: the ZSBE system.
    ///
    /// # Errors
    /// The uplift displacement must be finite and not negative, the capacity above it.
    pub fn new(uplift_displacement_m: f64, capacity_m: f64) -> Result<Self, StructureError> {
        not_negative("uplift_displacement_m", uplift_displacement_m, "m")?;
        require(capacity_m > 0.0, "capacity_m", capacity_m, "m", "positive")?;
        if capacity_m <= uplift_displacement_m {
            return Err(StructureError::CapacityBelowUplift { capacity_m, uplift_displacement_m });
        }
        Ok(Self { uplift_displacement_m, capacity_m })
    }

    /// Uplift displacement `u_up`, m.
    pub fn uplift_displacement_m(&self) -> f64 {
        self.uplift_displacement_m
    }

    /// Displacement capacity `u_cap`, m.
    pub fn capacity_m(&self) -> f64 {
        self.capacity_m
    }

    /// `u_cap − u_up`, m.
    fn softening_range_m(&self) -> f64 {
        self.capacity_m - self.uplift_displacement_m
    }
}

/// What a rule says of the demand on a negative-stiffness system.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Demand {
    /// The system stands.
    Stands {
        /// Demand `u_dem,NS`, m; at most the displacement capacity.
        displacement_m: f64,
        /// `γ = u_dem,NS/u_dem,ZS` (Eq. 3.8); 1 where there is no demand.
        ratio: f64,
    },
    /// The ZSBE demand is beyond what the rule allows: the negative-stiffness system overturns (Eq. 3.14).
    Overturns {
        /// Largest ZSBE demand with which it would stand, m.
        largest_zero_stiffness_demand_m: f64,
    },
}

impl Demand {
    /// The demand, m: infinite where the system overturns.
    pub fn displacement_m(self) -> f64 {
        match self {
            Self::Stands { displacement_m, .. } => displacement_m,
            Self::Overturns { .. } => f64::INFINITY,
        }
    }
}

/// How the demand of a negative-stiffness system follows from that of the ZSBE system of the same strength and
/// uplift displacement.
///
/// With `z` for `u_dem,ZS` and `n` for `u_dem,NS`, both above `u_up`:
///
/// | | equal displacement (Eq. 3.9, 3.10) | equal energy (Eq. 3.11) |
/// |---|---|---|
/// | demand | `n = z` | `n = u_cap − √((u_cap − u_up)(u_cap − 2z + u_up))` |
/// | back | `z = n` | `z = n − (n − u_up)²/(2(u_cap − u_up))` |
/// | stands if | `z ≤ u_cap` | `z ≤ (u_cap + u_up)/2` (Eq. 3.14) |
///
/// Up to `u_up` both systems are the same, so `n = z` for either rule: Eq. 3.11 itself is meant for uplifted systems
/// and falls below 1 there. As `u_cap → ∞` equal energy becomes equal displacement. The text proposes equal energy, the
/// more conservative one (Section 3.4.4).
///
/// ```
/// use uplift_structure::{Capacity, Demand, Rule};
/// // Table 3.5, near-field pulse-like, 1.0 PGA: 0.472 m on the ZSBE system, 0.576 m with a capacity of 1.60 m
/// let demand = Rule::EqualEnergy.demand(&Capacity::new(0.0005, 1.6)?, 0.472)?;
/// assert!((demand.displacement_m() - 0.576).abs() < 0.001);
/// # Ok::<(), uplift_structure::StructureError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rule {
    /// Both systems reach the same displacement.
    EqualDisplacement,
    /// Both systems take up the same work.
    EqualEnergy,
}

impl Rule {
    /// In words: `equal displacement`.
    pub fn words(self) -> &'static str {
        match self {
            Self::EqualDisplacement => "equal displacement",
            Self::EqualEnergy => "equal energy",
        }
    }

    /// Largest ZSBE demand with which the system stands, m: `u_cap`, or `(u_cap + u_up)/2` (Eq. 3.14).
    pub fn largest_zero_stiffness_demand_m(self, capacity: &Capacity) -> f64 {
        match self {
            Self::EqualDisplacement => capacity.capacity_m,
            Self::EqualEnergy => 0.5 * capacity.capacity_m + 0.5 * capacity.uplift_displacement_m,
        }
    }

    /// Demand on the negative-stiffness system for a demand `u_dem,ZS` (m) on the ZSBE system.
    ///
    /// # Errors
    /// The ZSBE demand must be finite and not negative.
    pub fn demand(self, capacity: &Capacity, zero_stiffness_demand_m: f64) -> Result<Demand, StructureError> {
        let z = not_negative("zero_stiffness_demand_m", zero_stiffness_demand_m, "m")?;
        let largest_zero_stiffness_demand_m = self.largest_zero_stiffness_demand_m(capacity);
        if z > largest_zero_stiffness_demand_m {
            return Ok(Demand::Overturns { largest_zero_stiffness_demand_m });
        }
        let beyond_uplift_m = z - capacity.uplift_displacement_m;
        if self == Self::EqualDisplacement || beyond_uplift_m <= 0.0 {
            return Ok(Demand::Stands { displacement_m: z, ratio: 1.0 });
        }
        // c − √(c² − 2 c d) = d + d x/(1 + √(1 − x))² with x = 2 d/c: nothing cancels where the capacity is large
        let x = (2.0 * beyond_uplift_m / capacity.softening_range_m()).min(1.0);
        let displacement_m = z + beyond_uplift_m * x / (1.0 + (1.0 - x).sqrt()).powi(2);
        let displacement_m = displacement_m.clamp(z, capacity.capacity_m);
        Ok(Demand::Stands { displacement_m, ratio: displacement_m / z })
    }

    /// Demand on the ZSBE system that goes with a demand (m) on the negative-stiffness one: the inverse of
    /// [`demand`](Self::demand), m.
    ///
    /// # Errors
    /// The demand must be finite, not negative and at most the capacity.
    pub fn zero_stiffness_demand_m(self, capacity: &Capacity, demand_m: f64) -> Result<f64, StructureError> {
        not_negative("demand_m", demand_m, "m")?;
        if demand_m > capacity.capacity_m {
            return Err(StructureError::DemandAboveCapacity { demand_m, capacity_m: capacity.capacity_m });
        }
        let beyond_uplift_m = demand_m - capacity.uplift_displacement_m;
        if self == Self::EqualDisplacement || beyond_uplift_m <= 0.0 {
            return Ok(demand_m);
        }
        let softened = 1.0 - 0.5 * beyond_uplift_m / capacity.softening_range_m();
        Ok(capacity.uplift_displacement_m + beyond_uplift_m * softened)
    }

    /// Smallest capacity that is `FS` times the demand it brings about, `u_cap = FS γ u_dem,ZS` (Eq. 3.15), m.
    ///
    /// With equal energy `γ` depends on `u_cap`; the equation is quadratic and its larger root is
    /// `u_cap = (z + √(z² − k u_up (2z − u_up)))/k` with `k = (2 FS − 1)/FS²`. For `u_up = 0` that is
    /// `2 FS²/(2 FS − 1) z`: 3.125 z for `FS = 2.5`, against 2.5 z by equal displacement. Up to `u_up` the demand is
    /// `z` itself and `u_cap = FS z`.
    ///
    /// # Errors
    /// The demand and the uplift displacement must be finite and not negative, the safety factor finite and at least 1.
    pub fn required_capacity_m(
        self,
        zero_stiffness_demand_m: f64,
        uplift_displacement_m: f64,
        safety_factor: f64,
    ) -> Result<f64, StructureError> {
        let z = not_negative("zero_stiffness_demand_m", zero_stiffness_demand_m, "m")?;
        let uplift_m = not_negative("uplift_displacement_m", uplift_displacement_m, "m")?;
        let factor = checked_safety_factor(safety_factor)?;
        if self == Self::EqualDisplacement || z <= uplift_m {
            return Ok(factor * z);
        }
        let k = (2.0 - 1.0 / factor) / factor;
        let uplift_share = uplift_m / z;
        // the root is real: k ≤ 1 leaves at least (1 − u_up/z)²
        let root = (1.0 - k * uplift_share * (2.0 - uplift_share)).max(0.0).sqrt();
        Ok(z * (1.0 + root) / k)
    }
}

/// Error of a demand (m) against the exact one, `(u − u_exact)/u_exact` \[-\]: negative on the unsafe side. `−1` where
/// only the exact one is infinite, `+∞` where only the other is, 0 where both are; none where the exact one is 0.
pub fn relative_error(demand_m: f64, exact_m: f64) -> Option<f64> {
    match (demand_m.is_infinite(), exact_m.is_infinite()) {
        (true, true) => Some(0.0),
        (false, true) => Some(-1.0),
        _ if exact_m == 0.0 => None,
        _ => Some((demand_m - exact_m) / exact_m),
    }
}

/// A safety factor `FS ≥ 1`.
fn checked_safety_factor(safety_factor: f64) -> Result<f64, StructureError> {
    positive("safety_factor", safety_factor, "")?;
    require(safety_factor >= 1.0, "safety_factor", safety_factor, "", "at least 1")
}
