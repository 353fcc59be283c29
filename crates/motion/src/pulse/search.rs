//! Where the potential pulses of a pair are: time, scale and orientation of its strongest wavelets.

use super::transform::{Blocks, FINEST, Kernel, Resolution};
use super::wavelet;
use crate::peaks::integral;

/// Shortest and longest pseudo-period searched \[s\].
const PERIODS_S: [f64; 2] = [0.25, 15.0];
/// Steps from the first scale to the last, equal.
const SCALE_STEPS: usize = 50;
/// Wavelets closer than this, in units of the scale, belong to one pulse.
pub(super) const NEIGHBOURHOOD: f64 = 10.0 / 25.0;

/// The scales searched: whole numbers of samples with equal steps, to the longest period or a
/// little farther.
#[derive(Debug, Clone, Copy)]
struct Scales {
    first: f64,
    step: f64,
    dt_s: f64,
}

impl Scales {
    fn new(dt_s: f64) -> Self {
        let [shortest, longest] = PERIODS_S.map(|period_s| period_s * wavelet::CENTRE_FREQUENCY / dt_s);
        let first = shortest.floor().max(1.0);
        Self { first, step: ((longest - first) / SCALE_STEPS as f64).ceil().max(1.0), dt_s }
    }

    /// Scale of a row \[s\].
    fn scale_s(self, row: usize) -> f64 {
        (self.first + row as f64 * self.step) * self.dt_s
    }

    /// Scales of the rows next to `row`, or its own at an end \[s\].
    fn neighbours_s(self, row: usize) -> [f64; 2] {
        [self.scale_s(row.saturating_sub(1)), self.scale_s((row + 1).min(SCALE_STEPS))]
    }
}

/// A potential pulse.
#[derive(Debug, Clone, Copy)]
pub(super) struct Peak {
    /// Time of the centre of the strongest wavelet \[s\].
    pub(super) centre_s: f64,
    /// The scales searched next to its own, between which its own lies \[s\].
    pub(super) scales_s: [f64; 2],
    /// Its coefficients in the two components.
    pub(super) coefficients: [f64; 2],
}

/// Coefficients of both components at one scale.
struct Row {
    scale_s: f64,
    step_s: f64,
    /// At centres 0, `step_s`, 2 `step_s`, …
    coefficients: Vec<[f64; 2]>,
}

/// Wavelet coefficients of both components at every scale and time.
pub(super) struct Scalogram {
    scales: Scales,
    duration_s: f64,
    integrals: [Vec<f64>; 2],
    rows: Vec<Row>,
}

impl Scalogram {
    /// Transforms the two `velocities`, of equal length and step.
    pub(super) fn new(velocities: &[Vec<f64>; 2], dt_s: f64, resolution: Resolution) -> Self {
        let scales = Scales::new(dt_s);
        let duration_s = (velocities[0].len() - 1) as f64 * dt_s;
        let integrals = velocities.each_ref().map(|velocity| integral(velocity, dt_s));
        let row = |row: usize| {
            let scale_s = scales.scale_s(row);
            let blocks = integrals.each_ref().map(|area| Blocks::new(area, dt_s, scale_s, resolution.search));
            let step_s = blocks[0].step_s;
            let kernel = Kernel::new(scale_s, 0.0, step_s);
            #[allow(clippy::cast_possible_truncation)] // no more than samples
            let last = (duration_s / step_s) as i64;
            let at = |shift: i64| blocks.each_ref().map(|blocks| kernel.coefficient(blocks, shift));
            Row { scale_s, step_s, coefficients: (0..=last).map(at).collect() }
        };
        let rows = (0..=SCALE_STEPS).map(row).collect();
        Self { scales, duration_s, integrals, rows }
    }

    /// The strongest wavelet in any orientation, c₁² + c₂² being largest; the coefficients of all
    /// scales at the times around it are struck off. None when nothing but zeros is left.
    pub(super) fn take_peak(&mut self) -> Option<Peak> {
        let mut strongest = (0.0, None);
        for (index, row) in self.rows.iter().enumerate() {
            for (column, coefficients) in row.coefficients.iter().enumerate() {
                let power = power(*coefficients);
                if power > strongest.0 {
                    strongest = (power, Some((index, column)));
                }
            }
        }
        let (found, column) = strongest.1?;
        let row = &self.rows[found];
        let about_s = column as f64 * row.step_s;
        // The blocks take a little off the coefficients, of one scale more than of the next.
        let near = found.saturating_sub(1)..=(found + 1).min(SCALE_STEPS);
        let climbed = near.map(|row| (row, self.climb(self.rows[row].scale_s, about_s, self.rows[found].step_s)));
        let (index, centre_s, coefficients) =
            climbed.fold(
                (found, about_s, [0.0; 2]),
                |best, (row, (at, c))| {
                    if power(c) > power(best.2) { (row, at, c) } else { best }
                },
            );

        let reach_s = NEIGHBOURHOOD * self.rows[index].scale_s;
        for row in &mut self.rows {
            for (column, coefficients) in row.coefficients.iter_mut().enumerate() {
                if (column as f64 * row.step_s - centre_s).abs() < reach_s {
                    *coefficients = [0.0; 2];
                }
            }
        }
        // Whatever the steps, no other call finds the same.
        self.rows[found].coefficients[column] = [0.0; 2];
        Some(Peak { centre_s, scales_s: self.scales.neighbours_s(index), coefficients })
    }

