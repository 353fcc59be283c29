//! The notation of grids, `start:step:stop`, in exact arithmetic.
//!
//! Adding 0.001 a thousand times does not give 1. Here `0.001:0.001:3` gives the doubles nearest to 0.001, 0.002, …,
//! and `0:1/300:1` those nearest to i/300: the numbers are fractions of integers until one division, which is correctly
//! rounded, gives each value.

use super::GridError;
use crate::reading::commas;

/// Most values that a grid may have.
pub const MOST_GRID_VALUES: usize = 100_000;

/// Integers up to here are exact as doubles, and their quotient is correctly rounded.
const EXACT: i128 = 1 << 53;

fn refuse<T>(message: impl Into<String>, help: impl Into<String>) -> Result<T, GridError> {
    Err(GridError { message: message.into(), help: help.into() })
}

/// The values of `text`: a number, a fraction, or `start:step:stop`, both ends included.
pub(crate) fn values(text: &str) -> Result<Vec<f64>, GridError> {
    let parts: Vec<&str> = text.split(':').map(str::trim).collect();
    match parts[..] {
        [number] if !number.contains('/') => match number.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(vec![value]),
            _ => not_a_number(number),
        },
        [fraction] => {
            let value = Fraction::parse(fraction)?;
            Ok(vec![value.numerator as f64 / value.denominator as f64])
        }
        [start, step, stop] => range(start, step, stop),
        _ => refuse(format!("\"{text}\" is not a grid"), "write a number, or \"start:step:stop\" as in \"0:1/300:1\""),
    }
}

/// The notation of `count` values from `start` to `stop` in equal steps.
pub(crate) fn equal_steps(start: f64, stop: f64, count: i64) -> Result<String, GridError> {
    // A double prints as the shortest decimal that gives it back: the one in the study file.
    let (from, to) = (Fraction::parse(&start.to_string())?, Fraction::parse(&stop.to_string())?);
    let step = (|| {
        let numerator =
            (to.numerator.checked_mul(from.denominator)?).checked_sub(from.numerator.checked_mul(to.denominator)?)?;
        let denominator = from.denominator.checked_mul(to.denominator)?.checked_mul(i128::from(count - 1))?;
        Some(Fraction::reduced(numerator, denominator))
    })();
    match step {
        Some(step) if step.denominator == 1 => Ok(format!("{start}:{}:{stop}", step.numerator)),
        Some(step) => Ok(format!("{start}:{}/{}:{stop}", step.numerator, step.denominator)),
        None => too_many_digits(&format!("{start} to {stop}")),
    }
}

fn range(start: &str, step: &str, stop: &str) -> Result<Vec<f64>, GridError> {
    let text = format!("{start}:{step}:{stop}");
    let fractions = [Fraction::parse(start)?, Fraction::parse(step)?, Fraction::parse(stop)?];
    let Some((denominator, [first, step_size, last])) = common_denominator(fractions) else {
        return too_many_digits(&text);
    };
    if step_size <= 0 {
        return refuse(format!("\"{text}\" has the step {step}"), "the step of \"start:step:stop\" must be above zero");
    }
    if last < first {
        return refuse(
            format!("\"{text}\" stops below its start"),
            "write \"start:step:stop\" with stop at or above start",
        );
    }
    let steps = (last - first) / step_size;
    if (last - first) % step_size != 0 {
        return refuse(
            format!(
                "\"{text}\" misses its stop: after {steps} steps it is at {}",
                (first + steps * step_size) as f64 / denominator as f64
            ),
            "stop must lie a whole number of steps above start; write thirds as 1/3, not 0.333",
        );
    }
    let count = usize::try_from(steps).unwrap_or(usize::MAX);
    if count >= MOST_GRID_VALUES {
        return refuse(
            format!("\"{text}\" has {} values", steps + 1),
            format!("a grid has at most {MOST_GRID_VALUES} values: take a larger step"),
        );
    }
    Ok((0..=steps).map(|i| (first + i * step_size) as f64 / denominator as f64).collect())
}

