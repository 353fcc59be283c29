//! What to say where no stack meets a target: what cannot be, or which limit refuses what comes nearest.

use uplift_job::text::{counted, two_digits};
use uplift_statics::selection::{MOST_SERIES, select};
use uplift_statics::{
    Candidate, CatalogueDisc, Limits, Parts, Ranking, RestrainedColumns, Restrainer, Spring, StaticsError, Target,
};

use super::stack_name;

/// Why none of the `discs` meets the target in `columns`, and what to change.
///
/// # Errors
/// None where the search itself went through.
pub(super) fn advice(
    columns: &RestrainedColumns,
    discs: &[CatalogueDisc],
    target: Target,
    limits: &Limits,
) -> Result<String, StaticsError> {
    if discs.iter().all(|disc| disc.disc.snaps_through()) {
        return Ok(
            "every disc snaps through (h0/t from 1.414 on), and behind a tendon has no unique state: use discs \
                   of less cone height"
                .to_owned(),
        );
    }
    if let Some(beyond) = beyond_tendon(columns, target, limits)? {
        return Ok(beyond);
    }
    let loose = Limits {
        tolerance: 0.99,
        capacity_excess: 10.0,
        stroke_share: 1.0,
        tendon_factor: 1.0,
        largest_force_n: None,
        largest_diameter_m: None,
        least_inner_diameter_m: None,
        largest_length_m: None,
        ..*limits
    };
    // the fewer limits refuse it the nearer it is
    let nearest = select(columns, discs, target, &loose, Ranking::Target)?
        .into_iter()
        .map(|stack| (refusals(&stack, target, limits), stack))
        .min_by_key(|(refusals, _)| refusals.len());
    Ok(match nearest {
        Some((refusals, near)) => format!(
            "the nearest without limits is {}, {:+.1} % of the target: {}",
            stack_name(&near),
            100.0 * near.miss,
            refusals.join("; ")
        ),
        // a capacity rises with the stiffness
        None if matches!(target, Target::Capacity { .. }) => {
            "no stack of these discs comes near it: use larger discs, or more of them side by side (--parallel)"
                .to_owned()
        }
        None if limits.most_series < MOST_SERIES => format!(
            "with at most {} in series these discs are too stiff: use softer discs, or allow up to {MOST_SERIES} by \
             --springs",
            counted(limits.most_series as usize, "packet")
        ),
        None => "no stack of these discs comes near it: use other discs".to_owned(),
    })
}

/// That springs in series with a tendon leave it less than it has alone, where that is less than the target asks for.
fn beyond_tendon(columns: &RestrainedColumns, target: Target, limits: &Limits) -> Result<Option<String>, StaticsError> {
    let Limits { tendon, prestress_n, path, .. } = *limits;
    let parts = Parts { tendon: Some(tendon), prestress_n, ..Parts::from_spring(Spring::Rigid) };
    let alone = columns.clone().with_restrainer(Restrainer::new(parts)?, path)?;
    let most_n_m = tendon.stiffness_n_m;
    let asked_n_m = match target {
        Target::Capacity { capacity_m } => {
            let most_m = alone.capacity().map_or(f64::INFINITY, |capacity| capacity.displacement_m);
            return Ok((most_m < capacity_m).then(|| {
                format!(
                    "the tendon alone gives {most_m:.4} m, so no stack can give {capacity_m:.4} m: use a stiffer \
                     tendon or wider columns"
                )
            }));
        }
        Target::Stiffness { stiffness_n_m, .. } => (1.0 - limits.tolerance) * stiffness_n_m,
        Target::ZeroStiffness { .. } => (1.0 - limits.tolerance) * alone.linear(0.0)?.critical_stiffness_n_m(),
        Target::PositiveStiffness { .. } => alone.linear(0.0)?.critical_stiffness_n_m(),
    };
    Ok((most_n_m < asked_n_m).then(|| {
        let [most, asked] = [most_n_m, asked_n_m].map(|stiffness_n_m| 1e-3 * stiffness_n_m);
        format!(
            "the tendon alone has {most:.0} kN/m, so no stack can have the {asked:.0} kN/m that it needs: use a \
             stiffer tendon"
        )
    }))
}

/// The limits that refuse a stack, with its numbers and the option that would allow it.
fn refusals(stack: &Candidate, target: Target, limits: &Limits) -> Vec<String> {
    let mut refusals = Vec::new();
    let mut refuse = |refuses: bool, why: String| refusals.extend(refuses.then_some(why));
    let force_kn = 1e-3 * stack.tendon_n;
    let by = |limit: f64| format!("{} %", two_digits(100.0 * limit));
    match target {
        Target::Capacity { .. } => refuse(
            stack.miss > limits.capacity_excess,
            format!(
                "it exceeds the target by more than {}: --excess {}",
                by(limits.capacity_excess),
                up(stack.miss, 100.0)
            ),
        ),
        Target::Stiffness { .. } | Target::ZeroStiffness { .. } => refuse(
            stack.miss.abs() > limits.tolerance,
            format!("it misses it by more than {}: --tolerance {}", by(limits.tolerance), up(stack.miss.abs(), 100.0)),
        ),
        Target::PositiveStiffness { .. } => {}
    }
    refuse(
        stack.stroke_share > limits.stroke_share,
        format!(
            "it is pressed by {} of its stroke, more than {}: --stroke {}",
            by(stack.stroke_share),
            by(limits.stroke_share),
            up(stack.stroke_share, 100.0)
        ),
    );
    if let (Some(utilisation), Some(yield_n)) = (stack.tendon_utilisation, limits.tendon.yield_n) {
        refuse(
            utilisation * limits.tendon_factor > 1.0,
            format!(
                "{force_kn:.0} kN exceeds the tendon's yield over {}, {:.0} kN: --tendon-factor {:.2}",
                limits.tendon_factor,
                1e-3 * yield_n / limits.tendon_factor,
                (100.0 / utilisation).floor() / 100.0
            ),
        );
    }
    if let Some(most_n) = limits.largest_force_n {
        refuse(
            stack.tendon_n > most_n,
            format!("{force_kn:.0} kN exceeds {:.0} kN: --largest-force-n {}", 1e-3 * most_n, up(stack.tendon_n, 1.0)),
        );
    }
    if let Some(most_m) = limits.largest_length_m {
        let length_m = up(stack.length_m, 1000.0);
        refuse(
            stack.length_m > most_m,
            format!("it is {length_m} m long, more than {most_m} m: --largest-length-m {length_m}"),
        );
    }
    if let Spring::Discs(discs) = stack.restrainer.parts().spring {
        let dimensions = discs.disc().dimensions();
        let (outer_m, inner_m) = (dimensions.outer_diameter_m, dimensions.inner_diameter_m);
        if let Some(most_m) = limits.largest_diameter_m {
            refuse(outer_m > most_m, format!("{outer_m} m is wider than {most_m} m: --largest-diameter-m {outer_m}"));
        }
        if let Some(least_m) = limits.least_inner_diameter_m {
            refuse(
                inner_m < least_m,
                format!("its hole of {inner_m} m is narrower than {least_m} m: --least-inner-diameter-m {inner_m}"),
            );
        }
    }
    refusals
}

/// A limit in whole parts of one that is not below the value.
fn up(value: f64, parts: f64) -> f64 {
    (value * parts).ceil() / parts
}
