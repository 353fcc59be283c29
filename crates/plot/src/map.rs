//! Maps: areas between levels of a value, and hatched regions without one.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "pixels of a drawing: whole numbers far below any limit"
)]

use std::ops::Range;

use plotters::prelude::*;

use super::figure::{Hatch, Map, Region, Scale, Tone};
use super::frame::Frame;
use super::stroke::{Area, FAINT_LINE, Failure, UNITS, ZOOM, colour};

/// Units between the lines of a hatching, and between the points where a line is asked whether it is inside.
const HATCH_SPACE: i32 = 6 * UNITS;
const HATCH_STEP: usize = UNITS as usize / 4;

/// How far into the next row an area reaches that has no part there, as a share of the way.
const REACH: f64 = 0.5;

pub(super) fn draw_map(
    plot: &Area<'_>,
    map: &Map,
    (x_scale, y_scale): (Scale, Scale),
    frame: &Frame,
    shifted: &impl Fn(Vec<(i32, i32)>) -> Vec<(i32, i32)>,
) -> Result<(), Failure> {
    let positions = |scale: Scale, values: &[f64]| values.iter().map(|&value| scale.position(value)).collect();
    let xs: Option<Vec<f64>> = positions(x_scale, &map.x);
    let ys: Option<Vec<f64>> = positions(y_scale, &map.y);
    // a map with a value that a logarithmic axis does not have cannot be drawn
    let (Some(xs), Some(ys)) = (xs, ys) else { return Ok(()) };
    let grid = Grid { xs, ys };
    let pixels = |points: Vec<(f64, f64)>| shifted(points.into_iter().map(|(x, y)| frame.pixel(x, y)).collect());
    let fill = |cover: Cover, colour: RGBColor| -> Result<(), Failure> {
        for polygon in cover.polygons {
            plot.draw(&Polygon::new(pixels(polygon), colour.filled()))?;
        }
        for seam in cover.seams {
            plot.draw(&PathElement::new(pixels(seam.to_vec()), colour.stroke_width(FAINT_LINE)))?;
        }
        Ok(())
    };
    let columns = grid.xs.len();
    // each area covers all that is higher too, and the next is drawn over it: so no seam is seen between them
    let of = map.levels.len();
    for (step, (level, _)) in map.levels.iter().enumerate() {
        let height = |column, row| {
            let value: f64 = map.values[row * columns + column];
            if value.is_finite() { value - level } else { f64::INFINITY }
        };
        fill(grid.cover(height), colour(Tone::Shade { step, of }))?;
    }
    for region in &map.regions {
        let inside = |column, row| region.inside[row * columns + column];
        fill(grid.cover(|column, row| if inside(column, row) { f64::INFINITY } else { f64::NEG_INFINITY }), WHITE)?;
        for ends in grid.hatch(region, frame) {
            draw_hatch(plot, shifted(ends.to_vec()), region.tone)?;
        }
    }
    // the areas have covered the axes
    let corners = shifted(vec![
        (frame.x_pixels.start, frame.y_pixels.start),
        (frame.x_pixels.end, frame.y_pixels.start),
        (frame.x_pixels.end, frame.y_pixels.end),
        (frame.x_pixels.start, frame.y_pixels.end),
        (frame.x_pixels.start, frame.y_pixels.start),
    ]);
    plot.draw(&PathElement::new(corners, BLACK.stroke_width(ZOOM)))?;
    Ok(())
}

/// A line of a hatching; it has no dashes of its own.
pub(super) fn draw_hatch(area: &Area<'_>, ends: Vec<(i32, i32)>, tone: Tone) -> Result<(), Failure> {
    area.draw(&PathElement::new(ends, colour(tone).stroke_width(FAINT_LINE)))?;
    Ok(())
}

/// The points of a map, in positions.
struct Grid {
    xs: Vec<f64>,
    ys: Vec<f64>,
}

/// Polygons that make up an area, and the lines along which they touch, where a drawing would let shine through what is
/// below.
#[derive(Default)]
struct Cover {
    polygons: Vec<Vec<(f64, f64)>>,
    seams: Vec<[(f64, f64); 2]>,
}

/// Where along a row an area lies.
type Interval = (f64, f64);

/// A part of an area that grows row by row: where its left and right edge pass, and its interval in the last row.
struct Strip {
    left: Vec<(f64, f64)>,
    right: Vec<(f64, f64)>,
    last: Interval,
}

impl Strip {
    fn new(interval: Interval, y: f64) -> Self {
        Self { left: vec![(interval.0, y)], right: vec![(interval.1, y)], last: interval }
    }

    fn push(&mut self, interval: Interval, y: f64) {
        self.left.push((interval.0, y));
        self.right.push((interval.1, y));
        self.last = interval;
    }

    fn outline(self) -> Vec<(f64, f64)> {
        self.left.into_iter().chain(self.right.into_iter().rev()).collect()
    }
}