fn not_a_number<T>(text: &str) -> Result<T, GridError> {
    let help = commas(text)
        .unwrap_or_else(|| "write a decimal such as 0.025 or 2.5e-2, or a fraction such as 1/300".to_owned());
    refuse(format!("\"{text}\" is not a number"), help)
}

fn too_many_digits<T>(text: &str) -> Result<T, GridError> {
    refuse(
        format!("\"{text}\" has too many digits for an exact grid"),
        "use at most 15 digits from the first of the largest number to the last of the smallest",
    )
}

/// The three fractions over their common denominator, all exact as doubles.
fn common_denominator(fractions: [Fraction; 3]) -> Option<(i128, [i128; 3])> {
    let mut denominator = 1_i128;
    for fraction in fractions {
        let factor = fraction.denominator / greatest_common_divisor(denominator, fraction.denominator);
        denominator = denominator.checked_mul(factor)?;
    }
    let mut numerators = [0; 3];
    for (numerator, fraction) in numerators.iter_mut().zip(fractions) {
        *numerator = fraction.numerator.checked_mul(denominator / fraction.denominator)?;
    }
    let exact = denominator <= EXACT && numerators.iter().all(|n| n.abs() <= EXACT);
    exact.then_some((denominator, numerators))
}

fn greatest_common_divisor(a: i128, b: i128) -> i128 {
    let (mut a, mut b) = (a.abs(), b.abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

/// A fraction in lowest terms with a denominator above zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Fraction {
    numerator: i128,
    denominator: i128,
}

impl Fraction {
    fn reduced(numerator: i128, denominator: i128) -> Self {
        let divisor = greatest_common_divisor(numerator, denominator).max(1) * denominator.signum();
        Self { numerator: numerator / divisor, denominator: denominator / divisor }
    }

    /// Parses a decimal, or the fraction of two of them.
    fn parse(text: &str) -> Result<Self, GridError> {
        let (above, below) = text.split_once('/').unwrap_or((text, "1"));
        let (above, below) = (Self::decimal(above.trim())?, Self::decimal(below.trim())?);
        if below.numerator == 0 {
            return refuse(format!("\"{text}\" divides by zero"), "write a fraction such as 1/300");
        }
        let numerator = above.numerator.checked_mul(below.denominator);
        let denominator = above.denominator.checked_mul(below.numerator);
        match (numerator, denominator) {
            (Some(numerator), Some(denominator)) => {
                let fraction = Self::reduced(numerator, denominator);
                if fraction.numerator.abs() <= EXACT && fraction.denominator <= EXACT {
                    Ok(fraction)
                } else {
                    too_many_digits(text)
                }
            }
            _ => too_many_digits(text),
        }
    }

    /// Parses a decimal such as `-12.50e-3`.
    fn decimal(text: &str) -> Result<Self, GridError> {
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => match exponent.parse::<i32>() {
                Ok(exponent) => (mantissa, exponent),
                Err(_) => return not_a_number(text),
            },
            None => (text, 0),
        };
        let unsigned = mantissa.strip_prefix(['-', '+']).unwrap_or(mantissa);
        let (whole, decimals) = unsigned.split_once('.').unwrap_or((unsigned, ""));
        let digits = format!("{whole}{decimals}");
        if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
            return not_a_number(text);
        }
        let decimals = decimals.trim_end_matches('0');
        let magnitude = format!("0{whole}{decimals}").parse::<i128>().ok();
        let scale = i32::try_from(decimals.len()).ok().and_then(|places| exponent.checked_sub(places));
        let power = scale.and_then(|scale| 10_i128.checked_pow(scale.unsigned_abs()));
        let (Some(magnitude), Some(scale), Some(power)) = (magnitude, scale, power) else {
            return too_many_digits(text);
        };
        let signed = if mantissa.starts_with('-') { -magnitude } else { magnitude };
        if scale < 0 {
            Ok(Self::reduced(signed, power))
        } else {
            signed.checked_mul(power).map_or_else(|| too_many_digits(text), |numerator| Ok(Self::reduced(numerator, 1)))
        }
    }
}
