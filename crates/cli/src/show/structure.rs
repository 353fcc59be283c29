//! What a design and an overturning tell alike: the structure, and how often something happens to it.

use std::io::Write;

use uplift::alarms::Alarm;
/// The model of a frame that is held against its proxies.
pub(super) use uplift::structure::WOBBLING_FRAME as WOBBLING;
use uplift::structure::{Bands, EventRisk, PLANAR_FRAME, StructureReport};
use uplift::text::{self, per_cent, short, three_digits, two_digits};
use uplift_structure::{NO_CAPACITY, NO_CAPACITY_REASON};

use super::alarms::is_doubted;
use super::{ROUNDING_DECIDES, shown_path};
use crate::error::CommandError;

/// The kind of a structure that is one rigid block.
pub(super) const BLOCK: &str = "block";

/// The restitution of a model of the structure itself, below the lines of the structure.
pub(super) fn restitution_line(model: &str, restitution: f64) -> String {
    let what = match model {
        WOBBLING => "wobbling restitution",
        PLANAR_FRAME => "restitution in a plane",
        _ => "block's restitution",
    };
    format!("           {what:<24} {restitution:.4}")
}

/// The structure in words, below an empty line: what is it, and which oscillator is it equivalent to; with its
/// restitution where there is one to tell.
pub(super) fn print_structure(out: &mut impl Write, structure: &StructureReport) -> Result<(), CommandError> {
    let StructureReport { name, kind, table_3_1_row, .. } = structure;
    let file = shown_path(&structure.file).display();
    let mut lines = vec![
        format!("structure  {name}: {kind}, Table 3.1 row {table_3_1_row} ({file})"),
        format!("           equivalent mass          {} kg", short(structure.mass_kg)),
        format!("           force at uplift          {} N", short(structure.uplift_force_n)),
        format!("           strength f_up/(m g)      {:.4}", structure.strength),
        format!("           factor on the motion     {:.4}", structure.participation),
        format!("           strength of the spectrum {:.4}", structure.spectral_strength),
        format!("           uplift displacement      {} m", three_digits(structure.uplift_displacement_m)),
    ];
    lines.extend(structure.restitution.map(|restitution| format!("           oscillator's restitution {restitution}")));
    let stiffness_n_m = structure.post_uplift_stiffness_n_m;
    lines.push(match structure.capacity_m {
        Some(capacity_m) => format!("           displacement capacity    {capacity_m:.4} m"),
        None if stiffness_n_m > 0.0 => {
            let rises = short(stiffness_n_m);
            format!("           displacement capacity    none: {NO_CAPACITY_REASON}, it rises by {rises} N/m")
        }
        None => format!("           displacement capacity    none: {NO_CAPACITY_REASON}"),
    });
    lines.extend(structure.warnings.iter().map(|warning| format!("warning    {warning}")));
    Ok(writeln!(out, "\n{}", lines.join("\n"))?)
}

/// What else is to be known, a line each.
pub(super) fn print_notes(out: &mut impl Write, notes: &[String]) -> Result<(), CommandError> {
    for note in notes {
        writeln!(out, "note       {note}")?;
    }
    Ok(())
}

/// What asterisks mean, and from where to where rounding `moved` numbers over such values; nothing where there are
/// none.
pub(super) fn print_moved(out: &mut impl Write, moved: &[String], over: &str) -> Result<(), CommandError> {
    if moved.is_empty() {
        return Ok(());
    }
    let moved = moved.join("\n");
    Ok(writeln!(out, "{ROUNDING_DECIDES}. Range over {over} some 1e-15 lower and higher:\n{moved}")?)
}

/// That an answer is subject to a probable mistake, with a space behind; nothing where there is none.
pub(super) fn doubt(alarms: &[Alarm]) -> &'static str {
    if is_doubted(alarms) { "subject to the mistake? below, " } else { "" }
}

/// The record set; a wobbling frame takes both components of it, and what moves in a plane that of the study.
pub(super) fn record_set(words: &str, wobbles: bool) -> String {
    match words.split_once(", component h").filter(|_| wobbles) {
        Some((before, rest)) if rest.starts_with(['1', '2']) => {
            let (component, more) = rest.split_at(1);
            format!("{before}, both components (planar: h{component}){more}")
        }
        _ => words.to_owned(),
    }
}

