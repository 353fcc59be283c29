//! The section `[uncertainty]`: quantities of a structure that are not known exactly.

use uplift_plausible::{Range, USUAL_VARIATION, after_value};
use uplift_structure::{NO_CAPACITY, NO_CAPACITY_REASON, UncertainQuantity};
use uplift_uncertainty::{Distribution, Family, GaussianCopula, RandomVector, Sampling, UncertaintyError};

use serde_json::{Value, json};

use self::written::{Scatter, Written};
use super::top;
use crate::keys::{ANY, Choice, Integer, Key, Number, SectionKeys, Shape, Special, choice, integer, number, special};
use crate::reading::{Field, Origin, Rule, Section};

mod written;

pub(crate) const KEYS: SectionKeys = SectionKeys::new("uncertainty", &[&KIND, &SAMPLING, &SAMPLES, &DRAWS, &SEED]);
const KIND: Key<Choice<UncertaintyKind>> =
    choice("kind", &UncertaintyKind::ALL, UncertaintyKind::key).with_default(UncertaintyKind::Epistemic).meaning(
        "`\"epistemic\"`, one structure of which it is not known which: all records shake the same `samples` \
         structures, and the spectrum has a band over them; `\"aleatory\"`, another structure in every earthquake: \
         each record shakes `draws` structures of its own",
    );
const SAMPLING: Key<Choice<Sampling>> = choice("sampling", &Sampling::ALL, Sampling::key)
    .with_default(Sampling::Sobol)
    .meaning("`\"sobol\"`, scrambled Sobol' points, or `\"latin-hypercube\"`");
const SAMPLES: Key<Integer> = integer("samples", 8, 4096)
    .with_default(64)
    .meaning("structures of an epistemic study, each as many analyses again")
    .note("a power of two for `\"sobol\"`");
const DRAWS: Key<Integer> = integer("draws", 1, 100)
    .with_default(10)
    .meaning("structures of each record in an aleatory study, each as many analyses again");
const SEED: Key<Integer> = top::seed(1).meaning("where the random numbers begin");

/// The keys of any quantity, shown with one.
pub(crate) const QUANTITY_KEYS: SectionKeys = SectionKeys::new(
    "uncertainty.restitution",
    &[&DISTRIBUTION, &COEFFICIENT_OF_VARIATION, &MEAN, &PERCENTILES, &LOWER, &UPPER, &MODE],
);
const DISTRIBUTION: Key<Choice<Family>> =
    choice("distribution", &Family::ALL, Family::key).meaning("how the quantity is distributed");
const COEFFICIENT_OF_VARIATION: Key<Number> = number("coefficient_of_variation", "", ANY)
    .without_default("none")
    .meaning("standard deviation over mean; 0 is a quantity that is known");
const MEAN: Key<Number> =
    number("mean", "", ANY).without_default("that of the structure as described").meaning("the mean beside it");
const PERCENTILES: Key<Special> = special("percentiles", two_percentiles)
    .without_default("none")
    .meaning("two percentages with their values in place of these, `[[5, 0.9], [95, 0.97]]`");
const LOWER: Key<Number> = number("lower", "", ANY)
    .without_default("none")
    .meaning("lower limit of a uniform or triangular one in place of these");
const UPPER: Key<Number> = number("upper", "", ANY).without_default("none").meaning("upper limit of such a one");
const MODE: Key<Number> =
    number("mode", "", ANY).without_default("the middle").meaning("of a triangular one with limits");

pub(crate) const CORRELATION_KEYS: SectionKeys =
    SectionKeys::new("uncertainty.correlation", &[&BETWEEN, &COEFFICIENT]).shape(Shape::TableOrList);
const BETWEEN: Key<Special> =
    special("between", two_quantities).meaning("two quantities that go together, `[\"strength\", \"restitution\"]`");
const COEFFICIENT: Key<Number> = number("coefficient", "", Rule::Between(-1.0, 1.0, "above -1 and below 1"))
    .meaning("of the normal quantities behind them (Gaussian copula)");

const PERCENTAGE: Rule = Rule::Between(0.0, 100.0, "above 0 and below 100");

/// A mean that is so many times what the structure has, or that part of it, is asked about.
const FAR: f64 = 5.0;

