//! The stripes of a study: what is known from before, what is computed now, and what is kept if it stops.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use sha2::{Digest, Sha256};
use uplift_ida::{Cells, Part, Piece, Watch};
use uplift_labelled::hexadecimal;
use uplift_oscillator::Oscillator;

use crate::UpliftError;
use crate::checkpoint::{KeptPieces, PieceFile, PieceFileHead, PieceKey, StripeKeys, motion_key};
use crate::events::{Events, Progress};
use crate::inputs::RecordSet;
use crate::text::thousands;
use crate::uniform_risk::EarlierStripes;
use crate::uniform_risk::{Stripes, analyse_stripes, oscillators, plan_stripes};
use uplift_study::ResolvedStudy;

/// All analyses that a study asks for.
pub(crate) struct Work<'a> {
    study: &'a ResolvedStudy,
    records: &'a RecordSet,
    oscillators: Vec<Oscillator>,
    motions: Vec<String>,
    /// `[measure]`.
    keys: Vec<StripeKeys>,
}

/// What is known before anything is computed.
pub(crate) struct Known {
    pub(crate) kept: KeptPieces,
    /// Bytes of the file that were cut off or damaged.
    damaged_bytes: u64,
    earlier: Option<EarlierStripes>,
}

impl<'a> Work<'a> {
    /// The work of `study` on `records`.
    ///
    /// # Errors
    /// A parameter of an oscillator that the study file's check let through: none is known.
    pub(crate) fn new(study: &'a ResolvedStudy, records: &'a RecordSet) -> Result<Self, UpliftError> {
        let motions: Vec<String> = records.records.iter().map(|record| motion_key(&record.accelerogram)).collect();
        let keys = study.measures.iter().map(|measure| StripeKeys::of(study, measure, records, &motions)).collect();
        Ok(Self { study, records, oscillators: oscillators(study)?, motions, keys })
    }

    /// The head of the file of one part.
    pub(crate) fn head(&self, part: Part) -> PieceFileHead {
        let mut hash = Sha256::new();
        let mut pieces = 0;
        for keys in &self.keys {
            for (record, strength, key) in keys.iter() {
                hash.update(key.0);
                pieces += u64::from(part.contains(record, strength, self.study.strengths.len()));
            }
        }
        let work = hexadecimal(&hash.finalize());
        PieceFileHead::new(work, &self.study.title, [part.index + 1, part.count], pieces)
    }

    /// How many of the pieces of one part `kept` has, and how many there are.
    pub(crate) fn share_of(&self, part: Part, kept: &KeptPieces) -> [u64; 2] {
        let of_part = |(record, strength, key): (usize, usize, PieceKey)| {
            part.contains(record, strength, self.study.strengths.len()).then_some(key)
        };
        let keys = || self.keys.iter().flat_map(StripeKeys::iter).filter_map(of_part);
        [keys().filter(|key| kept.contains(*key)).count() as u64, keys().count() as u64]
    }

