//! The keys of a structure file, and what is read from them.

use serde_json::json;
use uplift_plausible::{CONCRETE_STRENGTH, UPLIFT_DISPLACEMENT};
use uplift_structure::{Allowed, Anchorage, Kind, Reference, StructureDescription};

use super::resolve::ReadStructure;
use super::{ColumnShape, restrainer};
use crate::keys::{self, Choice, Key, Number, SectionKeys, Special, choice, number, special};
use crate::reading::{Rule, Section};
use crate::sections::uncertainty;
use crate::shake_table::REST;

/// The keys of a structure file, section by section.
pub(crate) const KEYS: [SectionKeys; 6] = [
    SectionKeys::new(
        "",
        &[
            &KIND,
            &WIDTH_M,
            &HEIGHT_M,
            &CENTRE_HEIGHT_M,
            &SLENDERNESS_RAD,
            &SLENDERNESS_DEG,
            &SIZE_M,
            &MASS_KG,
            &MOMENT_OF_INERTIA_KG_M2,
            &DISPLACEMENT_OF,
            &COLUMNS,
            &COLUMN_MASS_KG,
            &DECK_MASS_KG,
            &TENDON_STIFFNESS_N_M,
            &TENDON_ANCHORAGE,
            &CURVATURE_RADIUS_M,
            &EXTENDED_WIDTH_M,
            &UPLIFT_DISPLACEMENT_M,
            &PERIOD_S,
            &GRAVITY_M_S2,
            &RESTITUTION,
            &COLUMN_SHAPE,
            &F_CD_PA,
            &REST_AMPLITUDE_RAD,
            &WOBBLING_RESTITUTION,
        ],
    ),
    restrainer::KEYS,
    restrainer::STOPPER_KEYS,
    uncertainty::KEYS,
    uncertainty::QUANTITY_KEYS,
    uncertainty::CORRELATION_KEYS,
];
const KIND: Key<Choice<Kind>> = choice("kind", &Kind::ALL, Kind::name).meaning("what kind of structure it is");
const WIDTH_M: Key<Number> = judged("width_m", "m").meaning("width 2b of the block or column, m");
const HEIGHT_M: Key<Number> = judged("height_m", "m").meaning("height 2h of the block or column, m");
const CENTRE_HEIGHT_M: Key<Number> = judged("centre_height_m", "m")
    .meaning("height h of the mass centre of a `point-mass` or a `body`, in place of `height_m`, m");
const SLENDERNESS_RAD: Key<Number> =
    judged("slenderness_rad", "rad").meaning("slenderness α with one length, in place of two lengths, rad");
const SLENDERNESS_DEG: Key<Number> =
    judged("slenderness_deg", "degrees").meaning("the same in degrees, in place of `slenderness_rad`");
const SIZE_M: Key<Number> =
    judged("size_m", "m").meaning("distance R from the pivot corner to the mass centre, with a slenderness, m");
const MASS_KG: Key<Number> = judged("mass_kg", "kg").meaning("mass of a `point-mass`, `block` or `body`, kg");
const MOMENT_OF_INERTIA_KG_M2: Key<Number> = judged("moment_of_inertia_kg_m2", "kg m2")
    .meaning("moment of inertia I_o of a `body` about the pivot corner, kg m²");
const DISPLACEMENT_OF: Key<Choice<Reference>> =
    choice("displacement_of", &[Reference::Top, Reference::Centre], |reference| match reference {
        Reference::Top => "top",
        Reference::Centre => "centre",
    })
    .without_default("`\"top\"`")
    .meaning("point of a `block` whose displacement is followed");
const COLUMNS: Key<Special> =
    special("columns", || json!({ "type": "integer", "minimum": 1, "maximum": uplift_plausible::COLUMNS.most }))
        .without_default("")
        .meaning("number of columns of a frame")
        .note("1 to 1e6");
const COLUMN_MASS_KG: Key<Number> = judged("column_mass_kg", "kg").meaning("mass of one column of a frame, kg");
const DECK_MASS_KG: Key<Number> = judged("deck_mass_kg", "kg").meaning("mass of the deck of a frame, kg");
const TENDON_STIFFNESS_N_M: Key<Number> = judged("tendon_stiffness_n_m", "N/m").meaning(
    "stiffness of the tendon and springs of one column of a `restrained-frame`, in series, N/m; or a table \
     `[restrainer]`",
);
const TENDON_ANCHORAGE: Key<Choice<Anchorage>> =
    choice("tendon_anchorage", &[Anchorage::Foundation, Anchorage::Column], |anchorage| match anchorage {
        Anchorage::Foundation => "foundation",
        Anchorage::Column => "column",
    })
    .without_default("")
    .meaning("where these tendons are anchored");
const CURVATURE_RADIUS_M: Key<Number> =
    judged("curvature_radius_m", "m").meaning("radius r of the curved ends of a `curved-frame`, m");
const EXTENDED_WIDTH_M: Key<Number> =
    judged("extended_width_m", "m").meaning("width 2b' of the end of such a column with its extensions, m");
