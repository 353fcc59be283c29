//! Progress of a phase: a bar on a terminal, plain lines elsewhere, or events.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use uplift::events::Phase;
use uplift::text::one_line;

use super::events::Event;
use super::{Form, tell};

/// Seconds between the lines that stand in for a bar.
const LINE_EVERY: Duration = Duration::from_secs(10);
/// Time between the events that tell of it.
const EVENT_EVERY: Duration = Duration::from_millis(100);

/// Tells how far a phase is.
pub(super) struct Progress {
    label: String,
    unit: &'static str,
    total: u64,
    done: AtomicU64,
    start: Instant,
    /// None where there is no terminal to draw one on.
    bar: Option<ProgressBar>,
    form: Form,
    /// Time from the start at which the next line or event is due, ms.
    next_ms: AtomicU64,
}

impl Progress {
    pub(super) fn new(Phase { label, unit, total }: Phase<'_>, form: Form) -> Self {
        let label = one_line(label).into_owned();
        if form == Form::Json {
            Event::Begin { label: &label, unit, total }.tell();
        }
        let bar = (form == Form::Text && std::io::stderr().is_terminal()).then(|| {
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
            form,
            next_ms: AtomicU64::new(if form == Form::Json { 0 } else { millis(LINE_EVERY) }),
        }
    }

    pub(super) fn advance(&self, steps: u64) {
        let done = self.done.fetch_add(steps, Ordering::Relaxed) + steps;
        match &self.bar {
            Some(bar) => bar.set_position(done),
            None => self.line_or_event(done),
        }
    }

    /// Takes the bar away.
    pub(super) fn close(&self) {
        if self.form == Form::Json {
            Event::End { done: self.done.load(Ordering::Relaxed), total: self.total }.tell();
        }
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }

    fn line_or_event(&self, done: u64) {
        let elapsed = self.start.elapsed();
        let (now, due) = (millis(elapsed), self.next_ms.load(Ordering::Relaxed));
        // lines keep to their times, events their distance
        let next = if self.form == Form::Json { now + millis(EVENT_EVERY) } else { due + millis(LINE_EVERY) };
        let claimed =
            now >= due && self.next_ms.compare_exchange(due, next, Ordering::Relaxed, Ordering::Relaxed).is_ok();
        if claimed && self.form == Form::Json {
            Event::Advance { done, total: self.total }.tell();
        } else if claimed && done < self.total {
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

fn millis(time: Duration) -> u64 {
    u64::try_from(time.as_millis()).unwrap_or(u64::MAX)
}
