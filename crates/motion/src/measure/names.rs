//! How measures are called, and how their names are read.

use std::collections::BTreeSet;
use std::fmt;
use std::str::FromStr;
use std::sync::{Mutex, PoisonError};

use super::{IntensityMeasure, Period};
use crate::error::MotionError;

/// How a measure is called.
struct Description {
    label: &'static str,
    key: &'static str,
    unit: &'static str,
    long_name: &'static str,
}

impl IntensityMeasure {
    /// The words that [`FromStr`] accepts, for messages.
    pub const ACCEPTED: &'static str = "pgv, pga, sa_1s (of any period: sa_0p5s is SA at 0.5 s), avgsa_0p2s_2s (of any \
                                        two periods), pgd, cav, arias, si, d5_75, d5_95";

    fn description(self) -> Description {
        let of = |label, key, unit, long_name| Description { label, key, unit, long_name };
        match self {
            Self::Pgv => of("PGV", "pgv", "cm/s", "peak ground velocity"),
            Self::Pga => of("PGA", "pga", "g", "peak ground acceleration"),
            Self::Sa(period) => of(
                interned(format!("SA({period})")),
                interned(format!("sa_{}", period.key())),
                "g",
                interned(format!("5 % damped spectral acceleration at {period} s")),
            ),
            Self::AvgSa { from, to } => of(
                interned(format!("AvgSA({from}-{to})")),
                interned(format!("avgsa_{}_{}", from.key(), to.key())),
                "g",
                interned(format!("average 5 % damped spectral acceleration from {from} to {to} s")),
            ),
            Self::Pgd => of("PGD", "pgd", "cm", "peak ground displacement"),
            Self::Cav => of("CAV", "cav", "cm/s", "cumulative absolute velocity"),
            Self::Arias => of("IA", "arias", "cm/s", "Arias intensity"),
            Self::SpectrumIntensity => of("SI", "si", "cm", "Housner's spectrum intensity, 5 % damped, 0.1 to 2.5 s"),
            Self::D575 => of("D5-75", "d5_75", "s", "significant duration D5-75"),
            Self::D595 => of("D5-95", "d5_95", "s", "significant duration D5-95"),
        }
    }

    /// Short name for text and plots, as engines of hazard write it: "PGV", "SA(1.0)".
    pub fn label(self) -> &'static str {
        self.description().label
    }

    /// Name in files and keys: `pgv`, `sa_1s`, `sa_0p5s`.
    pub fn key(self) -> &'static str {
        self.description().key
    }

    /// Unit of the levels, e.g. "cm/s".
    pub fn unit(self) -> &'static str {
        self.description().unit
    }

    /// The unit as names of columns and arrays have it: `cm_s`.
    pub fn unit_key(self) -> &'static str {
        match self.unit() {
            "cm/s" => "cm_s",
            unit => unit,
        }
    }

    /// Name in full; how the components of a pair are combined belongs to it ([`Combination`](crate::Combination)).
    pub fn long_name(self) -> &'static str {
        self.description().long_name
    }
}

/// One text of each kind, kept for good: there are as many as measures that a user names.
fn interned(text: String) -> &'static str {
    static TEXTS: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
    let mut texts = TEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = texts.get(text.as_str()) {
        return known;
    }
    let kept: &'static str = Box::leak(text.into_boxed_str());
    texts.insert(kept);
    kept
}

impl fmt::Display for IntensityMeasure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.label())
    }
}

/// Accepts the key or the label of a measure, in any case: `sa_0p5s`, `sa_0.5s` and `SA(0.5)` are one.
impl FromStr for IntensityMeasure {
    type Err = MotionError;

    fn from_str(word: &str) -> Result<Self, MotionError> {
        let plain = word.trim().to_lowercase();
        let is_called = |measure: &Self| plain == measure.key() || plain == measure.label().to_lowercase();
        let fixed = Self::WITHOUT_PERIOD.into_iter().find(is_called);
        fixed.or_else(|| spectral(&plain)).ok_or_else(|| MotionError::UnknownWord {
            what: "intensity measure",
            given: word.to_owned(),
            accepted: Self::ACCEPTED,
        })
    }
}

/// A spectral ordinate, or a mean of several, in small letters.
fn spectral(text: &str) -> Option<IntensityMeasure> {
    let parameters = |name: &str| {
        let rest = text.strip_prefix(name)?;
        rest.strip_prefix('_').or_else(|| rest.strip_prefix('(')?.strip_suffix(')'))
    };
    if let Some(range) = parameters("avgsa") {
        let (from, to) = range.split_once(['_', '-', ','])?;
        let (from, to) = (Period::parse(from)?, Period::parse(to)?);
        return (from < to).then_some(IntensityMeasure::AvgSa { from, to });
    }
    // engines may write the damping, per cent, behind the period
    let period = parameters("sa")?;
    let period = period.split_once(',').map_or(period, |(period, damping)| match damping.trim().parse() {
        Ok(5.0) => period,
        _ => "",
    });
    Period::parse(period).map(IntensityMeasure::Sa)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn period(period_s: f64) -> Period {
        Period::from_s(period_s).unwrap()
    }

    #[test]
    fn names_come_back() {
        let with_periods = [
            IntensityMeasure::Sa(period(1.0)),
            IntensityMeasure::Sa(period(0.075)),
            IntensityMeasure::AvgSa { from: period(0.2), to: period(2.0) },
        ];
        for measure in IntensityMeasure::WITHOUT_PERIOD.into_iter().chain(with_periods) {
            for name in [measure.key(), measure.label()] {
                assert_eq!(name.parse::<IntensityMeasure>().unwrap(), measure);
                assert_eq!(format!(" {}", name.to_uppercase()).parse::<IntensityMeasure>().unwrap(), measure);
            }
            assert!(
                measure.key().bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'_')
            );
        }
        let half = IntensityMeasure::Sa(period(0.5));
        for name in ["sa_0p5s", "sa_0.5s", "SA(0.5)", "SA(0.5,5.0)", "Sa(0.50)"] {
            assert_eq!(name.parse::<IntensityMeasure>().unwrap(), half, "{name}");
        }
        assert_eq!((half.key(), half.label(), half.unit()), ("sa_0p5s", "SA(0.5)", "g"));
        assert!(std::ptr::eq(half.key(), half.key()), "one text");
    }

    #[test]
    fn no_measures() {
        for name in ["sa", "sa_", "sa()", "sa(1.0,10)", "sa_0s", "sa_99s", "avgsa_2s_1s", "avgsa_1s", "psa(1)", ""] {
            assert!(name.parse::<IntensityMeasure>().is_err(), "{name}");
        }
        let message = "sa".parse::<IntensityMeasure>().unwrap_err().to_string();
        assert!(message.starts_with("unknown intensity measure \"sa\"; use one of: pgv, pga, sa_1s"), "{message}");
    }
}