const UPLIFT_DISPLACEMENT_M: Key<Number> = number("uplift_displacement_m", "m", Rule::Within(UPLIFT_DISPLACEMENT))
    .without_default("0.0005")
    .meaning("displacement at uplift u_up, m");
const PERIOD_S: Key<Number> =
    judged("period_s", "s").meaning("period T with closed joints, in place of `uplift_displacement_m`, s");
const GRAVITY_M_S2: Key<Number> =
    judged("gravity_m_s2", "m/s2").without_default("9.80665").meaning("acceleration of gravity, m/s²");
const RESTITUTION: Key<Number> = judged("restitution", "")
    .without_default("the study's for the oscillator, momentum's for a block or planar frame")
    .meaning("velocity after an impact divided by the one before");
const COLUMN_SHAPE: Key<Choice<ColumnShape>> =
    choice("column_shape", &[ColumnShape::Cylinder, ColumnShape::Rectangle], |shape| match shape {
        ColumnShape::Cylinder => "cylinder",
        ColumnShape::Rectangle => "rectangle",
    })
    .with_default(ColumnShape::Rectangle)
    .meaning("section of the columns");
const F_CD_PA: Key<Number> = number("f_cd_pa", "Pa", Rule::Within(CONCRETE_STRENGTH))
    .without_default("none")
    .meaning("design strength of the columns' concrete, Pa");
const REST_AMPLITUDE_RAD: Key<Number> = number("rest_amplitude_rad", "rad", REST)
    .without_default("1e-5")
    .meaning("tilt whose energy is that of a wobbling frame at rest, rad");
const WOBBLING_RESTITUTION: Key<Number> = number("wobbling_restitution", "", Rule::From(0.5, 1.0, "from 0.5 to 1"))
    .without_default("1, no loss")
    .meaning("velocity of a wobbling frame after passing the upright divided by the one before");

/// A number that the description judges.
const fn judged(name: &'static str, unit: &'static str) -> Key<Number> {
    keys::judged(name, unit, |key| match StructureDescription::allowed(key) {
        Some(Allowed::Plausible(range)) => Rule::Within(range),
        Some(Allowed::BelowQuarterTurn(quarter_turn, words)) => Rule::Between(0.0, quarter_turn, words),
        None => keys::ANY,
    })
}

/// Reads every key; none where the kind is missing or unknown. A value of the wrong type counts as not given.
pub(super) fn read(mut root: Section<'_>) -> Option<ReadStructure> {
    let help = format!("write kind = and one of \"{}\"", Kind::ALL.map(Kind::name).join("\", \""));
    let kind = root.read_needed(&KIND, "what kind of structure is this?", help);
    let mut number = |key: &Key<Number>| root.optional(key).flatten();
    let description = StructureDescription {
        kind: kind.unwrap_or(Kind::Block),
        width_m: number(&WIDTH_M),
        height_m: number(&HEIGHT_M),
        centre_height_m: number(&CENTRE_HEIGHT_M),
        slenderness_rad: number(&SLENDERNESS_RAD),
        slenderness_deg: number(&SLENDERNESS_DEG),
        size_m: number(&SIZE_M),
        mass_kg: number(&MASS_KG),
        moment_of_inertia_kg_m2: number(&MOMENT_OF_INERTIA_KG_M2),
        column_mass_kg: number(&COLUMN_MASS_KG),
        deck_mass_kg: number(&DECK_MASS_KG),
        tendon_stiffness_n_m: number(&TENDON_STIFFNESS_N_M),
        curvature_radius_m: number(&CURVATURE_RADIUS_M),
        extended_width_m: number(&EXTENDED_WIDTH_M),
        period_s: number(&PERIOD_S),
        gravity_m_s2: number(&GRAVITY_M_S2),
        restitution: number(&RESTITUTION),
        uplift_displacement_m: root.optional(&UPLIFT_DISPLACEMENT_M).flatten(),
        columns: root
            .given(&COLUMNS)
            .and_then(|field| field.integer(0, u64::from(u32::MAX)))
            .and_then(|columns| u32::try_from(columns).ok()),
        displacement_of: root.optional(&DISPLACEMENT_OF).flatten(),
        tendon_anchorage: root.optional(&TENDON_ANCHORAGE).flatten(),
    };
    let restrainer = restrainer::read(&mut root, &description);
    let column_shape = root.read(&COLUMN_SHAPE).unwrap_or_default();
    let f_cd_pa = root.optional(&F_CD_PA).flatten();
    let rest_amplitude_rad = root.optional(&REST_AMPLITUDE_RAD).flatten();
    let wobbling_restitution = root.optional(&WOBBLING_RESTITUTION).flatten();
    // it is read when the structure is known, whose values are its means
    root.section("uncertainty");
    root.finish();
    kind.map(|_| ReadStructure {
        description,
        restrainer,
        column_shape,
        f_cd_pa,
        rest_amplitude_rad,
        wobbling_restitution,
    })
}
