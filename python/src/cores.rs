//! Work on all cores that Ctrl-C ends.

use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::ThreadPoolBuilder;
use uplift_ida::Watch;

/// How often Python is asked whether to stop.
const LOOKING: Duration = Duration::from_millis(50);

/// Whether the work is to stop.
#[derive(Debug, Default)]
pub(crate) struct Interruption(AtomicBool);

impl Watch for Interruption {
    fn finished(&self, _: u64) {}

    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Does the `work` on all cores without the interpreter's lock. It looks at the [`Interruption`] at least some times a
/// second; what it returns after one is not used.
///
/// The threads are started and ended with the call, so that a process may be forked between two calls.
///
/// # Errors
/// What a signal's handler raises, `KeyboardInterrupt` mostly; threads that cannot be started; errors of the work.
pub(crate) fn on_all_cores<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&Interruption) -> PyResult<T> + Send,
) -> PyResult<T> {
    let interruption = Interruption::default();
    py.detach(|| {
        let no_threads = |error| PyRuntimeError::new_err(format!("no threads to compute with: {error}"));
        let pool = ThreadPoolBuilder::new().build().map_err(no_threads)?;
        let (done, is_done) = channel();
        thread::scope(|scope| {
            let worker = thread::Builder::new().spawn_scoped(scope, || {
                let result = pool.install(|| work(&interruption));
                // nobody listens any more only where the caller is gone
                let _ = done.send(());
                drop(done);
                result
            })?;
            let mut raised = None;
            while let Err(RecvTimeoutError::Timeout) = is_done.recv_timeout(LOOKING) {
                if let Err(error) = signals() {
                    interruption.0.store(true, Ordering::Relaxed);
                    raised.get_or_insert(error);
                }
            }
            let result = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
            raised.map_or(result, Err)
        })
    })
}

/// Lets Python handle the signals that have come: in the main thread only, as Python does.
fn signals() -> PyResult<()> {
    #[expect(clippy::redundant_closure_for_method_calls, reason = "the method itself has too narrow a lifetime")]
    Python::attach(|py| py.check_signals())
}
