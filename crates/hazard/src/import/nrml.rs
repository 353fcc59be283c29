//! Hazard curves in NRML, the XML of the `OpenQuake` engine before version 3, and of EFEHR's services.
//!
//! | element | version | read by |
//! |---|---|---|
//! | `hazardCurves` | 0.4 and 0.5 | `curves` |
//! | `hazardCurveField` | 0.3 | `fields` |

mod curves;
mod fields;

use std::sync::Arc;

use roxmltree::{Document, Node, ParsingOptions};

use super::entry::{Entry, Head};
use super::measure::{openquake_unit, spectral_acceleration};
use super::{SitePlace, Statistic, coordinates};
use crate::declaration::SecondColumn;
use crate::error::{HazardError, Place};
use crate::text::number;

/// Most XML nodes: ten a site for a hundred thousand sites.
const MAX_NODES: u32 = 1_000_000;
/// Most quotes in one tag, two an attribute.
const MAX_QUOTES: usize = 128;
/// Elements near a curve that are looked at for its place and its probabilities.
const NEAR: usize = 100;
/// Most declarations of a namespace.
const MAX_NAMESPACES: usize = 1000;

/// Every curve of the document, in its order.
pub(super) fn entries(text: &str, name: &str) -> Result<Vec<Entry>, HazardError> {
    let fail = |reason: String| HazardError::File { file: name.to_owned(), reason };
    if !is_modest(text) {
        return Err(fail("more XML elements, attributes or namespaces than hazard curves need".to_owned()));
    }
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let error: String = error.to_string().chars().take(120).collect();
        fail(format!("not XML that can be read: {}", error.escape_debug()))
    })?;
    let mut lines = LineNumbers { text, at: 0, line: 1 };
    let mut entries = Vec::new();
    for group in document.descendants() {
        let version = match group.tag_name().name() {
            "hazardCurves" => curves::VERSION,
            "hazardCurveField" => fields::VERSION,
            _ => continue,
        };
        let line = lines.line_of(group);
        let head = Arc::new((version.head)(group, name, &Place::Line { file: name.to_owned(), line })?);
        for curve in group.children().filter(|node| is(*node, version.curve)) {
            entries.push(entry(curve, lines.line_of(curve), &version, &head)?);
        }
    }
    if entries.is_empty() {
        return Err(fail(
            "no hazardCurve in hazardCurves, and no HCNode in a hazardCurveField: export the hazard curves in NRML \
             0.3, 0.4 or 0.5"
                .to_owned(),
        ));
    }
    Ok(entries)
}

/// What the versions differ in.
struct Version {
    /// The element of one curve.
    curve: &'static str,
    /// The element of its probabilities.
    probabilities: &'static str,
    /// What its levels are called.
    levels: &'static str,
    /// What the curves of a group have in common.
    head: fn(Node, &str, &Place) -> Result<Head, HazardError>,
}

/// Whether the parser can be given the text.
///
/// It allocates as many nodes and attributes as there are `<` and `=`, compares each attribute with all others of
/// its tag and lets each element repeat the namespaces around it. A `<` cannot stand in the value of an attribute, so
/// each piece between two holds at most one tag.
fn is_modest(text: &str) -> bool {
    let quotes = |tag: &str| tag.bytes().filter(|byte| matches!(byte, b'"' | b'\'')).count();
    let most = MAX_NODES as usize;
    text.matches('<').count() <= 2 * most
        && text.matches('=').count() <= most
        && text.matches("xmlns").count() <= MAX_NAMESPACES
        && text.split('<').all(|tag| quotes(tag) <= MAX_QUOTES)
}

/// Whether the node is an element of that name, in whichever namespace: the versions of NRML differ in it.
fn is(node: Node, name: &str) -> bool {
    node.is_element() && node.tag_name().name() == name
}

