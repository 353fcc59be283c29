//! Descriptions as written in TOML: what they resolve to, and every mistake said at once.

use uplift_structure::{
    Anchorage, Conditions, EquivalentSystem, Frame, Geometry, Kind, RestrainedFrame, StructureDescription,
};

fn resolved(text: &str) -> EquivalentSystem {
    toml::from_str::<StructureDescription>(text).unwrap().resolve().unwrap()
}

fn mistakes(text: &str) -> Vec<String> {
    let mistakes = toml::from_str::<StructureDescription>(text).unwrap().resolve().unwrap_err();
    mistakes.iter().map(ToString::to_string).collect()
}

const BRIDGE: &str = r#"
    kind = "restrained-frame"
    columns = 4
    width_m = 1.6
    height_m = 9.6
    column_mass_kg = 48000.0
    deck_mass_kg = 900000
    tendon_stiffness_n_m = 3.0e6
    tendon_anchorage = "foundation"
    uplift_displacement_m = 0.004
    gravity_m_s2 = 9.81
"#;

#[test]
fn a_description_is_its_constructor() {
    let columns = Geometry::from_width_and_height(1.6, 9.6).unwrap();
    let frame = Frame::new(columns, 4, 48_000.0, 900_000.0).unwrap();
    let conditions = Conditions::new(9.81, 0.004).unwrap();
    let expected = RestrainedFrame::new(frame, 3.0e6, Anchorage::Foundation).unwrap().equivalent(conditions).unwrap();
    assert_eq!(resolved(BRIDGE), expected);
    let column = BRIDGE.replace("foundation", "column");
    let capacity = |text: &str| resolved(text).capacity().unwrap().capacity_m();
    assert!(capacity(&column) < capacity(BRIDGE));
}

#[test]
fn every_way_to_say_the_same_geometry() {
    // α = atan 0.1 = 5.710593 degrees, R = √(0.5² + 5²) = 5.024938 m
    let ways = [
        "width_m = 1\nheight_m = 10",
        "slenderness_rad = 0.09966865249116203\nsize_m = 5.024937810560445",
        "slenderness_deg = 5.710593137499643\nheight_m = 10",
        "slenderness_rad = 0.09966865249116203\nwidth_m = 1",
    ];
    for way in ways {
        let top = resolved(&format!("kind = \"block\"\nmass_kg = 3\n{way}"));
        let centre = resolved(&format!("kind = \"block\"\nmass_kg = 3\ndisplacement_of = \"centre\"\n{way}"));
        assert!((top.capacity().unwrap().capacity_m() - 1.0).abs() < 1e-14, "{way}");
        assert!((top.spectral_strength() - 0.099_668_652_491_162).abs() < 1e-15, "{way}");
        assert_eq!((top.table_row(), top.mass_kg(), centre.table_row(), centre.mass_kg()), (4, 1.0, 2, 4.0));
    }
    let point = resolved("kind = \"point-mass\"\nmass_kg = 3\nwidth_m = 1\ncentre_height_m = 5");
    assert!((point.strength() - 0.099_668_652_491_162).abs() < 1e-15);
    assert_eq!(point.conditions(), Conditions::default());
}

#[test]
fn all_mistakes_at_once() {
    let found = mistakes(
        r#"
        kind = "frame"
        columns = 0
        width_m = -1.6
        height_m = 9.6
        column_mass_kg = nan
        mass_kg = 3.0
        tendon_anchorage = "column"
        displacement_of = "top"
        gravity_m_s2 = inf
    "#,
    );
    assert_eq!(
        found,
        [
            "`width_m` is -1.6 m: it must be from 0.001 to 1e6 m (in m, not in mm)",
            "`mass_kg` = 3 kg means nothing for kind \"frame\": remove it or choose another kind",
            "`columns` is 0: it must be from 1 to 1e6 (columns of one frame)",
            "`column_mass_kg` is NaN kg: it must be from 0 to 1e12 kg (in kg, not in t or N)",
            "`deck_mass_kg` is missing: kind \"frame\" needs it; give it in kg",
            "`gravity_m_s2` is inf m/s2: it must be from 0.1 to 2000 m/s2 (9.81 on Earth, 1.62 on the Moon; in m/s2, \
             not in cm/s2 or mm/s2)",
            "`displacement_of` = \"top\" means nothing for kind \"frame\": remove it or choose another kind",
            "`tendon_anchorage` = \"column\" means nothing for kind \"frame\": remove it or choose another kind",
        ]
    );
}

