//! What a mean over records says of the mean over all records there could be, where the records scatter unevenly.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use statrs::distribution::{ContinuousCDF, StudentsT};

/// A scatter below this share of the mean is that of rounding.
const ROUNDING: f64 = 1e-7;

/// A mean over units (records, or earthquakes with all their records), with how the units scatter about it.
///
/// The rate λ(c) at which a displacement is exceeded is such a mean, and a few records carry it: Student's interval,
/// which takes the mean for normal, misses the truth on the side of those that were not drawn. Four things mend that:
///
/// - the deviate T = (mean − value)/s is freed of the skewness γ of the units by a cubic that rises everywhere,
///   g(T) = T + γT²/(3√n) + γ²T³/(27n) + γ/(6√n) (Hall);
/// - γ is the adjusted Fisher–Pearson coefficient, since a sample shows too little of it;
/// - above the mean the quantile is Student's with as many degrees of freedom as the variance is known with,
///   2n/(κ − 1) − 1 for units of the kurtosis κ, rounded down, from 1 to n − 1: n − 1 where they are normal
///   (Satterthwaite's matching of moments); below it the quantile has n − 1, since a sample that holds the few large
///   units shows their scatter too;
/// - a sample shows too little of κ as well, and never more than n: κ is adjusted for n, and at least 3 + 3γ²/2, that
///   of a gamma distribution as skewed; three units show none, and leave one degree of freedom.
///
/// Units that do not count alike tell less than their number: κ is adjusted for the number of units that count alike
/// and whose variance is known as well, and there is one degree of freedom less than these, if that is less (Carter,
/// Schnepel and Steigerwald's effective clusters).
///
/// # Source
/// P. Hall, J. R. Stat. Soc. B 54 (1992), 221–228; F. E. Satterthwaite, Biometrics Bulletin 2 (1946), 110–114; A. V.
/// Carter, K. T. Schnepel, D. G. Steigerwald, Rev. Econ. Stat. 99 (2017), 698–709.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SkewedMean {
    /// The mean.
    pub mean: f64,
    /// Standard deviation of a unit about it.
    pub deviation: f64,
    /// Skewness of the units, adjusted for their number.
    pub skewness: f64,
    /// Kurtosis of the units; 3 where they are normal.
    pub kurtosis: f64,
    /// How many units.
    pub units: usize,
    /// To how many units that count alike they amount, at most `units`.
    pub effective_units: f64,
}

impl SkewedMean {
    /// From the second, third and fourth power of the deviations of `units` from their `mean`, averaged.
    pub fn new(mean: f64, moments: [f64; 3], units: usize) -> Self {
        Self::with_adjustment(mean, moments, (units, adjustment(units)))
    }

    /// The same with the [`adjustment`] of the skewness worked out before.
    pub(crate) fn with_adjustment(
        mean: f64,
        [second, third, fourth]: [f64; 3],
        (units, adjustment): (usize, f64),
    ) -> Self {
        let n = units as f64;
        let is_scattered = units > 1 && second > (ROUNDING * mean).powi(2);
        if !is_scattered {
            return Self { mean, deviation: 0.0, skewness: 0.0, kurtosis: 3.0, units, effective_units: n };
        }
        Self {
            mean,
            deviation: (second * n / (n - 1.0)).sqrt(),
            skewness: adjustment * third / (second * second.sqrt()),
            kurtosis: fourth / (second * second),
            units,
            effective_units: n,
        }
    }

    /// The same of units of which each carries an a, from Σ a² and Σ a⁴: they amount to (Σ a²)²/Σ a⁴ that carry alike.
    #[must_use]
    pub fn carried_by(self, [second, fourth]: [f64; 2]) -> Self {
        let effective = second * second / fourth;
        // nothing is carried where nothing is exceeded
        Self { effective_units: if effective.is_nan() { self.effective_units } else { effective }, ..self }
    }

    /// How far the mean of `units` such units lies above `value`, as the deviate of a normal variable; infinite where
    /// they do not scatter.
    pub fn deviate(&self, value: f64, units: usize) -> f64 {
        self.deviate_by_root(value, (units as f64).sqrt())
    }

