//! Figures as files.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use clap::{Args, value_parser};
use uplift::outputs::{self, Output, OutputKind};
use uplift::result::write_atomically;
use uplift::text::visible;
use uplift::typed::one_of;
use uplift::{JobError, UpliftError};
use uplift_plot::{Drawing, Figure, Look, Width, png, svg, with_description, with_software};

/// Of a PNG for print.
const DOTS_PER_INCH: u16 = 300;
/// From half a column to a poster, mm: narrower, the letters of a legend do not fit.
const WIDTHS_MM: RangeInclusive<i64> = 60..=500;

/// Formats of figure files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FigureFormat {
    /// SVG.
    #[default]
    Svg,
    /// PNG.
    Png,
    /// A file of each.
    Both,
}

impl FigureFormat {
    const ALL: [Self; 3] = [Self::Svg, Self::Png, Self::Both];

    /// Its word on a command line.
    fn key(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Both => "both",
        }
    }

    /// Endings of the files of a figure.
    fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Svg => &["svg"],
            Self::Png => &["png"],
            Self::Both => &["png", "svg"],
        }
    }
}

/// Widths with a word on a command line.
const COLUMNS: [Width; 2] = [Width::Single, Width::Double];

fn columns(width: Width) -> &'static str {
    if width == Width::Single { "single" } else { "double" }
}

/// How figures are written into a folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Args)]
pub struct FigureOptions {
    /// File format
    #[arg(long, value_parser = one_of(&FigureFormat::ALL, FigureFormat::key), default_value = "svg")]
    pub format: FigureFormat,
    /// Width: one column (90 mm) or a page (190 mm)
    #[arg(long, value_parser = one_of(&COLUMNS, columns), default_value = "double")]
    pub width: Width,
    /// Other width, mm; below 140 mm panels are stacked
    #[arg(long, value_name = "MM", conflicts_with = "width", value_parser = value_parser!(u16).range(WIDTHS_MM))]
    pub width_mm: Option<u16>,
    /// Resolution of a PNG, dots per inch
    #[arg(
        long = "dpi", value_name = "N", default_value_t = DOTS_PER_INCH,
        value_parser = value_parser!(u16).range(72..=1200)
    )]
    pub dots_per_inch: u16,
    /// Write the title into the figure
    #[arg(long)]
    pub title: bool,
}

impl Default for FigureOptions {
    fn default() -> Self {
        let (format, width) = (FigureFormat::default(), Width::Double);
        Self { format, width, width_mm: None, dots_per_inch: DOTS_PER_INCH, title: false }
    }
}

impl FigureOptions {
    fn look(self) -> Look {
        Look { width: self.width_mm.map_or(self.width, Width::Millimetres), title: self.title }
    }

    /// The files in `folder` that the figures of these names are written to.
    pub fn outputs<'a>(self, ids: impl Iterator<Item = &'a str>, folder: &Path) -> Vec<Output> {
        let files =
            ids.flat_map(|id| self.format.endings().iter().map(move |ending| folder.join(format!("{id}.{ending}"))));
        files.map(|file| Output::new(file, OutputKind::Figure)).collect()
    }

    /// Writes `figure` into `folder`, which is there; the files written say of themselves what `mark` says.
    ///
    /// # Errors
    /// A file that cannot be written, and no font for a PNG.
    pub fn write(self, figure: &Figure, folder: &Path, mark: &str) -> Result<Vec<PathBuf>, UpliftError> {
        self.write_svg(&figure.id, &drawing_of(figure, self.look())?.svg, folder, mark)
    }

    /// As [`write`](Self::write), of a drawing that is SVG already.
    ///
    /// # Errors
    /// As [`write`](Self::write).
    pub(crate) fn write_svg(self, id: &str, svg: &str, folder: &Path, mark: &str) -> Result<Vec<PathBuf>, UpliftError> {
        let mut written = Vec::new();
        for ending in self.format.endings() {
            let file = folder.join(format!("{id}.{ending}"));
            write_drawing(id, svg, &file, (mark, self.dots_per_inch))?;
            written.push(file);
        }
        Ok(written)
    }
}

/// Refuses a name that does not tell the format of a figure, and one that would replace something else, before anything
/// is computed.
///
/// # Errors
/// As [`outputs::check`].
pub fn check_figure_file(file: &Path, inputs: &[impl AsRef<Path>], force: bool) -> Result<(), UpliftError> {
    Ok(outputs::check(&[Output::new(file, OutputKind::Figure)], inputs, force)?)
}

/// Writes `figure`, as wide as a page, to `file`, in the format of its ending.
///
/// # Errors
/// A file that cannot be written, and no font for a PNG.
pub fn write_figure_file(figure: &Figure, file: &Path) -> Result<(), UpliftError> {
    let usual = FigureOptions::default();
    write_drawing(&figure.id, &drawing_of(figure, usual.look())?.svg, file, (&outputs::mark(), usual.dots_per_inch))
}

/// Writes a figure that was drawn, in the format of the ending, with what it says of itself.
fn write_drawing(id: &str, svg: &str, file: &Path, (mark, dots_per_inch): (&str, u16)) -> Result<(), UpliftError> {
    let mark = visible(mark).into_owned();
    if file.extension().is_some_and(|extension| extension == "png") {
        let image = png(svg, f32::from(dots_per_inch)).map_err(|error| refused(id, error))?;
        Ok(write_atomically(file, &with_software(&image, &mark))?)
    } else {
        Ok(write_atomically(file, with_description(svg, &mark).as_bytes())?)
    }
}

/// A figure as SVG, in whose texts what is no letter is spelt out: no reader of XML takes it.
fn drawing_of(figure: &Figure, look: Look) -> Result<Drawing, UpliftError> {
    let drawing = svg(figure, look).map_err(|reason| refused(&figure.id, reason))?;
    Ok(Drawing { svg: visible(&drawing.svg).into_owned(), ..drawing })
}

/// A figure that the drawing library does not draw.
pub(crate) fn refused(id: &str, reason: impl Display) -> UpliftError {
    JobError::input(format!("{id}: {reason}")).into()
}
