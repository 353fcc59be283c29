//! What the factors of levels with records of their own are beside the ones that the records' intensities ask for.

use uplift_motion::IntensityMeasure;

/// A factor so many times level over intensity, or one over that, is of another unit rather than of other components or
/// of another definition of the measure.
const FAR: f64 = 3.0;

/// Factors over the ones that bring each record to its level, `[level, record]`; NaN where a record does not belong to
/// a level.
///
/// - `factors`: `[record, level]`.
/// - `levels`: in the unit of `measure`.
/// - `intensities`: of the unscaled records, in the same, `[record]`.
pub fn relative_factors(factors: &[f64], measure: IntensityMeasure, levels: &[f64], intensities: &[f64]) -> Vec<f64> {
    let amplitude = |value: f64| measure.amplitude(value);
    let of_cell = |(level, x): (usize, &f64), record: usize| {
        factors[record * levels.len() + level] / (amplitude(*x) / amplitude(intensities[record]))
    };
    levels.iter().enumerate().flat_map(|at| (0..intensities.len()).map(move |record| of_cell(at, record))).collect()
}

/// Factors that no definition of the measure explains, in words; none where there are none.
///
/// - `relative`: those of [`relative_factors`].
/// - `names`: of the records.
pub fn far_factors(
    relative: &[f64],
    names: &[String],
    (measure, levels): (IntensityMeasure, &[f64]),
) -> Option<String> {
    let times = |factor: f64| factor.max(1.0 / factor);
    let known = relative.iter().enumerate().filter(|(_, factor)| factor.is_finite());
    let far = known.clone().filter(|(_, factor)| times(**factor) > FAR);
    let (cell, factor) = far.clone().max_by(|a, b| times(*a.1).total_cmp(&times(*b.1)))?;
    let (level, record) = (levels[cell / names.len()], &names[cell % names.len()]);
    let (label, unit) = (measure.label(), measure.unit());
    Some(format!(
        "{} of {} factors of records.at_level are more than {FAR} times off the {label} of their level over that of \
         the record: {record} at {level} {unit} is {:.0} times too {}",
        far.count(),
        known.count(),
        times(*factor),
        if *factor > 1.0 { "large" } else { "small" }
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_of_another_unit_are_reported_by_the_furthest() {
        let (measure, levels, names) = (IntensityMeasure::Pgv, [1.0, 10.0], ["A".to_owned(), "B".to_owned()]);
        // records of 2 and 5 cm/s: 0.5 and 5 for the first; the second at 10 cm/s alone, by 100 times too little
        let relative = relative_factors(&[0.5, 7.0, f64::NAN, 0.02], measure, &levels, &[2.0, 5.0]);
        assert_eq!((relative[0], relative[2], relative[3]), (1.0, 1.4, 0.01));
        assert!(relative[1].is_nan());
        let told = far_factors(&relative, &names, (measure, &levels)).unwrap_or_default();
        assert!(
            told.starts_with("1 of 3 factors") && told.ends_with(": B at 10 cm/s is 100 times too small"),
            "{told}"
        );
        assert_eq!(far_factors(&relative[..3], &names, (measure, &levels)), None);
        // nine times the Arias intensity is three times the motion
        let squared = relative_factors(&[3.0], IntensityMeasure::Arias, &[9.0], &[1.0]);
        assert_eq!(squared, [1.0]);
    }
}
