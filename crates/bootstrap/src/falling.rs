//! From where to where a value lies at which a rate that falls with it meets a target.

/// What each record contributes at each of `values`, ascending, made to fall with the value: of every record the
/// least-squares fit that never rises, with a weight of each value as wide as it stands for in ln value
/// (pool-adjacent-violators).
///
/// A wider structure overturns less often, but for single records it may overturn again. Limits of the mean that are
/// followed along the value rise and fall with such noise, and where they last meet a target is too high: bands of the
/// value held 95 to 97 % in place of 90. The mean of contributions that fall meets it once, and each limit scatters as
/// a mean of independent records does.
///
/// - `contributions`: `[value][record]`, in the unit of a rate.
///
/// # Source
/// R. E. Barlow, D. J. Bartholomew, J. M. Bremner, H. D. Brunk, Statistical Inference under Order Restrictions, 1972.
pub fn falling(values: &[f64], contributions: &[&[f64]]) -> Vec<Vec<f64>> {
    let mut fallen: Vec<Vec<f64>> = contributions.iter().map(|records| records.to_vec()).collect();
    let last = values.len().saturating_sub(1);
    // half of the way to either neighbour
    let width = |place: usize| (values[(place + 1).min(last)] / values[place.saturating_sub(1)]).ln();
    let widths: Vec<f64> = if last == 0 { vec![1.0; values.len()] } else { (0..=last).map(width).collect() };
    let records = contributions.first().map_or(0, |records| records.len());
    // mean, weight and values of each block
    let mut blocks: Vec<(f64, f64, usize)> = Vec::with_capacity(values.len());
    for record in 0..records {
        blocks.clear();
        for (of_value, &weight) in contributions.iter().zip(&widths) {
            let mut block = (of_value[record], weight, 1);
            while let Some(before) = blocks.pop_if(|before| before.0 < block.0) {
                let weight = before.1 + block.1;
                block = ((before.0 * before.1 + block.0 * block.1) / weight, weight, before.2 + block.2);
            }
            blocks.push(block);
        }
        let means = blocks.iter().flat_map(|(mean, _, many)| std::iter::repeat_n(*mean, *many));
        fallen.iter_mut().zip(means).for_each(|(of_value, mean)| of_value[record] = mean);
    }
    fallen
}

/// The value above which `rates` stay at or below `target`, on straight lines in logarithms between `values`,
/// ascending; the first of these where they always do, infinite where the last is above.
pub fn crossing(values: &[f64], rates: impl DoubleEndedIterator<Item = f64> + ExactSizeIterator, target: f64) -> f64 {
    let mut after: Option<(f64, f64)> = None;
    for (&value, rate) in values.iter().zip(rates).rev() {
        if rate > target {
            let Some((next, below)) = after else { return f64::INFINITY };
            // a rate of 0 has no logarithm: as good as a line down to it
            let share = if below > 0.0 { (rate / target).ln() / (rate / below).ln() } else { 1.0 };
            return value * (next / value).powf(share);
        }
        after = Some((value, rate));
    }
    values.first().copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    // 3, 1, 2, 0 of values a factor of 2 apart, whose ends weigh half: 1 and 2 become their mean
    #[test]
    fn what_rises_is_pooled() {
        let contributions: [&[f64]; 4] = [&[3.0, 0.0], &[1.0, 0.0], &[2.0, 0.0], &[0.0, 3.0]];
        let fallen = falling(&[1.0, 2.0, 4.0, 8.0], &contributions);
        let of = |record: usize| fallen.iter().map(|of_value| of_value[record]).collect::<Vec<_>>();
        assert_eq!(of(0), [3.0, 1.5, 1.5, 0.0]);
        // one record that overturns at the last alone: half of two steps of six halves
        assert!(of(1).iter().all(|rate| (rate - 0.5).abs() < 1e-12), "{:?}", of(1));
    }

    #[test]
    fn what_falls_stays_and_one_value_too() {
        let contributions: [&[f64]; 3] = [&[3.0], &[3.0], &[0.5]];
        assert_eq!(falling(&[1.0, 3.0, 4.0], &contributions), [[3.0], [3.0], [0.5]]);
        assert_eq!(falling(&[1.0], &contributions[..1]), [[3.0]]);
    }

    // a rate of 8/v³ is 1 at 2, wherever it is known
    #[test]
    fn a_power_is_crossed_exactly() {
        let values = [1.0, 1.5, 3.0, 7.0];
        let rates = values.map(|value: f64| 8.0 / value.powi(3));
        let at = |target: f64| crossing(&values, rates.iter().copied(), target);
        assert!((at(1.0) - 2.0).abs() < 1e-12);
        assert_eq!((at(9.0), at(0.01)), (1.0, f64::INFINITY));
        // the last of several
        let wave = [2.0, 0.5, 2.0, 0.0];
        assert_eq!(crossing(&values, wave.into_iter(), 1.0), 7.0);
    }
}
