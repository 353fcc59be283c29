//! One frame under many ground motions, several courses side by side.
//!
//! A series is a chain of operations that wait for each other, and the processor could do several such chains in the
//! same time. So each course goes on alone to its next step, all these are expanded together in vectors, operation by
//! operation as one alone ([`crate::series`]), and each goes through its own. What the vectors do not have, restrainers
//! without a straight law, pulses, series of high order, is expanded alone: every demand has the bits of
//! [`respond`](crate::respond).

use uplift_instructions::{Instructions, Vectors, Work};

use crate::course::{Course, Next};
use crate::error::FrameError;
use crate::frame::RockingFrame;
use crate::ground::GroundMotion;
use crate::history::Unobserved;
use crate::motion::{Asked, Ending};
use crate::response::{FrameDemand, Model, Options, course, demand_of};
use crate::series::{Begin, Begins, Expansion, LANES, SeriesOfAll, Step};

/// Courses that go on at a time: of so many there are mostly enough whose next series are about as long.
const POOL: usize = 3 * LANES;

/// Demands of `frame` under each of `grounds`: to the bit those of [`respond`](crate::respond), in half the time.
///
/// # Errors
/// As [`respond`](crate::respond), of each by itself.
pub fn demands(
    frame: &RockingFrame,
    grounds: &[GroundMotion<'_>],
    model: Model,
    options: &Options,
) -> Vec<Result<FrameDemand, FrameError>> {
    demands_with(Instructions::chosen(), frame, grounds, model, options)
}

fn demands_with(
    instructions: Instructions,
    frame: &RockingFrame,
    grounds: &[GroundMotion<'_>],
    model: Model,
    options: &Options,
) -> Vec<Result<FrameDemand, FrameError>> {
    match model {
        Model::Planar => instructions.run(Following::<false> { instructions, frame, grounds, model, options }),
        Model::Wobbling => instructions.run(Following::<true> { instructions, frame, grounds, model, options }),
    }
}

struct Following<'a, const WOBBLES: bool> {
    instructions: Instructions,
    frame: &'a RockingFrame,
    grounds: &'a [GroundMotion<'a>],
    model: Model,
    options: &'a Options,
}

#[cfg(test)]
thread_local! {
    /// Steps that were expanded together.
    static TOGETHER: std::cell::Cell<u64> = const { std::cell::Cell::new(0) };
}

type Demand = Result<FrameDemand, FrameError>;

/// A course under the ground motion of an index.
struct Going<'a> {
    index: usize,
    course: Course<'a, Unobserved<false>>,
    /// The step that it waits for.
    waits: Option<(Asked, Begin)>,
    demand: Option<Demand>,
}

impl<const WOBBLES: bool> Work for Following<'_, WOBBLES> {
    type Output = Vec<Demand>;

    #[inline(always)]
    fn run<V: Vectors>(self, _: V) -> Self::Output {
        let Self { instructions, frame, grounds, model, options } = self;
        let mut pending = grounds.iter().enumerate();
        let mut demands: Vec<Option<Demand>> = grounds.iter().map(|_| None).collect();
        let mut going: Vec<Going<'_>> = Vec::with_capacity(POOL);
        let mut alone = Expansion::new(instructions);
        let (mut begins, mut series, mut step) = (Begins::NONE, SeriesOfAll::<WOBBLES>::NONE, Step::NONE);
        loop {
            let room = POOL - going.len();
            for (index, ground) in pending.by_ref().take(room) {
                match course(frame, ground, model, options, Unobserved) {
                    Ok(course) => going.push(Going { index, course, waits: None, demand: None }),
                    Err(error) => demands[index] = Some(Err(error)),
                }
            }
            for own in going.iter_mut().filter(|own| own.waits.is_none()) {
                own.go_on::<WOBBLES>(frame, &mut alone);
            }
            going.retain_mut(|own| own.demand.take().map(|demand| demands[own.index] = Some(demand)).is_none());
            if going.len() < POOL && pending.len() > 0 {
                continue;
            }
            let Some(first) = going.first() else { return demands.into_iter().flatten().collect() };
            // those of which there are more: a vector is as long as its longest series
            let is_long = |own: &Going<'_>| own.waits.is_some_and(|(asked, _)| asked.is_long);
            let are_long = 2 * going.iter().filter(|own| is_long(own)).count() > going.len();
            let constants = *first.course.motion.constants();
            let mut chosen = [0; LANES];
            let mut count = 0;
            begins.clear();
            for (place, own) in going.iter().enumerate().filter(|(_, own)| is_long(own) == are_long).take(LANES) {
                let Some((_, begin)) = &own.waits else { continue };
                begins.put(count, begin);
                chosen[count] = place;
                count += 1;
            }
            series.expand(&constants, &begins);
            for (lane, &place) in chosen[..count].iter().enumerate() {
                let is_written = series.write(lane, &begins, &mut step);
                going[place].step(frame, &mut alone, is_written.then_some(&step));
            }
        }
    }
}