/// What the scatter of a quantity stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UncertaintyKind {
    /// One structure, of which it is not known which: every structure that it may be has a risk, and these make a band.
    Epistemic,
    /// A structure that is another one in every earthquake, or one of many: each record shakes its own, and there is
    /// one risk.
    Aleatory,
}

impl UncertaintyKind {
    /// Both kinds.
    pub const ALL: [Self; 2] = [Self::Epistemic, Self::Aleatory];

    /// Its word.
    pub fn key(self) -> &'static str {
        match self {
            Self::Epistemic => "epistemic",
            Self::Aleatory => "aleatory",
        }
    }
}

/// Quantities that are not known exactly, and how they are sampled.
#[derive(Debug, Clone, PartialEq)]
pub struct Uncertainty {
    /// What their scatter stands for.
    pub kind: UncertaintyKind,
    /// How they are sampled.
    pub sampling: Sampling,
    /// Rows of each of the two samples of an epistemic analysis.
    pub samples: usize,
    /// Structures that each record draws in an aleatory one.
    pub draws: usize,
    /// Where the random numbers begin.
    pub seed: u64,
    /// The quantities, in the order of [`UncertainQuantity::ALL`].
    pub quantities: Vec<UncertainQuantity>,
    /// Their distributions, in the same order, and how they go together.
    pub vector: RandomVector,
    /// The distributions as they were written, in the same order.
    pub(crate) written: Vec<Written>,
    /// The correlations as they were written: two positions among the quantities, and the coefficient.
    pub(crate) correlations: Vec<(usize, usize, f64)>,
}

impl Uncertainty {
    /// Whether nothing scatters after all: every coefficient of variation is 0.
    pub fn is_known(&self) -> bool {
        self.vector.distributions().iter().all(|of| of.constant().is_some())
    }
}

/// The value that a quantity has before it is uncertain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Described {
    /// This one: the mean where none is given.
    As(f64),
    /// This one, which the file does not give: the mean where none is given, and nothing to measure another by.
    Assumed(f64),
    /// Not told: a mean is needed.
    Open,
    /// Cannot be reported for other mistakes.
    Mistaken,
    /// A displacement capacity where the force does not fall: there is none.
    NoCapacity,
}

/// A number that can be, but is probably meant otherwise.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Doubt {
    /// `uncertainty.strength.coefficient_of_variation`.
    pub(crate) key: String,
    pub(crate) origin: Origin,
    /// ` is 6; usual is ...`, to be read after the key.
    pub(crate) what: String,
}

/// Reads the section; none where there is none, or where it is wrong. What is doubtful goes to `doubts`.
pub(crate) fn read(
    mut section: Section<'_>,
    described: &dyn Fn(UncertainQuantity) -> Described,
    doubts: &mut Vec<Doubt>,
) -> Option<Uncertainty> {
    if !section.is_present() {
        return None;
    }
    let kind = section.read(&KIND);
    let sampling = section.read(&SAMPLING);
    let samples = section.read(&SAMPLES);
    let draws = section.read(&DRAWS);
    let seed = section.read(&SEED);
    let (foreign, other, own) = match kind {
        Some(UncertaintyKind::Aleatory) => {
            (SAMPLES.name, UncertaintyKind::Epistemic, "draws, the structures of each record")
        }
        _ => (DRAWS.name, UncertaintyKind::Aleatory, "samples, the rows of each sample"),
    };
    if kind.is_some()
        && let Some(field) = section.field(foreign)
    {
        let message = format!("{foreign} belongs to kind = \"{}\"", other.key());
        field.mistake(message, format!("leave it out, or give {own}"));
    }
    if let (Some(Sampling::Sobol), Some(samples)) = (sampling, samples)
        && kind != Some(UncertaintyKind::Aleatory)
        && !samples.is_power_of_two()
    {
        let message = format!("Sobol' points fill a range evenly only in powers of two, and {samples} is none");
        let (below, above) = (samples.next_power_of_two() / 2, samples.next_power_of_two());
        section.mistake(SAMPLES.name, message, format!("write {below} or {above}, or sampling = \"latin-hypercube\""));
    }
    let (mut known, mut mistaken) = (Vec::new(), Vec::new());
    let mut is_whole = true;
    for quantity in UncertainQuantity::ALL {
        let of_quantity = section.section(quantity.key());
        if !of_quantity.is_present() {
            if section.field(quantity.key()).is_some() {
                mistaken.push(quantity);
            }
            continue;
        }
        match read_quantity(of_quantity, quantity, described(quantity), doubts) {
            Some(distribution) => known.push((quantity, distribution)),
            None => mistaken.push(quantity),
        }
    }
    is_whole &= mistaken.is_empty();
    if known.is_empty() && is_whole {
        let keys = UncertainQuantity::ALL.map(UncertainQuantity::key).join("], [uncertainty.");
        section.mistake("", "nothing here is uncertain", format!("give one or more of [uncertainty.{keys}]"));
        is_whole = false;
    }
    let (quantities, known): (Vec<_>, Vec<_>) = known.into_iter().unzip();
    let (distributions, written): (Vec<_>, Vec<_>) = known.into_iter().unzip();
    let correlation = section.field("correlation");
    let pairs = correlation.as_ref().map(|field| read_pairs(field, &quantities, &mistaken));
    section.finish();
    let pairs = match pairs {
        Some(pairs) => pairs?,
        None => Vec::new(),
    };
    if !is_whole {
        return None;
    }
    let copula = match GaussianCopula::new(quantities.len(), &pairs) {
        Ok(copula) => copula,
        Err(error) => {
            let field = correlation?;
            return field
                .refuse(told(&error, &quantities), "each coefficient is above -1 and below 1; 0 is independent");
        }
    };
    let count = |number: u64| usize::try_from(number).unwrap_or(usize::MAX);
    Some(Uncertainty {
        kind: kind?,
        sampling: sampling?,
        samples: count(samples?),
        draws: count(draws?),
        seed: seed?,
        quantities,
        vector: RandomVector::new(distributions, copula).ok()?,
        written,
        correlations: pairs,
    })
}

