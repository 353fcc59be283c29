//! Hazard curves in NRML, the XML of the `OpenQuake` engine before version 3.
//!
//! # Source
//! NRML schema `hazard_curves.xsd`, versions 0.4 and 0.5 (element `hazardCurves`).

use std::sync::Arc;

use roxmltree::{Document, Node, ParsingOptions};

use super::entry::{Entry, Head};
use super::measure::{openquake_unit, spectral_acceleration};
use super::{SitePlace, Statistic, coordinates};
use crate::declaration::SecondColumn;
use crate::error::{HazardError, Place};
use crate::text::{excerpt, number};

/// Most XML nodes: ten a site for a hundred thousand sites.
const MAX_NODES: u32 = 1_000_000;
/// Most quotes in one tag, two an attribute.
const MAX_QUOTES: usize = 128;
/// Longest path through the logic trees, bytes; every curve keeps a copy.
const LONGEST_PATH: usize = 1000;
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
    for group in document.descendants().filter(|node| is(*node, "hazardCurves")) {
        let line = lines.of(group);
        let head = Arc::new(head(group, name, &Place::Line { file: name.to_owned(), line })?);
        for curve in group.children().filter(|node| is(*node, "hazardCurve")) {
            entries.push(entry(curve, lines.of(curve), &head)?);
        }
    }
    if entries.is_empty() {
        return Err(fail("no hazardCurve in hazardCurves; export the hazard curves in NRML 0.4 or 0.5".to_owned()));
    }
    Ok(entries)
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

fn head(group: Node, name: &str, place: &Place) -> Result<Head, HazardError> {
    let row = |reason: String| HazardError::Row { place: place.clone(), reason };
    let attribute = |name: &str| group.attribute(name).map(str::trim).filter(|value| !value.is_empty());
    let required = |name: &str| attribute(name).ok_or_else(|| row(format!("hazardCurves without attribute {name}")));
    let optional_number = |name: &str| attribute(name).map(|text| number(text, || place.clone())).transpose();

    let imt = required("IMT")?;
    let period_s = optional_number("saPeriod")?;
    let damping = optional_number("saDamping")?;
    let measure = match (imt, period_s) {
        ("SA", None) => return Err(row("IMT SA without saPeriod".to_owned())),
        ("SA", Some(period_s)) => match damping {
            Some(per_cent) if per_cent != 5.0 => format!("SA({period_s:?},{per_cent:?})"),
            _ => spectral_acceleration(period_s),
        },
        (other, _) => other.to_owned(),
    };
    let quantile = optional_number("quantileValue")?;
    let kind = match (attribute("statistics"), quantile) {
        (Some("mean"), _) => Statistic::Mean,
        (Some("quantile"), Some(quantile)) if (0.0..=1.0).contains(&quantile) => Statistic::Quantile(quantile),
        (Some(other), _) => {
            return Err(row(format!(
                "statistics {} is neither mean nor quantile with a quantileValue",
                excerpt(other)
            )));
        }
        (None, _) => match (attribute("sourceModelTreePath"), attribute("gsimTreePath")) {
            (Some(source), Some(gsim)) if source.len() + gsim.len() > LONGEST_PATH => {
                return Err(row(format!("a path of more than {LONGEST_PATH} bytes through the logic trees")));
            }
            (Some(source), Some(gsim)) => Statistic::Branch(format!("{source}~{gsim}")),
            _ => Statistic::Unspecified,
        },
    };
    let mut levels = group.children().filter(|node| is(*node, "IMLs"));
    let (Some(levels), None) = (levels.next(), levels.next()) else {
        return Err(row("hazardCurves must have one element IMLs".to_owned()));
    };
    Ok(Head {
        file: name.to_owned(),
        unit: openquake_unit(&measure, || place.clone())?,
        source: format!("NRML hazard curves, {kind}, {measure}"),
        measure,
        kind,
        content: SecondColumn::Probability,
        years: Some(number(required("investigationTime")?, || place.clone())?),
        levels: numbers(&content(levels), |_| place.clone())?,
        component: None,
    })
}

fn entry(curve: Node, line: usize, head: &Arc<Head>) -> Result<Entry, HazardError> {
    let place = || Place::Line { file: head.file.clone(), line };
    let row = |reason: String| HazardError::Row { place: place(), reason };
    // Not among all descendants: curves inside one another would be gone through again and again.
    let mut near = curve.children().flat_map(|child| std::iter::once(child).chain(child.children()));
    let position = near.find(|node| is(*node, "pos")).map(content);
    let position = numbers(&position.unwrap_or_default(), |_| place())?;
    let &[longitude, latitude, ..] = &position[..] else {
        return Err(row("hazardCurve without the longitude and latitude of its gml:pos".to_owned()));
    };
    let (longitude_deg, latitude_deg) = coordinates(longitude, latitude, place)?;
    let Some(values) = curve.children().find(|node| is(*node, "poEs")) else {
        return Err(row("hazardCurve without poEs".to_owned()));
    };
    let values = numbers(&content(values), |index| head.place(Some(line), index));
    if let Ok(values) = &values
        && values.len() != head.levels.len()
    {
        return Err(row(format!("{} poEs for {} IMLs; export the file again", values.len(), head.levels.len())));
    }
    let site = SitePlace { name: None, longitude_deg, latitude_deg };
    Ok(Entry { head: Arc::clone(head), line: Some(line), site, vs30_m_s: None, values })
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
    fn of(&mut self, node: Node) -> usize {
        let start = node.range().start;
        if let Some(passed) = self.text.get(self.at..start) {
            self.line += passed.matches('\n').count();
            self.at = start;
        }
        self.line
    }
}
