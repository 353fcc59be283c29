//! An answer goes into the result that it was asked under.

use std::path::Path;

use serde_json::{Map, Value};
use uplift_job::JobError;
use uplift_job::events::Events;
use uplift_job::text::counted;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_result::layout::attribute::{self, answer};
use uplift_result::layout::axis;
use uplift_result::{Finding, LockedResult, StoredFinding, sign};

use crate::error::DesignError;

/// Keeps `finding` in the result at `result`, in place of an earlier answer to the same question and of no other, and
/// tells `events` where. What cannot be kept is reported too, with the reason: an answer is none the worse for that.
///
/// Returns the group that it stands in; none where it is not kept.
pub fn keep(finding: &Finding, result: &Path, events: &dyn Events) -> Option<String> {
    match write(finding, result, events) {
        Ok(()) => {
            let group = finding.group();
            events.remark("kept", &format!("in {}", result.display()));
            Some(group)
        }
        Err(error) => {
            events.note(&format!("the answer is not kept in {}: {error}", result.display()));
            None
        }
    }
}

fn write(finding: &Finding, result: &Path, events: &dyn Events) -> Result<(), DesignError> {
    if std::fs::metadata(result).is_ok_and(|metadata| metadata.permissions().readonly()) {
        return Err(JobError::input("it may not be written to".to_owned()).into());
    }
    let (locked, file) = LockedResult::open(result, events)?;
    if file.head()?.study_digest() != finding.study_digest {
        return Err(JobError::input("another result replaced it meanwhile: run the command again".to_owned()).into());
    }
    let earlier = file.findings()?;
    let (key, group) = (finding.key(), finding.group());
    if earlier.iter().any(|of| says_more(&of.finding, finding)) {
        return Ok(());
    }
    let replaced = [group.clone(), axis::path(&axis::finding(&key))];
    locked.write(&replaced, |writer| add(writer, finding, &group))?;
    tell_of_another_file(finding, &earlier, events);
    Ok(())
}

/// Whether an answer that is kept has every number of a new one to the same question, and more beside them: a design
/// with the neighbours of its strength.
fn says_more(kept: &Finding, new: &Finding) -> bool {
    let of = |of: &Finding| (of.group(), of.structure_sha256(), of.study_digest.clone());
    let bits = |of: &Finding| -> Vec<[u64; 3]> {
        of.rows.iter().map(|row| [row.value, row.limits[0], row.limits[1]].map(f64::to_bits)).collect()
    };
    of(kept) == of(new) && bits(kept) == bits(new) && kept.document.len() > new.document.len()
}

/// Says which answers were of the structure file as it was before.
fn tell_of_another_file(finding: &Finding, earlier: &[StoredFinding], events: &dyn Events) {
    let (sha256, group) = (finding.structure_sha256(), finding.group());
    let of_another =
        |of: &&StoredFinding| of.finding.structure == finding.structure && of.finding.structure_sha256() != sha256;
    let (replaced, left): (Vec<&StoredFinding>, Vec<&StoredFinding>) =
        earlier.iter().filter(of_another).partition(|of| of.finding.group() == group);
    let file = &finding.structure_file;
    if let Some(earlier) = replaced.first().map(|of| &of.finding.structure_file) {
        events.note(&if earlier == file {
            format!("{file} has changed: this answer replaces the one for what it was before")
        } else {
            format!("{file} replaces {earlier}, which has the same name: rename one to keep both answers")
        });
    }
    if !left.is_empty() {
        let questions: Vec<String> = left.iter().map(|of| of.finding.question()).collect();
        events.note(&format!(
            "{} has changed: the result keeps {} for the earlier file, marked as such: {}",
            finding.structure,
            counted(left.len(), "answer"),
            questions.join("; ")
        ));
    }
}

fn add(writer: &mut LabelledWriter, finding: &Finding, group: &str) -> Result<(), LabelledError> {
    sign(writer, group)?;
    let sha256 = finding.structure_sha256();
    let key = finding.key();
    let names = [("<command>", finding.inquiry.key()), ("<key>", &key), ("<structure>", &finding.structure)];
    attribute::structure::STRUCTURE_SHA256.write(writer, &names, sha256.as_str())?;
    let request: Map<String, Value> =
        finding.request.iter().map(|(name, value)| (name.clone(), value.as_str().into())).collect();
    for (attribute, text) in [
        (answer::STRUCTURE_FILE, finding.structure_file.as_str()),
        (answer::STRUCTURE_SHA256, &sha256),
        (answer::STRUCTURE_TOML, &finding.structure_toml),
        (answer::STUDY_DIGEST, &finding.study_digest),
        (answer::REQUEST, &Value::Object(request).to_string()),
        (answer::DOCUMENT, &finding.document),
    ] {
        attribute.write(writer, &names, text)?;
    }
    finding.write_rows(writer)
}
