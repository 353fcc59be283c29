//! The numbers of an answer with their bands, below each other on one axis, as SVG, at a glance.

use std::fmt::Write;

use uplift::result::FindingRow;
use uplift_plot::{Scale, escaped, ticks};

/// Pixels of the drawing, of the names at its left, and of a line.
const WIDE: f64 = 480.0;
const LEFT: f64 = 190.0;
const RIGHT: f64 = 24.0;
const LINE: f64 = 19.0;
/// Letters that the space for names has room for.
const LETTERS: usize = 32;
/// What an axis has beyond the numbers at either end, as a share of what they take.
const AROUND: f64 = 0.04;
/// Labels on an axis, about.
const TICKS: usize = 4;

/// A unit with the axis on which its numbers stand.
const UNITS: [(&str, Scale, &str); 2] = [("m", Scale::Linear, "m"), ("1/yr", Scale::Log, "annual rate, 1/yr")];

/// A drawing for each quantity of metres, whose sizes need not be alike, and one for all frequencies, where there are
/// such with bands.
pub(crate) fn bands(rows: &[FindingRow]) -> Vec<String> {
    let mut drawings = Vec::new();
    for (unit, scale, label) in UNITS {
        let banded: Vec<&FindingRow> = rows.iter().filter(|row| row.unit == unit && !row.limits[1].is_nan()).collect();
        let alike = |a: &&FindingRow, b: &&FindingRow| scale == Scale::Log || a.quantity == b.quantity;
        drawings.extend(banded.chunk_by(alike).filter_map(|rows| drawing(rows, (scale, label))));
    }
    drawings
}

fn drawing(rows: &[&FindingRow], (scale, label): (Scale, &str)) -> Option<String> {
    let axis = Axis::from_rows(rows, scale)?;
    let fits = |label: &String| label.chars().count() <= LETTERS;
    let mut text = String::new();
    let mut line = 0.0;
    let mut before: Option<[&str; 3]> = None;
    for row in rows {
        let names = [row.quantity.as_str(), &row.site, &row.im];
        if before.replace(names) != Some(names) {
            let named: Vec<&str> = names.into_iter().filter(|name| !name.is_empty()).collect();
            let unit = if row.unit == "1/yr" { "a year" } else { &row.unit };
            let name = escaped(&format!("{}: {} {unit}", named.join(", "), row.shown()));
            line += 1.0;
            let _ = writeln!(text, "<text x=\"4\" y=\"{:.1}\" font-weight=\"bold\">{name}</text>", line * LINE - 4.0);
        }
        line += 1.0;
        let y = line * LINE - 8.0;
        let _ = writeln!(
            text,
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\" fill=\"#5b6270\">{}</text>",
            LEFT - 10.0,
            y + 4.0,
            escaped(Some(format!("{} {}", row.band, row.band_shown())).filter(fits).as_ref().unwrap_or(&row.band))
        );
        let ends = row.limits.map(|limit| axis.place(limit));
        let [from, to] = ends.map(|end| axis.pixel(end));
        let _ = writeln!(
            text,
            "<path d=\"M{from:.1} {y:.1}H{to:.1}\" stroke=\"#0072b2\" stroke-width=\"5\" stroke-opacity=\"0.45\"/>"
        );
        // what has no end on the axis lies, or goes on, beyond it
        if ends.contains(&Place::Below) {
            arrow(&mut text, (LEFT, y), -1.0);
        }
        if ends.contains(&Place::Above) {
            arrow(&mut text, (WIDE - RIGHT, y), 1.0);
        }
        if let at @ Place::At(_) = axis.place(row.value) {
            let x = axis.pixel(at);
            let _ = writeln!(text, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"#1b1e23\"/>");
        }
    }
    let below = line * LINE + 4.0;
    axis.draw(&mut text, below, label);
    let high = below + 40.0;
    Some(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDE} {high}\" width=\"{WIDE}\" height=\"{high}\" \
         role=\"img\" aria-label=\"Values (dots) with their 90 % confidence bands (bars), {label}\" \
         font-family=\"sans-serif\" font-size=\"12\" fill=\"#1b1e23\">\n{text}</svg>"
    ))
}

fn arrow(text: &mut String, (x, y): (f64, f64), towards: f64) {
    let (back, top, bottom) = (x - 7.0 * towards, y - 5.0, y + 5.0);
    let _ = writeln!(text, "<path d=\"M{x:.1} {y:.1}L{back:.1} {top:.1}V{bottom:.1}Z\" fill=\"#0072b2\"/>");
}

/// Where a number lies on an axis.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// Below all numbers: minus infinity, nothing among powers of ten, and no lower limit.
    Below,
    /// At a position: the logarithm of a power of ten.
    At(f64),
    /// Above all numbers.
    Above,
}

/// A horizontal axis.
struct Axis {
    scale: Scale,
    /// Positions of its ends.
    ends: [f64; 2],
}

