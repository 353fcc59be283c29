//! One system after the other: every motion at every level, then what that says of the system.

use serde::Serialize;
use uplift_block::RockingBlock;
use uplift_fragility::{Stripes, SurfaceTrial, exceedance_counts, standard_deviation};
use uplift_ida::{Peaks, Plan, ScaledMotion, System, Watch, analyse};
use uplift_oscillator::Oscillator;
use uplift_spectra::{Motion, percentile};

use super::fits::{FitReport, OVERTURNING_M, SurfaceReport};
use super::systems::{LibrarySystem, Normalised};
use crate::error::LaboratoryError;

/// How one system responds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SystemReport {
    /// `block` or `oscillator`.
    pub kind: &'static str,
    /// Size parameter R of a block, m.
    pub size_m: Option<f64>,
    /// Slenderness α of a block, rad.
    pub slenderness_rad: Option<f64>,
    /// Strength η of an oscillator.
    pub strength: Option<f64>,
    /// Displacement at uplift of an oscillator, m.
    pub uplift_displacement_m: Option<f64>,
    /// Displacement at which its force is zero, m; none where the force stays constant.
    pub capacity_m: Option<f64>,
    /// Velocity after an impact over the one before.
    pub restitution: f64,
    /// Ground acceleration at uplift, g: tan α or η.
    pub uplift_acceleration_g: f64,
    /// Frequency parameter, rad/s: √(3g/(4R)) of a block, √(η g over the displacement from uplift to capacity) of an
    /// oscillator; none of an oscillator whose force stays constant, which has no normalised PGV.
    pub p_rad_s: Option<f64>,
    /// What the response is: `theta/alpha`, `u/u_cap`, or `u_m` where there is no capacity.
    pub response: &'static str,
    /// By each intensity.
    pub measures: Vec<MeasureReport>,
    /// Overturning over both intensities; none of what cannot overturn.
    pub surface: Option<SurfaceReport>,
}

/// How a system responds to motions that are scaled to levels of one intensity.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasureReport {
    /// The intensity.
    pub measure: Normalised,
    /// Level by level.
    pub levels: Vec<LevelReport>,
    /// Lognormal fits of rocking and of overturning; of rocking alone where the system cannot overturn.
    pub fits: Vec<FitReport>,
}

/// How a system responds to motions of one level.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LevelReport {
    /// The level.
    pub level: f64,
    /// Motions.
    pub motions: u32,
    /// Of these, under how many the system rocks, overturning included.
    pub rocking: u32,
    /// Of these, under how many it overturns.
    pub overturned: u32,
    /// 16, 50 and 84 % of the response over all motions; infinite where it overturns.
    pub percentiles: [f64; 3],
    /// Standard deviation of the logarithm of the response, of motions under which the system rocks and stays; none of
    /// fewer than two.
    pub dispersion: Option<f64>,
}

/// Percentiles of a [`LevelReport`], %.
pub(super) const PERCENT: [f64; 3] = [16.0, 50.0, 84.0];

/// The motions of a library.
pub(super) struct Motions<'a> {
    pub(super) all: &'a [Motion<'a>],
    /// Positions of the motions of each earthquake, or of each record where that is not known.
    pub(super) units: Vec<Vec<usize>>,
    pub(super) gravity_m_s2: f64,
}

impl Motions<'_> {
    /// The normalised intensity of a motion as it is recorded; none of a system that has none such.
    fn intensity(&self, motion: &Motion<'_>, measure: Normalised, of: &LibrarySystem) -> Option<f64> {
        match measure {
            Normalised::Pga => Some(motion.pga_g * self.gravity_m_s2 / of.uplift_m_s2),
            Normalised::Pgv => of.p_rad_s.map(|p_rad_s| 0.01 * motion.pgv_cm_s * p_rad_s / of.uplift_m_s2),
        }
    }
}

/// The intensities by which a system is shaken, with their levels; in the order of the scales of its plan.
pub(super) fn measures<'a>(of: &LibrarySystem, levels: [&'a [f64]; 2]) -> Vec<(Normalised, &'a [f64])> {
    let has = |measure: Normalised| measure == Normalised::Pga || of.p_rad_s.is_some();
    Normalised::ALL.into_iter().zip(levels).filter(|(measure, _)| has(*measure)).collect()
}

