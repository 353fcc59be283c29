//! The force of a restrainer over its elongation.
//!
//! Spring and stopper side by side carry `F_s(d)` at the deformation `d`; the tendon of stiffness `k_t` stretches by
//! `T/k_t` behind them, so that at the elongation `Δ`
//!
//! `d + F_s(d)/k_t = Δ + d0 + T0/k_t`, `T = F_s(d)`, with `F_s(d0) = T0` the prestress,
//!
//! and `dT/dΔ = F_s'/(1 + F_s'/k_t)`. With slack, `Δ − slack` takes the place of `Δ`; a tendon never pushes. The energy
//! is `E(Δ) = ∫T dΔ = ∫F_s dd + T²/(2 k_t)`, less its value at rest.
//!
//! The law is smooth between elongations that are known beforehand, and each [`Piece`] between them says what it is:
//! nothing, the tendon alone, or a polynomial of the third degree in `d` with the tendon behind it. A dynamic model
//! turns the [thresholds](Piece::from_elongation_m) into rotations and integrates from one to the next.

use crate::cubic::Cubic;
use crate::error::{StaticsError, not_negative};
use crate::parts::{Parts, Spring, Stopper, WhenFlat};
use crate::root::bisect;

/// What begins a piece of the law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Threshold {
    /// Nothing does: the first piece.
    Start,
    /// The slack is taken up, or the tendon is no longer loose.
    Taut,
    /// The stopper engages.
    StopperEngages,
    /// The stopper yields.
    StopperYields,
    /// The springs are flat.
    SpringsFlat,
}

/// The law of a piece.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PieceLaw {
    /// No force.
    Loose,
    /// Spring, stopper and tendon: `F_s(d) = c₀ + c₁ d + c₂ d² + c₃ d³`.
    Assembly {
        /// `c₀` (N) to `c₃` (N/m³).
        coefficients: [f64; 4],
    },
    /// The tendon alone stretches: `T = T_from + k_t (Δ − Δ_from)`.
    Tendon {
        /// `k_t`, N/m.
        stiffness_n_m: f64,
    },
}

/// A piece of the law between two thresholds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// What begins it.
    pub threshold: Threshold,
    /// Elongation at which it begins, m; −∞ for the first.
    pub from_elongation_m: f64,
    /// Deformation of the spring there, m.
    pub from_deformation_m: f64,
    /// Force there, N.
    pub from_force_n: f64,
    /// Energy there, J, against that at rest.
    pub from_energy_j: f64,
    /// What the force does from there on.
    pub law: PieceLaw,
}

/// A restrainer at an elongation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestrainerState {
    /// Force `T`, N.
    pub force_n: f64,
    /// Tangent stiffness `dT/dΔ`, N/m; at a threshold that of the piece that begins.
    pub stiffness_n_m: f64,
    /// Energy `E`, J, against that at rest.
    pub energy_j: f64,
    /// Deformation `d` of the spring, m; none without a spring of its own.
    pub deformation_m: Option<f64>,
}

/// A restrainer whose parts go together.
///
/// ```
/// use uplift_statics::{DiscDimensions, DiscSpring, DiscStack, Parts, Restrainer};
/// let disc = DiscSpring::new(DiscDimensions {
///     outer_diameter_m: 0.125,
///     inner_diameter_m: 0.061,
///     thickness_m: 0.006,
///     cone_height_m: 0.0036,
///     reduced_thickness_m: None,
/// })?;
/// let restrainer = Restrainer::new(Parts::discs(DiscStack::new(disc, 10, 1)?, 13_318e3))?;
/// // Section 6.3.3: 1720 kN/m where the stack has been pressed by 21.5 mm
/// let state = restrainer.at(0.0248)?;
/// assert!((state.deformation_m.unwrap() - 0.0216).abs() < 1e-4);
/// assert!((state.force_n / 0.0248 / 1720e3 - 1.0).abs() < 0.01);
/// # Ok::<(), uplift_statics::StaticsError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Restrainer {
    parts: Parts,
    /// `1/k_t`, m/N; 0 without a tendon.
    flexibility_m_n: f64,
    pieces: Vec<Piece>,
    /// Elongation at which the law ends, m.
    limit_m: Option<f64>,
}

