//! What a table says about itself: measure, unit and component in a comment or a column name.

use crate::component::ComponentDefinition;
use crate::unit::CurveUnit;

/// Measure, unit and component as far as a text names them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Declaration {
    pub(crate) measure: Option<String>,
    pub(crate) unit: Option<String>,
    /// How horizontal components are combined; more than one where the text contradicts itself.
    pub(crate) components: Vec<ComponentDefinition>,
    /// What must name a definition of the component, and none that is known.
    pub(crate) doubtful: Option<String>,
}

/// What the second column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SecondColumn {
    /// Mean annual frequency of exceedance, 1/yr.
    AnnualRate,
    /// Probability of exceedance within [`crate::CsvOptions::years`].
    Probability,
    /// Return period, years: one over the annual rate.
    ReturnPeriod,
}

impl SecondColumn {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::AnnualRate => "annual rates",
            Self::Probability => "probabilities of exceedance",
            Self::ReturnPeriod => "return periods",
        }
    }
}

/// A column recognised by its name.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Column {
    Intensity(Declaration),
    Hazard(SecondColumn),
    /// Probabilities of exceedance within so many years.
    ProbabilityWithin(f64),
}

/// Names of intensity columns that say nothing about the measure.
const GENERIC: [&str; 5] = ["iml", "im", "imls", "level", "intensity"];
/// Measures accepted as column names; the declared measure is always accepted beside them.
const MEASURES: [&str; 10] = ["pgv", "pga", "sa", "psa", "avgsa", "pgd", "cav", "ia", "arias", "si"];
/// Longest unit behind a name, with its underscore, bytes.
const LONGEST_UNIT: usize = 16;
const RATES: [&str; 8] =
    ["maf", "mafe", "afe", "rate", "annual_rate", "lambda", "annual_frequency", "annual_frequency_of_exceedance"];
const RETURN_PERIODS: [&str; 3] = ["return_period", "tr", "rp"];
const PROBABILITIES: [&str; 4] = ["poe", "probability", "probability_of_exceedance", "prob"];

/// Recognises a column name such as `iml`, `im_g`, `pgv_cm_s`, `PGV [cm/s]`, `maf`, `maf_1_yr`, `poe`.
pub(crate) fn column(name: &str, declared_measure: Option<&str>) -> Option<Column> {
    let (plain, unit) = split_unit(name.trim());
    let key = plain.to_ascii_lowercase().replace([' ', '-'], "_");
    let is = |names: &[&str]| names.contains(&key.as_str());
    // Rates per anything but a year and probabilities in per cent are not what the column would be read as.
    if is(&RATES) {
        return unit.is_none_or(is_per_year).then_some(Column::Hazard(SecondColumn::AnnualRate));
    }
    if is(&PROBABILITIES) {
        return unit.is_none().then_some(Column::Hazard(SecondColumn::Probability));
    }
    if is(&RETURN_PERIODS) {
        return unit.is_none_or(is_years).then_some(Column::Hazard(SecondColumn::ReturnPeriod));
    }
    // the years are part of the name, not its unit
    let whole = name.trim().to_ascii_lowercase().replace([' ', '-'], "_");
    if let Some(years) = PROBABILITIES.iter().find_map(|name| years_within(whole.strip_prefix(name)?)) {
        return Some(Column::ProbabilityWithin(years));
    }
    let unit = unit.map(str::to_owned);
    if is(&GENERIC) {
        return Some(Column::Intensity(Declaration { unit, ..Declaration::default() }));
    }
    let is_declared = declared_measure.is_some_and(|declared| same_measure(plain, declared));
    (is(&MEASURES) || key.starts_with("sa(") || key.starts_with("avgsa(") || is_declared)
        .then(|| Column::Intensity(Declaration { measure: Some(plain.to_owned()), unit, ..Declaration::default() }))
}

/// The years of `_in_50_years`, `_50yr` and the like; none of other text, and of no positive number.
fn years_within(text: &str) -> Option<f64> {
    let text = text.strip_prefix('_')?;
    let text = text.strip_prefix("in_").or_else(|| text.strip_prefix("within_")).unwrap_or(text);
    let number = ["years", "year", "yrs", "yr", "y"].iter().find_map(|word| text.strip_suffix(word))?;
    number.trim_end_matches('_').parse().ok().filter(|years: &f64| years.is_finite() && *years > 0.0)
}

