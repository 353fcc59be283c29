//! Weighted hazard curves of which some are far from the others: in another unit, or of another site.

use uplift_hazard::HazardCurve;
use uplift_inputs::{file_of, unit_of_branch};
use uplift_job::alarm::{Case, Severity};
use uplift_job::text::rounded;
use uplift_study::UniformRiskStudy;

use super::curves_at_site::CurvesAtSite;

/// Alternatives differ by 2 or 3 times, more at low rates alone; told is a gap between them that is as wide throughout.
const BEYOND_ALTERNATIVES: f64 = 5.0;
/// Rates at which curves are held against each other: `10^(-k/2)` a year for these k.
const HALF_DECADES: std::ops::RangeInclusive<i32> = 0..=10;
/// At how many of them at least …
const FEWEST_RATES: usize = 3;
/// … and at one at least as frequent as that of this k: rare shaking alone has alternatives that are far apart.
const FREQUENT: i32 = 6;

/// What is raised of the weighted curves of a site.
pub(super) fn case(study: &UniformRiskStudy, curves: &CurvesAtSite<'_>) -> Option<Case> {
    if curves.branches.is_empty() {
        return None;
    }
    let files = file_of(study, curves.site, curves.measure)?;
    let mut all: Vec<&HazardCurve> = curves.branches.iter().map(|(_, curve)| *curve).collect();
    // the mean of the weighted curves is no other one, and what a file calls their mean may be
    if files.file.is_some() {
        all.push(curves.curve);
    }
    let apart = Apart::from_curves(&all)?;
    let name = |curve: usize| {
        let branch = files.branches.get(curve);
        let path = branch.map(|branch| &branch.file).or(files.file.as_ref()).and_then(|path| path.file_name());
        let path = path.unwrap_or_default().to_string_lossy();
        match branch {
            Some(branch) => format!("the weighted curve \"{}\" ({path})", branch.name),
            None => format!("the curve of the spectra ({path})"),
        }
    };
    let more = match &apart.odd[1..] {
        [] => String::new(),
        more => format!(" (and {} more of {})", more.len(), all.len()),
    };
    let others = match &apart.others[..] {
        [one] => name(*one),
        others => format!("the {} others", others.len()),
    };
    let direction = if apart.odd_above { "above" } else { "below" };
    let [frequent, rare] = apart.rates_per_year.map(|rate| rounded(rate, 1));
    Some(Case {
        severity: Severity::Mistake,
        badness: apart.times,
        subject: curves.subject(),
        what: format!(
            "the levels of {}{more} are at least {:.1} times {direction} those of {others}, at every rate from \
             {frequent} to {rare} a year",
            name(apart.odd[0]),
            apart.times
        ),
        what_to_do: unit_of_branch(study, (curves.site, curves.measure), apart.too_large())
            .unwrap_or_else(|| "Check the files: unit, annual rates, site and measure".to_owned()),
    })
}

/// Two groups of curves with a wide gap between their levels at every rate that both have.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Apart {
    /// The smaller group; of two alike the lower one.
    odd: Vec<usize>,
    others: Vec<usize>,
    odd_above: bool,
    /// How many times the groups are apart where they are the nearest.
    times: f64,
    /// The most frequent and the rarest rate at which they were held against each other, 1/yr.
    rates_per_year: [f64; 2],
}

impl Apart {
    /// How many times too large the levels of the odd ones are for those of the others.
    pub(crate) fn too_large(&self) -> f64 {
        if self.odd_above { self.times } else { 1.0 / self.times }
    }

