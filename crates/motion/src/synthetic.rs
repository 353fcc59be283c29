//! Synthetic record pairs from a published stochastic model, for studies without real records.
//!
//! Real records may not be distributed with a program, so the default set is generated: two
//! horizontal components on firm ground after Rezaeian & Der Kiureghian (2010, 2012),
//!
//! x(t) = q(t) u(t), then a high-pass,
//!
//! with a smooth envelope q that carries Arias intensity, duration and time of strong shaking, and
//! filtered white noise u of unit variance whose frequency moves linearly with time. The six
//! parameters of a pair are drawn from the model's regression on magnitude, mechanism, rupture
//! distance and V<sub>S30</sub>; the two components share them, and differ by their noise and by a
//! lognormal scatter of the Arias intensity.
//!
//! The motions scatter less than real ones and have no long-period pulses: a study that matters
//! uses real records.
//!
//! # Determinism
//!
//! Each candidate pair has its own stream of a counter-based generator (`ChaCha8`), drawn in a fixed
//! order. The parameters are rounded to six decimals and the samples to 10⁻⁶ g, as a file would
//! hold them; the steps along the record use operations that are exact everywhere. `exp`, `ln` and
//! the quantile functions may differ between platforms in the last bit, which moves a sample by
//! 3·10⁻¹⁴ g at most; through the rounding that shows only where the sample lies so near a rounding
//! boundary. In the default set none does: all keep more than 10⁻¹³ g away, which a test holds.
//!
//! # Source
//!
//! S. Rezaeian, A. Der Kiureghian, "Simulation of synthetic ground motions for specified earthquake
//! and site characteristics", Earthquake Engng Struct. Dyn. 39 (2010) 1155–1180, and "Simulation of
//! orthogonal horizontal ground motion components for specified earthquake and site
//! characteristics", 41 (2012) 335–357.

mod complex;
mod envelope;
mod filter;
mod high_pass;
mod marginal;
mod parameters;
mod random;
#[cfg(test)]
mod tests;

use crate::{Accelerogram, MotionError, RecordPair, STANDARD_GRAVITY_M_S2};
use envelope::Envelope;
use filter::filtered_noise;
use high_pass::high_pass;
use parameters::{Parameters, Scenario};
use random::RandomStream;
use std::collections::BTreeMap;

/// The samples are whole multiples of this \[g\].
const QUANTUM_G: f64 = 1e-6;

/// Standard deviation of ln Iₐ of one component about the pair's geometric mean.
///
/// The model gives none. With what the independent noise adds, the components' PGA and PGV then
/// scatter about their geometric means by 0.16 and 0.18 to 0.19 in ln; measured ones by 0.166 and
/// 0.190 (Campbell & Bozorgnia 2008, Earthquake Spectra 24(1) 139–171, intra-component standard
/// deviation).
const COMPONENT_SCATTER: f64 = 0.25;

/// Candidates tried for each pair asked for, before giving up.
const CANDIDATES_PER_PAIR: u64 = 100;

/// What a synthetic record set is made with. The default is the embedded set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SyntheticSetOptions {
    /// Seed of the random numbers; one seed, one set.
    pub seed: u64,
    /// Number of pairs, 1 to 10 000. A smaller set is the beginning of a larger one.
    pub pairs: usize,
    /// Time step \[s\], 0.001 to 0.01.
    pub dt_s: f64,
    /// Corner frequency of the high-pass \[Hz\], 0.1 to 0.25.
    pub corner_hz: f64,
    /// A pair is kept when the geometric mean of the peak ground accelerations of its components is
    /// above this \[g\], 0 to 1.
    pub minimum_pga_g: f64,
    /// The earthquakes and sites; each pair has its own.
    pub scenario: ScenarioRange,
}

impl Default for SyntheticSetOptions {
    fn default() -> Self {
        let scenario = ScenarioRange::default();
        Self { seed: 1, pairs: 105, dt_s: 0.01, corner_hz: 0.1, minimum_pga_g: 0.14, scenario }
    }
}

/// Earthquakes and sites from which each pair's own is drawn: uniformly between two ends, which may
/// be one. The default is that of the embedded set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScenarioRange {
    /// Moment magnitude, 6 to 8; drawn to 0.01.
    pub magnitude: [f64; 2],
    /// Closest distance to the rupture \[km\], 8 to 100; drawn to 0.1 km.
    pub rrup_km: [f64; 2],
    /// Mean shear-wave velocity of the upper 30 m \[m/s\], 360 to 1100; drawn to 1 m/s.
    pub vs30_m_s: [f64; 2],
    /// Faulting; even odds where none is given.
    pub faulting: Option<Faulting>,
}

