//! Commands that put a structure under the records and hazard of a result.

pub(super) mod design;
pub(super) mod overturning;
pub(super) mod risk;
pub(super) mod target;