impl Restrainer {
    /// From its parts.
    ///
    /// # Errors
    /// Numbers must be finite, forces and lengths not negative, stiffnesses positive; discs in series with a tendon or
    /// under prestress must not snap through; the prestress must lie below what yields or breaks the tendon, presses
    /// the springs flat or engages the stopper; the stopper's gap below the deformation of flat springs; no prestress
    /// with slack.
    pub fn new(parts: Parts) -> Result<Self, StaticsError> {
        check(&parts)?;
        let flexibility_m_n = parts.tendon.map_or(0.0, |tendon| 1.0 / tendon.stiffness_n_m);
        let mut restrainer = Self { parts, flexibility_m_n, pieces: Vec::with_capacity(5), limit_m: None };
        let assembly = assembly_pieces(&parts);
        let prestressed_m = restrainer.deformation_at_prestress_m(&assembly)?;
        // extension of spring and tendon together at rest, from where both are loose
        let rest_m = prestressed_m + parts.prestress_n * flexibility_m_n - parts.slack_m;
        restrainer.add_pieces(&assembly, rest_m);
        let at_rest_j = restrainer.at(0.0)?.energy_j;
        for piece in &mut restrainer.pieces {
            piece.from_energy_j -= at_rest_j;
        }
        Ok(restrainer)
    }

    /// What it is made of.
    pub fn parts(&self) -> &Parts {
        &self.parts
    }

    /// Its pieces, by rising elongation; the first begins at −∞.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// `1/k_t` of the tendon behind the spring, m/N; 0 without a tendon.
    pub fn tendon_flexibility_m_n(&self) -> f64 {
        self.flexibility_m_n
    }

    /// Elongation beyond which nothing yields, m: springs flat, and stopped there.
    pub fn limit_m(&self) -> Option<f64> {
        self.limit_m
    }

    /// Deformation of the springs at which they are flat, m.
    pub fn flat_deformation_m(&self) -> Option<f64> {
        match self.parts.spring {
            Spring::Discs(stack) => Some(stack.flat_deformation_m()),
            Spring::Rigid | Spring::Linear { .. } => None,
        }
    }

    /// Elongation at which a threshold is crossed, m.
    pub fn elongation_at_m(&self, threshold: Threshold) -> Option<f64> {
        let at = self.pieces.iter().find(|piece| piece.threshold == threshold).map(|piece| piece.from_elongation_m);
        at.or(self.limit_m.filter(|_| threshold == Threshold::SpringsFlat))
    }

    /// Force, stiffness, energy and deformation at an elongation `Δ` (m).
    ///
    /// # Errors
    /// [`StaticsError::BeyondFlat`] beyond [`limit_m`](Self::limit_m).
    pub fn at(&self, elongation_m: f64) -> Result<RestrainerState, StaticsError> {
        if let Some(flat_m) = self.limit_m.filter(|limit_m| elongation_m > *limit_m) {
            return Err(StaticsError::BeyondFlat { elongation_m, flat_m, at: String::new() });
        }
        let index = self.pieces.iter().rposition(|piece| piece.from_elongation_m <= elongation_m).unwrap_or(0);
        Ok(self.in_piece(index, elongation_m))
    }

