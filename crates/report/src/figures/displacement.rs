//! Displacement spectra of record sets (Figures 2.9 to 2.14 and 3.10 to 3.17).

mod design;
mod motions;
mod spectra;

use std::collections::BTreeSet;

use uplift::UpliftError;
use uplift::result::layout::{axis_part, unique_axis};
use uplift::result::{ResultFile, SpectrumPlace, StoredDisplacements, StoredStructures};
use uplift::text::{metres, nearest};
use uplift_plot::{Axis, Figure, Marks, Panel, Series, Tone};

/// What rings on a line are called.
const HANGING: &str = "decided by rounding";
/// Ordinates whose range is reported in a caption.
const RANGES_TOLD: usize = 6;

/// How many of its figures a result is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// All of them.
    All,
    /// Those of the least uplift displacement and of the first way of scaling, which are the main text's.
    Main,
}

/// A result of displacement spectra, read for its figures.
struct DisplacementSource<'a> {
    file: &'a ResultFile,
    stored: &'a StoredDisplacements,
    /// The sets as they are called in names of figures.
    words: Vec<String>,
    extent: Extent,
}

/// The figures of the displacement spectra `stored`, read from `file`, in the order of the dissertation.
///
/// # Errors
/// A file that is damaged.
pub fn displacement_figures(
    file: &ResultFile,
    stored: &StoredDisplacements,
    extent: Extent,
) -> Result<Vec<Figure>, UpliftError> {
    let mut taken = BTreeSet::new();
    let words = stored.sets.iter().map(|set| unique_axis(axis_part(&set.name).replace('_', "-"), &mut taken)).collect();
    let source = DisplacementSource { file, stored, words, extent };
    let mut figures = Vec::new();
    figures.extend(spectra::spectra(&source));
    figures.extend(motions::motions(&source)?);
    figures.extend(spectra::by_equal_energy(&source)?);
    figures.extend(spectra::uplift_displacements(&source));
    if let Some(design) = file.design()? {
        figures.extend(design::procedure(&source, &design));
        figures.push(design::comparison(&source, &design));
    }
    Ok(figures)
}

/// A line of a spectrum: what it is called, its position among the lines, its tone.
struct Line {
    name: String,
    position: usize,
    tone: Tone,
}

