//! What the legend of a figure names, and the sample that stands before a name.
#![allow(clippy::cast_possible_wrap, reason = "pixels of a drawing: whole numbers far below any limit")]

use plotters::prelude::*;

use super::figure::{Figure, Hatch, Marks, Tone};
use super::map::{draw_hatch, hatching};
use super::stroke::{Area, FAINT_LINE, Failure, UNITS, colour, draw_line, draw_mark, width};

/// A name in the legend and what stands before it.
pub(super) struct Entry {
    pub(super) name: String,
    tone: Tone,
    kind: Kind,
}

#[derive(Clone, Copy)]
enum Kind {
    Line,
    /// A line in the middle of a band.
    LineInBand,
    Dots(Marks),
    Area,
    Level,
    Region(Hatch),
}

/// What the legend names: each name once.
pub(super) fn legend(figure: &Figure) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for panel in &figure.panels {
        let lines = panel.series.iter().map(|series| {
            let has_band = panel.bands.iter().any(|band| band.name.is_empty() && band.tone == series.tone);
            let kind = match series.marks {
                marks @ (Marks::Only | Marks::Rings) => Kind::Dots(marks),
                _ if has_band => Kind::LineInBand,
                _ => Kind::Line,
            };
            (&series.name, series.tone, kind)
        });
        let bands = panel.bands.iter().map(|band| (&band.name, band.tone, Kind::Area));
        let levels = panel.map.iter().flat_map(|map| {
            let of = map.levels.len();
            map.levels.iter().enumerate().map(move |(step, (_, name))| (name, Tone::Shade { step, of }, Kind::Level))
        });
        let regions = panel
            .map
            .iter()
            .flat_map(|map| map.regions.iter().map(|region| (&region.name, region.tone, Kind::Region(region.hatch))));
        for (name, tone, kind) in lines.chain(bands).chain(levels).chain(regions) {
            if !name.is_empty() && entries.iter().all(|known| known.name != *name) {
                entries.push(Entry { name: name.clone(), tone, kind });
            }
        }
    }
    entries
}

/// The sample of an entry, 22 pixels wide, its upper left corner at a place in units.
pub(super) fn draw_swatch(root: &Area<'_>, entry: &Entry, (x, top): (i32, i32)) -> Result<(), Failure> {
    let tone = entry.tone;
    let (middle, right) = (top + 6 * UNITS, x + 22 * UNITS);
    let (upper, lower) = (middle - 4 * UNITS, middle + 4 * UNITS);
    let corners = [(x, upper), (right, lower)];
    match entry.kind {
        Kind::Area => root.draw(&Rectangle::new(corners, colour(tone).mix(0.25).filled()))?,
        Kind::Level => root.draw(&Rectangle::new(corners, colour(tone).filled()))?,
        Kind::Region(hatch) => {
            for ends in hatching(hatch, x..right, upper..lower, |_| true) {
                draw_hatch(root, ends.to_vec(), tone)?;
            }
            root.draw(&Rectangle::new(corners, colour(tone).stroke_width(FAINT_LINE)))?;
        }
        Kind::Dots(marks) => draw_mark(root, (x + 11 * UNITS, middle), tone, marks)?,
        Kind::LineInBand => {
            root.draw(&Rectangle::new(corners, colour(tone).mix(0.22).filled()))?;
            draw_line(root, &[(x, middle), (right, middle)], tone, width(tone))?;
        }
        Kind::Line => draw_line(root, &[(x, middle), (right, middle)], tone, width(tone))?,
    }
    Ok(())
}
