//! Every row of Table 3.1 against numbers worked out by hand, with g = 10 m/s², and the limits between rows.

use proptest::prelude::*;
use uplift_structure::{
    Anchorage, Block, Body, Conditions, CurvedFrame, EquivalentSystem, Frame, Geometry, PointMass, PostUpliftForce,
    Reference, RestrainedFrame, StructureError, Warning,
};

fn rigid() -> Conditions {
    Conditions::new(10.0, 0.0).unwrap()
}

/// R = 5 m, α = 0.1: R sin α = 5 · 0.099 833 416 65 = 0.499 167 083 m.
fn block_geometry() -> Geometry {
    Geometry::from_slenderness_and_size(0.1, 5.0).unwrap()
}

/// Two columns of 300 kg, α = 0.1, 2b = 1 m, under 900 kg: γ = 900/600 = 1.5.
fn frame() -> Frame {
    Frame::new(Geometry::from_slenderness_and_width(0.1, 1.0).unwrap(), 2, 300.0, 900.0).unwrap()
}

fn assert_close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{found} is not {expected}");
}

fn assert_system(system: &EquivalentSystem, mass: f64, force: f64, capacity: f64, participation: f64, strength: f64) {
    assert_close(system.mass_kg(), mass);
    assert_close(system.uplift_force_n(), force);
    assert_close(system.capacity().unwrap().capacity_m(), capacity);
    assert_close(system.participation(), participation);
    assert_close(system.strength(), strength);
}

#[test]
fn row_1_point_mass() {
    // m = 1000 kg: m g α = 1000 · 10 · 0.1 = 1000 N; η = 0.1
    let system = PointMass::new(block_geometry(), 1000.0).unwrap().equivalent(rigid()).unwrap();
    assert_eq!(system.table_row(), 1);
    assert_system(&system, 1000.0, 1000.0, 0.499_167_083_234_140_8, 1.0, 0.1);
    // stiffness: −1000/0.499167 = −2003.337 N/m
    assert_close(system.post_uplift_stiffness_n_m(), -1000.0 / 0.499_167_083_234_140_8);
}

#[test]
fn row_2_block_at_its_centre() {
    // 4/3 · 1000 = 1333.33 kg; η = 1000/13333.3 = 0.075
    let block = Block::new(block_geometry(), 1000.0).unwrap();
    let system = block.equivalent(Reference::Centre, rigid()).unwrap();
    assert_eq!(system.table_row(), 2);
    assert_system(&system, 4000.0 / 3.0, 1000.0, 0.499_167_083_234_140_8, 0.75, 0.075);
}

#[test]
fn row_3_body_of_given_inertia() {
    // I_o = 30 000 kg m²: I_o/R² = 1200 kg; Γ = 25 000/30 000 = 5/6; η = 1000/12 000 = 1/12
    let system = Body::new(block_geometry(), 1000.0, 30_000.0).unwrap().equivalent(rigid()).unwrap();
    assert_eq!(system.table_row(), 3);
    assert_system(&system, 1200.0, 1000.0, 0.499_167_083_234_140_8, 5.0 / 6.0, 1.0 / 12.0);
}

#[test]
fn row_4_block_at_its_top() {
    // 1000/3 kg; 1000 · 10 · 0.1/2 = 500 N; 2R sin α = 0.998334 m; η = 500/3333.3 = 0.15
    let system = Block::new(block_geometry(), 1000.0).unwrap().equivalent(Reference::Top, rigid()).unwrap();
    assert_eq!(system.table_row(), 4);
    assert_system(&system, 1000.0 / 3.0, 500.0, 0.998_334_166_468_281_5, 1.5, 0.15);
}

#[test]
fn row_5_free_frame() {
    // (1 + 4.5) · 2 · 300/3 = 1100 kg; 2 · 300 · 10/2 · (1 + 3) · 0.1 = 1200 N; 3 · 4/(2 · 5.5) =
    // 12/11; η = 1200/11 000
    let system = frame().equivalent(rigid()).unwrap();
    assert_eq!(system.table_row(), 5);
    assert_system(&system, 1100.0, 1200.0, 1.0, 12.0 / 11.0, 12.0 / 110.0);
}

