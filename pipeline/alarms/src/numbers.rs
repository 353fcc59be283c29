//! Numbers of a command line that can be, but are probably in another unit.

use uplift_job::alarm::{Alarm, Severity};
use uplift_plausible::Range;

/// The alarms of what is `given`: what is usual of a number, its option, and the number where there is one.
pub fn of_numbers(subject: &str, given: &[(Range, &'static str, Option<f64>)]) -> Vec<Alarm> {
    let unlikely = |(usual, option, value): &(Range, &'static str, Option<f64>)| usual.unlikely(option, (*value)?);
    let alarm = |found: uplift_plausible::Unlikely| {
        Alarm::of_one(Severity::Mistake, "unlikely-number", subject, found.to_string(), &found.what_to_do())
    };
    given.iter().filter_map(unlikely).map(alarm).collect()
}
