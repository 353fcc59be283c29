//! Progress of a phase: a bar on a terminal, plain lines elsewhere.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use uplift::events::Phase;
use uplift::text::one_line;

use super::tell;

/// Seconds between the lines that stand in for a bar.
const LINE_EVERY_S: u64 = 10;

/// Tells how far a phase is.
pub(super) struct Progress {
    label: String,
    unit: &'static str,
    total: u64,
    done: AtomicU64,
    start: Instant,
    /// None where there is no terminal to draw one on.
    bar: Option<ProgressBar>,
    next_line_s: AtomicU64,
}

impl Progress {
    pub(super) fn new(Phase { label, unit, total }: Phase<'_>) -> Self {
        let label = one_line(label).into_owned();
        let bar = std::io::stderr().is_terminal().then(|| {
            let bar = ProgressBar::new(total);
            let template = format!(
                "{{msg}} {{bar:32}} {{percent:>3}} %  {{human_pos}} of {{human_len}} {unit}, {{per_sec}}, {{eta}} left"
            );
            if let Ok(style) = ProgressStyle::with_template(&template) {
                bar.set_style(style);
            }
            bar.set_message(label.clone());
            bar.enable_steady_tick(Duration::from_millis(200));
            bar
        });
        Self {
            label,
            unit,
            total,
            done: AtomicU64::new(0),
            start: Instant::now(),
            bar,
            next_line_s: AtomicU64::new(LINE_EVERY_S),
        }
    }

    pub(super) fn advance(&self, steps: u64) {
        let done = self.done.fetch_add(steps, Ordering::Relaxed) + steps;
        match &self.bar {
            Some(bar) => bar.set_position(done),
            None => self.line(done),
        }
    }

    /// Takes the bar away.
    pub(super) fn close(&self) {
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
            // of what takes seconds a step, whole numbers say nothing
            let decimals = usize::from(rate < 10.0);
            tell(&format!(
                "{}: {:.0} % of {} {}, {rate:.decimals$}/s, {left_s:.0} s left",
                self.label,
                100.0 * done as f64 / self.total as f64,
                self.total,
                self.unit
            ));
        }
    }
}
