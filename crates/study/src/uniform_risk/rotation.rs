//! The section `[records.rotation]`: from which azimuths a pair is seen.

use serde::Serialize;
use uplift_motion::Rotation;

use crate::keys::{Key, SectionKeys};
use crate::reading::Section;

/// Most azimuths: one a degree.
const MOST_AZIMUTHS: u64 = 180;
/// Azimuths where no number is given, 15° apart.
const AZIMUTHS: u64 = 12;

pub(super) const KEYS: SectionKeys = SectionKeys {
    section: "records.rotation",
    keys: &[
        Key {
            names: &["take"],
            meaning: "`\"random\"`, one azimuth a pair, drawn evenly by the study's `seed`; `\"each\"`, every azimuth \
                      as a record of its own; `\"percentile\"`, of the peaks from all azimuths",
            default: "`\"random\"`",
            range: "`\"random\"`, `\"each\"`, `\"percentile\"`",
        },
        Key {
            names: &["azimuths"],
            meaning: "how many azimuths, evenly spaced over 180° from h1 on, each as many analyses again",
            default: "12",
            range: "1 to 180; not with `take = \"random\"`",
        },
        Key {
            names: &["percentile"],
            meaning: "the smallest peak that so many per cent of the azimuths do not exceed: 100 the worst azimuth, 50 \
                      the median",
            default: "100",
            range: "1 to 100; only with `take = \"percentile\"`",
        },
    ],
};

#[derive(Clone, Copy, PartialEq)]
enum Take {
    Random,
    Each,
    Percentile,
}

const TAKES: [(&str, Take); 3] = [("random", Take::Random), ("each", Take::Each), ("percentile", Take::Percentile)];

/// As the section of a study file.
#[derive(Serialize)]
pub(super) struct Written {
    take: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    azimuths: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    percentile: Option<u8>,
}

impl From<Rotation> for Written {
    fn from(rotation: Rotation) -> Self {
        let (take, azimuths, percentile) = match rotation {
            Rotation::Random => ("random", None, None),
            Rotation::Each { azimuths } => ("each", Some(azimuths), None),
            Rotation::Percentile { azimuths, percentile } => ("percentile", Some(azimuths), Some(percentile)),
        };
        Self { take, azimuths, percentile }
    }
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<Rotation> {
    let take = section.choice_or("take", &TAKES, Take::Random);
    let (given_azimuths, given_percentile) = (section.field("azimuths"), section.field("percentile"));
    let whole = |value: Option<u64>| value.and_then(|value| u8::try_from(value).ok());
    let azimuths = whole(section.integer_or("azimuths", 1..=MOST_AZIMUTHS, AZIMUTHS));
    let percentile = whole(section.integer_or("percentile", 1..=100, 100));
    if let (Some(field), Some(Take::Random)) = (&given_azimuths, take) {
        field.mistake("one azimuth of each pair is drawn", "leave it out, or write take = \"each\" or \"percentile\"");
    }
    if let (Some(field), Some(Take::Random | Take::Each)) = (&given_percentile, take) {
        field.mistake("no percentile is taken", "leave it out, or write take = \"percentile\"");
    }
    section.finish();
    let (azimuths, percentile) = (azimuths?, percentile?);
    Some(match take? {
        Take::Random => Rotation::Random,
        Take::Each => Rotation::Each { azimuths },
        Take::Percentile => Rotation::Percentile { azimuths, percentile },
    })
}
