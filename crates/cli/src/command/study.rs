//! Commands that carry out a study.

pub(super) mod check;
pub(super) mod init;
pub(super) mod merge;
pub(super) mod run;
pub(super) mod sweep;
