//! The design examples (Figures 2.13 and 2.14).

use super::super::DISPLACEMENT;
use super::{DisplacementSource, HANGING};
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
            let tangent = row(rows, source, place, "tan_alpha_design");
            let spectrum = |wanted_m: f64, tone: usize| {
                let ordinates_m = stored.percentile_m(place, line_of(wanted_m)?, percentile);
                let points = stored.abscissas.iter().copied().zip(ordinates_m.iter().copied()).collect();
                Some(Series::line(format!("2H = {wanted_m} m"), points, Tone::Distinct(tone)))
            };
            let line = stored.abscissas.iter().map(|&tangent| (tangent, own_m * tangent)).collect();
            let capacity = Series::line(format!("capacity 2H tan α, 2H = {own_m} m"), line, Tone::Distinct(1));
            let point = tangent.into_iter().flat_map(|tangent| {
                let displacement = |height_m| row(rows, source, place, &StoredDesigned::block_quantity(height_m));
                let points = [displacement(endless_m), displacement(own_m)].into_iter().flatten();
                let points = points.map(|u| ((tangent.noisy.value, u.noisy.value), hang([tangent, u])));
                dots_and_rings("design", points.collect(), Tone::Distinct(3))
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
            "Design of a block of 2H = {own_m} m for the set {set} by the spectrum of an infinitely tall one (Section \
             2.4.3, Fig. 2.13): {} times the slenderness at which the capacity line meets the spectrum. Dots: both \
             spectra there. {}.{}",
            design.safety_factor,
            source.scaling_words(place.scaled_by),
            rings_words(rows.iter().filter(|row| row.record_set == *set))
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

/// A design value of the spectrum at `place`, where there is one.
fn row<'a>(
    rows: &'a [DesignRow],
    source: &DisplacementSource<'_>,
    place: SpectrumPlace,
    quantity: &str,
) -> Option<&'a DesignRow> {
    let stored = source.stored;
    rows.iter()
        .find(|row| {
            row.quantity == quantity
                && row.record_set == stored.sets[place.set].name
                && row.scaling == stored.scalings[place.scaling]
                && row.scaled_by == stored.scaled_by[place.scaled_by]
        })
        .filter(|row| row.noisy.value.is_finite())
}

/// Whether rounding decides one of two values.
fn hang(rows: [&DesignRow; 2]) -> bool {
    rows.iter().any(|row| row.hangs_on_rounding())
}

/// Points as dots, and as rings those that hang on rounding.
fn dots_and_rings(name: &str, points: Vec<((f64, f64), bool)>, tone: Tone) -> impl Iterator<Item = Series> {
    let (rings, dots): (Vec<_>, Vec<_>) = points.into_iter().partition(|(_, hangs)| *hangs);
    let series = [(name, dots, Marks::Only), (HANGING, rings, Marks::Rings)].map(|(name, points, marks)| {
        let points = points.into_iter().map(|(point, _)| point).collect::<Vec<_>>();
        Series { name: name.to_owned(), points, tone, marks }
    });
    series.into_iter().filter(|series| series.marks == Marks::Only || !series.points.is_empty())
}

/// What rings mean, where rounding decides one of the values.
fn rings_words<'a>(mut rows: impl Iterator<Item = &'a DesignRow>) -> &'static str {
    if rows.any(DesignRow::hangs_on_rounding) { " Rings: rounding decides a value, see the design tables." } else { "" }
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
    let caption = format!("{caption}{}", rings_words(rows.iter()));
    let columns = panels.len();
    source.figure("design".to_owned(), "Predicted and computed displacements".to_owned(), caption, columns, panels)
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
            rows.collect::<Vec<_>>()
        };
        let points: Vec<((f64, f64), bool)> = (own(&quantities.computed).into_iter().zip(own(&quantities.predicted)))
            .map(|(computed, predicted)| ((computed.noisy.value, predicted.noisy.value), hang([computed, predicted])))
            .collect();
        largest = points
            .iter()
            .flat_map(|(point, _)| [point.0, point.1])
            .filter(|value| value.is_finite())
            .fold(largest, f64::max);
        series.extend(dots_and_rings(&set.name, points, Tone::Distinct(index)));
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
