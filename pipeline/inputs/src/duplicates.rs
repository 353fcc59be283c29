//! Records that are entered twice: one motion under two names counts twice in every spectrum, and bands take it for two
//! records.

use std::collections::BTreeMap;

use rayon::prelude::*;
use uplift_job::text::first_names;
use uplift_motion::Accelerogram;
use uplift_study::Duplicates;

use super::manifest::{ComponentFile, Row};
use super::pairs::CheckedPair;

/// Files and channels of the components of pairs, by the names of the pairs.
pub(super) struct Places(BTreeMap<String, [String; 2]>);

impl Places {
    /// As the `rows` of a manifest say.
    pub(super) fn from_rows(rows: &[Row]) -> Self {
        let place = |file: &ComponentFile| match file.channel {
            Some(channel) => format!("{}, channel {channel}", file.path.display()),
            None => file.path.display().to_string(),
        };
        Self(
            rows.iter()
                .map(|row| (row.id.clone(), [0, 1].map(|component| place(&row.components[component]))))
                .collect(),
        )
    }

    /// A note about the records that are entered twice where the study keeps them; none where there are none.
    ///
    /// # Errors
    /// Where it does not keep them: a line each two records with a motion in common.
    pub(super) fn note<'a>(
        &self,
        pairs: impl IntoIterator<Item = &'a CheckedPair>,
        duplicates: Duplicates,
    ) -> Result<Option<String>, Vec<String>> {
        let pairs: Vec<&CheckedPair> = pairs.into_iter().collect();
        let shared = shared_motions(&pairs);
        let id = |position: usize| pairs[position].0.id.as_str();
        if shared.is_empty() {
            return Ok(None);
        }
        if duplicates == Duplicates::Keep {
            let kept: BTreeMap<usize, usize> = shared.keys().map(|&(first, again)| (again, first)).collect();
            let named: Vec<String> =
                kept.iter().map(|(again, first)| format!("{} is {}", id(*again), id(*first))).collect();
            return Ok(Some(format!("records entered twice are kept: {}", first_names(&named))));
        }
        let place = |position: usize, component: usize| {
            let file = self.0.get(id(position)).map_or("", |places| places[component].as_str());
            format!("h{} ({file})", component + 1)
        };
        let line = |(&(first, again), components): (&(usize, usize), &Vec<[usize; 2]>)| {
            let same = |&[of_first, of_again]: &[usize; 2]| {
                format!("{} is {}", place(again, of_again), place(first, of_first))
            };
            let same: Vec<String> = components.iter().map(same).collect();
            let (again, first, same) = (id(again), id(first), same.join(", "));
            let what = match components.len() {
                1 => format!("record {again} has a motion of record {first}"),
                _ => format!("record {again} is record {first} again"),
            };
            format!("{what}: {same}; remove one of them, or set records.duplicates = \"keep\"")
        };
        Err(shared.iter().map(line).collect())
    }
}