    /// The same of the root of the number of units.
    fn deviate_by_root(&self, value: f64, root: f64) -> f64 {
        /// A division takes as long as all else.
        const THIRD: f64 = 1.0 / 3.0;
        let difference = self.mean - value;
        if self.deviation == 0.0 {
            return if difference == 0.0 { 0.0 } else { f64::INFINITY.copysign(difference) };
        }
        let (t, a) = (difference * (root / self.deviation), self.skewness / root);
        let third = THIRD * a * t;
        t * (1.0 + third * (1.0 + THIRD * third)) + 0.5 * THIRD * a
    }

    /// Degrees of freedom of the quantiles of `units` such units, for values below and above the mean.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 1 and the number of units")]
    pub fn degrees_of_freedom(&self, units: usize) -> [usize; 2] {
        let n = self.effective_units;
        // three units show none, whatever rounding leaves
        let adjusted = if n > 3.0 + ROUNDING { adjusted_excess(n, self.kurtosis) } else { f64::INFINITY };
        let excess = adjusted.max(1.5 * self.skewness * self.skewness);
        let above = 2.0 * units as f64 / (excess + 2.0) - 1.0;
        // 12 units that count alike are 12
        let most = n / self.units as f64 * units as f64 + ROUNDING - 1.0;
        [units.saturating_sub(1).max(1), above.min(most).max(1.0) as usize]
    }

    /// The quantiles with those degrees of freedom.
    pub(crate) fn quantiles(&self, of_freedom: &StudentQuantiles, units: usize) -> [f64; 2] {
        self.degrees_of_freedom(units).map(|freedom| of_freedom.at(freedom))
    }

    /// Where `value` lies in what the mean of a sample leaves open: within −1 and 1 where it may be the mean of all
    /// there could be, above 1 where the mean is too large for it.
    pub(crate) fn place(&self, value: f64, sample: &SampleQuantiles) -> f64 {
        let deviate = self.deviate_by_root(value, sample.root);
        if deviate.abs() <= sample.least {
            return deviate / sample.least;
        }
        deviate / (by_side(self.quantiles(&sample.of_freedom, sample.units), deviate) * sample.wider)
    }

    /// The interval of the mean over all units there could be, at the level of `quantiles`; NaN of a single unit. The
    /// quantity is not negative, and nor is the interval.
    pub fn interval(&self, quantiles: &StudentQuantiles) -> [f64; 2] {
        if self.units < 2 {
            return [f64::NAN; 2];
        }
        if self.deviation == 0.0 {
            return [self.mean; 2];
        }
        let root = (self.units as f64).sqrt();
        let a = self.skewness / root;
        let [below, above] = self.quantiles(quantiles, self.units);
        [below, -above].map(|deviate| {
            // g(T) = ((1 + aT/3)³ − 1)/a + a/6, solved for T
            let t = if a.abs() < 1e-9 { deviate } else { 3.0 / a * ((1.0 + a * (deviate - a / 6.0)).cbrt() - 1.0) };
            (self.mean - t * self.deviation / root).max(0.0)
        })
    }
}

/// The kurtosis of `n` units above that of a normal variable, adjusted for their number.
fn adjusted_excess(n: f64, kurtosis: f64) -> f64 {
    (n - 1.0) * ((n + 1.0) * (kurtosis - 3.0) + 6.0) / ((n - 2.0) * (n - 3.0))
}

/// What holds for a value below the mean, where its deviate is positive, or else above it.
pub(crate) fn by_side<T>([below, above]: [T; 2], deviate: f64) -> T {
    if deviate < 0.0 { above } else { below }
}

/// What the skewness of a sample is too small by.
pub(crate) fn adjustment(units: usize) -> f64 {
    let n = units as f64;
    if units > 2 { (n * (n - 1.0)).sqrt() / (n - 2.0) } else { 0.0 }
}

/// Two-sided quantiles of Student's distribution, by whole degrees of freedom.
#[derive(Debug, Clone, PartialEq)]
pub struct StudentQuantiles(Arc<[f64]>);

