//! The exponents for which a set, scaled to x, has the site's hazard of y.
//!
//! A weighting of (record, level) has two margins, the hazard of x and that of y. Among all that have both, the one
//! closest to "every record alike" in the sense of Kullback and Leibler is F(x) G(y) on the lines of the records
//! (iterative proportional fitting; Deming and Stephan 1940). F is the normalisation at each stripe; ln G is
//! [`Knots`]' smooth g: `p_ij = m_j exp(g(ln y_ij)) / Σ_k m_k exp(g(ln y_ik))`.
//!
//! What does not depend on exponents or multiplicities is worked out once: the basis of g at each run, and how many
//! records, by falling q, exceed each compared level at each stripe. At any stripe y falls in the order of q, so that
//! the runs above a level are the first ones. The order is the same at all stripes but where these have records of
//! their own, which count by `m_j` times their share there.

mod calibration;

use uplift_risk::RiskError;

use crate::exponent::{Exponents, KNOTS, Knots};
use crate::scratch::{Scratch, check};
use crate::{ConsistencyError, Miss, Nearest, NoRepair, Reach, ScaledAnalysis};

/// Rates at which the implied hazard is fitted to the site's.
pub const FIT_RATES: usize = 12;

/// Smoothness of the exponent over the level where none is chosen.
pub const DEFAULT_SMOOTHNESS: f64 = 0.05;

/// Second differences of the exponents.
const CURVATURES: usize = KNOTS - 2;

/// A fit has not reached the curve where a residual is larger than this.
pub(crate) const LARGEST_RESIDUAL: f64 = 0.1;

/// An exponent beyond this has run away.
const LARGEST_EXPONENT: f64 = 50.0;

/// A step that brings less of the sum of squares is the last one.
const LITTLE: f64 = 1e-12;

/// Most steps of a fit.
const MOST_STEPS: u32 = 60;

/// The problem of one analysis at one site; solved for the set, its resamples and with records left out.
#[derive(Debug, Clone)]
pub struct Solver<'a> {
    analysis: &'a ScaledAnalysis<'a>,
    smoothness: f64,
    /// Levels y of the knots, rising.
    knot_levels: [f64; KNOTS],
    /// `ρ_n`, falling, 1/yr.
    rates: [f64; FIT_RATES],
    /// `y_n`, the site's level at each, rising.
    site_levels: [f64; FIT_RATES],
    /// `w_i`, 1/yr, `[level]`.
    stripe_weights: Vec<f64>,
    /// Contributions to g, `[level, rank]`; a rank is a record's place by falling q among those of the level.
    basis: Vec<[f64; KNOTS]>,
    /// How many ranks have `y_ij > y_n`, `[level]`.
    above: Vec<[usize; FIT_RATES]>,
}

/// What a fit came to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// The best exponents b found, at the knots.
    pub exponents: Exponents,
    /// ln(implied rate of the site's level / ρ) at the fitted rates.
    pub residuals: [f64; FIT_RATES],
    /// Steps that brought the hazard nearer; the last one, which brought next to nothing, is not counted.
    pub iterations: u32,
}

impl Fit {
    /// The largest residual, without its sign.
    pub fn largest_residual(&self) -> f64 {
        self.residuals.iter().fold(0.0, |largest, residual| residual.abs().max(largest))
    }

    /// Whether an exponent is beyond 50.
    pub fn has_run_away(&self) -> bool {
        !self.exponents.iter().all(|exponent| exponent.abs() <= LARGEST_EXPONENT)
    }

    /// Whether the site's hazard is reached: every residual within 0.1, no exponent beyond 50.
    pub fn is_reached(&self) -> bool {
        self.largest_residual() <= LARGEST_RESIDUAL && !self.has_run_away()
    }
}

/// How much is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Care {
    /// Every level at every step.
    All,
    /// What the exponents depend on.
    Least,
}

/// Residuals with their derivatives by the exponents, and the sum of squares.
struct Residuals {
    values: [f64; FIT_RATES + CURVATURES],
    by_exponent: [[f64; KNOTS]; FIT_RATES + CURVATURES],
    squares: f64,
}

