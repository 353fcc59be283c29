//! What an interrupted bootstrap keeps, to go on from.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use uplift_job::outputs::beside;
use uplift_labelled::{LabelledReader, LabelledWriter, hexadecimal};
use uplift_uniform_risk::consistency::Reweighing;

use super::bands::{bands_of_numbers, numbers_of_bands};
use super::joint::JointSiteBands;
use super::plain::StrengthBands;
use super::repaired::{SiteBands, SiteShape};
use super::source::Source;
use crate::error::QuestionsError;

/// What is finished.
#[derive(Debug, Default)]
pub(super) struct Finished {
    /// Strengths, by measure and index.
    pub(super) strengths: BTreeMap<(&'static str, usize), StrengthBands>,
    /// Sites with repaired spectra, by measure and index.
    pub(super) sites: BTreeMap<(&'static str, usize), SiteBands>,
    /// Repaired sites with weighted hazard curves, by measure and index.
    pub(super) joint: BTreeMap<(&'static str, usize), JointSiteBands>,
}

/// What a checkpoint may hold: a damaged one may hold anything.
pub(super) struct Expected {
    /// Measures, by their keys.
    pub(super) keys: Vec<&'static str>,
    /// Shape of the bands of a repaired site.
    pub(super) site: SiteShape,
    /// Whether there are bands of whole spectra.
    pub(super) simultaneous: bool,
}

/// The file beside a result that holds the finished part of its bootstrap.
#[derive(Debug)]
pub(super) struct Checkpoint {
    path: PathBuf,
    fingerprint: String,
    /// What was typed to compute it.
    command: String,
}

/// What the file of an interrupted bootstrap says of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Interrupted {
    /// Finished strengths of all measures.
    pub strengths: u64,
    /// What was typed to compute it; none in files of earlier versions, and where nothing was typed.
    pub command: Option<String>,
}

/// Where the bootstrap of the result at `result` keeps what is finished.
pub fn part_path(result: &Path) -> PathBuf {
    beside(result, "bootstrap.part.h5")
}

/// By what the bootstrap in a file is known again; none in another file, or a damaged one.
fn fingerprint_in(part: &Path) -> Option<String> {
    LabelledReader::open(part).ok()?.attribute::<String>("/", "fingerprint").ok()
}

/// The interrupted bootstrap in the file `part`; none where there is none.
pub fn interrupted(part: &Path) -> Option<Interrupted> {
    fingerprint_in(part)?;
    let reader = LabelledReader::open(part).ok()?;
    let count = |measure: &String| {
        reader.array::<u32>(&format!("/{measure}/strength")).map_or(0, |strengths| strengths.values.len() as u64)
    };
    let strengths = reader.children("/").ok()?.iter().map(count).sum();
    let command = reader.attribute::<String>("/", "command").ok().filter(|command| !command.is_empty());
    Some(Interrupted { strengths, command })
}

impl Checkpoint {
    /// The checkpoint of this very bootstrap, for which `command` was typed: its fingerprint covers all numbers that
    /// the bands depend on.
    pub(super) fn new(source: &Source<'_>, command: &str) -> Self {
        // pairs are of the bands of the truth, which are not kept
        let Source { stored, reweighing, plan, settings, quoted: _ } = source;
        let mut hash = Sha256::new();
        let mut add = |values: &[f64]| {
            hash.update((values.len() as u64).to_le_bytes());
            for value in values {
                hash.update(value.to_le_bytes());
            }
        };
        add(&stored.targets_per_year);
        add(&stored.strengths);
        for measure in &stored.measures {
            add(&measure.levels);
            add(measure.edp_m.values());
            if let Some(shares) = &measure.shares {
                add(shares);
            }
            for weights in measure.weights.iter().chain(measure.branches.iter().flatten().map(|(_, weights)| weights)) {
                add(&weights.per_year());
            }
            let branch_weights: Vec<f64> = measure.branches.iter().flatten().map(|(weight, _)| *weight).collect();
            add(&branch_weights);
        }
        add(&reweighing.map(Reweighing::numbers).unwrap_or_default());
        hash.update(format!("{:?} {:?} {} {:?}", plan.unit(), plan.sizes(), plan.replicates(), settings));
        for count in plan.multiplicities() {
            hash.update(count.to_le_bytes());
        }
        Self::beside(&stored.path, hexadecimal(&hash.finalize()), command.to_owned())
    }

    /// In its own file where that of the result holds another bootstrap, which may be all that is left of it.
    fn beside(result: &Path, fingerprint: String, command: String) -> Self {
        let (path, own) = (part_path(result), beside(result, &format!("bootstrap-{}.part.h5", &fingerprint[..8])));
        let is_of_another = fingerprint_in(&path).is_some_and(|other| other != fingerprint);
        Self { path: if own.exists() || is_of_another { own } else { path }, fingerprint, command }
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// What is there already; nothing if it belongs to other numbers or cannot be read.
    pub(super) fn load(&self, expected: &Expected) -> Finished {
        let read = || -> Result<Finished, QuestionsError> {
            let reader = LabelledReader::open(&self.path)?;
            let mut finished = Finished::default();
            if reader.attribute::<String>("/", "fingerprint")? != self.fingerprint {
                return Ok(finished);
            }
            for &key in expected.keys.iter().filter(|key| reader.exists(&format!("/{key}/bands_m"))) {
                let strengths = reader.array::<u32>(&format!("/{key}/strength"))?.values;
                let bands = reader.array::<f64>(&format!("/{key}/bands_m"))?.values;
                let path = format!("/{key}/replicates_m");
                let replicates = if reader.exists(&path) { reader.array::<f64>(&path)?.values } else { Vec::new() };
                if strengths.is_empty() {
                    continue;
                }
                let (per_band, per_replicate) = (bands.len() / strengths.len(), replicates.len() / strengths.len());
                for (row, &strength) in strengths.iter().enumerate() {
                    let bands = bands_of_numbers(&bands[row * per_band..(row + 1) * per_band]);
                    let replicates_m = replicates[row * per_replicate..(row + 1) * per_replicate].to_vec();
                    let strength = (key, strength as usize);
                    finished.strengths.insert(strength, StrengthBands { bands, replicates_m });
                }
            }
            for &key in &expected.keys {
                for (site, row) in rows_of_sites(&reader, key, REPAIRED)? {
                    let bands = SiteBands::from_numbers(&row, expected.site, expected.simultaneous);
                    finished.sites.extend(bands.map(|bands| ((key, site), bands)));
                }
                for (site, row) in rows_of_sites(&reader, key, JOINT)? {
                    let bands = JointSiteBands::from_numbers(&row, expected.site);
                    finished.joint.extend(bands.map(|bands| ((key, site), bands)));
                }
            }
            Ok(finished)
        };
        read().unwrap_or_default()
    }

    /// Keep what is finished.
    pub(super) fn save(&self, finished: &Finished) -> Result<(), QuestionsError> {
        let mut writer = LabelledWriter::create(&self.path)?;
        writer.attribute("/", "program", "uplift")?;
        writer.attribute("/", "fingerprint", self.fingerprint.as_str())?;
        writer.attribute("/", "command", self.command.as_str())?;
        for (key, rows) in by_measure(&finished.strengths) {
            let row = row_axis(&mut writer, &format!("{key}_row"), rows.len())?;
            writer.array(&format!("/{key}/strength"), &[&row], &indices(&rows), "1", "index of the strength")?;
            let bands: Vec<f64> = rows.iter().flat_map(|(_, done)| numbers_of_bands(&done.bands)).collect();
            let value = row_axis(&mut writer, &format!("{key}_value"), bands.len() / rows.len())?;
            writer.array(&format!("/{key}/bands_m"), &[&row, &value], &bands, "m", "bands")?;
            let replicates: Vec<f64> = rows.iter().flat_map(|(_, done)| done.replicates_m.iter().copied()).collect();
            if !replicates.is_empty() {
                let axis = row_axis(&mut writer, &format!("{key}_replicate"), replicates.len() / rows.len())?;
                let path = format!("/{key}/replicates_m");
                writer.array(&path, &[&row, &axis], &replicates, "m", "replicates")?;
            }
        }
        for (key, rows) in by_measure(&finished.sites) {
            let rows = rows.into_iter().map(|(site, done)| (site, done.numbers())).collect();
            write_rows_of_sites(&mut writer, key, (REPAIRED, "bands of repaired spectra"), rows)?;
        }
        for (key, rows) in by_measure(&finished.joint) {
            let rows = rows.into_iter().map(|(site, done)| (site, done.numbers())).collect();
            write_rows_of_sites(&mut writer, key, (JOINT, "joint bands of repaired spectra"), rows)?;
        }
        writer.finish()?;
        Ok(())
    }

    /// Take the file away, once its numbers are in the result.
    pub(super) fn remove(&self) {
        let _ = std::fs::remove_file(&self.path);
    }
}

/// The rows of repaired sites.
const REPAIRED: &str = "repaired";
/// The rows of their bands over records and weighted hazard curves together.
const JOINT: &str = "joint";

/// Sites with their rows of numbers, by the `name` of these; none where there are none.
fn rows_of_sites(reader: &LabelledReader, key: &str, name: &str) -> Result<Vec<(usize, Vec<f64>)>, QuestionsError> {
    if !reader.exists(&format!("/{key}/{name}")) {
        return Ok(Vec::new());
    }
    let sites = reader.array::<u32>(&format!("/{key}/{name}_site"))?.values;
    let numbers = reader.array::<f64>(&format!("/{key}/{name}"))?.values;
    let rows = numbers.chunks_exact((numbers.len() / sites.len().max(1)).max(1)).map(<[f64]>::to_vec);
    Ok(sites.iter().map(|&site| site as usize).zip(rows).collect())
}

fn write_rows_of_sites(
    writer: &mut LabelledWriter,
    key: &str,
    (name, what): (&str, &str),
    rows: Vec<(usize, Vec<f64>)>,
) -> Result<(), QuestionsError> {
    let row = row_axis(writer, &format!("{key}_{name}_row"), rows.len())?;
    writer.array(&format!("/{key}/{name}_site"), &[&row], &indices(&rows), "1", "index of the site")?;
    let count = rows.len();
    let numbers: Vec<f64> = rows.into_iter().flat_map(|(_, numbers)| numbers).collect();
    let value = row_axis(writer, &format!("{key}_{name}_value"), numbers.len() / count.max(1))?;
    writer.array(&format!("/{key}/{name}"), &[&row, &value], &numbers, "1", what)?;
    Ok(())
}

/// What is finished of each measure, with its index.
fn by_measure<'a, T>(finished: &'a BTreeMap<(&'static str, usize), T>) -> BTreeMap<&'static str, Vec<(usize, &'a T)>> {
    let mut found: BTreeMap<&'static str, Vec<(usize, &'a T)>> = BTreeMap::new();
    for (&(key, index), done) in finished {
        found.entry(key).or_default().push((index, done));
    }
    found
}

fn indices<T>(rows: &[(usize, T)]) -> Vec<u32> {
    rows.iter().map(|(index, _)| u32::try_from(*index).unwrap_or(u32::MAX)).collect()
}

/// An axis of numbers, by its name.
fn row_axis(writer: &mut LabelledWriter, name: &str, length: usize) -> Result<String, QuestionsError> {
    let numbers: Vec<u32> = (0..).take(length).collect();
    writer.axis(name, &numbers, "1", "number")?;
    Ok(name.to_owned())
}
