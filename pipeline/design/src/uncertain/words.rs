//! An answer for an uncertain structure in a sentence.

use uplift_job::text::rate;

use super::report::{AleatoryResult, EpistemicResult, Spread, UncertainFinding, UncertainResult, VarianceShare};

/// A share with a larger standard error says nothing: a band of two errors to either side holds every share there is.
const MOST_ERROR: f64 = 0.3;

impl UncertainResult {
    /// The answer with its band, and what that owes to what, in one sentence.
    pub fn in_words(&self) -> String {
        let Self { site, im, of, unit, found, .. } = self;
        let described = shown(self.as_described, self.as_described_at_most_per_year, unit);
        match found {
            UncertainFinding::Epistemic(EpistemicResult { by_structure, by_all, shares, no_shares }) => {
                let mean = shown(by_structure.mean, by_structure.at_most_per_year, unit);
                if is_unseen(by_structure.mean, unit) {
                    return format!(
                        "{of}, {site}, {im}: {mean} over the possible structures; as described {described}"
                    );
                }
                let owed = match no_shares {
                    Some(reason) => format!("no shares of the variance: {reason}"),
                    None => owed(shares),
                };
                let [alone, all] = [by_structure, by_all].map(|spread| limits(spread, unit));
                format!(
                    "{of}, {site}, {im}: mean {mean}; 90 % of the possible structures {alone}, with all uncertainty \
                     {all}; as described {described}; {owed}"
                )
            }
            UncertainFinding::Aleatory(AleatoryResult {
                value,
                at_most_per_year,
                by_record,
                by_earthquake,
                with_hazard,
            }) => {
                let records = by_record.map(|limits| format!(", 90 % band of the records {}", range(limits, unit)));
                let earthquakes = by_earthquake.map(|limits| format!(", of the earthquakes {}", range(limits, unit)));
                let hazard = with_hazard.map(|limits| format!(", with the hazard's curves {}", range(limits, unit)));
                format!(
                    "{of}, {site}, {im}: {}{}{}{}; as described {described}",
                    shown(*value, *at_most_per_year, unit),
                    records.unwrap_or_default(),
                    earthquakes.unwrap_or_default(),
                    hazard.unwrap_or_default()
                )
            }
        }
    }
}

/// Whether no run shows what is counted; a demand is no count.
fn is_unseen(value: f64, unit: &str) -> bool {
    unit != "m" && value == 0.0
}

/// An answer without its unit.
fn number(value: f64, unit: &str) -> String {
    match unit {
        "m" if value.is_infinite() => "overturns".to_owned(),
        "m" => format!("{value:.4}"),
        // a limit of a band: what is counted is none for some of it, and that is not never
        _ if value == 0.0 => "none seen".to_owned(),
        _ => rate(value),
    }
}

/// An answer in its unit; of what no run shows what it is at most.
fn shown(value: f64, at_most_per_year: Option<f64>, unit: &str) -> String {
    match at_most_per_year {
        Some(bound) => format!("at most {} per year: no run shows it", rate(bound)),
        None if is_unseen(value, unit) => "cannot happen".to_owned(),
        None => with_unit(number(value, unit), unit),
    }
}

fn with_unit(text: String, unit: &str) -> String {
    match unit {
        "m" if text.ends_with("overturns") => text,
        "m" => text + " m",
        _ => text + " per year",
    }
}

/// From where to where an answer may be.
fn range([lower, upper]: [f64; 2], unit: &str) -> String {
    with_unit(format!("{} to {}", number(lower, unit), number(upper, unit)), unit)
}

fn limits(spread: &Spread, unit: &str) -> String {
    let [lower, .., upper] = spread.percentiles;
    range([lower, upper], unit)
}

/// What a scatter owes to what, the most first.
fn owed(shares: &[VarianceShare]) -> String {
    if shares.iter().all(|of| !is_told(of.total_error) && !is_told(of.first_order_error)) {
        return "shares of the variance need more samples (samples of [uncertainty])".to_owned();
    }
    format!("of its variance {}", shares.iter().map(share).collect::<Vec<_>>().join(", "))
}

/// Whether a share of this standard error can be told from others.
fn is_told(standard_error: f64) -> bool {
    standard_error <= MOST_ERROR
}

/// A share of which the sampling makes more than all, or less than nothing, is reported with that; one that the
/// sampling leaves open is not told.
fn share(of: &VarianceShare) -> String {
    let number =
        |value: f64, error: f64| is_told(error).then(|| format!("{:.0} ± {:.0} %", 100.0 * value, 100.0 * error));
    let is_share = |value: f64| (0.0..=1.0).contains(&value);
    let few = if is_share(of.first_order) && is_share(of.total) { "" } else { " (few samples)" };
    let factor = &of.factor;
    match [number(of.total, of.total_error), number(of.first_order, of.first_order_error)] {
        [Some(total), Some(alone)] => format!("{factor} {total} (alone {alone}){few}"),
        [Some(total), None] => format!("{factor} {total} (alone: too few samples to say)"),
        [None, Some(alone)] => format!("{factor} (alone {alone}; too few samples to say more)"),
        [None, None] => format!("{factor} (too few samples to say)"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(first_order: f64, first_order_error: f64, total_error: f64) -> VarianceShare {
        VarianceShare { factor: "capacity".to_owned(), first_order, first_order_error, total: 0.5, total_error }
    }

    #[test]
    fn a_share_outside_its_range_is_marked_as_of_few_samples() {
        assert_eq!(share(&of(0.4, 0.2, 0.1)), "capacity 50 ± 10 % (alone 40 ± 20 %)");
        assert_eq!(share(&of(1.1, 0.2, 0.1)), "capacity 50 ± 10 % (alone 110 ± 20 %) (few samples)");
        assert_eq!(share(&of(-0.04, 0.2, 0.1)), "capacity 50 ± 10 % (alone -4 ± 20 %) (few samples)");
    }

    /// 154 ± 57 % is no share.
    #[test]
    fn an_uncertain_share_is_not_reported() {
        assert_eq!(share(&of(1.54, 0.57, 0.1)), "capacity 50 ± 10 % (alone: too few samples to say)");
        assert_eq!(share(&of(0.4, 0.2, 0.31)), "capacity (alone 40 ± 20 %; too few samples to say more)");
        assert_eq!(share(&of(0.4, 0.5, f64::NAN)), "capacity (too few samples to say)");
        let (known, open) = (of(0.4, 0.2, 0.1), of(0.4, 0.5, 0.6));
        assert!(owed(&[known, open.clone()]).ends_with("(alone 40 ± 20 %), capacity (too few samples to say)"));
        assert!(owed(&[open]).contains("need more samples"));
    }

    #[test]
    fn zero_counts_are_reported_as_a_bound() {
        assert_eq!(shown(0.0, Some(1.23e-5), "1/yr"), "at most 1.2e-5 per year: no run shows it");
        assert_eq!(shown(0.0, None, "1/yr"), "cannot happen");
        assert_eq!(shown(0.0, None, "m"), "0.0000 m");
        assert_eq!(range([0.0, 2e-4], "1/yr"), "none seen to 2.0e-4 per year");
    }
}
