//! The law of the restrainers between rotations known beforehand, on each of which it is analytic.
//!
//! Slack taken up, the touch of a shifted tendon, stoppers that engage or yield and springs that are flat are kinks: a
//! series across one converges no better than a method of first or second order. The elongation grows with the
//! rotation, so that every kink is a rotation, and a step that ends there is analytic throughout.

use uplift_statics::{PieceLaw, RestrainedColumns, Restrainer, TendonPath, Threshold};

use crate::frame::RockingFrame;

/// The elongation `Δ(θ)` on a branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Form {
    /// `Δ = 2B sin(θ/2)`.
    Axis {
        /// `B`, m.
        lever_m: f64,
    },
    /// `Δ = ρ − ρ₀` with `ρ²` linear in `sin θ` and `1 − cos θ`: Eq. A2.6 and A2.7 (corrected), squared.
    Chord {
        /// `ρ₀`, m.
        rest_m: f64,
        /// Coefficient of `sin θ`, m².
        sine_m2: f64,
        /// Coefficient of `1 − cos θ`, m².
        versine_m2: f64,
    },
}

/// The force `T(Δ)` on a branch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Law {
    /// None.
    Loose,
    /// `T = c + k Δ`.
    Linear { constant_n: f64, stiffness_n_m: f64 },
    /// `T = F_s(d)`, `d + F_s(d)/k_t = Δ + const`.
    Cubic { coefficients: [f64; 4], flexibility_m_n: f64 },
}

/// What holds from a rotation on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Branch {
    /// The rotation, rad.
    pub(crate) from_rad: f64,
    pub(crate) form: Form,
    pub(crate) law: Law,
    /// Whether the stoppers yield on it: turning back then follows another law.
    pub(crate) yields: bool,
}

impl Branch {
    /// `T Δ'` as multiples of `sin θ` and of `cos ½θ`, N m, where it is no more than that.
    pub(crate) fn multiples(&self) -> Option<[f64; 2]> {
        match (self.law, self.form) {
            (Law::Loose, _) => Some([0.0, 0.0]),
            (Law::Linear { constant_n, stiffness_n_m }, Form::Axis { lever_m }) => {
                Some([lever_m * stiffness_n_m * lever_m, lever_m * constant_n])
            }
            _ => None,
        }
    }
}

/// The branches of a frame, by rising rotation, the first from 0; none without restrainers.
pub(crate) fn branches(frame: &RockingFrame) -> Vec<Branch> {
    let columns = frame.columns();
    let Some(restrainer) = columns.restrainer() else { return Vec::new() };
    let touch_rad = columns.path().touch_rotation_rad(columns.geometry());
    let mut kinks: Vec<(f64, Option<usize>)> = restrainer
        .pieces()
        .iter()
        .enumerate()
        .filter_map(|(index, piece)| {
            let from_m = piece.from_elongation_m;
            let rad = if from_m <= 0.0 { Some(0.0) } else { columns.rotation_at_elongation_rad(from_m) };
            rad.map(|rad| (rad, Some(index)))
        })
        .chain(touch_rad.map(|rad| (rad.max(0.0), None)))
        .collect();
    kinks.sort_by(|one, other| one.0.total_cmp(&other.0));
    let (mut piece, mut touches) = (0, false);
    let mut branches: Vec<Branch> = Vec::with_capacity(kinks.len());
    for (from_rad, change) in kinks {
        match change {
            Some(index) => piece = index.max(piece),
            None => touches = true,
        }
        let yields = restrainer.pieces()[piece].threshold == Threshold::StopperYields;
        let branch = Branch { from_rad, form: form(columns, touches), law: law(restrainer, piece), yields };
        match branches.last_mut() {
            Some(last) if from_rad <= last.from_rad => *last = branch,
            _ => branches.push(branch),
        }
    }
    branches
}

fn form(columns: &RestrainedColumns, touches: bool) -> Form {
    let geometry = columns.geometry();
    let (b, height_m) = (geometry.half_width_m(), geometry.height_m());
    match columns.path() {
        TendonPath::Column | TendonPath::Foundation => Form::Axis { lever_m: columns.path().openings() * b },
        TendonPath::Shifted { duct_gap_m, tendon_length_m } => {
            let above_m = tendon_length_m - height_m;
            if touches && duct_gap_m == 0.0 && above_m == 0.0 {
                Form::Axis { lever_m: b }
            } else if touches {
                let lever_m = b - duct_gap_m;
                Form::Chord {
                    rest_m: tendon_length_m - height_m.hypot(duct_gap_m),
                    sine_m2: 2.0 * lever_m * above_m,
                    versine_m2: 2.0 * lever_m * b,
                }
            } else {
                Form::Chord {
                    rest_m: tendon_length_m,
                    sine_m2: 2.0 * tendon_length_m * b,
                    versine_m2: 2.0 * (b * b + height_m * height_m - tendon_length_m * height_m),
                }
            }
        }
    }
}

fn law(restrainer: &Restrainer, index: usize) -> Law {
    let piece = restrainer.pieces()[index];
    let flexibility_m_n = restrainer.tendon_flexibility_m_n();
    let linear = |stiffness_n_m: f64| Law::Linear {
        constant_n: piece.from_force_n - stiffness_n_m * piece.from_elongation_m,
        stiffness_n_m,
    };
    match piece.law {
        PieceLaw::Loose => Law::Loose,
        PieceLaw::Tendon { stiffness_n_m } => linear(stiffness_n_m),
        PieceLaw::Assembly { coefficients: [_, c1, c2, c3] } if c2 == 0.0 && c3 == 0.0 => {
            linear(c1 / (1.0 + flexibility_m_n * c1))
        }
        PieceLaw::Assembly { coefficients } => Law::Cubic { coefficients, flexibility_m_n },
    }
}
