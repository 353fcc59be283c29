//! One block under one record at many scale factors, several motions side by side, each at its own time.
//!
//! Of twelve sample intervals in which a block rocks some eleven hold no impact, and no peak that could be the largest.
//! Such intervals are computed together in vectors, by the [series](crate::series) that a single motion has, operation
//! by operation; all others, and what comes before uplift and after the record, by the [motion](crate::motion) itself.
//! So every response has the bits of [`respond`](crate::respond).

use std::array::from_fn;
use std::ops::ControlFlow;

use uplift_instructions::{Instructions, Vectors, Work, by_halves, larger, smaller};
use uplift_motion::Accelerogram;
use uplift_taylor::{LEAST_ORDER, TRUNCATION};

use crate::block::{LYING_RAD, RockingBlock};
use crate::error::BlockError;
use crate::excitation::{check_acceleration, line};
use crate::motion::{Ending, Motion};
use crate::observer::Unobserved;
use crate::response::{BlockResponse, FreeRocking, check_duration, rock_on};
use crate::rest::RestRule;
use crate::series::{INVERSE, Series};
use crate::sine::sine_and_cosine;

/// Motions side by side.
const LANES: usize = 8;

/// Highest power in the series of a velocity: 5 to 10 suffice for the sample intervals of a record.
const MOST: usize = 12;

/// How far a bound must be from what it decides, relatively, for roundings not to matter.
const MARGIN: f64 = 1e-12;

type Lanes = [f64; LANES];

/// Responses of `block`, at rest before, to `record` times each of `scales`: those of [`respond`](crate::respond) to
/// the bit, in a fraction of the time.
///
/// # Errors
/// As [`respond`](crate::respond).
pub fn respond_at_scales(
    block: &RockingBlock,
    record: &Accelerogram,
    scales: &[f64],
    free: FreeRocking,
) -> Result<Vec<BlockResponse>, BlockError> {
    respond_with(Instructions::chosen(), block, record, scales, free)
}

fn respond_with(
    instructions: Instructions,
    block: &RockingBlock,
    record: &Accelerogram,
    scales: &[f64],
    free: FreeRocking,
) -> Result<Vec<BlockResponse>, BlockError> {
    check_duration(block, record.duration_s(), free)?;
    let peak_m_s2 = record.acceleration_m_s2().iter().fold(0.0_f64, |peak, a| peak.max(a.abs()));
    scales.iter().try_for_each(|scale| check_acceleration(scale * peak_m_s2))?;
    let sweep = Sweep::new(block, record, free);
    Ok(instructions.run(Following { sweep: &sweep, scales }))
}

/// What the motions share.
struct Sweep<'a> {
    block: &'a RockingBlock,
    samples_m_s2: &'a [f64],
    dt_s: f64,
    free: FreeRocking,
    /// Of every sample interval what [`Forcing::bound`](uplift_taylor::Forcing::bound) is of, at a scale of one.
    bounds_m_s2: Vec<f64>,
    interval: Interval,
}

/// A whole sample interval as a step: what its series needs.
struct Interval {
    /// Whether a step may be as long.
    is_step: bool,
    slenderness_rad: f64,
    /// −p² dt/(k + 1).
    of_moment: [f64; MOST + 1],
    /// dt/(k + 1).
    of_rate: [f64; MOST + 1],
}

impl<'a> Sweep<'a> {
    fn new(block: &'a RockingBlock, record: &'a Accelerogram, free: FreeRocking) -> Self {
        let (samples_m_s2, dt_s) = (record.acceleration_m_s2(), record.dt_s());
        let motion = Motion::new(block, RestRule::Proven, Unobserved);
        let p_squared = block.frequency_parameter_rad_s().powi(2);
        let of_rate = from_fn(|k| dt_s * INVERSE[k]);
        let interval = Interval {
            is_step: dt_s <= motion.longest_step_s(),
            slenderness_rad: block.slenderness_rad(),
            of_moment: of_rate.map(|rate| -p_squared * rate),
            of_rate,
        };
        let bounds_m_s2 = samples_m_s2.windows(2).map(|pair| pair[0].abs() + (pair[1] - pair[0]).abs()).collect();
        Self { block, samples_m_s2, dt_s, free, bounds_m_s2, interval }
    }

