//! Roots of continuous functions, to the last digit.

/// The place between `low` and `high` where `f` changes its sign, by bisection until the two are neighbours or 200
/// halvings are done; `f(low)` and `f(high)` must not have the same sign.
pub(crate) fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let sign = f(low) <= 0.0;
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if (f(middle) <= 0.0) == sign {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// The least value of a function that falls, then rises between `low` and `high`: its place, by golden sections.
pub(crate) fn minimum(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let share = 0.5 * (3.0 - 5.0_f64.sqrt());
    let (mut left, mut right) = (low + share * (high - low), high - share * (high - low));
    let (mut at_left, mut at_right) = (f(left), f(right));
    for _ in 0..100 {
        if at_left < at_right {
            (high, right, at_right) = (right, left, at_left);
            left = low + share * (high - low);
            at_left = f(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = high - share * (high - low);
            at_right = f(right);
        }
    }
    0.5 * (low + high)
}
