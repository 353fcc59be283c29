//! Stacks out of a catalogue, and stoppers.

use uplift_statics::selection::{select, stopper_yield_force_n};
use uplift_statics::{
    CatalogueDisc, DiscDimensions, Limits, Parts, Ranking, RestrainedColumns, Restrainer, Target, Tendon,
};
use uplift_structure::Geometry;

use crate::hand_solutions::stack;

fn disc(name: &str, [outer, inner, thickness, cone]: [f64; 4], price: Option<f64>) -> CatalogueDisc {
    let dimensions = DiscDimensions {
        outer_diameter_m: 1e-3 * outer,
        inner_diameter_m: 1e-3 * inner,
        thickness_m: 1e-3 * thickness,
        cone_height_m: 1e-3 * cone,
        reduced_thickness_m: None,
    };
    CatalogueDisc::new(name.to_owned(), dimensions, None, price).unwrap()
}

/// The discs of the two specimens between others.
fn catalogue() -> Vec<CatalogueDisc> {
    vec![
        disc("100/51/6", [100.0, 51.0, 6.0, 2.2], Some(3.0)),
        disc("125/61/6", [125.0, 61.0, 6.0, 3.6], Some(5.0)),
        disc("125/64/5", [125.0, 64.0, 5.0, 3.5], None),
        disc("200/92/10", [200.0, 92.0, 10.0, 5.6], Some(20.0)),
        disc("200/102/5", [200.0, 102.0, 5.0, 7.6], None),
    ]
}

fn tendon(length_m: f64) -> Tendon {
    Tendon { stiffness_n_m: 190e9 * 150e-6 / length_m, yield_n: Some(150e-6 * 1590e6), failure_n: None }
}

/// Section 5.3.3: 2302 kN/m where the column has travelled by 4b; 11 × 200/92/10 is one of the answers.
#[test]
fn the_stack_of_the_column() {
    let geometry = Geometry::from_width_and_height(0.2578, 1.45).unwrap();
    let column = RestrainedColumns::new(geometry, 1, 52.2e3, 1.89e3).unwrap();
    let limits = Limits::behind(tendon(2.352));
    let target = Target::Stiffness { stiffness_n_m: 2302e3, at_m: 0.5156 };
    let found = select(&column, &catalogue(), target, &limits, Ranking::Mass).unwrap();
    let ours: Vec<_> = found.iter().filter(|stack| stack.disc == "200/92/10" && stack.parallel == 1).collect();
    // lightest first: 11 discs, 7 % above the target, then 12 to 14 down to 10 % below
    assert_eq!(ours.iter().map(|stack| stack.springs).collect::<Vec<_>>(), [11, 12, 13, 14]);
    // whatever is flat before the force vanishes stands behind what has a capacity
    let last = found.iter().rposition(|stack| stack.capacity_m.is_some()).unwrap();
    assert!(found[..=last].iter().all(|stack| stack.capacity_m.is_some()), "{found:#?}");
    assert!((ours[0].miss - 0.0742).abs() < 0.01 && ours[0].capacity_m.unwrap() > 0.5156, "{:?}", ours[0]);
    // asked for the capacity itself, 11 is the softest of these discs that has it
    let target = Target::Capacity { capacity_m: 0.5156 };
    let found = select(&column, &catalogue(), target, &limits, Ranking::Target).unwrap();
    let first = found.iter().find(|stack| stack.disc == "200/92/10" && stack.parallel == 1).unwrap();
    assert_eq!(first.springs, 11);
    assert!((first.capacity_m.unwrap() - 0.530_583).abs() < 1e-3, "{first:?}");
    assert!(found.iter().all(|stack| stack.miss >= 0.0 && stack.disc != "200/102/5"));
}

/// Section 6.3.3: 1808 kN/m where the frame has travelled by 394 mm; 10 × 125/61/6 is among the stacks within 10 %.
#[test]
fn the_stack_of_the_frame() {
    let geometry = Geometry::from_width_and_height(0.197, 1.45).unwrap();
    let frame = RestrainedColumns::new(geometry, 4, 23_587.5, 1220.0).unwrap();
    let limits = Limits::behind(tendon(2.134));
    let target = Target::Stiffness { stiffness_n_m: 1808e3, at_m: 0.394 };
    let found = select(&frame, &catalogue(), target, &limits, Ranking::Target).unwrap();
    let ours: Vec<_> = found.iter().filter(|stack| stack.disc == "125/61/6" && stack.parallel == 1).collect();
    assert_eq!(ours.iter().map(|stack| stack.springs).collect::<Vec<_>>(), [9, 10, 8]);
    assert!((ours[1].miss + 0.06).abs() < 0.02, "{:?}", ours[1]);
    assert!(ours[1].stroke_share < 0.75 && ours[1].tendon_utilisation.unwrap() < 0.25, "{:?}", ours[1]);
    // what each limit takes away
    let count = |limits: &Limits| select(&frame, &catalogue(), target, limits, Ranking::Length).unwrap().len();
    assert_eq!(count(&Limits { largest_diameter_m: Some(0.05), ..limits }), 0);
    assert_eq!(count(&Limits { largest_length_m: Some(0.05), ..limits }), 0);
    assert_eq!(count(&Limits { largest_force_n: Some(10e3), ..limits }), 0);
    assert_eq!(count(&Limits { least_inner_diameter_m: Some(0.3), ..limits }), 0);
    assert_eq!(count(&Limits { stroke_share: 0.1, ..limits }), 0);
    assert_eq!(count(&Limits { tendon_factor: 50.0, ..limits }), 0);
    let wide = count(&limits);
    assert!(count(&Limits { tolerance: 0.02, ..limits }) < wide && wide > 2, "{wide}");
    // ranked by length and by price
    let by_length = select(&frame, &catalogue(), target, &limits, Ranking::Length).unwrap();
    assert!(by_length.windows(2).all(|pair| pair[0].length_m <= pair[1].length_m));
    let by_price = select(&frame, &catalogue(), target, &limits, Ranking::Price).unwrap();
    let prices: Vec<f64> = by_price.iter().map(|stack| stack.price.unwrap_or(f64::INFINITY)).collect();
    assert!(prices.windows(2).all(|pair| pair[0] <= pair[1]), "{prices:?}");
}

