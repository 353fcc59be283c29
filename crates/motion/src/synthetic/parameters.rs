//! The six parameters of the model and their regression on the scenario.

use super::marginal::Marginal;
use super::random::RandomStream;

/// An earthquake and a site.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scenario {
    /// Moment magnitude M.
    pub(super) magnitude: f64,
    /// F: reverse (1) or strike-slip (0).
    pub(super) reverse: bool,
    /// Rupture distance R \[km\].
    pub(super) rrup_km: f64,
    /// V: shear-wave velocity of the upper 30 m \[m/s\].
    pub(super) vs30_m_s: f64,
}

/// What one realisation of the model is made with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Parameters {
    /// Natural logarithm of the Arias intensity in s·g, Iₐ = (π/2) ∫ (a/g)² dt.
    pub(super) ln_arias: f64,
    /// Time from 5 to 95 % of the Arias intensity \[s\].
    pub(super) d5_95_s: f64,
    /// Time of 45 % of the Arias intensity \[s\].
    pub(super) t_mid_s: f64,
    /// Frequency of the filter at `t_mid_s` \[Hz\].
    pub(super) f_mid_hz: f64,
    /// Rate of change of that frequency \[Hz/s\].
    pub(super) f_slope_hz_s: f64,
    /// Damping ratio of the filter.
    pub(super) damping: f64,
}

/// One parameter's regression and marginal.
struct Regression {
    /// β₀ … β₄, on 1, M, F, R, V; for the Arias intensity on 1, M/7, F, ln(R/25), ln(V/750).
    beta: [f64; 5],
    /// Standard deviations between earthquakes (τ) and within (σ).
    tau: f64,
    sigma: f64,
    marginal: Marginal,
}

/// In the order of [`Parameters`].
///
/// # Source
///
/// Rezaeian & Der Kiureghian, Earthquake Engng Struct. Dyn. 39 (2010) 1155–1180 and 41 (2012)
/// 335–357.
const REGRESSIONS: [Regression; 6] = [
    Regression {
        beta: [-2.2962, 2.9440, -0.0707, -1.3564, -0.2654],
        tau: 0.2738,
        sigma: 0.5937,
        marginal: Marginal::Normal { mean: -4.8255, deviation: 1.4318 },
    },
    Regression {
        beta: [-6.1946, 0.9703, -0.7034, 0.0087, -0.0007],
        tau: 0.4574,
        sigma: 0.5688,
        marginal: Marginal::Beta { low: 5.0, width: 40.0, a: 1.1314, b: 2.4474 },
    },
    Regression {
        beta: [-5.0105, 0.6625, -0.3450, 0.0139, -0.0002],
        tau: 0.5114,
        sigma: 0.4145,
        marginal: Marginal::Beta { low: 0.5, width: 39.5, a: 1.5792, b: 3.6405 },
    },
    Regression {
        beta: [2.2525, -0.2586, -0.0808, -0.0084, 0.0],
        tau: 0.6918,
        sigma: 0.7228,
        marginal: Marginal::Gamma { shape: 4.0982, scale: 1.4330 },
    },
    Regression {
        beta: [-2.4886, 0.3440, 0.0441, 0.0026, -0.0001],
        tau: 0.1286,
        sigma: 0.9529,
        marginal: Marginal::TwoSidedExponential { low: -2.0, high: 0.5, rise: 6.7729, fall: 17.095 },
    },
    Regression {
        beta: [-0.2583, 0.1293, -0.4772, -0.0115, 0.0004],
        tau: 0.6815,
        sigma: 0.7601,
        marginal: Marginal::Beta { low: 0.02, width: 0.98, a: 1.4250, b: 5.7208 },
    },
];

