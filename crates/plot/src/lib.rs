//! Figures, free of science: lines, bands, marks and maps over two axes, several panels a figure, drawn as SVG or PNG.
//!
//! A [`Figure`] says what is to be seen; [`svg()`] draws it and tells where each panel lies, so that a report can read
//! values off the curves; [`png()`] turns the drawing into pixels. Colours are those of Okabe and Ito, told apart by
//! the colour-blind, and every series has its own dashes, so that a figure can be read in grey.

mod draw;
mod figure;
mod frame;
mod legend;
mod map;
mod mark;
mod panel;
mod raster;
mod stroke;
mod ticks;
mod typeset;

pub use draw::{Drawing, Look, Swatch, Width, panel_svg, svg, swatches};
pub use figure::{Axis, Band, Figure, Hatch, Map, Marks, Panel, Region, Scale, Series, Tone};
pub use mark::{with_description, with_software};
pub use panel::{PanelPlace, share_y};
pub use raster::{RasterError, png};
pub use ticks::ticks;
pub use typeset::{escaped, html, plain};