#[test]
fn row_5_restrained_frame() {
    let restrained = |k, anchorage| RestrainedFrame::new(frame(), k, anchorage).unwrap().equivalent(rigid()).unwrap();
    // anchored in the foundation: κ = 2 · 2 · 30 000 · 0.5 · 0.1/(1200 · 10) = 1/2, so 2b/(1 − 1/2) = 2 m
    assert_system(&restrained(30_000.0, Anchorage::Foundation), 1100.0, 1200.0, 2.0, 12.0 / 11.0, 12.0 / 110.0);
    // within the column: κ = 1/8, so 1/(7/8) = 8/7 m, and −1200/(8/7) = −1050 N/m
    let in_column = restrained(30_000.0, Anchorage::Column);
    assert_system(&in_column, 1100.0, 1200.0, 8.0 / 7.0, 12.0 / 11.0, 12.0 / 110.0);
    assert_close(in_column.post_uplift_stiffness_n_m(), -1050.0);
    // four times the stiffness within the column does what one does in the foundation
    assert_close(restrained(120_000.0, Anchorage::Column).capacity().unwrap().capacity_m(), 2.0);
    // κ = 2: the force rises as much as it would have fallen, 1200 N/1 m
    let stiff = restrained(120_000.0, Anchorage::Foundation);
    let PostUpliftForce::Positive { stiffness_n_m } = stiff.post_uplift() else { panic!("{:?}", stiff.post_uplift()) };
    assert_close(stiffness_n_m, 1200.0);
    assert_eq!(stiff.warnings(), [Warning::PositiveStiffness { stiffness_n_m }]);
    assert_eq!(stiff.capacity(), Err(StructureError::PositiveStiffness { stiffness_n_m }));
    assert_close(stiff.restoring_force_n(-0.5), -1800.0);
    // with u_up = 0.5 m Eq. 3.2 passes through u_cap = −1 m: 1200/(0.5 + 1) = 800 N/m, and 1200 + 800 · 0.5 N at 1 m
    let soft = Conditions::new(10.0, 0.5).unwrap();
    let stiff = RestrainedFrame::new(frame(), 120_000.0, Anchorage::Foundation).unwrap().equivalent(soft).unwrap();
    assert_close(stiff.post_uplift_stiffness_n_m(), 800.0);
    assert_close(stiff.restoring_force_n(1.0), 1600.0);
}

#[test]
fn critical_stiffness_is_the_zero_stiffness_system() {
    // k_crit = (1 + 2γ) m g/(4 b α) = 4 · 300 · 10/(4 · 0.5 · 0.1) = 60 000 N/m, and four times that within the column
    let (foundation, column) = (Anchorage::Foundation, Anchorage::Column);
    assert_close(frame().critical_tendon_stiffness_n_m(foundation, rigid()), 60_000.0);
    assert_close(frame().critical_tendon_stiffness_n_m(column, rigid()), 240_000.0);
    let k = frame().critical_tendon_stiffness_n_m(column, rigid());
    let system = RestrainedFrame::new(frame(), k, column).unwrap().equivalent(rigid()).unwrap();
    assert_eq!((system.post_uplift(), system.warnings()), (PostUpliftForce::Zero, &[Warning::ZeroStiffness][..]));
    assert_eq!(system.capacity().unwrap().capacity_m(), f64::INFINITY);
    assert_eq!((system.post_uplift_stiffness_n_m(), system.restoring_force_n(7.0)), (0.0, 1200.0));
}

#[test]
fn row_5_as_printed_up_to_the_slenderness_squared() {
    // EA = 2h k_res; 2b/(1 − EA α²/((½ + γ) m g)) differs from ours by h α against b
    let k = 30_000.0;
    let geometry = *frame().geometry();
    let axial_stiffness = k * geometry.height_m();
    let printed = 2.0 / (2.0 - axial_stiffness / 3000.0 * 0.01) * geometry.width_m();
    let ours = RestrainedFrame::new(frame(), k, Anchorage::Foundation).unwrap().equivalent(rigid()).unwrap();
    assert!((printed / ours.capacity().unwrap().capacity_m() - 1.0).abs() < 0.01);
}

