//! Rules and design: algebra by hand, the printed tables of Section 3.4.5, and what must hold for any numbers.

use std::collections::BTreeMap;

use proptest::prelude::*;
use uplift_structure::{Block, Capacity, Check, Conditions, Demand, Geometry, Reference, Rule, StructureError, design};

fn capacity(uplift_m: f64, capacity_m: f64) -> Capacity {
    Capacity::new(uplift_m, capacity_m).unwrap()
}

fn demand(rule: Rule, capacity: &Capacity, z: f64) -> f64 {
    rule.demand(capacity, z).unwrap().displacement_m()
}

#[test]
fn equal_energy_by_hand() {
    // rigid, u_cap = 2: 2 − √(2 (2 − 1.5)) = 1
    let rigid = capacity(0.0, 2.0);
    assert_eq!(
        Rule::EqualEnergy.demand(&rigid, 0.75).unwrap(),
        Demand::Stands { displacement_m: 1.0, ratio: 4.0 / 3.0 }
    );
    assert_eq!(Rule::EqualEnergy.zero_stiffness_demand_m(&rigid, 1.0).unwrap(), 0.75);
    // u_up = 0.5, u_cap = 2.5: 2.5 − √(2 (2.5 − 2.5 + 0.5)) = 1.5
    let soft = capacity(0.5, 2.5);
    assert_eq!(demand(Rule::EqualEnergy, &soft, 1.25), 1.5);
    assert_eq!(Rule::EqualEnergy.zero_stiffness_demand_m(&soft, 1.5).unwrap(), 1.25);
    // at the limit (2.5 + 0.5)/2 the demand is the capacity; beyond, it overturns
    assert_eq!(demand(Rule::EqualEnergy, &soft, 1.5), 2.5);
    assert_eq!(
        Rule::EqualEnergy.demand(&soft, 1.500_001).unwrap(),
        Demand::Overturns { largest_zero_stiffness_demand_m: 1.5 }
    );
    // not uplifted: the same system
    assert_eq!(Rule::EqualEnergy.demand(&soft, 0.3).unwrap(), Demand::Stands { displacement_m: 0.3, ratio: 1.0 });
    assert_eq!(Rule::EqualEnergy.demand(&soft, 0.0).unwrap(), Demand::Stands { displacement_m: 0.0, ratio: 1.0 });
}

#[test]
fn equal_displacement_up_to_the_capacity() {
    let soft = capacity(0.5, 2.5);
    assert_eq!(demand(Rule::EqualDisplacement, &soft, 2.5), 2.5);
    assert_eq!(Rule::EqualDisplacement.zero_stiffness_demand_m(&soft, 1.5).unwrap(), 1.5);
    assert_eq!(
        Rule::EqualDisplacement.demand(&soft, 2.6).unwrap(),
        Demand::Overturns { largest_zero_stiffness_demand_m: 2.5 }
    );
}

#[test]
fn required_capacity_by_hand() {
    // FS = 2, rigid: 2 · 4/3 · 0.75 = 2, whose demand is 1 = 2/2
    assert!((Rule::EqualEnergy.required_capacity_m(0.75, 0.0, 2.0).unwrap() - 2.0).abs() < 1e-15);
    // FS = 2.5: 3.125 z and 2.5 z
    assert!((Rule::EqualEnergy.required_capacity_m(1.0, 0.0, 2.5).unwrap() - 3.125).abs() < 1e-15);
    assert_eq!(Rule::EqualDisplacement.required_capacity_m(1.0, 0.0, 2.5).unwrap(), 2.5);
    // FS = 1 is the edge of Eq. 3.14: 2 · 1.5 − 0.5
    assert!((Rule::EqualEnergy.required_capacity_m(1.5, 0.5, 1.0).unwrap() - 2.5).abs() < 1e-15);
    // z = 1.25, u_up = 0.5, FS = 2: k = 0.75, (1.25 + √(1.5625 − 0.75 · 0.5 · 2))/0.75 = (1.25 +
    // √0.8125)/0.75 = 2.868517
    let required = Rule::EqualEnergy.required_capacity_m(1.25, 0.5, 2.0).unwrap();
    assert!((required - 2.868_517_091_8).abs() < 1e-9, "{required}");
    // no uplift
    assert_eq!(Rule::EqualEnergy.required_capacity_m(0.3, 0.5, 2.0).unwrap(), 0.6);
}

