//! Parameters of an uplifting oscillator, checked once.

use crate::branch::Branch;
use crate::error::{OscillatorError, require, require_positive};

/// Standard acceleration of gravity, m/s².
pub const STANDARD_GRAVITY_M_S2: f64 = 9.806_65;

/// Slope of the restoring force after uplift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PostUplift {
    /// Constant force: the ZSBE system (`u_cap = ∞`).
    Zero,
    /// Falling force that vanishes at the displacement capacity: the NSBE system (Eq. 4.2 with the sign mended).
    Negative {
        /// Displacement of zero restoring force `u_cap`, m; above the uplift displacement.
        capacity_m: f64,
    },
    /// Rising force.
    Positive {
        /// Stiffness after uplift over the mass, 1/s²; positive.
        stiffness_per_s2: f64,
    },
}

impl PostUplift {
    /// A number for its kind, and its parameter, 0 without one. Keys of finished analyses are made of both: they never
    /// change.
    pub fn identity(self) -> (u32, f64) {
        match self {
            Self::Zero => (0, 0.0),
            Self::Negative { capacity_m } => (1, capacity_m),
            Self::Positive { stiffness_per_s2 } => (2, stiffness_per_s2),
        }
    }
}

/// A mass-normalised oscillator that uplifts at a given strength (Eq. 4.1–4.3).
///
/// | branch | restoring force per mass `r(u)` |
/// |---|---|
/// | attached, `abs(u) ≤ u_up` | `η g u/u_up` |
/// | uplifted, ZSBE | `sgn(u) η g` |
/// | uplifted, NSBE | `sgn(u) η g (u_cap − abs(u))/(u_cap − u_up)` |
/// | uplifted, positive stiffness | `sgn(u) (η g + k (abs(u) − u_up))` |
///
/// When `abs(u)` comes down to `u_up` the velocity is multiplied by the coefficient of restitution (Eq. 4.3).
/// Strength zero without post-uplift stiffness is a free mass: no force, no uplift, no impact, so its peak is
/// the peak ground displacement.
#[derive(Debug, Clone, PartialEq)]
pub struct Oscillator {
    strength: f64,
    gravity_m_s2: f64,
    uplift_displacement_m: f64,
    restitution: f64,
    post_uplift: PostUplift,
}

/// Stiffest branch that is followed, 1/s²: 16 kHz, far above what a record shakes; the time that a run takes grows with
/// its root.
const STIFFEST_PER_S2: f64 = 1e10;

/// Steps of a run, at most: some seconds, and a time history of a gigabyte.
const MOST_STEPS: f64 = 1e7;

impl Oscillator {
    /// A ZSBE oscillator of strength `η = f_up/(m g)` with the dissertation's `u_up = 0.5 mm`,
    /// `r_c = 0.95` and standard gravity.
    ///
    /// # Errors
    /// The strength must be finite and not negative.
    pub fn zsbe(strength: f64) -> Result<Self, OscillatorError> {
        Self::new(strength, STANDARD_GRAVITY_M_S2, 0.0005, 0.95, PostUplift::Zero)
    }

    /// An oscillator from all of its parameters.
    ///
    /// * `strength` — `η = f_up/(m g)`, finite and ≥ 0
    /// * `gravity_m_s2` — acceleration of gravity, m/s², > 0
    /// * `uplift_displacement_m` — `u_up`, m, > 0
    /// * `restitution` — `r_c`, in \[0, 1\]
    ///
    /// # Errors
    /// A parameter outside its range is named with its value; [`OscillatorError::TooStiff`] where they make an
    /// oscillator that no motion resolves.
    pub fn new(
        strength: f64,
        gravity_m_s2: f64,
        uplift_displacement_m: f64,
        restitution: f64,
        post_uplift: PostUplift,
    ) -> Result<Self, OscillatorError> {
        require(strength.is_finite() && strength >= 0.0, "strength", strength, "", "finite and not negative")?;
        require_positive("gravity_m_s2", gravity_m_s2, "m/s²")?;
        require_positive("uplift_displacement_m", uplift_displacement_m, "m")?;
        require((0.0..=1.0).contains(&restitution), "restitution", restitution, "", "between 0 and 1")?;
        match post_uplift {
            PostUplift::Zero => {}
            PostUplift::Negative { capacity_m } => {
                require_positive("capacity_m", capacity_m, "m")?;
                if capacity_m <= uplift_displacement_m {
                    return Err(OscillatorError::CapacityBelowUplift { capacity_m, uplift_displacement_m });
                }
            }
            PostUplift::Positive { stiffness_per_s2 } => {
                require_positive("post_uplift_stiffness_per_s2", stiffness_per_s2, "1/s²")?;
            }
        }
        let oscillator = Self { strength, gravity_m_s2, uplift_displacement_m, restitution, post_uplift };
        for (branch, of) in [("while attached", oscillator.attached()), ("after uplift", oscillator.uplifted())] {
            if !(of.stiffness_per_s2.abs() <= STIFFEST_PER_S2) {
                return Err(OscillatorError::TooStiff {
                    branch,
                    stiffness_per_s2: of.stiffness_per_s2,
                    most_per_s2: STIFFEST_PER_S2,
                    strength,
                    gravity_m_s2,
                    uplift_displacement_m,
                });
            }
        }
        Ok(oscillator)
    }