#[test]
fn row_6_curved_ends() {
    // 2b = 1 m, 2h = 10 m, r = 2.5 m: ρ = 1/4, 2b/(1 − 1/2) = 2 m; (300 + 900) · 10 · atan 0.1 = 12 000 ·
    // 0.0996687 = 1196.024 N
    let frame = Frame::new(Geometry::from_width_and_height(1.0, 10.0).unwrap(), 2, 300.0, 900.0).unwrap();
    let curved = CurvedFrame::new(frame, 2.5, 2.4).unwrap();
    let system = curved.equivalent(rigid()).unwrap();
    assert_eq!((system.table_row(), curved.radius_ratio(), system.warnings()), (6, 0.25, &[][..]));
    assert_system(&system, 1100.0, 1_196.023_829_893_94, 2.0, 12.0 / 11.0, 0.099_668_652_491_162 * 12.0 / 11.0);

    // extended to 1.5 m only: rolling ends at 10 asin(0.25/2.5) = 1.001674 m, the base overturns at 1.5 m
    let short = CurvedFrame::new(frame, 2.5, 1.5).unwrap().equivalent(rigid()).unwrap();
    assert_eq!(short.capacity().unwrap().capacity_m(), 1.5);
    let [Warning::ExtensionEnds { rolling_until_m, rolling_capacity_m, overturning_m }] = *short.warnings() else {
        panic!("{:?}", short.warnings())
    };
    assert_close(rolling_until_m, 1.001_674_211_615_598);
    assert_eq!((rolling_capacity_m, overturning_m), (2.0, 1.5));

    // r = h: rolling without softening until the extension ends
    let neutral = CurvedFrame::new(frame, 5.0, 2.0).unwrap();
    assert_eq!(neutral.rolling_capacity_m(), f64::INFINITY);
    let system = neutral.equivalent(rigid()).unwrap();
    assert_eq!((system.capacity().unwrap().capacity_m(), system.warnings().len()), (2.0, 1));
}

#[test]
fn rows_meet_at_their_limits() {
    let conditions = Conditions::new(10.0, 0.001).unwrap();
    let same = |a: &EquivalentSystem, b: &EquivalentSystem| {
        assert_system(
            a,
            b.mass_kg(),
            b.uplift_force_n(),
            b.capacity().unwrap().capacity_m(),
            b.participation(),
            b.strength(),
        );
    };
    let geometry = block_geometry();
    let block = Block::new(geometry, 1000.0).unwrap();
    let mass_r2 = 1000.0 * 25.0;
    // row 3 is row 2 for the rectangle and row 1 for the point
    let body = |inertia| Body::new(geometry, 1000.0, inertia).unwrap().equivalent(conditions).unwrap();
    same(&body(4.0 / 3.0 * mass_r2), &block.equivalent(Reference::Centre, conditions).unwrap());
    same(&body(mass_r2), &PointMass::new(geometry, 1000.0).unwrap().equivalent(conditions).unwrap());
    // row 5 without a deck is row 4 for the mass of all columns
    let columns = Frame::new(geometry, 4, 250.0, 0.0).unwrap();
    same(&columns.equivalent(conditions).unwrap(), &block.equivalent(Reference::Top, conditions).unwrap());
    // row 5 with massless columns is row 1 of twice the size: the deck turns about the columns' far corners
    let deck = Frame::new(geometry, 4, 0.0, 1000.0).unwrap().equivalent(conditions).unwrap();
    let twice = Geometry::from_slenderness_and_size(0.1, 10.0).unwrap();
    same(&deck, &PointMass::new(twice, 1000.0).unwrap().equivalent(conditions).unwrap());
    assert_close(deck.participation(), 1.0);
    // no stiffness and no curvature leave the free frame
    let free = frame().equivalent(conditions).unwrap();
    for anchorage in [Anchorage::Foundation, Anchorage::Column] {
        let slack = RestrainedFrame::new(frame(), 0.0, anchorage).unwrap().equivalent(conditions).unwrap();
        assert_eq!(slack, free);
    }
    let sharp = CurvedFrame::new(frame(), 0.0, frame().geometry().width_m()).unwrap().equivalent(conditions).unwrap();
    same(&sharp, &free);
    assert_eq!(sharp.warnings(), []);
}

