//! What keeps any job from doing what it was asked.

use std::error::Error;
use std::path::{Path, PathBuf};

use thiserror::Error;
use uplift_atomic_file::FileError;
use uplift_ida::IdaError;
use uplift_labelled::LabelledError;
use uplift_plausible::Implausible;
use uplift_study::did_you_mean;

use crate::text::one_line;

/// Why a job did not do what it was asked, whatever the job. Each crate of the pipeline wraps it in an error of its
/// own; [`cause`] finds it there.
#[derive(Debug, Error)]
#[error("{0}")]
pub enum JobError {
    /// What a job is asked for does not fit together.
    Usage(String),
    /// A choice among what a result has, that it does not have or that was not made.
    #[error("{}", choice([option, noun], wanted.as_deref(), known))]
    Choice {
        /// What is chosen, as the command line calls it: `--site`.
        option: &'static str,
        /// What the option selects, as a noun: `site`.
        noun: &'static str,
        /// The choice made; none where there is none, and there are several.
        wanted: Option<String>,
        /// What the result has.
        known: Vec<String>,
    },
    /// Records or hazard curves cannot be used; all that was found.
    #[error("{}", list(" in the input data", .0))]
    Inputs(Vec<String>),
    /// Numbers that no system, record or person means; all that was found.
    #[error("{}", list("", .0))]
    Implausible(Vec<Implausible>),
    /// A job cannot fit on this machine; why.
    #[error(
        "{}\n(the need is an estimate: UPLIFT_LIMITS=warn in the environment continues)",
        list(" with memory or disk", .0)
    )]
    Room(Vec<String>),
    /// A file cannot be opened or written.
    File(#[from] FileError),
    /// A file of labelled arrays, a result above all, cannot be read or written.
    Labelled(#[from] LabelledError),
    /// One of the files that a job reads is at fault.
    #[error("{}: {source}", path.display())]
    InFile {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: Box<dyn Error + Send + Sync>,
    },
    /// An analysis that cannot be planned or finished; one that was told to stop is [`Interrupted`](Self::Interrupted).
    Analysis(#[source] Box<IdaError>),
    /// The user stopped the run.
    #[error(
        "interrupted: nothing was written; an earlier result file is unchanged. Run the same command to start again"
    )]
    Interrupted,
    /// The user stopped a computation that goes on where it stopped.
    #[error(
        "interrupted: {done} of {total} {what} are in the checkpoint {}. Run the same command to resume",
        path.display()
    )]
    Paused {
        /// What is counted, in the plural.
        what: &'static str,
        /// Finished, over all measures.
        done: u64,
        /// In all.
        total: u64,
        /// The checkpoint that holds them.
        path: PathBuf,
    },
}

/// Makes the error of a crate of the pipeline from errors that a [`JobError`] is made from, by way of it.
#[macro_export]
macro_rules! through_job_error {
    ($error:ty: $($from:ty),+) => {
        $(impl From<$from> for $error {
            fn from(error: $from) -> Self {
                $crate::JobError::from(error).into()
            }
        })+
    };
}

/// What was chosen and is not there, or what to choose among.
fn choice([option, noun]: [&str; 2], wanted: Option<&str>, known: &[String]) -> String {
    let all = known.join(", ");
    let Some(wanted) = wanted else {
        let example = known.first().map_or_else(String::new, |first| format!(" {first}"));
        return format!("choose one: {option}{example}; the result has {all}");
    };
    let names: Vec<&str> = known.iter().map(String::as_str).collect();
    // a number is no mistyped number
    let is_word = wanted.parse::<f64>().is_err();
    let meant = did_you_mean(wanted, &names).filter(|_| is_word && known.len() > 1);
    let meant = meant.map_or_else(String::new, |meant| format!("; {}", meant.replace('`', "")));
    format!("the result has no {noun} {wanted}: it has {all}{meant}")
}

/// Several mistakes as one message; `place` says where they are.
pub fn list(place: &str, mistakes: &[impl ToString]) -> String {
    match mistakes {
        [one] => one_line(&one.to_string()).into_owned(),
        many => {
            let lines: Vec<String> =
                many.iter().map(|mistake| format!("  - {}", one_line(&mistake.to_string()))).collect();
            format!("{} problems{place}:\n{}", many.len(), lines.join("\n"))
        }
    }
}

impl JobError {
    /// One mistake in the input data.
    pub fn input(message: impl Into<String>) -> Self {
        Self::Inputs(vec![message.into()])
    }
}

impl From<IdaError> for JobError {
    fn from(error: IdaError) -> Self {
        match error {
            IdaError::Cancelled => Self::Interrupted,
            other => Self::Analysis(Box::new(other)),
        }
    }
}

/// The first error of type `E` in the chain of causes that begins with `error`.
pub fn cause<'e, E: Error + 'static>(error: &'e (dyn Error + 'static)) -> Option<&'e E> {
    let mut next = Some(error);
    while let Some(error) = next {
        if let Some(found) = error.downcast_ref() {
            return Some(found);
        }
        next = error.source();
    }
    None
}

/// Whether somebody stopped the job.
pub fn is_stopped(error: &(dyn Error + 'static)) -> bool {
    matches!(cause(error), Some(JobError::Interrupted | JobError::Paused { .. }))
}

/// The `error`, said of the file at `path`; a job that was stopped was not stopped by the file.
pub fn in_file<E: From<JobError> + Error + Send + Sync + 'static>(error: E, path: &Path) -> E {
    if is_stopped(&error) {
        return error;
    }
    JobError::InFile { path: path.to_owned(), source: Box::new(error) }.into()
}
