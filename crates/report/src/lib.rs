//! The figures of a result, and the page that holds them.
//!
//! | module | what is in it |
//! |---|---|
//! | [`figures`] | what the figures of Chapters 2 to 4 show |
//! | [`write_figure`] | a figure as an SVG or PNG file |
//! | [`page`](mod@page) | one HTML page with every figure and table of results |

mod figure_file;
pub mod figures;
pub mod page;

pub use figure_file::write_figure;
pub use page::report;