/// Reads `IM: PGV [cm/s]`, `unit: cm/s` and `component: RotD50` out of a comment, among other text
/// separated by `;` or `,`.
///
/// Accepted keys: `im`, `imt`, `measure`, `intensity measure`; `unit`, `units`; `component`, `horizontal component`.
/// The component may follow the measure without key, as in `IM: PGV [cm/s], geometric mean (GMRotI50)`. Prose after a
/// key is not a declaration: a measure is one word, and a unit outside brackets must be a known one.
pub(crate) fn comment(text: &str) -> Declaration {
    let mut found = Declaration::default();
    for part in text.split([';', ',']) {
        let Some((key, value)) = part.split_once(':') else {
            if found.measure.is_some() {
                found.note_component(part, false);
            }
            continue;
        };
        match key.trim().to_ascii_lowercase().as_str() {
            "im" | "imt" | "measure" | "intensity measure" => {
                let (measure, unit) = split_unit(value.trim());
                if !measure.is_empty() && !measure.contains(char::is_whitespace) {
                    found.measure = Some(measure.to_owned());
                    found.unit = unit.map(str::to_owned).or(found.unit);
                }
            }
            "unit" | "units" if CurveUnit::parse(value).is_some() => {
                found.unit = Some(value.trim().to_owned());
            }
            "component" | "horizontal component" => found.note_component(value, true),
            _ => {}
        }
    }
    found
}

impl Declaration {
    /// Takes `text` as the definition of the component, or as an unknown one where it must be one that is not
    /// known: a single word where only a definition can stand, and words of which definitions are made. Other
    /// prose is not a declaration.
    fn note_component(&mut self, text: &str, alone: bool) {
        const WORDS: [&str; 8] = ["rot", "geometric", "geomean", "gmean", "larger", "arbitrary", "srss", "envelope"];
        if let Ok(component) = text.parse::<ComponentDefinition>() {
            self.components.push(component);
            return;
        }
        let plain = text.trim().to_lowercase();
        let single = alone && !plain.is_empty() && !plain.contains(char::is_whitespace);
        if single
            || plain.split(|c: char| !c.is_alphanumeric()).any(|word| WORDS.iter().any(|known| word.contains(known)))
        {
            self.doubtful.get_or_insert_with(|| text.trim().to_owned());
        }
    }
}

/// Whether two texts name the same measure: `SA(1)` and `SA(1.0)`; `AvgSA`, which says no periods, and
/// `AvgSA(0.2-2.0)`.
pub(crate) fn same_measure(a: &str, b: &str) -> bool {
    let plain = |text: &str| text.to_ascii_lowercase().replace([' ', '_'], "");
    let (a, b) = (plain(a), plain(b));
    // `SA(1.0)`, or `sa_1s` and `sa_0p5s` as a study calls it
    let period_s = |text: &str| -> Option<f64> {
        let engine = text.strip_prefix("sa(").and_then(|rest| rest.strip_suffix(')')).map(str::to_owned);
        let study = || Some(text.strip_prefix("sa")?.strip_suffix('s')?.replacen('p', ".", 1));
        engine.or_else(study)?.parse().ok()
    };
    // a column `sa_g` is of whatever period the file is taken for
    let any_period = |text: &str| text == "sa" || text == "psa";
    let average = |text: &str| text == "avgsa" || text.starts_with("avgsa(");
    let unsaid = |text: &str| text == "avgsa";
    a == b
        || period_s(&a).is_some_and(|period| period_s(&b) == Some(period) || any_period(&b))
        || any_period(&a) && period_s(&b).is_some()
        || average(&a) && average(&b) && (unsaid(&a) || unsaid(&b))
}

/// Splits `PGV [cm/s]`, `PGV (cm/s)`, `PGV cm/s`, `pgv_cm_s` and `maf_1_yr` into name and unit. Only brackets may
/// hold an unknown unit.
fn split_unit(name: &str) -> (&str, Option<&str>) {
    if let Some((plain, unit)) = name.strip_suffix(']').and_then(|rest| rest.split_once('[')) {
        return (plain.trim_end(), Some(unit.trim()));
    }
    let is_unit = |unit: &str| CurveUnit::parse(unit).is_some() || is_per_year(unit) || is_years(unit);
    if let Some((plain, unit)) = name.strip_suffix(')').and_then(|rest| rest.split_once('('))
        && is_unit(unit)
    {
        return (plain.trim_end(), Some(unit));
    }
    // The longest suffix first: `im_cm_s` is in cm/s, not in "s".
    let mut suffixes =
        name.match_indices([' ', '_']).map(|(at, _)| at).filter(|&at| at > 0 && name.len() - at <= LONGEST_UNIT);
    let at = suffixes.find(|&at| is_unit(&name[at + 1..]));
    at.map_or((name, None), |at| (&name[..at], Some(&name[at + 1..])))
}

fn is_per_year(unit: &str) -> bool {
    matches!(unit, "1/yr" | "1/year" | "1_yr" | "yr-1" | "per_yr" | "per_year")
}