#[test]
fn a_check_names_demand_requirement_and_margin() {
    let geometry = Geometry::from_width_and_height(2.0, 20.0).unwrap();
    let block = Block::new(geometry, 1.0).unwrap();
    let system = block.equivalent(Reference::Top, Conditions::new(10.0, 0.0).unwrap()).unwrap();
    // an ordinate of 0.5 m is 0.75 m at the top: demand 1 m, required 2 m at FS = 2, and the block is 2 m wide
    let z = system.zero_stiffness_demand_m(0.5).unwrap();
    let check = Check::from_system(&system, Rule::EqualEnergy, 2.0, z).unwrap();
    assert_eq!((z, check.demand.displacement_m(), check.capacity_m), (0.75, 1.0, 2.0));
    assert!((check.required_capacity_m - 2.0).abs() < 1e-15 && check.margin_m().abs() < 1e-15);
    assert_eq!(check.safety_factor(), 2.0);
    let weak = Check::from_system(&system, Rule::EqualEnergy, 2.0, 1.2).unwrap();
    assert!(!weak.is_satisfied() && weak.margin_m() < 0.0 && weak.safety_factor() == 0.0);
    assert_eq!(weak.demand, Demand::Overturns { largest_zero_stiffness_demand_m: 1.0 });
    let endless = Check::from_capacity(&capacity(0.0, f64::INFINITY), Rule::EqualEnergy, 2.0, 1.2).unwrap();
    assert_eq!((endless.demand.displacement_m(), endless.margin_m()), (1.2, f64::INFINITY));
}

#[test]
fn nonsense_is_refused() {
    let some = capacity(0.0, 1.0);
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        assert!(Rule::EqualEnergy.demand(&some, bad).is_err());
        assert!(Rule::EqualEnergy.zero_stiffness_demand_m(&some, bad).is_err());
        assert!(Rule::EqualEnergy.required_capacity_m(bad, 0.0, 2.0).is_err());
        assert!(Rule::EqualEnergy.required_capacity_m(1.0, 0.0, bad).is_err());
        assert!(Capacity::new(bad, 1.0).is_err());
    }
    assert!(Rule::EqualEnergy.required_capacity_m(1.0, 0.0, 0.99).is_err());
    assert_eq!(
        Rule::EqualEnergy.zero_stiffness_demand_m(&some, 1.1),
        Err(StructureError::DemandAboveCapacity { demand_m: 1.1, capacity_m: 1.0 })
    );
    assert!(Capacity::new(1.0, 1.0).is_err() && Capacity::new(0.0, f64::NAN).is_err());
}

/// Rows of Tables 3.2 to 3.7: value by quantity, by record set and scaling, by rule.
type Tables = BTreeMap<String, BTreeMap<(String, String), BTreeMap<String, f64>>>;

fn tables() -> Tables {
    let text = include_str!("../../../tests/reference/tables_3_2_to_3_7.csv");
    let mut tables = Tables::new();
    for line in text.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let [rule, set, scaling, quantity, value] = line.split(',').collect::<Vec<_>>()[..] else { panic!("{line}") };
        let cell = tables.entry(rule.to_owned()).or_default().entry((set.to_owned(), scaling.to_owned())).or_default();
        cell.insert(quantity.to_owned(), value.parse().unwrap());
    }
    tables
}

#[test]
fn printed_tables_of_the_design_example() {
    let tables = tables();
    let own = capacity(0.0005, 1.6);
    let mut cells = 0;
    for (key, displacement) in &tables["ED"] {
        let energy = &tables["EE"][key];
        // the printed ZSBE demand is rounded to a millimetre: design with both ends of what it may have been
        let z = [displacement["u_dem_rule_m"] - 0.0005, displacement["u_dem_rule_m"] + 0.0005];
        for (rule, printed) in [(Rule::EqualDisplacement, displacement), (Rule::EqualEnergy, energy)] {
            let [low, high] = z.map(|z| design(&own, rule, 2.5, z).unwrap());
            let within = |found: [f64; 2], printed: f64, rounding: f64| {
                let least = found[0].min(found[1]);
                let most = found[0].max(found[1]);
                least - rounding <= printed && printed <= most + rounding
            };
            assert!(within([low.capacity_m, high.capacity_m], printed["u_cap_m"], 0.0051), "{rule:?} {key:?} {low:?}");
            let demands = [low.demand.displacement_m(), high.demand.displacement_m()];
            assert!(within(demands, printed["u_dem_rule_m"], 0.000_51), "{rule:?} {key:?} {demands:?}");
            assert!(low.is_satisfied() && low.safety_factor() >= 2.5 - 1e-12);
            cells += 2;
        }
    }
    assert_eq!(cells, 72);
}

/// Work of the loading curve to a displacement, from its areas.
fn work(uplift: f64, slope: f64, displacement: f64) -> f64 {
    if displacement <= uplift {
        return 0.5 * displacement * displacement / uplift;
    }
    let beyond = displacement - uplift;
    0.5 * uplift + beyond * (1.0 + 0.5 * slope * beyond)
}

