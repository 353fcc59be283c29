//! Hazard consistency: whether a set of records scaled to one intensity measure brings what the site's hazard says of
//! another, and how weights of the records make it so.
//!
//! One set scaled to every level x of PGV brings its own PGA, y = x q with q = PGA/PGV of each record, and the other
//! way round. The hazard of y that it implies, `λ̂_y(c) = Σ w_i Σ_j p_ij 1[y_ij > c]`, should be the
//! site's.
//!
//! - [`RecordSet`]: the records with both measures: the same for every site; with [`LevelSets`] where each level has
//!   records of its own.
//! - [`ScaledAnalysis`]: the set, its stripes and the hazard of both measures at a site;
//!   [`ScaledAnalysis::diagnose`] measures the deviation, [`ScaledAnalysis::repair`] weighs the records anew.
//! - [`Diagnosis`]: [`Deviation`] and [`Verdict`], effective records, scale factors.
//! - [`Repaired`], or [`NoRepair`]: the weights, their exponents and [`Warning`]s, or why there are none.
//! - [`Solver`]: the same exponents for thousands of resamples, and with records left out.
//! - [`Agreement`]: what it is worth: spectra by PGA over spectra by PGV.
//!
//! ```
//! use uplift_consistency::{RecordSet, RepairOptions, ScaledAnalysis, Seismology, SetRecord, Verdict};
//! use uplift_hazard::{Extrapolation, HazardCurve};
//!
//! // ln(PGA/PGV) scatters by half a unit around that of 0.01 g to 1 cm/s
//! let record = |pair: usize| {
//!     let other = 0.01 * (0.5 * (pair as f64 / 20.0 - 1.0) * 1.7).exp();
//!     SetRecord { scaled_to: 1.0, other, pair, event: None, seismology: Seismology::default() }
//! };
//! let set = RecordSet::new((0..41).map(record).collect())?;
//! let rising = |first: f64| (0..60).map(move |i| first * 1.15_f64.powi(i));
//! let power = |level: f64| 0.5 * level.powf(-1.8);
//! let pgv = HazardCurve::new("PGV", "cm/s", "", rising(0.5).collect(), rising(0.5).map(power).collect())?;
//! let pga = HazardCurve::new("PGA", "g", "", rising(0.005).collect(), rising(0.5).map(power).collect())?;
//! let levels_cm_s: Vec<f64> = (0..60).map(|i| 1.1_f64.powi(i)).collect();
//! let targets = [4.04e-4, 2.107e-3];
//! let analysis = ScaledAnalysis::new(&set, &levels_cm_s, &pgv, &pga, &targets, Extrapolation::Refuse)?;
//!
//! let before = analysis.diagnose(None, [0.2, 5.0])?;
//! assert_eq!(before.verdict(), Some(Verdict::Off));
//! let repaired = analysis.repair(&RepairOptions::default())?;
//! assert_eq!(repaired.diagnosis.verdict(), Some(Verdict::Consistent));
//! # Ok::<(), uplift_consistency::ConsistencyError>(())
//! ```
//!
//! # Source
//! W. E. Deming and F. F. Stephan, Ann. Math. Statist. 11, 427–444 (1940): adjusting a table to given margins.

mod agreement;
mod analysis;
mod deviation;
mod diagnosis;
mod error;
mod exponent;
mod level_sets;
mod nearest;
mod no_repair;
mod range;
mod reach;
mod repair;
mod scratch;
mod set;
mod solver;
mod stripe;
mod warning;
mod words;

pub use agreement::Agreement;
pub use analysis::{ScaledAnalysis, Target};
pub use deviation::{DEVIATION_RATES, Deviation, TwoSided, Verdict};
pub use diagnosis::{Diagnosis, LeastEffective, TargetDiagnosis};
pub use error::ConsistencyError;
pub use exponent::{Exponents, KNOTS};
pub use level_sets::LevelSets;
pub use nearest::{Miss, Nearest};
pub use no_repair::NoRepair;
pub use range::{HighLimit, LowLimit, RateRange};
pub use reach::Reach;
pub use repair::{RepairOptions, Repaired};
pub use scratch::Scratch;
pub use set::{Powers, RecordSet, Seismology, SetRecord};
pub use solver::{DEFAULT_SMOOTHNESS, FIT_RATES, Fit, Solver};
pub use stripe::{Medians, ScaleFactors, StripeStatistics};
pub use warning::Warning;
pub use words::Words;
