//! The JSON Schemas (draft-07) of study, structure and library files, by which editors complete and check keys.
//!
//! They follow from the declared keys. What takes several keys to judge is left to the reader: what passes the schema
//! may still be refused, and what the reader takes passes.

use serde_json::{Map, Value, json};
use uplift_motion::IntensityMeasure;
use uplift_structure::UncertainQuantity;

use crate::grid::MOST_GRID_VALUES;
use crate::keys::{Declared, SectionKeys, Shape, one_or_several};
use crate::kind::Kind;
use crate::{library, structure};

/// The measure whose keys are declared in place of those of every measure that is not named beside it.
const ANY_MEASURE: &str = "sa_1s";
/// A period in the name of a spectral acceleration.
const PERIOD: &str = "[0-9]+(p[0-9]+)?s";
/// The quantity whose keys are declared in place of those of every uncertain one.
const ANY_QUANTITY: &str = "restitution";

/// The schema of study files of every kind.
pub fn study_schema() -> Value {
    let reference = |kind: Kind| json!({ "$ref": format!("#/definitions/{}", name(kind)) });
    let is_any_of = |kinds: &[Kind]| {
        let words: Vec<&str> = kinds.iter().map(|kind| kind.key()).collect();
        json!({ "properties": { "kind": { "enum": words } }, "required": ["kind"] })
    };
    let others = [Kind::Displacement, Kind::ShakeTable];
    let mut checks = others.map(|kind| json!({ "if": is_any_of(&[kind]), "then": reference(kind) })).to_vec();
    checks.push(json!({ "if": { "not": is_any_of(&others) }, "then": reference(Kind::UniformRisk) }));
    // Taplo completes keys by alternatives, not by conditions: the last one leaves the checking to these
    let mut alternatives = Kind::ALL.map(reference).to_vec();
    alternatives.push(json!({}));
    let definitions = Kind::ALL.into_iter().map(|kind| (name(kind), table("", kind.keys())));
    schema("Study file of uplift", definitions, &json!({ "allOf": checks, "anyOf": alternatives }))
}

/// The schema of structure files.
pub fn structure_schema() -> Value {
    schema("Structure file of uplift", [], &table("", &structure::KEYS))
}

/// The schema of files of a library of rocking response.
pub fn library_schema() -> Value {
    schema("Library file of uplift", [], &table("", &library::KEYS))
}

fn name(kind: Kind) -> String {
    kind.key().replace(' ', "_")
}

/// A schema of the `whole` file, with the definitions that it refers to.
fn schema(title: &str, definitions: impl IntoIterator<Item = (String, Value)>, whole: &Value) -> Value {
    const NUMBER: &str = r"\s*[-+0-9.eE]+\s*";
    let part = format!("{NUMBER}(/{NUMBER})?");
    let grids = [
        (
            "notation",
            json!({
                "type": "string",
                "pattern": format!("^{part}(:{part}:{part})?$"),
                "description": "`\"start:step:stop\"`, both ends included; a number or a fraction in quotes",
            }),
        ),
        (
            "equal_steps",
            json!({
                "type": "object",
                "properties": {
                    "start": { "type": "number", "description": "first value" },
                    "stop": { "type": "number", "description": "last value" },
                    "count": {
                        "type": "integer", "minimum": 2, "maximum": MOST_GRID_VALUES, "description": "number of values",
                    },
                },
                "required": ["start", "stop", "count"],
                "additionalProperties": false,
            }),
        ),
    ];
    let grids = grids.map(|(name, grid)| (name.to_owned(), grid));
    let definitions: Map<String, Value> = definitions.into_iter().chain(grids).collect();
    let mut schema = json!({ "$schema": "http://json-schema.org/draft-07/schema#", "title": title, "type": "object" });
    for (key, value) in whole.as_object().into_iter().flatten() {
        schema[key] = value.clone();
    }
    schema["definitions"] = definitions.into();
    schema
}

