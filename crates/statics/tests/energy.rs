//! The laws are derivatives of one energy, for any restrainer and any path.

use proptest::prelude::*;
use uplift_statics::{Parts, RestrainedColumns, Restrainer, Spring, Stopper, Tendon, TendonPath, WhenFlat};

use crate::hand_solutions::{column, stack};

fn parts() -> impl Strategy<Value = Parts> {
    let spring = prop_oneof![
        (1e4_f64..1e7).prop_map(|stiffness_n_m| Spring::Linear { stiffness_n_m }),
        Just(Spring::Discs(stack())),
        Just(Spring::Rigid),
    ];
    let stopper = proptest::option::of((0.005_f64..0.03, 1e6_f64..5e7, proptest::option::of(1e3_f64..1e5)));
    let rest = (prop::bool::ANY, 1e6_f64..1e8, 0.0_f64..3e3, 0.0_f64..0.004, prop::bool::ANY);
    (spring, stopper, rest).prop_map(|(spring, stopper, (tendon, stiffness_n_m, prestress_n, slack_m, taut))| {
        let rigid = spring == Spring::Rigid;
        let stopper =
            stopper.filter(|_| !rigid).map(|(gap_m, stiffness_n_m, yield_n)| Stopper { gap_m, stiffness_n_m, yield_n });
        let tendon = (tendon || rigid).then_some(Tendon { stiffness_n_m, yield_n: None, failure_n: None });
        let (prestress_n, slack_m) = if taut { (prestress_n, 0.0) } else { (0.0, slack_m) };
        Parts { spring, stopper, tendon, prestress_n, slack_m, when_flat: WhenFlat::Tendon }
    })
}

fn path() -> impl Strategy<Value = TendonPath> {
    prop_oneof![
        Just(TendonPath::Column),
        Just(TendonPath::Foundation),
        (0.0_f64..0.03, 0.0_f64..1.0)
            .prop_map(|(duct_gap_m, above_m)| TendonPath::Shifted { duct_gap_m, tendon_length_m: 1.6 + above_m }),
    ]
}