impl Default for ScenarioRange {
    fn default() -> Self {
        Self { magnitude: [6.2, 7.6], rrup_km: [8.0, 60.0], vs30_m_s: [360.0, 800.0], faulting: None }
    }
}

/// Mechanism of an earthquake, as far as the model tells them apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Faulting {
    /// Strike-slip.
    StrikeSlip,
    /// Reverse or reverse-oblique.
    Reverse,
}

impl SyntheticSetOptions {
    /// Refuses what would not make motions.
    fn check(&self) -> Result<(), MotionError> {
        let checks = [
            ("pairs", self.pairs as f64, 1.0, 1e4, "1 to 10000"),
            ("dt_s", self.dt_s, 0.001, 0.01, "0.001 to 0.01 s"),
            ("corner_hz", self.corner_hz, 0.1, 0.25, "0.1 to 0.25 Hz"),
            ("minimum_pga_g", self.minimum_pga_g, 0.0, 1.0, "0 to 1 g"),
        ];
        for (option, value, least, most, allowed) in checks {
            if !(least..=most).contains(&value) {
                return Err(MotionError::SyntheticOption { option, value, allowed });
            }
        }
        let ScenarioRange { magnitude, rrup_km, vs30_m_s, faulting: _ } = self.scenario;
        // What the model was fitted to, but for soft ground.
        let ranges = [
            ("magnitude", magnitude, 6.0, 8.0, "6 to 8, the smaller end first"),
            ("rrup_km", rrup_km, 8.0, 100.0, "8 to 100 km, the smaller end first"),
            ("vs30_m_s", vs30_m_s, 360.0, 1100.0, "360 to 1100 m/s, the smaller end first"),
        ];
        for (option, [from, to], least, most, allowed) in ranges {
            let beyond = [from, to].into_iter().find(|value| !(least..=most).contains(value));
            if let Some(value) = beyond.or((from > to).then_some(from)) {
                return Err(MotionError::SyntheticOption { option, value, allowed });
            }
        }
        Ok(())
    }
}

/// Generates the synthetic record set of `options`, all of [`Pairs`].
///
/// # Errors
///
/// As [`Pairs::from_options`] and each of its pairs.
pub fn generate(options: &SyntheticSetOptions) -> Result<Vec<RecordPair>, MotionError> {
    Pairs::from_options(options)?.collect()
}

/// The pairs of a synthetic record set, each made when it is asked for: some 25 ms of a core.
///
/// They are named `SYN001`, `SYN002`, …; their metadata hold `event`, `magnitude`, `rrup_km`, `vs30` \[m/s\],
/// `station`, `mechanism` and `set_tags`. "synthetic" stands in event, station and tags. The scenario of each candidate
/// is drawn from [`SyntheticSetOptions::scenario`].
#[derive(Debug, Clone)]
pub struct Pairs<'a> {
    options: &'a SyntheticSetOptions,
    kept: usize,
    candidate: u64,
}

impl<'a> Pairs<'a> {
    /// The set of `options`, none of it made yet.
    ///
    /// # Errors
    ///
    /// [`MotionError::SyntheticOption`] for an option out of its range.
    pub fn from_options(options: &'a SyntheticSetOptions) -> Result<Self, MotionError> {
        options.check()?;
        Ok(Self { options, kept: 0, candidate: 0 })
    }
}

impl Iterator for Pairs<'_> {
    type Item = Result<RecordPair, MotionError>;

    /// The next pair; [`MotionError::SyntheticCandidates`], and nothing more, when too few candidates reach
    /// `minimum_pga_g`.
    fn next(&mut self) -> Option<Self::Item> {
        let options = self.options;
        let most = CANDIDATES_PER_PAIR * options.pairs as u64;
        if self.kept == options.pairs || self.candidate > most {
            return None;
        }
        while self.candidate < most {
            let candidate = self.candidate;
            self.candidate += 1;
            let Some(motion) = Candidate::simulate(options, candidate) else {
                continue;
            };
            if motion.geometric_mean_pga_g() > options.minimum_pga_g {
                self.kept += 1;
                return Some(motion.into_pair(options, self.kept));
            }
        }
        self.candidate = most + 1;
        Some(Err(MotionError::SyntheticCandidates {
            kept: self.kept,
            tried: most,
            wanted: options.pairs,
            minimum_pga_g: options.minimum_pga_g,
        }))
    }
}

