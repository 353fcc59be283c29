//! The numbers of an answer with their bands, below each other on one axis, as SVG: how sure they are at a glance.

use std::fmt::Write;

use uplift::result::FindingRow;
use uplift_plot::{Scale, escaped, ticks};

/// Pixels of the drawing, of the names at its left, and of a line.
const WIDE: f64 = 640.0;
const LEFT: f64 = 190.0;
const RIGHT: f64 = 24.0;
const LINE: f64 = 19.0;
/// Labels on an axis, about.
const TICKS: usize = 6;

/// A unit with the axis on which its numbers stand.
const UNITS: [(&str, Scale, &str); 2] =
    [("m", Scale::Linear, "m"), ("1/yr", Scale::Log, "mean annual frequency, 1/yr")];

/// One drawing for displacements and one for frequencies, where there are such with bands.
pub(crate) fn bands(rows: &[FindingRow]) -> Vec<String> {
    UNITS.iter().filter_map(|(unit, scale, label)| drawing(rows, (unit, *scale, label))).collect()
}

/// A band of a number.
struct Bar<'a> {
    row: &'a FindingRow,
    /// Where it begins; none where it has no lower limit.
    lower: Option<f64>,
}

impl<'a> Bar<'a> {
    fn of(row: &'a FindingRow, scale: Scale) -> Self {
        let [lower, _] = row.limits;
        // nothing of a frequency is no place on an axis of powers of ten, and a demand may leave nothing of a capacity
        let is_placed = lower.is_finite() && (scale == Scale::Linear || lower > 0.0);
        Self { row, lower: is_placed.then_some(lower) }
    }
}

fn drawing(rows: &[FindingRow], (unit, scale, label): (&str, Scale, &str)) -> Option<String> {
    let is_banded = |row: &&FindingRow| row.unit == unit && !row.limits[1].is_nan();
    let bars: Vec<Bar<'_>> = rows.iter().filter(is_banded).map(|row| Bar::of(row, scale)).collect();
    let axis = Axis::of(&bars, scale)?;
    let mut text = String::new();
    let mut line = 0.0;
    let mut before: Option<[&str; 3]> = None;
    for bar in &bars {
        let Bar { row, lower } = bar;
        let names = [row.quantity.as_str(), &row.site, &row.im];
        if before.replace(names) != Some(names) {
            let named: Vec<&str> = names.into_iter().filter(|name| !name.is_empty()).collect();
            let name = escaped(&named.join(", "));
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
            escaped(&row.band)
        );
        let (value, upper) = (row.value, row.limits[1]);
        let from = lower.map_or(LEFT, |lower| axis.x(lower));
        let to = if upper.is_finite() { axis.x(upper) } else { WIDE - RIGHT };
        let _ = writeln!(
            text,
            "<path d=\"M{from:.1} {y:.1}H{to:.1}\" stroke=\"#0072b2\" stroke-width=\"5\" stroke-opacity=\"0.45\"/>"
        );
        // what has no end on the axis goes on beyond it
        if lower.is_none() {
            arrow(&mut text, (LEFT, y), -1.0);
        }
        if upper.is_infinite() {
            arrow(&mut text, (WIDE - RIGHT, y), 1.0);
        }
        if value.is_finite() && (scale == Scale::Linear || value > 0.0) {
            let _ = writeln!(text, "<circle cx=\"{:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"#1b1e23\"/>", axis.x(value));
        }
    }
    let below = line * LINE + 4.0;
    axis.draw(&mut text, below, label);
    let high = below + 40.0;
    Some(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDE} {high}\" width=\"{WIDE}\" height=\"{high}\" \
         role=\"img\" aria-label=\"Numbers (dots) and their bands (bars), {label}\" font-family=\"sans-serif\" \
         font-size=\"12\" fill=\"#1b1e23\">\n{text}</svg>"
    ))
}

