//! Every mistake of a description at once.

use std::f64::consts::FRAC_PI_2;

use uplift_plausible::{
    COLUMNS, CURVATURE_RADIUS, GRAVITY, LENGTH, MASS, MOMENT_OF_INERTIA, PERIOD, RESTITUTION, Range, SIZE,
    TENDON_STIFFNESS, UPLIFT_DISPLACEMENT,
};

use super::{Kind, StructureDescription};
use crate::block::Reference;
use crate::error::{StructureError, require};
use crate::frame::Anchorage;
use Allowed::{BelowQuarterTurn, Plausible};

/// What a kind makes of a quantity.
#[derive(Clone, Copy, PartialEq)]
enum Role {
    Needed,
    Accepted,
    Foreign,
}

/// Values that a quantity can take by itself.
#[derive(Debug, Clone, Copy)]
pub enum Allowed {
    /// A plausible one.
    Plausible(Range),
    /// Above 0 and below a quarter turn, in the unit of the quantity; and that in words.
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
    unit: &'static str,
    allowed: Allowed,
    value: fn(&StructureDescription) -> Option<f64>,
    role: fn(Kind) -> Role,
}

const fn quantity(
    key: &'static str,
    unit: &'static str,
    allowed: Allowed,
    value: fn(&StructureDescription) -> Option<f64>,
    role: fn(Kind) -> Role,
) -> Quantity {
    Quantity { key, unit, allowed, value, role }
}

fn accepted(_: Kind) -> Role {
    Role::Accepted
}

fn needed_if(condition: bool) -> Role {
    if condition { Role::Needed } else { Role::Foreign }
}

fn accepted_if(condition: bool) -> Role {
    if condition { Role::Accepted } else { Role::Foreign }
}

fn needed_of_frames(kind: Kind) -> Role {
    needed_if(kind.is_frame())
}

fn needed_of_curved(kind: Kind) -> Role {
    needed_if(kind == Kind::CurvedFrame)
}

/// What may be absent.
const fn from_zero(range: Range) -> Allowed {
    Plausible(Range { least: 0.0, ..range })
}

/// Every quantity that is a number, in the order of the documentation.
const QUANTITIES: [Quantity; 18] = [
    quantity("width_m", "m", Plausible(LENGTH), |of| of.width_m, accepted),
    quantity("height_m", "m", Plausible(LENGTH), |of| of.height_m, |kind| accepted_if(!kind.is_by_centre())),
    quantity(
        "centre_height_m",
        "m",
        Plausible(LENGTH),
        |of| of.centre_height_m,
        |kind| accepted_if(kind.is_by_centre()),
    ),
    quantity(
        "slenderness_rad",
        "rad",
        BelowQuarterTurn(FRAC_PI_2, "above 0 and below π/2"),
        |of| of.slenderness_rad,
        accepted,
    ),
    quantity(
        "slenderness_deg",
        "degrees",
        BelowQuarterTurn(90.0, "above 0 and below 90"),
        |of| of.slenderness_deg,
        accepted,
    ),
    quantity("size_m", "m", Plausible(SIZE), |of| of.size_m, accepted),
    quantity("mass_kg", "kg", Plausible(MASS), |of| of.mass_kg, |kind| needed_if(!kind.is_frame())),
    quantity(
        "moment_of_inertia_kg_m2",
        "kg m²",
        Plausible(MOMENT_OF_INERTIA),
        |of| of.moment_of_inertia_kg_m2,
        |kind| needed_if(kind == Kind::Body),
    ),
    quantity("columns", "", Plausible(COLUMNS), |of| of.columns.map(f64::from), needed_of_frames),
    quantity("column_mass_kg", "kg", from_zero(MASS), |of| of.column_mass_kg, needed_of_frames),
    quantity("deck_mass_kg", "kg", from_zero(MASS), |of| of.deck_mass_kg, needed_of_frames),
    quantity(
        "tendon_stiffness_n_m",
        "N/m",
        Plausible(TENDON_STIFFNESS),
        |of| of.tendon_stiffness_n_m,
        |kind| needed_if(kind == Kind::RestrainedFrame),
    ),
    quantity("curvature_radius_m", "m", Plausible(CURVATURE_RADIUS), |of| of.curvature_radius_m, needed_of_curved),
    quantity("extended_width_m", "m", Plausible(LENGTH), |of| of.extended_width_m, needed_of_curved),
    quantity("uplift_displacement_m", "m", from_zero(UPLIFT_DISPLACEMENT), |of| of.uplift_displacement_m, accepted),
    quantity("period_s", "s", Plausible(PERIOD), |of| of.period_s, accepted),
    quantity("gravity_m_s2", "m/s²", Plausible(GRAVITY), |of| of.gravity_m_s2, accepted),
    quantity("restitution", "", Plausible(RESTITUTION), |of| of.restitution, accepted),
];

/// What the quantity of this `key` may be; none of a key that is no number.
pub(super) fn allowed(key: &str) -> Option<Allowed> {
    QUANTITIES.iter().find(|quantity| quantity.key == key).map(|quantity| quantity.allowed)
}

/// The mistakes that can be seen in single quantities and in the choice of geometry.
pub(super) fn mistakes(of: &StructureDescription) -> Vec<StructureError> {
    let kind = of.kind.name();
    let foreign = |key, value: &str, unit| StructureError::Foreign { key, value: value.to_owned(), unit, kind };
    let mut mistakes = Vec::new();
    for Quantity { key, unit, allowed, value, role } in QUANTITIES {
        match (role(of.kind), value(of)) {
            (Role::Needed, None) => mistakes.push(StructureError::Missing { key, unit, kind }),
            (Role::Foreign, Some(value)) => mistakes.push(foreign(key, &value.to_string(), unit)),
            (_, Some(value)) => mistakes.extend(allowed.check(key, value, unit).err()),
            _ => {}
        }
    }
    if let Some(reference) = of.displacement_of.filter(|_| of.kind != Kind::Block) {
        let value = match reference {
            Reference::Centre => "\"centre\"",
            Reference::Top => "\"top\"",
        };
        mistakes.push(foreign("displacement_of", value, ""));
    }
    match (of.kind == Kind::RestrainedFrame, of.tendon_anchorage) {
        (true, None) => mistakes.push(StructureError::MissingAnchorage),
        (false, Some(anchorage)) => {
            let value = match anchorage {
                Anchorage::Foundation => "\"foundation\"",
                Anchorage::Column => "\"column\"",
            };
            mistakes.push(foreign("tendon_anchorage", value, ""));
        }
        _ => {}
    }
    if of.period_s.is_some() && of.uplift_displacement_m.is_some() {
        mistakes.push(StructureError::UpliftTwice);
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
    let given: Vec<String> = QUANTITIES
        .iter()
        .filter(|quantity| LENGTHS.contains(&quantity.key) && (quantity.role)(of.kind) != Role::Foreign)
        .filter_map(|quantity| {
            (quantity.value)(of).map(|value| format!("`{}` = {value} {}", quantity.key, quantity.unit))
        })
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