#[test]
fn impossible_structures_are_refused() {
    let geometry = block_geometry();
    assert_eq!(Frame::new(geometry, 2, 0.0, 0.0), Err(StructureError::Massless));
    assert!(matches!(Frame::new(geometry, 0, 1.0, 0.0), Err(StructureError::OutOfRange { key: "columns", .. })));
    let inertia_about_centre = 1000.0 * 25.0 / 3.0;
    let refused = Body::new(geometry, 1000.0, inertia_about_centre);
    assert!(
        matches!(refused, Err(StructureError::InertiaBelowPointMass { least_kg_m2, .. }) if least_kg_m2 > 24_999.0)
    );
    let refused = Body::new(geometry, 1234.5678, 1.0).unwrap_err().to_string();
    assert!(refused.contains("below m R² = 30860 kg m²"), "{refused}");
    // R sin α = 0.499 m does not reach an uplift displacement of 0.5 m, 2R sin α does
    let soft = Conditions::new(10.0, 0.5).unwrap();
    let block = Block::new(geometry, 1000.0).unwrap();
    assert!(matches!(block.equivalent(Reference::Centre, soft), Err(StructureError::CapacityBelowUplift { .. })));
    assert!(block.equivalent(Reference::Top, soft).is_ok());
    // an extension narrower than the base, or wider than its arcs can reach
    for width in [0.9, 1.0 + 2.0 * 0.2 + 0.01] {
        assert!(matches!(CurvedFrame::new(frame(), 0.2, width), Err(StructureError::Extension { .. })), "{width}");
    }
    for bad in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
        assert!(Geometry::from_width_and_height(bad, 1.0).is_err());
        assert!(Geometry::from_slenderness_and_size(bad, 1.0).is_err());
        assert!(Geometry::from_slenderness_and_height(0.1, bad).is_err());
        assert!(Block::new(geometry, bad).is_err());
        assert!(Conditions::new(bad, 0.0).is_err());
    }
}

#[test]
fn a_stocky_body_raises_a_warning() {
    // α = 0.5: (0.546302 − 0.5)/0.546302 = 8.48 %; α = 0.3: (0.309336 − 0.3)/0.309336 = 3.02 %
    let warnings = |slenderness| {
        let geometry = Geometry::from_slenderness_and_size(slenderness, 5.0).unwrap();
        Block::new(geometry, 1.0).unwrap().equivalent(Reference::Top, rigid()).unwrap().warnings().to_vec()
    };
    let stocky = warnings(0.5);
    let is_8_5_percent = |error: f64| (error - 0.0848).abs() < 5e-5;
    assert!(matches!(stocky[..], [Warning::Stocky { linearisation_error, .. }] if is_8_5_percent(linearisation_error)));
    assert!(stocky[0].to_string().contains("8.5 %"), "{}", stocky[0]);
    assert!(warnings(0.3).is_empty());
}

#[test]
fn a_static_analysis_replaces_the_loop() {
    let system = Block::new(block_geometry(), 1000.0).unwrap().equivalent(Reference::Top, rigid()).unwrap();
    let soft = system.with_static_analysis(450.0, 0.02, 0.9).unwrap();
    assert_system(&soft, 1000.0 / 3.0, 450.0, 0.9, 1.5, 0.135);
    // −450/0.88 = −511.36 N/m; half way up the elastic branch 225 N
    assert_close(soft.post_uplift_stiffness_n_m(), -511.363_636_363_636_4);
    assert_close(soft.restoring_force_n(-0.01), -225.0);
    assert!(system.with_static_analysis(450.0, 0.02, 0.02).is_err());
    assert_eq!(system.with_static_analysis(450.0, 0.02, f64::INFINITY).unwrap().post_uplift(), PostUpliftForce::Zero);
}

/// All six rows for one geometry.
fn all_rows(length: f64, mass: f64, slenderness: f64, stiffness: f64, conditions: Conditions) -> Vec<EquivalentSystem> {
    let geometry = Geometry::from_slenderness_and_size(slenderness, 5.0 * length).unwrap();
    let frame = Frame::new(geometry, 3, 400.0 * mass, 700.0 * mass).unwrap();
    let block = Block::new(geometry, 1000.0 * mass).unwrap();
    let inertia = 28_000.0 * mass * length * length;
    let radius = 0.3 * geometry.height_m();
    vec![
        PointMass::new(geometry, 1000.0 * mass).unwrap().equivalent(conditions).unwrap(),
        block.equivalent(Reference::Centre, conditions).unwrap(),
        Body::new(geometry, 1000.0 * mass, inertia).unwrap().equivalent(conditions).unwrap(),
        block.equivalent(Reference::Top, conditions).unwrap(),
        RestrainedFrame::new(frame, stiffness * mass / length, Anchorage::Column)
            .unwrap()
            .equivalent(conditions)
            .unwrap(),
        CurvedFrame::new(frame, radius, geometry.width_m() + radius).unwrap().equivalent(conditions).unwrap(),
    ]
}