impl<'a> Solver<'a> {
    /// Sets the problem of an analysis up.
    ///
    /// - `smoothness`: weight of the second differences of the exponents in the sum of squares; 0.05 is usual.
    ///
    /// # Errors
    /// [`NoRepair::NarrowRange`] where the range of rates is too narrow; a smoothness that is negative or not finite.
    pub fn new(analysis: &'a ScaledAnalysis<'a>, smoothness: f64) -> Result<Self, ConsistencyError> {
        if !(smoothness.is_finite() && smoothness >= 0.0) {
            return Err(ConsistencyError::Smoothness { value: smoothness });
        }
        let range = analysis.range();
        if !range.is_wide() {
            return Err(ConsistencyError::NoRepair(NoRepair::NarrowRange(*range)));
        }
        let (mut knot_levels, mut site_levels) = ([0.0; KNOTS], [0.0; FIT_RATES]);
        for (level, rate) in knot_levels.iter_mut().zip(range.rates::<KNOTS>()) {
            *level = analysis.other().im_at_rate(rate)?;
        }
        let rates = range.rates();
        for (level, &rate) in site_levels.iter_mut().zip(&rates) {
            *level = analysis.other().im_at_rate(rate)?;
        }
        let knots = Knots::new(knot_levels);
        let (set, records) = (analysis.set(), analysis.set().len());
        let mut basis = Vec::with_capacity(analysis.levels().len() * records);
        let mut above = Vec::with_capacity(analysis.levels().len());
        for (stripe, &level) in analysis.levels().iter().enumerate() {
            let (ratios, order) = (set.ratios_at(stripe), set.order(stripe));
            let brought = |record: usize| set.brought(level, ratios[record]);
            basis.extend(order.iter().map(|&record| knots.basis(brought(record).ln())));
            basis.resize((stripe + 1) * records, [0.0; KNOTS]);
            above.push(site_levels.map(|site_level| order.partition_point(|&record| brought(record) > site_level)));
        }
        let stripe_weights = analysis.stripes().per_year();
        Ok(Self { analysis, smoothness, knot_levels, rates, site_levels, stripe_weights, basis, above })
    }

    /// The analysis.
    pub fn analysis(&self) -> &'a ScaledAnalysis<'a> {
        self.analysis
    }

    /// Levels y of the knots, rising, in the unit of the curve of y.
    pub fn knot_levels(&self) -> &[f64; KNOTS] {
        &self.knot_levels
    }

    /// The rates ρ of the fit, 1/yr, falling.
    pub fn rates_per_year(&self) -> &[f64; FIT_RATES] {
        &self.rates
    }

    /// How many of the rates no weights of the drawn records can give: to be asked before solving.
    ///
    /// - `multiplicities`: how often each record counts, `[record]`.
    ///
    /// # Errors
    /// Another number of multiplicities than of records; no record drawn.
    pub fn reach(&self, multiplicities: &[u32]) -> Result<Reach, ConsistencyError> {
        let bounds = self.bounds(multiplicities)?;
        let count = |is_out: &dyn Fn((f64, [f64; 2])) -> bool| {
            self.rates.iter().copied().zip(bounds).filter(|of| is_out(*of)).count()
        };
        Ok(Reach {
            set_above: count(&|(rate, [_, least])| least > rate),
            set_below: count(&|(rate, [most, _])| most < rate),
        })
    }

    /// The most and the least rate of the site's level at each rate of the fit that any weights give, 1/yr.
    fn bounds(&self, multiplicities: &[u32]) -> Result<[[f64; 2]; FIT_RATES], ConsistencyError> {
        check(self.analysis.set(), multiplicities)?;
        let set = self.analysis.set();
        // the largest and the smallest y that a record brings, [level]
        let mut extremes = Vec::with_capacity(self.analysis.levels().len());
        for (stripe, &level) in self.analysis.levels().iter().enumerate() {
            let ratios = set.ratios_at(stripe);
            let mut drawn = set.order(stripe).iter().filter(|&&record| multiplicities[record] > 0);
            let Some(&first) = drawn.next() else { return Err(RiskError::EmptyLevel { level: stripe }.into()) };
            let last = drawn.next_back().copied().unwrap_or(first);
            extremes.push([first, last].map(|record| set.brought(level, ratios[record])));
        }
        Ok(self.site_levels.map(|site_level| {
            [0, 1].map(|side| {
                let levels = extremes.iter().zip(&self.stripe_weights);
                levels.filter(|(brought, _)| brought[side] > site_level).map(|(_, weight)| weight).sum()
            })
        }))
    }