/// How often in a year, as runs count it: none of them is no proof of never.
pub(super) fn rate(per_year: f64) -> String {
    if per_year == 0.0 { "none seen".to_owned() } else { text::rate(per_year) }
}

/// From where to where a rate is, for a sentence.
pub(super) fn limits(per_year: [f64; 2]) -> String {
    per_year.map(text::rate).join(" to ")
}

/// A demand with the quoted band, and of whom that is.
pub(super) fn demand_in_words(value_m: f64, band_m: Option<[f64; 2]>, by_whom: &str) -> String {
    let demand = text::metres_with_band(value_m, band_m);
    demand.strip_suffix(')').map_or_else(|| demand.clone(), |open| format!("{open}{by_whom})"))
}

/// What a demand of zero means, behind it; nothing behind another.
pub(super) fn rests(demand_m: f64) -> &'static str {
    if demand_m == 0.0 { ": it does not uplift at this risk" } else { "" }
}

/// The quoted band of a rate in brackets, after the rate in a sentence; nothing where there is none.
pub(super) fn band_after(per_year: Option<Bands>) -> String {
    per_year.map_or_else(String::new, |bands| format!(" ({}{})", limits(bands.quoted()), bands.by_whom()))
}

/// The same in the cell of a table, which is narrow.
pub(super) fn band_in_cell(per_year: Option<Bands>) -> String {
    per_year.map_or_else(String::new, |bands| format!(" ({})", bands.quoted().map(text::rate).join("–")))
}

/// The mark of a band by earthquake.
const BY_EARTHQUAKE: &str = "†";

/// The mark behind a band in a cell of a table, of whom it is; nothing behind one by record.
pub(super) fn mark_of(bands: Option<Bands>) -> &'static str {
    bands.filter(|bands| !bands.by_whom().is_empty()).map_or("", |_| BY_EARTHQUAKE)
}

/// As [`band_in_cell`], with the mark of a band by earthquake.
pub(super) fn marked_band_in_cell(per_year: Option<Bands>) -> String {
    band_in_cell(per_year) + mark_of(per_year)
}

/// What that mark means, where the `table` has it.
pub(super) fn print_by_earthquake(out: &mut impl Write, table: &str) -> Result<(), CommandError> {
    if table.contains(BY_EARTHQUAKE) {
        writeln!(out, "{BY_EARTHQUAKE} band by earthquake")?;
    }
    Ok(())
}

/// At how many levels a frame is shaken, by each measure whose study has more: `; frame at 26 of 84 levels (uplift risk
/// takes all)`. Rates from other levels are other numbers.
pub(super) fn fewer_levels<'a>(of_measures: impl IntoIterator<Item = (usize, usize, &'a str)>) -> String {
    let fewer: Vec<_> = of_measures.into_iter().filter(|(shaken, all, _)| shaken < all).collect();
    let named = |(shaken, all, im): &(usize, usize, &str)| match fewer.len() {
        1 => format!("{shaken} of {all} levels"),
        _ => format!("{shaken} of {all} {im} levels"),
    };
    let each: Vec<String> = fewer.iter().map(named).collect();
    if each.is_empty() { String::new() } else { format!("; frame at {} (uplift risk takes all)", each.join(", ")) }
}

/// The option by which a structure is judged by another measure.
pub(super) fn measure_option(im: &str) -> String {
    format!("--measure {}", im.to_lowercase())
}

/// Annual rate, probability and return period, with two digits each.
pub(super) fn risk_cells(risk: &EventRisk) -> [String; 3] {
    let return_period = |per_year: f64| match 1.0 / per_year {
        years if years < 1e7 => two_digits(years),
        years => format!("{years:.1e}"),
    };
    if risk.per_year > 0.0 {
        let probability = match two_digits(100.0 * risk.probability).as_str() {
            "100" => per_cent(risk.probability),
            text => format!("{text} %"),
        };
        return [text::rate(risk.per_year), probability, return_period(risk.per_year)];
    }
    match risk.at_most_per_year {
        // a count of none is no proof: an alarm says what the bound is
        Some(bound) => [format!("< {}", text::rate(bound)), "-".to_owned(), format!("> {}", return_period(bound))],
        None => [NO_CAPACITY.to_owned(), "-".to_owned(), "-".to_owned()],
    }
}