/// The components that two records have in common, `[of the first, of the other]`, by the positions of both; the first
/// is the first of all that have the motion.
///
/// Samples are compared only where time step, length and peak are the same: 8000 records cost one look at each sample.
fn shared_motions(pairs: &[&CheckedPair]) -> BTreeMap<(usize, usize), Vec<[usize; 2]>> {
    type Key = (usize, u64, u64);
    let key = |motion: &Accelerogram| -> Key { (motion.len(), motion.dt_s().to_bits(), motion.pga_m_s2().to_bits()) };
    let keys: Vec<[Key; 2]> = pairs.par_iter().map(|(pair, _)| [key(&pair.h1), key(&pair.h2)]).collect();
    let mut known: BTreeMap<Key, Vec<(usize, usize, &Accelerogram)>> = BTreeMap::new();
    let mut shared: BTreeMap<(usize, usize), Vec<[usize; 2]>> = BTreeMap::new();
    for (position, ((pair, _), keys)) in pairs.iter().zip(keys).enumerate() {
        for (component, (motion, key)) in [&pair.h1, &pair.h2].into_iter().zip(keys).enumerate() {
            let alike = known.entry(key).or_default();
            let same = alike.iter().filter(|(.., other)| *other == motion);
            match same.min_by_key(|(first, of_first, _)| (*first, *of_first != component)) {
                // both components of one record may be alike: that is told by itself
                Some(&(first, of_first, _)) if first < position => {
                    shared.entry((first, position)).or_default().push([of_first, component]);
                }
                _ => alike.push((position, component, motion)),
            }
        }
    }
    shared
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use uplift_motion::RecordPair;

    use super::*;

    fn motion(first: f64) -> Accelerogram {
        Accelerogram::new(0.01, vec![0.0, first, -1.0, 2.0]).unwrap()
    }

    fn pair(id: &str, [h1, h2]: [f64; 2]) -> CheckedPair {
        let pair = RecordPair { id: id.to_owned(), h1: motion(h1), h2: motion(h2), metadata: BTreeMap::new() };
        (pair, [String::new(), String::new()])
    }

    fn places(ids: &[&str]) -> Places {
        let row = |id: &&str| Row {
            id: (*id).to_owned(),
            components: [None, Some(2)].map(|channel| ComponentFile {
                path: PathBuf::from(format!("{id}.txt")),
                channel,
                sha256: None,
            }),
            vertical: None,
            dt_s: None,
            unit: None,
            format: None,
            metadata: BTreeMap::new(),
        };
        Places::from_rows(&ids.iter().map(row).collect::<Vec<_>>())
    }

    #[test]
    fn every_record_that_is_entered_twice_is_named_with_its_files_and_channels() {
        // C is A with its components swapped; D has one of B; E and F are new, and F has one motion as both components;
        // G is F again
        let set = [
            pair("A", [0.1, 0.2]),
            pair("B", [0.3, 0.4]),
            pair("C", [0.2, 0.1]),
            pair("D", [0.5, 0.4]),
            pair("E", [0.6, 0.7]),
            pair("F", [0.8, 0.8]),
            pair("G", [0.8, 0.8]),
        ];
        let places = places(&["A", "B", "C", "D", "E", "F", "G"]);
        let what_to_do = "; remove one of them, or set records.duplicates = \"keep\"";
        assert_eq!(
            places.note(&set, Duplicates::Refuse).unwrap_err(),
            [
                format!(
                    "record C is record A again: h1 (C.txt) is h2 (A.txt, channel 2), h2 (C.txt, channel 2) is h1 \
                     (A.txt){what_to_do}"
                ),
                format!(
                    "record D has a motion of record B: h2 (D.txt, channel 2) is h2 (B.txt, channel 2){what_to_do}"
                ),
                format!(
                    "record G is record F again: h1 (G.txt) is h1 (F.txt), h2 (G.txt, channel 2) is h2 (F.txt, channel \
                     2){what_to_do}"
                ),
            ]
        );
        let kept = places.note(&set, Duplicates::Keep).unwrap();
        assert_eq!(kept.as_deref(), Some("records entered twice are kept: C is A, D is B, G is F"));
        // without these all is well, and nothing is said
        let once = [0, 1, 4, 5].map(|position| set[position].clone());
        for duplicates in Duplicates::ALL {
            assert_eq!(places.note(&once, duplicates), Ok(None));
        }
    }

    #[test]
    fn a_motion_of_another_time_step_is_another_one() {
        let (mut set, places) = ([pair("A", [0.1, 0.2]), pair("B", [0.1, 0.2])], places(&["A", "B"]));
        assert!(places.note(&set, Duplicates::Refuse).is_err());
        set[1].0.h1 = Accelerogram::new(0.02, set[0].0.h1.acceleration_m_s2().to_vec()).unwrap();
        set[1].0.h2 = set[0].0.h2.scaled(1.0 + 1e-15).unwrap();
        assert_eq!(places.note(&set, Duplicates::Refuse), Ok(None));
    }
}