    /// Carries out one part, keeps every finished piece in `file`, and returns the stripes by measure if the part is the whole.
    ///
    /// # Errors
    /// [`UpliftError::Paused`] where the user stopped it; a file that can no longer be written, which stops it too.
    pub(crate) fn carry_out(
        &self,
        known: &Known,
        file: &PieceFile,
        part: Part,
        events: &dyn Events,
    ) -> Result<Vec<Stripes>, UpliftError> {
        let study = self.study;
        let plans = (study.measures.iter())
            .map(|measure| plan_stripes(study, measure, self.records, &self.oscillators))
            .collect::<Result<Vec<_>, _>>()?;
        let share = |analyses: u64| analyses / part.count;
        let total: u64 = plans.iter().map(|plan| share(plan.analyses())).sum();
        let mut cells: Vec<Cells> = Vec::new();
        for ((measure, plan), keys) in study.measures.iter().zip(&plans).zip(&self.keys) {
            let mut of_measure = Cells::unknown(plan);
            if let Some(earlier) = &known.earlier {
                earlier.fill(study, measure, self.records, &self.motions, &mut of_measure);
            }
            known.kept.fill(keys, &mut of_measure);
            cells.push(of_measure);
        }
        if known.damaged_bytes > 0 {
            events.note(&format!(
                "{}: pieces that were cut off or damaged ({} bytes) are computed again",
                file.path().display(),
                known.damaged_bytes
            ));
        }
        let before: u64 = cells.iter().map(Cells::count).sum();
        if before > 0 {
            events.remark(
                "known",
                &format!("{} of {} analyses from before", thousands(before.min(total)), thousands(total)),
            );
        }
        let finished = AtomicU64::new(before);
        let mut stripes = Vec::new();
        for (((measure, plan), keys), cells) in study.measures.iter().zip(&plans).zip(&self.keys).zip(cells) {
            let label = measure.measure.label();
            events.remark(
                label,
                &format!(
                    "{} records x {} strengths x {} levels = {} analyses",
                    self.records.records.len(),
                    study.strengths.len(),
                    measure.levels.len(),
                    thousands(plan.analyses())
                ),
            );
            let progress = Progress::begin(events, label, "analyses", share(plan.analyses()));
            let strengths = study.strengths.len();
            let known_in_rows: Vec<usize> = (0..self.records.records.len() * strengths)
                .map(|row| cells.known_in_row(row / strengths, row % strengths))
                .collect();
            let keep = |piece: &Piece<'_>| {
                file.append(keys.at(piece.record, piece.strength), piece);
                let new = piece.edp_m.len() - known_in_rows[piece.record * strengths + piece.strength];
                finished.fetch_add(new as u64, Ordering::Relaxed);
            };
            let watch = UntilFull { progress: &progress, file };
            let outcome = analyse_stripes(measure, plan, cells, part, &watch, &keep);
            drop(progress);
            if let Some(reason) = file.failure() {
                return Err(UpliftError::input(format!(
                    "{}: nothing more can be kept ({reason}); what is in it is kept: make room, and run the same command to go on",
                    file.path().display()
                )));
            }
            let done = match outcome {
                Err(UpliftError::Interrupted) => {
                    file.sync()?;
                    let done = finished.load(Ordering::Relaxed);
                    return Err(UpliftError::Paused { what: "analyses", done, total, path: file.path().to_owned() });
                }
                other => other?,
            };
            if let Some(done) = &done {
                let rate =
                    if done.computed > 0 { format!(", {} analyses/s", thousands(rate(done))) } else { String::new() };
                events.remark("", &format!("{:.1} s{rate}", done.seconds));
            }
            stripes.extend(done);
        }
        file.sync()?;
        Ok(stripes)
    }
}

/// Analyses a second.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a rate for people")]
pub(crate) fn rate(stripes: &Stripes) -> u64 {
    (stripes.computed as f64 / stripes.seconds.max(1e-9)) as u64
}

/// Opens the file of one part, with what is known from it and from an earlier `result`.
///
/// # Errors
/// A file that cannot be written, or that holds something else.
pub(crate) fn open(
    path: &Path,
    head: &PieceFileHead,
    result: Option<&Path>,
) -> Result<(PieceFile, Known), UpliftError> {
    let (file, found) = PieceFile::open(path, head)?;
    let damaged_bytes = found.damaged_bytes;
    Ok((file, Known { kept: found.kept, damaged_bytes, earlier: result.and_then(EarlierStripes::open) }))
}

/// Stops when the user says so, and when nothing more can be kept.
struct UntilFull<'a> {
    progress: &'a Progress<'a>,
    file: &'a PieceFile,
}

impl Watch for UntilFull<'_> {
    fn finished(&self, analyses: u64) {
        self.progress.finished(analyses);
    }

    fn cancelled(&self) -> bool {
        self.progress.cancelled() || self.file.failure().is_some()
    }
}