#[test]
fn geometries_that_do_not_determine_a_block() {
    let geometry = |lines: &str| mistakes(&format!("kind = \"block\"\nmass_kg = 1\n{lines}"));
    assert!(geometry("")[0].starts_with("the geometry is given by nothing: give `width_m` and `height_m`"));
    let over = geometry("width_m = 1\nheight_m = 10\nsize_m = 5");
    assert!(over[0].contains("`width_m` = 1 m, `height_m` = 10 m, `size_m` = 5 m"), "{over:?}");
    assert_eq!(geometry("slenderness_rad = 0.1\nslenderness_deg = 5\nsize_m = 5").len(), 1);
    assert_eq!(geometry("slenderness_deg = 0.1").len(), 1);
    // a range and a choice are both said
    assert_eq!(geometry("slenderness_deg = 95").len(), 2);
    // the height of the body is not that of the centre: it does not belong here, and then the height is missing
    let body = mistakes("kind = \"body\"\nmass_kg = 1\nmoment_of_inertia_kg_m2 = 99\nwidth_m = 1\nheight_m = 10");
    assert_eq!(body.len(), 2);
    assert!(body[1].starts_with("the geometry is given by `width_m` = 1 m: "), "{body:?}");
    assert!(
        body[0].starts_with("`height_m` = 10 m means nothing for kind \"body\"")
            && body[1].contains("`centre_height_m`")
    );
}

#[test]
fn mistakes_between_quantities_are_said_too() {
    let massless = BRIDGE.replace("48000.0", "0").replace("900000", "0");
    assert_eq!(
        mistakes(&massless),
        ["`column_mass_kg` and `deck_mass_kg` are both 0 kg: at least one must be positive"]
    );
    let soft = BRIDGE.replace("0.004", "9.5");
    assert!(mistakes(&soft)[0].contains("is not above `uplift_displacement_m` = 9.5 m"), "{:?}", mistakes(&soft));
    let loose = BRIDGE.replace("tendon_anchorage = \"foundation\"", "");
    assert!(mistakes(&loose)[0].starts_with("`tendon_anchorage` is missing"));
}

#[test]
fn a_stiff_tendon_raises_a_warning() {
    let stiff = resolved(&BRIDGE.replace("3.0e6", "3.0e8"));
    assert!(stiff.warnings()[0].to_string().contains("positive"), "{:?}", stiff.warnings());
}

#[test]
fn unknown_words_are_refused_by_name() {
    let refused = |text: &str| toml::from_str::<StructureDescription>(text).unwrap_err().to_string();
    assert!(refused("kind = \"block\"\nwidht_m = 1").contains("widht_m"));
    assert!(refused("kind = \"wall\"").contains("restrained-frame"));
    assert!(refused("kind = \"frame\"\ncolumns = -1").contains("columns"));
    assert!(refused("width_m = 1").contains("kind"));
    for kind in [Kind::PointMass, Kind::Block, Kind::Body, Kind::Frame, Kind::RestrainedFrame, Kind::CurvedFrame] {
        // the name in messages is the name in files; what is missing is said for each kind, and nothing panics
        let text = format!("kind = \"{}\"", kind.name());
        assert_eq!(toml::from_str::<StructureDescription>(&text).unwrap().kind, kind);
        assert!(mistakes(&text).len() >= 2);
    }
}