    /// State in the piece of that index, which may be continued beyond its ends.
    fn in_piece(&self, index: usize, elongation_m: f64) -> RestrainerState {
        let piece = &self.pieces[index];
        let has_spring = self.has_spring();
        let beyond_m = elongation_m - piece.from_elongation_m;
        match piece.law {
            PieceLaw::Loose => RestrainerState {
                force_n: 0.0,
                stiffness_n_m: 0.0,
                energy_j: piece.from_energy_j,
                deformation_m: has_spring.then_some(0.0),
            },
            PieceLaw::Tendon { stiffness_n_m } => RestrainerState {
                force_n: piece.from_force_n + stiffness_n_m * beyond_m,
                stiffness_n_m,
                energy_j: piece.from_energy_j + beyond_m * (piece.from_force_n + 0.5 * stiffness_n_m * beyond_m),
                deformation_m: has_spring.then_some(piece.from_deformation_m),
            },
            PieceLaw::Assembly { coefficients } => {
                let (c, polynomial) = (self.flexibility_m_n, Polynomial(coefficients));
                let from_m = piece.from_deformation_m;
                let extension_m = from_m + piece.from_force_n * c + beyond_m;
                let deformation_m = polynomial.behind(c, extension_m, from_m);
                let force_n = polynomial.value(deformation_m);
                let slope_n_m = polynomial.slope(deformation_m);
                let stretch_j = 0.5 * c * (force_n - piece.from_force_n) * (force_n + piece.from_force_n);
                RestrainerState {
                    force_n,
                    stiffness_n_m: slope_n_m / (1.0 + c * slope_n_m),
                    energy_j: piece.from_energy_j + polynomial.work(from_m, deformation_m) + stretch_j,
                    deformation_m: has_spring.then_some(deformation_m),
                }
            }
        }
    }

    /// True where the spring has a deformation of its own: a linear spring that is the whole restrainer has none.
    fn has_spring(&self) -> bool {
        match self.parts.spring {
            Spring::Rigid => false,
            Spring::Linear { .. } => self.parts.tendon.is_some() || self.parts.stopper.is_some(),
            Spring::Discs(_) => true,
        }
    }

    /// Elongation at which the force reaches `force_n` (N) first, m; none where it never does.
    pub fn elongation_at_force_m(&self, force_n: f64) -> Option<f64> {
        if force_n <= 0.0 {
            return None;
        }
        for (index, piece) in self.pieces.iter().enumerate().filter(|(_, piece)| piece.law != PieceLaw::Loose) {
            let end_m = self.pieces.get(index + 1).map(|next| next.from_elongation_m).or(self.limit_m);
            let short_n = |elongation_m: f64| self.in_piece(index, elongation_m).force_n - force_n;
            let from_m = piece.from_elongation_m;
            if piece.from_force_n >= force_n {
                return Some(from_m);
            }
            let end_m = match end_m {
                Some(end_m) => end_m,
                None => self.beyond(index, force_n)?,
            };
            if short_n(end_m) >= 0.0 {
                return Some(bisect(from_m, end_m, short_n));
            }
        }
        None
    }

    /// An elongation in the last piece at which the force is at least `force_n`, m: it rises without end, or not.
    fn beyond(&self, index: usize, force_n: f64) -> Option<f64> {
        let piece = &self.pieces[index];
        let mut step_m = 1e-6;
        while step_m < 1e6 {
            let elongation_m = piece.from_elongation_m + step_m;
            if self.in_piece(index, elongation_m).force_n >= force_n {
                return Some(elongation_m);
            }
            step_m *= 2.0;
        }
        None
    }

    /// The restrainer after its stopper has been stretched to the deformation `largest_deformation_m` (m) of the
    /// springs: the rods that have yielded engage later by their plastic part. Unloading and reloading follow this law
    /// exactly, and loading beyond goes on along the former.
    ///
    /// # Errors
    /// None that the restrainer itself did not have.
    pub fn after_yielding(&self, largest_deformation_m: f64) -> Result<Self, StaticsError> {
        let Some(stopper) = self.parts.stopper else { return Ok(self.clone()) };
        let gap_m = stopper.gap_m + stopper.plastic_m(largest_deformation_m);
        Self::new(Parts { stopper: Some(Stopper { gap_m, ..stopper }), ..self.parts })
    }

    /// Deformation of the spring under the prestress, m.
    fn deformation_at_prestress_m(&self, assembly: &[Piece]) -> Result<f64, StaticsError> {
        let force_n = self.parts.prestress_n;
        let Some(PieceLaw::Assembly { coefficients }) = assembly.first().map(|piece| piece.law) else { return Ok(0.0) };
        if force_n == 0.0 {
            return Ok(0.0);
        }
        let polynomial = Polynomial(coefficients);
        let largest_m = match self.flat_deformation_m() {
            Some(flat_m) if polynomial.value(flat_m) <= force_n => {
                return Err(StaticsError::PrestressBeyondFlat {
                    prestress_n: force_n,
                    flat_n: polynomial.value(flat_m),
                });
            }
            Some(flat_m) => flat_m,
            // a linear spring
            None => 2.0 * force_n / coefficients[1],
        };
        let deformation_m = bisect(0.0, largest_m, |d_m| polynomial.value(d_m) - force_n);
        match self.parts.stopper {
            Some(Stopper { gap_m, .. }) if gap_m <= deformation_m => {
                Err(StaticsError::StopperAtRest { deformation_m, gap_m })
            }
            _ => Ok(deformation_m),
        }
    }

