//! Construction, interpolation and units of a hazard curve, on cases solved by hand.

use uplift_hazard::{Extrapolation, HazardCurve, HazardError, HazardPoint};

/// λ = 0.1 im⁻²: a straight line in log–log axes.
fn power_law() -> HazardCurve {
    HazardCurve::new("PGV", "cm/s", "power law", vec![1.0, 10.0, 100.0], vec![0.1, 1e-3, 1e-5]).unwrap()
}

fn close(a: f64, b: f64) -> bool {
    (a / b - 1.0).abs() < 1e-14
}

#[test]
fn a_power_law_is_reproduced_between_and_beyond_its_points() {
    let curve = power_law();
    for im in [1.0, 1.5, 2.0, 5.0, 10.0, 31.0, 99.0, 100.0] {
        assert!(close(curve.rate_at(im).unwrap(), 0.1 / (im * im)), "{im}");
        assert!(close(curve.im_at_rate(0.1 / (im * im)).unwrap(), im), "{im}");
    }
    for im in [1e-3, 0.5, 200.0, 1e5] {
        let rate = 0.1 / (im * im);
        assert!((curve.rate_at_extrapolated(im, Extrapolation::LogLog).unwrap() / rate - 1.0).abs() < 1e-13);
        assert!((curve.im_at_rate_extrapolated(rate, Extrapolation::LogLog).unwrap() / im - 1.0).abs() < 1e-13);
    }
}

#[test]
fn extrapolation_continues_the_end_segment_only() {
    // Slopes −1 and −3.
    let curve = HazardCurve::new("PGA", "g", "", vec![0.1, 1.0, 10.0], vec![1.0, 0.1, 1e-4]).unwrap();
    let rate = |im| curve.rate_at_extrapolated(im, Extrapolation::LogLog).unwrap();
    assert!(close(rate(0.01), 10.0));
    assert!(close(rate(20.0), 1e-4 / 8.0));
}

#[test]
fn points_are_returned_exactly() {
    let (im, maf) = (vec![0.1, 0.3, 0.7], vec![0.123_456, 0.012_345, 0.000_777]);
    let curve = HazardCurve::new("PGA", "g", "", im.clone(), maf.clone()).unwrap();
    for (&im, &maf) in im.iter().zip(&maf) {
        assert_eq!(curve.rate_at(im).unwrap(), maf);
        assert_eq!(curve.im_at_rate(maf).unwrap(), im);
    }
    assert_eq!(curve.first(), HazardPoint { im: 0.1, maf: 0.123_456 });
    assert_eq!(curve.last(), HazardPoint { im: 0.7, maf: 0.000_777 });
    assert_eq!((curve.len(), curve.points().len()), (3, 3));
}

#[test]
fn outside_the_curve_is_refused_with_the_way_out() {
    let curve = power_law();
    assert_eq!(
        curve.rate_at(250.0).unwrap_err().to_string(),
        "PGV = 250 cm/s lies outside the hazard curve, which spans 1 to 100 cm/s; check the unit of the curve, give a \
         curve that covers it, or choose log-log extrapolation (risk.extrapolate = \"loglog\")"
    );
    assert!(matches!(curve.rate_at(0.999), Err(HazardError::LevelOutside { .. })));
    assert!(matches!(curve.im_at_rate(0.11), Err(HazardError::RateOutside { .. })));
    assert!(matches!(curve.im_at_rate(0.9e-5), Err(HazardError::RateOutside { .. })));
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for extrapolation in [Extrapolation::Refuse, Extrapolation::LogLog] {
            let level = curve.rate_at_extrapolated(value, extrapolation);
            assert!(matches!(level, Err(HazardError::Argument { .. })), "{value}");
            let rate = curve.im_at_rate_extrapolated(value, extrapolation);
            assert!(matches!(rate, Err(HazardError::Argument { .. })), "{value}");
        }
    }
    let underflow = curve.rate_at_extrapolated(1e200, Extrapolation::LogLog);
    assert!(matches!(underflow, Err(HazardError::ExtrapolationRange { .. })));
}

#[test]
fn extreme_but_valid_numbers() {
    let curve = HazardCurve::new("x", "-", "", vec![1e-300, 1e300], vec![1e300, 1e-300]).unwrap();
    assert!((curve.rate_at(1.0).unwrap() - 1.0).abs() < 1e-10);
    assert!((curve.rate_at(1e150).unwrap() / 1e-150 - 1.0).abs() < 1e-10);
    // Neighbouring numbers.
    let next = f64::from_bits(1.0_f64.to_bits() + 2);
    let curve = HazardCurve::new("x", "-", "", vec![1.0, next], vec![2.0, 1.0]).unwrap();
    let middle = f64::from_bits(1.0_f64.to_bits() + 1);
    assert!((curve.rate_at(middle).unwrap() - 2.0_f64.sqrt()).abs() < 1e-12);
}

