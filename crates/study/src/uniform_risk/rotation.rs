//! The section `[records.rotation]`: from which azimuths a pair is seen.

use uplift_motion::Rotation;

use crate::keys::{Choice, Integer, Key, SectionKeys, choice, integer};
use crate::reading::Section;

/// Most azimuths: one a degree.
const MOST_AZIMUTHS: u64 = 180;

pub(super) const KEYS: SectionKeys = SectionKeys::new("records.rotation", &[&TAKE, &AZIMUTHS, &PERCENTILE]);
const TAKE: Key<Choice<Take>> = choice("take", &Take::ALL, Take::key).with_default(Take::Random).meaning(
    "`\"random\"`, one azimuth a pair, drawn evenly by the study's `seed`; `\"each\"`, every azimuth as a record of \
     its own; `\"percentile\"`, of the peaks from all azimuths",
);
/// By default 15° apart.
const AZIMUTHS: Key<Integer> = integer("azimuths", 1, MOST_AZIMUTHS)
    .with_default(12)
    .meaning("how many azimuths, evenly spaced over 180° from h1 on, each as many analyses again")
    .note("not with `take = \"random\"`");
const PERCENTILE: Key<Integer> = integer("percentile", 1, 100)
    .with_default(100)
    .meaning(
        "the smallest peak that so many per cent of the azimuths do not exceed: 100 the worst azimuth, 50 the median",
    )
    .note("only with `take = \"percentile\"`");

#[derive(Clone, Copy, PartialEq)]
enum Take {
    Random,
    Each,
    Percentile,
}

impl Take {
    const ALL: [Self; 3] = [Self::Random, Self::Each, Self::Percentile];

    fn key(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Each => "each",
            Self::Percentile => "percentile",
        }
    }
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<Rotation> {
    let take = section.read(&TAKE);
    let (given_azimuths, given_percentile) = (section.given(&AZIMUTHS), section.given(&PERCENTILE));
    let whole = |value: Option<u64>| value.and_then(|value| u8::try_from(value).ok());
    let azimuths = whole(section.read(&AZIMUTHS));
    let percentile = whole(section.read(&PERCENTILE));
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
