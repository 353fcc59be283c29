//! The tests of a shaking table for other programs.

use polars::prelude::Column;
use serde_json::{Value, json};
use uplift_alarms::alarms;
use uplift_job::JobError;
use uplift_job::alarm::Alarm;
use uplift_result::layout::axis::{DIRECTION, EXCITATION, LEVEL, PERIOD};
use uplift_result::{
    DESIGN_SPECTRUM, DIRECTIONS, Head, ResultFile, ShakeTable, TABLE_EXCITATIONS, TABLE_ORDER, TABLE_SPECTRA,
    TABLE_TESTS,
};
use uplift_studies::shake_table::columns;

use super::matlab::add;
use super::matlab::level_5::{MatFile, Shape};
use super::source::provenance_of;
use crate::error::ExportsError;

/// The tests of a result, and where they come from.
pub(super) struct TestsExport {
    pub(super) head: Head,
    pub(super) table: ShakeTable,
    /// What to know before using them, the worst first.
    pub(super) alarms: Vec<Alarm>,
    /// Name of the result file.
    pub(super) file: String,
    /// One line: program, time, file, records.
    pub(super) provenance: String,
}

impl TestsExport {
    /// Read `file`.
    pub(super) fn from_file(file: &ResultFile) -> Result<Self, ExportsError> {
        let (head, table) = (file.head()?, file.shake_table()?);
        let name = file.path().file_name().unwrap_or_default().to_string_lossy().into_owned();
        let provenance = provenance_of(&head, &name);
        Ok(Self { alarms: alarms(file)?, head, table, file: name, provenance })
    }

    /// A row a test, as the table that a run leaves beside the result.
    pub(super) fn columns(&self) -> Vec<Column> {
        columns(&self.table)
    }

    /// Everything as one JSON object; what is infinite, the displacement of a frame that overturned, is null.
    pub(super) fn json(&self) -> Value {
        json!({
            "provenance": self.provenance,
            "title": self.head.title,
            "created": self.head.created,
            "study_digest": self.head.study_digest(),
            "alarms": self.alarms,
            "shake_table": self.table,
            "order": self.table.order(),
            "spectra": self.table.spectra,
        })
    }

    /// A MATLAB file: `u_m` and every other quantity of a test are excitation × level, spectra are period × direction ×
    /// excitation.
    pub(super) fn matlab(&self) -> Result<Vec<u8>, ExportsError> {
        let ShakeTable { levels, excitations, .. } = &self.table;
        let mut file = MatFile::new(&self.provenance);
        file.text("provenance", &self.provenance);
        let said: Vec<String> = self.alarms.iter().map(|alarm| format!("{}: {alarm}", alarm.severity.word())).collect();
        file.texts("warnings", &said.iter().map(String::as_str).collect::<Vec<_>>());
        file.texts("level", &levels.iter().map(|level| level.name.as_str()).collect::<Vec<_>>());
        file.texts("exc_id", &excitations.iter().map(|one| one.exc_id.as_str()).collect::<Vec<_>>());
        let lengths = &[(LEVEL.name, levels.len()), (EXCITATION.name, excitations.len())];
        for group in [&TABLE_EXCITATIONS, &TABLE_TESTS] {
            add(&mut file, group.quantities, lengths, &self.table, |own| own.name.to_owned());
        }
        let shape = Shape(vec![excitations.len(), levels.len()]);
        let order: Vec<f64> = self.table.order().into_iter().map(f64::from).collect();
        file.numbers(TABLE_ORDER.quantities[0].name, &shape, &order);
        if let Some(spectra) = &self.table.spectra {
            let count = spectra.periods_s.len();
            file.numbers("period_s", &Shape::column(count), &spectra.periods_s);
            let directions = (DIRECTION.name, DIRECTIONS.len());
            let lengths = &[(EXCITATION.name, excitations.len()), directions, (PERIOD.name, count)];
            add(&mut file, TABLE_SPECTRA.quantities, lengths, spectra, |own| own.name.to_owned());
            if let Some(design_m_s2) = &spectra.design_m_s2 {
                add(&mut file, DESIGN_SPECTRUM.quantities, lengths, design_m_s2, |own| own.name.to_owned());
            }
        }
        Ok(file.finish().map_err(JobError::input)?)
    }
}