impl Axis {
    /// One that holds all numbers and limits of `rows`; none where these have no extent.
    fn from_rows(rows: &[&FindingRow], scale: Scale) -> Option<Self> {
        let axis = Self { scale, ends: [0.0; 2] };
        let numbers = rows.iter().flat_map(|row| [row.limits[0], row.limits[1], row.value]);
        let positions =
            numbers.filter_map(|number| if let Place::At(at) = axis.place(number) { Some(at) } else { None });
        let [least, most] = positions.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], position| {
            [least.min(position), most.max(position)]
        });
        let around = AROUND * (most - least);
        let ends = [least - around, most + around];
        (least < most && ends.iter().all(|end| end.is_finite())).then_some(Self { scale, ends })
    }

    fn place(&self, number: f64) -> Place {
        let position = if self.scale == Scale::Log { number.log10() } else { number };
        match position {
            at if at.is_finite() => Place::At(at),
            at if at > 0.0 => Place::Above,
            _ => Place::Below,
        }
    }

    fn pixel(&self, place: Place) -> f64 {
        let share = match place {
            Place::Below => 0.0,
            Place::At(position) => (position - self.ends[0]) / (self.ends[1] - self.ends[0]),
            Place::Above => 1.0,
        };
        LEFT + share * (WIDE - RIGHT - LEFT)
    }

    fn draw(&self, text: &mut String, y: f64, label: &str) {
        let right = WIDE - RIGHT;
        let _ = writeln!(text, "<path d=\"M{LEFT} {y:.1}H{right}\" stroke=\"#1b1e23\"/>");
        for tick in ticks(self.scale, self.ends[0], self.ends[1], TICKS) {
            let shown = match self.scale {
                Scale::Linear => format!("{}", (tick * 1e6).round() / 1e6),
                Scale::Log => format!("{:.1e}", 10.0_f64.powf(tick)).replace(".0e", "e"),
            };
            let x = self.pixel(Place::At(tick));
            let _ = writeln!(
                text,
                "<path d=\"M{x:.1} {y:.1}v5\" stroke=\"#1b1e23\"/><text x=\"{x:.1}\" y=\"{:.1}\" \
                 text-anchor=\"middle\">{shown}</text>",
                y + 18.0
            );
        }
        let middle = 0.5 * (LEFT + right);
        let _ = writeln!(
            text,
            "<text x=\"{middle}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            y + 34.0,
            escaped(label)
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(value: f64, limits: [f64; 2], unit: &str) -> FindingRow {
        let (quantity, site, im) = ("demand <1>".to_owned(), "Here & there".to_owned(), "PGV".to_owned());
        FindingRow { quantity, site, im, value, limits, unit: unit.to_owned(), band: "records".to_owned() }
    }

    #[test]
    fn a_bar_lies_where_its_limits_are() {
        let drawn = bands(&[row(0.2, [0.1, 0.4], "m"), row(0.2, [0.0, 0.5], "m"), row(0.3, [f64::NAN; 2], "m")]);
        assert_eq!(drawn.len(), 1, "a number without a band is not drawn");
        // the axis goes from -0.02 to 0.52
        let x = |value: f64| LEFT + (value + 0.02) / 0.54 * (WIDE - RIGHT - LEFT);
        assert!(drawn[0].contains(&format!("M{:.1} 30.0H{:.1}", x(0.1), x(0.4))), "{}", drawn[0]);
        assert!(
            drawn[0].contains(&format!("cx=\"{:.1}\"", x(0.2)))
                && drawn[0].contains("demand &lt;1&gt;, Here &amp;")
                && drawn[0].contains("PGV: 0.2000 m")
                && drawn[0].contains("records 0.1000 to 0.4000")
        );
        assert_eq!(drawn[0].matches("font-weight").count(), 1, "a number with two bands has one heading");
        // numbers of other sizes have an axis of their own
        let other = FindingRow { quantity: "capacity less demand".to_owned(), ..row(9.2, [9.1, 9.4], "m") };
        assert_eq!(bands(&[row(0.2, [0.1, 0.4], "m"), other]).len(), 2);
    }

    #[test]
    fn what_has_no_end_continues() {
        let frequencies = bands(&[row(2e-4, [0.0, 1e-3], "1/yr"), row(0.0, [f64::NAN, 1e-5], "1/yr")]);
        assert_eq!(frequencies[0].matches("<circle").count(), 1, "none seen has no place among powers of ten");
        assert_eq!(frequencies[0].matches("fill=\"#0072b2\"").count(), 2);
        let demand = bands(&[row(f64::INFINITY, [0.3, f64::INFINITY], "m"), row(0.2, [0.1, 0.4], "m")]);
        let right = WIDE - RIGHT;
        assert!(
            demand[0].contains(&format!("H{right:.1}")) && demand[0].matches("<circle").count() == 1,
            "{}",
            demand[0]
        );
        assert_eq!(demand[0].matches("fill=\"#0072b2\"").count(), 1);
    }

    /// What overturns however often lies beyond the axis, and leaves nothing open.
    #[test]
    fn what_lies_beyond_the_axis_has_an_arrow_alone() {
        let (beyond, right) = ([f64::INFINITY; 2], WIDE - RIGHT);
        for (limits, x) in [(beyond, right), (beyond.map(|limit: f64| -limit), LEFT)] {
            let drawn = bands(&[row(limits[0], limits, "m"), row(0.2, [0.1, 0.4], "m")]);
            assert!(drawn[0].contains(&format!("M{x:.1} 30.0H{x:.1}")), "{}", drawn[0]);
            assert_eq!(drawn[0].matches("fill=\"#0072b2\"").count(), 1, "one arrow");
        }
        assert_eq!(bands(&[row(f64::INFINITY, beyond, "m")]), Vec::<String>::new());
    }
}