/// One curve of a group.
fn entry(curve: Node, line: usize, version: &Version, head: &Arc<Head>) -> Result<Entry, HazardError> {
    let place = || Place::Line { file: head.file.clone(), line };
    let row = |reason: String| HazardError::Row { place: place(), reason };
    // Not among all descendants: curves inside one another would be gone through again and again.
    let near = || curve.children().flat_map(|child| std::iter::once(child).chain(child.children()));
    let places = near().chain(near().flat_map(|node| node.children()));
    let position = places.take(NEAR).find(|node| is(*node, "pos")).map(content);
    let position = numbers(&position.unwrap_or_default(), |_| place())?;
    let &[longitude, latitude, ..] = &position[..] else {
        return Err(row(format!("{} without the longitude and latitude of its gml:pos", version.curve)));
    };
    let (longitude_deg, latitude_deg) = coordinates(longitude, latitude, place)?;
    let Some(values) = near().take(NEAR).find(|node| is(*node, version.probabilities)) else {
        return Err(row(format!("{} without {}", version.curve, version.probabilities)));
    };
    let values = numbers(&content(values), |index| head.place(Some(line), index));
    if let Ok(values) = &values
        && values.len() != head.levels.len()
    {
        return Err(row(format!(
            "{} {} for {} {}; export the file again",
            values.len(),
            version.probabilities,
            head.levels.len(),
            version.levels
        )));
    }
    let site = SitePlace { name: None, longitude_deg, latitude_deg };
    Ok(Entry { head: Arc::clone(head), line: Some(line), site, vs30_m_s: None, values })
}

/// What curves of probabilities have in common; `levels` is the one element that should have them.
fn head<'a>(
    name: &str,
    (kind, measure, years): (Statistic, String, f64),
    levels: Node<'a, 'a>,
    place: &Place,
) -> Result<Head, HazardError> {
    Ok(Head {
        file: name.to_owned(),
        unit: openquake_unit(&measure, || place.clone())?,
        source: format!("NRML hazard curves, {kind}, {measure}"),
        measure,
        kind,
        content: SecondColumn::Probability,
        years: Some(years),
        levels: numbers(&content(levels), |_| place.clone())?,
        component: None,
    })
}

/// The only child of that name, or a mistake of the element `parent`.
fn only<'a, 'input>(
    node: Node<'a, 'input>,
    (parent, name): (&str, &str),
    place: &Place,
) -> Result<Node<'a, 'input>, HazardError> {
    let mut found = node.children().filter(|child| is(*child, name));
    match (found.next(), found.next()) {
        (Some(only), None) => Ok(only),
        _ => Err(HazardError::Row { place: place.clone(), reason: format!("{parent} must have one element {name}") }),
    }
}

/// Name of the measure `imt` with the period, s, and the damping, per cent, of a spectral acceleration.
fn measure(imt: &str, period_s: Option<f64>, damping: Option<f64>) -> Option<String> {
    match (imt, period_s) {
        ("SA", None) => None,
        ("SA", Some(period_s)) => Some(match damping {
            Some(per_cent) if per_cent != 5.0 => format!("SA({period_s:?},{per_cent:?})"),
            _ => spectral_acceleration(period_s),
        }),
        (other, _) => Some(other.to_owned()),
    }
}

/// An attribute that says something.
fn attribute<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    node.attribute(name).map(str::trim).filter(|value| !value.is_empty())
}

/// A number in an attribute.
fn optional_number(node: Node, name: &str, place: &Place) -> Result<Option<f64>, HazardError> {
    attribute(node, name).map(|text| number(text, || place.clone())).transpose()
}

/// All text in an element; comments may divide it.
fn content(node: Node) -> String {
    node.children().filter_map(|child| child.text().filter(|_| child.is_text())).collect()
}

fn numbers(text: &str, place: impl Fn(usize) -> Place) -> Result<Vec<f64>, HazardError> {
    text.split_whitespace().enumerate().map(|(index, field)| number(field, || place(index))).collect()
}

/// Line numbers of nodes asked for in document order, so that the text is gone through once.
struct LineNumbers<'a> {
    text: &'a str,
    at: usize,
    line: usize,
}

impl LineNumbers<'_> {
    fn line_of(&mut self, node: Node) -> usize {
        let start = node.range().start;
        if let Some(passed) = self.text.get(self.at..start) {
            self.line += passed.matches('\n').count();
            self.at = start;
        }
        self.line
    }
}
