//! The fragilities of one system by one measure: counted, and fitted.

use uplift_design::LimitState;
use uplift_fragility::{
    FitSpread, FragilityError, FragilityFunction, FragilityState, Goodness, LognormalFragility, StripeCount, Stripes,
    ZeroInflatedFragility, exceedance_probabilities, fit_lognormal, fit_zero_inflated, lognormal_spread, plain_id,
    stripe_counts,
};
use uplift_job::JobError;
use uplift_motion::IntensityMeasure;

use super::measures::{Foreign, openquake};
use crate::error::ExportsError;

/// The limit states of one system, under records scaled to the levels of one measure.
#[derive(Debug, Clone)]
pub(super) struct Fragility {
    /// `strength 0.2`, `pier oscillator`.
    pub(super) system: String,
    pub(super) measure: IntensityMeasure,
    /// In the unit of the measure, ascending.
    pub(super) levels: Vec<f64>,
    /// The first that begins first.
    pub(super) states: Vec<StateFragility>,
}

/// How often one limit state is exceeded.
#[derive(Debug, Clone)]
pub(super) struct StateFragility {
    pub(super) name: String,
    /// Its displacement, m; infinite for overturning.
    pub(super) displacement_m: f64,
    pub(super) counts: Vec<StripeCount>,
    /// Share of the records that exceed it, `[level]` (Eq. 4.7).
    pub(super) shares: Vec<f64>,
    /// The lognormal function of maximum likelihood, or why there is none.
    pub(super) lognormal: Result<(LognormalFragility, Goodness), FragilityError>,
    /// Standard errors of its parameters; none where it is not fitted without some of the records.
    pub(super) spread: Option<FitSpread>,
    /// The same times that of uplift, or why there is none.
    pub(super) zero_inflated: Result<(ZeroInflatedFragility, Goodness), FragilityError>,
}

impl Fragility {
    /// Counts and fits the `limits` of a system that is still up to `uplift_m`.
    ///
    /// - `units`: positions of the records that are independent of the others.
    pub(super) fn new(
        (system, measure): (String, IntensityMeasure),
        stripes: &Stripes<'_>,
        (uplift_m, limits): (f64, &[LimitState]),
        units: &[Vec<usize>],
    ) -> Result<Self, ExportsError> {
        if let Some(shares) = stripes.shares() {
            let unequal = shares.chunks_exact(stripes.record_count()).any(|of_level| {
                let mut some = of_level.iter().filter(|&&share| share > 0.0);
                let first = some.next().copied().unwrap_or(0.0);
                some.any(|share| (share / first - 1.0).abs() > 1e-9)
            });
            if unequal {
                return Err(JobError::Usage(
                    "--fragility: the records of a level do not count alike, and fragilities are counted: use a \
                     result of records without weights"
                        .to_owned(),
                )
                .into());
            }
        }
        let state = |limit: &LimitState| {
            let threshold_m = limit.threshold_m;
            let counts = stripe_counts(stripes, threshold_m)?;
            let lognormal = fit_lognormal(&counts).map(|fit| {
                let goodness = Goodness::from_counts(&counts, |level| fit.fragility.probability(level));
                (fit.fragility, goodness)
            });
            let zero_inflated = fit_zero_inflated(stripes, uplift_m, threshold_m)
                .map(|fit| (fit, Goodness::from_counts(&counts, |level| fit.probability(level))));
            Ok::<_, ExportsError>(StateFragility {
                name: limit.name.clone(),
                displacement_m: limit.displacement_m,
                shares: exceedance_probabilities(stripes, threshold_m)?,
                spread: lognormal_spread(stripes, threshold_m, units).ok(),
                lognormal,
                zero_inflated,
                counts,
            })
        };
        let states = limits.iter().map(state).collect::<Result<_, _>>()?;
        Ok(Self { system, measure, levels: stripes.levels().to_vec(), states })
    }

    /// Its name in other programs: letters, digits, hyphens and underscores.
    pub(super) fn id(&self) -> String {
        plain_id(&format!("{}_{}", self.system, self.measure.key()))
    }

    /// As `OpenQuake` takes it; none of a measure that it does not have.
    pub(super) fn function(&self) -> Option<FragilityFunction> {
        let Foreign { name, factor, .. } = openquake(self.measure)?;
        let scaled = |fit: &LognormalFragility| LognormalFragility::new(factor * fit.median(), fit.dispersion()).ok();
        let state = |state: &StateFragility| FragilityState {
            name: state.name.clone(),
            shares: state.shares.clone(),
            lognormal: state.lognormal.as_ref().ok().and_then(|(fit, _)| scaled(fit)),
        };
        Some(FragilityFunction {
            id: self.id(),
            imt: name,
            levels: self.levels.iter().map(|level| level * factor).collect(),
            states: self.states.iter().map(state).collect(),
        })
    }
}

/// The limit states that displacements are.
///
/// # Errors
/// None, one that is not positive and finite, or one twice.
pub(super) fn displacement_limits(displacements_m: &[f64]) -> Result<Vec<LimitState>, JobError> {
    let mut sorted_m = displacements_m.to_vec();
    sorted_m.sort_by(f64::total_cmp);
    if sorted_m.is_empty() {
        return Err(JobError::Usage("--fragility: give --displacement-m, or --structure".to_owned()));
    }
    if let Some(bad) = sorted_m.iter().find(|value| !(value.is_finite() && **value > 0.0)) {
        return Err(JobError::Usage(format!("--displacement-m {bad}: give positive displacements in m")));
    }
    if let Some([twice, _]) = sorted_m.windows(2).find(|two| two[0] == two[1]) {
        return Err(JobError::Usage(format!("--displacement-m {twice} is given twice")));
    }
    let state = |threshold_m: f64| {
        let millimetres = (1e3 * threshold_m * 1e9).round() / 1e9;
        let name = format!("u_{millimetres}mm").replace('.', "p");
        LimitState { name, displacement_m: threshold_m, threshold_m }
    };
    Ok(sorted_m.into_iter().map(state).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_that_other_programs_accept() {
        let limits = displacement_limits(&[0.3, 0.0005, 0.1]).unwrap();
        let names: Vec<&str> = limits.iter().map(|limit| limit.name.as_str()).collect();
        assert_eq!(names, ["u_0p5mm", "u_100mm", "u_300mm"]);
        for bad in [&[][..], &[0.0], &[f64::INFINITY], &[0.1, 0.1]] {
            assert!(displacement_limits(bad).is_err(), "{bad:?}");
        }
        let stripes = Stripes::new(&[1.0], &[0.2]).unwrap();
        let units = [vec![0]];
        let of = |system: &str| {
            let subject = (system.to_owned(), IntensityMeasure::Pgv);
            Fragility::new(subject, &stripes, (0.0, &limits), &units).unwrap().id()
        };
        assert_eq!(of("strength 0.2"), "strength_0p2_pgv");
        assert_eq!(of("pier ü/2 wobbling frame"), "pier___2_wobbling_frame_pgv");
    }

    #[test]
    fn records_that_do_not_count_alike_are_refused() {
        let shares = [0.25, 0.75];
        let stripes = Stripes::with_shares(&[1.0], &[0.2, 0.4], (2, 1), Some(&shares)).unwrap();
        let limits = displacement_limits(&[0.3]).unwrap();
        let subject = ("x".to_owned(), IntensityMeasure::Pgv);
        assert!(Fragility::new(subject, &stripes, (0.0, &limits), &[vec![0], vec![1]]).is_err());
    }
}