    /// The pieces over the elongation, where `rest_m` is the extension of spring and tendon at rest.
    fn add_pieces(&mut self, assembly: &[Piece], rest_m: f64) {
        let c = self.flexibility_m_n;
        self.pieces.push(Piece {
            threshold: Threshold::Start,
            from_elongation_m: f64::NEG_INFINITY,
            from_deformation_m: 0.0,
            from_force_n: 0.0,
            from_energy_j: 0.0,
            law: PieceLaw::Loose,
        });
        for piece in assembly {
            let from_elongation_m = piece.from_deformation_m + c * piece.from_force_n - rest_m;
            let last = self.pieces.len() - 1;
            let from_energy_j = if last == 0 { 0.0 } else { self.in_piece(last, from_elongation_m).energy_j };
            self.pieces.push(Piece { from_elongation_m, from_energy_j, ..*piece });
        }
        let Some(flat_m) = self.flat_deformation_m() else { return };
        let last = self.pieces[self.pieces.len() - 1];
        let PieceLaw::Assembly { coefficients } = last.law else { return };
        let flat_n = Polynomial(coefficients).value(flat_m);
        let from_elongation_m = flat_m + c * flat_n - rest_m;
        match self.parts.tendon.filter(|_| self.parts.when_flat == WhenFlat::Tendon) {
            None => self.limit_m = Some(from_elongation_m),
            Some(tendon) => {
                let from_energy_j = self.in_piece(self.pieces.len() - 1, from_elongation_m).energy_j;
                self.pieces.push(Piece {
                    threshold: Threshold::SpringsFlat,
                    from_elongation_m,
                    from_deformation_m: flat_m,
                    from_force_n: flat_n,
                    from_energy_j,
                    law: PieceLaw::Tendon { stiffness_n_m: tendon.stiffness_n_m },
                });
            }
        }
    }
}

/// The pieces of spring and stopper by rising deformation, without elongation and energy.
fn assembly_pieces(parts: &Parts) -> Vec<Piece> {
    let piece = |threshold, from_deformation_m, from_force_n, law| Piece {
        threshold,
        from_elongation_m: 0.0,
        from_deformation_m,
        from_force_n,
        from_energy_j: 0.0,
        law,
    };
    let (law, flat_m) = match parts.spring {
        Spring::Rigid => {
            let stiffness_n_m = parts.tendon.map_or(0.0, |tendon| tendon.stiffness_n_m);
            return vec![piece(Threshold::Taut, 0.0, 0.0, PieceLaw::Tendon { stiffness_n_m })];
        }
        Spring::Linear { stiffness_n_m } => (Cubic::new([stiffness_n_m, 0.0, 0.0]), f64::INFINITY),
        Spring::Discs(stack) => (stack.law(), stack.flat_deformation_m()),
    };
    let [c1, c2, c3] = law.coefficients();
    let mut pieces = vec![piece(Threshold::Taut, 0.0, 0.0, PieceLaw::Assembly { coefficients: [0.0, c1, c2, c3] })];
    if let Some(stopper) = parts.stopper {
        let Stopper { gap_m, stiffness_n_m, .. } = stopper;
        let coefficients = [-stiffness_n_m * gap_m, c1 + stiffness_n_m, c2, c3];
        let engaged = PieceLaw::Assembly { coefficients };
        pieces.push(piece(Threshold::StopperEngages, gap_m, law.force_n(gap_m), engaged));
        if let (Some(yield_n), Some(at_m)) = (stopper.yield_n, stopper.yields_at_m().filter(|at_m| *at_m < flat_m)) {
            let yielding = PieceLaw::Assembly { coefficients: [yield_n, c1, c2, c3] };
            pieces.push(piece(Threshold::StopperYields, at_m, law.force_n(at_m) + yield_n, yielding));
        }
    }
    pieces
}

