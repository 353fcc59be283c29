//! An answer for an uncertain structure in a sentence.

use super::report::{AleatoryResult, EpistemicResult, Spread, UncertainFinding, UncertainResult, VarianceShare};

impl UncertainResult {
    /// The answer with its band, and what that owes to what, in one sentence.
    pub fn in_words(&self) -> String {
        let Self { site, im, of, unit, as_described, found } = self;
        let described = shown(*as_described, unit);
        match found {
            UncertainFinding::Epistemic(EpistemicResult { by_structure, by_all, shares, no_shares }) => {
                let owed = match no_shares {
                    Some(reason) => format!("what it owes to what cannot be told: {reason}"),
                    None => format!("it owes that to {}", shares.iter().map(share).collect::<Vec<_>>().join(", ")),
                };
                let mean = shown(by_structure.mean, unit);
                let [alone, all] = [by_structure, by_all].map(|spread| limits(spread, unit));
                format!(
                    "{of}, {site}, {im}: {mean} on average, {alone} for 90 % of what the structure may be; with what \
                     else is not known {all}; as described {described}; {owed}"
                )
            }
            UncertainFinding::Aleatory(AleatoryResult { value, by_record, by_earthquake }) => {
                let records = by_record.map(|limits| format!(", 90 % band of the records {}", range(limits, unit)));
                let earthquakes = by_earthquake.map(|limits| format!(", of the earthquakes {}", range(limits, unit)));
                format!(
                    "{of}, {site}, {im}: {}{}{}; as described {described}",
                    shown(*value, unit),
                    records.unwrap_or_default(),
                    earthquakes.unwrap_or_default()
                )
            }
        }
    }
}

/// An answer without its unit.
fn number(value: f64, unit: &str) -> String {
    match unit {
        "m" if value.is_infinite() => "overturns".to_owned(),
        "m" => format!("{value:.4}"),
        _ => format!("{value:.3e}"),
    }
}

/// An answer in its unit.
fn shown(value: f64, unit: &str) -> String {
    with_unit(number(value, unit), unit)
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

/// A share of which the sampling makes more than all, or less than nothing, is told with that.
fn share(of: &VarianceShare) -> String {
    let is_share = |value: f64| (0.0..=1.0).contains(&value);
    format!(
        "{} {:.0} ± {:.0} % (alone {:.0} ± {:.0} %){}",
        of.factor,
        100.0 * of.total,
        100.0 * of.total_error,
        100.0 * of.first_order,
        100.0 * of.first_order_error,
        if is_share(of.first_order) && is_share(of.total) { "" } else { " (few samples)" }
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_few_samples_make_of_a_share_is_said() {
        let of = |first_order| VarianceShare {
            factor: "capacity".to_owned(),
            first_order,
            first_order_error: 0.2,
            total: 0.5,
            total_error: 0.1,
        };
        assert_eq!(share(&of(0.4)), "capacity 50 ± 10 % (alone 40 ± 20 %)");
        assert_eq!(share(&of(1.1)), "capacity 50 ± 10 % (alone 110 ± 20 %) (few samples)");
        assert_eq!(share(&of(-0.04)), "capacity 50 ± 10 % (alone -4 ± 20 %) (few samples)");
    }
}