    /// The nearest to the site's hazard that any weights of the drawn records come at each level by itself.
    ///
    /// - `multiplicities`: how often each record counts, `[record]`.
    ///
    /// # Errors
    /// Another number of multiplicities than of records; no record drawn.
    pub fn nearest_reach(&self, multiplicities: &[u32]) -> Result<Nearest, ConsistencyError> {
        let bounds = self.bounds(multiplicities)?;
        Ok(self.nearest(std::array::from_fn(|n| {
            let ([most, least], rate) = (bounds[n], self.rates[n]);
            rate.clamp(least.min(most), most) / rate
        })))
    }

    /// What the weights of `fit` come to: of all tried, the nearest in the sum of squares of the logarithms.
    pub fn nearest_of(&self, fit: &Fit) -> Nearest {
        self.nearest(fit.residuals.map(f64::exp))
    }

    /// Where the site's levels are exceeded so many `times` as often.
    fn nearest(&self, times: [f64; FIT_RATES]) -> Nearest {
        Nearest::from_misses(&std::array::from_fn(|n| Miss {
            level: self.site_levels[n],
            rate_per_year: self.rates[n],
            times: times[n],
            scaled_to: self.analysis.scaled_level(self.rates[n]),
        }))
    }

    /// Fits the exponents: Levenberg and Marquardt's method with the exact derivatives.
    ///
    /// A fit that does not reach the curve, [`Fit::is_reached`], is returned with the best exponents found.
    ///
    /// - `multiplicities`: how often each record counts, `[record]`: 1 for the set itself, 0 for a record left out.
    /// - `start`: exponents to start from: 0, or those of the set for its resamples.
    ///
    /// # Errors
    /// Another number of multiplicities than of records; no record drawn.
    pub fn solve(
        &self,
        multiplicities: &[u32],
        start: &Exponents,
        scratch: &mut Scratch,
    ) -> Result<Fit, ConsistencyError> {
        self.descend(multiplicities, start, scratch, Care::All)
    }

    /// The same for one of many samples: the step that would bring next to nothing is the last one and is not looked
    /// at, and levels that tell nothing of the exponents are left out. What differs from [`solve`](Self::solve) is less
    /// than what that leaves open: 1e-12 of the sum of squares.
    ///
    /// The residuals of the last step are those of the derivatives.
    ///
    /// # Errors
    /// As [`solve`](Self::solve).
    pub fn solve_sample(
        &self,
        multiplicities: &[u32],
        start: &Exponents,
        scratch: &mut Scratch,
    ) -> Result<Fit, ConsistencyError> {
        self.descend(multiplicities, start, scratch, Care::Least)
    }

    fn descend(
        &self,
        multiplicities: &[u32],
        start: &Exponents,
        scratch: &mut Scratch,
        care: Care,
    ) -> Result<Fit, ConsistencyError> {
        scratch.draw(self.analysis.set(), multiplicities)?;
        let mut exponents = *start;
        let mut residuals = self.residuals(&exponents, scratch, care);
        let (mut damping, mut iterations) = (0.01, 0);
        for _ in 0..MOST_STEPS {
            let (gradient, normal) = residuals.normal_equations();
            if gradient.iter().all(|component| component.abs() < 1e-10) {
                break;
            }
            let step = solve_damped(&normal, &gradient, damping);
            let tried: Exponents = std::array::from_fn(|k| exponents[k] - step[k]);
            let promised: f64 = (0..KNOTS).map(|k| step[k] * (gradient[k] + damping * step[k])).sum();
            if care == Care::Least && promised < LITTLE * residuals.squares {
                exponents = tried;
                residuals.follow(&step);
                break;
            }
            let found = self.residuals(&tried, scratch, care);
            if found.squares < residuals.squares {
                let decrease = residuals.squares - found.squares;
                let is_little = decrease < LITTLE * residuals.squares;
                (exponents, residuals) = (tried, found);
                damping = (damping / 5.0_f64).max(1e-9);
                if is_little {
                    break;
                }
                iterations += 1;
            } else {
                damping *= 5.0;
                if damping > 1e10 {
                    break;
                }
            }
        }
        Ok(Fit { exponents, residuals: std::array::from_fn(|n| residuals.values[n]), iterations })
    }