/// Correlation of the total errors of the six regressions.
const CORRELATION: [[f64; 6]; 6] = [
    [1.0, -0.3555, 0.0066, -0.1545, 0.1341, -0.0078],
    [-0.3555, 1.0, 0.6729, -0.1303, -0.1576, -0.1958],
    [0.0066, 0.6729, 1.0, -0.2761, -0.1977, -0.2188],
    [-0.1545, -0.1303, -0.2761, 1.0, -0.2034, 0.2814],
    [0.1341, -0.1576, -0.1977, -0.2034, 1.0, -0.0137],
    [-0.0078, -0.1958, -0.2188, 0.2814, -0.0137, 1.0],
];

impl Parameters {
    /// Draws the parameters for `scenario`: six variates of `stream`.
    ///
    /// They are rounded by [`round_parameter`].
    pub(super) fn draw(scenario: &Scenario, stream: &mut RandomStream) -> Self {
        let independent: [f64; 6] = std::array::from_fn(|_| stream.normal());
        Self::from_normal(scenario, independent)
    }

    /// The parameters for six independent standard normal variates; all zero gives the medians.
    fn from_normal(scenario: &Scenario, independent: [f64; 6]) -> Self {
        let factor = cholesky(&CORRELATION);
        let means = means(scenario);
        let [ln_arias, d5_95_s, t_mid_s, f_mid_hz, f_slope_hz_s, damping] = std::array::from_fn(|i| {
            let Regression { tau, sigma, marginal, .. } = &REGRESSIONS[i];
            let correlated: f64 = factor[i].iter().zip(&independent).map(|(l, x)| l * x).sum();
            let variate = means[i] + (tau * tau + sigma * sigma).sqrt() * correlated;
            round_parameter(marginal.at_normal(variate))
        });
        // The filter oscillates: its damping stays below critical.
        let damping = damping.min(0.999);
        Self { ln_arias, d5_95_s, t_mid_s, f_mid_hz, f_slope_hz_s, damping }
    }
}

/// Rounds to six decimals: what is computed with a rounded parameter does not depend on the last
/// bits of the quantile function that gave it.
pub(super) fn round_parameter(value: f64) -> f64 {
    #[cfg(test)]
    tests::note_margin(value * 1e6);
    (value * 1e6).round() / 1e6
}

/// Means of the six normal variates.
fn means(scenario: &Scenario) -> [f64; 6] {
    let &Scenario { magnitude, reverse, rrup_km, vs30_m_s } = scenario;
    let f = f64::from(u8::from(reverse));
    let arias = [1.0, magnitude / 7.0, f, (rrup_km / 25.0).ln(), (vs30_m_s / 750.0).ln()];
    let others = [1.0, magnitude, f, rrup_km, vs30_m_s];
    std::array::from_fn(|i| {
        let terms = if i == 0 { &arias } else { &others };
        REGRESSIONS[i].beta.iter().zip(terms).map(|(b, t)| b * t).sum()
    })
}

