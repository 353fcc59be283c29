//! The mean of several hazard curves.

use crate::{HazardCurve, HazardError};

impl HazardCurve {
    /// The weighted mean of curves of one measure in one unit: `λ(im) = Σ w λ_b(im)/Σ w`.
    ///
    /// It is exact at every abscissa of every curve and at every level of `also_at` that lies within all of them;
    /// between, it is read as any curve. It reaches as far as all curves do. It keeps the definition of the component
    /// where all curves have the same.
    ///
    /// - `branches`: weight and curve.
    /// - `also_at`: further levels, in the unit of the curves, stripe levels for instance.
    ///
    /// # Errors
    /// No curve, or curves that share fewer than two levels.
    pub fn weighted_mean(branches: &[(f64, &Self)], also_at: &[f64]) -> Result<Self, HazardError> {
        let Some((_, first)) = branches.first() else {
            return Self::new("", "", "", Vec::new(), Vec::new());
        };
        debug_assert!(branches.iter().all(|(_, curve)| curve.unit() == first.unit()), "curves of one unit");
        let from = branches.iter().fold(0.0_f64, |from, (_, curve)| from.max(curve.first().im));
        let to = branches.iter().fold(f64::INFINITY, |to, (_, curve)| to.min(curve.last().im));
        let mut im: Vec<f64> = branches
            .iter()
            .flat_map(|(_, curve)| curve.im().iter().copied())
            .chain(also_at.iter().copied())
            .filter(|&im| im >= from && im <= to)
            .collect();
        im.sort_by(f64::total_cmp);
        im.dedup();
        let total: f64 = branches.iter().map(|(weight, _)| weight).sum();
        let maf = im
            .iter()
            .map(|&im| {
                let rates = branches.iter().map(|(weight, curve)| Ok(weight * curve.rate_at(im)?));
                Ok(rates.sum::<Result<f64, HazardError>>()? / total)
            })
            .collect::<Result<Vec<f64>, HazardError>>()?;
        let source = format!("weighted mean of {} curves", branches.len());
        let component = first.component().filter(|_| branches.iter().all(|(_, c)| c.component() == first.component()));
        Ok(Self::new(first.measure(), first.unit(), source, im, maf)?.with_component(component))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn power_law(k0: f64, k: f64, im: &[f64]) -> HazardCurve {
        let maf = im.iter().map(|im| k0 * im.powf(-k)).collect();
        HazardCurve::new("PGV", "cm/s", "", im.to_vec(), maf).unwrap()
    }

    #[test]
    fn the_mean_is_that_of_the_rates() {
        let a = power_law(0.2, 1.0, &[1.0, 10.0, 100.0]);
        let b = power_law(0.4, 2.0, &[0.5, 8.0, 50.0]);
        let mean = HazardCurve::weighted_mean(&[(0.25, &a), (0.75, &b)], &[3.0, 0.1, 400.0]).unwrap();
        assert_eq!(mean.im(), [1.0, 3.0, 8.0, 10.0, 50.0]);
        for (&im, &maf) in mean.im().iter().zip(mean.maf()) {
            let expected = 0.25 * 0.2 / im + 0.75 * 0.4 / (im * im);
            assert!((maf - expected).abs() < 1e-14 * expected, "{im}: {maf} {expected}");
        }
        // definitions of the component that differ leave none
        let with = |curve: &HazardCurve, name: &str| curve.clone().with_component(Some(name.parse().unwrap()));
        let (a50, b50, b100) = (with(&a, "RotD50"), with(&b, "RotD50"), with(&b, "RotD100"));
        let component = |x, y| HazardCurve::weighted_mean(&[(0.5, x), (0.5, y)], &[]).unwrap().component();
        assert_eq!([component(&a50, &b50), component(&a50, &b100), component(&a, &b50)], [a50.component(), None, None]);
        // a curve is its own mean
        let same = HazardCurve::weighted_mean(&[(0.5, &a), (0.5, &a)], &[]).unwrap();
        assert_eq!(same.im(), a.im());
        assert!(same.maf().iter().zip(a.maf()).all(|(a, b)| (a - b).abs() < 1e-15 * b));
    }

    #[test]
    fn curves_that_do_not_meet_have_no_mean() {
        let (a, b) = (power_law(0.2, 1.0, &[1.0, 2.0]), power_law(0.2, 1.0, &[3.0, 4.0]));
        assert!(HazardCurve::weighted_mean(&[(0.5, &a), (0.5, &b)], &[]).is_err());
        assert!(HazardCurve::weighted_mean(&[], &[]).is_err());
    }
}