/// One realisation of the model, before it is known whether the set keeps it.
#[derive(Debug)]
struct Candidate {
    number: u64,
    scenario: Scenario,
    /// Both components \[g\], not yet rounded.
    components_g: [Vec<f64>; 2],
}

impl Candidate {
    /// Candidate `number` of the set; `None` where the drawn duration and middle admit no
    /// envelope. The order of the draws is part of the definition of the set.
    fn simulate(options: &SyntheticSetOptions, number: u64) -> Option<Self> {
        let mut stream = RandomStream::new(options.seed, number);
        let scenario = Scenario::draw(&options.scenario, &mut stream);
        let parameters = Parameters::draw(&scenario, &mut stream);
        let scatter = COMPONENT_SCATTER * stream.normal();
        let envelope = Envelope::new(parameters.ln_arias.exp(), parameters.d5_95_s, parameters.t_mid_s)?;

        let dt_s = options.dt_s;
        let shaking = samples(envelope.end_s, dt_s);
        let noise: [Vec<f64>; 2] = std::array::from_fn(|_| (0..shaking).map(|_| stream.normal()).collect());
        let mut components_g = filtered_noise(&parameters, dt_s, [&noise[0], &noise[1]]);
        // The geometric mean of the components keeps the Arias intensity of the model.
        for (component, side) in components_g.iter_mut().zip([0.5, -0.5]) {
            let factor = (side * scatter).exp() / STANDARD_GRAVITY_M_S2;
            for (index, sample) in component.iter_mut().enumerate() {
                *sample *= factor * envelope.at(index as f64 * dt_s);
            }
            component.resize(shaking + samples(quiet_s(options.corner_hz), dt_s), 0.0);
            high_pass(component, dt_s, options.corner_hz);
        }
        Some(Self { number, scenario, components_g })
    }

    /// Geometric mean of the components' peak accelerations \[g\].
    fn geometric_mean_pga_g(&self) -> f64 {
        let peak = |component: &[f64]| component.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        (peak(&self.components_g[0]) * peak(&self.components_g[1])).sqrt()
    }

    /// The pair, its samples rounded, as number `position` of the set.
    fn into_pair(self, options: &SyntheticSetOptions, position: usize) -> Result<RecordPair, MotionError> {
        let metadata = BTreeMap::from(
            [
                ("event", format!("synthetic, seed {}, candidate {}", options.seed, self.number)),
                ("magnitude", format!("{:.2}", self.scenario.magnitude)),
                ("rrup_km", format!("{:.1}", self.scenario.rrup_km)),
                ("vs30", format!("{:.0}", self.scenario.vs30_m_s)),
                ("station", "synthetic firm ground".to_owned()),
                ("mechanism", if self.scenario.reverse { "reverse" } else { "strike-slip" }.to_owned()),
                ("set_tags", "synthetic".to_owned()),
            ]
            .map(|(key, value)| (key.to_owned(), value)),
        );
        let [h1, h2] = self.components_g.map(|component| {
            let rounded = component.iter().map(|a| (a / QUANTUM_G).round() * (QUANTUM_G * STANDARD_GRAVITY_M_S2));
            Accelerogram::new(options.dt_s, rounded.collect())
        });
        Ok(RecordPair { id: format!("SYN{position:03}"), h1: h1?, h2: h2?, metadata })
    }
}

impl Scenario {
    /// Draws a scenario: four variates of `stream`, rounded to what the metadata show.
    fn draw(range: &ScenarioRange, stream: &mut RandomStream) -> Self {
        let mut between = |[low, high]: [f64; 2], steps_per_unit: f64| {
            ((low + (high - low) * stream.uniform()) * steps_per_unit).round() / steps_per_unit
        };
        let (magnitude, rrup_km, vs30_m_s) =
            (between(range.magnitude, 100.0), between(range.rrup_km, 10.0), between(range.vs30_m_s, 1.0));
        // drawn in any case, so that the variates after it do not depend on the choice
        let drawn = stream.uniform() < 0.5;
        let reverse = range.faulting.map_or(drawn, |faulting| faulting == Faulting::Reverse);
        Scenario { magnitude, reverse, rrup_km, vs30_m_s }
    }
}

/// Time \[s\] added after the shaking for the ground to come to rest: one and a half periods of the
/// high-pass, in which its free velocity falls to 8·10⁻⁴.
fn quiet_s(corner_hz: f64) -> f64 {
    1.5 / corner_hz
}

/// Samples that cover `duration_s`.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // at most some 10⁵
fn samples(duration_s: f64, dt_s: f64) -> usize {
    (duration_s / dt_s).ceil() as usize + 1
}
