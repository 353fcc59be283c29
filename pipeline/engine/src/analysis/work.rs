//! Plans with their labels, and the carrying out of them.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use sha2::{Digest, Sha256};
use uplift_ida::{AnalysisRow, Cells, IdaError, Peaks, Plan, Shard, estimate};
use uplift_job::events::{Events, Progress};
use uplift_job::machine::{Needs, PROGRAM_BYTES};
use uplift_job::text::thousands;
use uplift_labelled::hexadecimal;

use crate::checkpoint::{Checkpoint, FinishedRows, RowFile, RowFileHead, RowKey, RowKeys};
use crate::error::EngineError;

/// A plan with its remark.
#[derive(Debug)]
pub struct LabelledPlan<'a> {
    /// What is worked on: a measure, a record set, a model.
    pub label: String,
    /// A remark when it begins, topic and text.
    pub remark: Option<(String, String)>,
    /// The plan.
    pub plan: Plan<'a>,
    /// Keys of its motions (see [`motion_key`](uplift_job::checksum::motion_key)).
    pub motions: &'a [String],
    /// What is known of it from elsewhere than a checkpoint.
    pub known: Option<Cells>,
}

/// The result of a plan.
#[derive(Debug, Clone)]
pub struct Analysed {
    /// The peaks.
    pub peaks: Peaks,
    /// Nonlinear time histories.
    pub analyses: u64,
    /// Those of them that were not known from before.
    pub computed: u64,
    /// Wall time for these, s.
    pub seconds: f64,
}

/// All analyses that a job asks for.
#[derive(Debug)]
pub struct Work<'a> {
    pub(super) title: String,
    plans: Vec<LabelledPlan<'a>>,
    /// Of each plan.
    keys: Vec<RowKeys>,
}

impl<'a> Work<'a> {
    /// The work of `plans`; `title` is reported with files of its rows.
    pub fn new(title: &str, plans: Vec<LabelledPlan<'a>>) -> Self {
        let keys = plans.iter().map(|labelled| RowKeys::from_plan(&labelled.plan, labelled.motions)).collect();
        Self { title: title.to_owned(), plans, keys }
    }

    /// The head of the file of one shard.
    pub(super) fn head(&self, shard: Shard) -> RowFileHead {
        let mut hash = Sha256::new();
        for key in self.keys.iter().flat_map(RowKeys::as_slice) {
            hash.update(key.0);
        }
        let place = [shard.index + 1, shard.count];
        let a_peak = self.plans.iter().map(|labelled| labelled.plan.histories_per_peak()).max().unwrap_or(1);
        let analyses = [self.analyses_of(shard), a_peak as u64];
        RowFileHead::new(hexadecimal(&hash.finalize()), &self.title, place, analyses)
    }

    /// Analyses of one shard.
    fn analyses_of(&self, shard: Shard) -> u64 {
        self.plans.iter().map(|labelled| labelled.plan.analyses() / shard.count).sum()
    }

    /// How many of the rows of one shard are among `rows`, and how many there are.
    pub(super) fn share_of(&self, shard: Shard, rows: &FinishedRows) -> [u64; 2] {
        let found = self.keys_of(shard).filter(|key| rows.contains(*key)).count();
        [found as u64, self.keys_of(shard).count() as u64]
    }

    /// Nonlinear time histories of all plans.
    pub fn analyses(&self) -> u64 {
        self.plans.iter().map(|labelled| labelled.plan.analyses()).sum()
    }

