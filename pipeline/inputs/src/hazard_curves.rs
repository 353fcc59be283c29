//! Hazard curves, imported from what engines export, and looked at.
//!
//! | job | what it does |
//! |---|---|
//! | [`import`](import()) | curve files of a site from the exports of an engine, and the lines for a study |
//! | [`show`](show()) | what a curve file or an export holds |
//! | [`read`](read()) | the curves of files, for a figure |

mod import;
mod read;
mod show;

pub use import::{HazardImportOptions, HazardImportReport, WrittenCurve, import};
pub use read::{CurveOptions, NamedCurve, read};
pub use show::{HazardReport, ShownCurve, show};