impl Going<'_> {
    /// Goes on alone until it waits for a step, or has ended.
    fn go_on<const WOBBLES: bool>(&mut self, frame: &RockingFrame, alone: &mut Expansion) {
        while self.demand.is_none() && self.waits.is_none() {
            match self.course.next() {
                Ok(Next::Step(asked)) => {
                    let begin = self.course.motion.begin::<WOBBLES>(self.course.shaken(), &asked);
                    self.waits = begin.map(|begin| (asked, begin));
                    if begin.is_none() {
                        let taken = self.course.step_alone(alone, asked);
                        self.see(frame, taken);
                    }
                }
                Ok(Next::End(ending)) => self.end(frame, Ok(ending)),
                Err(error) => self.end(frame, Err(error)),
            }
        }
    }

    /// Through the step that it waits for: that which was expanded for it, or else one expanded alone.
    fn step(&mut self, frame: &RockingFrame, alone: &mut Expansion, expanded: Option<&Step>) {
        let Some((asked, _)) = self.waits.take() else { return };
        let taken = match expanded {
            Some(step) => {
                #[cfg(test)]
                TOGETHER.set(TOGETHER.get() + 1);
                self.course.take(step, asked.step_s)
            }
            None => self.course.step_alone(alone, asked),
        };
        self.see(frame, taken);
    }

    /// After a step.
    fn see(&mut self, frame: &RockingFrame, taken: Result<Option<Ending>, FrameError>) {
        match taken {
            Ok(None) => {}
            Ok(ending) => self.end(frame, Ok(ending)),
            Err(error) => self.end(frame, Err(error)),
        }
    }

    fn end(&mut self, frame: &RockingFrame, ending: Result<Option<Ending>, FrameError>) {
        self.demand = Some(ending.map(|ending| demand_of(frame, &self.course.motion, ending)));
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use uplift_motion::Accelerogram;
    use uplift_statics::{DiscDimensions, DiscSpring, DiscStack, Parts, Restrainer, Stopper, TendonPath};
    use uplift_structure::Geometry;

    use super::*;
    use crate::{ColumnShape, Until, respond};

    /// A burst of noise that swells and fades, m/s².
    fn record(samples: usize, dt_s: f64, seed: u64, scale: f64) -> Accelerogram {
        let mut state = seed;
        let (mut last, mut noise) = (0.0, Vec::new());
        for i in 0..samples {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let white = (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
            last += 0.3 * (white - last);
            noise.push(scale * 5.0 * last * (i as f64 / samples as f64 * 3.0).sin());
        }
        Accelerogram::new(dt_s, noise).unwrap()
    }

    /// The frame of the shaking table: free, on prestressed tendons, on springs, or on disc springs with stoppers.
    fn frame(shape: ColumnShape, restrainer: usize) -> RockingFrame {
        let column = Geometry::from_width_and_height(0.197, 1.45).unwrap();
        let frame = RockingFrame::new(column, 4, 124.4, 9435.0, shape, 9.81).unwrap();
        let disc = DiscSpring::new(DiscDimensions {
            outer_diameter_m: 0.125,
            inner_diameter_m: 0.061,
            thickness_m: 0.006,
            cone_height_m: 0.0036,
            reduced_thickness_m: None,
        });
        let stopper = Some(Stopper { gap_m: 0.015, stiffness_n_m: 20e6, yield_n: Some(54e3) });
        let parts = match restrainer {
            0 => return frame,
            1 => Parts { prestress_n: 20e3, ..Parts::linear(1720e3) },
            2 => Parts::linear(1720e3),
            _ => Parts { stopper, ..Parts::discs(DiscStack::new(disc.unwrap(), 10, 1).unwrap(), 13_318e3) },
        };
        frame.with_restrainer(Restrainer::new(parts).unwrap(), TendonPath::Column).unwrap()
    }

    fn bits(demand: &Demand) -> Result<(u64, u64), String> {
        demand.as_ref().map(|demand| (demand.displacement_m.to_bits(), demand.impacts)).map_err(ToString::to_string)
    }

    #[test]
    fn steps_of_a_free_frame_are_expanded_together() {
        for (shape, model) in [(ColumnShape::Rectangle, Model::Planar), (ColumnShape::Cylinder, Model::Wobbling)] {
            let (x, y) = (record(300, 0.01, 1, 2.0), record(300, 0.01, 2, 2.0));
            let before = TOGETHER.get();
            let found = demands(&frame(shape, 0), &[GroundMotion::pair(&x, &y); 5], model, &Options::default());
            assert!(found.iter().all(|demand| demand.as_ref().unwrap().displacement_m > 0.0), "{found:?}");
            assert!(TOGETHER.get() - before > 500, "{model:?}: {}", TOGETHER.get() - before);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]

        #[test]
        fn every_demand_has_the_bits_of_the_motion_alone(
            seed in 0_u64..1_000_000,
            samples in (20_usize..700, 20_usize..700),
            dt_s in 0.002_f64..0.02,
            restrainer in 0_usize..4,
            wobbles in any::<bool>(),
            shaken in (any::<bool>(), any::<bool>()),
            restitution in prop_oneof![Just(None), (0.3_f64..=1.0).prop_map(Some)],
            lasting_s in prop_oneof![Just(None), (1.0_f64..9.0).prop_map(Some)],
            scales in prop::collection::vec(0.1_f64..4.0, 1..40),
        ) {
            let model = if wobbles { Model::Wobbling } else { Model::Planar };
            let shape = if wobbles { ColumnShape::Cylinder } else { ColumnShape::Rectangle };
            let frame = frame(shape, restrainer);
            let until = lasting_s.map_or(Until::FirstFreePeak, Until::Time);
            let options = Options { until, restitution, ..Options::default() };
            // mostly of one length, as the components of a pair are
            let across = if seed % 4 == 0 { samples.1 } else { samples.0 };
            let records: Vec<[Accelerogram; 3]> = scales
                .iter()
                .enumerate()
                .map(|(at, scale)| {
                    // some end earlier than others
                    let [along, across] = [samples.0, across].map(|samples| if at % 5 == 4 { 12 } else { samples });
                    [(along, seed, *scale), (across, seed + 1, *scale), (across, seed + 2, 0.2 * scale)]
                        .map(|(samples, seed, scale)| record(samples, dt_s, seed, scale))
                })
                .collect();
            let grounds: Vec<GroundMotion<'_>> = records
                .iter()
                .enumerate()
                .map(|(at, [x, y, z])| GroundMotion {
                    // of some sets a few keep their plane
                    y: (shaken.0 && (seed % 3 > 0 || at % 3 > 0)).then_some(crate::Shaking::Record(y)),
                    z: shaken.1.then_some(crate::Shaking::Record(z)),
                    ..GroundMotion::along_x(x)
                })
                .collect();
            let all: Vec<Demand> = grounds
                .iter()
                .map(|ground| {
                    let response = respond(&frame, ground, model, &options)?;
                    Ok(FrameDemand { displacement_m: response.displacement.value, impacts: response.impacts })
                })
                .collect();
            let expected: Vec<_> = all.iter().map(bits).collect();
            for instructions in Instructions::available() {
                let together = demands_with(instructions, &frame, &grounds, model, &options);
                let together: Vec<_> = together.iter().map(bits).collect();
                prop_assert_eq!(&together, &expected, "{:?}", instructions);
            }
        }
    }
}
