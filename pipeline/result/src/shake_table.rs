//! The tests of a shaking table: what a run computed, and what a result file holds of it.

use serde::Serialize;
use uplift_job::Array;
use uplift_labelled::{LabelledError, LabelledWriter};
use uplift_study::Kind;

use super::declared::group;
use super::file::ResultFile;
use super::layout::attribute::shake_table as attribute;
use super::layout::axis::{DIRECTION, EXCITATION, LEVEL, PERIOD};
use crate::error::ResultError;

/// Every test of a shaking table.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ShakeTable {
    /// Where the records come from, in a line.
    pub records: String,
    /// Whether they are synthetic.
    pub synthetic: bool,
    /// The structure file.
    pub structure: String,
    /// Lengths of the prototype over those of the model.
    pub length_scale: f64,
    /// The levels of shaking.
    pub levels: Vec<TableLevel>,
    /// What is played.
    pub excitations: Vec<Excitation>,
    /// Every excitation at every level, `[level, excitation]`.
    pub tests: Vec<TableTest>,
    /// What the table plays as response spectra; none in a result of a version that had none.
    #[serde(skip)]
    pub spectra: Option<TableSpectra>,
}

/// Response spectra of what the table plays, 5 % damped (Fig. 6.12).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TableSpectra {
    /// Natural periods in the time of the table, s.
    pub periods_s: Vec<f64>,
    /// Of each component in the time of the table with the accelerations as recorded, m/s²,
    /// `[excitation, direction, period]`: times the factor of a test it is the spectrum on the table.
    pub recorded_m_s2: Vec<f64>,
    /// The code's in the time of the table, m/s², NaN beyond its longest period; none where none was asked for.
    pub design_m_s2: Option<Vec<f64>>,
}

impl TableSpectra {
    /// The spectrum of an excitation's component as recorded, m/s².
    pub fn recorded(&self, excitation: usize, direction: usize) -> &[f64] {
        let count = self.periods_s.len();
        let first = (excitation * DIRECTIONS.len() + direction) * count;
        &self.recorded_m_s2[first..first + count]
    }
}

/// The horizontal components of what a table plays.
pub const DIRECTIONS: [&str; 2] = ["x", "y"];

/// A level of shaking.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TableLevel {
    /// Its name.
    pub name: String,
    /// `√(PGV_x² + PGV_y²)` on the table, m/s (Eq. 6.9).
    pub pgv_srss_m_s: f64,
}

/// A record that is played.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Excitation {
    /// What it is called among the tests.
    pub exc_id: String,
    /// Its class: near-field pulse, near field, far field.
    pub class: String,
    /// Identifier of the record.
    pub record: String,
    /// Its sequence number; empty where it has none.
    pub rsn: String,
    /// `√(PGV_x² + PGV_y²)` as recorded, m/s.
    pub recorded_pgv_m_s: f64,
}

/// What the frame does in one test. Of one that overturns displacements and forces of restrainers are infinite;
/// accelerations and base shear are the largest up to then.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct TableTest {
    /// Factor on the accelerations of the record.
    pub factor: f64,
    /// `√(PGA_x² + PGA_y²)` on the table, m/s².
    pub pga_srss_m_s2: f64,
    /// Largest horizontal displacement U of the deck, m.
    pub u_m: f64,
    /// Largest displacement along the first component, m.
    pub u_x_m: f64,
    /// Along the second, m.
    pub u_y_m: f64,
    /// U over the height of the columns.
    pub drift: f64,
    /// Largest force of a restrainer, N; NaN without.
    pub tendon_n: f64,
    /// Largest deformation of its springs, m; NaN without.
    pub spring_m: f64,
    /// Largest base shear of the deck, N (Eq. 6.10).
    pub base_shear_n: f64,
    /// Largest horizontal reaction, the inertia of the columns counted too, N.
    pub base_reaction_n: f64,
    /// Largest total acceleration of the deck, m/s².
    pub deck_acceleration_m_s2: f64,
}

