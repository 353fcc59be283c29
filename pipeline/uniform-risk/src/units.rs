//! What of the records of a result tells something by itself: each record, or each pair with all that is made of it.

use uplift_study::UniformRiskStudy;

/// What is left out together: each record by itself, or a pair with all its azimuths and structures.
#[derive(Debug, Clone)]
pub struct RecordUnits {
    /// Positions of the records of each.
    pub records: Vec<Vec<usize>>,
    /// What each is called: the record or the pair.
    pub names: Vec<String>,
    /// The unit of each record, `[record]`.
    pub of: Vec<usize>,
    /// Structures that each motion shakes, one a record; one where they are known exactly.
    pub structures_of_a_motion: usize,
}

impl RecordUnits {
    /// Those of `records` by their names, in a study.
    pub(super) fn new(study: &UniformRiskStudy, records: &[String]) -> Self {
        let mut units = Self {
            records: Vec::new(),
            names: Vec::new(),
            of: Vec::new(),
            structures_of_a_motion: study.structures_of_a_motion(),
        };
        for (position, record) in records.iter().enumerate() {
            let name = if study.keeps_pairs_together() { study.pair_of_record(record) } else { record };
            // the records of a pair follow each other
            if units.names.last().is_none_or(|last| last != name) || !study.keeps_pairs_together() {
                units.names.push(name.to_owned());
                units.records.push(Vec::new());
            }
            let unit = units.names.len() - 1;
            units.records[unit].push(position);
            units.of.push(unit);
        }
        units
    }

    /// What is left out with the record at a position.
    ///
    /// # Panics
    /// If there is no such record.
    pub fn name(&self, record: usize) -> &str {
        &self.names[self.of[record]]
    }

    /// The position of the first record of each.
    pub fn firsts(&self) -> impl Iterator<Item = usize> + '_ {
        self.records.iter().map(|records| records[0])
    }

    /// Whether each is a record.
    pub fn are_records(&self) -> bool {
        self.records.len() == self.of.len()
    }
}