    /// The shares `p_ij` of the records, for exponents and multiplicities.
    ///
    /// - `shares`: receives them, `[level, record]`: what [`RunWeights`](uplift_risk::RunWeights) takes.
    ///
    /// # Errors
    /// Another number of multiplicities than of records, or of shares than of runs; no record drawn.
    pub fn shares(
        &self,
        multiplicities: &[u32],
        exponents: &Exponents,
        scratch: &mut Scratch,
        shares: &mut [f64],
    ) -> Result<(), ConsistencyError> {
        scratch.draw(self.analysis.set(), multiplicities)?;
        let records = self.analysis.set().len();
        if shares.len() != self.basis.len() {
            return Err(ConsistencyError::Count { what: "shares", found: shares.len(), expected: self.basis.len() });
        }
        shares.fill(0.0);
        for (level, row) in shares.chunks_exact_mut(records).enumerate() {
            self.exponentials(level, exponents, scratch);
            let (drawn, values) = scratch.at_level(self.analysis.set(), level);
            let total: f64 = values.iter().sum();
            for (&(_, record, _), value) in drawn.records.iter().zip(values) {
                row[record] = *value / total;
            }
        }
        Ok(())
    }

    /// `m_j exp(g(ln y_ij))` of the drawn records at a stripe, over the largest exponential.
    fn exponentials(&self, level: usize, exponents: &Exponents, scratch: &mut Scratch) {
        let basis = &self.basis[level * self.analysis.set().len()..];
        let (drawn, values) = scratch.at_level(self.analysis.set(), level);
        values.clear();
        let mut largest = f64::NEG_INFINITY;
        for &(rank, ..) in &drawn.records {
            let basis = &basis[rank];
            let value = (0..KNOTS).map(|k| exponents[k] * basis[k]).sum();
            largest = largest.max(value);
            values.push(value);
        }
        for (value, (.., count)) in values.iter_mut().zip(&drawn.records) {
            *value = count * (*value - largest).exp();
        }
    }

    /// Residuals and derivatives: `∂λ̂(y_n)/∂b_k = Σ_i w_i Σ_j p_ij (B_ijk − B̄_ik) 1[y_ij > y_n]`,
    /// B̄ the weighted mean.
    fn residuals(&self, exponents: &Exponents, scratch: &mut Scratch, care: Care) -> Residuals {
        let records = self.analysis.set().len();
        let mut implied = [0.0; FIT_RATES];
        let mut slopes = [[0.0; KNOTS]; FIT_RATES];
        for (level, (&weight, above)) in self.stripe_weights.iter().zip(&self.above).enumerate() {
            let (drawn, _) = scratch.at_level(self.analysis.set(), level);
            let (before, all) = (|n: usize| drawn.before[above[n]], drawn.records.len());
            if care == Care::Least && (0..FIT_RATES).all(|n| before(n) == 0 || before(n) == all) {
                // all records of the stripe are on the same side of each rate, however they are weighed
                for (n, implied) in implied.iter_mut().enumerate() {
                    *implied += if before(n) == all { weight } else { 0.0 };
                }
                continue;
            }
            self.exponentials(level, exponents, scratch);
            let basis = &self.basis[level * records..];
            let (drawn, values) = scratch.at_level(self.analysis.set(), level);
            // Σ m e and Σ m e B over the first ranks, kept where each level ends
            let (mut sum, mut moments) = (0.0, [0.0; KNOTS]);
            let (mut sums, mut all_moments) = ([0.0; FIT_RATES], [[0.0; KNOTS]; FIT_RATES]);
            let mut from = 0;
            let mut add = |to: usize, sum: &mut f64, moments: &mut [f64; KNOTS]| {
                for (&(rank, ..), &value) in drawn.records[from..to].iter().zip(&values[from..to]) {
                    *sum += value;
                    for (moment, basis) in moments.iter_mut().zip(&basis[rank]) {
                        *moment += value * basis;
                    }
                }
                from = to;
            };
            for n in (0..FIT_RATES).rev() {
                add(drawn.before[above[n]], &mut sum, &mut moments);
                (sums[n], all_moments[n]) = (sum, moments);
            }
            add(drawn.records.len(), &mut sum, &mut moments);
            let factor = weight / sum;
            let mean = moments.map(|moment| moment / sum);
            for n in 0..FIT_RATES {
                implied[n] += factor * sums[n];
                for k in 0..KNOTS {
                    slopes[n][k] += factor * (all_moments[n][k] - sums[n] * mean[k]);
                }
            }
        }
        let mut values = [0.0; FIT_RATES + CURVATURES];
        let mut by_exponent = [[0.0; KNOTS]; FIT_RATES + CURVATURES];
        for n in 0..FIT_RATES {
            // a level that no drawn record reaches is far off, and no exponent changes that
            let rate = implied[n].max(f64::MIN_POSITIVE);
            values[n] = (rate / self.rates[n]).ln();
            by_exponent[n] = slopes[n].map(|slope| slope / rate);
        }
        for k in 0..CURVATURES {
            let row = FIT_RATES + k;
            values[row] = self.smoothness * (exponents[k] - 2.0 * exponents[k + 1] + exponents[k + 2]);
            by_exponent[row][k] = self.smoothness;
            by_exponent[row][k + 1] = -2.0 * self.smoothness;
            by_exponent[row][k + 2] = self.smoothness;
        }
        Residuals { values, by_exponent, squares: values.iter().map(|value| value * value).sum() }
    }
}

