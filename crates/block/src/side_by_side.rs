//! One block under one record at many scale factors, several motions side by side, each at its own time.
//!
//! All motions take their next steps together: the [series](crate::series) are expanded in vectors, operation by
//! operation as that of a single motion. Of ten steps some nine go on to the end of a sample interval without an
//! impact, and without a peak that could be the largest; they end in vectors, too. What else is on a step, the
//! [motion](crate::motion) itself finds in the series, and it says what the next step is. What comes before uplift and
//! after the record, and series of a high order, are left to it altogether. So every response has the bits of
//! [`respond`](crate::respond).

use std::array::from_fn;
use std::ops::ControlFlow;

use uplift_instructions::{Instructions, Numbers, Vectors, Work};
use uplift_motion::Accelerogram;
use uplift_taylor::Forcing;

use crate::block::{LYING_RAD, RockingBlock};
use crate::error::BlockError;
use crate::excitation::{check_acceleration, set_line};
use crate::motion::{Motion, Segment};
use crate::observer::Unobserved;
use crate::response::{BlockResponse, FreeRocking, check_duration, rock_on};
use crate::rest::RestRule;
use crate::series::Series;
use crate::series::side_by_side::{Begins, Constants, LANES, Lanes, Outcome, SeriesOfAll, Step};

/// How far a bound must be from what it decides, relatively, for roundings not to matter.
const MARGIN: f64 = 1e-12;

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
    /// Whether a step may be as long as a sample interval.
    is_step: bool,
    /// Of every sample interval what [`Forcing::bound`](uplift_taylor::Forcing::bound) is of, at a scale of one.
    bounds_m_s2: Vec<f64>,
}

impl<'a> Sweep<'a> {
    fn new(block: &'a RockingBlock, record: &'a Accelerogram, free: FreeRocking) -> Self {
        let (samples_m_s2, dt_s) = (record.acceleration_m_s2(), record.dt_s());
        let bounds_m_s2 = samples_m_s2.windows(2).map(|pair| pair[0].abs() + (pair[1] - pair[0]).abs()).collect();
        let is_step = dt_s <= Motion::new(block, RestRule::Proven, Unobserved).longest_step_s();
        Self { block, samples_m_s2, dt_s, free, is_step, bounds_m_s2 }
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
    fn run<V: Vectors>(self, vectors: V) -> Self::Output {
        follow(vectors.few(), self.sweep, self.scales)
    }
}

/// What a motion asks for.
enum Next {
    /// A step.
    Step(Step),
    /// Nothing more.
    End(BlockResponse),
}

/// A motion, and where in the record it is.
struct Run<'a> {
    index: usize,
    scale: f64,
    motion: Motion<'a, Unobserved>,
    interval: usize,
    /// The sample interval as a segment; none before the motion has entered it.
    segment: Option<Segment>,
}

impl<'a> Run<'a> {
    fn new(sweep: &Sweep<'a>, index: usize, scale: f64) -> Self {
        let motion = Motion::new(sweep.block, RestRule::Proven, Unobserved);
        Self { index, scale, motion, interval: 0, segment: None }
    }

    fn enter(&mut self, sweep: &Sweep<'a>) -> &mut Segment {
        let begin_s = self.interval as f64 * sweep.dt_s;
        self.segment.insert(Segment::new(begin_s, sweep.dt_s, self.motion.impacts))
    }

    /// Goes on to the next step on which the record shakes the block.
    #[inline(never)]
    fn next(&mut self, sweep: &Sweep<'a>, series: &mut Series) -> Next {
        let (n, mut forcing) = (sweep.intervals(), Forcing::none());
        loop {
            if let Some(segment) = &mut self.segment {
                let samples = [self.interval, self.interval + 1].map(|i| self.scale * sweep.samples_m_s2[i]);
                let shaking = |offset_s, step_s, forcing: &mut Forcing| {
                    set_line(forcing, samples, sweep.dt_s, offset_s, step_s);
                };
                if let Some(step_s) = self.motion.next(segment, &mut forcing, shaking) {
                    return Next::Step(Step { ground: straight(&forcing), length_s: step_s });
                }
                self.interval += 1;
            }
            if self.motion.resting {
                // what the ground cannot lift; the motion itself says so where it is close
                let threshold = sweep.block.uplift_acceleration_m_s2() / self.scale.abs() * (1.0 - MARGIN);
                let quiet = sweep.bounds_m_s2[self.interval..].iter().position(|bound| *bound > threshold);
                self.interval = quiet.map_or(n, |quiet| self.interval + quiet);
            }
            if self.interval == n {
                let ending = rock_on(&mut self.motion, series, n as f64 * sweep.dt_s, sweep.free);
                return Next::End(BlockResponse::from_motion(&self.motion, ending));
            }
            self.enter(sweep);
        }
    }
}

