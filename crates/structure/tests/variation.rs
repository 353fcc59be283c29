//! One quantity of a structure changed, and what stays (Table 3.1).

use uplift_structure::{EquivalentSystem, Kind, PostUpliftForce, Quantity, StructureDescription};

fn read(text: &str) -> StructureDescription {
    toml::from_str(text).unwrap()
}

fn capacity_m(system: &EquivalentSystem) -> f64 {
    system.capacity().unwrap().capacity_m()
}

fn near(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
}

const BLOCK: &str = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4.0\nmass_kg = 1000.0\n";
const PIER: &str = "kind = \"restrained-frame\"\ncolumns = 4\nwidth_m = 1.6\nheight_m = 9.6\ncolumn_mass_kg = 48000.0\n\
                    deck_mass_kg = 900000.0\ntendon_stiffness_n_m = 1.5e6\ntendon_anchorage = \"foundation\"\n";
const BODY: &str = "kind = \"body\"\nwidth_m = 1.0\ncentre_height_m = 3.0\nmass_kg = 9000.0\n\
                    moment_of_inertia_kg_m2 = 120000.0\n";

#[test]
fn at_its_own_value_a_structure_is_itself() {
    let kinds = [BLOCK, PIER, BODY].map(read);
    for description in kinds {
        let own = description.resolve().unwrap();
        for quantity in Quantity::ALL {
            if quantity == Quantity::TendonStiffness && description.kind != Kind::RestrainedFrame {
                let refused = quantity.varied(&description, 1e6).unwrap_err();
                assert!(refused[0].to_string().contains("has no tendons"), "{}", refused[0]);
                continue;
            }
            let value = quantity.value(&description).unwrap().unwrap();
            let same = quantity.varied(&description, value).unwrap();
            near(same.strength(), own.strength());
            near(capacity_m(&same), capacity_m(&own));
            near(same.participation(), own.participation());
            assert_eq!(same.conditions(), own.conditions());
        }
    }
}

#[test]
fn strength_and_capacity_leave_each_other_alone() {
    let block = read(BLOCK);
    let own = block.resolve().unwrap();
    let strong = Quantity::Strength.varied(&block, 0.45).unwrap();
    near(strong.strength(), 0.45);
    assert_eq!(capacity_m(&strong).to_bits(), capacity_m(&own).to_bits());
    let far = Quantity::Capacity.varied(&block, 1.7).unwrap();
    assert_eq!(
        (far.uplift_force_n(), far.post_uplift()),
        (own.uplift_force_n(), PostUpliftForce::Negative { capacity_m: 1.7 })
    );
}

#[test]
fn size_and_width_follow_table_3_1() {
    // row 4: f_up/(m g) = 3 α/2, capacity 2R sin α = 2b
    let block = read(BLOCK);
    let alpha = 0.2_f64.atan();
    let large = Quantity::Size.varied(&block, 5.0).unwrap();
    near(large.strength(), 1.5 * alpha);
    near(capacity_m(&large), 10.0 * alpha.sin());
    let wide = Quantity::Width.varied(&block, 1.2).unwrap();
    near(wide.strength(), 1.5 * 0.3_f64.atan());
    near(capacity_m(&wide), 1.2);
    // row 3: the inertia about the centre stays, I_o = I_c + m R²
    let body = read(BODY);
    let of = |half_width_m: f64| half_width_m * half_width_m + 9.0;
    let inertia = 120_000.0 + 9000.0 * (of(0.7) - of(0.5));
    let wide = Quantity::Width.varied(&body, 1.4).unwrap();
    near(wide.participation(), 9000.0 * of(0.7) / inertia);
    // all lengths alike: the same Γ and strength
    let (own, large) = (body.resolve().unwrap(), Quantity::Size.varied(&body, 2.0 * of(0.5).sqrt()).unwrap());
    near(large.participation(), own.participation());
    near(large.strength(), own.strength());
    near(capacity_m(&large), 2.0 * capacity_m(&own));
}

#[test]
fn tendons_give_the_capacity_they_were_asked_for() {
    let pier = read(PIER);
    let asked_m = 2.5;
    let stiffness_n_m = pier.tendon_stiffness_for_capacity_n_m(asked_m).unwrap().unwrap();
    near(capacity_m(&Quantity::TendonStiffness.varied(&pier, stiffness_n_m).unwrap()), asked_m);
}

#[test]
fn what_cannot_be_is_said() {
    let block = read(BLOCK);
    for quantity in [Quantity::Strength, Quantity::Size, Quantity::Width, Quantity::Capacity] {
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            // an infinite capacity is a force that stays, and no value to be found
            assert!(quantity.varied(&block, value).is_err(), "{} {value}", quantity.key());
        }
    }
    assert!(Quantity::Capacity.varied(&block, 1e-4).unwrap_err()[0].to_string().contains("not above"));
}