fn check(parts: &Parts) -> Result<(), StaticsError> {
    let Parts { spring, stopper, tendon, prestress_n, slack_m, .. } = *parts;
    not_negative("prestress_n", prestress_n, "N")?;
    not_negative("slack_m", slack_m, "m")?;
    if slack_m > 0.0 && prestress_n > 0.0 {
        return Err(StaticsError::SlackAndPrestress { slack_m, prestress_n });
    }
    let tendon = tendon.map(crate::parts::Tendon::checked).transpose()?;
    if let Some(tendon) = tendon {
        for (key, limit_n) in [("tendon_yield_n", tendon.yield_n), ("tendon_failure_n", tendon.failure_n)] {
            if let Some(limit_n) = limit_n.filter(|limit_n| prestress_n >= *limit_n) {
                return Err(StaticsError::PrestressAboveYield { prestress_n, key, limit_n });
            }
        }
    }
    let stopper = stopper.map(Stopper::checked).transpose()?;
    match spring {
        Spring::Rigid if tendon.is_none() => Err(StaticsError::Missing {
            key: "tendon_stiffness_n_m",
            kind: "tendon",
            advice: "give EA/L of the tendon in N/m",
        }),
        Spring::Rigid if stopper.is_some() => {
            Err(StaticsError::Foreign { key: "stopper", what: "a tendon without springs".to_owned() })
        }
        Spring::Rigid => Ok(()),
        Spring::Linear { stiffness_n_m } => {
            not_negative("stiffness_n_m", stiffness_n_m, "N/m")?;
            if stiffness_n_m == 0.0 && prestress_n > 0.0 {
                return Err(StaticsError::PrestressBeyondFlat { prestress_n, flat_n: 0.0 });
            }
            Ok(())
        }
        Spring::Discs(stack) => {
            let disc = stack.disc();
            if disc.snaps_through() && (tendon.is_some() || prestress_n > 0.0) {
                return Err(StaticsError::SnapThrough { ratio: disc.snap_ratio() });
            }
            match stopper {
                Some(Stopper { gap_m, .. }) if gap_m >= stack.flat_deformation_m() => {
                    Err(StaticsError::StopperBehindFlat { gap_m, flat_m: stack.flat_deformation_m() })
                }
                _ => Ok(()),
            }
        }
    }
}

/// `c₀ + c₁ x + c₂ x² + c₃ x³`.
struct Polynomial([f64; 4]);

impl Polynomial {
    fn value(&self, x: f64) -> f64 {
        let [c0, c1, c2, c3] = self.0;
        c0 + x * (c1 + x * (c2 + x * c3))
    }

    fn slope(&self, x: f64) -> f64 {
        let [_, c1, c2, c3] = self.0;
        c1 + x * (2.0 * c2 + x * 3.0 * c3)
    }

    /// `∫` from `a` to `b`: exact by Simpson's rule, and without cancellation where `b` is near `a`.
    fn work(&self, a: f64, b: f64) -> f64 {
        (b - a) / 6.0 * (self.value(a) + 4.0 * self.value(0.5 * (a + b)) + self.value(b))
    }

    /// The `x ≥ from` at which `x + c · value(x) = sum`: Newton's method, held between bounds. The left side rises at
    /// least as fast as `x` within a piece.
    fn behind(&self, c: f64, sum: f64, from: f64) -> f64 {
        if c == 0.0 {
            return sum;
        }
        let excess = |x: f64| x + c * self.value(x) - sum;
        let (mut low, mut high) = (from.min(sum), sum.max(from));
        let mut x = low;
        for _ in 0..100 {
            let value = excess(x);
            if value == 0.0 {
                return x;
            }
            let bound = if value < 0.0 { &mut low } else { &mut high };
            *bound = x;
            let newton = x - value / (1.0 + c * self.slope(x));
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if next == x || next <= low && next >= high || (next - x).abs() <= f64::EPSILON * 0.5 * next.abs() {
                return next;
            }
            x = next;
        }
        x
    }
}