fn meet(a: Interval, b: Interval) -> bool {
    a.0 <= b.1 && b.0 <= a.1
}

/// What of the intervals of a row goes on into what of the next row's. One that meets several is cut in the middle
/// between them.
fn joints(below: &[Interval], above: &[Interval]) -> Vec<(Interval, Interval)> {
    let part = |of: Interval, meeting: Interval, all: &[Interval]| {
        let others = || all.iter().filter(|&&other| meet(of, other));
        let from =
            others().filter(|other| other.1 < meeting.0).map(|other| 0.5 * (other.1 + meeting.0)).reduce(f64::max);
        let to = others().filter(|other| other.0 > meeting.1).map(|other| 0.5 * (other.0 + meeting.1)).reduce(f64::min);
        (from.unwrap_or(of.0), to.unwrap_or(of.1))
    };
    below
        .iter()
        .flat_map(|&a| above.iter().filter(move |&&b| meet(a, b)).map(move |&b| (a, b)))
        .map(|(a, b)| (part(a, b, above), part(b, a, below)))
        .collect()
}

impl Grid {
    /// The area where `height` of a column and row is zero or more.
    ///
    /// Along a row the edges lie where the height passes zero on a straight line, or halfway to a point where it is
    /// infinite.
    fn cover(&self, height: impl Fn(usize, usize) -> f64) -> Cover {
        let mut cover = Cover::default();
        let mut open: Vec<Strip> = Vec::new();
        let mut before: Option<(f64, Vec<Interval>)> = None;
        for (row, &y) in self.ys.iter().enumerate() {
            let now = self.intervals(|column| height(column, row));
            let mut next = Vec::new();
            let (y_before, earlier) = before.unwrap_or((y, Vec::new()));
            let step = y - y_before;
            for (from, to) in joints(&earlier, &now) {
                let mut strip = if let Some(at) = open.iter().position(|strip| strip.last == from) {
                    open.swap_remove(at)
                } else {
                    cover.seams.push([(from.0, y_before), (from.1, y_before)]);
                    Strip::new(from, y_before)
                };
                strip.push(to, y);
                next.push(strip);
            }
            for mut strip in open {
                if !now.iter().any(|&interval| meet(strip.last, interval)) {
                    strip.push(strip.last, y_before + REACH * step);
                }
                cover.polygons.push(strip.outline());
            }
            for &interval in &now {
                if !earlier.iter().any(|&other| meet(other, interval)) {
                    let mut strip = Strip::new(interval, y - REACH * step);
                    strip.push(interval, y);
                    next.push(strip);
                }
            }
            open = next;
            before = Some((y, now));
        }
        cover.polygons.extend(open.into_iter().map(Strip::outline));
        cover
    }

    /// Where along a row the height is zero or more.
    fn intervals(&self, height: impl Fn(usize) -> f64) -> Vec<Interval> {
        let crossing = |column: usize| {
            let (before, after) = (height(column - 1), height(column));
            let share = if before.is_finite() && after.is_finite() { before / (before - after) } else { 0.5 };
            self.xs[column - 1] + share * (self.xs[column] - self.xs[column - 1])
        };
        let mut found = Vec::new();
        let mut start = None;
        for column in 0..self.xs.len() {
            match (height(column) >= 0.0, start) {
                (true, None) => start = Some(if column == 0 { self.xs[0] } else { crossing(column) }),
                (false, Some(from)) => {
                    found.push((from, crossing(column)));
                    start = None;
                }
                _ => {}
            }
        }
        if let (Some(from), Some(&last)) = (start, self.xs.last()) {
            found.push((from, last));
        }
        found
    }

    /// The hatching of a region, in pixels.
    fn hatch(&self, region: &Region, frame: &Frame) -> Vec<[(i32, i32); 2]> {
        let columns = self.xs.len();
        hatching(region.hatch, frame.x_pixels.clone(), frame.y_pixels.clone(), |pixel| {
            let (x, y) = frame.position(pixel);
            nearest(&self.xs, x)
                .zip(nearest(&self.ys, y))
                .is_some_and(|(column, row)| region.inside[row * columns + column])
        })
    }
}

/// Which of increasing values is nearest; none beyond them.
fn nearest(values: &[f64], wanted: f64) -> Option<usize> {
    let above = values.partition_point(|value| *value < wanted);
    match (above.checked_sub(1), values.get(above)) {
        (None, Some(first)) => (*first == wanted).then_some(0),
        (Some(below), Some(value)) => Some(if wanted - values[below] < value - wanted { below } else { above }),
        (_, None) => None,
    }
}

