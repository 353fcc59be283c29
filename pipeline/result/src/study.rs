//! The study of a result, as the file holds it.

use uplift_study::{AnyStudy, Kind, Study, UniformRiskStudy};

use super::file::ResultFile;
use super::layout::attribute::root;
use crate::error::ResultError;

impl ResultFile {
    /// The study; its records and curves need not be there any more.
    ///
    /// # Errors
    /// A file that is damaged, or of another kind.
    pub fn stored_study(&self) -> Result<UniformRiskStudy, ResultError> {
        self.require(Kind::UniformRisk)?;
        match Study::stored(&root::STUDY_TOML.read(&self.reader, &[])?) {
            Ok(AnyStudy::UniformRisk(study)) => Ok(*study),
            Ok(other) => Err(self.damaged(format!("its study {} is of another kind", other.title()))),
            Err(error) => {
                let mistakes: Vec<String> = error.mistakes().iter().map(ToString::to_string).collect();
                Err(self.fail(format!("the study in the file cannot be read: {}", mistakes.join("; "))))
            }
        }
    }

    /// Refuses a result each of whose levels has records of its own, of which `question` has no answer.
    ///
    /// # Errors
    /// That it is one; a file that is damaged or of another kind.
    pub fn refuse_records_at_level(&self, question: &str) -> Result<(), ResultError> {
        if self.stored_study()?.records.at_level.is_none() {
            return Ok(());
        }
        Err(self.fail(format!(
            "its levels have records of their own (records.at_level), and {question}: use a result with the same \
             records at every level"
        )))
    }
}