impl Residuals {
    /// What they become where a step is subtracted from the exponents, as the derivatives have it.
    fn follow(&mut self, step: &Exponents) {
        for (value, row) in self.values.iter_mut().zip(&self.by_exponent) {
            *value -= (0..KNOTS).map(|k| row[k] * step[k]).sum::<f64>();
        }
    }

    /// Gradient `Jᵀr` and normal matrix `JᵀJ`.
    fn normal_equations(&self) -> (Exponents, [[f64; KNOTS]; KNOTS]) {
        let (mut gradient, mut normal) = ([0.0; KNOTS], [[0.0; KNOTS]; KNOTS]);
        for (value, row) in self.values.iter().zip(&self.by_exponent) {
            for k in 0..KNOTS {
                gradient[k] += row[k] * value;
                for l in 0..KNOTS {
                    normal[k][l] += row[k] * row[l];
                }
            }
        }
        (gradient, normal)
    }
}

/// The solution of (A + μ I) x = g by Cholesky's factors; A has no negative eigenvalue, and μ is above 0.
fn solve_damped(normal: &[[f64; KNOTS]; KNOTS], gradient: &Exponents, damping: f64) -> Exponents {
    let mut factor = *normal;
    let mut x = *gradient;
    for k in 0..KNOTS {
        factor[k][k] += damping;
        for l in 0..=k {
            let dot: f64 = (0..l).map(|i| factor[k][i] * factor[l][i]).sum();
            let rest = factor[k][l] - dot;
            factor[k][l] = if k == l { rest.sqrt() } else { rest / factor[l][l] };
        }
        let dot: f64 = (0..k).map(|i| factor[k][i] * x[i]).sum();
        x[k] = (x[k] - dot) / factor[k][k];
    }
    for k in (0..KNOTS).rev() {
        let dot: f64 = (k + 1..KNOTS).map(|i| factor[i][k] * x[i]).sum();
        x[k] = (x[k] - dot) / factor[k][k];
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damped_equations_are_solved() {
        let normal = [[4.0, 1.0, 0.0, 0.5], [1.0, 3.0, 0.2, 0.0], [0.0, 0.2, 2.0, 0.1], [0.5, 0.0, 0.1, 1.0]];
        let expected = [1.0, -2.0, 3.0, 0.5];
        let gradient =
            std::array::from_fn(|k| (0..KNOTS).map(|l| normal[k][l] * expected[l]).sum::<f64>() + 0.25 * expected[k]);
        for (found, expected) in solve_damped(&normal, &gradient, 0.25).iter().zip(expected) {
            assert!((found - expected).abs() < 1e-14);
        }
    }
}