/// What is wrong with correlations, quantities by their names.
fn told(error: &UncertaintyError, quantities: &[UncertainQuantity]) -> String {
    match error {
        UncertaintyError::Pair { first, second } => {
            let name = |place: &usize| quantities.get(*place).map_or("?", |quantity| quantity.key());
            format!(
                "the correlation of {} with {}: name two different quantities, each pair once",
                name(first),
                name(second)
            )
        }
        other => other.to_string(),
    }
}

/// Pairs of quantities, by their positions among the uncertain ones, with the coefficient of each; those that are
/// `mistaken` have been reported.
fn read_pairs(
    field: &Field<'_>,
    quantities: &[UncertainQuantity],
    mistaken: &[UncertainQuantity],
) -> Option<Vec<(usize, usize, f64)>> {
    let choices = UncertainQuantity::ALL.map(|quantity| (quantity.key(), quantity));
    let read = |item: Field<'_>| -> Option<(usize, usize, f64)> {
        let mut section = item.section();
        if !section.is_present() {
            return None;
        }
        let help = "which two go together: [\"strength\", \"capacity_m\"]";
        let between = section.needed(&BETWEEN, "a correlation needs `between`", help);
        let coefficient = section.needed(&COEFFICIENT, "a correlation needs `coefficient`", "how much: 0.5");
        section.finish();
        let (between, coefficient) = (between?, coefficient?);
        let coefficient = COEFFICIENT.read(&coefficient);
        let names = between.items();
        let [first, second] = &names[..] else {
            return between.refuse(format!("{} quantities", names.len()), "a correlation is between two");
        };
        let (first, second) = (first.choice(&choices), second.choice(&choices));
        let is_missing = |quantity: &UncertainQuantity| !quantities.contains(quantity) && !mistaken.contains(quantity);
        let mut missing: Vec<&str> =
            [first, second].into_iter().flatten().filter(is_missing).map(UncertainQuantity::key).collect();
        missing.dedup();
        if !missing.is_empty() {
            let are = if missing.len() > 1 { "are" } else { "is" };
            let help = format!("give [uncertainty.{}], or leave the correlation out", missing.join("], [uncertainty."));
            between.mistake(format!("{} {are} not uncertain", missing.join(" and ")), help);
        }
        let place = |quantity| quantities.iter().position(|known| *known == quantity);
        Some((place(first?)?, place(second?)?, coefficient?))
    };
    let items = field.few_items()?;
    let count = items.len();
    let pairs: Vec<_> = items.into_iter().filter_map(read).collect();
    (pairs.len() == count).then_some(pairs)
}

