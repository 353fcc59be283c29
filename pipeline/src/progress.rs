//! Progress of the analyses: a bar on a terminal, plain lines elsewhere, nothing where it was asked for quiet.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use uplift_ida::Watch;

/// Seconds between the lines that stand in for a bar.
const LINE_EVERY_S: u64 = 10;

/// Set when the user asks to stop.
pub type StopFlag = Arc<AtomicBool>;

/// Tells how far a long computation is.
#[derive(Debug)]
pub struct Progress {
    label: String,
    unit: &'static str,
    total: u64,
    done: AtomicU64,
    start: Instant,
    bar: Option<ProgressBar>,
    lines: bool,
    next_line_s: AtomicU64,
    stop: StopFlag,
}

impl Progress {
    /// Progress of `total` steps under the name `label`; `unit` is what a step is called, in the plural.
    pub fn new(label: &str, unit: &'static str, total: u64, quiet: bool, stop: StopFlag) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let bar = (terminal && !quiet).then(|| {
            let bar = ProgressBar::new(total);
            let template = format!(
                "{{msg}} {{bar:32}} {{percent:>3}} %  {{human_pos}} of {{human_len}} {unit}, {{per_sec}}, {{eta}} left"
            );
            if let Ok(style) = ProgressStyle::with_template(&template) {
                bar.set_style(style);
            }
            bar.set_message(label.to_owned());
            bar.enable_steady_tick(Duration::from_millis(200));
            bar
        });
        Self {
            label: label.to_owned(),
            unit,
            total,
            done: AtomicU64::new(0),
            start: Instant::now(),
            bar,
            lines: !terminal && !quiet,
            next_line_s: AtomicU64::new(LINE_EVERY_S),
            stop,
        }
    }

    /// Take the bar away.
    pub fn close(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }

    fn line(&self, done: u64) {
        let elapsed = self.start.elapsed();
        let due = self.next_line_s.load(Ordering::Relaxed);
        let claimed = elapsed.as_secs() >= due
            && self.next_line_s.compare_exchange(due, due + LINE_EVERY_S, Ordering::Relaxed, Ordering::Relaxed).is_ok();
        if claimed && done < self.total {
            let rate = done as f64 / elapsed.as_secs_f64();
            let left_s = (self.total - done) as f64 / rate;
            // of what takes seconds a piece, whole numbers say nothing
            let decimals = usize::from(rate < 10.0);
            tell!(
                "{}: {:.0} % of {} {}, {rate:.decimals$}/s, {left_s:.0} s left",
                self.label,
                100.0 * done as f64 / self.total as f64,
                self.total,
                self.unit
            );
        }
    }
}

impl Watch for Progress {
    fn finished(&self, analyses: u64) {
        let done = self.done.fetch_add(analyses, Ordering::Relaxed) + analyses;
        if let Some(bar) = &self.bar {
            bar.set_position(done);
        } else if self.lines {
            self.line(done);
        }
    }

    fn cancelled(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}
