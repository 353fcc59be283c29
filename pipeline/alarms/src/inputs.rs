//! What a result rests on: its study, its records, and what was noticed when they were read.

use uplift_inputs::at_level::{far_factors, relative_factors};
use uplift_job::alarm::{Alarm, Severity};
use uplift_job::text::{counted, records_in_words};
use uplift_motion::IntensityMeasure;
use uplift_result::{Kind, ResultFile};
use uplift_risk::FEW_RECORDS;
use uplift_study::{AnyStudy, Study, Warning};
use uplift_uniform_risk::consistency::Question;

use crate::error::AlarmsError;

pub(super) fn result_alarms(file: &ResultFile) -> Result<Vec<Alarm>, AlarmsError> {
    let head = file.head()?;
    let mut alarms = Vec::new();
    // a study that cannot be read any more has nothing to add
    let study = Study::stored(&head.study_toml).ok();
    alarms.extend(study_alarms(study.as_ref().map_or(&[], AnyStudy::warnings), head.synthetic));
    if file.kind() == Kind::UniformRisk {
        let records = file.stored_axes()?.records.len();
        // nor does it say which records are of one pair
        let question = study.is_some().then(|| Question::from_result(file)).transpose()?;
        let pair_of = question.as_ref().map_or_else(|| (0..records).collect(), Question::pair_of);
        let pairs = uplift_bootstrap::units(&pair_of);
        let sets = sets_of_levels(file, &pairs)?;
        alarms.extend(sets.iter().filter_map(far));
        alarms.extend(sets.iter().find_map(few_at_level));
        if sets.is_empty() {
            alarms.extend(few(records, pairs.len()));
        }
        alarms.extend(question.as_ref().and_then(few_earthquakes));
    }
    let noticed = head.warnings.iter().filter(|line| !line.is_empty());
    alarms.extend(noticed.map(|line| noticed_alarm(line)));
    Ok(alarms)
}

/// Of what was noticed of the inputs; a probable mistake of a record, or whatever it is of, if the line says so.
pub fn noticed_alarm(line: &str) -> Alarm {
    match line.split_once(&format!(": {} ", Severity::Mistake.word())) {
        Some((subject, doubt)) => Alarm::new(Severity::Mistake, NOTICED, subject, doubt.to_owned(), ""),
        None => Alarm::new(Severity::Note, NOTICED, "Inputs", line.to_owned(), ""),
    }
}

/// What a study says but probably does not mean, and that its records are not real ones.
pub fn study_alarms(warnings: &[Warning], synthetic: bool) -> impl Iterator<Item = Alarm> {
    let of_records = synthetic.then(synthetic_records);
    warnings.iter().map(|warning| warning_alarm("study", warning)).chain(of_records)
}

/// Of records that are not real ones, wherever a number of theirs is shown.
pub fn synthetic_records() -> Alarm {
    Alarm::new(
        Severity::Caution,
        "synthetic-records",
        "Synthetic records",
        "not for design".to_owned(),
        "Set records.manifest",
    )
}

/// What a file says but probably does not mean.
pub(super) fn warning_alarm(subject: &str, warning: &Warning) -> Alarm {
    let (severity, kind) =
        if warning.unlikely { (Severity::Mistake, "unlikely-number") } else { (Severity::Note, "study") };
    Alarm::new(severity, kind, subject, warning.what.clone(), &warning.what_to_do)
}

/// The records of each level of a measure, where these are its own.
struct Sets {
    measure: IntensityMeasure,
    levels: Vec<f64>,
    names: Vec<String>,
    /// Factors over level/intensity `[level, record]`, NaN where a record does not belong to a level.
    relative: Vec<f64>,
    /// `[level, record]`; none where all count alike.
    shares: Option<Vec<f64>>,
    /// The positions of the records of each pair.
    pairs: Vec<Vec<usize>>,
}

fn sets_of_levels(file: &ResultFile, pairs: &[Vec<usize>]) -> Result<Vec<Sets>, AlarmsError> {
    let mut sets = Vec::new();
    for (measure, levels) in file.levels()? {
        let stored = file.records()?;
        if let Some(own) = file.sets_of_levels(stored.ids.len(), measure, levels.len())? {
            let intensities = stored.intensities(measure).unwrap_or_default();
            let relative = relative_factors(&own.factors, measure, &levels, intensities);
            let (names, pairs) = (stored.ids, pairs.to_vec());
            sets.push(Sets { measure, levels, names, relative, shares: own.shares, pairs });
        }
    }
    Ok(sets)
}

fn far(sets: &Sets) -> Option<Alarm> {
    far_factors(&sets.relative, &sets.names, (sets.measure, &sets.levels)).map(far_factors_alarm)
}

/// Of factors `what` of which no definition of the measure explains.
pub fn far_factors_alarm(what: String) -> Alarm {
    let what_to_do = "Check the units of levels, factors and records in records.at_level, or leave it if it is meant";
    Alarm::new(Severity::Mistake, "factors-at-level", "records", what, what_to_do)
}

