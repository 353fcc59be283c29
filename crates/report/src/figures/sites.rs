//! Maps of many sites: the displacement at a few strengths, a dot a site.

#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "cells within a map, from 0")]

use std::collections::BTreeMap;
use std::path::Path;

use uplift::UpliftError;
use uplift::result::{ResultFile, SiteArrays};
use uplift::text::{nearest, risk_in_words, rounded};
use uplift::uniform_risk::site_table::SHOWN_ON_MAP;
use uplift::uniform_risk::strength_index;
use uplift_plot::{Axis, Figure, Panel, Series, Tone};

/// Ends of the classes, m.
const ENDS_M: [f64; 13] = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0];
/// Cells of a panel, across and up, of each of which one dot is drawn.
const CELLS: [f64; 2] = [160.0, 120.0];

/// Width over height of a panel.
const ASPECT: f64 = 1.43;
/// How high a map is at least, degrees, and its margin as a share of its height.
const LEAST_HEIGHT_DEG: f64 = 0.1;
const MARGIN: f64 = 0.08;

/// The maps of the many sites beside the result at `path`, one for each measure and probability; none without such. A
/// panel shows one of the `strengths`, or of a few where none is asked for.
pub(super) fn site_maps(
    path: &Path,
    file: &ResultFile,
    strengths: &[f64],
    remark: &str,
) -> Result<Vec<Figure>, UpliftError> {
    let Some(sites) = SiteArrays::read(path, &file.head()?.study_digest())? else { return Ok(Vec::new()) };
    let place = |&wanted: &f64| strength_index(&sites.strengths, wanted);
    let mut shown = strengths.iter().map(place).collect::<Result<Vec<_>, _>>()?;
    if shown.is_empty() {
        shown = nearest(&sites.strengths, &SHOWN_ON_MAP);
    }
    let each = (0..sites.measures.len()).flat_map(|measure| (0..sites.poes.len()).map(move |poe| (measure, poe)));
    Ok(each.map(|place| site_map(&sites, &shown, place, remark)).collect())
}

fn site_map(sites: &SiteArrays, shown: &[usize], (measure, poe): (usize, usize), remark: &str) -> Figure {
    let key = &sites.measures[measure];
    let frame = frame(sites);
    let of = |strength: usize| largest_of_cells(sites, frame, [measure, poe, strength]);
    let dots: Vec<Vec<Dot>> = shown.iter().map(|&strength| of(strength)).collect();
    let classes = Classes::new(dots.iter().flatten().map(|dot| dot.u_m));
    let panel = |(&strength, dots): (&usize, &Vec<Dot>)| {
        let title = format!("strength {}", rounded(sites.strengths[strength], 4));
        let [x, y] = [("longitude, °", frame[0]), ("latitude, °", frame[1])];
        let axis = |(label, [from, to]): (&str, [f64; 2])| Axis::linear(label).between(from, to);
        Panel::lines(title, axis(x), axis(y), classes.series(dots))
    };
    let panels: Vec<Panel> = shown.iter().zip(&dots).map(panel).collect();
    let risk = risk_in_words(sites.poes[poe], sites.years);
    let id = format!("map-{key}-{}pct", rounded(100.0 * sites.poes[poe], 6));
    let title = format!("Displacement of {risk}, by {}", key.to_uppercase());
    let caption = "Displacement that a structure of this uplift strength must accommodate. Where sites overlap, the \
                   largest is drawn.";
    Figure::new(id, title, caption, panels).with_remark(remark)
}

/// From where to where the map goes, longitudes and latitudes: a degree of both is of one length in its middle.
fn frame(sites: &SiteArrays) -> [[f64; 2]; 2] {
    let ends = |values: &[f64]| {
        let of = |choose: fn(f64, f64) -> f64| values.iter().copied().reduce(choose).unwrap_or_default();
        [of(f64::min), of(f64::max)]
    };
    let [x, y] = [ends(&sites.longitude_deg), ends(&sites.latitude_deg)];
    let [middle_x, middle_y] = [x, y].map(|[from, to]| 0.5 * (from + to));
    let shrunk = middle_y.to_radians().cos().max(0.1);
    let height = (y[1] - y[0]).max((x[1] - x[0]) * shrunk / ASPECT).max(LEAST_HEIGHT_DEG) * (1.0 + MARGIN);
    let width = height * ASPECT / shrunk;
    [[middle_x - 0.5 * width, middle_x + 0.5 * width], [middle_y - 0.5 * height, middle_y + 0.5 * height]]
}

/// A site on a map.
#[derive(Clone, Copy)]
struct Dot {
    place: (f64, f64),
    u_m: f64,
}