fn is_years(unit: &str) -> bool {
    matches!(unit, "yr" | "year" | "years" | "a")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(measure: Option<&str>, unit: Option<&str>) -> Declaration {
        let (measure, unit) = (measure.map(str::to_owned), unit.map(str::to_owned));
        Declaration { measure, unit, ..Declaration::default() }
    }

    #[test]
    fn column_names() {
        for (name, measure, unit) in [
            ("iml", None, None),
            ("IM_s", None, None),
            ("iml_g", None, Some("g")),
            ("pgv_cm_s", Some("pgv"), Some("cm_s")),
            ("PGV [cm/s]", Some("PGV"), Some("cm/s")),
            ("PGA (g)", Some("PGA"), Some("g")),
            ("PGV cm/s", Some("PGV"), Some("cm/s")),
            ("PGA g", Some("PGA"), Some("g")),
            ("PGA m/s2", Some("PGA"), Some("m/s2")),
            ("SA(1.0) cm s-2", Some("SA(1.0)"), Some("cm s-2")),
            ("SA(1.0)", Some("SA(1.0)"), None),
            ("SA(1.0)_g", Some("SA(1.0)"), Some("g")),
            ("pga_m_s2", Some("pga"), Some("m_s2")),
            ("PGV [furlong/fortnight]", Some("PGV"), Some("furlong/fortnight")),
            ("arias_intensity", Some("arias_intensity"), None),
        ] {
            let expected = (name != "IM_s").then(|| Column::Intensity(named(measure, unit)));
            assert_eq!(column(name, Some("Arias intensity")), expected, "{name}");
        }
        for (name, what) in [
            ("maf", SecondColumn::AnnualRate),
            ("AFE", SecondColumn::AnnualRate),
            ("maf_1_yr", SecondColumn::AnnualRate),
            ("MAF [1/yr]", SecondColumn::AnnualRate),
            ("annual rate", SecondColumn::AnnualRate),
            ("return period years", SecondColumn::ReturnPeriod),
            ("PoE", SecondColumn::Probability),
        ] {
            assert_eq!(column(name, Some("PGV")), Some(Column::Hazard(what)), "{name}");
        }
        for (name, years) in [
            ("PoE in 50 years", 50.0),
            ("poe_50yr", 50.0),
            ("poe_in_50_years", 50.0),
            ("Probability of exceedance in 1 year", 1.0),
        ] {
            assert_eq!(column(name, Some("PGV")), Some(Column::ProbabilityWithin(years)), "{name}");
        }
        for name in [
            "",
            "lon",
            "poe-0.1",
            "poe in years",
            "poe in -5 years",
            "poe in nan years",
            "poe in 5 days",
            "_g",
            "[g]",
            "sigma",
            "maf [1/day]",
            "poe [%]",
        ] {
            assert_eq!(column(name, Some("PGV")), None, "{name}");
            assert_eq!(column(name, None), None, "{name}");
        }
    }

    #[test]
    fn comments() {
        let line = " site: Athens, Greece; longitude 23.7; IM: PGV [cm/s], geometric mean (GMRotI50), rock";
        let gm = vec![ComponentDefinition::GmRotI50];
        assert_eq!(comment(line), Declaration { components: gm, ..named(Some("PGV"), Some("cm/s")) });
        assert_eq!(comment("component: RotD50; see above").components, [ComponentDefinition::RotD50]);
        // Without a measure or a key it is prose.
        assert_eq!(comment("averaged over models, geometric mean, rock"), named(None, None));
        assert_eq!(comment("component: see the report"), named(None, None));
        for (one, other) in [
            ("SA(1)", "sa(1.00)"),
            ("SA(0.5)", "sa_0p5s"),
            ("sa", "SA(2.0)"),
            ("AvgSA", "AvgSA(0.2-2.0)"),
            ("PGV", "pgv"),
        ] {
            assert!(same_measure(one, other) && same_measure(other, one), "{one} {other}");
        }
        for (one, other) in [
            ("SA(1)", "SA(2)"),
            ("AvgSA(0.2-2.0)", "AvgSA(0.1-1.0)"),
            ("SA(1)", "AvgSA"),
            ("SA", "SI"),
            ("SA(1)", "sa_2s"),
        ] {
            assert!(!same_measure(one, other), "{one} {other}");
        }
        assert_eq!(comment("imt: PGA; units: m/s2"), named(Some("PGA"), Some("m/s2")));
        assert_eq!(comment("measure: SA(1.0) [g]"), named(Some("SA(1.0)"), Some("g")));
        assert_eq!(comment("units: see the report"), named(None, None));
        assert_eq!(comment("im: the geometric mean was used"), named(None, None));
        assert_eq!(comment("maf: mean annual frequency [1/yr]"), named(None, None));
    }
}