/// Zero and positive stiffness: the force at the travel asked for is that at uplift, or more.
#[test]
fn stiffnesses_by_their_sign() {
    let geometry = Geometry::from_width_and_height(0.197, 1.45).unwrap();
    let frame = RestrainedColumns::new(geometry, 4, 23_587.5, 1220.0).unwrap();
    let limits = Limits { stroke_share: 0.9, ..Limits::behind(tendon(2.134)) };
    let force_n = |stack: &uplift_statics::Candidate| {
        let held = frame.clone().with_restrainer(stack.restrainer.clone(), limits.path).unwrap();
        held.at_displacement(0.2).unwrap().force_n / frame.uplift_force_n()
    };
    let zero = select(&frame, &catalogue(), Target::ZeroStiffness { at_m: 0.2 }, &limits, Ranking::Target).unwrap();
    assert!(zero.iter().all(|stack| (force_n(stack) - 1.0).abs() < 0.15) && !zero.is_empty());
    let rising =
        select(&frame, &catalogue(), Target::PositiveStiffness { at_m: 0.2 }, &limits, Ranking::Target).unwrap();
    assert!(rising.iter().all(|stack| force_n(stack) > 0.98) && !rising.is_empty());
}

#[test]
fn targets_that_cannot_be() {
    let geometry = Geometry::from_width_and_height(0.197, 1.45).unwrap();
    let frame = RestrainedColumns::new(geometry, 4, 23_587.5, 1220.0).unwrap();
    let limits = Limits::behind(tendon(2.134));
    let refused = |target, limits: &Limits, words: &str| {
        let message = select(&frame, &catalogue(), target, limits, Ranking::Target).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    };
    let target = Target::Stiffness { stiffness_n_m: 1808e3, at_m: 0.394 };
    refused(Target::Capacity { capacity_m: -1.0 }, &limits, "`capacity_m` is -1 m");
    refused(target, &Limits { tolerance: 0.0, ..limits }, "`tolerance` is 0");
    refused(target, &Limits { stroke_share: 1.5, ..limits }, "`stroke_share` is 1.5");
    refused(target, &Limits { most_parallel: 9, ..limits }, "`parallel` is 9");
    refused(Target::ZeroStiffness { at_m: 9.0 }, &limits, "beyond the column's reach");
}

/// A list in metres read as one in millimetres.
#[test]
fn discs_of_another_unit() {
    let dimensions = DiscDimensions {
        outer_diameter_m: 0.125e-3,
        inner_diameter_m: 0.061e-3,
        thickness_m: 0.006e-3,
        cone_height_m: 0.0036e-3,
        reduced_thickness_m: None,
    };
    let message = CatalogueDisc::new("tiny".to_owned(), dimensions, None, None).unwrap_err().to_string();
    assert!(message.contains("`outer_diameter_m` is 1.25e-4 m: it must be from 0.001 to 3 m"), "{message}");
}

/// Section 6.3.4: rods of 54 kN are well below what the tendon of 238.5 kN leaves behind springs of 31 kN.
#[test]
fn a_stopper_that_protects_the_tendon() {
    let law = Restrainer::new(Parts { tendon: Some(tendon(2.14)), ..Parts::discs(stack(), 1.0) }).unwrap();
    let most_n = stopper_yield_force_n(&law, 0.015, 2e9, 1.5).unwrap().unwrap();
    assert!((most_n + 31.1e3 - 238.5e3 / 1.5).abs() < 300.0 && most_n > 54e3, "{most_n}");
    assert_eq!(stopper_yield_force_n(&law, 0.015, 2e9, 10.0).unwrap(), None);
    let message = stopper_yield_force_n(&law, 0.05, 2e9, 1.5).unwrap_err().to_string();
    assert!(message.contains("it would never engage"), "{message}");
    let unknown = Restrainer::new(Parts::discs(stack(), 13e6)).unwrap();
    assert!(stopper_yield_force_n(&unknown, 0.015, 2e9, 1.5).is_err());
}