impl DisplacementSource<'_> {
    fn figure(&self, id: String, title: String, caption: String, columns: usize, panels: Vec<Panel>) -> Figure {
        Figure { columns, ..Figure::new(id, title, caption, panels).with_remark(super::remark(self.stored.synthetic)) }
    }

    /// Ways of scaling shown, by position.
    fn scaled_by(&self) -> std::ops::Range<usize> {
        match self.extent {
            Extent::All => 0..self.stored.scaled_by.len(),
            Extent::Main => 0..self.stored.scaled_by.len().min(1),
        }
    }

    /// What is added to the name of a figure of one way of scaling: nothing for the first.
    fn suffix(&self, scaled_by: usize) -> String {
        if scaled_by == 0 { String::new() } else { format!("-by-{}", self.stored.scaled_by[scaled_by]) }
    }

    /// How motions are scaled, in words.
    fn scaling_words(&self, scaled_by: usize) -> String {
        format!("PGA or PGV of each {} scaled to a multiple of the set's median", self.stored.scaled_by[scaled_by])
    }

    /// Uplift displacements shown, by position and value; one without value for blocks.
    fn uplift_displacements(&self) -> Vec<(usize, Option<f64>)> {
        match &self.stored.structures {
            StoredStructures::Blocks { .. } => vec![(0, None)],
            StoredStructures::Oscillators { uplift_displacement_m, .. } => {
                let shown = if self.extent == Extent::Main { 1 } else { uplift_displacement_m.len() };
                uplift_displacement_m.iter().take(shown).map(|&value| Some(value)).enumerate().collect()
            }
        }
    }

    /// The lines of one uplift displacement: a capacity or a height each. The last, of the largest, is black.
    fn lines(&self, uplift: usize) -> Vec<Line> {
        let (values, name): (&[f64], fn(f64) -> String) = match &self.stored.structures {
            StoredStructures::Blocks { height_m } => (height_m, |height_m| format!("2H = {height_m} m")),
            StoredStructures::Oscillators { capacity_m, .. } => (capacity_m, capacity_name),
        };
        let tone = |index: usize| {
            let black = 4;
            Tone::Distinct(if index + 1 == values.len() { black } else { index + usize::from(index >= black) })
        };
        let line = |(index, &value): (usize, &f64)| Line {
            name: name(value),
            position: uplift * values.len() + index,
            tone: tone(index),
        };
        values.iter().enumerate().map(line).collect()
    }

    /// Percentiles shown: the median, and the largest.
    fn percentiles(&self) -> Vec<usize> {
        let percentiles = &self.stored.percentiles;
        let largest = (0..percentiles.len()).max_by(|&a, &b| percentiles[a].total_cmp(&percentiles[b]));
        let mut shown = vec![self.median()];
        shown.extend(largest.filter(|&largest| largest != self.median()));
        shown
    }

    /// The median, or what is nearest to it.
    fn median(&self) -> usize {
        nearest(&self.stored.percentiles, &[50.0]).first().copied().unwrap_or_default()
    }

    /// What a percentile is called in the names of figures, and in words.
    fn percentile_names(&self, percentile: usize) -> [String; 2] {
        match self.stored.percentiles[percentile] {
            50.0 => ["median", "median"].map(str::to_owned),
            percent => [format!("percentile-{percent}"), format!("percentile {percent}")],
        }
    }

    /// The axis of strengths or slendernesses, from end to end.
    fn abscissa(&self) -> Axis {
        let label = match self.stored.structures {
            StoredStructures::Oscillators { .. } => super::STRENGTH,
            StoredStructures::Blocks { .. } => "slenderness tan α",
        };
        super::spanned(Axis::linear(label), &self.stored.abscissas)
    }

    /// A line to the right of the last abscissa at which the structure overturns.
    fn line_beyond_overturning(&self, line: &Line, ordinates_m: impl Iterator<Item = f64>) -> Series {
        let mut points: Vec<(f64, f64)> = self.stored.abscissas.iter().copied().zip(ordinates_m).collect();
        let from = points.iter().rposition(|point| point.1.is_infinite()).map_or(0, |last| last + 1);
        points.drain(..from);
        Series::sampled(line.name.clone(), points, line.tone)
    }

    /// Rings where the lines of a panel hang on rounding, or those `behind` all of them do: `series` is what is drawn
    /// of `lines`. None where nothing does.
    fn rings(
        &self,
        (place, percentile): (SpectrumPlace, usize),
        (lines, behind): (&[Line], &[usize]),
        series: &[Series],
    ) -> Option<Series> {
        let mut points = Vec::new();
        for (line, drawn) in lines.iter().zip(series) {
            for own in behind.iter().chain([&line.position]) {
                for (at, _) in self.stored.hanging_on_rounding(place, *own, percentile) {
                    let mut here = drawn.points.iter().filter(|point| point.0.to_bits() == at.to_bits());
                    let new = here.find(|point| !point.1.is_nan() && !points.contains(*point));
                    points.extend(new.copied());
                }
            }
        }
        let rings = Series { name: HANGING.to_owned(), points, tone: Tone::Distinct(4), marks: Marks::Rings };
        (!rings.points.is_empty()).then_some(rings)
    }

    /// What rings mean, and from where to where rounding moves the displacements of `lines` in the panels at `places`;
    /// empty where it moves none.
    fn rounding_words(&self, places: impl Iterator<Item = SpectrumPlace>, lines: &[Line], percentile: usize) -> String {
        let mut moved = Vec::new();
        for place in places {
            for line in lines {
                for (at, ordinate) in self.stored.hanging_on_rounding(place, line.position, percentile) {
                    let [lowest, highest] = [ordinate.lowest, ordinate.highest].map(|end| match end {
                        f64::INFINITY => "overturning".to_owned(),
                        end => format!("{} m", metres(end)),
                    });
                    let Line { name, .. } = line;
                    let set = &self.stored.sets[place.set].name;
                    let scaling = &self.stored.scalings[place.scaling];
                    moved.push(format!("{set}, {scaling}, {name} at {at:.4}: {lowest} to {highest}"));
                }
            }
        }
        if moved.is_empty() {
            return String::new();
        }
        let more = match moved.len() - moved.len().min(RANGES_TOLD) {
            0 => String::new(),
            more => format!("; {more} more in the result file"),
        };
        moved.truncate(RANGES_TOLD);
        format!(" Rings: rounding decides these ordinates; lowest to highest: {}{more}.", moved.join("; "))
    }

    /// Every set and way of scaling that is shown, of the first scaling.
    fn places(&self) -> impl Iterator<Item = SpectrumPlace> {
        let sets = self.stored.sets.len();
        self.scaled_by()
            .flat_map(move |scaled_by| (0..sets).map(move |set| SpectrumPlace { set, scaling: 0, scaled_by }))
    }
}

fn capacity_name(capacity_m: f64) -> String {
    if capacity_m.is_infinite() { "u_{cap} = ∞".to_owned() } else { format!("u_{{cap}} = {capacity_m} m") }
}
