//! Hazard consistency: whether the records bring, at each site, what its hazard says of the other intensity measure,
//! and the spectra of weights by which they do (docs/method.md, section 18).
//!
//! | module | what is in it |
//! |---|---|
//! | `answer` | all of it for a run |
//! | `question` | what is asked of: records, stripes and the hazard of every measure, from a run or from a result |
//! | `branches` | the same for weighted hazard curves |
//! | `finding` | the answer for one set of stripes at one site, with the repair |
//! | `earthquakes` | those of the site's hazard, beside those of the records |
//! | `spectra` | the spectra of repaired weights |
//! | `reweighing` | the same for other samples of the records, each with weights of its own |
//! | `report` | both as rows and sentences |
//! | `write` | arrays of the result file, and the table beside it |
//! | `effective` | how many records count under the weights of a result |
//! | `asked` | the answer at other risks than those of the study |

mod answer;
mod asked;
mod branches;
mod earthquakes;
mod effective;
mod finding;
mod question;
mod report;
mod reweighing;
mod spectra;
mod write;

pub use answer::Answer;
pub(crate) use asked::consistency_of_asked;
pub use branches::BranchFindings;
pub use earthquakes::{EarthquakeRow, disaggregated, earthquakes};
pub use effective::least_effective;
pub use finding::Finding;
pub use question::Question;
pub use report::{
    AgreementRow, ConsistencyReport, ConsistencyRow, MissRow, NearestRow, RepairRow, TargetRow, TwoSidedRow,
};
pub use reweighing::{RepairedAnalysis, Reweighed, ReweighedBranch, Reweighing};
pub use spectra::{Repairs, repairs_of};
pub use uplift_consistency::Verdict;
pub use write::{Keep, add, columns, consistency_path, replaced};