/// How a quantity is distributed.
fn read_family(section: &mut Section<'_>) -> Option<Family> {
    let words = Family::ALL.map(Family::key).join("\", \"");
    let help = format!("write distribution = and one of \"{words}\"");
    section.read_needed(&DISTRIBUTION, "how is it distributed?", help)
}

/// One quantity: its mean and coefficient of variation, two percentiles, or its limits.
fn read_quantity(
    mut section: Section<'_>,
    quantity: UncertainQuantity,
    described: Described,
    doubts: &mut Vec<Doubt>,
) -> Option<(Distribution, Written)> {
    let family = read_family(&mut section);
    let (usual, asked_before) = (quantity.usual(), doubts.len());
    let mut number = |key: &Key<Number>, usual: Range| {
        let field = section.given(key)?;
        let value = field.number(usual.unit, ANY);
        doubts.extend(value.and_then(|value| doubt(&field, value, usual)));
        Some(value)
    };
    let (mean, variation) = (number(&MEAN, usual), number(&COEFFICIENT_OF_VARIATION, USUAL_VARIATION));
    let (lower, mode, upper) = (number(&LOWER, usual), number(&MODE, usual), number(&UPPER, usual));
    let percentiles = section.given(&PERCENTILES).map(|field| read_percentiles(&field, usual, doubts));
    if let (Some(Some(mean)), Described::As(own)) = (mean, described) {
        doubts.extend(section.given(&MEAN).and_then(|field| far_off(&field, mean, own, usual.unit)));
    }
    if described == Described::NoCapacity {
        section.mistake("", format!("{NO_CAPACITY}: {NO_CAPACITY_REASON}"), "leave it out");
        section.finish();
        return None;
    }
    let by_limits = lower.is_some() || mode.is_some() || upper.is_some();
    let by_mean = mean.is_some() || variation.is_some();
    let ways = usize::from(by_limits) + usize::from(by_mean) + usize::from(percentiles.is_some());
    if ways != 1 {
        let message = if ways == 0 { "nothing says how uncertain it is" } else { "its scatter is given twice" };
        let help = "give coefficient_of_variation (and mean), or percentiles, or lower and upper (and mode)";
        section.mistake("", message, help);
        section.finish();
        return None;
    }
    if by_mean && variation.is_none() {
        let help = "its standard deviation over its mean: 0.1 is 10 %";
        section.mistake(COEFFICIENT_OF_VARIATION.name, "a mean needs a coefficient of variation", help);
    }
    if by_limits && !(lower.is_some() && upper.is_some()) {
        section.mistake("", "one of its limits is missing", "give both lower and upper");
    }
    if by_mean && mean.is_none() && described == Described::Open {
        let help = format!("give mean, or {} of the structure", quantity.key());
        section.mistake(MEAN.name, "its mean is missing", help);
    }
    let bounded = matches!(family, Some(Family::Uniform | Family::Triangular));
    if by_limits && family.is_some() && !bounded {
        section.mistake("", "only a uniform and a triangular distribution have limits", "give its mean or percentiles");
    }
    if mode.is_some() && family == Some(Family::Uniform) {
        section.mistake(MODE.name, "a uniform distribution has no mode", "leave it out, or write \"triangular\"");
    }
    let range = [quantity.range().least, quantity.range().most];
    let distribution = |family: Family| -> Option<Result<Distribution, UncertaintyError>> {
        if let Some(percentiles) = percentiles {
            return Some(Distribution::from_percentiles(family, percentiles?, range));
        }
        if by_limits {
            let limits = [lower??, upper??];
            return match (family, mode) {
                (Family::Uniform, None) => Some(Distribution::from_limits(limits, None, range)),
                (Family::Triangular, mode) => {
                    let mode = mode.unwrap_or(Some(0.5 * (limits[0] + limits[1])));
                    Some(Distribution::from_limits(limits, Some(mode?), range))
                }
                _ => None,
            };
        }
        let mean = match (mean, described) {
            (Some(mean), _) => mean?,
            (None, Described::As(value) | Described::Assumed(value)) => value,
            (None, _) => return None,
        };
        Some(Distribution::from_mean(family, (mean, variation??), range))
    };
    let found = family.and_then(distribution);
    let found = match found? {
        Ok(distribution) => {
            let scatter = match percentiles {
                Some(percentiles) => Scatter::Percentiles { percentiles: percentiles? },
                None if by_limits => Scatter::Limits { lower: lower??, upper: upper??, mode: mode.flatten() },
                None => Scatter::Mean { mean: mean.flatten(), coefficient_of_variation: variation?? },
            };
            Some((distribution, Written { family: family?, scatter }))
        }
        Err(error) => {
            // a number that is probably in another unit is why, most likely
            let doubtful = &doubts[asked_before..];
            let refused = format!("{} cannot be distributed so: {error}", quantity.name());
            let message = doubtful.iter().fold(refused, |told, doubt| format!("{told}; {}{}", doubt.key, doubt.what));
            let (key, help) = match error {
                UncertaintyError::Limits { lower, upper, .. } if lower < upper => {
                    (MODE.name, "without a mode it is the middle of the limits")
                }
                UncertaintyError::Limits { .. } => ("", "give the lower limit as lower, and the upper one as upper"),
                _ => ("", quantity.range().hint),
            };
            section.refuse(key, message, help)
        }
    };
    section.finish();
    found
}