proptest! {
    #[test]
    fn lengths_scale_the_capacity_and_leave_the_strength(
        length in 0.01_f64..100.0, mass in 0.01_f64..1e6, slenderness in 0.01_f64..0.5, stiffness in 0.0_f64..1e5,
    ) {
        let unit = all_rows(1.0, 1.0, slenderness, stiffness, Conditions::new(9.81, 0.0).unwrap());
        let scaled = all_rows(length, mass, slenderness, stiffness, Conditions::new(9.81, 0.0).unwrap());
        for (a, b) in unit.iter().zip(&scaled) {
            prop_assert!((b.strength() / a.strength() - 1.0).abs() < 1e-12);
            prop_assert!((b.participation() / a.participation() - 1.0).abs() < 1e-12);
            prop_assert!((b.mass_kg() / a.mass_kg() / mass - 1.0).abs() < 1e-12);
            // of positive and negative slopes alike; near the critical stiffness the difference of nearly
            // equal numbers loses digits
            let slope = |system: &EquivalentSystem| system.post_uplift_stiffness_n_m() / system.uplift_force_n();
            prop_assert!((slope(b) * length - slope(a)).abs() < 1e-10 / slenderness);
        }
    }

    #[test]
    fn every_row_uplifts_when_the_ground_reaches_the_slenderness(
        slenderness in 0.01_f64..0.5, stiffness in 0.0_f64..1e5,
    ) {
        for system in all_rows(1.0, 1.0, slenderness, stiffness, Conditions::new(9.81, 0.0).unwrap()) {
            prop_assert!((system.spectral_strength() / slenderness - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn tendons_found_for_a_capacity_give_it(ratio in 1.0_f64..50.0, deck in 0.0_f64..1e6, foundation: bool) {
        let anchorage = if foundation { Anchorage::Foundation } else { Anchorage::Column };
        let conditions = Conditions::default();
        let frame = Frame::new(Geometry::from_width_and_height(1.6, 9.6).unwrap(), 4, 48_000.0, deck).unwrap();
        let capacity = 1.6 * ratio;
        let k = frame.tendon_stiffness_for_capacity_n_m(capacity, anchorage, conditions).unwrap();
        let system = RestrainedFrame::new(frame, k, anchorage).unwrap().equivalent(conditions).unwrap();
        prop_assert!((system.capacity().unwrap().capacity_m() / capacity - 1.0).abs() < 1e-12);
        prop_assert_eq!(frame.tendon_stiffness_for_capacity_n_m(1.6 / ratio, anchorage, conditions).unwrap(), 0.0);
    }

    #[test]
    fn extreme_numbers_never_panic(
        lengths in prop::array::uniform4(any::<f64>()), masses in prop::array::uniform3(any::<f64>()), columns: u32,
    ) {
        let Ok(conditions) = Conditions::new(9.81, lengths[2].abs()) else { return Ok(()) };
        let Ok(geometry) = Geometry::from_width_and_height(lengths[0].abs(), lengths[1].abs()) else { return Ok(()) };
        let mut systems = vec![];
        let block = Block::new(geometry, masses[0].abs());
        systems.push(block.and_then(|block| block.equivalent(Reference::Top, conditions)));
        let body = Body::new(geometry, masses[0].abs(), masses[1].abs());
        systems.push(body.and_then(|body| body.equivalent(conditions)));
        if let Ok(frame) = Frame::new(geometry, columns, masses[0].abs(), masses[1].abs()) {
            let restrained = RestrainedFrame::new(frame, masses[2].abs(), Anchorage::Column);
            systems.push(restrained.and_then(|frame| frame.equivalent(conditions)));
            let curved = CurvedFrame::new(frame, lengths[2].abs(), lengths[3].abs());
            systems.push(curved.and_then(|frame| frame.equivalent(conditions)));
        }
        for system in systems.into_iter().flatten() {
            prop_assert!(system.strength() > 0.0 && system.strength().is_finite());
            prop_assert!(!system.post_uplift_stiffness_n_m().is_nan());
        }
    }
}
