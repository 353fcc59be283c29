//! Overrides of the command line: `--set key=value`.

use super::document::Entry;
use super::suggestion::did_you_mean;
use super::{Finding, Node, Origin, Table, Value};

/// No key of a study file has so many parts.
const MOST_PARTS: usize = 16;
/// Keys that the path of a hazard curve alone can be given.
const OF_A_CURVE: [&str; 3] = ["unit", "kind", "years"];

/// Puts the override `text`, number `index` on the command line, into the document.
///
/// The key is a dotted path; an item of a list is named by its position from zero (`risk.poe.1`
/// or `risk.poe[1]`), a site also by its name (`sites.Athens.pgv`); a part with a dot in it is put
/// in double quotes. The value is TOML, or else plain text.
pub(crate) fn apply(root: &mut Table, index: usize, text: &str) -> Result<(), Finding> {
    let origin = Origin::Override(index);
    let refuse = |key: &str, message: String, help: String| Finding {
        key: key.to_owned(),
        origin: origin.clone(),
        message,
        help: Some(help),
    };
    let Some((path, value)) = text.split_once('=') else {
        return Err(refuse(
            "",
            "an override needs a `=`".to_owned(),
            "write --set key=value, e.g. --set risk.years=100".to_owned(),
        ));
    };
    let Some(parts) = split(path.trim()) else {
        return Err(refuse(
            "",
            format!("\"{path}\" is not a key"),
            "write a dotted key, e.g. risk.years, sites.Athens.pgv or sites.\"Sion 2.1\".pgv".to_owned(),
        ));
    };
    let node = Node::parse_or_text(value.trim(), &origin);
    put(root, &parts, node, &origin)
        .map_err(|Refusal { depth, message, help }| refuse(&parts[..depth].join("."), message, help))
}

/// Why a value cannot be put, and after how many parts of its key.
struct Refusal {
    depth: usize,
    message: String,
    help: String,
}

fn put(table: &mut Table, parts: &[String], node: Node, origin: &Origin) -> Result<(), Refusal> {
    let mut table = table;
    let mut depth = 0;
    loop {
        let entry = entry(table, &parts[depth], origin);
        depth += 1;
        let mut target = &mut entry.node;
        // A list takes the next part as the position or the name of its item.
        while let (Value::List(_), true) = (&target.value, depth < parts.len()) {
            target = item(target, &parts[depth]).map_err(|(message, help)| Refusal { depth, message, help })?;
            depth += 1;
        }
        if depth == parts.len() {
            *target = node;
            return Ok(());
        }
        // what is the path of a hazard curve alone takes further keys, as sites.Athens.pga.unit
        let is_path = matches!(target.value, Value::Text(_)) && parts.get(2).is_some_and(|part| part != "name");
        if depth == 3 && parts[0] == "sites" && is_path && OF_A_CURVE.contains(&parts[3].as_str()) {
            let path = target.clone();
            let file = Entry { key: "file".to_owned(), key_origin: path.origin.clone(), node: path };
            target.value = Value::Table(Table { entries: vec![file] });
        }
        let described = target.describe();
        let Value::Table(inner) = &mut target.value else {
            return Err(Refusal {
                depth,
                message: format!("it is {described}, and has no `{}`", parts[depth]),
                help: "name a key of the study file".to_owned(),
            });
        };
        table = inner;
    }
}

/// The entry of `key`, made where it is missing.
fn entry<'a>(table: &'a mut Table, key: &str, origin: &Origin) -> &'a mut Entry {
    let position = table.entries.iter().position(|entry| entry.key == key);
    let position = position.unwrap_or_else(|| {
        table.entries.push(Entry {
            key: key.to_owned(),
            key_origin: origin.clone(),
            node: Node { origin: origin.clone(), value: Value::Table(Table::default()) },
        });
        table.entries.len() - 1
    });
    &mut table.entries[position]
}

/// The item of a list that `part` names, by its `name` or else its position.
fn item<'a>(list: &'a mut Node, part: &str) -> Result<&'a mut Node, (String, String)> {
    let Value::List(items) = &mut list.value else {
        return Err((format!("no list, so no item `{part}`"), String::new()));
    };
    let name = |item: &Node| match &item.table()?.get("name")?.node.value {
        Value::Text(name) => Some(name.clone()),
        _ => None,
    };
    let names: Vec<Option<String>> = items.iter().map(name).collect();
    let by_name = names.iter().position(|name| name.as_deref() == Some(part));
    let position = by_name.or_else(|| part.parse().ok());
    let count = items.len();
    if let Some(item) = position.and_then(|position| items.get_mut(position)) {
        return Ok(item);
    }
    let names: Vec<&str> = names.iter().flatten().map(String::as_str).collect();
    let help = if let Some(suggestion) = did_you_mean(part, &names) {
        suggestion
    } else if names.is_empty() {
        format!("its items are counted from 0, and it has {count}")
    } else {
        format!("the items are {}", names.join(", "))
    };
    Err((format!("it has no item `{part}`"), help))
}

/// The parts of a dotted path; none where it is malformed.
fn split(path: &str) -> Option<Vec<String>> {
    let mut parts = Vec::new();
    let mut rest = path;
    loop {
        if let Some(quoted) = rest.strip_prefix('"') {
            let (part, after) = quoted.split_once('"')?;
            parts.push(part.to_owned());
            rest = after;
        } else {
            let end = rest.find(['.', '[']).unwrap_or(rest.len());
            let (part, after) = rest.split_at(end);
            parts.push(part.trim().to_owned());
            rest = after;
        }
        while let Some(bracket) = rest.strip_prefix('[') {
            let (position, after) = bracket.split_once(']')?;
            parts.push(position.parse::<usize>().ok()?.to_string());
            rest = after;
        }
        if parts.len() > MOST_PARTS || parts.iter().any(String::is_empty) {
            return None;
        }
        match rest.strip_prefix('.') {
            Some(after) => rest = after,
            None => return rest.is_empty().then_some(parts),
        }
    }
}
