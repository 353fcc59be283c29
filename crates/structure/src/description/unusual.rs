//! What a description says that can be, but is unlikely: numbers in another unit than the key's, mostly.

use uplift_plausible::{
    Range, USUAL_BULK, USUAL_DECK, USUAL_GRAVITY, USUAL_INERTIA, USUAL_LENGTH, USUAL_MASS, USUAL_PERIOD,
    USUAL_RESTITUTION, USUAL_ROTATION, USUAL_TENDON_STIFFNESS, USUAL_UPLIFT_DISPLACEMENT, USUAL_WIDTH, Unlikely,
};

use super::{Kind, StructureDescription};

/// The unlikely numbers of a description that [`resolve`](StructureDescription::resolve) takes.
pub(super) fn unlikely(of: &StructureDescription) -> Vec<Unlikely> {
    // what may be absent is no mistake of unit
    let given = |value: Option<f64>| value.filter(|value| *value > 0.0);
    let quantities: [(&'static str, Option<f64>, Range); 14] = [
        ("width_m", of.width_m, USUAL_WIDTH),
        ("height_m", of.height_m, USUAL_LENGTH),
        ("centre_height_m", of.centre_height_m, USUAL_LENGTH),
        ("size_m", of.size_m, USUAL_LENGTH),
        ("extended_width_m", of.extended_width_m, USUAL_LENGTH),
        ("mass_kg", of.mass_kg, USUAL_MASS),
        ("column_mass_kg", given(of.column_mass_kg), USUAL_MASS),
        ("deck_mass_kg", given(of.deck_mass_kg), USUAL_MASS),
        ("tendon_stiffness_n_m", given(of.tendon_stiffness_n_m), USUAL_TENDON_STIFFNESS),
        ("uplift_displacement_m", given(of.uplift_displacement_m), USUAL_UPLIFT_DISPLACEMENT),
        ("period_s", of.period_s, USUAL_PERIOD),
        ("moment_of_inertia_kg_m2 over mass_kg × R²", inertia_ratio(of), USUAL_INERTIA),
        ("gravity_m_s2", of.gravity_m_s2, USUAL_GRAVITY),
        ("restitution", of.restitution, USUAL_RESTITUTION),
    ];
    let mut found: Vec<Unlikely> =
        quantities.into_iter().filter_map(|(name, value, usual)| usual.unlikely(name, value?)).collect();
    found.extend(
        deck_share(of).and_then(|share| USUAL_DECK.unlikely("deck_mass_kg over the mass of the columns", share)),
    );
    found.extend(rotation_rad(of).and_then(|(rotation_rad, inputs)| {
        let found = USUAL_ROTATION.unlikely("the rotation at the displacement capacity", rotation_rad)?;
        Some(found.from_inputs(inputs))
    }));
    found.extend(bulk_kg_m3(of).and_then(|(name, bulk)| USUAL_BULK.unlikely(name, bulk)));
    found
}

/// Of a body; none of others.
fn inertia_ratio(of: &StructureDescription) -> Option<f64> {
    Some(three_digits(of.body().ok().filter(|_| of.kind == Kind::Body)?.inertia_ratio))
}

/// Mass of the deck over that of the columns; none where one of them has no mass.
fn deck_share(of: &StructureDescription) -> Option<f64> {
    let columns_kg = f64::from(of.columns?) * of.column_mass_kg?;
    let share = of.deck_mass_kg? / columns_kg;
    (share > 0.0 && share.is_finite()).then(|| three_digits(share))
}

/// Three digits of what is computed.
fn three_digits(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// Mass over width² times height of a block, or of a column of a frame, kg/m³; none for a body that its centre alone
/// describes, and for columns without mass.
fn bulk_kg_m3(of: &StructureDescription) -> Option<(&'static str, f64)> {
    let (name, mass_kg) = match of.kind {
        Kind::Block => ("mass_kg over width² × height", of.mass_kg?),
        kind if kind.is_frame() => ("column_mass_kg over width² × height", of.column_mass_kg?),
        _ => return None,
    };
    let geometry = of.geometry().ok()?;
    let volume_m3 = geometry.width_m().powi(2) * geometry.height_m();
    (mass_kg > 0.0 && volume_m3 > 0.0).then(|| (name, three_digits(mass_kg / volume_m3)))
}

/// The rotation at which a frame with tendons or curved ends has lost its stability, rad. A body that is held by
/// nothing but its weight has its slenderness for it, and is judged by that. With the inputs that it follows from.
fn rotation_rad(of: &StructureDescription) -> Option<(f64, &'static str)> {
    let inputs = match of.kind {
        Kind::RestrainedFrame => "width_m, height_m or the tendons",
        Kind::CurvedFrame => "curvature_radius_m, extended_width_m or height_m",
        Kind::PointMass | Kind::Block | Kind::Body | Kind::Frame => return None,
    };
    Some((three_digits(of.resolve().ok()?.capacity_m()? / of.geometry().ok()?.height_m()), inputs))
}
