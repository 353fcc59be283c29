//! A library as fragilities for other programs: its levels as PGA and PGV.

use uplift_fragility::{FragilityFunction, FragilityState, LognormalFragility, plain_id};

use super::compute::{LevelReport, MeasureReport, SystemReport};
use super::systems::Normalised;

/// A count of a level.
type Count = fn(&LevelReport) -> u32;
/// The limit states, as the fits are called, and how many motions exceed them.
const STATES: [(&str, Count); 2] = [("rocking", |level| level.rocking), ("overturning", |level| level.overturned)];

/// The fragilities of each system by each intensity. What cannot overturn has shares of zero.
pub(super) fn functions(systems: &[SystemReport], gravity_m_s2: f64) -> Vec<FragilityFunction> {
    let of = |system: &SystemReport| {
        let of_measure = |measure: &MeasureReport| function(system, measure, gravity_m_s2);
        system.measures.iter().filter_map(of_measure).collect::<Vec<_>>()
    };
    systems.iter().flat_map(of).collect()
}

fn function(system: &SystemReport, measure: &MeasureReport, gravity_m_s2: f64) -> Option<FragilityFunction> {
    let uplift_g = system.uplift_acceleration_g;
    let (imt, unit) = match measure.measure {
        Normalised::Pga => ("PGA", uplift_g),
        Normalised::Pgv => ("PGV", 100.0 * uplift_g * gravity_m_s2 / system.p_rad_s?),
    };
    let levels: Vec<f64> = measure.levels.iter().map(|own| unit * own.level).collect();
    let state = |(name, count): (&str, Count)| {
        let share = |own: &LevelReport| f64::from(count(own)) / f64::from(own.motions);
        let shares: Vec<f64> = measure.levels.iter().map(share).collect();
        let fit = measure.fits.iter().find(|fit| fit.of == name).and_then(|fit| Some((fit.median?, fit.dispersion?)));
        let fit = fit.map(|(median, dispersion)| (unit * median, dispersion)).or_else(|| step(&levels, &shares));
        let lognormal = fit.and_then(|(median, dispersion)| LognormalFragility::new(median, dispersion).ok());
        FragilityState { name: name.to_owned(), shares, lognormal }
    };
    Some(FragilityFunction {
        id: plain_id(&format!("{}_{}", system.name().replace(',', ""), measure.measure.key())),
        imt: imt.to_owned(),
        states: STATES.map(state).into(),
        levels,
    })
}

/// Median and dispersion of shares that step from none to all between two levels, which have no fit of maximum
/// likelihood: three dispersions from the median to either.
fn step(levels: &[f64], shares: &[f64]) -> Option<(f64, f64)> {
    let first = shares.iter().position(|share| *share > 0.0).filter(|&first| first > 0)?;
    let (below, above) = (levels[first - 1], levels[first]);
    shares[first..].iter().all(|share| *share >= 1.0).then(|| ((below * above).sqrt(), (above / below).ln() / 6.0))
}
