//! Every mistake of a description at once.

use std::f64::consts::FRAC_PI_2;

use uplift_plausible::{
    COLUMNS, CURVATURE_RADIUS, GRAVITY, LENGTH, MASS, MOMENT_OF_INERTIA, RESTITUTION, Range, SIZE, TENDON_STIFFNESS,
    UPLIFT_DISPLACEMENT,
};

use super::{Kind, StructureDescription};
use crate::block::Reference;
use crate::error::{StructureError, require};
use crate::frame::Anchorage;

/// What a kind makes of a quantity.
#[derive(Clone, Copy, PartialEq)]
enum Role {
    Needed,
    Accepted,
    Foreign,
}

/// Values a quantity can take by itself.
#[derive(Clone, Copy)]
enum Allowed {
    Plausible(Range),
    /// Above 0 and below a quarter turn, given in the quantity's unit.
    BelowQuarterTurn(f64, &'static str),
}

impl Allowed {
    fn check(self, key: &'static str, value: f64, unit: &'static str) -> Result<f64, StructureError> {
        match self {
            Self::Plausible(range) => range.check(key, value).map_err(StructureError::Implausible),
            Self::BelowQuarterTurn(quarter_turn, requirement) => {
                require(value > 0.0 && value < quarter_turn, key, value, unit, requirement)
            }
        }
    }
}

struct Quantity {
    key: &'static str,
    value: Option<f64>,
    unit: &'static str,
    allowed: Allowed,
    role: Role,
}

fn needed_if(condition: bool) -> Role {
    if condition { Role::Needed } else { Role::Foreign }
}

fn accepted_if(condition: bool) -> Role {
    if condition { Role::Accepted } else { Role::Foreign }
}

/// Every quantity that is a number, in the order of the documentation.
fn quantities(of: &StructureDescription) -> Vec<Quantity> {
    use Allowed::{BelowQuarterTurn, Plausible};
    // what may be absent
    let from_zero = |range: Range| Plausible(Range { least: 0.0, ..range });
    let kind = of.kind;
    let (frame, by_centre) = (kind.is_frame(), kind.is_by_centre());
    let restrained = kind == Kind::RestrainedFrame;
    let curved = kind == Kind::CurvedFrame;
    let quantity = |key, value, unit, allowed, role| Quantity { key, value, unit, allowed, role };
    let radians = BelowQuarterTurn(FRAC_PI_2, "above 0 and below π/2");
    let degrees = BelowQuarterTurn(90.0, "above 0 and below 90");
    vec![
        quantity("width_m", of.width_m, "m", Plausible(LENGTH), Role::Accepted),
        quantity("height_m", of.height_m, "m", Plausible(LENGTH), accepted_if(!by_centre)),
        quantity("centre_height_m", of.centre_height_m, "m", Plausible(LENGTH), accepted_if(by_centre)),
        quantity("slenderness_rad", of.slenderness_rad, "rad", radians, Role::Accepted),
        quantity("slenderness_deg", of.slenderness_deg, "degrees", degrees, Role::Accepted),
        quantity("size_m", of.size_m, "m", Plausible(SIZE), Role::Accepted),
        quantity("mass_kg", of.mass_kg, "kg", Plausible(MASS), needed_if(!frame)),
        quantity(
            "moment_of_inertia_kg_m2",
            of.moment_of_inertia_kg_m2,
            "kg m²",
            Plausible(MOMENT_OF_INERTIA),
            needed_if(kind == Kind::Body),
        ),
        quantity("columns", of.columns.map(f64::from), "", Plausible(COLUMNS), needed_if(frame)),
        quantity("column_mass_kg", of.column_mass_kg, "kg", from_zero(MASS), needed_if(frame)),
        quantity("deck_mass_kg", of.deck_mass_kg, "kg", from_zero(MASS), needed_if(frame)),
        quantity(
            "tendon_stiffness_n_m",
            of.tendon_stiffness_n_m,
            "N/m",
            Plausible(TENDON_STIFFNESS),
            needed_if(restrained),
        ),
        quantity("curvature_radius_m", of.curvature_radius_m, "m", Plausible(CURVATURE_RADIUS), needed_if(curved)),
        quantity("extended_width_m", of.extended_width_m, "m", Plausible(LENGTH), needed_if(curved)),
        quantity(
            "uplift_displacement_m",
            of.uplift_displacement_m,
            "m",
            from_zero(UPLIFT_DISPLACEMENT),
            Role::Accepted,
        ),
        quantity("gravity_m_s2", of.gravity_m_s2, "m/s²", Plausible(GRAVITY), Role::Accepted),
        quantity("restitution", of.restitution, "", Plausible(RESTITUTION), Role::Accepted),
    ]
}

/// The mistakes that can be seen in single quantities and in the choice of geometry.
pub(super) fn mistakes(of: &StructureDescription) -> Vec<StructureError> {
    let kind = of.kind.name();
    let mut mistakes = Vec::new();
    for Quantity { key, value, unit, allowed, role } in quantities(of) {
        match (role, value) {
            (Role::Needed, None) => mistakes.push(StructureError::Missing { key, unit, kind }),
            (Role::Foreign, Some(value)) => {
                mistakes.push(StructureError::Foreign { key, value: value.to_string(), unit, kind });
            }
            (_, Some(value)) => mistakes.extend(allowed.check(key, value, unit).err()),
            _ => {}
        }
    }
    if let Some(reference) = of.displacement_of.filter(|_| of.kind != Kind::Block) {
        let value = match reference {
            Reference::Centre => "\"centre\"",
            Reference::Top => "\"top\"",
        };
        mistakes.push(StructureError::Foreign { key: "displacement_of", value: value.to_owned(), unit: "", kind });
    }
    match (of.kind == Kind::RestrainedFrame, of.tendon_anchorage) {
        (true, None) => mistakes.push(StructureError::MissingAnchorage),
        (false, Some(anchorage)) => {
            let value = match anchorage {
                Anchorage::Foundation => "\"foundation\"",
                Anchorage::Column => "\"column\"",
            };
            mistakes.push(StructureError::Foreign { key: "tendon_anchorage", value: value.to_owned(), unit: "", kind });
        }
        _ => {}
    }
    // values are judged above: here only a wrong choice of them counts
    if let Err(mistake @ StructureError::Geometry { .. }) = of.geometry() {
        mistakes.push(mistake);
    }
    mistakes
}

/// The geometry is not one of the accepted combinations.
pub(super) fn geometry_mistake(of: &StructureDescription) -> StructureError {
    const LENGTHS: [&str; 6] =
        ["width_m", "height_m", "centre_height_m", "slenderness_rad", "slenderness_deg", "size_m"];
    let given: Vec<String> = quantities(of)
        .iter()
        .filter(|quantity| LENGTHS.contains(&quantity.key) && quantity.role != Role::Foreign)
        .filter_map(|quantity| quantity.value.map(|value| format!("`{}` = {value} {}", quantity.key, quantity.unit)))
        .collect();
    let given = if given.is_empty() { "nothing".to_owned() } else { given.join(", ") };
    let advice = if of.kind.is_by_centre() {
        "give `width_m` and `centre_height_m`, or one of `slenderness_rad`, `slenderness_deg` \
         with one of `size_m`, `centre_height_m`, `width_m`"
    } else {
        "give `width_m` and `height_m`, or one of `slenderness_rad`, `slenderness_deg` \
         with one of `size_m`, `height_m`, `width_m`"
    };
    StructureError::Geometry { given, advice }
}