group! {
    /// What is played, at which levels.
    pub const TABLE_EXCITATIONS: ShakeTable = "/shake_table";
    "pgv_srss_m_s" [LEVEL] F64 "m/s" "SRSS of both PGV on the table"
        ("root of the sum of squares of both PGV on the table (Eq. 6.9)") = |of, at| of.levels[at].pgv_srss_m_s;
    "class" [EXCITATION] Text "" "class of the excitation" = |of, at| of.excitations[at].class;
    "record" [EXCITATION] Text "" "record" ("identifier of the record") = |of, at| of.excitations[at].record;
    "rsn" [EXCITATION] Text "" "record sequence number" ("its sequence number; empty if not known")
        = |of, at| of.excitations[at].rsn;
    "recorded_pgv_m_s" [EXCITATION] F64 "m/s" "SRSS of both PGV as recorded"
        ("root of the sum of squares of both PGV as recorded") = |of, at| of.excitations[at].recorded_pgv_m_s;
}

group! {
    /// What the frame does in each test; places of [`ShakeTable::tests`] are `[level, excitation]`.
    pub const TABLE_TESTS: ShakeTable = TABLE_EXCITATIONS.path;
    "factor" [LEVEL, EXCITATION] F64 "1" "factor on the accelerations of the record" = |of, at| of.tests[at].factor;
    "pga_srss_m_s2" [LEVEL, EXCITATION] F64 "m/s2" "SRSS of both PGA on the table"
        = |of, at| of.tests[at].pga_srss_m_s2;
    "u_m" [LEVEL, EXCITATION] F64 "m" "peak displacement of the deck, infinite where overturned"
        = |of, at| of.tests[at].u_m;
    "u_x_m" [LEVEL, EXCITATION] F64 "m" "peak displacement along the first component" = |of, at| of.tests[at].u_x_m;
    "u_y_m" [LEVEL, EXCITATION] F64 "m" "peak displacement along the second component" = |of, at| of.tests[at].u_y_m;
    "drift" [LEVEL, EXCITATION] F64 "1" "peak displacement over the height of the columns"
        = |of, at| of.tests[at].drift;
    "tendon_n" [LEVEL, EXCITATION] F64 "N" "peak force of a restrainer, NaN without" = |of, at| of.tests[at].tendon_n;
    "spring_m" [LEVEL, EXCITATION] F64 "m" "peak deformation of its springs, NaN without"
        = |of, at| of.tests[at].spring_m;
    "base_shear_n" [LEVEL, EXCITATION] F64 "N" "peak base shear of the deck (Eq. 6.10)"
        = |of, at| of.tests[at].base_shear_n;
    "base_reaction_n" [LEVEL, EXCITATION] F64 "N" "peak horizontal reaction, columns counted"
        = |of, at| of.tests[at].base_reaction_n;
    "deck_acceleration_m_s2" [LEVEL, EXCITATION] F64 "m/s2" "peak total acceleration of the deck"
        = |of, at| of.tests[at].deck_acceleration_m_s2;
}

group! {
    /// Place of each test in the [order](ShakeTable::order) of rising displacement.
    pub const TABLE_ORDER: Array<2, u32> = TABLE_EXCITATIONS.path;
    "order" [LEVEL, EXCITATION] U32 "1" "place in the order of rising displacement, from 1" = |of, at| of[at];
}

group! {
    /// Response spectra of what is played.
    pub const TABLE_SPECTRA: TableSpectra = TABLE_EXCITATIONS.path;
    "spectral_acceleration_m_s2" [EXCITATION, DIRECTION, PERIOD] F64 "m/s2"
        "spectral acceleration at 5 % damping of the component in the time of the table, accelerations as recorded: \
         times factor it is that on the table"
        ("at 5 % damping, in the time of the table with the accelerations as recorded: times `factor` it is that on \
          the table") = |of, at| of.recorded_m_s2[at];
}

group! {
    /// The code's spectrum, where one was asked for.
    pub const DESIGN_SPECTRUM: Vec<f64> = TABLE_EXCITATIONS.path;
    "design_spectrum_m_s2" [PERIOD] F64 "m/s2"
        "elastic response spectrum of EN 1998-1 in the time of the table, NaN beyond its longest period"
        ("elastic spectrum of EN 1998-1 in the time of the table, NaN beyond 4 s of the prototype; where \
          `[spectra.design]` asks for it") = |of, at| of[at];
}