/// Lower triangular factor L of a positive definite matrix A = L Lᵀ (NaN where it is not).
fn cholesky<const N: usize>(matrix: &[[f64; N]; N]) -> [[f64; N]; N] {
    let mut factor = [[0.0; N]; N];
    for i in 0..N {
        for j in 0..=i {
            let dot: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let rest = matrix[i][j] - dot;
            factor[i][j] = if i == j { rest.sqrt() } else { rest / factor[j][j] };
        }
    }
    factor
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    thread_local! {
        /// The least distance of a rounded value from its rounding boundary, in units of the last
        /// decimal kept, on this thread.
        pub(in super::super) static LEAST_MARGIN: std::cell::Cell<f64> = const { std::cell::Cell::new(0.5) };
    }

    pub(super) fn note_margin(value: f64) {
        let margin = 0.5 - (value - value.round()).abs();
        LEAST_MARGIN.set(LEAST_MARGIN.get().min(margin));
    }

    const SCENARIO: Scenario = Scenario { magnitude: 7.0, reverse: false, rrup_km: 25.0, vs30_m_s: 750.0 };

    #[test]
    fn correlation_is_symmetric_and_positive_definite() {
        let factor = cholesky(&CORRELATION);
        for i in 0..6 {
            assert!(factor[i][i] > 0.1, "pivot {i}: {}", factor[i][i]);
            for j in 0..6 {
                assert_eq!(CORRELATION[i][j], CORRELATION[j][i]);
                let product: f64 = (0..6).map(|k| factor[i][k] * factor[j][k]).sum();
                assert!((product - CORRELATION[i][j]).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn cholesky_of_a_hand_solved_matrix() {
        let factor = cholesky(&[[4.0, 2.0], [2.0, 10.0]]);
        assert_eq!(factor, [[2.0, 0.0], [1.0, 3.0]]);
        assert!(cholesky(&[[1.0, 2.0], [2.0, 1.0]])[1][1].is_nan());
    }

    #[test]
    fn means_by_hand() {
        // M 7, R 25 km, V 750 m/s, strike-slip: the logarithms vanish.
        let hand = [
            -2.2962 + 2.9440,
            -6.1946 + 6.7921 + 0.2175 - 0.525,
            -5.0105 + 4.6375 + 0.3475 - 0.15,
            2.2525 - 1.8102 - 0.21,
            -2.4886 + 2.408 + 0.065 - 0.075,
            -0.2583 + 0.9051 - 0.2875 + 0.3,
        ];
        for (mean, hand) in means(&SCENARIO).iter().zip(hand) {
            assert!((mean - hand).abs() < 1e-12);
        }
        // F = 1 adds β₂.
        let reverse = means(&Scenario { reverse: true, ..SCENARIO });
        assert!((reverse[1] - hand[1] + 0.7034).abs() < 1e-12);
    }

    #[test]
    fn medians_for_the_hand_scenario() {
        let medians = Parameters::from_normal(&SCENARIO, [0.0; 6]);
        assert!((medians.ln_arias - (-4.8255 + 1.4318 * 0.6478)).abs() < 1e-6);
        assert!(medians.d5_95_s > 5.0 && medians.d5_95_s < 45.0);
        // Φ(−0.0906) = 0.4639 is below the mass 0.7162 of the falling branch:
        // ω'/2π = ln(0.4639/0.7162)/6.7729 = −0.0641 Hz/s.
        assert!((medians.f_slope_hz_s + 0.0641).abs() < 1e-4, "{medians:?}");
    }

    #[test]
    fn errors_have_the_published_deviations_and_correlation() {
        let mut stream = RandomStream::new(1, 0);
        let base = means(&SCENARIO)[0];
        let count = 20_000;
        // ln Iₐ and the frequency rank: the first is linear in its variate.
        let draws: Vec<_> = (0..count).map(|_| Parameters::draw(&SCENARIO, &mut stream)).collect();
        let standard = |p: &Parameters| ((p.ln_arias + 4.8255) / 1.4318 - base) / 0.653_79;
        let n = f64::from(count);
        let mean = draws.iter().map(standard).sum::<f64>() / n;
        let variance = draws.iter().map(|p| standard(p).powi(2)).sum::<f64>() / n;
        assert!(mean.abs() < 4.0 / n.sqrt(), "{mean}");
        assert!((variance - 1.0).abs() < 4.0 * (2.0 / n).sqrt(), "{variance}");
        // Quadrant probability of two normal variates, ¼ + asin(ρ)/2π, for D5-95 and t_mid
        // (ρ = 0.6729): unchanged by their monotone marginals.
        let medians = Parameters::from_normal(&SCENARIO, [0.0; 6]);
        let both =
            draws.iter().filter(|p| p.d5_95_s > medians.d5_95_s && p.t_mid_s > medians.t_mid_s).count() as f64 / n;
        let exact = 0.25 + 0.6729_f64.asin() / std::f64::consts::TAU;
        assert!((both - exact).abs() < 4.0 * (exact * (1.0 - exact) / n).sqrt(), "{both} {exact}");
    }
}
