//! Weighted hazard curves of which one is far from the others: in another unit, or of another site.

use uplift_hazard::HazardCurve;
use uplift_study::UniformRiskStudy;

use super::hazard::CurvesAtSite;
use super::{Case, Severity};
use crate::inputs::unit_of_branch;

/// Alternatives differ by 2 or 3 times, more at low rates; told is only what is as far at every rate.
const BEYOND_ALTERNATIVES: f64 = 5.0;
/// Rates at which curves are held against each other: `10^(-k/2)` a year for these k.
const HALF_DECADES: std::ops::RangeInclusive<i32> = 0..=10;

/// What is raised of the weighted curves of a site.
pub(super) fn case(study: &UniformRiskStudy, curves: &CurvesAtSite<'_>) -> Option<Case> {
    let (odd, times) = farthest(&curves.branches)?;
    let (name, _) = curves.branches[odd];
    let others = match curves.branches.len() {
        2 => format!("those of \"{}\"", curves.branches[1 - odd].0),
        count => format!("the median of the {} others", count - 1),
    };
    let (most, direction) = if times > 1.0 { (times, "above") } else { (1.0 / times, "below") };
    Some(Case {
        severity: Severity::Mistake,
        badness: most,
        subject: curves.subject(),
        what: format!(
            "at every rate the levels of the weighted curve \"{name}\" are at least {most:.1} times {direction} \
             {others}"
        ),
        what_to_do: unit_of_branch(study, (curves.site, curves.measure), times).unwrap_or_else(|| {
            "see its file: its unit, whether it gives rates per year, of this site and this measure".to_owned()
        }),
    })
}

/// The curve that is the farthest from the others, and how many times too large its levels are for theirs where these
/// are the nearest; none where all are near.
fn farthest(branches: &[(&str, &HazardCurve)]) -> Option<(usize, f64)> {
    // by rate, the levels of the curves that have it, as logarithms
    let levels: Vec<Vec<Option<f64>>> = HALF_DECADES
        .map(|k| {
            let rate = 10_f64.powf(-f64::from(k) / 2.0);
            branches.iter().map(|(_, curve)| curve.im_at_rate(rate).ok().map(f64::ln)).collect()
        })
        .collect();
    let sorted: Vec<Vec<f64>> = levels
        .iter()
        .map(|row| {
            let mut row: Vec<f64> = row.iter().copied().flatten().collect();
            row.sort_by(f64::total_cmp);
            row
        })
        .collect();
    let distance = |branch: usize| {
        let distances = levels.iter().zip(&sorted).filter_map(|(row, sorted)| {
            let level = row[branch]?;
            Some(level - median_without(sorted, level)?)
        });
        let nearest = distances.clone().min_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        // above at one rate and below at another is near
        distances.clone().all(|distance| distance.signum() == nearest.signum()).then_some(nearest)
    };
    let (odd, distance) = (0..branches.len())
        .filter_map(|branch| Some((branch, distance(branch)?)))
        .reduce(|most, next| if next.1.abs() > most.1.abs() { next } else { most })?;
    (distance.abs() > BEYOND_ALTERNATIVES.ln()).then(|| (odd, distance.exp()))
}

/// The median of `sorted` without one `value` of it; none where nothing is left.
fn median_without(sorted: &[f64], value: f64) -> Option<f64> {
    let own = sorted.partition_point(|other| *other < value);
    let other = |position: usize| sorted[if position < own { position } else { position + 1 }];
    let count = sorted.len().checked_sub(1).filter(|count| *count > 0)?;
    Some(f64::midpoint(other((count - 1) / 2), other(count / 2)))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// A curve of slope -2 by whose levels those of 1e-4 a year are `level`.
    fn curve(level: f64) -> HazardCurve {
        let im: Vec<f64> = [0.01, 0.1, 1.0, 3.0].iter().map(|part| part * level).collect();
        let maf = im.iter().map(|im| 1e-4 * (level / im).powi(2)).collect();
        HazardCurve::new("PGV", "cm/s", "", im, maf).unwrap()
    }

    fn found(levels: &[f64]) -> Option<(usize, f64)> {
        let curves: Vec<HazardCurve> = levels.iter().map(|level| curve(*level)).collect();
        let branches: Vec<(&str, &HazardCurve)> = curves.iter().map(|curve| ("", curve)).collect();
        farthest(&branches).map(|(branch, times)| (branch, (100.0 * times).round() / 100.0))
    }

    #[test]
    fn the_one_curve_in_another_unit_is_found() {
        assert_eq!(found(&[50.0, 0.5]), Some((0, 100.0)));
        assert_eq!(found(&[50.0, 60.0, 0.5, 40.0]), Some((2, 0.01)));
        assert_eq!(found(&[50.0, 60.0, 500.0, 40.0]), Some((2, 10.0)));
        // alternatives
        assert_eq!(found(&[20.0, 50.0, 80.0]), None);
        assert_eq!(found(&[]), None);
        assert_eq!(found(&[50.0]), None);
    }

    #[test]
    fn curves_that_cross_or_meet_are_alternatives() {
        let steep = HazardCurve::new("PGV", "cm/s", "", vec![1.0, 10.0, 100.0], vec![1.0, 1e-3, 1e-6]).unwrap();
        let gentle = HazardCurve::new("PGV", "cm/s", "", vec![0.01, 10.0, 10_000.0], vec![1.0, 1e-3, 1e-6]).unwrap();
        assert_eq!(farthest(&[("a", &steep), ("b", &gentle)]), None);
        // no rate in common
        let rare = HazardCurve::new("PGV", "cm/s", "", vec![500.0, 900.0], vec![1e-7, 1e-8]).unwrap();
        assert_eq!(farthest(&[("a", &steep), ("b", &rare)]), None);
    }

    #[test]
    fn a_median_leaves_one_value_out() {
        assert_eq!(median_without(&[1.0, 2.0, 5.0], 5.0), Some(1.5));
        assert_eq!(median_without(&[1.0, 2.0, 5.0], 1.0), Some(3.5));
        assert_eq!(median_without(&[1.0, 2.0, 2.0, 5.0], 2.0), Some(2.0));
        assert_eq!(median_without(&[1.0], 1.0), None);
        assert_eq!(median_without(&[], 1.0), None);
    }
}
