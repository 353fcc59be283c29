//! Bands that hold whole spectra.

/// Limits of a simultaneous band, m, `[strength]` of (lower, upper): at least `confidence` of the replicate
/// spectra lie wholly within.
///
/// - `replicates_m`: the ordinates, `[strength][replicate]`, in the same order of replicates at each strength.
///
/// Each spectrum has a depth: over all strengths, the least number of replicates that are at most, or at least, as
/// large as it is. The band runs between the k-th smallest and the k-th largest ordinate at each strength, with the
/// largest k that leaves the asked share of the spectra no shallower than k. So the limits are as rare at each strength
/// as at any other, and no scale enters.
pub fn simultaneous_bands(replicates_m: &[Vec<f64>], confidence: f64) -> Vec<(f64, f64)> {
    let count = replicates_m.first().map_or(0, Vec::len);
    if count == 0 {
        return vec![(f64::NAN, f64::NAN); replicates_m.len()];
    }
    let sorted: Vec<Vec<f64>> = replicates_m
        .iter()
        .map(|ordinates| {
            let mut sorted = ordinates.clone();
            sorted.sort_by(f64::total_cmp);
            sorted
        })
        .collect();
    let mut depths: Vec<usize> = (0..count)
        .map(|replicate| {
            let depth = |(ordinates, sorted): (&Vec<f64>, &Vec<f64>)| {
                let value = ordinates[replicate];
                let not_above = sorted.partition_point(|&other| other <= value);
                let not_below = count - sorted.partition_point(|&other| other < value);
                not_above.min(not_below)
            };
            replicates_m.iter().zip(&sorted).map(depth).min().unwrap_or(count)
        })
        .collect();
    depths.sort_unstable();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count of replicates")]
    let left_out = ((count as f64 * (1.0 - confidence) + 1e-9).floor() as usize).min(count - 1);
    let depth = depths[left_out];
    sorted.iter().map(|sorted| (sorted[depth - 1], sorted[count - depth])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn one_strength_is_the_pointwise_band() {
        // 100 replicates: five are left out at each end for 90 %
        let ordinates: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!(simultaneous_bands(&[ordinates], 0.9), [(6.0, 95.0)]);
    }

    #[test]
    fn parallel_spectra_need_no_more_than_the_pointwise_band_and_crossing_ones_do() {
        let rising: Vec<f64> = (1..=100).map(f64::from).collect();
        let mixed: Vec<f64> = (0..100).map(|i| f64::from((i * 37) % 100 + 1)).collect();
        assert_eq!(simultaneous_bands(&[rising.clone(), rising.clone()], 0.9), [(6.0, 95.0); 2]);
        let [(lower, upper), _] = simultaneous_bands(&[rising, mixed], 0.9)[..] else { unreachable!() };
        assert!(lower < 6.0 && upper > 95.0);
        assert!(simultaneous_bands(&[vec![]], 0.9)[0].0.is_nan());
    }

    proptest! {
        #[test]
        fn the_share_asked_for_lies_within(
            replicates in (1_usize..6, 1_usize..60).prop_flat_map(|(strengths, count)| {
                let ordinate = prop_oneof![1 => Just(0.0), 1 => Just(f64::INFINITY), 6 => 0.0..1.0_f64];
                prop::collection::vec(prop::collection::vec(ordinate, count), strengths)
            }),
            confidence in 0.0_f64..1.0,
        ) {
            let bands = simultaneous_bands(&replicates, confidence);
            let count = replicates[0].len();
            let within = (0..count).filter(|&replicate| {
                replicates.iter().zip(&bands).all(|(row, &(low, high))| low <= row[replicate] && row[replicate] <= high)
            }).count();
            prop_assert!(within as f64 >= confidence * count as f64 - 1e-6, "{within} of {count}");
        }
    }
}
