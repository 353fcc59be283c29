//! Synthetic pairs as they are made, with a sign of how far they are.

use uplift_ida::Watch;
use uplift_job::JobError;
use uplift_job::events::{Events, Progress};
use uplift_motion::RecordPair;
use uplift_motion::synthetic::{Pairs, SyntheticSetOptions};

use crate::error::InputsError;

/// Pairs that are made within a few seconds, without a word.
const SOON: usize = 200;

/// Makes the set of `options`, pair by pair.
///
/// # Errors
/// An option out of its range, too few candidates that are strong enough; [`JobError::Interrupted`] where `events`
/// say so.
pub(crate) fn made_pairs(options: &SyntheticSetOptions, events: &dyn Events) -> Result<Vec<RecordPair>, InputsError> {
    let pairs = Pairs::from_options(options)?;
    if options.pairs <= SOON {
        return Ok(pairs.collect::<Result<_, _>>()?);
    }
    let progress = Progress::begin(events, "records", "synthetic pairs", options.pairs as u64);
    let mut made = Vec::with_capacity(options.pairs);
    for pair in pairs {
        if progress.cancelled() {
            return Err(JobError::Interrupted.into());
        }
        made.push(pair?);
        progress.finished(1);
    }
    Ok(made)
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use uplift_job::is_stopped;

    use super::*;

    /// Counts the steps, and stops after so many.
    struct Counting(AtomicU64, u64);

    impl Events for Counting {
        fn advance(&self, steps: u64) {
            self.0.fetch_add(steps, Ordering::Relaxed);
        }

        fn cancelled(&self) -> bool {
            self.0.load(Ordering::Relaxed) >= self.1
        }
    }

    #[test]
    fn many_pairs_tell_how_far_they_are_and_can_be_stopped() {
        let options = SyntheticSetOptions { pairs: SOON + 1, ..SyntheticSetOptions::default() };
        let events = Counting(AtomicU64::new(0), 3);
        assert!(is_stopped(&made_pairs(&options, &events).unwrap_err()));
        assert_eq!(events.0.into_inner(), 3);
    }
}
