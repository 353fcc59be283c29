//! The terminal as jobs see it: remarks on standard error, a progress bar or plain lines, Ctrl-C.

mod events;
mod progress;
mod visible;

use std::borrow::Cow;
use std::collections::HashSet;
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError, RwLock};
use std::time::Duration;

use clap::ValueEnum;
use miette::{GraphicalReportHandler, GraphicalTheme};
use uplift::JobError;
use uplift::events::{Events, Phase};
use uplift::study::StudyError;
use uplift::text::{one_line, visible};

use crate::error::CommandError;
use events::Event;
use progress::Progress;
pub(crate) use visible::{Output, error_output, output, visible_json};

/// What the shell sees of an interruption.
const EXIT_INTERRUPTED: u8 = 5;
/// How long an interrupted program may take to come to a good end by itself.
const GRACE: Duration = Duration::from_millis(800);
/// What is left to the words of a program that was asked twice to end.
const WORDS: Duration = Duration::from_millis(200);

/// How people or programs are reported what a command does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Form {
    /// Lines and a bar, for people
    Text,
    /// A line of JSON for each event, for programs
    Json,
}

/// Where the user sits. Where nobody listens any more, a closed pipe or a full disk, what is said is lost, and the work
/// goes on.
pub(crate) struct Terminal {
    quiet: bool,
    details: bool,
    form: Form,
    stop: Arc<AtomicBool>,
    /// What is said where an interruption cannot wait for the work in hand.
    interruption_message: Arc<Mutex<String>>,
    progress: RwLock<Option<Progress>>,
    /// Notes that were told: a job of many steps has the same one at each.
    noted: Mutex<HashSet<String>>,
}

impl Terminal {
    /// A terminal that hears Ctrl-C and SIGTERM from now on; a quiet one tells results, probable mistakes and errors
    /// only, one with `details` every table.
    pub(crate) fn new(quiet: bool, details: bool, form: Form) -> Self {
        let stop = Arc::new(AtomicBool::new(false));
        let interruption_message = Arc::new(Mutex::new(JobError::Interrupted.to_string()));
        let terminal = Self {
            quiet,
            details,
            form,
            stop: stop.clone(),
            interruption_message: interruption_message.clone(),
            progress: RwLock::new(None),
            noted: Mutex::default(),
        };
        let interrupted = move || {
            let interruption_message = interruption_message.clone();
            // what is being written now is written to a file of its own, and an earlier file is as it was
            let end = move || -> ! {
                let message = interruption_message.lock().unwrap_or_else(PoisonError::into_inner).clone();
                match form {
                    Form::Text => tell(&format!("uplift: {message}")),
                    Form::Json => Event::interrupted(EXIT_INTERRUPTED, message).tell(),
                }
                std::process::exit(EXIT_INTERRUPTED.into())
            };
            let is_asked_twice = stop.swap(true, Ordering::Relaxed);
            std::thread::spawn(move || {
                std::thread::sleep(if is_asked_twice { Duration::ZERO } else { GRACE });
                end()
            });
            if is_asked_twice {
                // the words may wait for whoever reads them, the end does not
                std::thread::sleep(WORDS);
                std::process::exit(EXIT_INTERRUPTED.into())
            }
        };
        #[cfg(unix)]
        on_termination(interrupted.clone());
        // where no handler can be set, Ctrl-C ends the program at once, which does no harm either
        let _ = ctrlc::set_handler(interrupted);
        terminal
    }

    /// Whether only results and errors are reported.
    pub(crate) fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// Whether every table is shown.
    pub(crate) fn shows_details(&self) -> bool {
        self.details
    }

    /// From now on, this is what an interruption leaves.
    pub(crate) fn set_interruption_message(&self, words: String) {
        *self.interruption_message.lock().unwrap_or_else(PoisonError::into_inner) = words;
    }

    /// A line on standard error, unless it was asked for quiet.
    pub(crate) fn say(&self, text: &str) {
        self.tell_unless_quiet(&Event::Line { text }, text);
    }