impl ShakeTable {
    /// Writes every test.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write(&self, writer: &mut LabelledWriter) -> Result<(), LabelledError> {
        let lengths = &[(LEVEL.name, self.levels.len()), (EXCITATION.name, self.excitations.len())];
        TABLE_EXCITATIONS.write(writer, &[], lengths, self)?;
        TABLE_TESTS.write(writer, &[], lengths, self)?;
        TABLE_ORDER.write_array(writer, &[], &self.order())
    }

    /// The tests of a level with their excitations.
    pub fn tests_at_level(&self, level: usize) -> impl Iterator<Item = (&Excitation, &TableTest)> {
        let count = self.excitations.len();
        self.excitations.iter().zip(&self.tests[level * count..(level + 1) * count])
    }

    /// Place of each test in the order of rising displacement, from 1; those that overturn stand last, equal ones in
    /// the order of levels and excitations.
    pub fn order(&self) -> Vec<u32> {
        let mut tests: Vec<usize> = (0..self.tests.len()).collect();
        tests.sort_by(|&one, &other| self.tests[one].u_m.total_cmp(&self.tests[other].u_m));
        let mut order = vec![0; tests.len()];
        for (place, test) in (1..).zip(tests) {
            order[test] = place;
        }
        order
    }

    /// The classes, in the order of the excitations.
    pub fn classes(&self) -> Vec<&str> {
        let mut classes: Vec<&str> = Vec::new();
        for excitation in &self.excitations {
            if !classes.contains(&excitation.class.as_str()) {
                classes.push(&excitation.class);
            }
        }
        classes
    }
}

impl ResultFile {
    /// The tests of a result of a shaking table.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn shake_table(&self) -> Result<ShakeTable, ResultError> {
        self.require(Kind::ShakeTable)?;
        let reader = &self.reader;
        let (names, ids) = (reader.axis::<String>(LEVEL.name)?, reader.axis::<String>(EXCITATION.name)?);
        let (level, excitation) = ((LEVEL.name, names.len()), (EXCITATION.name, ids.len()));
        if names.is_empty() || ids.is_empty() {
            return Err(self.damaged("an axis of its tests is empty"));
        }
        let mut table = ShakeTable {
            records: self.record_set()?,
            synthetic: self.is_synthetic()?,
            structure: attribute::STRUCTURE.read(reader, &[])?,
            length_scale: attribute::LENGTH_SCALE.read(reader, &[])?,
            levels: names.into_iter().map(|name| TableLevel { name, pgv_srss_m_s: f64::NAN }).collect(),
            tests: vec![TableTest::default(); level.1 * excitation.1],
            excitations: ids.into_iter().map(|exc_id| Excitation { exc_id, ..Excitation::default() }).collect(),
            spectra: None,
        };
        TABLE_EXCITATIONS.read(self, &[], &[level, excitation], &mut table)?;
        TABLE_TESTS.read(self, &[], &[level, excitation], &mut table)?;
        table.spectra = self.table_spectra(excitation)?;
        Ok(table)
    }

    /// The spectra of what a table plays; none in a result of a version that had none.
    fn table_spectra(&self, excitation: (&str, usize)) -> Result<Option<TableSpectra>, ResultError> {
        if !TABLE_SPECTRA.is_in(self, &[]) {
            return Ok(None);
        }
        let periods_s = self.reader.axis::<f64>(PERIOD.name)?;
        let lengths = [excitation, (DIRECTION.name, DIRECTIONS.len()), (PERIOD.name, periods_s.len())];
        let nan = |axes: &[(&str, usize)]| vec![f64::NAN; axes.iter().map(|(_, length)| length).product()];
        let design_m_s2 = DESIGN_SPECTRUM.is_in(self, &[]).then(|| nan(&lengths[2..]));
        let mut spectra = TableSpectra { periods_s, recorded_m_s2: nan(&lengths), design_m_s2 };
        TABLE_SPECTRA.read(self, &[], &lengths, &mut spectra)?;
        spectra.design_m_s2.iter_mut().try_for_each(|own| DESIGN_SPECTRUM.read(self, &[], &lengths, own))?;
        Ok(Some(spectra))
    }
}