    fn intervals(&self) -> usize {
        self.bounds_m_s2.len()
    }
}

struct Following<'a> {
    sweep: &'a Sweep<'a>,
    scales: &'a [f64],
}

impl Work for Following<'_> {
    type Output = Vec<BlockResponse>;

    #[inline(always)]
    fn run<V: Vectors>(self, _: V) -> Self::Output {
        follow(self.sweep, self.scales)
    }
}

/// A motion, and where in the record it is.
struct Run<'a> {
    index: usize,
    scale: f64,
    motion: Motion<'a, Unobserved>,
    series: Series,
    interval: usize,
}

impl<'a> Run<'a> {
    fn new(sweep: &Sweep<'a>, index: usize, scale: f64) -> Self {
        let motion = Motion::new(sweep.block, RestRule::Proven, Unobserved);
        Self { index, scale, motion, series: Series::EMPTY, interval: 0 }
    }

    /// Goes on alone, through one interval at least if it `must`, until the block rocks at the begin of an interval;
    /// its response if it is over before.
    #[inline(never)]
    fn go_on(&mut self, sweep: &Sweep<'a>, mut must: bool) -> Option<BlockResponse> {
        let n = sweep.intervals();
        loop {
            if self.motion.resting {
                // what the ground cannot lift; the motion itself says so where it is close
                let threshold = sweep.block.uplift_acceleration_m_s2() / self.scale.abs() * (1.0 - MARGIN);
                let quiet = sweep.bounds_m_s2[self.interval..].iter().position(|bound| *bound > threshold);
                self.interval = quiet.map_or(n, |quiet| self.interval + quiet);
            }
            if self.interval == n {
                let ending = rock_on(&mut self.motion, &mut self.series, n as f64 * sweep.dt_s, sweep.free);
                return Some(BlockResponse::from_motion(&self.motion, ending));
            }
            if !must && sweep.interval.is_step && !self.motion.resting && self.motion.x > 0.0 {
                return None;
            }
            must = false;
            if let ControlFlow::Break(ending) = self.advance(sweep) {
                return Some(BlockResponse::from_motion(&self.motion, Some(ending)));
            }
        }
    }

    /// Through one interval.
    fn advance(&mut self, sweep: &Sweep<'a>) -> ControlFlow<Ending> {
        let samples = [self.interval, self.interval + 1].map(|i| self.scale * sweep.samples_m_s2[i]);
        let shaking = |offset_s, step_s| line(samples, sweep.dt_s, offset_s, step_s);
        let begin_s = self.interval as f64 * sweep.dt_s;
        self.interval += 1;
        self.motion.advance(&mut self.series, begin_s, sweep.dt_s, false, shaking)
    }
}