    /// Tells an error; a study's mistakes with their lines and carets.
    pub(crate) fn tell_error(&self, error: &CommandError) {
        match (error, self.form) {
            (CommandError::OutputClosed, _) => {}
            (_, Form::Text) => tell_error(error),
            (_, Form::Json) => Event::from_error(error).tell(),
        }
    }

    /// The event for a program, or the text for a person.
    fn tell_unless_quiet(&self, event: &Event<'_>, text: &str) {
        match self.form {
            _ if self.quiet => {}
            Form::Text => tell(text),
            Form::Json => event.tell(),
        }
    }
}

/// Calls `interrupted` when the system or a queue asks the program to end (SIGTERM): that is Ctrl-C without a keyboard.
#[cfg(unix)]
fn on_termination(interrupted: impl Fn() + Send + 'static) {
    if let Ok(mut signals) = signal_hook::iterator::Signals::new([signal_hook::consts::SIGTERM]) {
        std::thread::spawn(move || signals.forever().for_each(|_| interrupted()));
    }
}

impl Events for Terminal {
    fn remark(&self, topic: &str, text: &str) {
        self.tell_unless_quiet(&Event::Remark { topic, text }, &format!("{topic:<8} {}", one_line(text)));
    }

    fn note(&self, text: &str) {
        let is_known = !self.noted.lock().unwrap_or_else(PoisonError::into_inner).insert(text.to_owned());
        // programs that read events get all of them
        if is_known && self.form != Form::Json {
            return;
        }
        self.tell_unless_quiet(&Event::Note { text }, &format!("note: {}", one_line(text)));
    }

    fn begin(&self, phase: Phase<'_>) {
        let progress = (!self.quiet).then(|| Progress::new(phase, self.form));
        *self.progress.write().unwrap_or_else(PoisonError::into_inner) = progress;
    }

    fn advance(&self, steps: u64) {
        if let Some(progress) = &*self.progress.read().unwrap_or_else(PoisonError::into_inner) {
            progress.advance(steps);
        }
    }

    fn end(&self) {
        if let Some(progress) = self.progress.write().unwrap_or_else(PoisonError::into_inner).take() {
            progress.close();
        }
    }

    fn resumes_from(&self, checkpoint: &Path) {
        if self.form == Form::Json && !self.quiet {
            Event::Checkpoint { path: &checkpoint.to_string_lossy() }.tell();
        }
        self.set_interruption_message(format!(
            "interrupted: finished work is in the checkpoint {}. Run the same command to resume",
            checkpoint.display()
        ));
    }

    fn writing_into(&self, folder: &Path) {
        self.set_interruption_message(format!(
            "interrupted: files in {} may be from an earlier run. Run the same command again",
            folder.display()
        ));
    }

    fn cancelled(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// A line on standard error.
pub(crate) fn tell(text: &str) {
    let _ = writeln!(error_output(), "{text}");
}

/// An error in words.
fn tell_error(error: &CommandError) {
    match error {
        CommandError::Uplift(error) if let Some(error) = error.root().downcast_ref::<StudyError>() => {
            let rendered = |theme| {
                let mut text = String::new();
                GraphicalReportHandler::new_themed(theme).render_report(&mut text, error).ok().map(|()| text)
            };
            let Some(plain) = rendered(GraphicalTheme::unicode_nocolor()) else {
                return tell(&format!("uplift: {error}"));
            };
            // among colours of our own, commands to the terminal in the file could not be told apart
            let coloured = std::io::stderr().is_terminal()
                && std::env::var_os("NO_COLOR").is_none()
                && matches!(visible(&plain), Cow::Borrowed(_));
            match rendered(GraphicalTheme::unicode()).filter(|_| coloured) {
                Some(text) => drop(write!(std::io::stderr(), "{text}")),
                None => drop(write!(error_output(), "{plain}")),
            }
        }
        other => tell(&format!("uplift: {other}")),
    }
}
