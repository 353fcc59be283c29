use super::super::stroke::{FAINT_LINE, LINE};
use super::*;
use crate::{Axis, Band, Marks, Panel, Series, Tone, png};

const LOOK: Look = Look { width: Width::Double, title: false };

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
fn a_thin_line_has_the_colour_of_another_and_no_dashes() {
    let of_tone = |tone: Tone| {
        let line = Series::line("line", vec![(0.0, 1.0), (1.0, 2.0)], tone);
        let panels = vec![Panel::lines("", Axis::linear("x"), Axis::linear("y"), vec![line])];
        let drawn = svg(&Figure { panels, columns: 1, remark: String::new(), ..figure() }, LOOK).unwrap().svg;
        let lines = drawn.split("stroke=\"#D55E00\" ").skip(1).map(|rest| rest.split("/>").next().unwrap().to_owned());
        lines.collect::<Vec<String>>()
    };
    // the line and its sample in the legend
    let (thick, thin) = (of_tone(Tone::Distinct(1)), of_tone(Tone::Thin(1)));
    assert_eq!((thick.len(), thin.len()), (2, 2));
    assert!(thick.iter().all(|line| line.contains("stroke-dasharray") && line.contains(&format!("\"{LINE}\""))));
    assert!(
        thin.iter().all(|line| !line.contains("stroke-dasharray") && line.contains(&format!("\"{FAINT_LINE}\""))),
        "{thin:?}"
    );
}

#[test]
fn everything_lies_within_the_drawing() {
    for width in [Width::Single, Width::Double] {
        let drawing = svg(&figure(), Look { width, title: true }).unwrap();
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
    let drawing = svg(&figure(), LOOK).unwrap();
    // the line with gaps, in pieces and in the legend; the others are full or thin
    let dashed = drawing.svg.matches("stroke=\"#D55E00\" stroke-width=\"12\" stroke-dasharray=\"56 24\"").count();
    assert_eq!(dashed, drawing.svg.matches("stroke=\"#D55E00\"").count());
    assert!(dashed > 6, "{dashed}");
    assert_eq!(drawing.svg.matches("stroke-dasharray").count(), dashed);
}

#[test]
fn a_place_turns_pixels_into_values() {
    let place = &svg(&figure(), LOOK).unwrap().places[2];
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
    assert!(svg(&figure, LOOK).is_ok());
    figure.panels.clear();
    assert!(svg(&figure, LOOK).is_ok());
}

#[test]
fn an_image_has_the_resolution_asked_for() {
    let drawing = svg(&figure(), Look { width: Width::Single, ..LOOK }).unwrap();
    match png(&drawing.svg, 192.0) {
        Ok(image) => {
            // width and height stand in the header of a PNG
            let number = |at: usize| u32::from_be_bytes(image[at..at + 4].try_into().unwrap());
            assert_eq!((number(16), number(20)), (2 * drawing.size.0, 2 * drawing.size.1));
            // and says how many dots there are to a metre
            let said = image.windows(4).position(|name| name == b"pHYs").unwrap();
            assert_eq!((number(said + 4), number(said + 8), image[said + 12]), (7559, 7559, 1));
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
        svg(&figure, LOOK).unwrap().svg
    };
    let circles = |svg: &str, filled: &str| {
        svg.lines().filter(|line| line.starts_with("<circle") && line.contains(&format!("fill=\"{filled}\""))).count()
    };
    let (dots, rings) = (marked(Marks::Only), marked(Marks::Rings));
    assert_eq!([circles(&dots, "#000000"), circles(&dots, "none"), circles(&dots, "#FFFFFF")], [1, 0, 0]);
    assert_eq!([circles(&rings, "#000000"), circles(&rings, "none"), circles(&rings, "#FFFFFF")], [0, 1, 1]);
}

#[test]
fn a_figure_has_a_title_only_on_request() {
    let [with, without] = [true, false].map(|title| svg(&figure(), Look { title, ..LOOK }).unwrap());
    assert!(with.svg.contains("A test") && !without.svg.contains("A test"));
    assert!(without.size.1 < with.size.1, "and no gap is left for it");
    assert!(without.svg.contains("synthetic"), "what warns stays");
}

#[test]
fn texts_are_no_smaller_than_journals_take() {
    for width in [Width::Single, Width::Double] {
        let drawing = svg(&figure(), Look { width, ..LOOK }).unwrap();
        let sizes = drawing.svg.split("<text ").skip(1).map(|text| {
            let size = text.split_once("font-size=\"").unwrap().1;
            size[..size.find('"').unwrap()].parse::<f64>().unwrap() / f64::from(ZOOM) * 72.0 / 96.0
        });
        let smallest = sizes.fold(f64::INFINITY, f64::min);
        assert!(smallest > 6.99, "{smallest} points");
    }
}

#[test]
fn few_computed_values_are_marked() {
    let circles = |count: u32| {
        let points = (0..count).map(|i| (f64::from(i), 1.0)).collect();
        let panel =
            Panel::lines("", Axis::linear("x"), Axis::linear("y"), vec![Series::sampled("s", points, Tone::Faint)]);
        panel_svg(&panel).unwrap().svg.matches("<circle").count()
    };
    assert_eq!((circles(5), circles(300)), (5, 0));
}

#[test]
fn panels_share_a_range_if_they_measure_the_same() {
    let panel = |label: &str, top: f64| {
        let line = Series::line("", vec![(0.0, 0.0), (1.0, top)], Tone::Faint);
        Panel::lines("", Axis::linear("x"), Axis::linear(label), vec![line])
    };
    let mut panels = vec![panel("u, m", 1.0), panel("u, m", 4.0), panel("u, m", f64::NAN)];
    crate::share_y(&mut panels);
    let ranges: Vec<_> = panels.iter().map(|panel| panel_svg(panel).unwrap().places[0].y_range).collect();
    assert_eq!(ranges, [(0.0, 4.2); 3]);
    let mut panels = vec![panel("u, m", 1.0), panel("v, m", 4.0)];
    crate::share_y(&mut panels);
    assert!(panels.iter().all(|panel| panel.y.range.is_none()));
}

#[test]
fn a_legend_in_parts_is_that_of_the_figure() {
    let names: Vec<String> = swatches(&figure()).unwrap().into_iter().map(|swatch| swatch.name).collect();
    assert_eq!(names, ["full", "with a gap", "band"]);
}
