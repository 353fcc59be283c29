//! Hazard consistency: whether the records bring, at each site, what its hazard says of the other intensity measure,
//! and the spectra of weights by which they do (docs/method.md, section 18).
//!
//! | module | what is in it |
//! |---|---|
//! | `answer` | all of it for a run or a result, and what a result holds of it |
//! | `question` | what is asked of: records, stripes and the hazard of every measure, from a run or from a result |
//! | `branches` | the same for weighted hazard curves |
//! | `finding` | the answer for one set of stripes at one site, with the repair |
//! | `earthquakes` | those of the site's hazard, beside those of the records |
//! | `repairs` | the spectra of repaired weights, and how many records count under them |
//! | `reweighing` | the same for other samples of the records, each with weights of its own |
//! | `report` | both as rows and sentences |

mod answer;
mod branches;
mod earthquakes;
mod finding;
mod question;
mod repairs;
mod report;
mod reweighing;

pub use answer::Answer;
pub(crate) use answer::consistency_at_target_risks;
pub use branches::BranchFindings;
pub use earthquakes::{disaggregated, earthquakes};
pub use finding::Finding;
pub use question::Question;
pub use repairs::{Repairs, least_effective};
pub use report::{
    AgreementRow, ConsistencyReport, ConsistencyRow, EarthquakeRow, MissRow, NearestRow, RepairRow, TargetRow,
    TwoSidedRow, missed_in_words, times_in_words,
};
pub use reweighing::{RepairedAnalysis, Reweighed, ReweighedBranch, Reweighing};
pub use uplift_consistency::Verdict;
