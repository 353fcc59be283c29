//! Free rocking against what is known of it in closed form.

use uplift_block::{History, HistoryRow, Moment, Overturning, RockingBlock, rock_freely};

fn impacts(history: &History) -> Vec<[HistoryRow; 2]> {
    let rows = history.rows.windows(2).filter(|rows| rows[1].moment == Moment::AfterImpact);
    rows.map(|rows| [rows[0], rows[1]]).collect()
}

/// Housner's quarter period, T/4 = acosh(1/(1 − θ₀/α))/p, holds for α → 0: the deviation goes with α².
#[test]
fn the_first_impact_comes_after_housners_quarter_period() {
    let mut deviations = Vec::new();
    for alpha in [0.1, 0.01, 0.001] {
        let block = RockingBlock::new(2.0, alpha).unwrap();
        let (_, history) = rock_freely(&block, 0.6 * alpha, 3.0).unwrap();
        let quarter = (1.0_f64 / 0.4).acosh() / block.frequency_parameter_rad_s();
        deviations.push((impacts(&history)[0][0].time_s / quarter - 1.0).abs());
    }
    println!("deviations from the linear limit: {deviations:?}");
    assert!(deviations[2] < 2e-7);
    for pair in deviations.windows(2) {
        assert!((pair[0] / pair[1] - 100.0).abs() < 5.0, "{deviations:?}");
    }
}

/// Half cycle by half cycle in the linear limit (Housner): after the n-th impact the rotation reaches
/// θₙ = α (1 − √(1 − r²ⁿ (1 − (1 − θ₀/α)²))), and the time from peak to impact is the quarter period of θₙ.
#[test]
fn impacts_follow_housners_half_periods() {
    let alpha = 1e-4;
    let block = RockingBlock::new(1.0, alpha).unwrap().with_restitution(0.9).unwrap();
    let p = block.frequency_parameter_rad_s();
    let (response, history) = rock_freely(&block, -0.8 * alpha, 20.0).unwrap();
    let quarter = |peak: f64| (1.0 / (1.0 - peak)).acosh() / p;
    let peak = |n: i32| 1.0 - (1.0 - 0.9_f64.powi(2 * n) * (1.0 - 0.2 * 0.2)).sqrt();
    let mut expected = quarter(0.8);
    let found = impacts(&history);
    assert!(found.len() > 40 && response.impacts == found.len() as u64);
    for (n, impact) in (1..).zip(found.iter().take(40)) {
        assert!((impact[0].time_s / expected - 1.0).abs() < 1e-7, "impact {n}: {} {expected}", impact[0].time_s);
        expected += 2.0 * quarter(peak(n));
    }
    // Σ 2 quarter(θₙ) converges: the block rests at a finite time
    let rest = history.rows.iter().find(|row| row.moment == Moment::Rest).unwrap();
    let all = quarter(0.8) + (1..2000).map(|n| 2.0 * quarter(peak(n))).sum::<f64>();
    assert!(rest.time_s < all && all - rest.time_s < 0.5, "{} {all}", rest.time_s);
    assert_eq!(response.overturning, Overturning::None);
}

/// v²/2 + p² cos(α − |θ|) is constant between impacts, v falls by r at each, θ is zero there and changes its sign.
#[test]
fn energy_is_lost_at_impacts_only() {
    let mut largest = 0.0_f64;
    for (alpha, tilt) in [(0.05, 0.9), (0.2, -0.999), (0.5, 0.7)] {
        let block = RockingBlock::new(1.5, alpha).unwrap();
        let p2 = block.frequency_parameter_rad_s().powi(2);
        let lift = |rotation: f64| {
            // cos(α − θ) − cos α without the difference
            let half = 0.5 * rotation.abs();
            2.0 * half.sin() * (alpha - half).sin()
        };
        let energy = |row: &HistoryRow| 0.5 * row.velocity_rad_s.powi(2) + p2 * lift(row.rotation_rad);
        let (_, history) = rock_freely(&block, tilt * alpha, 60.0).unwrap();
        let mut before = energy(&history.rows[0]);
        for rows in history.rows.windows(2).take_while(|rows| rows[1].moment != Moment::Rest) {
            if rows[1].moment == Moment::AfterImpact {
                assert_eq!(rows[0].moment, Moment::BeforeImpact);
                assert_eq!([rows[0].rotation_rad, rows[1].rotation_rad].map(f64::abs), [0.0; 2]);
                let ratio = rows[1].velocity_rad_s / rows[0].velocity_rad_s;
                assert!((ratio / block.restitution() - 1.0).abs() < 1e-15, "{ratio}");
                before = energy(&rows[1]);
            } else {
                largest = largest.max((energy(&rows[1]) / before - 1.0).abs());
            }
        }
        assert!(impacts(&history).len() > 5, "{}", impacts(&history).len());
    }
    println!("largest relative change of energy between impacts: {largest:.1e}");
    assert!(largest < 1e-11);
}

/// An elastic block keeps its energy through a hundred impacts, and its peaks.
#[test]
fn an_elastic_block_rocks_for_ever() {
    let block = RockingBlock::new(1.0, 0.1).unwrap().with_restitution(1.0).unwrap();
    let (response, history) = rock_freely(&block, 0.07, 300.0).unwrap();
    assert!(response.impacts > 100);
    let speeds: Vec<f64> = impacts(&history).iter().map(|rows| rows[0].velocity_rad_s.abs()).collect();
    let change = speeds.iter().fold(0.0_f64, |change, v| change.max((v / speeds[0] - 1.0).abs()));
    assert!(change < 1e-11, "{change:e}");
    assert!((response.rotation_rad - 0.07).abs() < 1e-13);
}

#[test]
fn beyond_the_corner_it_falls_short_of_it_it_returns() {
    let block = RockingBlock::new(1.0, 0.2).unwrap();
    for sign in [-1.0, 1.0] {
        let (response, history) = rock_freely(&block, sign * 0.2 * (1.0 + 1e-12), 100.0).unwrap();
        assert_eq!(response.overturning, Overturning::WithoutImpact);
        assert_eq!(response.rotation_rad, f64::INFINITY);
        assert_eq!(response.displacement_m, f64::INFINITY);
        assert_eq!(history.rows.last().unwrap().moment, Moment::Overturned);
        let (response, _) = rock_freely(&block, sign * 0.2 * (1.0 - 1e-12), 100.0).unwrap();
        assert_eq!(response.overturning, Overturning::None);
        assert!((response.rotation_rad - 0.2).abs() < 1e-12 && response.impacts > 0);
    }
    assert!(rock_freely(&block, 2.0, 1.0).is_err());
    assert!(rock_freely(&block, f64::NAN, 1.0).is_err());
    assert!(rock_freely(&block, 0.1, f64::NAN).unwrap_err().to_string().contains("time of free rocking is NaN s"));
    let message = rock_freely(&block, 0.1, 1e9).unwrap_err().to_string();
    assert!(message.contains("give a shorter motion"), "{message}");
}

/// Without restitution the first impact is the last.
#[test]
fn a_plastic_block_stops_at_once() {
    let block = RockingBlock::new(1.0, 0.2).unwrap().with_restitution(0.0).unwrap();
    let (response, history) = rock_freely(&block, 0.1, 100.0).unwrap();
    assert_eq!(response.impacts, 1);
    assert_eq!(history.rows.last().unwrap().velocity_rad_s, 0.0);
}