/// Lines of a hatching within a rectangle, as far as they are `inside`.
pub(super) fn hatching(
    hatch: Hatch,
    x_pixels: Range<i32>,
    y_pixels: Range<i32>,
    inside: impl Fn((i32, i32)) -> bool,
) -> Vec<[(i32, i32); 2]> {
    let (wide, high) = (x_pixels.end - x_pixels.start, y_pixels.end - y_pixels.start);
    let mut lines = Vec::new();
    for offset in (HATCH_SPACE / 2..wide + high).step_by(HATCH_SPACE as usize) {
        let mut line: Option<[(i32, i32); 2]> = None;
        // down a line that rises to the right, seen from the left edge or the top
        for along in ((offset - high).max(0)..=offset.min(wide)).step_by(HATCH_STEP) {
            let y = match hatch {
                Hatch::Rising => y_pixels.start + offset - along,
                Hatch::Falling => y_pixels.end - offset + along,
            };
            let pixel = (x_pixels.start + along, y);
            match (&mut line, inside(pixel)) {
                (Some(line), true) => line[1] = pixel,
                (None, true) => line = Some([pixel, pixel]),
                (_, false) => lines.extend(line.take()),
            }
        }
        lines.extend(line);
    }
    lines.retain(|[from, to]| from != to);
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(columns: u32, rows: u32) -> Grid {
        Grid { xs: (0..columns).map(f64::from).collect(), ys: (0..rows).map(f64::from).collect() }
    }

    /// Area by the shoelace formula.
    fn area(polygon: &[(f64, f64)]) -> f64 {
        let next = polygon.iter().cycle().skip(1);
        0.5 * polygon.iter().zip(next).map(|(a, b)| a.0 * b.1 - b.0 * a.1).sum::<f64>().abs()
    }

    #[test]
    fn the_edge_of_a_plane_is_straight() {
        // x + y/2 >= 3.25 on 0..10 by 0..4, whose edge begins and ends between points
        let found = grid(11, 5).cover(|column, row| column as f64 + 0.5 * row as f64 - 3.25).polygons;
        assert_eq!(found.len(), 1);
        assert!((area(&found[0]) - (40.0 - 4.0 * f64::midpoint(3.25, 1.25))).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn a_hole_is_left_out() {
        let ring = |column: usize, row: usize| {
            let distance = (column as f64 - 20.0).hypot(row as f64 - 20.0);
            (distance - 6.0).min(15.0 - distance)
        };
        let found = grid(41, 41).cover(ring).polygons;
        let covered: f64 = found.iter().map(|polygon| area(polygon)).sum();
        let expected = std::f64::consts::PI * (15.0_f64.powi(2) - 6.0_f64.powi(2));
        assert!((covered / expected - 1.0).abs() < 0.02, "{covered} {expected}");
        assert!(found.len() > 3, "below the hole, beside it, above it");
        // all corners lie on the ring, but for a cell where parts begin and end
        for (x, y) in found.into_iter().flatten() {
            let distance = (x - 20.0).hypot(y - 20.0);
            assert!((4.5..15.6).contains(&distance), "({x}, {y})");
        }
    }

    #[test]
    fn a_jump_lies_halfway() {
        let found = grid(5, 2).cover(|column, _| if column < 2 { f64::NEG_INFINITY } else { f64::INFINITY }).polygons;
        assert_eq!(found.len(), 1);
        assert!((area(&found[0]) - 2.5).abs() < 1e-12, "{found:?}");
        assert!(grid(3, 3).cover(|_, _| -1.0).polygons.is_empty());
    }

    #[test]
    fn where_parts_join_their_edges_stay_straight() {
        // left of the slit the area begins late, which does not bend its edge far to the right
        let height = |column: usize, row: usize| {
            let (x, y) = (column as f64, row as f64);
            if (3..=4).contains(&column) && row < 2 { -1.0 } else { 20.5 - x - 3.0 * y }
        };
        let polygons = grid(31, 5).cover(height).polygons;
        for (x, y) in polygons.into_iter().flatten().filter(|point| point.0 > 6.0) {
            assert!((x + 3.0 * y - 20.5).abs() < 0.5, "({x}, {y})");
        }
    }

    #[test]
    fn a_hatching_stays_inside() {
        for hatch in [Hatch::Rising, Hatch::Falling] {
            let inside = |(x, y): (i32, i32)| (400..=1200).contains(&x) && y >= 500;
            let lines = hatching(hatch, 160..2000, 80..1600, inside);
            assert!(lines.len() > 10);
            for [from, to] in lines {
                assert!(inside(from) && inside(to) && from.0 < to.0, "{hatch:?} {from:?} {to:?}");
                assert_eq!((to.0 - from.0).abs(), (to.1 - from.1).abs(), "{hatch:?}");
                assert_eq!(to.1 < from.1, hatch == Hatch::Rising);
            }
        }
    }

    #[test]
    fn the_nearest_point() {
        let values = [0.0, 1.0, 3.0];
        assert_eq!([0.0, 0.4, 0.6, 1.9, 2.1, 3.0].map(|x| nearest(&values, x)), [0, 0, 1, 1, 2, 2].map(Some));
        assert_eq!([-0.1, 3.1].map(|x| nearest(&values, x)), [None; 2]);
    }
}