    /// The groups of `curves`; none where all are near at one rate at least, or have too few in common.
    fn from_curves(curves: &[&HazardCurve]) -> Option<Self> {
        // by rate, the levels of the curves that have it as logarithms, the lowest first
        let rows: Vec<(i32, Vec<(usize, f64)>)> = HALF_DECADES
            .map(|k| {
                let level = |curve: &HazardCurve| curve.im_at_rate(rate_per_year(k)).ok().map(f64::ln);
                let levels = curves.iter().enumerate().filter_map(|(curve, of)| Some((curve, level(of)?)));
                let mut levels: Vec<(usize, f64)> = levels.collect();
                levels.sort_by(|a, b| a.1.total_cmp(&b.1));
                (k, levels)
            })
            .collect();
        // where most of them are, the widest gap says who belongs to whom
        let fullest = rows.iter().rev().max_by_key(|(_, levels)| levels.len()).map(|(_, levels)| levels)?;
        let gap = |end: usize| fullest[end].1 - fullest[end - 1].1;
        let end = (1..fullest.len()).max_by(|a, b| gap(*a).total_cmp(&gap(*b)))?;
        let [lower, upper] = [&fullest[..end], &fullest[end..]].map(|group| group.iter().map(|(curve, _)| *curve));
        let (lower, upper): (Vec<usize>, Vec<usize>) = (lower.collect(), upper.collect());

        let gaps: Vec<(i32, f64)> = (rows.iter())
            .filter_map(|(k, levels)| {
                let highest = levels.iter().rev().find(|(curve, _)| lower.contains(curve))?;
                let lowest = levels.iter().find(|(curve, _)| upper.contains(curve))?;
                Some((*k, lowest.1 - highest.1))
            })
            .collect();
        let (first, last) = (gaps.first()?.0, gaps.last()?.0);
        let least = gaps.iter().map(|(_, gap)| *gap).min_by(f64::total_cmp)?;
        if gaps.len() < FEWEST_RATES || first > FREQUENT || least <= BEYOND_ALTERNATIVES.ln() {
            return None;
        }
        let odd_above = upper.len() < lower.len();
        let (odd, others) = if odd_above { (upper, lower) } else { (lower, upper) };
        Some(Self { odd, others, odd_above, times: least.exp(), rates_per_year: [first, last].map(rate_per_year) })
    }
}

fn rate_per_year(half_decades: i32) -> f64 {
    10_f64.powf(-f64::from(half_decades) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A curve of slope -2 by whose levels that of 1e-4 a year is `level`.
    fn curve(level: f64) -> HazardCurve {
        let im: Vec<f64> = [0.01, 0.1, 1.0, 3.0].iter().map(|part| part * level).collect();
        let maf = im.iter().map(|im| 1e-4 * (level / im).powi(2)).collect();
        HazardCurve::new("PGV", "cm/s", "", im, maf).unwrap()
    }

    /// The odd ones, and how many times too large they are.
    fn found(levels: &[f64]) -> Option<(Vec<usize>, f64)> {
        let curves: Vec<HazardCurve> = levels.iter().map(|level| curve(*level)).collect();
        let apart = Apart::from_curves(&curves.iter().collect::<Vec<_>>())?;
        let too_large = apart.too_large();
        Some((apart.odd, (100.0 * too_large).round() / 100.0))
    }

    #[test]
    fn curves_in_another_unit_are_found() {
        assert_eq!(found(&[50.0, 0.5]), Some((vec![1], 0.01)));
        assert_eq!(found(&[50.0, 60.0, 0.5, 40.0]), Some((vec![2], 0.01)));
        // 400 beside 60, the highest of the others
        assert_eq!(found(&[50.0, 60.0, 480.0, 40.0]), Some((vec![2], 8.0)));
        assert_eq!(found(&[50.0, 0.4, 60.0, 0.5, 40.0]), Some((vec![1, 3], 0.01)));
    }

    #[test]
    fn alternatives_that_differ_are_not() {
        // models and fractiles 3 and 4 times apart, however many
        for levels in [&[20.0, 50.0, 80.0][..], &[20.0, 60.0, 180.0], &[15.0, 60.0, 240.0], &[50.0], &[]] {
            assert_eq!(found(levels), None, "{levels:?}");
        }
        // curves that cross
        let steep = HazardCurve::new("PGV", "cm/s", "", vec![1.0, 10.0, 100.0], vec![1.0, 1e-3, 1e-6]).unwrap();
        let gentle = HazardCurve::new("PGV", "cm/s", "", vec![0.01, 10.0, 10_000.0], vec![1.0, 1e-3, 1e-6]).unwrap();
        assert_eq!(Apart::from_curves(&[&steep, &gentle]), None);
        // no rate in common, and rare ones alone
        let rare = HazardCurve::new("PGV", "cm/s", "", vec![500.0, 900.0], vec![1e-7, 1e-8]).unwrap();
        assert_eq!(Apart::from_curves(&[&steep, &rare]), None);
        let low = HazardCurve::new("PGV", "cm/s", "", vec![1.0, 10.0], vec![9e-4, 9e-6]).unwrap();
        let high = HazardCurve::new("PGV", "cm/s", "", vec![20.0, 200.0], vec![9e-4, 9e-6]).unwrap();
        assert_eq!(Apart::from_curves(&[&low, &high]), None);
    }
}
