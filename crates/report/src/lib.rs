//! The figures of a result, and the page that holds them.
//!
//! | module | what is in it |
//! |---|---|
//! | [`figures`] | what the figures of Chapters 2 to 4 show |
//! | [`page`](mod@page) | one HTML page with every figure and table of results |

pub mod figures;
pub mod page;

pub use page::report;