/// Shakes one system and sums up what it does.
///
/// Memory: 13 bytes an analysis of this system, and what a fit takes.
pub(super) fn system_report(
    of: &LibrarySystem,
    motions: &Motions<'_>,
    levels: [&[f64]; 2],
    watch: &dyn Watch,
) -> Result<SystemReport, LaboratoryError> {
    let measures = measures(of, levels);
    let scales = |motion: &Motion<'_>| {
        let of_measure = |&(measure, levels): &(Normalised, &[f64])| {
            let own = motions.intensity(motion, measure, of).unwrap_or(f64::NAN);
            levels.iter().map(move |level| level / own).collect::<Vec<f64>>()
        };
        measures.iter().flat_map(of_measure).collect::<Vec<f64>>()
    };
    let scaled = motions.all.iter().map(|motion| ScaledMotion {
        id: &motion.id,
        accelerogram: motion.accelerogram,
        scales: scales(motion),
    });
    let plan = Plan::scaled(scaled.collect(), std::slice::from_ref(&of.system), of.with_free_peak)?;
    let peaks = analyse(&plan, watch)?;
    let mut reports = Vec::new();
    let (mut first, count) = (0, peaks.axes().scales);
    for (measure, levels) in measures {
        let demands_m = &peaks.displacement_m()[first..];
        let stripes = Stripes::strided(levels, demands_m, motions.all.len(), count)?;
        reports.push(measure_report(of, measure, &stripes, &motions.units)?);
        first += levels.len();
    }
    let surface = (of.system.can_overturn()).then(|| SurfaceReport::fit(&trials(of, motions, &plan, &peaks)));
    let (block, oscillator) = match &of.system {
        System::Block(block) => (Some(block), None),
        System::Oscillator(oscillator) => (None, Some(oscillator)),
        System::Frame(_) => (None, None),
    };
    Ok(SystemReport {
        kind: of.system.kind(),
        size_m: block.map(RockingBlock::size_m),
        slenderness_rad: block.map(RockingBlock::slenderness_rad),
        strength: oscillator.map(Oscillator::strength),
        uplift_displacement_m: oscillator.map(Oscillator::uplift_displacement_m),
        capacity_m: oscillator.map(Oscillator::capacity_m).filter(|capacity_m| capacity_m.is_finite()),
        restitution: of.system.restitution(),
        uplift_acceleration_g: of.uplift_m_s2 / motions.gravity_m_s2,
        p_rad_s: of.p_rad_s,
        response: of.response_is(),
        measures: reports,
        surface,
    })
}

fn measure_report(
    of: &LibrarySystem,
    measure: Normalised,
    stripes: &Stripes<'_>,
    units: &[Vec<usize>],
) -> Result<MeasureReport, LaboratoryError> {
    let rocking = exceedance_counts(stripes, of.uplift_m)?;
    let overturned = exceedance_counts(stripes, OVERTURNING_M)?;
    let level = |place: usize| {
        let responses: Vec<f64> = stripes.stripe(place).map(|displacement_m| of.response(displacement_m)).collect();
        let rocks = |displacement_m: &f64| *displacement_m > of.uplift_m && displacement_m.is_finite();
        let logarithms: Vec<f64> = stripes.stripe(place).filter(rocks).map(|u_m| of.response(u_m).ln()).collect();
        LevelReport {
            level: stripes.levels()[place],
            motions: u32::try_from(responses.len()).unwrap_or(u32::MAX),
            rocking: rocking[place],
            overturned: overturned[place],
            percentiles: PERCENT.map(|percent| percentile(&responses, percent)),
            dispersion: (logarithms.len() > 1).then(|| standard_deviation(&logarithms)),
        }
    };
    let mut fits = vec![FitReport::fit("rocking", stripes, of.uplift_m, units)?];
    if of.system.can_overturn() {
        fits.push(FitReport::fit("overturning", stripes, OVERTURNING_M, units)?);
    }
    Ok(MeasureReport { measure, levels: (0..stripes.level_count()).map(level).collect(), fits })
}

/// Every analysis as the surface of overturning takes it.
fn trials(of: &LibrarySystem, motions: &Motions<'_>, plan: &Plan<'_>, peaks: &Peaks) -> Vec<SurfaceTrial> {
    let mut trials = Vec::new();
    for (unit, members) in motions.units.iter().enumerate() {
        for &member in members {
            let own = Normalised::ALL.map(|measure| motions.intensity(&motions.all[member], measure, of));
            let [Some(pga), Some(pgv)] = own else { continue };
            for (scale, displacement_m) in plan.motions()[member].scales.iter().zip(peaks.row_m(member, 0)) {
                let intensities = [pga, pgv].map(|own| scale * own);
                let exceeds = displacement_m.is_infinite();
                trials.push(SurfaceTrial { intensities, exceeds, unit });
            }
        }
    }
    trials
}

impl SystemReport {
    /// Its kind and parameters: `block R 2.5 m, alpha 0.1 rad, r 0.985`.
    pub fn name(&self) -> String {
        let restitution = format!("r {}", rounded(self.restitution));
        match (self.size_m, self.slenderness_rad, self.strength, self.uplift_displacement_m) {
            (Some(size_m), Some(slenderness_rad), ..) => {
                format!("block R {size_m} m, alpha {slenderness_rad} rad, {restitution}")
            }
            (_, _, Some(strength), Some(uplift_m)) => {
                let capacity = self.capacity_m.map_or_else(String::new, |capacity_m| format!(" u_cap {capacity_m} m,"));
                format!("oscillator eta {strength}, u_up {uplift_m} m,{capacity} {restitution}")
            }
            _ => self.kind.to_owned(),
        }
    }
}

/// To four decimals.
fn rounded(value: f64) -> f64 {
    (1e4 * value).round() / 1e4
}