#[inline(always)]
fn follow(sweep: &Sweep<'_>, scales: &[f64]) -> Vec<BlockResponse> {
    let mut pending = scales.iter().enumerate();
    let mut responses = vec![None; scales.len()];
    let mut runs: [Option<Run<'_>>; LANES] = [const { None }; LANES];
    let (mut states, mut series) = (States::AT_REST, SeriesOfAll::EMPTY);
    let mut stopped = [true; LANES];
    loop {
        for (lane, run) in runs.iter_mut().enumerate().filter(|(lane, _)| stopped[*lane]) {
            let mut must = true;
            if let Some(run) = run {
                states.take(lane, &mut run.motion);
            }
            loop {
                if run.is_none() {
                    *run = pending.next().map(|(index, scale)| Run::new(sweep, index, *scale));
                    must = false;
                }
                let Some(going) = run else { break };
                match going.go_on(sweep, must) {
                    None => {
                        states.put(lane, &going.motion);
                        break;
                    }
                    Some(response) => {
                        responses[going.index] = Some(response);
                        *run = None;
                    }
                }
            }
        }
        if runs.iter().all(Option::is_none) {
            return responses.into_iter().flatten().collect();
        }
        stopped = rock_together(sweep, &mut runs, &mut states, &mut series);
    }
}

/// All runs through whole intervals, until something else than rocking on is in the next interval of one; of which.
#[inline(always)]
fn rock_together(
    sweep: &Sweep<'_>,
    runs: &mut [Option<Run<'_>>; LANES],
    states: &mut States,
    series: &mut SeriesOfAll,
) -> [bool; LANES] {
    let n = sweep.intervals();
    let mut interval: [usize; LANES] = from_fn(|i| runs[i].as_ref().map_or(0, |run| run.interval));
    let scale: Lanes = from_fn(|i| runs[i].as_ref().map_or(0.0, |run| run.scale));
    let is_empty: [bool; LANES] = from_fn(|i| runs[i].is_none());
    let to_g: Lanes = from_fn(|i| states.side[i] / sweep.block.gravity_m_s2());
    let stopped = loop {
        let begin: Lanes = from_fn(|i| scale[i] * sweep.samples_m_s2[interval[i]]);
        let end: Lanes = from_fn(|i| scale[i] * sweep.samples_m_s2[interval[i] + 1]);
        let ground = [from_fn(|i| begin[i] * to_g[i]), from_fn(|i| (end[i] - begin[i]) * to_g[i])];
        let time_s = from_fn(|i| interval[i] as f64 * sweep.dt_s + sweep.dt_s);
        let rocks_on = states.rock_on(series, &sweep.interval, &ground, &time_s);
        let mut stopped = [false; LANES];
        let mut any = false;
        for i in 0..LANES {
            if is_empty[i] {
                interval[i] = 0;
                continue;
            }
            interval[i] += usize::from(rocks_on[i] != 0.0);
            stopped[i] = rocks_on[i] == 0.0 || interval[i] == n;
            any |= stopped[i];
        }
        if any {
            break stopped;
        }
    };
    for (i, run) in runs.iter_mut().enumerate() {
        if let Some(run) = run {
            run.interval = interval[i];
        }
    }
    stopped
}

/// States of the motions.
struct States {
    x: Lanes,
    v: Lanes,
    side: Lanes,
    peak: Lanes,
    peak_s: Lanes,
}

impl States {
    const AT_REST: Self =
        Self { x: [0.0; LANES], v: [0.0; LANES], side: [1.0; LANES], peak: [0.0; LANES], peak_s: [0.0; LANES] };

    fn put(&mut self, lane: usize, motion: &Motion<'_, Unobserved>) {
        self.side[lane] = motion.side;
        (self.x[lane], self.v[lane]) = (motion.x, motion.v);
        (self.peak[lane], self.peak_s[lane]) = (motion.peak, motion.peak_s);
    }

    fn take(&self, lane: usize, motion: &mut Motion<'_, Unobserved>) {
        (motion.x, motion.v) = (self.x[lane], self.v[lane]);
        (motion.peak, motion.peak_s) = (self.peak[lane], self.peak_s[lane]);
    }

    /// Moves what rocks on, without an impact and without a peak inside that could be the largest, through a sample
    /// interval that ends at `time_s`, with the ground acceleration begin + change·s in units of g: 1 of each that
    /// does, 0 of the others, which stay.
    #[inline(always)]
    fn rock_on(&mut self, series: &mut SeriesOfAll, interval: &Interval, ground: &[Lanes; 2], time_s: &Lanes) -> Lanes {
        series.expand(interval, &self.x, &self.v, ground);
        let SeriesOfAll { order, x, v, open, .. } = series;
        let order = *order;
        let [mut x_end, mut v_end, mut reach, mut change] = [[0.0; LANES]; 4];
        for k in (0..=order + 1).rev() {
            x_end = from_fn(|i| x_end[i] + x[k][i]);
        }
        for k in (0..=order).rev() {
            v_end = from_fn(|i| v_end[i] + v[k][i]);
        }
        for x in &x[..=order + 1] {
            reach = from_fn(|i| reach[i] + x[i].abs());
        }
        for v in &v[1..=order] {
            change = from_fn(|i| change[i] + v[i].abs());
        }
        let mut goes = [0.0; LANES];
        for i in 0..LANES {
            // x falls by less than the second term and all later ones together
            let fall = x[1][i] - ((reach[i] - x[0][i]) - x[1][i].abs());
            let lowest = x[0][i] + smaller(fall, 0.0);
            let stays_up = lowest > MARGIN * reach[i] && x_end[i] > 0.0 && reach[i] < LYING_RAD;
            let has_no_peak = reach[i] <= self.peak[i] || v[0][i].abs() > (1.0 + MARGIN) * change[i];
            goes[i] = if stays_up && has_no_peak && open[i] == 0.0 { 1.0 } else { 0.0 };
        }
        for i in 0..LANES {
            let is_peak = goes[i] != 0.0 && x_end[i] > self.peak[i];
            self.x[i] = if goes[i] == 0.0 { self.x[i] } else { x_end[i] };
            self.v[i] = if goes[i] == 0.0 { self.v[i] } else { v_end[i] };
            self.peak[i] = if is_peak { x_end[i] } else { self.peak[i] };
            self.peak_s[i] = if is_peak { time_s[i] } else { self.peak_s[i] };
        }
        goes
    }
}

/// The [series](crate::series) of all motions over a sample interval. Beyond the order of its own, that of a motion is
/// zero.
struct SeriesOfAll {
    x: [Lanes; MOST + 2],
    v: [Lanes; MOST + 1],
    sine: [Lanes; MOST + 1],
    cosine: [Lanes; MOST + 1],
    /// Zero of the motions of which no higher order is needed.
    open: Lanes,
    /// The highest of all.
    order: usize,
}

impl SeriesOfAll {
    const EMPTY: Self = Self {
        order: 0,
        x: [[0.0; LANES]; MOST + 2],
        v: [[0.0; LANES]; MOST + 1],
        sine: [[0.0; LANES]; MOST + 1],
        cosine: [[0.0; LANES]; MOST + 1],
        open: [0.0; LANES],
    };

    #[inline(always)]
    fn expand(&mut self, interval: &Interval, x_begin: &Lanes, v_begin: &Lanes, [begin, change]: &[Lanes; 2]) {
        let Self { x, v, sine, cosine, .. } = self;
        (x[0], v[0]) = (*x_begin, *v_begin);
        for i in 0..LANES {
            (sine[0][i], cosine[0][i]) = sine_and_cosine(interval.slenderness_rad - x_begin[i]);
        }
        let mut largest: Lanes = v_begin.map(f64::abs);
        let mut open = [1.0; LANES];
        let mut drawn: Lanes = from_fn(|i| begin[i] * cosine[0][i]);
        let mut order = 0;
        while order < MOST {
            let k = order;
            let (of_moment, of_rate) = (interval.of_moment[k], interval.of_rate[k]);
            let (mut falls, mut rises) = ([0.0; LANES], [0.0; LANES]);
            for j in 0..=k {
                falls = from_fn(|i| falls[i] - cosine[j][i] * v[k - j][i]);
                rises = from_fn(|i| rises[i] + sine[j][i] * v[k - j][i]);
            }
            v[k + 1] = from_fn(|i| open[i] * (of_moment * (sine[k][i] + drawn[i])));
            x[k + 1] = from_fn(|i| of_rate * v[k][i]);
            sine[k + 1] = from_fn(|i| of_rate * falls[i]);
            cosine[k + 1] = from_fn(|i| of_rate * rises[i]);
            drawn = from_fn(|i| begin[i] * cosine[k + 1][i] + change[i] * cosine[k][i]);
            largest = from_fn(|i| larger(v[k + 1][i].abs(), largest[i]));
            order += 1;
            if order >= LEAST_ORDER {
                let tail: Lanes = from_fn(|i| larger(v[k + 1][i].abs(), v[k][i].abs()));
                open = from_fn(|i| if tail[i] <= TRUNCATION * largest[i] { 0.0 } else { open[i] });
                if sum(open) == 0.0 {
                    break;
                }
            }
        }
        x[order + 1] = from_fn(|i| interval.of_rate[order] * v[order][i]);
        (self.order, self.open) = (order, open);
    }
}

#[inline(always)]
fn sum(lanes: Lanes) -> f64 {
    by_halves(lanes, |a, b| a + b)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::{Overturning, respond};

    /// A burst of noise that swells and fades, m/s².
    fn record(samples: usize, dt_s: f64, seed: u64) -> Accelerogram {
        let mut state = seed;
        let (mut last, mut noise) = (0.0, Vec::new());
        for i in 0..samples {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let white = (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
            last += 0.3 * (white - last);
            noise.push(5.0 * last * (i as f64 / samples as f64 * 3.0).sin());
        }
        Accelerogram::new(dt_s, noise).unwrap()
    }

    fn bits(response: &BlockResponse) -> ([u64; 3], Option<u64>, u64, Overturning, bool) {
        let numbers = [response.rotation_rad, response.displacement_m, response.time_s].map(f64::to_bits);
        let uplift = response.uplift_s.map(f64::to_bits);
        (numbers, uplift, response.impacts, response.overturning, response.chatter_was_cut)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        #[test]
        fn every_response_has_the_bits_of_the_motion_alone(
            seed in 0_u64..1_000_000,
            samples in 20_usize..1500,
            dt_s in prop_oneof![0.001_f64..0.05, 0.1_f64..2.0],
            size_m in 0.2_f64..30.0,
            slenderness_rad in 0.02_f64..0.9,
            restitution in prop_oneof![Just(None), (0.0_f64..=1.0).prop_map(Some)],
            scales in prop::collection::vec(prop_oneof![0.1_f64..20.0, -20.0_f64..-0.1, Just(0.0)], 1..25),
            free in prop_oneof![Just(FreeRocking::FirstPeak), Just(FreeRocking::Lasting { duration_s: 0.0 })],
        ) {
            let record = record(samples, dt_s, seed);
            let mut block = RockingBlock::new(size_m, slenderness_rad).unwrap();
            if let Some(restitution) = restitution {
                block = block.with_restitution(restitution).unwrap();
            }
            let alone: Vec<_> = scales
                .iter()
                .map(|scale| bits(&respond(&block, &record.scaled(*scale).unwrap(), free).unwrap()))
                .collect();
            for instructions in Instructions::available() {
                let together = respond_with(instructions, &block, &record, &scales, free).unwrap();
                let together: Vec<_> = together.iter().map(bits).collect();
                prop_assert_eq!(&together, &alone, "{:?}", instructions);
            }
        }
    }

    // Whoever changes these bits raises NUMERICS: unfinished work of an earlier version is then not gone on with.
    #[test]
    fn the_version_of_the_numbers_goes_with_their_bits() {
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        for (seed, size_m) in [(1, 1.0), (2, 2.5), (3, 10.0)] {
            let block = RockingBlock::new(size_m, 0.2).unwrap();
            let scales = [0.5, 1.0, 1.5, 2.0, 3.0, 5.0];
            for response in
                respond_at_scales(&block, &record(1000, 0.01, seed), &scales, FreeRocking::FirstPeak).unwrap()
            {
                hash = (hash ^ response.rotation_rad.to_bits() ^ response.impacts).wrapping_mul(0x100_0000_01b3);
            }
        }
        assert_eq!((crate::NUMERICS, format!("{hash:016x}").as_str()), (2, "b11cd8459188e00a"));
    }

    #[test]
    fn refuses_what_a_motion_alone_refuses() {
        let (block, record) = (RockingBlock::new(1.0, 0.2).unwrap(), record(50, 0.01, 1));
        let message = |scale: f64| {
            respond_at_scales(&block, &record, &[1.0, scale], FreeRocking::FirstPeak).unwrap_err().to_string()
        };
        assert!(message(1e9).contains("ground acceleration"), "{}", message(1e9));
        assert!(message(f64::NAN).contains("NaN"), "{}", message(f64::NAN));
    }
}