/// The coefficients of a straight line.
fn straight(forcing: &Forcing) -> [f64; 2] {
    match *forcing.coefficients() {
        [begin, change, ..] => [begin, change],
        [begin] => [begin, 0.0],
        [] => [0.0; 2],
    }
}

#[inline(always)]
fn follow<N: Numbers<LANES>>(numbers: N, sweep: &Sweep<'_>, scales: &[f64]) -> Vec<BlockResponse> {
    let mut pending = scales.iter().enumerate();
    let mut responses = vec![None; scales.len()];
    let constants = Constants::new(sweep.block);
    let (mut steps, mut series, mut alone) = (Steps::NONE, SeriesOfAll::new(numbers), Series::EMPTY);
    let mut runs: [Option<Run<'_>>; LANES] = [const { None }; LANES];
    let (mut goes, mut ended) = (0, 0);
    loop {
        let stay = !(goes | ended);
        for (lane, run) in runs.iter_mut().enumerate().filter(|(lane, _)| stay >> lane & 1 != 0) {
            let mut next = run.as_mut().map(|run| steps.take(lane, run, sweep, &series, &mut alone));
            loop {
                match (&mut *run, next) {
                    (Some(run), Some(Next::Step(step))) => {
                        steps.put(lane, run, sweep, &step);
                        break;
                    }
                    (Some(run), Some(Next::End(response))) => responses[run.index] = Some(response),
                    _ => {}
                }
                *run = pending.next().map(|(index, scale)| Run::new(sweep, index, *scale));
                next = run.as_mut().map(|run| run.next(sweep, &mut alone));
                if next.is_none() {
                    steps.clear(lane);
                    ended |= 1 << lane;
                    break;
                }
            }
        }
        if ended == (1 << LANES) - 1 {
            return responses.into_iter().flatten().collect();
        }
        let outcome = series.expand(&constants, &steps.begins);
        goes = steps.rock_on(numbers, sweep, &outcome);
    }
}

/// The steps that the motions are about to take.
struct Steps {
    begins: Begins,
    /// 1 of steps to the end of a sample interval of a block that rocks, 0 of others.
    goes_on: Lanes,
    /// From the begin of the interval to the end of the step.
    end_s: Lanes,
    interval: [usize; LANES],
    scale: Lanes,
    /// From an acceleration of the ground to what the block feels, in units of g and in the frame of the corner.
    to_g: Lanes,
    peak: Lanes,
    peak_s: Lanes,
}

impl Steps {
    const NONE: Self = Self {
        begins: Begins::NONE,
        goes_on: [0.0; LANES],
        end_s: [0.0; LANES],
        interval: [0; LANES],
        scale: [0.0; LANES],
        to_g: [0.0; LANES],
        peak: [0.0; LANES],
        peak_s: [0.0; LANES],
    };

    fn clear(&mut self, lane: usize) {
        self.begins.clear(lane);
        (self.goes_on[lane], self.interval[lane]) = (0.0, 0);
    }

    fn put(&mut self, lane: usize, run: &Run<'_>, sweep: &Sweep<'_>, step: &Step) {
        let motion = &run.motion;
        self.begins.put(lane, (motion.x, motion.v), step);
        let end_s = run.segment.as_ref().and_then(|segment| segment.end_s(step.length_s));
        let goes_on = end_s.is_some() && !motion.resting && sweep.is_step;
        (self.goes_on[lane], self.end_s[lane]) = (f64::from(u8::from(goes_on)), end_s.unwrap_or(0.0));
        self.interval[lane] = run.interval;
        (self.scale[lane], self.to_g[lane]) = (run.scale, motion.side / sweep.block.gravity_m_s2());
        (self.peak[lane], self.peak_s[lane]) = (motion.peak, motion.peak_s);
    }

    /// Takes a step of a motion whose series is in `series`, and goes on to the next.
    #[inline(always)]
    fn take<'a, N: Numbers<LANES>>(
        &self,
        lane: usize,
        run: &mut Run<'a>,
        sweep: &Sweep<'a>,
        series: &SeriesOfAll<N>,
        alone: &mut Series,
    ) -> Next {
        let Begins { x, v, ground: [begin, change], length_s } = &self.begins;
        let motion = &mut run.motion;
        (motion.x, motion.v) = (x[lane], v[lane]);
        (motion.peak, motion.peak_s) = (self.peak[lane], self.peak_s[lane]);
        if run.interval != self.interval[lane] {
            run.interval = self.interval[lane];
            run.segment = None;
        }
        if run.interval < sweep.intervals() {
            if !series.write(lane, length_s[lane], alone) {
                let mut forcing = Forcing::none();
                forcing.set_line(begin[lane], change[lane]);
                run.motion.expand(alone, &forcing, length_s[lane]);
            }
            if run.segment.is_none() {
                run.enter(sweep);
            }
            if let Some(segment) = &mut run.segment
                && let ControlFlow::Break(ending) = run.motion.take(segment, alone, false)
            {
                return Next::End(BlockResponse::from_motion(&run.motion, Some(ending)));
            }
        }
        run.next(sweep, alone)
    }

    /// Moves what rocks on, without an impact and without a peak inside that could be the largest, to the end of the
    /// sample interval, the begin of the next: a bit for each that does and has not reached the end of the record. The
    /// others stay.
    #[inline(always)]
    fn rock_on<N: Numbers<LANES>>(&mut self, n: N, sweep: &Sweep<'_>, outcome: &Outcome<N::F64s>) -> u32 {
        let one = n.splat(1.0);
        let goes = self.rocks_on(n, outcome);
        let choose = |new, old| n.if_at_most(one, goes, new, old);
        let peak = n.load(&self.peak);
        let end_s: Lanes = from_fn(|i| self.interval[i] as f64 * sweep.dt_s + self.end_s[i]);
        let [old_s, end_s] = [&self.peak_s, &end_s].map(|own| n.load(own));
        self.peak_s = n.store(n.if_at_most(outcome.x, peak, old_s, choose(end_s, old_s)));
        self.peak = n.store(choose(n.larger(outcome.x, peak), peak));
        self.begins.x = n.store(choose(outcome.x, n.load(&self.begins.x)));
        self.begins.v = n.store(choose(outcome.v, n.load(&self.begins.v)));
        let dt_s = n.splat(sweep.dt_s);
        self.end_s = n.store(choose(dt_s, n.load(&self.end_s)));
        self.begins.length_s = n.store(choose(dt_s, n.load(&self.begins.length_s)));
        let moved = n.at_most(one, goes);
        let last = sweep.intervals() - 1;
        self.interval = from_fn(|i| self.interval[i] + (moved >> i & 1) as usize);
        let samples: [Lanes; 2] = [0, 1].map(|next| from_fn(|i| sweep.samples_m_s2[self.interval[i].min(last) + next]));
        let (scale, to_g) = (n.load(&self.scale), n.load(&self.to_g));
        let [begin, end] = samples.map(|own| n.mul(scale, n.load(&own)));
        let [old_begin, old_change] = self.begins.ground.map(|own| n.load(&own));
        let ground = [choose(n.mul(begin, to_g), old_begin), choose(n.mul(n.sub(end, begin), to_g), old_change)];
        self.begins.ground = ground.map(|own| n.store(own));
        (0..LANES).filter(|i| self.interval[*i] <= last).fold(0, |bits, i| bits | moved & (1 << i))
    }

    /// 1 of what rocks on to the end of a sample interval without an impact and without a peak inside that could be the
    /// largest, 0 of what perhaps does not.
    #[inline(always)]
    fn rocks_on<N: Numbers<LANES>>(&self, n: N, outcome: &Outcome<N::F64s>) -> N::F64s {
        let &Outcome { x: x_end, v: v_end, reach, change, acceleration, bend, open, first } = outcome;
        let [x, v] = [&self.begins.x, &self.begins.v].map(|own| n.load(own));
        let (zero, margin) = (n.splat(0.0), n.splat(MARGIN));
        // x falls by less than the second term and all later ones together
        let fall = n.sub(first, n.sub(n.sub(reach, x), n.abs(first)));
        let lowest = n.add(x, n.if_at_most(fall, zero, fall, zero));
        // x rises by less than its positive terms
        let top = n.add(n.mul(n.splat(0.5), n.add(x_end, reach)), n.mul(margin, reach));
        let speed = n.abs(v);
        let goes = n.load(&self.goes_on);
        let is_one_way = n.if_at_most(n.mul(n.splat(1.0 + MARGIN), change), speed, goes, zero);
        let has_no_peak = n.if_at_most(top, n.load(&self.peak), goes, is_one_way);
        // a velocity that grows or falls all the time has the signs of its ends
        let least = n.mul(margin, n.mul(speed, n.add(speed, change)));
        let keeps_sign = n.if_at_most(least, n.mul(v, v_end), goes, zero);
        let is_steady = n.if_at_most(n.mul(n.splat(1.0 + MARGIN), bend), n.abs(acceleration), keeps_sign, zero);
        let has_no_peak = n.larger(has_no_peak, is_steady);
        let least = n.mul(margin, reach);
        // from the ground it rises if no later terms can outweigh the first
        let leaves = n.if_at_most(x, zero, n.if_at_most(least, fall, has_no_peak, zero), zero);
        let stays_up = n.if_at_most(least, lowest, has_no_peak, leaves);
        let ends_up = n.if_at_most(n.splat(f64::MIN_POSITIVE), x_end, stays_up, zero);
        let stays = n.if_at_most(reach, n.splat(LYING_RAD * (1.0 - MARGIN)), ends_up, zero);
        n.if_at_most(open, zero, stays, zero)
    }
}

#[cfg(test)]
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
