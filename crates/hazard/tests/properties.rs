//! What holds for every curve and every text.

use std::fmt::Write;

use proptest::prelude::*;
use uplift_hazard::{CsvOptions, Extrapolation, HazardCurve, HazardError, SecondColumn, read_csv};

/// Curves of 2 to 40 points with steps from nearly flat to steep.
fn curves() -> impl Strategy<Value = HazardCurve> {
    let steps = prop::collection::vec((1e-3..2.0_f64, 1e-3..3.0_f64), 1..40);
    (-5.0..2.0_f64, -3.0..1.0_f64, steps).prop_map(|(log_im, log_maf, steps)| {
        let (mut x, mut y) = (log_im, log_maf);
        let (mut im, mut maf) = (vec![x.exp()], vec![y.exp()]);
        for (dx, dy) in steps {
            (x, y) = (x + dx, y - dy);
            im.push(x.exp());
            maf.push(y.exp());
        }
        HazardCurve::new("PGA", "g", "", im, maf).unwrap()
    })
}

fn options(second_column: Option<SecondColumn>) -> CsvOptions {
    CsvOptions { second_column, years: Some(50.0), ..CsvOptions::new("PGA", "g") }
}

proptest! {
    #[test]
    fn inversion_round_trip(curve in curves(), t in -0.2..1.2_f64) {
        let (first, last) = (curve.first().im, curve.last().im);
        let im = first * (last / first).powf(t);
        let rate = match curve.rate_at_extrapolated(im, Extrapolation::LogLog) {
            // A steep last segment continued may leave the range of numbers with full precision.
            Err(HazardError::ExtrapolationRange { .. }) => return Ok(()),
            Ok(rate) if rate < f64::MIN_POSITIVE => return Ok(()),
            other => other?,
        };
        let back = curve.im_at_rate_extrapolated(rate, Extrapolation::LogLog)?;
        // A nearly flat segment magnifies the rounding of the rate by dx/dy <= 2000.
        prop_assert!((back / im - 1.0).abs() < 1e-10, "{} {}", im, back);
    }

    #[test]
    fn rates_fall_strictly(curve in curves(), t in 0.0..1.0_f64, step in 1e-6..0.5_f64) {
        let (first, last) = (curve.first().im, curve.last().im);
        let a = first * (last / first).powf(t);
        let b = a * (1.0 + step);
        let rate = |im| curve.rate_at_extrapolated(im, Extrapolation::LogLog).unwrap();
        prop_assert!(rate(b) < rate(a));
    }

    #[test]
    fn interpolated_rates_lie_between_their_neighbours(curve in curves(), t in 0.0..1.0_f64, at in 0..40_usize) {
        let points: Vec<_> = curve.points().collect();
        let pair = &points[at % (points.len() - 1)..][..2];
        let im = pair[0].im + t * (pair[1].im - pair[0].im);
        let rate = curve.rate_at(im)?;
        prop_assert!(pair[1].maf <= rate && rate <= pair[0].maf);
    }

    /// λ → kλ and im → q·im shift a log–log curve without bending it.
    #[test]
    fn scaling_both_axes(curve in curves(), k in 0.1..10.0_f64, q in 0.1..10.0_f64, t in 0.0..1.0_f64) {
        let scaled = HazardCurve::new(
            "PGA", "g", "",
            curve.im().iter().map(|x| x * q).collect(),
            curve.maf().iter().map(|y| y * k).collect(),
        )?;
        let im = curve.first().im + t * (curve.last().im - curve.first().im);
        let ours = scaled.rate_at_extrapolated(im * q, Extrapolation::LogLog)?;
        prop_assert!((ours / (k * curve.rate_at(im)?) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn written_and_read_again(curve in curves()) {
        let mut text = String::from("# from a test\niml_g,maf\n");
        for point in curve.points() {
            writeln!(text, "{:e},{:e}", point.im, point.maf)?;
        }
        let read = read_csv(&text, "t.csv", &options(None))?;
        prop_assert_eq!((read.curve.im(), read.curve.maf()), (curve.im(), curve.maf()));
        prop_assert_eq!((read.dropped_zeros, read.dropped_certain), (0, 0));
    }

    #[test]
    fn arrays_never_panic_and_accepted_ones_are_valid(
        im in prop::collection::vec(prop::num::f64::ANY, 0..5),
        maf in prop::collection::vec(prop::num::f64::ANY, 0..5),
    ) {
        if let Ok(curve) = HazardCurve::new("PGA", "g", "", im, maf) {
            prop_assert!(curve.im().windows(2).all(|pair| pair[0] < pair[1]));
            prop_assert!(curve.maf().windows(2).all(|pair| pair[0] > pair[1]));
        }
    }

    #[test]
    fn any_number_may_be_asked(curve in curves(), value in prop::num::f64::ANY) {
        for extrapolation in [Extrapolation::Refuse, Extrapolation::LogLog] {
            for result in [
                curve.rate_at_extrapolated(value, extrapolation),
                curve.im_at_rate_extrapolated(value, extrapolation),
            ].into_iter().flatten() {
                prop_assert!(result.is_finite() && result > 0.0);
            }
        }
    }

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        let text = String::from_utf8_lossy(&bytes);
        let _ = read_csv(&text, "t.csv", &options(Some(SecondColumn::Probability)));
    }

    /// Texts made of the fragments a table is made of reach deeper than random bytes.
    #[test]
    fn shuffled_tables_never_panic(fragments in prop::collection::vec(prop::sample::select(vec![
        "iml", "maf", "poe", "pga_g", ",", ";", "\t", " ", "\n", "\r\n", "#", "IM:", "[g]", "\"", "1", "0", "0.5", "-1",
        "1e-3", "nan", "inf", "1e999", "_", "(", ")", "é²", "\u{feff}",
    ]), 0..60)) {
        for second in [None, Some(SecondColumn::AnnualRate), Some(SecondColumn::Probability)] {
            if let Ok(read) = read_csv(&fragments.concat(), "t.csv", &options(second)) {
                prop_assert!(read.curve.len() >= 2);
            }
        }
    }
}
