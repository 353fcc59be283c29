//! The workbook of a shaking table: its tests, a line each, and where they come from.

use rust_xlsxwriter::{Workbook, XlsxError};
use uplift_result::TABLE_TESTS;
use uplift_result::declared::Quantity;

use super::sheet::{Formats, Sheet, Shown};
use super::{no_workbook, properties_of, study_lines};
use crate::error::ExportsError;
use crate::export::shake_table::TestsExport;

/// Columns of what a line is of.
const OF: [&str; 6] = ["order", "excitation", "class", "level", "record", "RSN"];

impl TestsExport {
    /// A workbook; the same bytes for the same result.
    pub(crate) fn workbook(&self) -> Result<Vec<u8>, ExportsError> {
        self.sheets().map_err(|error| no_workbook(&self.file, &error))
    }

    fn sheets(&self) -> Result<Vec<u8>, XlsxError> {
        let mut workbook = Workbook::new();
        workbook.set_properties(&properties_of(&self.head, &self.provenance)?);
        let formats = Formats::new();
        let mut add = |name: &str, fill: &dyn Fn(&mut Sheet<'_>) -> Result<(), XlsxError>| {
            let worksheet = workbook.add_worksheet();
            worksheet.set_name(name)?;
            fill(&mut Sheet::new(worksheet, &formats))
        };
        add("About", &|sheet| self.about_tests(sheet))?;
        add("Tests", &|sheet| self.tests_sheet(sheet))?;
        add("Study", &|sheet| study_lines(&self.head.study_toml, sheet))?;
        workbook.save_to_buffer()
    }

    fn about_tests(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        let (head, table) = (&self.head, &self.table);
        let level = |of: &uplift_result::TableLevel| format!("{} ({} m/s)", of.name, of.pgv_srss_m_s);
        let facts = [
            ("Tests of a shaking table", head.title.clone()),
            ("Result file", self.file.clone()),
            ("Made", head.created.clone()),
            ("Program", format!("uplift {} ({})", head.version, head.commit)),
            ("Command", head.command.clone()),
            ("Study file", head.study_file.clone()),
            ("Study digest", head.study_digest()),
            ("Structure", table.structure.clone()),
            ("Records", table.records.clone()),
            ("Synthetic records", ["no", "yes: not for design"][usize::from(table.synthetic)].to_owned()),
            ("Length scale", table.length_scale.to_string()),
            ("Levels, SRSS of both PGV", table.levels.iter().map(level).collect::<Vec<_>>().join(", ")),
        ];
        for (line, (name, value)) in facts.iter().enumerate() {
            sheet.heading((line, 0), name, false)?;
            sheet.long_text((line, 1), value)?;
        }
        for (index, alarm) in self.alarms.iter().enumerate() {
            sheet.long_text((facts.len() + index, 1), &format!("{}: {alarm}", alarm.severity.word()))?;
        }
        sheet.finish((0, 1), &[30.0, 110.0])
    }

    /// The tests, level by level.
    fn tests_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        for (column, name) in OF.iter().enumerate() {
            sheet.heading((0, column), name, true)?;
        }
        for (column, Quantity { unit, long_name, .. }) in TABLE_TESTS.quantities.iter().enumerate() {
            let name = if *unit == "1" { (*long_name).to_owned() } else { format!("{long_name}, {unit}") };
            sheet.heading((0, OF.len() + column), &name, true)?;
        }
        let (table, order) = (&self.table, self.table.order());
        let tests =
            (0..table.levels.len()).flat_map(|level| table.tests_at_level(level).map(move |test| (level, test)));
        for (index, (level, (excitation, _))) in tests.enumerate() {
            let line = index + 1;
            sheet.number((line, 0), f64::from(order[index]), Shown::Whole, "")?;
            let level = &table.levels[level].name;
            let of = [&excitation.exc_id, &excitation.class, level, &excitation.record, &excitation.rsn];
            for (column, text) in of.into_iter().enumerate() {
                sheet.text((line, 1 + column), text)?;
            }
            for (column, quantity) in TABLE_TESTS.quantities.iter().enumerate() {
                let value = quantity.number(table, index).unwrap_or(f64::NAN);
                sheet.number((line, OF.len() + column), value, Shown::Plain, "overturned")?;
            }
        }
        sheet.finish((1, 2), &[8.0, 12.0, 10.0, 10.0, 30.0, 8.0])
    }
}
