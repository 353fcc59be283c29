//! What a result rests on: its study, its records, and what was noticed when they were read.

use uplift_study::{AnyStudy, Study, Warning};

use super::{Alarm, Severity};
use crate::error::UpliftError;
use crate::frame::FEW_RECORDS;
use crate::result::{Kind, ResultFile};

pub(super) fn of_result(file: &ResultFile) -> Result<Vec<Alarm>, UpliftError> {
    let head = file.head()?;
    let mut alarms = Vec::new();
    // a study that cannot be read any more has nothing to add
    if let Ok(study) = Study::stored(&head.study_toml) {
        alarms.extend(of_study(&study));
    }
    if head.synthetic {
        alarms.push(Alarm::of_one(
            Severity::Caution,
            "synthetic-records",
            "records",
            "they are synthetic, and scatter less than real ones: not for design".to_owned(),
            "bring real ones for results that matter: records.manifest (records/README.md)",
        ));
    }
    if file.kind() == Kind::UniformRisk {
        alarms.extend(few(file.axes()?.records.len()));
    }
    let noticed = head.warnings.iter().filter(|line| !line.is_empty());
    alarms.extend(noticed.map(|line| Alarm::of_one(Severity::Note, "inputs", "inputs", line.clone(), "")));
    Ok(alarms)
}

/// What the study says but probably does not mean.
fn of_study(study: &AnyStudy) -> Vec<Alarm> {
    study.warnings().iter().map(|warning| of_warning("study", warning)).collect()
}

/// What a file says but probably does not mean.
pub(super) fn of_warning(subject: &str, warning: &Warning) -> Alarm {
    let (severity, kind) =
        if warning.unlikely { (Severity::Mistake, "unlikely-number") } else { (Severity::Note, "study") };
    Alarm::of_one(severity, kind, subject, warning.what.clone(), &warning.what_to_do)
}

fn few(records: usize) -> Option<Alarm> {
    (records < FEW_RECORDS).then(|| {
        Alarm::of_one(
            Severity::Caution,
            "few-records",
            "records",
            format!("{records} are few: below about {FEW_RECORDS} spectra depend strongly on the choice of records"),
            "bring more (records.manifest), or take all there are (records.first); uplift bootstrap shows how much",
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forty_records_are_no_longer_few() {
        assert_eq!(few(40), None);
        assert!(few(39).is_some_and(|alarm| alarm.what.starts_with("39 are few")));
    }
}