/// Those worked out before, by the bits of the confidence and the most degrees of freedom: to work them out takes as
/// long as a band.
static KNOWN: Mutex<BTreeMap<(u64, usize), StudentQuantiles>> = Mutex::new(BTreeMap::new());

impl StudentQuantiles {
    /// Those that leave `1 − confidence` outside, half of it on each side, up to `most` degrees of freedom.
    pub fn new(confidence: f64, most: usize) -> Self {
        let of = |freedom: usize| {
            StudentsT::new(0.0, 1.0, freedom as f64)
                .map_or(f64::INFINITY, |student| student.inverse_cdf(0.5 * (1.0 + confidence)))
        };
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        known.entry((confidence.to_bits(), most)).or_insert_with(|| Self((1..=most.max(1)).map(of).collect())).clone()
    }

    /// At so many degrees of freedom, or at the most there are.
    pub fn at(&self, freedom: usize) -> f64 {
        self.0[freedom.clamp(1, self.0.len()) - 1]
    }
}

/// The quantiles by which the mean of a sample is judged.
#[derive(Debug, Clone)]
pub(crate) struct SampleQuantiles {
    units: usize,
    /// √units.
    root: f64,
    of_freedom: StudentQuantiles,
    /// By what they are wider than those of the truth.
    wider: f64,
    /// The least of them: with fewer degrees of freedom a quantile is larger.
    least: f64,
}

impl SampleQuantiles {
    /// Of so many `units`, and so much `wider`.
    pub(crate) fn new(units: usize, wider: f64, of_freedom: &StudentQuantiles) -> Self {
        let least = of_freedom.at(units.saturating_sub(1)) * wider;
        Self { units, root: (units as f64).sqrt(), of_freedom: of_freedom.clone(), wider, least }
    }
}

