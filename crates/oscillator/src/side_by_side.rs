//! Several runs of one oscillator under one record side by side, each at its own time: they go from event to event together.
//!
//! All of them are attached, then all of them are uplifted, each wherever it has come to in the record. So an event of one does not hold up the
//! others, and the [events](crate::events) of all are found together. Each run is computed as if it were alone: its bits do not depend on its
//! neighbours.

use crate::ahead::larger;
use crate::events::{Attached, Stretches};
use crate::run::{Phase, Run, Stretch};
use crate::sweep::{Peak, Sweep};

/// A run that waits for its turn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Waiting {
    /// Where its peak belongs.
    pub(crate) index: usize,
    pub(crate) scale: f64,
    /// Interval of the first uplift.
    pub(crate) interval: usize,
}

struct Lane<'a, const STIFF: bool> {
    index: usize,
    run: Run<'a, STIFF>,
    phase: Phase,
}

/// Follow all of `waiting` to their ends and put their peaks where they belong.
///
/// * `RUNS` — how many are followed side by side
/// * `STIFF` — whether there is a post-uplift stiffness
#[inline(always)]
pub(crate) fn follow<const RUNS: usize, const STIFF: bool>(sweep: &Sweep<'_>, waiting: &[Waiting], peaks: &mut [Peak]) {
    match sweep.terms {
        Some(terms) => follow_together::<RUNS, STIFF>(sweep, terms, waiting, peaks),
        None => follow_alone::<STIFF>(sweep, waiting, peaks),
    }
}

/// One by one, where the series do not serve.
#[inline(always)]
fn follow_alone<const STIFF: bool>(sweep: &Sweep<'_>, waiting: &[Waiting], peaks: &mut [Peak]) {
    for &Waiting { index, scale, interval } in waiting {
        let mut run = Run::<STIFF>::new(sweep, scale);
        let phase = run.follow(run.start(interval));
        peaks[index] = run.peak(phase);
    }
}

#[inline(always)]
fn follow_together<const RUNS: usize, const STIFF: bool>(
    sweep: &Sweep<'_>,
    terms: usize,
    waiting: &[Waiting],
    peaks: &mut [Peak],
) {
    let (k, growth, boundary) = (sweep.attached.stiffness_per_s2, sweep.growth, sweep.boundary_m);
    let branch = Attached { k, growth, terms, boundary };
    let mut waiting = waiting.iter();
    let mut lanes: [Option<Lane<'_, STIFF>>; RUNS] = [const { None }; RUNS];
    loop {
        for lane in &mut lanes {
            if let Some(Lane { index, run, phase }) = lane.take_if(|lane| lane.phase.is_over()) {
                peaks[index] = run.peak(phase);
            }
            if lane.is_none() {
                *lane = waiting.next().map(|next| {
                    let run = Run::<STIFF>::new(sweep, next.scale);
                    let phase = run.start(next.interval);
                    Lane { index: next.index, run, phase }
                });
            }
        }
        if lanes.iter().all(Option::is_none) {
            return;
        }
        attached(sweep, &branch, &mut lanes);
        uplifted(sweep, &mut lanes);
    }
}

/// All attached runs to their next uplift.
#[inline(always)]
fn attached<const RUNS: usize, const STIFF: bool>(
    sweep: &Sweep<'_>,
    branch: &Attached,
    lanes: &mut [Option<Lane<'_, STIFF>>; RUNS],
) {
    let (n, k) = (sweep.ground.intervals(), branch.k);
    // the rest of the intervals of the impacts
    let mut motions = Stretches::<RUNS>::IDLE;
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
    let mut stretches: [Option<Stretch>; RUNS] = [None; RUNS];
    for (i, lane) in lanes.iter_mut().enumerate() {
        let Some(Lane { run, phase, .. }) = lane else { continue };
        let Phase::Attached(at) = *phase else { continue };
        if at.interval == n {
            *phase = Phase::RecordEnd(0.0, at.u, at.v);
        } else if stays_inside[i] {
            match run.seek_uplift(at.interval + 1, &motions.end(i)) {
                Err(over) => *phase = over,
                Ok(stretch) => {
                    motions.put(i, &stretch.motion, stretch.h);
                    motions.put_end(i, &stretch.end);
                    stretches[i] = Some(stretch);
                }
            }
        } else {
            stretches[i] = Some(Stretch { at, motion: motions.motion(i, k), h: motions.h[i], end: motions.end(i) });
        }
    }
    let found = motions.uplifts(branch);
    for (i, lane) in lanes.iter_mut().enumerate() {
        if let (Some(Lane { run, phase, .. }), Some(stretch)) = (lane, &stretches[i]) {
            *phase = match found.passage(i) {
                Some(passage) => run.uplift(passage, &stretch.at),
                None => run.attached_from(stretch),
            };
        }
    }
}

/// All uplifted runs to their next impact.
#[inline(always)]
fn uplifted<const RUNS: usize, const STIFF: bool>(sweep: &Sweep<'_>, lanes: &mut [Option<Lane<'_, STIFF>>; RUNS]) {
    let (n, boundary) = (sweep.ground.intervals(), sweep.boundary_m);
    // the intervals of the landings, each told on its own side
    let mut motions = Stretches::<RUNS>::IDLE;
    let mut stretches: [Option<(f64, Stretch)>; RUNS] = [None; RUNS];
    for (i, lane) in lanes.iter_mut().enumerate() {
        let Some(Lane { run, phase, .. }) = lane else { continue };
        let Phase::Uplifted(side, at) = *phase else { continue };
        if at.interval == n {
            *phase = Phase::RecordEnd(side, at.u, at.v);
            continue;
        }
        let mut stretch = run.rest_of_interval_uplifted(side, at);
        *phase = loop {
            if !STIFF && side * stretch.end.u < boundary {
                motions.put(i, &stretch.motion.on(side), stretch.h);
                motions.put_end(i, &stretch.end.on(side));
                stretches[i] = Some((side, stretch));
                break *phase;
            }
            if let Some(passage) = run.uplifted_interval(side, &stretch) {
                break run.impact(passage, side, &stretch.at);
            }
            match run.seek_landing(side, stretch.at.interval + 1, &stretch.end) {
                Ok(further) => stretch = further,
                Err(over) => break over,
            }
        };
    }
    let (found, tops) = motions.landings(boundary);
    for (i, lane) in lanes.iter_mut().enumerate() {
        if let (Some(Lane { run, phase, .. }), Some((side, stretch))) = (lane, &stretches[i]) {
            *phase = match found.passage(i) {
                Some(passage) => {
                    run.peak_m = larger(tops[i], run.peak_m);
                    run.impact(passage.on(*side), *side, &stretch.at)
                }
                None => run.uplifted_from(*side, stretch),
            };
        }
    }
}
