//! Commands that take a result: look at it, hand it on, or ask it something.

pub(super) mod bootstrap;
pub(super) mod consistency;
pub(super) mod export;
pub(super) mod influence;
pub(super) mod measures;
pub(super) mod plot;
pub(super) mod report;
pub(super) mod spectrum;
pub(super) mod status;
pub(super) mod table;
pub(super) mod verify;
pub(super) mod warnings;