/// Sums over all places of the `terms` of the `values` there, several side by side for the processor to do at once.
#[inline(always)]
pub(crate) fn sums<const M: usize, const N: usize>(
    values: [&[f64]; M],
    terms: impl Fn([f64; M]) -> [f64; N],
) -> [f64; N] {
    const LANES: usize = 4;
    let mut lanes = [[0.0; LANES]; N];
    let parts = values.map(<[f64]>::as_chunks::<LANES>);
    let mut add = |lane: usize, value: [f64; M]| {
        for (lanes, term) in lanes.iter_mut().zip(terms(value)) {
            lanes[lane] += term;
        }
    };
    for place in 0..parts[0].0.len() {
        // values of a whole chunk first: the compiler makes no vectors otherwise
        let chunk = parts.map(|(chunks, _)| chunks[place]);
        for lane in 0..LANES {
            add(lane, chunk.map(|chunk| chunk[lane]));
        }
    }
    for lane in 0..parts[0].1.len() {
        add(lane, parts.map(|(_, rest)| rest[lane]));
    }
    lanes.map(|lanes| lanes.iter().sum())
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) fn mean_of(values: &[f64]) -> SkewedMean {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let moment = |power: i32| values.iter().map(|value| (value - mean).powi(power)).sum::<f64>() / n;
        SkewedMean::new(mean, [2, 3, 4].map(moment), values.len())
    }

    #[test]
    fn without_skewness_it_is_students_interval() {
        // mean 3, s² = 2.5, no skewness: κ = 3 at least, 2 · 5/2 − 1 = 4 degrees of freedom; t = 2.131847
        let found = mean_of(&[1.0, 2.0, 3.0, 4.0, 5.0]);
        let half = 2.131_847 * (2.5_f64 / 5.0).sqrt();
        let [low, high] = found.interval(&StudentQuantiles::new(0.9, 4));
        assert!((low - (3.0 - half)).abs() < 1e-6 && (high - (3.0 + half)).abs() < 1e-6, "{low} {high}");
        assert_eq!(found.degrees_of_freedom(5), [4, 4]);
    }

    // 0, 0, 0, 4: mean 1, m2 = 3, m3 = 6, m4 = 21; s = 2, γ = 6/3^1.5 · √12/2 = 2, κ = 3 + 3 · 4/2 = 9, more than the
    // adjusted 3 + 3/2 · (5 (21/9 − 3) + 6) = 7. Of the value 2: T = −1, a = γ/√4 = 1, g = −1 + 1/3 − 1/27 + 1/6.
    #[test]
    fn a_skewed_mean_by_hand() {
        let found = mean_of(&[0.0, 0.0, 0.0, 4.0]);
        assert!((found.skewness - 2.0).abs() < 1e-12 && (found.deviation - 2.0).abs() < 1e-12, "{found:?}");
        assert!((found.deviate(2.0, 4) - (-1.0 + 1.0 / 3.0 - 1.0 / 27.0 + 1.0 / 6.0)).abs() < 1e-12);
        // 2 · 4/8 − 1 = 0, 2 · 25/8 − 1 = 5.25
        assert_eq!((found.degrees_of_freedom(4), found.degrees_of_freedom(25)), ([3, 1], [24, 5]));
        // κ = 5/2 is adjusted to 3 + 9/56 · (11 (5/2 − 3) + 6) = 3 + 9/112, and of that 2 · 10/2.08 − 1 = 8.61
        let even = mean_of(&[-1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0]);
        assert_eq!(even.degrees_of_freedom(10), [9, 8]);
        // for five effective units it is 3 + 4/6 · (6 (5/2 − 3) + 6) = 5, and 2 · 10/4 − 1 = 4; three show none
        let carried = |effective_units: f64| SkewedMean { effective_units, ..even }.degrees_of_freedom(10);
        assert_eq!([carried(5.0), carried(3.0)], [[9, 4], [9, 1]]);
    }

    // 6, 2, 1, 1: (36 + 4 + 2)²/(1296 + 16 + 2) = 1764/1314 = 1.34; 2, 2, 2, 1: 169/49 = 3.45, two degrees of freedom,
    // in a sample of eight 6.90, five
    #[test]
    fn units_that_carry_more_leave_fewer_degrees_of_freedom() {
        let alike = mean_of(&[1.0, 2.0, 3.0, 4.0]);
        let carried_by =
            |each: [f64; 4]| alike.carried_by([2, 4].map(|power| each.iter().map(|own| own.powi(power)).sum()));
        assert_eq!(carried_by([0.3; 4]).degrees_of_freedom(4), [3, 3]);
        let one = carried_by([6.0, 2.0, 1.0, 1.0]);
        assert!((one.effective_units - 1764.0 / 1314.0).abs() < 1e-12);
        let three = carried_by([2.0, 2.0, 2.0, 1.0]);
        let found = [one.degrees_of_freedom(4), three.degrees_of_freedom(4), three.degrees_of_freedom(8)];
        assert_eq!(found, [[3, 1], [3, 2], [7, 5]]);
        assert_eq!(carried_by([0.0; 4]), alike);
    }

    #[test]
    fn the_interval_is_where_the_deviate_is_within_the_quantiles() {
        let found = mean_of(&[0.1, 0.2, 0.25, 0.4, 2.0, 0.3]);
        let quantiles = StudentQuantiles::new(0.9, 5);
        let [low, high] = found.interval(&quantiles);
        let sample = SampleQuantiles::new(6, 1.0, &quantiles);
        assert!((found.place(high, &sample) + 1.0).abs() < 1e-9, "{}", found.place(high, &sample));
        // the lower limit is not negative, and lies further from the mean than Student's would not
        assert!(low >= 0.0 && found.place(low, &sample) <= 1.0 + 1e-9);
        assert!(high - found.mean > found.mean - low, "{low} {high}");
    }

    #[test]
    fn units_that_are_alike_or_alone() {
        let quantiles = StudentQuantiles::new(0.9, 9);
        assert_eq!(mean_of(&[0.3; 4]).interval(&quantiles).map(|limit| (limit - 0.3).abs() < 1e-12), [true; 2]);
        assert!(mean_of(&[0.3]).interval(&quantiles)[0].is_nan());
        assert_eq!(mean_of(&[0.0; 4]).deviate(0.1, 4), f64::NEG_INFINITY);
    }
}
