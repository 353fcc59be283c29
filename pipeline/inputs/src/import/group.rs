//! Which components belong together.

use std::collections::BTreeMap;
use std::path::Path;

use uplift_motion::Orientation;

use super::component::Component;
use super::name::RecordName;
use super::search_results::{Entry, SearchResults};
use super::warnings::Warning;

/// Two horizontal components of one record, not measured yet.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    pub(super) id: String,
    pub(super) rsn: Option<u64>,
    pub(super) components: [Component; 2],
    /// The third component, where one file of the record is vertical and of the same layout.
    pub(super) vertical: Option<Component>,
    pub(super) search: Option<Entry>,
}

/// The components of one station and event, or of one record as the file names tell it.
#[derive(Default)]
struct Group {
    id: String,
    rsn: Option<u64>,
    horizontal: Vec<Component>,
    vertical: Vec<Component>,
}

/// Pairs `components`; those without a partner are among the warnings.
///
/// A record sequence number in the file name tells the record, else station and event that the head says, else the file
/// itself if it holds several components, else its name without what tells the component.
pub(super) fn pairs(components: Vec<Component>, search: &SearchResults, warnings: &mut Vec<Warning>) -> Vec<Candidate> {
    let mut groups: BTreeMap<String, Group> = BTreeMap::new();
    for component in components {
        let name = RecordName::from_path(&component.path);
        let (key, id) = key_and_id(&component, &name);
        let orientation = component.description.orientation;
        let group = groups.entry(key).or_insert_with(|| Group { id, rsn: name.rsn, ..Group::default() });
        if orientation.is_none_or(Orientation::is_horizontal) {
            group.horizontal.push(component);
        } else {
            group.vertical.push(component);
        }
    }
    let mut ids: BTreeMap<String, usize> = BTreeMap::new();
    let mut candidates = Vec::new();
    for group in groups.into_values() {
        let Group { id, rsn, horizontal, mut vertical } = group;
        let names = || horizontal.iter().map(told).collect::<Vec<_>>().join(", ");
        match horizontal.len() {
            0 => {} // verticals alone
            1 => warnings.push(Warning {
                kind: "no partner",
                text: format!("{}: its other horizontal component is not here; left out", names()),
            }),
            2 if !may_be_a_pair(&horizontal) => warnings.push(Warning {
                kind: "same direction",
                text: format!(
                    "{}: these point in nearly the same direction, so they are not two components of one motion; left \
                     out: if they are, add a row of the manifest by hand",
                    names()
                ),
            }),
            2 => {
                let entry = search.find(rsn).cloned();
                let mut components = horizontal;
                put_in_order(&mut components, entry.as_ref());
                let count = ids.entry(id.clone()).or_insert(0);
                *count += 1;
                let id = if *count == 1 { id } else { format!("{id}-{count}") };
                if let Ok(components) = <[Component; 2]>::try_from(components) {
                    vertical.retain(|own| own.format == components[0].format);
                    let vertical = if vertical.len() == 1 { vertical.pop() } else { None };
                    candidates.push(Candidate { id, rsn, components, vertical, search: entry });
                }
            }
            count => warnings.push(Warning {
                kind: "more than two",
                text: format!(
                    "{id}: {count} horizontal components ({}), and it is unclear which two belong together; left out: \
                     add a row of the manifest for each pair by hand",
                    shortened(&names())
                ),
            }),
        }
    }
    candidates
}

/// Whether two components may be those of one motion: not if both say their direction, and it is nearly one.
fn may_be_a_pair(components: &[Component]) -> bool {
    let directions: Vec<f64> = (components.iter())
        .filter_map(|component| match component.description.orientation {
            Some(Orientation::Azimuth(degrees)) => Some(degrees),
            _ => None,
        })
        .collect();
    match directions[..] {
        [one, other] => (LEAST_ANGLE_DEG..=180.0 - LEAST_ANGLE_DEG).contains(&(one - other).rem_euclid(180.0)),
        _ => true,
    }
}

/// Angle between two components of one motion, at least; installed at right angles, they may be some degrees off.
const LEAST_ANGLE_DEG: f64 = 45.0;

fn told(component: &Component) -> String {
    match component.channel {
        Some(channel) => format!("{}, component {channel}", component.path.display()),
        None => component.path.display().to_string(),
    }
}

fn shortened(text: &str) -> String {
    const LONGEST: usize = 300;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// What components of one record share, and how the record is called.
fn key_and_id(component: &Component, name: &RecordName) -> (String, String) {
    let description = &component.description;
    let sensor = sensor(description);
    let with_sensor = |id: String| if sensor.is_empty() { id } else { format!("{id}_{sensor}") };
    if let Some(rsn) = name.rsn {
        return (format!("rsn {rsn}"), name.record.clone());
    }
    let event = description.event_time.as_deref().or(description.event.as_deref());
    if let (Some(station), Some(event)) = (&description.station, event) {
        let digits: String = event.chars().filter(char::is_ascii_alphanumeric).collect();
        return (format!("station {station} {sensor} {event}"), fit(&with_sensor(format!("{station}_{digits}"))));
    }
    if component.channel.is_some() {
        return (format!("file {} {sensor}", component.path.display()), with_sensor(fit(&name.record)));
    }
    let folder = component.path.parent().unwrap_or(Path::new("")).display();
    (format!("name {folder}/{}", name.record), fit(&name.record))
}

/// The instrument that recorded: its place, and of a channel such as HNE the two letters that tell the instrument.
fn sensor(description: &uplift_motion::RecordingDescription) -> String {
    let place = description.sensor.as_deref().unwrap_or_default();
    // band, instrument and direction of a SEED channel
    let code = description.channel.as_deref().filter(|channel| {
        let [band, instrument, direction] = channel.as_bytes() else { return false };
        b"HBESCLM".contains(band) && b"HLNG".contains(instrument) && b"NEZ123".contains(direction)
    });
    let instrument = code.and_then(|channel| channel.get(..2)).unwrap_or_default();
    [place, instrument].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("_")
}

/// A name without blanks and separators of tables.
fn fit(id: &str) -> String {
    let fitting = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    id.trim().chars().map(fitting).collect()
}

/// As the search results list them, else by file and channel.
fn put_in_order(components: &mut [Component], entry: Option<&Entry>) {
    let position = |component: &Component| {
        let file = component.path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
        entry.and_then(|entry| {
            entry.files.iter().position(|listed| listed.as_ref().is_some_and(|listed| listed.to_lowercase() == file))
        })
    };
    components.sort_by(|a, b| {
        let listed = (position(a), position(b));
        let by_list = if let (Some(a), Some(b)) = listed { a.cmp(&b) } else { std::cmp::Ordering::Equal };
        by_list.then_with(|| a.path.cmp(&b.path)).then_with(|| a.channel.cmp(&b.channel))
    });
}