/// Where the level with the fewest pairs has few that count.
fn few_at_level(sets: &Sets) -> Option<Alarm> {
    let records = sets.names.len();
    let counts = |(level, row): (usize, &[f64])| {
        let of_pair = |pair: &Vec<usize>| pair.iter().map(|&record| row[record]).sum::<f64>();
        let of_pairs: Vec<f64> = sets.pairs.iter().map(of_pair).collect();
        let effective = 1.0 / of_pairs.iter().map(|share| share * share).sum::<f64>();
        let count = |shares: &[f64]| shares.iter().filter(|share| **share > 0.0).count();
        (level, records_in_words(count(row), count(&of_pairs)), effective)
    };
    let even = vec![1.0 / records as f64; records];
    let rows: Vec<&[f64]> = sets.shares.as_deref().map_or(vec![&even[..]], |shares| shares.chunks(records).collect());
    let (level, count, effective) = rows.into_iter().enumerate().map(counts).min_by(|a, b| a.2.total_cmp(&b.2))?;
    let place = format!("{} {} {}", sets.measure.label(), sets.levels[level], sets.measure.unit());
    (effective < FEW_RECORDS as f64 - 0.05).then(|| {
        Alarm::new(
            Severity::Caution,
            "few-records",
            &place,
            format!("its {count} count as {effective:.1}, fewer than {FEW_RECORDS}"),
            "Select more: records.at_level",
        )
    })
}

/// Where the set has few pairs: two components of one, or what is seen of it from several azimuths, are no two of them.
pub fn few(records: usize, pairs: usize) -> Option<Alarm> {
    (pairs < FEW_RECORDS).then(|| {
        Alarm::new(
            Severity::Caution,
            "few-records",
            "Few records",
            format!(
                "{are} ({FEW_RECORDS} advised)",
                are = if pairs < records {
                    format!("{}, {}", counted(pairs, "pair"), counted(records, "record"))
                } else {
                    records.to_string()
                }
            ),
            "",
        )
    })
}

/// The kind of what was noticed while the inputs were read.
pub(super) const NOTICED: &str = "inputs";

/// Fewer earthquakes than this have no band that holds (`make coverage`; docs/confidence-bands.md).
const FEW_EARTHQUAKES: usize = 5;

/// Where several records are of so few earthquakes that no confidence band holds as often as it says.
///
/// - `question`: knows the earthquakes of the records.
pub fn few_earthquakes(question: &Question) -> Option<Alarm> {
    // a single record has no band
    let has_several = uplift_bootstrap::units(&question.pair_of()).len() > 1;
    question.earthquakes().filter(|_| has_several).and_then(too_few)
}

fn too_few(earthquakes: usize) -> Option<Alarm> {
    (earthquakes < FEW_EARTHQUAKES).then(|| {
        Alarm::new(
            Severity::Caution,
            "few-earthquakes",
            "Few earthquakes",
            format!("{earthquakes}; below {FEW_EARTHQUAKES} the bands are unreliable"),
            "Add records of other earthquakes: records.manifest",
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_record_probably_does_not_mean_is_no_note() {
        let doubted = noticed_alarm("RSN1: mistake? PGA 168 g: is its unit right?");
        assert_eq!(
            (doubted.severity, doubted.to_string().as_str()),
            (Severity::Mistake, "RSN1: PGA 168 g: is its unit right?")
        );
        assert_eq!(noticed_alarm("RSN1: begins late").severity, Severity::Note);
    }

    #[test]
    fn five_earthquakes_are_no_longer_few() {
        assert_eq!(too_few(5), None);
        assert_eq!(too_few(4).unwrap().to_string(), "Few earthquakes: 4; below 5 the bands are unreliable");
    }

    #[test]
    fn the_level_with_the_fewest_records_that_count_is_named() {
        let even = |count: usize| vec![1.0 / count as f64; count];
        let mut sets = Sets {
            measure: IntensityMeasure::Pgv,
            levels: vec![1.0, 10.0],
            names: (0..60).map(|record| format!("R{record}")).collect(),
            relative: vec![1.0; 120],
            shares: None,
            pairs: (0..60).map(|record| vec![record]).collect(),
        };
        assert_eq!((few_at_level(&sets), far(&sets)), (None, None));
        sets.shares = Some([even(60), even(20), vec![0.0; 40]].concat());
        let few = few_at_level(&sets).map(|alarm| alarm.to_string()).unwrap_or_default();
        assert!(few.starts_with("PGV 10 cm/s: its 20 records count as 20.0"), "{few}");
        // two of a pair
        sets.pairs = (0..30).map(|pair| vec![2 * pair, 2 * pair + 1]).collect();
        let few = few_at_level(&sets).map(|alarm| alarm.to_string()).unwrap_or_default();
        assert!(few.starts_with("PGV 10 cm/s: its 20 records of 10 pairs count as 10.0"), "{few}");
        sets.relative[3] = 400.0;
        assert!(
            far(&sets).is_some_and(|alarm| alarm.severity == Severity::Mistake && alarm.what.contains("R3 at 1 cm/s"))
        );
    }

    #[test]
    fn forty_records_are_no_longer_few() {
        assert_eq!([few(40, 40), few(80, 40)], [None, None]);
        assert!(few(39, 39).is_some_and(|alarm| alarm.what.starts_with("39 (40 advised)")));
        assert!(few(78, 39).is_some_and(|alarm| alarm.what.starts_with("39 pairs, 78 records (40")));
    }
}