proptest! {
    #[test]
    fn equal_energy_is_equal_work(uplift in 1e-4_f64..0.5, range in 0.01_f64..100.0, share in 0.0_f64..1.0) {
        let capacity = capacity(uplift, uplift + range);
        let z = share * Rule::EqualEnergy.largest_zero_stiffness_demand_m(&capacity);
        let n = demand(Rule::EqualEnergy, &capacity, z);
        let (zero, negative) = (work(uplift, 0.0, z), work(uplift, -1.0 / range, n));
        prop_assert!((zero - negative).abs() <= 1e-12 * (1.0 + zero), "{} {}", zero, negative);
        // and it is Eq. 3.11 as printed, up to its own cancellation
        if z > uplift {
            let printed = capacity.capacity_m() - (range * (capacity.capacity_m() - 2.0 * z + uplift)).max(0.0).sqrt();
            prop_assert!((printed - n).abs() < 1e-6 * capacity.capacity_m());
        }
    }

    #[test]
    fn there_and_back(uplift in 0.0_f64..0.5, range in 0.01_f64..100.0, share in 0.0_f64..0.999, energy: bool) {
        let rule = if energy { Rule::EqualEnergy } else { Rule::EqualDisplacement };
        let capacity = capacity(uplift, uplift + range);
        let z = share * rule.largest_zero_stiffness_demand_m(&capacity);
        let n = demand(rule, &capacity, z);
        prop_assert!(n >= z && n <= capacity.capacity_m());
        let back = rule.zero_stiffness_demand_m(&capacity, n).unwrap();
        prop_assert!((back - z).abs() < 1e-12 * (1.0 + capacity.capacity_m()), "{} {}", z, back);
    }

    #[test]
    fn more_demand_is_more_and_more_capacity_is_less(
        uplift in 0.0_f64..0.1, range in 0.1_f64..10.0, wider in 1.0_f64..5.0, a in 0.0_f64..1.0, b in 0.0_f64..1.0,
    ) {
        let (narrow, wide) = (capacity(uplift, uplift + range), capacity(uplift, uplift + range * wider));
        let largest = Rule::EqualEnergy.largest_zero_stiffness_demand_m(&narrow);
        let (low, high) = (a.min(b) * largest, a.max(b) * largest);
        prop_assert!(demand(Rule::EqualEnergy, &narrow, low) <= demand(Rule::EqualEnergy, &narrow, high) + 1e-12);
        prop_assert!(demand(Rule::EqualEnergy, &wide, high) <= demand(Rule::EqualEnergy, &narrow, high) + 1e-12);
        prop_assert!(demand(Rule::EqualDisplacement, &narrow, high) <= demand(Rule::EqualEnergy, &narrow, high));
    }

    #[test]
    fn without_end_the_rules_agree(z in 0.0_f64..10.0, uplift in 0.0_f64..0.1, huge in 1e9_f64..1e300) {
        prop_assert_eq!(demand(Rule::EqualEnergy, &capacity(uplift, f64::INFINITY), z), z);
        prop_assert!((demand(Rule::EqualEnergy, &capacity(uplift, huge), z) - z).abs() < 1e-7);
    }

    #[test]
    fn the_required_capacity_has_the_safety_factor(
        z in 1e-6_f64..10.0, uplift in 0.0_f64..0.1, factor in 1.0_f64..10.0, energy: bool,
    ) {
        let rule = if energy { Rule::EqualEnergy } else { Rule::EqualDisplacement };
        let required = rule.required_capacity_m(z, uplift, factor).unwrap();
        prop_assume!(required > uplift * (1.0 + 1e-9) && factor > 1.000_001);
        let n = demand(rule, &capacity(uplift, required), z);
        prop_assert!((required / n / factor - 1.0).abs() < 1e-8, "{} {} {}", required, n, factor);
        // a larger capacity has a larger factor, a smaller one does not reach it
        let factor_of = |c: f64| Check::from_capacity(&capacity(uplift, c), rule, factor, z).unwrap();
        prop_assert!(factor_of(1.01 * required).is_satisfied());
        prop_assert!(factor_of(1.01 * required).safety_factor() > factor);
        if 0.99 * required > uplift {
            prop_assert!(!factor_of(0.99 * required).is_satisfied());
            prop_assert!(factor_of(0.99 * required).safety_factor() < factor);
        }
    }

    #[test]
    fn any_numbers_never_panic(numbers in prop::array::uniform4(any::<f64>())) {
        if let Ok(capacity) = Capacity::new(numbers[0], numbers[1]) {
            for rule in [Rule::EqualDisplacement, Rule::EqualEnergy] {
                if let Ok(demand) = rule.demand(&capacity, numbers[2].abs()) {
                    prop_assert!(!demand.displacement_m().is_nan());
                }
                let _ = rule.zero_stiffness_demand_m(&capacity, numbers[2].abs());
                let _ = design(&capacity, rule, numbers[3].abs(), numbers[2].abs());
            }
        }
    }
}
