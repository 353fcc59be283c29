#![allow(clippy::unwrap_used)]
use super::*;
use crate::{Axis, Band, Panel, Series, png};

fn figure() -> Figure {
    let line = |name: &str, factor: f64, tone: Tone| {
        Series::line(
            name,
            (0..50).map(|i| (f64::from(i) / 49.0, factor * (-f64::from(i) / 10.0).exp())).collect(),
            tone,
        )
    };
    let mut gap = line("with a gap", 0.5, Tone::Distinct(1));
    gap.points[20].1 = f64::NAN;
    gap.points[30].1 = f64::INFINITY;
    let panel = |y: Axis| Panel {
        map: None,
        title: "<Site & others>".to_owned(),
        x: Axis::linear("strength"),
        y,
        bands: vec![Band {
            name: "band".to_owned(),
            points: vec![(0.0, 0.1, 1.0), (0.5, 0.0, 0.5), (1.0, 0.01, f64::INFINITY)],
            tone: Tone::Distinct(0),
        }],
        series: vec![line("full", 1.0, Tone::Distinct(0)), gap.clone(), line("", 0.2, Tone::Faint)],
    };
    Figure {
        id: "test".to_owned(),
        title: "A test".to_owned(),
        caption: String::new(),
        remark: "synthetic".to_owned(),
        panels: vec![
            panel(Axis::log("u, m")),
            panel(Axis::linear("u, m")),
            panel(Axis::linear("u, m").between(0.2, 0.4)),
        ],
        columns: 2,
    }
}

#[test]
fn everything_lies_within_the_drawing() {
    for width in [Width::Single, Width::Double] {
        let drawing = svg(&figure(), width).unwrap();
        assert_eq!(drawing.places.len(), 3);
        assert!(drawing.svg.contains("&lt;Site &amp; others&gt;") && drawing.svg.contains("synthetic"));
        assert!(!drawing.svg.contains("NaN") && !drawing.svg.contains("inf"));
        // coordinates of lines and areas
        for points in drawing.svg.split("points=\"").skip(1) {
            for point in points.split('"').next().unwrap().split_whitespace() {
                let (x, y) = point.split_once(',').unwrap();
                let (x, y): (i32, i32) = (x.parse().unwrap(), y.parse().unwrap());
                let (wide, high) = (drawing.size.0 as i32 * UNITS, drawing.size.1 as i32 * UNITS);
                assert!((0..=wide).contains(&x) && (0..=high).contains(&y), "{point}");
            }
        }
    }
}

#[test]
fn each_tone_has_its_dashes() {
    let drawing = svg(&figure(), Width::Double).unwrap();
    // the line with gaps, in pieces and in the legend; the others are full or thin
    let dashed = drawing.svg.matches("stroke=\"#D55E00\" stroke-width=\"12\" stroke-dasharray=\"56 24\"").count();
    assert_eq!(dashed, drawing.svg.matches("stroke=\"#D55E00\"").count());
    assert!(dashed > 6, "{dashed}");
    assert_eq!(drawing.svg.matches("stroke-dasharray").count(), dashed);
}

#[test]
fn a_place_turns_pixels_into_values() {
    let place = &svg(&figure(), Width::Double).unwrap().places[2];
    assert_eq!(place.y_range, (0.2, 0.4));
    assert!(place.x_pixels.1 - place.x_pixels.0 > 200 * UNITS && place.y_pixels.1 - place.y_pixels.0 > 100 * UNITS);
}

#[test]
fn a_figure_without_numbers_can_be_drawn() {
    let mut figure = figure();
    for panel in &mut figure.panels {
        panel.bands.clear();
        for series in &mut panel.series {
            series.points.iter_mut().for_each(|point| point.1 = f64::NAN);
        }
    }
    assert!(svg(&figure, Width::Double).is_ok());
    figure.panels.clear();
    assert!(svg(&figure, Width::Double).is_ok());
}

#[test]
fn an_image_has_the_resolution_asked_for() {
    let drawing = svg(&figure(), Width::Single).unwrap();
    match png(&drawing.svg, 192.0) {
        Ok(image) => {
            // width and height stand in the header of a PNG
            let number = |at: usize| u32::from_be_bytes(image[at..at + 4].try_into().unwrap());
            assert_eq!((number(16), number(20)), (2 * drawing.size.0, 2 * drawing.size.1));
        }
        Err(error) => assert!(error.to_string().contains("font"), "{error}"),
    }
}

#[test]
fn rings_are_hollow() {
    let marked = |marks| {
        let mut figure = figure();
        let points = vec![(0.5, 0.3)];
        figure.panels[0].series.push(Series { name: String::new(), points, tone: Tone::Distinct(4), marks });
        svg(&figure, Width::Double).unwrap().svg
    };
    let circles = |svg: &str, filled: &str| {
        svg.lines().filter(|line| line.starts_with("<circle") && line.contains(&format!("fill=\"{filled}\""))).count()
    };
    let (dots, rings) = (marked(Marks::Only), marked(Marks::Rings));
    assert_eq!([circles(&dots, "#000000"), circles(&dots, "none"), circles(&dots, "#FFFFFF")], [1, 0, 0]);
    assert_eq!([circles(&rings, "#000000"), circles(&rings, "none"), circles(&rings, "#FFFFFF")], [0, 1, 1]);
}