fn arrow(text: &mut String, (x, y): (f64, f64), towards: f64) {
    let (back, top, bottom) = (x - 7.0 * towards, y - 5.0, y + 5.0);
    let _ = writeln!(text, "<path d=\"M{x:.1} {y:.1}L{back:.1} {top:.1}V{bottom:.1}Z\" fill=\"#0072b2\"/>");
}

/// A horizontal axis.
struct Axis {
    scale: Scale,
    /// Positions of its ends: logarithms of powers of ten.
    ends: [f64; 2],
}

impl Axis {
    /// One that holds all `bars`; none where these have no extent.
    fn of(bars: &[Bar<'_>], scale: Scale) -> Option<Self> {
        let ends = bars.iter().flat_map(|bar| {
            let Bar { row, lower } = bar;
            [*lower, Some(row.limits[1]), Some(row.value)].into_iter().flatten()
        });
        let placed = |value: f64| match scale {
            Scale::Linear => value,
            Scale::Log => value.log10(),
        };
        let positions = ends.map(placed).filter(|position| position.is_finite());
        let [least, most] = positions.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], position| {
            [least.min(position), most.max(position)]
        });
        let ends = match scale {
            // a displacement is seen from nothing on
            Scale::Linear => [least.min(0.0), most + 0.04 * (most - least.min(0.0))],
            Scale::Log => [least - 0.1, most + 0.1],
        };
        (ends[0] < ends[1] && ends.iter().all(|end| end.is_finite())).then_some(Self { scale, ends })
    }

    /// The pixel of a value.
    fn x(&self, value: f64) -> f64 {
        let position = if self.scale == Scale::Log { value.log10() } else { value };
        let share = (position - self.ends[0]) / (self.ends[1] - self.ends[0]);
        LEFT + share.clamp(0.0, 1.0) * (WIDE - RIGHT - LEFT)
    }

    fn draw(&self, text: &mut String, y: f64, label: &str) {
        let right = WIDE - RIGHT;
        let _ = writeln!(text, "<path d=\"M{LEFT} {y:.1}H{right}\" stroke=\"#1b1e23\"/>");
        for tick in ticks(self.scale, self.ends[0], self.ends[1], TICKS) {
            let (value, shown) = match self.scale {
                Scale::Linear => (tick, format!("{}", (tick * 1e6).round() / 1e6)),
                Scale::Log => {
                    let value = 10.0_f64.powf(tick);
                    (value, format!("{value:.0e}"))
                }
            };
            let x = self.x(value);
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
        // the axis goes from 0 to 0.52
        let x = |value: f64| LEFT + value / 0.52 * (WIDE - RIGHT - LEFT);
        assert!(drawn[0].contains(&format!("M{:.1} 30.0H{:.1}", x(0.1), x(0.4))), "{}", drawn[0]);
        assert!(
            drawn[0].contains(&format!("cx=\"{:.1}\"", x(0.2))) && drawn[0].contains("demand &lt;1&gt;, Here &amp;")
        );
        assert_eq!(drawn[0].matches("font-weight").count(), 1, "a number with two bands has one heading");
    }

    #[test]
    fn what_has_no_end_goes_on() {
        let frequencies = bands(&[row(2e-4, [0.0, 1e-3], "1/yr"), row(0.0, [f64::NAN, 1e-5], "1/yr")]);
        assert_eq!(frequencies[0].matches("<circle").count(), 1, "none seen has no place among powers of ten");
        assert_eq!(frequencies[0].matches("fill=\"#0072b2\"").count(), 2);
        let demand = bands(&[row(f64::INFINITY, [0.3, f64::INFINITY], "m")]);
        assert!(demand[0].contains("fill=\"#0072b2\"") && !demand[0].contains("<circle"), "{}", demand[0]);
        assert_eq!(bands(&[row(f64::INFINITY, [f64::INFINITY; 2], "m")]), Vec::<String>::new());
    }
}