/// Of the sites with a value those with the largest one of their cell.
fn largest_of_cells(sites: &SiteArrays, [x, y]: [[f64; 2]; 2], [measure, poe, strength]: [usize; 3]) -> Vec<Dot> {
    let cell = |value: f64, [from, to]: [f64; 2], cells: f64| ((value - from) / (to - from) * cells) as u32;
    let mut largest: BTreeMap<(u32, u32), Dot> = BTreeMap::new();
    let places = sites.longitude_deg.iter().zip(&sites.latitude_deg).enumerate();
    for (site, (&longitude, &latitude)) in places {
        let u_m = sites.u_m[[site, measure, poe, strength]];
        if u_m.is_nan() {
            continue;
        }
        let dot = Dot { place: (longitude, latitude), u_m };
        let own = (cell(longitude, x, CELLS[0]), cell(latitude, y, CELLS[1]));
        let kept = largest.entry(own).or_insert(dot);
        if dot.u_m > kept.u_m {
            *kept = dot;
        }
    }
    largest.into_values().collect()
}

/// The classes of displacement that a map tells apart.
struct Classes {
    /// Ends between them, increasing, m.
    ends_m: Vec<f64>,
}

impl Classes {
    fn new(values_m: impl Iterator<Item = f64> + Clone) -> Self {
        let finite = values_m.filter(|value| value.is_finite());
        let (least, most) = (finite.clone().fold(f64::INFINITY, f64::min), finite.fold(0.0, f64::max));
        Self { ends_m: ENDS_M.into_iter().filter(|&end| least < end && end < most).collect() }
    }

    /// The dots of each class, and those that are censored.
    fn series(&self, dots: &[Dot]) -> Vec<Series> {
        let of = self.ends_m.len() + 1;
        let series = |name: String, tone, holds: &dyn Fn(f64) -> bool| {
            let points = dots.iter().filter(|dot| holds(dot.u_m)).map(|dot| dot.place).collect();
            Series::dots(name, points, tone)
        };
        let mut all: Vec<Series> = (0..of)
            .map(|step| {
                let [from, to] =
                    [step.checked_sub(1).map(|before| self.ends_m[before]), self.ends_m.get(step).copied()];
                let name = match (from, to) {
                    (Some(from), Some(to)) => format!("{from} to {to} m"),
                    (Some(from), None) => format!("above {from} m"),
                    (None, Some(to)) => format!("below {to} m"),
                    (None, None) => "displacement".to_owned(),
                };
                let holds =
                    |u_m: f64| u_m.is_finite() && from.is_none_or(|from| u_m >= from) && to.is_none_or(|to| u_m < to);
                series(name, Tone::Shade { step, of }, &holds)
            })
            .collect();
        if dots.iter().any(|dot| dot.u_m.is_infinite()) {
            all.push(series("censored".to_owned(), Tone::Distinct(0), &f64::is_infinite));
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sites(places: &[(f64, f64)]) -> SiteArrays {
        let values: Vec<f64> = (0..places.len()).flat_map(|site| [0.004, 0.03 * site as f64]).collect();
        SiteArrays {
            longitude_deg: places.iter().map(|place| place.0).collect(),
            latitude_deg: places.iter().map(|place| place.1).collect(),
            measures: vec!["pgv".to_owned()],
            poes: vec![0.02],
            years: 50.0,
            strengths: vec![0.1, 0.2],
            u_m: uplift::Array::new([places.len(), 1, 1, 2], values).unwrap_or_else(|error| panic!("{error}")),
        }
    }

    #[test]
    fn every_site_is_in_one_class_and_of_those_that_overlap_the_largest() {
        let sites = sites(&[(10.0, 45.0), (10.000_01, 45.0), (12.0, 44.0)]);
        let figure = site_map(&sites, &[0, 1], (0, 0), "");
        assert_eq!((figure.id.as_str(), figure.panels.len()), ("map-pgv-2pct", 2));
        let named: Vec<(&str, usize)> =
            figure.panels[1].series.iter().map(|own| (own.name.as_str(), own.points.len())).collect();
        let expected = [("below 0.005 m", 0), ("0.005 to 0.01 m", 0), ("0.01 to 0.02 m", 0), ("0.02 to 0.05 m", 1)];
        assert_eq!((&named[..4], named[4]), (&expected[..], ("above 0.05 m", 1)));
    }

    #[test]
    fn a_degree_is_of_one_length_both_ways() {
        let [x, y] = frame(&sites(&[(20.0, 60.0), (24.0, 60.5)]));
        assert!((((x[1] - x[0]) * 60_f64.to_radians().cos()) / (y[1] - y[0]) / ASPECT - 1.0).abs() < 0.02);
        assert!(x[0] < 20.0 && x[1] > 24.0 && y[0] < 60.0 && y[1] > 60.5);
    }
}
