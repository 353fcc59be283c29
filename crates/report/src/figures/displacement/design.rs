//! The design examples (Figures 2.13 and 2.14).

use super::super::DISPLACEMENT;
use super::DisplacementSource;
use uplift::result::{DesignRow, SpectrumPlace, StoredDesign, StoredDesigned, StoredStructures};
use uplift_plot::{Axis, Figure, Marks, Panel, Series, Tone};

/// What is predicted, and what time histories say, as the rows call them.
struct Quantities {
    predicted: String,
    computed: String,
}

/// Where the capacity line meets the spectrum of the endless block, and the design point (Figure 2.13).
pub(super) fn procedure(source: &DisplacementSource<'_>, design: &StoredDesign) -> Vec<Figure> {
    let stored = source.stored;
    let StoredStructures::Blocks { height_m } = &stored.structures else { return Vec::new() };
    let StoredDesigned::Block { height_m: own_m, endless_height_m: endless_m } = design.designed else {
        return Vec::new();
    };
    let rows = &design.rows;
    let line_of = |wanted_m: f64| height_m.iter().position(|&known_m| known_m == wanted_m);
    let percentile = source.median();
    let mut figures = Vec::new();
    for place in source.places() {
        let set = &stored.sets[place.set].name;
        let panel = |scaling: usize| {
            let place = SpectrumPlace { scaling, ..place };
            let tangent = value(rows, source, place, "tan_alpha_design");
            let spectrum = |wanted_m: f64, tone: usize| {
                let ordinates_m = stored.percentile_m(place, line_of(wanted_m)?, percentile);
                let points = stored.abscissas.iter().copied().zip(ordinates_m.iter().copied()).collect();
                Some(Series::line(format!("2H = {wanted_m} m"), points, Tone::Distinct(tone)))
            };
            let line = stored.abscissas.iter().map(|&tangent| (tangent, own_m * tangent)).collect();
            let capacity = Series::line(format!("capacity 2H tan α, 2H = {own_m} m"), line, Tone::Distinct(1));
            let point = tangent.map(|tangent| {
                let displacement_m = |height_m| {
                    value(rows, source, place, &StoredDesigned::block_quantity(height_m)).map(|u_m| (tangent, u_m))
                };
                let points = [displacement_m(endless_m), displacement_m(own_m)].into_iter().flatten().collect();
                Series { name: "design".to_owned(), points, tone: Tone::Distinct(3), marks: Marks::Only }
            });
            let lines: Vec<Series> = spectrum(endless_m, 4).into_iter().chain(spectrum(own_m, 0)).collect();
            // the capacity line leaves the panel where the spectra are low
            let top = lines.iter().flat_map(|line| &line.points).map(|point| point.1).filter(|u| u.is_finite());
            let top = 1.05 * top.fold(0.01, f64::max);
            let series = lines.into_iter().chain([capacity]).chain(point).collect();
            Panel::lines(
                stored.scalings[scaling].clone(),
                source.abscissa(),
                Axis::linear(DISPLACEMENT).between(0.0, top),
                series,
            )
        };
        let caption = format!(
            "Design of a block of 2H = {own_m} m under the set {set} by the spectrum of an endless one (Section 2.4.3, \
             Fig. 2.13): {} times the slenderness where the capacity line meets it. Dots: what both spectra say there. \
             {}.",
            design.safety_factor,
            source.scaling_words(place.scaled_by)
        );
        figures.push(source.figure(
            format!("design-{}{}", source.words[place.set], source.suffix(place.scaled_by)),
            format!("Design by the spectrum, {set}"),
            caption,
            3,
            (0..stored.scalings.len()).map(panel).collect(),
        ));
    }
    figures
}

/// A design value of the spectrum at `place`.
fn value(rows: &[DesignRow], source: &DisplacementSource<'_>, place: SpectrumPlace, quantity: &str) -> Option<f64> {
    let stored = source.stored;
    rows.iter()
        .find(|row| {
            row.quantity == quantity
                && row.record_set == stored.sets[place.set].name
                && row.scaling == stored.scalings[place.scaling]
                && row.scaled_by == stored.scaled_by[place.scaled_by]
        })
        .map(|row| row.noisy.value)
        .filter(|value| value.is_finite())
}

/// What the design rules predict beside the time histories (Figure 2.14).
pub(super) fn comparison(source: &DisplacementSource<'_>, design: &StoredDesign) -> Figure {
    let rows = &design.rows;
    let quantities = match design.designed {
        StoredDesigned::Bridge => {
            Quantities { predicted: "u_dem_rule_m".to_owned(), computed: "u_dem_TH_m".to_owned() }
        }
        StoredDesigned::Block { height_m, endless_height_m } => Quantities {
            predicted: StoredDesigned::block_quantity(endless_height_m),
            computed: StoredDesigned::block_quantity(height_m),
        },
    };
    let panels =
        rules(rows).into_iter().map(|rule| comparison_panel(source, rows, &quantities, rule)).collect::<Vec<_>>();
    let caption = "Displacement of the designed structures, predicted and by time histories, a dot for each scaling \
                   and way of scaling (Fig. 2.14, Tables 2.1 to 2.3 and 3.2 to 3.7). Above the line the prediction is \
                   conservative.";
    let columns = panels.len();
    source.figure(
        "design".to_owned(),
        "How well the design rules predict".to_owned(),
        caption.to_owned(),
        columns,
        panels,
    )
}

/// The rules of the rows, each once, in their order.
fn rules(rows: &[DesignRow]) -> Vec<Option<&'static str>> {
    let mut rules: Vec<_> = rows.iter().map(|row| row.rule).collect();
    rules.sort_unstable();
    rules.dedup();
    rules
}

fn comparison_panel(
    source: &DisplacementSource<'_>,
    rows: &[DesignRow],
    quantities: &Quantities,
    rule: Option<&'static str>,
) -> Panel {
    let of = |row: &&DesignRow, quantity: &str| row.rule == rule && row.quantity == quantity;
    let mut largest = 0.0_f64;
    let mut series: Vec<Series> = Vec::new();
    for (index, set) in source.stored.sets.iter().enumerate() {
        let own = |quantity: &str| {
            let rows = rows.iter().filter(|row| of(row, quantity) && row.record_set == set.name);
            rows.map(|row| row.noisy.value).collect::<Vec<f64>>()
        };
        let points: Vec<(f64, f64)> = own(&quantities.computed).into_iter().zip(own(&quantities.predicted)).collect();
        largest = points
            .iter()
            .flat_map(|point| [point.0, point.1])
            .filter(|value| value.is_finite())
            .fold(largest, f64::max);
        series.push(Series { name: set.name.clone(), points, tone: Tone::Distinct(index), marks: Marks::Only });
    }
    let end = if largest > 0.0 { 1.05 * largest } else { 1.0 };
    series.push(Series::line("equal", vec![(0.0, 0.0), (end, end)], Tone::Distinct(4)));
    let title = match rule {
        Some("ED") => "equal-displacement rule",
        Some(_) => "equal-energy rule",
        None => "",
    };
    let axis = |what: &str| Axis::linear(format!("displacement {what}, m")).between(0.0, end);
    Panel::lines(title, axis("by time histories"), axis("predicted"), series)
}