    /// Strength `η = f_up/(m g)`.
    pub fn strength(&self) -> f64 {
        self.strength
    }

    /// Restoring force per mass at uplift, `η g`, m/s².
    pub fn uplift_acceleration_m_s2(&self) -> f64 {
        self.strength * self.gravity_m_s2
    }

    /// Uplift displacement `u_up`, m.
    pub fn uplift_displacement_m(&self) -> f64 {
        self.uplift_displacement_m
    }

    /// Coefficient of restitution `r_c` (Eq. 4.3).
    pub fn restitution(&self) -> f64 {
        self.restitution
    }

    /// Slope after uplift.
    pub fn post_uplift(&self) -> PostUplift {
        self.post_uplift
    }

    /// Displacement of zero restoring force, m: infinite unless the post-uplift stiffness is negative.
    pub fn capacity_m(&self) -> f64 {
        match self.post_uplift {
            PostUplift::Negative { capacity_m } => capacity_m,
            PostUplift::Zero | PostUplift::Positive { .. } => f64::INFINITY,
        }
    }

    /// Refuses a run of more than 1e7 steps: samples `dt_s` (s) apart for `duration_s`, free vibration included, and
    /// half cycles of the stiffer branch, or times of growth where the force falls.
    ///
    /// # Errors
    /// [`OscillatorError::TooManySteps`].
    pub fn check_run_length(&self, duration_s: f64, dt_s: f64) -> Result<(), OscillatorError> {
        let [attached, uplifted] = [self.attached(), self.uplifted()].map(|branch| branch.stiffness_per_s2.abs());
        let half_cycles = attached.max(uplifted).sqrt() * duration_s / std::f64::consts::PI;
        let steps = duration_s / dt_s + half_cycles;
        if steps <= MOST_STEPS {
            return Ok(());
        }
        Err(OscillatorError::TooManySteps { duration_s, dt_s, steps, most: MOST_STEPS })
    }

    /// True where no force ever acts on the mass: strength zero and no stiffness after uplift.
    pub fn is_free_mass(&self) -> bool {
        self.strength == 0.0 && !matches!(self.post_uplift, PostUplift::Positive { .. })
    }

    /// The displacement at which the branch changes, m: infinite for the free mass, which has no branches.
    pub(crate) fn boundary_m(&self) -> f64 {
        if self.is_free_mass() { f64::INFINITY } else { self.uplift_displacement_m }
    }

    /// The branch `abs(u) ≤ u_up`.
    pub(crate) fn attached(&self) -> Branch {
        Branch { stiffness_per_s2: self.uplift_acceleration_m_s2() / self.uplift_displacement_m, offset_m_s2: 0.0 }
    }

    /// The branch `abs(u) > u_up` on the positive side; on the negative one the offset changes its sign.
    pub(crate) fn uplifted(&self) -> Branch {
        let at_uplift = self.uplift_acceleration_m_s2();
        match self.post_uplift {
            PostUplift::Zero => Branch { stiffness_per_s2: 0.0, offset_m_s2: at_uplift },
            PostUplift::Negative { capacity_m } => {
                let fall = at_uplift / (capacity_m - self.uplift_displacement_m);
                Branch { stiffness_per_s2: -fall, offset_m_s2: fall * capacity_m }
            }
            PostUplift::Positive { stiffness_per_s2 } => {
                Branch { stiffness_per_s2, offset_m_s2: at_uplift - stiffness_per_s2 * self.uplift_displacement_m }
            }
        }
    }
}