/// What is to be asked about the `value` of a field that is not what is usual.
fn doubt(field: &Field<'_>, value: f64, usual: Range) -> Option<Doubt> {
    let found = usual.unlikely("", value)?;
    Some(Doubt { key: field.key.clone(), origin: field.node.origin.clone(), what: found.to_string() })
}

/// What is to be asked about a `mean` that is far from the value that the structure has as described.
fn far_off(field: &Field<'_>, mean: f64, own: f64, unit: &str) -> Option<Doubt> {
    let times = if mean.abs() > own { mean.abs() / own } else { own / mean.abs() };
    // a mean of 0 is refused, and a value of 0 has no factor
    if !(times.is_finite() && times > FAR) {
        return None;
    }
    let unit = after_value(unit);
    // what is computed of a structure has more digits than anyone reads
    let own_shown = format!("{own:.3e}").parse::<f64>().unwrap_or(own);
    let far = if mean.abs() > own { format!("{times:.0} times") } else { format!("a {times:.0}th of") };
    Some(Doubt {
        key: field.key.clone(),
        origin: field.node.origin.clone(),
        what: format!(
            " is {mean}{unit}, {far} the {own_shown}{unit} that the structure has as described; without mean it is that"
        ),
    })
}

/// Two percentiles, `[[5, 0.08], [95, 0.12]]`.
fn read_percentiles(field: &Field<'_>, usual: Range, doubts: &mut Vec<Doubt>) -> Option<[(f64, f64); 2]> {
    let help = "write two percentages with their values: [[5, 0.08], [95, 0.12]]";
    let mut pair = |item: &Field<'_>| {
        let numbers = item.items();
        let [percentage, value] = &numbers[..] else {
            return item.refuse("a percentile is a percentage and a value", help);
        };
        let percentage = percentage.number("%", PERCENTAGE);
        let of_percentage = value.number(usual.unit, ANY);
        doubts.extend(of_percentage.and_then(|number| doubt(value, number, usual)));
        Some((percentage?, of_percentage?))
    };
    let items = field.items();
    let [first, second] = &items[..] else {
        return field.refuse(format!("{} percentiles", items.len()), help);
    };
    let (first, second) = (pair(first)?, pair(second)?);
    if first.0 < 1.0 && second.0 < 1.0 {
        doubts.push(Doubt {
            key: field.key.clone(),
            origin: field.node.origin.clone(),
            what: format!(" are those of {} and {} %; were shares meant? 5 % is 5, and 95 % is 95", first.0, second.0),
        });
    }
    Some([first, second])
}

/// Two percentiles as a JSON Schema.
fn two_percentiles() -> Value {
    let pair = json!({ "type": "array", "items": [PERCENTAGE.schema(), ANY.schema()], "minItems": 2, "maxItems": 2 });
    json!({ "type": "array", "items": pair, "minItems": 2, "maxItems": 2 })
}

/// Two quantities as a JSON Schema.
fn two_quantities() -> Value {
    let quantity = json!({ "type": "string", "enum": UncertainQuantity::ALL.map(UncertainQuantity::key) });
    json!({ "type": "array", "items": quantity, "minItems": 2, "maxItems": 2 })
}