/// The table at `path`, with the sections in it.
fn table(path: &str, sections: &[SectionKeys]) -> Value {
    let mut properties = Map::new();
    let mut needed = Vec::new();
    for key in sections.iter().filter(|section| section.section == path).flat_map(|section| section.keys) {
        for name in key.names() {
            // of two meanings, that of one structure and that of another, the first is shown
            properties.entry(name).or_insert_with(|| described(*key));
        }
        if key.is_needed() {
            needed.push(key.names()[0]);
        }
    }
    for (name, inner) in inner_sections(path, sections) {
        let shape = sections.iter().find(|section| section.section == inner).map_or(Shape::Table, |known| known.shape);
        let mut schema = shaped(shape, table(&inner, sections));
        if let Some(description) = properties.get(name).and_then(|key| key.get("description")) {
            schema["description"] = description.clone();
        }
        properties.insert(name.to_owned(), schema);
    }
    let mut schema = json!({ "type": "object" });
    if let Some(any) = properties.shift_remove(ANY_MEASURE) {
        use IntensityMeasure::{Arias, Cav, Pgd, SpectrumIntensity};
        for measure in [Pgd, SpectrumIntensity, Cav, Arias] {
            properties.entry(measure.key()).or_insert_with(|| any.clone());
        }
        schema["patternProperties"] = json!({ format!("^(sa_{PERIOD}|avgsa_{PERIOD}_{PERIOD})$"): any });
    }
    if path == "uncertainty"
        && let Some(any) = properties.shift_remove(ANY_QUANTITY)
    {
        properties.extend(UncertainQuantity::ALL.map(|quantity| (quantity.key().to_owned(), any.clone())));
    }
    schema["properties"] = properties.into();
    if !needed.is_empty() {
        schema["required"] = needed.into();
    }
    schema["additionalProperties"] = false.into();
    schema
}

/// A key with its description, in Markdown.
fn described(key: &dyn Declared) -> Value {
    let mut schema = key.schema();
    let default = if key.is_needed() { String::new() } else { key.default() };
    let parts = [("", key.meaning().to_owned()), ("Range: ", key.range()), ("Default: ", default)];
    let parts = parts.into_iter().filter(|(_, text)| !text.is_empty());
    let lines: Vec<String> = parts.map(|(title, text)| format!("{title}{}", without_links(&text))).collect();
    schema.insert("description".to_owned(), lines.join("\n\n").into());
    schema.into()
}

/// The sections in that at `path`: the name of each, and its own path.
fn inner_sections<'a>(path: &str, sections: &'a [SectionKeys]) -> Vec<(&'a str, String)> {
    let mut inner: Vec<(&str, String)> = Vec::new();
    for section in sections {
        let rest = if path.is_empty() { Some(section.section) } else { section.section.strip_prefix(path) };
        let name = rest.and_then(|rest| if path.is_empty() { Some(rest) } else { rest.strip_prefix('.') });
        let Some(name) = name.and_then(|name| name.split('.').next()).filter(|name| !name.is_empty()) else { continue };
        if inner.iter().all(|(known, _)| *known != name) {
            inner.push((name, format!("{path}.{name}").trim_start_matches('.').to_owned()));
        }
    }
    inner
}

/// A section of this shape, whose table is described.
fn shaped(shape: Shape, table: Value) -> Value {
    match shape {
        Shape::Table => table,
        Shape::List => json!({ "type": "array", "items": table }),
        Shape::TableOrList => one_or_several(&table),
        Shape::FileOrTable => json!({ "anyOf": [{ "type": "string", "minLength": 1 }, table] }),
    }
}

/// Markdown without the targets of its links, which lead nowhere outside of the documentation.
fn without_links(markdown: &str) -> String {
    let mut text = String::new();
    let mut rest = markdown;
    while let Some((before, (link, (_, after)))) = rest
        .split_once("([")
        .and_then(|(before, rest)| Some((before, rest.split_once("](")?)))
        .and_then(|(before, (link, rest))| Some((before, (link, rest.split_once("))")?))))
    {
        text = format!("{text}{before}({link})");
        rest = after;
    }
    text + rest
}
