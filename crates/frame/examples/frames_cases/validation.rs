//! Measured against computed samples: every statistic of them.

use serde_json::{Map, Value};
use uplift_validation::{
    AndersonDarling, CramerVonMises, Evidence, KolmogorovSmirnov, MannWhitney, Pairs, Quantiles, Resampling, Sample,
    bands, dkw_half_width, energy_distance, greenwood_band, kstest2_p, median_ratio_band, wasserstein_distance,
};

use super::comparison::{Comparison, number};

/// Relative tolerance: both sides are computed with doubles.
const TOLERANCE: f64 = 1e-9;
/// Absolute tolerance, for statistics that may vanish.
const NOTHING: f64 = 1e-12;

pub(crate) fn validation_case(case: &Value, comparison: &mut Comparison) -> Result<(), String> {
    let case = case.as_object().ok_or("not an object")?;
    comparison.tolerance = number(case, "tolerance").unwrap_or(TOLERANCE);
    let (measured, computed) = (values(case, "measured")?, values(case, "computed")?);
    let sample = |values: &[f64]| Sample::new(values.to_vec()).map_err(|error| error.to_string());
    let samples = [sample(&measured)?, sample(&computed)?];
    let expected = case.get("expected").and_then(Value::as_object).ok_or("no expected")?;
    for (name, value) in expected {
        match name.as_str() {
            "cdf_band" => band(&samples[0], value, comparison),
            "median_ratio_bootstrap_5_50_95" => {
                if !value.is_null() {
                    let found = median_ratio(&measured, &computed, &samples, value)?;
                    bootstrap(found, value, comparison);
                }
            }
            "cramer_von_mises_p_method" => {}
            "cramer_von_mises_p" => {
                let found = CramerVonMises::from_samples(&samples[0], &samples[1]);
                let is_limit = expected.get("cramer_von_mises_p_method").and_then(Value::as_str) == Some("asymptotic");
                let ours = if is_limit { found.p_limit } else { found.p };
                comparison.within(name, Some(ours), value, NOTHING, comparison.tolerance);
            }
            "evidence" => {
                let found = KolmogorovSmirnov::from_samples(&samples[0], &samples[1]);
                comparison.same(name, Evidence::from_p(found.p_exact).words(), value);
            }
            _ => match statistic(name, &measured, &computed, &samples)? {
                Ok(ours) => comparison.within(name, ours, value, NOTHING, comparison.tolerance),
                Err(Unknown) => comparison.unknown(name),
            },
        }
    }
    Ok(())
}

/// A name that is no statistic.
struct Unknown;

fn statistic(
    name: &str,
    measured: &[f64],
    computed: &[f64],
    [one, other]: &[Sample; 2],
) -> Result<Result<Option<f64>, Unknown>, String> {
    let ks = || KolmogorovSmirnov::from_samples(one, other);
    let ad = || AndersonDarling::from_samples(one, other);
    let pairs = || Pairs::from_peaks(measured, computed).map_err(|error| error.to_string());
    let finite = |value: f64| value.is_finite().then_some(value);
    Ok(Ok(match name {
        "ks_d" => Some(ks().distance),
        "ks_p_exact" => Some(ks().p_exact),
        "ks_p_kolmogorov" => Some(ks().p_kolmogorov),
        "ks_p_kstest2" => Some(kstest2_p(one.len(), other.len(), ks().distance)),
        "anderson_darling_midrank" => Some(ad().midrank),
        "anderson_darling_right" => Some(ad().right),
        "cramer_von_mises" => Some(CramerVonMises::from_samples(one, other).statistic),
        "mann_whitney_u" => Some(MannWhitney::from_samples(one, other).statistic),
        "mann_whitney_p" => Some(MannWhitney::from_samples(one, other).p),
        "median_measured" => finite(one.median()),
        "median_computed" => finite(other.median()),
        "e50" => finite((other.median() / one.median() - 1.0).abs()),
        "median_ratio" => finite(other.median() / one.median()),
        "energy_distance" => energy_distance(one, other),
        "wasserstein" => wasserstein_distance(one, other),
        "pairs_finite" => Some(pairs()?.finite as f64),
        "log_bias" => pairs()?.log_bias,
        "log_dispersion" => pairs()?.log_dispersion,
        "pearson" => pairs()?.pearson,
        "spearman" => pairs()?.spearman,
        "within_factor_1_5" => Some(pairs()?.within_1_5),
        "within_factor_2" => Some(pairs()?.within_2),
        "collapses_both" => Some(pairs()?.collapses.both as f64),
        "collapses_measured_only" => Some(pairs()?.collapses.measured_only as f64),
        "collapses_computed_only" => Some(pairs()?.collapses.computed_only as f64),
        _ => return Ok(Err(Unknown)),
    }))
}

/// Values with `"inf"` for a collapse.
fn values(case: &Map<String, Value>, name: &str) -> Result<Vec<f64>, String> {
    let list = case.get(name).and_then(Value::as_array).ok_or_else(|| format!("no {name}"))?;
    list.iter()
        .map(|value| match value.as_str() {
            Some("inf" | "overturned") => Ok(f64::INFINITY),
            _ => value.as_f64().ok_or_else(|| format!("{name} has {value}, which is no number")),
        })
        .collect()
}

/// The band of the measured distribution at a place.
fn band(measured: &Sample, expected: &Value, comparison: &mut Comparison) {
    let null = Value::Null;
    let of = |name: &str| expected.get(name).unwrap_or(&null);
    let Some(at) = of("at").as_f64() else { return };
    comparison.compare("cdf", Some(measured.cdf(at)), of("cdf"));
    let found = greenwood_band(measured, at);
    for (index, ours) in found.into_iter().enumerate() {
        let expected = of("greenwood").get(index).unwrap_or(&null);
        comparison.within("greenwood", Some(ours), expected, NOTHING, comparison.tolerance);
    }
    comparison.compare("dkw_half_width", Some(dkw_half_width(measured.len())), of("dkw_half_width"));
}

fn median_ratio(
    measured: &[f64],
    computed: &[f64],
    [one, other]: &[Sample; 2],
    expected: &Value,
) -> Result<Option<Quantiles>, String> {
    let resampling = Resampling::default();
    if expected.get("paired").and_then(Value::as_bool).unwrap_or(false) {
        let found = bands(measured, computed, resampling).map_err(|error| error.to_string())?;
        return Ok(found.median_ratio);
    }
    median_ratio_band(one, other, resampling).map_err(|error| error.to_string())
}

/// Quantiles of a bootstrap: other random numbers than those that were expected of.
fn bootstrap(found: Option<Quantiles>, expected: &Value, comparison: &mut Comparison) {
    let tolerance = expected.get("abs_tol").and_then(Value::as_f64).unwrap_or(0.02);
    let ours = found.map(|found| [found.q05, found.q50, found.q95]);
    for index in 0..3 {
        let expected = expected.get("values").and_then(|values| values.get(index)).unwrap_or(&Value::Null);
        comparison.within("median ratio by bootstrap", ours.map(|ours| ours[index]), expected, tolerance, 0.0);
    }
}
