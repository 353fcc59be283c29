//! Several runs of one oscillator under one record side by side, each at its own time: they go from
//! event to event together.
//!
//! All of them are attached, then all of them are uplifted, each wherever it has come to in the record. So an event of
//! one does not delay the others, and the [events](crate::events) of all are found together. Each run is computed as
//! if it were alone: its bits do not depend on the runs beside it.

use uplift_instructions::{Portable, Vectors};

use crate::ahead::larger;
use crate::events::{Attached, Segments};
use crate::run::{Phase, Run, Segment};
use crate::sweep::{Peak, Sweep};

/// A run that is not started yet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PendingRun {
    /// Where its peak belongs.
    pub(crate) index: usize,
    pub(crate) scale: f64,
    /// Interval of the first uplift.
    pub(crate) interval: usize,
}

struct Lane<'a, const STIFFNESS: bool> {
    index: usize,
    run: Run<'a, STIFFNESS>,
    phase: Phase,
}

/// Follow all of `pending` to their ends and put their peaks where they belong.
///
/// * `RUNS` — how many are followed side by side
/// * `STIFFNESS` — whether there is a post-uplift stiffness
#[inline(always)]
pub(crate) fn follow<V: Vectors, const RUNS: usize, const STIFFNESS: bool>(
    vectors: V,
    sweep: &Sweep<'_>,
    pending: &[PendingRun],
    peaks: &mut [Peak],
) {
    match sweep.terms {
        Some(terms) => follow_together::<V, RUNS, STIFFNESS>(vectors, sweep, terms, pending, peaks),
        None => follow_alone::<STIFFNESS>(sweep, pending, peaks),
    }
}

/// One by one, where the series do not suffice: seldom, so it is compiled once, for any processor.
#[inline(never)]
fn follow_alone<const STIFFNESS: bool>(sweep: &Sweep<'_>, pending: &[PendingRun], peaks: &mut [Peak]) {
    for &PendingRun { index, scale, interval } in pending {
        let mut run = Run::<STIFFNESS>::new(sweep, scale);
        let phase = run.follow(Portable, run.start(interval));
        peaks[index] = run.peak(phase);
    }
}

#[inline(always)]
fn follow_together<V: Vectors, const RUNS: usize, const STIFFNESS: bool>(
    vectors: V,
    sweep: &Sweep<'_>,
    terms: usize,
    pending: &[PendingRun],
    peaks: &mut [Peak],
) {
    let (k, growth, boundary) = (sweep.attached.stiffness_per_s2, sweep.growth, sweep.boundary_m);
    let branch = Attached { k, growth, terms, boundary };
    let mut pending = pending.iter();
    let mut lanes: [Option<Lane<'_, STIFFNESS>>; RUNS] = [const { None }; RUNS];
    loop {
        for lane in &mut lanes {
            if let Some(Lane { index, run, phase }) = lane.take_if(|lane| lane.phase.is_over()) {
                peaks[index] = run.peak(phase);
            }
            if lane.is_none() {
                *lane = pending.next().map(|next| {
                    let run = Run::<STIFFNESS>::new(sweep, next.scale);
                    let phase = run.start(next.interval);
                    Lane { index: next.index, run, phase }
                });
            }
        }
        if lanes.iter().all(Option::is_none) {
            return;
        }
        attached(vectors, sweep, &branch, &mut lanes);
        uplifted(vectors, sweep, &mut lanes);
    }
}

/// All attached runs to their next uplift.
#[inline(always)]
fn attached<V: Vectors, const RUNS: usize, const STIFFNESS: bool>(
    vectors: V,
    sweep: &Sweep<'_>,
    branch: &Attached,
    lanes: &mut [Option<Lane<'_, STIFFNESS>>; RUNS],
) {
    let (n, k) = (sweep.ground.intervals(), branch.k);
    // the rest of the intervals of the impacts
    let mut motions = Segments::<RUNS>::EMPTY;
    for (i, lane) in lanes.iter().enumerate() {
        if let Some(Lane { run, phase: Phase::Attached(at), .. }) = lane
            && at.interval < n
        {
            motions.put(i, &run.motion(at, k), sweep.dt_s - at.offset_s);
        }
    }
    motions.advance(branch);
    let stays_inside = motions.stay_inside(branch);
    // the intervals of the uplifts
    let mut segments: [Option<Segment>; RUNS] = [None; RUNS];
    for (i, lane) in lanes.iter_mut().enumerate() {
        let Some(Lane { run, phase, .. }) = lane else { continue };
        let Phase::Attached(at) = *phase else { continue };
        if at.interval == n {
            *phase = Phase::RecordEnd(0.0, at.u, at.v);
        } else if stays_inside[i] {
            match run.seek_uplift(vectors, at.interval + 1, &motions.end(i)) {
                Err(over) => *phase = over,
                Ok(segment) => {
                    motions.put(i, &segment.motion, segment.h);
                    motions.put_end(i, &segment.end);
                    segments[i] = Some(segment);
                }
            }
        } else {
            segments[i] = Some(Segment { at, motion: motions.motion(i, k), h: motions.h[i], end: motions.end(i) });
        }
    }
    let found = motions.uplifts(branch);
    for (i, lane) in lanes.iter_mut().enumerate() {
        if let (Some(Lane { run, phase, .. }), Some(segment)) = (lane, &segments[i]) {
            *phase = match found.crossing(i) {
                Some(crossing) => run.uplift(crossing, &segment.at),
                None => run.attached_from(vectors, segment),
            };
        }
    }
}

/// All uplifted runs to their next impact.
#[inline(always)]
fn uplifted<V: Vectors, const RUNS: usize, const STIFFNESS: bool>(
    vectors: V,
    sweep: &Sweep<'_>,
    lanes: &mut [Option<Lane<'_, STIFFNESS>>; RUNS],
) {
    let (n, boundary) = (sweep.ground.intervals(), sweep.boundary_m);
    // the intervals of the impacts, each in the coordinates of its side
    let mut motions = Segments::<RUNS>::EMPTY;
    let mut segments: [Option<(f64, Segment)>; RUNS] = [None; RUNS];
    for (i, lane) in lanes.iter_mut().enumerate() {
        let Some(Lane { run, phase, .. }) = lane else { continue };
        let Phase::Uplifted(side, at) = *phase else { continue };
        if at.interval == n {
            *phase = Phase::RecordEnd(side, at.u, at.v);
            continue;
        }
        let mut segment = run.rest_of_interval_uplifted(side, at);
        *phase = loop {
            if !STIFFNESS && side * segment.end.u < boundary {
                motions.put(i, &segment.motion.on(side), segment.h);
                motions.put_end(i, &segment.end.on(side));
                segments[i] = Some((side, segment));
                break *phase;
            }
            if let Some(crossing) = run.uplifted_interval(side, &segment) {
                break run.impact(crossing, side, &segment.at);
            }
            match run.seek_impact(vectors, side, segment.at.interval + 1, &segment.end) {
                Ok(further) => segment = further,
                Err(over) => break over,
            }
        };
    }
    let (found, tops) = motions.impacts(boundary);
    for (i, lane) in lanes.iter_mut().enumerate() {
        if let (Some(Lane { run, phase, .. }), Some((side, segment))) = (lane, &segments[i]) {
            *phase = match found.crossing(i) {
                Some(crossing) => {
                    run.peak_m = larger(tops[i], run.peak_m);
                    run.impact(crossing.on(*side), *side, &segment.at)
                }
                None => run.uplifted_from(vectors, *side, segment),
            };
        }
    }
}