proptest! {
    /// `T = dE/dΔ`: the energy between two elongations is the force times its way, by Gauss's rule of four points
    /// between thresholds, where the force is smooth; `dT/dΔ` is the slope.
    #[test]
    fn the_force_is_the_slope_of_the_energy(parts in parts(), share in 0.0_f64..1.0) {
        // prestress that engages the stopper or exceeds the springs is refused, as it must be
        let Ok(law) = Restrainer::new(parts) else { return Ok(()) };
        let elongation = share * law.limit_m().unwrap_or(0.06);
        let mut knots: Vec<f64> = law.pieces().iter().map(|piece| piece.from_elongation_m).collect();
        knots.retain(|at| *at > 0.0 && *at < elongation);
        knots.insert(0, 0.0);
        knots.push(elongation);
        // the spring in series softens smoothly: twenty parts of a piece are enough for 1e-10
        let nodes = [
            (0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
            (0.861_136_311_594_052_6, 0.347_854_845_137_453_9),
        ];
        let mut work = 0.0;
        for ends in knots.windows(2) {
            let width = (ends[1] - ends[0]) / 20.0;
            for part in 0..20 {
                let middle = ends[0] + (f64::from(part) + 0.5) * width;
                for (node, weight) in nodes {
                    for side in [-1.0, 1.0] {
                        work += 0.5 * width * weight * law.at(middle + 0.5 * side * node * width).unwrap().force_n;
                    }
                }
            }
        }
        let energy = law.at(elongation).unwrap().energy_j;
        prop_assert!((energy - work).abs() <= 1e-9 * work.abs().max(1e-9), "{energy} {work}");
        prop_assert!(law.at(0.0).unwrap().energy_j.abs() < 1e-12);
        let force_0 = law.at(0.0).unwrap().force_n;
        prop_assert!((force_0 - parts.prestress_n).abs() <= 1e-9 * parts.prestress_n.max(1.0), "{force_0}");
    }

    /// The force never falls as the elongation grows, and is continuous over the thresholds.
    #[test]
    fn the_force_rises_and_is_continuous(parts in parts(), share in 0.0_f64..1.0, step in 1e-6_f64..1e-2) {
        let Ok(law) = Restrainer::new(parts) else { return Ok(()) };
        let limit = law.limit_m().unwrap_or(0.08);
        let at = |elongation: f64| law.at(elongation.min(limit)).unwrap();
        prop_assert!(at(share * limit + step).force_n >= at(share * limit).force_n);
        prop_assert!(at(share * limit).stiffness_n_m >= 0.0);
        for piece in &law.pieces()[1..] {
            let from = piece.from_elongation_m;
            let (before, after) = (at(from - 1e-12), at(from + 1e-12));
            prop_assert!((after.force_n - before.force_n).abs() < 1e-3, "{piece:?}: {before:?} {after:?}");
            let way = 4e-12 * after.force_n.max(1.0);
            prop_assert!((after.energy_j - before.energy_j).abs() < way, "{piece:?}: {before:?} {after:?}");
        }
        // the force's inverse
        let force = at(share * limit).force_n;
        if force > 1.0 {
            let back = law.elongation_at_force_m(force).unwrap();
            prop_assert!((at(back).force_n / force - 1.0).abs() < 1e-9);
            prop_assert!(back <= share * limit + 1e-12);
        }
    }

    /// `F = dV/du`, by a central difference of the energy; `dV/dθ` is the same times `du/dθ`.
    #[test]
    fn the_force_on_the_deck_is_the_slope_of_the_potential(parts in parts(), path in path(), theta in 0.005_f64..0.4) {
        let Ok(law) = Restrainer::new(parts) else { return Ok(()) };
        let columns = RestrainedColumns::new(column(), 4, 30e3, 2e3).unwrap().with_restrainer(law, path).unwrap();
        let step = 1e-5;
        let last = columns.last_rotation_rad();
        prop_assume!(theta + step < last);
        prop_assume!(columns.threshold_rotations_rad().iter().all(|knot| (knot - theta).abs() > 2.0 * step));
        let at = |theta: f64| columns.at_rotation(theta).unwrap();
        let (left, right, middle) = (at(theta - step), at(theta + step), at(theta));
        let slope = (right.energy_j - left.energy_j) / (right.displacement_m - left.displacement_m);
        let scale = columns.uplift_force_n() + middle.tendon_n;
        prop_assert!((slope - middle.force_n).abs() < 2e-5 * scale, "{slope} {}", middle.force_n);
        let lever = 2.0 * column().size_m() * (column().slenderness_rad() - theta).cos();
        prop_assert!((columns.moment_n_m(theta) - middle.force_n * lever).abs() < 1e-9 * scale);
    }

    /// Linear: a tendon in the foundation is one at the column of four times the stiffness, exactly.
    #[test]
    fn the_foundation_is_the_column_with_four_times_the_stiffness(k in 1e4_f64..3e6, theta in 1e-6_f64..0.5) {
        let with = |k: f64, path| {
            let law = Restrainer::new(Parts::linear(k)).unwrap();
            RestrainedColumns::new(column(), 4, 30e3, 2e3).unwrap().with_restrainer(law, path).unwrap()
        };
        let (foundation, at_column) = (with(k, TendonPath::Foundation), with(4.0 * k, TendonPath::Column));
        let forces = [&foundation, &at_column].map(|columns| columns.at_rotation(theta).unwrap().force_n);
        prop_assert!((forces[0] - forces[1]).abs() <= 1e-13 * foundation.uplift_force_n());
        let capacities = [&foundation, &at_column].map(|columns| columns.capacity().map(|found| found.displacement_m));
        match capacities {
            [Some(one), Some(other)] => prop_assert!((one / other - 1.0).abs() < 1e-12),
            [one, other] => prop_assert_eq!(one, other),
        }
    }

    /// A stack in series with a very stiff tendon is the stack; pressed little, it is a linear spring.
    #[test]
    fn limits_of_the_series(d in 1e-4_f64..0.035) {
        let stiff = Restrainer::new(Parts::discs(stack(), 1e16)).unwrap().at(d).unwrap();
        prop_assert!((stiff.force_n / stack().law().force_n(d) - 1.0).abs() < 1e-8);
        let little = 1e-6 * d;
        let soft = Restrainer::new(Parts::discs(stack(), 13e6)).unwrap().at(little).unwrap();
        let series = 1.0 / (1.0 / stack().law().stiffness_n_m(0.0) + 1.0 / 13e6);
        prop_assert!((soft.force_n / (series * little) - 1.0).abs() < 1e-5);
    }

    /// Linearised and exact agree as the column becomes slender at the same `u/2b`: the error falls with α².
    #[test]
    fn the_linear_law_is_the_limit_of_slender_columns(share in 0.1_f64..1.5, kappa in 0.0_f64..0.9) {
        let difference = |slenderness: f64| {
            let geometry = uplift_structure::Geometry::from_slenderness_and_height(slenderness, 1.6).unwrap();
            let free = RestrainedColumns::new(geometry, 1, 30e3, 2e3).unwrap();
            let k = kappa * free.linear(0.0).unwrap().critical_stiffness_n_m();
            let held = free.with_restrainer(Restrainer::new(Parts::linear(k)).unwrap(), TendonPath::Column).unwrap();
            let u = share * geometry.width_m();
            let linear = held.linear(k).unwrap();
            (held.at_displacement(u).unwrap().force_n - linear.at(u).force_n) / linear.uplift_force_n()
        };
        let (coarse, fine) = (difference(0.08), difference(0.04));
        prop_assert!(coarse.abs() < 0.05, "{coarse}");
        // a quarter, where the leading term does not vanish
        if coarse.abs() > 1e-4 {
            prop_assert!((0.2..0.3).contains(&(fine / coarse)), "{coarse} {fine}");
        }
    }
}