#[test]
fn broken_rules_are_named_with_index_and_values() {
    let message = |im: &[f64], maf: &[f64]| {
        HazardCurve::new("PGV", "cm/s", "", im.to_vec(), maf.to_vec()).unwrap_err().to_string()
    };
    assert_eq!(
        message(&[1.0, 2.0, 2.0], &[0.3, 0.2, 0.1]),
        "point 2 (counted from 0): intensity 2 cm/s does not exceed 2 cm/s at point 1 (counted from 0); sort the rows \
         by intensity and remove repeated ones"
    );
    assert!(
        message(&[1.0, 2.0, 3.0], &[0.3, 0.2, 0.2])
            .starts_with("point 2 (counted from 0): annual rate 0.2 1/yr equals that at point 1 (counted from 0)")
    );
    assert!(message(&[1.0, 2.0], &[0.2, 0.3]).contains("0.3 1/yr is not below 0.2"));
    assert_eq!(
        message(&[1.0, 2.0], &[0.2, 0.0]),
        "point 1 (counted from 0): annual rate [1/yr] is 0, it must be a finite number above 0"
    );
    assert!(message(&[0.0, 2.0], &[0.2, 0.1]).contains("intensity [cm/s] is 0"));
    assert!(message(&[f64::NAN, 2.0], &[0.2, 0.1]).contains("is NaN"));
    assert!(message(&[1.0, f64::INFINITY], &[0.2, 0.1]).contains("is inf"));
    assert!(message(&[1.0], &[0.1]).contains("at least 2 points"));
    assert!(message(&[], &[]).contains("found 0"));
    assert_eq!(message(&[1.0, 2.0], &[0.1]), "hazard curve: 2 intensity levels but 1 rates; give one rate per level");
}

#[test]
fn a_known_measure_has_a_unit_of_its_dimension() {
    let build = |measure: &str, unit: &str| HazardCurve::new(measure, unit, "", vec![1.0, 2.0], vec![0.2, 0.1]);
    for (measure, unit) in
        [("PGV", "cm/s"), ("pgv", "m/s"), ("PGA", "g"), ("PGA", "m/s²"), ("SA(0.3)", "gal"), ("Arias", "m/s")]
    {
        assert!(build(measure, unit).is_ok(), "{measure} in {unit}");
    }
    for (measure, unit) in
        [("PGV", "g"), ("PGA", "cm/s"), ("SA(1.0)", "m"), ("PGV", "knots"), ("AvgSA(0.2-2.0)", "m"), ("CAV", "g")]
    {
        assert!(matches!(build(measure, unit), Err(HazardError::UnitOfMeasure { .. })), "{measure} in {unit}");
    }
    assert_eq!(build("PGV", "g").unwrap_err().to_string(), "measure PGV cannot be in \"g\": use cm/s or m/s");
    assert!(matches!(build(" ", "g"), Err(HazardError::EmptyLabel { what: "measure" })));
    assert!(matches!(build("PGA", ""), Err(HazardError::EmptyLabel { what: "unit" })));
}

#[test]
fn units_of_the_field() {
    let curve =
        |measure: &str, unit: &str| HazardCurve::new(measure, unit, "s", vec![0.5, 2.0], vec![0.2, 0.1]).unwrap();
    let gravity = 9.80665;
    let converted = curve("PGV", "m/s").in_field_units(gravity).unwrap();
    assert_eq!((converted.unit(), converted.im()), ("cm/s", &[50.0, 200.0][..]));
    assert_eq!((converted.maf(), converted.source()), (&[0.2, 0.1][..], "s"));
    let converted = curve("PGA", "m/s2").in_field_units(gravity).unwrap();
    assert_eq!(converted.unit(), "g");
    assert!(close(converted.im()[1], 2.0 / gravity));
    let converted = curve("PGA", "gal").in_field_units(10.0).unwrap();
    assert!(close(converted.im()[0], 0.0005));
    // No arithmetic where nothing changes, and the spelling becomes the usual one.
    let converted = curve("PGV", "cm_s").in_field_units(gravity).unwrap();
    assert_eq!((converted.unit(), converted.im()), ("cm/s", &[0.5, 2.0][..]));
    let converted = curve("CAV", "g s").in_field_units(gravity).unwrap();
    assert_eq!(converted.unit(), "cm/s");
    assert!(close(converted.im()[1], 2.0 * 100.0 * gravity));
    assert_eq!(curve("PGD", "m").in_field_units(gravity).unwrap().im(), [50.0, 200.0]);
    assert_eq!(curve("D5-95", "s").in_field_units(gravity).unwrap().unit(), "s");
    assert!(matches!(curve("PGV", "m/s").in_unit("g", gravity), Err(HazardError::Conversion { .. })));
    assert!(matches!(curve("PGV", "m/s").in_unit("cm/s", 0.0), Err(HazardError::Argument { .. })));
}