// A spectrum counts strength in multiples of its own gravity; the force per mass at which the oscillator
// uplifts is one and the same.
#[test]
fn strength_in_a_spectrum_of_another_gravity() {
    let text = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 8000\ngravity_m_s2 = 1.62\n";
    let block = toml::from_str::<StructureDescription>(text).unwrap().resolve().unwrap();
    let force_m_s2 = block.spectral_oscillator(0.9).unwrap().uplift_acceleration_m_s2();
    for gravity_m_s2 in [1.62, 9.81] {
        let read_at = block.spectral_strength_at(gravity_m_s2);
        assert!((read_at * gravity_m_s2 / force_m_s2 - 1.0).abs() < 1e-14, "{read_at}");
    }
    assert_eq!(block.spectral_strength_at(1.62), block.spectral_strength());
}

/// The names of what is unlikely in a description.
fn unlikely(text: &str) -> Vec<&'static str> {
    let description: StructureDescription = toml::from_str(text).unwrap();
    description.resolve().unwrap();
    description.unlikely().iter().map(|found| found.name).collect()
}

#[test]
fn numbers_in_other_units_are_accepted_and_reported() {
    // centimetres and tonnes
    let pier = "kind = \"block\"\nwidth_m = 40\nheight_m = 220\nmass_kg = 145\n";
    assert_eq!(unlikely(pier), ["width_m", "height_m", "mass_kg over width² × height"]);
    // of a block its width is the capacity: no mountain of concrete is satisfied without a question
    let mountain = "kind = \"block\"\nwidth_m = 80\nheight_m = 120\nmass_kg = 900e6\n";
    assert_eq!(unlikely(mountain), ["width_m"]);
    let block = "kind = \"block\"\nwidth_m = 0.8\nheight_m = 4\nmass_kg = 8000\n";
    assert_eq!(unlikely(block), [""; 0]);
    // a pier of 560 t, in tonnes; and one whose period is that of its rocking
    let pier = |mass: &str, period: &str| {
        format!(
            "kind = \"body\"\nwidth_m = 4\ncentre_height_m = 9\nmass_kg = {mass}\nmoment_of_inertia_kg_m2 = 57.55e6\n\
             period_s = {period}\n"
        )
    };
    assert_eq!(unlikely(&pier("560900", "0.6")), [""; 0]);
    assert_eq!(unlikely(&pier("560.9", "0.6")), ["moment_of_inertia_kg_m2 over mass_kg × R²"]);
    assert_eq!(unlikely(&pier("560900", "5")), ["period_s"]);
    for (key, value) in [("uplift_displacement_m", 0.5), ("gravity_m_s2", 981.0), ("restitution", 0.05)] {
        assert_eq!(unlikely(&format!("{block}{key} = {value}\n")), [key]);
    }
    // the same frame, with tendons that leave 0.2 rad and that leave 0.42
    let frame = |stiffness_n_m: f64| {
        format!(
            "kind = \"restrained-frame\"\ncolumns = 4\nwidth_m = 1.6\nheight_m = 9.6\ncolumn_mass_kg = 48000\n\
             deck_mass_kg = 900000\ntendon_anchorage = \"foundation\"\ntendon_stiffness_n_m = {stiffness_n_m}\n"
        )
    };
    assert_eq!(unlikely(&frame(1.5e6)), [""; 0]);
    // the deck alone in tonnes
    let light = frame(1.5e6).replace("deck_mass_kg = 900000", "deck_mass_kg = 900");
    assert_eq!(unlikely(&light), ["deck_mass_kg over the mass of the columns"]);
    assert_eq!(unlikely(&frame(1.5e6).replace("= 900000", "= 9700")), [""; 0]);
    let description: StructureDescription = toml::from_str(&frame(5.6e6)).unwrap();
    let found = description.unlikely();
    let [rotation] = &found[..] else { panic!("{found:?}") };
    assert!(rotation.name.contains("rotation") && rotation.value > 0.3, "{rotation}");
}