    /// What carrying it out takes: its peaks and impacts, held and written.
    pub(super) fn needs(&self) -> Needs {
        let cells: u64 = self.plans.iter().map(|labelled| labelled.plan.axes().cells() as u64).sum();
        let held = cells.saturating_mul(13);
        let samples = |labelled: &LabelledPlan<'_>| -> u64 {
            let samples: u64 = labelled.plan.motions().iter().map(|motion| motion.accelerogram.len() as u64).sum();
            samples * labelled.plan.histories_per_peak() as u64
        };
        let samples = self.plans.iter().map(samples).max().unwrap_or_default();
        let memory_bytes = held.saturating_add(PROGRAM_BYTES).saturating_add(64 * samples);
        Needs { memory_bytes, disk_bytes: held.saturating_add(1_000_000), disk_least_bytes: held / 13 * 12 }
    }

    fn keys_of(&self, shard: Shard) -> impl Iterator<Item = RowKey> + '_ {
        let of_plan = move |keys: &'_ RowKeys| -> Vec<RowKey> {
            let rows = keys.as_slice().iter().enumerate();
            rows.filter(|(row, _)| shard.contains(*row)).map(|(_, key)| *key).collect()
        };
        self.keys.iter().flat_map(of_plan)
    }

    /// The checkpoint at `path` of one shard, with the rows that it holds. The caller sees to it that no other job has
    /// it too.
    ///
    /// # Errors
    /// A file that cannot be written, or that holds something else.
    pub fn open_checkpoint(&self, path: &Path, shard: Shard) -> Result<Checkpoint, EngineError> {
        Checkpoint::open(path, &self.head(shard), || self.keys_of(shard).collect())
    }

    /// Removes the checkpoint at `path` that a run of this work left which was killed when its result was in place. One
    /// of other work, or that holds rows of other work too, stays.
    pub fn clear_checkpoint(&self, path: &Path) {
        if RowFile::read(path).is_ok_and(|found| found.is_some_and(|found| found.is_all_of(&self.head(Shard::WHOLE)))) {
            // where it cannot be removed it is in nobody's way
            let _ = std::fs::remove_file(path);
        }
    }

    /// Carries out one shard, plan after plan: finished rows go to the checkpoint, and if the shard is the whole, each
    /// plan's place and result to `each`.
    ///
    /// # Errors
    /// [`JobError::Paused`](uplift_job::JobError::Paused) where the user stopped it,
    /// [`JobError::Interrupted`](uplift_job::JobError::Interrupted) if there is no file; a file that can no longer be
    /// written, which stops it too; what `each` ends with.
    pub fn carry_out(
        self,
        checkpoint: &Checkpoint,
        shard: Shard,
        events: &dyn Events,
        each: &mut dyn FnMut(usize, Analysed) -> Result<(), EngineError>,
    ) -> Result<(), EngineError> {
        if let (Some(path), bytes @ 1..) = (checkpoint.path(), checkpoint.damaged_bytes()) {
            events.note(&format!(
                "{}: analysis rows that were cut off or damaged ({bytes} bytes) are computed again",
                path.display()
            ));
        }
        let share = |analyses: u64| analyses / shard.count;
        let total = self.analyses_of(shard);
        let before: u64 = self.plans.iter().zip(&self.keys).map(|(plan, keys)| known(plan, keys, checkpoint)).sum();
        if before > 0 {
            let (known, total) = (thousands(before.min(total)), thousands(total));
            events.remark("known", &format!("{known} of {total} analyses resumed"));
        }
        let finished = AtomicU64::new(before);
        for (place, (labelled, keys)) in self.plans.into_iter().zip(&self.keys).enumerate() {
            let LabelledPlan { label, remark, plan, known, .. } = labelled;
            if let Some((topic, text)) = &remark {
                events.remark(topic, text);
            }
            let mut cells = known.unwrap_or_else(|| Cells::unknown(&plan));
            checkpoint.rows().fill(keys, &mut cells);
            let known_before = cells.count();
            let in_row: Vec<usize> = (0..plan.axes().rows())
                .map(|row| {
                    let (motion, system) = plan.axes().motion_and_system(row);
                    cells.known_in_row(motion, system)
                })
                .collect();
            let keep = |row: &AnalysisRow<'_>| {
                let new = plan.histories_of(row.motion) - in_row[plan.axes().row(row.motion, row.system)];
                finished.fetch_add(new as u64, Ordering::Relaxed);
            };
            let start = Instant::now();
            let progress = Progress::begin(events, &label, "analyses", share(plan.analyses()));
            let outcome = checkpoint.complete((&plan, keys), cells, shard, &progress, &keep);
            drop(progress);
            let cells = match outcome {
                Err(IdaError::Cancelled) => {
                    return Err(checkpoint.stopped(finished.load(Ordering::Relaxed), total));
                }
                other => other?,
            };
            // the last rows may be those that found no room
            checkpoint.sync()?;
            let seconds = start.elapsed().as_secs_f64();
            let analyses = plan.analyses();
            let peaks = if shard.is_whole() { cells.complete() } else { None };
            if let Some(peaks) = peaks {
                let done = Analysed { peaks, analyses, computed: analyses - known_before, seconds };
                if remark.is_some() {
                    events.remark("", &pace(&done));
                }
                each(place, done)?;
            }
        }
        Ok(())
    }

    /// Carries out all of it: the result of each plan, in their order.
    ///
    /// # Errors
    /// As [`carry_out`](Self::carry_out).
    pub fn results(self, checkpoint: &Checkpoint, events: &dyn Events) -> Result<Vec<Analysed>, EngineError> {
        let mut results = Vec::with_capacity(self.plans.len());
        self.carry_out(checkpoint, Shard::WHOLE, events, &mut |_, analysed| {
            results.push(analysed);
            Ok(())
        })?;
        Ok(results)
    }
}

/// Time, and analyses a second.
fn pace(done: &Analysed) -> String {
    let rate = thousands(rate(done.computed, done.seconds));
    let rate = if done.computed > 0 { format!(", {rate} analyses/s") } else { String::new() };
    format!("{:.1} s{rate}", done.seconds)
}

/// Analyses a second.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a rate for people")]
pub fn rate(computed: u64, seconds: f64) -> u64 {
    (computed as f64 / seconds.max(1e-9)) as u64
}

/// Analyses of a plan that are known from elsewhere and from a checkpoint.
fn known(labelled: &LabelledPlan<'_>, keys: &RowKeys, checkpoint: &Checkpoint) -> u64 {
    let axes = labelled.plan.axes();
    let in_row = |(row, key): (usize, &RowKey)| {
        if checkpoint.rows().contains(*key) {
            return labelled.plan.histories_of(axes.motion_and_system(row).0) as u64;
        }
        let (motion, system) = axes.motion_and_system(row);
        labelled.known.as_ref().map_or(0, |cells| cells.known_in_row(motion, system) as u64)
    };
    keys.as_slice().iter().enumerate().map(in_row).sum()
}

/// Wall time of `plans` on the threads of the current rayon pool, s: rows of each are timed until its part of `budget`
/// is spent.
pub fn seconds(plans: &[Plan<'_>], budget: Duration) -> f64 {
    let each = budget / u32::try_from(plans.len().max(1)).unwrap_or(u32::MAX);
    let one_thread: f64 = plans.iter().map(|plan| estimate(plan, each).seconds_one_thread).sum();
    one_thread / rayon::current_num_threads() as f64
}
