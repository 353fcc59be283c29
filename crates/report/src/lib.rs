//! The figures of a result, and the page that holds them.
//!
//! | module | what is in it |
//! |---|---|
//! | [`figures`] | what the figures of Chapters 2 to 4 show |
//! | [`files`] | figures as SVG and PNG files |
//! | [`plot`](mod@plot) | the figures of results, curves, pulses and responses, written |
//! | [`columns`] | those of columns that are pushed, of restrainers and protocols |
//! | [`page`](mod@page) | one HTML page with every figure and table of results |
//! | [`report`](mod@report) | that page, written |
//! | [`sheet`] | one page on a structure that was designed |
//!
//! Nothing here prints or reads arguments: [`plot()`] and [`report()`] are jobs like those of [`uplift`].

pub mod columns;
pub mod figures;
pub mod files;
pub mod page;
pub mod plot;
pub mod report;
pub mod sheet;

pub use columns::{plot_columns, plot_protocol, plot_pushover, plot_restrainer};
pub use files::{FigureFormat, FigureOptions, check_figure_file, write_figure_file};
pub use plot::{
    HazardPlotOptions, PlotOptions, PlotReport, check_library_figures, check_pulse_figures, plot, plot_block_response,
    plot_frame_response, plot_frame_risk, plot_hazard, plot_library, plot_overturning, plot_pulses, plot_response,
    plot_sweep, plot_validation, plot_validation_pairs,
};
pub use report::{PageReport, ReportOptions, report};
pub use sheet::{check_design_sheet, write_design_sheet};
