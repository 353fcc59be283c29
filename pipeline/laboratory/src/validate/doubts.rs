//! Peaks whose unit is probably not the one that their column names.

use uplift_job::text::rounded;
use uplift_plausible::USUAL_THRESHOLD;

use super::group::GroupReport;
use super::peaks::metres_of;

/// Medians further apart than so many times are of two units: a model is off by some times, and cm taken for m by 100.
const TIMES_APART: f64 = 50.0;

/// What to ask about the peaks of all `groups`, in the unit of the column `value`.
pub(super) fn doubts(value: &str, groups: &[GroupReport]) -> Vec<String> {
    let medians = |of: &dyn Fn(&GroupReport) -> Option<f64>| groups.iter().filter_map(of).collect::<Vec<f64>>();
    let kinds = [
        ("the median of the measured peaks", medians(&|group| group.median_measured)),
        ("the median of the computed peaks", medians(&|group| group.median_computed)),
    ];
    let unusual = kinds.into_iter().filter_map(|(name, medians)| {
        let metres = metres_of(value)?;
        let positive = medians.into_iter().filter(|median| *median > 0.0);
        positive.map(|median| metres * median).find_map(|median| USUAL_THRESHOLD.unlikely(name, median))
    });
    let doubts: Vec<String> = unusual.map(|found| format!("mistake? {found}")).collect();
    if doubts.is_empty() { apart(groups).into_iter().collect() } else { doubts }
}

/// That the medians of a group are far apart; none where those of no group are.
fn apart(groups: &[GroupReport]) -> Option<String> {
    let ratios = groups.iter().filter_map(|group| Some(group.median_measured? / group.median_computed?));
    let far =
        ratios.filter(|ratio| *ratio > 0.0 && ratio.is_finite()).map(|ratio| (ratio.max(1.0 / ratio), ratio > 1.0));
    let (times, is_measured) = far.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|(times, _)| *times > TIMES_APART)?;
    let (large, small) = if is_measured { ("measured", "computed") } else { ("computed", "measured") };
    Some(format!(
        "mistake? the median of the {large} peaks is {} times that of the {small}: are both in the units that their \
         columns name?",
        rounded(times, 2)
    ))
}