    /// Centre and coefficients of the strongest wavelet of `scale_s` near `centre_s`, to a sample:
    /// up the hill in steps that begin with half of `step_s` and are halved.
    fn climb(&self, scale_s: f64, centre_s: f64, step_s: f64) -> (f64, [f64; 2]) {
        let blocks = self.integrals.each_ref().map(|area| Blocks::new(area, self.scales.dt_s, scale_s, FINEST));
        let fine_s = blocks[0].step_s;
        let kernel = Kernel::new(scale_s, centre_s, fine_s);
        let at = |shift: i64| {
            let inside = (0.0..=self.duration_s).contains(&(centre_s + shift as f64 * fine_s));
            if inside { blocks.each_ref().map(|blocks| kernel.coefficient(blocks, shift)) } else { [0.0; 2] }
        };
        #[allow(clippy::cast_possible_truncation)] // a ratio of resolutions
        let mut step = (step_s / fine_s) as i64 / 2;
        let (mut shift, mut coefficients) = (0, at(0));
        loop {
            step = step.max(1);
            let mut moved = false;
            for next in [shift - step, shift + step] {
                let there = at(next);
                if power(there) > power(coefficients) {
                    (shift, coefficients, moved) = (next, there, true);
                }
            }
            if !moved {
                if step == 1 {
                    return (centre_s + shift as f64 * fine_s, coefficients);
                }
                step /= 2;
            }
        }
    }
}

fn power([c1, c2]: [f64; 2]) -> f64 {
    c1 * c1 + c2 * c2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_by_hand() {
        // At 0.01 s: 0.25/1.4 is 17.9 samples, 15/1.4 is 1071.4, so 21.1 a step.
        let scales = Scales::new(0.01);
        assert_eq!((scales.first, scales.step), (17.0, 22.0));
        assert!((scales.scale_s(SCALE_STEPS) - 11.17).abs() < 1e-12);
        assert_eq!(scales.neighbours_s(0), [scales.scale_s(0), scales.scale_s(1)]);
        assert_eq!(scales.neighbours_s(50), [scales.scale_s(49), scales.scale_s(50)]);
        // Steps that no accelerograph has.
        for dt_s in [1e-300, 20.0, 1e300] {
            let scales = Scales::new(dt_s);
            assert!(scales.first >= 1.0 && scales.step >= 1.0, "{dt_s}");
        }
    }

    #[test]
    fn two_wavelets_are_found_in_the_order_of_their_strength() {
        let dt_s = 0.01;
        let wave =
            |t: f64, centre_s: f64, scale_s: f64| wavelet::value((t - centre_s) / scale_s + 3.5) / scale_s.sqrt();
        let scales = Scales::new(dt_s);
        let [long, short] = [scales.scale_s(10), scales.scale_s(3)];
        let at = |f: &dyn Fn(f64) -> f64| (0..4001).map(|i| f(f64::from(i) * dt_s)).collect::<Vec<_>>();
        // The first pulse in the direction (3, -4)/5 with 5, the second in (0, 1) with 4.
        let velocities =
            [at(&|t| 3.0 * wave(t, 20.0, long)), at(&|t| -4.0 * wave(t, 20.0, long) + 4.0 * wave(t, 5.0, short))];
        let mut scalogram = Scalogram::new(&velocities, dt_s, Resolution::DEFAULT);
        let [first, second] = [scalogram.take_peak().unwrap(), scalogram.take_peak().unwrap()];
        assert!((first.centre_s - 20.0).abs() <= dt_s, "{first:?}");
        assert_eq!(first.scales_s, scales.neighbours_s(10));
        assert!((first.coefficients[0] - 3.0).abs() < 0.01 && (first.coefficients[1] + 4.0).abs() < 0.01, "{first:?}");
        assert!((second.centre_s - 5.0).abs() <= dt_s, "{second:?}");
        assert_eq!(second.scales_s, scales.neighbours_s(3));
        assert!(second.coefficients[0].abs() < 0.01 && (second.coefficients[1] - 4.0).abs() < 0.01, "{second:?}");
    }

    #[test]
    fn nothing_moves() {
        let still = || vec![0.0; 50];
        assert!(Scalogram::new(&[still(), still()], 0.01, Resolution::DEFAULT).take_peak().is_none());
        let broken = || vec![f64::NAN; 50];
        assert!(Scalogram::new(&[broken(), broken()], 0.01, Resolution::DEFAULT).take_peak().is_none());
    }
}
