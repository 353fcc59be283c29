//! Events of a job, and its cancellation: the one way out.

use std::path::Path;

use rayon::prelude::*;
use uplift_ida::Watch;

use crate::JobError;

/// Whoever started a job, as the job sees them: a terminal, a notebook, a test, or nobody ([`Silent`]).
///
/// Every method but [`cancelled`](Self::cancelled) only listens. A phase is over before the next one begins; all but
/// [`advance`](Self::advance) and [`cancelled`](Self::cancelled) are called from the thread that started the job.
pub trait Events: Sync {
    /// A fact on the way, `topic` in a word: `records`, "105 records of …".
    fn remark(&self, topic: &str, text: &str) {
        let _ = (topic, text);
    }

    /// What whoever uses the numbers should know, and would not look for.
    fn note(&self, text: &str) {
        let _ = text;
    }

    /// A phase of known length begins.
    fn begin(&self, phase: Phase<'_>) {
        let _ = phase;
    }

    /// So many more steps of the phase are done. Called from every thread, often.
    fn advance(&self, steps: u64) {
        let _ = steps;
    }

    /// The phase is over, done or not.
    fn end(&self) {}

    /// From now on a stop loses nothing that is finished: it is in the file `checkpoint`.
    fn resumes_from(&self, checkpoint: &Path) {
        let _ = checkpoint;
    }

    /// From now on files are put into `folder` one by one: a stop leaves some of this job and some of an earlier one.
    fn writing_into(&self, folder: &Path) {
        let _ = folder;
    }

    /// True to stop the job at its next chance; it then ends with
    /// [`JobError::Interrupted`] or [`JobError::Paused`].
    fn cancelled(&self) -> bool {
        false
    }
}

/// A part of a job with steps that can be counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Phase<'a> {
    /// What is worked on: a measure, a record set.
    pub label: &'a str,
    /// What a step is called, in the plural.
    pub unit: &'static str,
    /// Steps in all.
    pub total: u64,
}

/// Nobody listens, and nobody stops the job.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Events for Silent {}

/// A phase under way, for the crates below, which know no more than that somebody watches. It ends when dropped.
pub struct Progress<'a>(&'a dyn Events);

impl<'a> Progress<'a> {
    /// Begins a phase.
    pub fn begin(events: &'a dyn Events, label: &str, unit: &'static str, total: u64) -> Self {
        events.begin(Phase { label, unit, total });
        Self(events)
    }
}

impl Watch for Progress<'_> {
    fn finished(&self, analyses: u64) {
        self.0.advance(analyses);
    }

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

impl Drop for Progress<'_> {
    fn drop(&mut self) {
        self.0.end();
    }
}

/// What `of` makes of each of `items`, in their order: on all threads, as a phase of `events` that has a label and a
/// unit, an item a step.
///
/// # Errors
/// [`JobError::Interrupted`] where `events` say so.
pub fn each<I: Send, T: Send>(
    events: &dyn Events,
    (label, unit): (&str, &'static str),
    items: Vec<I>,
    of: impl Fn(I) -> T + Sync,
) -> Result<Vec<T>, JobError> {
    let progress = Progress::begin(events, label, unit, items.len() as u64);
    let of_item = |item| {
        let made = (!progress.cancelled()).then(|| of(item))?;
        progress.finished(1);
        Some(made)
    };
    let made: Vec<Option<T>> = items.into_par_iter().map(of_item).collect();
    drop(progress);
    if events.cancelled() { Err(JobError::Interrupted) } else { Ok(made.into_iter().flatten().collect()) }
}
