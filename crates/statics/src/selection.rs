//! Which stacks out of a catalogue give columns the restrainer that they need.
//!
//! Every disc × number in series × number in parallel is put behind the tendon and into the columns, and computed
//! exactly. What meets the target and the limits is kept and ranked.

use uplift_plausible::{DISC_DIAMETER, DISC_HEIGHT};

use crate::columns::RestrainedColumns;
use crate::disc::{DiscDimensions, DiscSpring};
use crate::error::{StaticsError, not_negative, positive, require};
use crate::events::EventKind;
use crate::parts::{Parts, Spring, Stopper, Tendon};
use crate::path::TendonPath;
use crate::restrainer::{Restrainer, Threshold};
use crate::stack::DiscStack;

/// Density of steel, kg/m³.
const STEEL_DENSITY_KG_M3: f64 = 7850.0;
/// Most packets in series: stacks of more are a matter of guidance, not of springs.
pub const MOST_SERIES: u32 = 100;
/// In parallel, friction between more discs is no longer small.
const MOST_PARALLEL: u32 = 4;

/// A disc that can be bought.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct CatalogueDisc {
    /// What it is called.
    pub name: String,
    /// The disc.
    #[serde(skip)]
    pub disc: DiscSpring,
    /// Mass, kg: as given, else of the ring of its diameters and thickness.
    pub mass_kg: f64,
    /// Price of one, in the user's money; none where it was not given.
    pub price: Option<f64>,
}

impl CatalogueDisc {
    /// A disc of spring steel by its dimensions, with mass and price where they are known.
    ///
    /// # Errors
    /// Those of the disc, and dimensions that no disc has; mass and price must be finite and not negative.
    pub fn new(
        name: String,
        dimensions: DiscDimensions,
        mass_kg: Option<f64>,
        price: Option<f64>,
    ) -> Result<Self, StaticsError> {
        // a list in metres that was taken for millimetres, and the other way round
        for (key, value, range) in [
            ("outer_diameter_m", dimensions.outer_diameter_m, DISC_DIAMETER),
            ("inner_diameter_m", dimensions.inner_diameter_m, DISC_DIAMETER),
            ("thickness_m", dimensions.thickness_m, DISC_HEIGHT),
            ("cone_height_m", dimensions.cone_height_m, DISC_HEIGHT),
        ] {
            range.check(key, value).map_err(StaticsError::Implausible)?;
        }
        let disc = DiscSpring::new(dimensions)?;
        let DiscDimensions { outer_diameter_m: outer, inner_diameter_m: inner, thickness_m, .. } = dimensions;
        let ring_kg = 0.25 * std::f64::consts::PI * (outer * outer - inner * inner) * thickness_m * STEEL_DENSITY_KG_M3;
        let mass_kg = positive("mass_kg", mass_kg.unwrap_or(ring_kg), "kg")?;
        if let Some(price) = price {
            not_negative("price", price, "")?;
        }
        Ok(Self { name, disc, mass_kg, price })
    }
}

/// What a stack is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    /// A secant stiffness of spring and tendon (N/m) at the travel `at_m` (m) of the deck, within the tolerance.
    Stiffness {
        /// Stiffness, N/m.
        stiffness_n_m: f64,
        /// Travel, m.
        at_m: f64,
    },
    /// A displacement capacity of at least so much, m.
    Capacity {
        /// Capacity, m.
        capacity_m: f64,
    },
    /// A force that neither falls nor rises up to the travel `at_m` (m): the critical stiffness, within the tolerance.
    ZeroStiffness {
        /// Travel, m.
        at_m: f64,
    },
    /// A force that rises up to the travel `at_m` (m): at least the critical stiffness.
    PositiveStiffness {
        /// Travel, m.
        at_m: f64,
    },
}

/// What limits a stack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// The tendon behind the stack.
    pub tendon: Tendon,
    /// Prestress, N.
    pub prestress_n: f64,
    /// Where the tendon runs.
    pub path: TendonPath,
    /// By how much a stiffness may miss its target, as a share of it.
    pub tolerance: f64,
    /// By how much a capacity may exceed what is asked for, as a share of it: beyond, the restrainer is stronger
    /// than it need be.
    pub capacity_excess: f64,
    /// Share of `n h0` that the stack may be pressed by at the travel of the target.
    pub stroke_share: f64,
    /// Factor between the force at which the tendon yields and the largest that the target brings.
    pub tendon_factor: f64,
    /// Largest force of the tendon, N.
    pub largest_force_n: Option<f64>,
    /// Largest outer diameter, m.
    pub largest_diameter_m: Option<f64>,
    /// Least inner diameter, m: what has to pass through.
    pub least_inner_diameter_m: Option<f64>,
    /// Largest height of the unloaded stack, m.
    pub largest_length_m: Option<f64>,
    /// Most discs in the same sense.
    pub most_parallel: u32,
    /// Most packets in alternate sense.
    pub most_series: u32,
}

impl Limits {
    /// Behind a tendon, without prestress, held in the axis at the column's foot: stiffness within 10 %, capacity from
    /// what is asked for to a quarter more, the whole stroke, a factor of 1.5 on the tendon.
    pub fn behind(tendon: Tendon) -> Self {
        Self {
            tendon,
            prestress_n: 0.0,
            path: TendonPath::Column,
            tolerance: 0.1,
            capacity_excess: 0.25,
            stroke_share: 1.0,
            tendon_factor: 1.5,
            largest_force_n: None,
            largest_diameter_m: None,
            least_inner_diameter_m: None,
            largest_length_m: None,
            most_parallel: 2,
            most_series: 40,
        }
    }
}

/// By what stacks are ranked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Ranking {
    /// By what they miss the target by.
    Target,
    /// By mass.
    #[default]
    Mass,
    /// By the height of the unloaded stack.
    Length,
    /// By price; stacks without one last.
    Price,
}

/// A stack that meets the target and the limits.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Candidate {
    /// Name of the disc.
    pub disc: String,
    /// Packets in alternate sense, `n`.
    pub springs: u32,
    /// Discs in the same sense in each, `i`.
    pub parallel: u32,
    /// By how much it misses the target, as a share of it: of the stiffness, or of the capacity.
    pub miss: f64,
    /// Secant stiffness of stack and tendon at the travel of the target, N/m.
    pub secant_n_m: f64,
    /// Travel of the target, m: the exact capacity where that is the target.
    pub at_m: f64,
    /// Force of the tendon there, N.
    pub tendon_n: f64,
    /// Deformation of the stack there, m.
    pub spring_m: f64,
    /// The same as a share of `n h0`.
    pub stroke_share: f64,
    /// Force of the tendon there over that at which it yields; none where it is not known to.
    pub tendon_utilisation: Option<f64>,
    /// Displacement capacity by the exact law, m; none where the force does not vanish.
    pub capacity_m: Option<f64>,
    /// The same by the linear law with the secant stiffness, m.
    pub linear_capacity_m: Option<f64>,
    /// What happens first beyond uplift, to spring or tendon, and the travel, m.
    pub first: Option<(EventKind, f64)>,
    /// Height of the unloaded stack, m.
    pub length_m: f64,
    /// Mass of the stack, kg.
    pub mass_kg: f64,
    /// Its price.
    pub price: Option<f64>,
    /// Spring and tendon, as they were computed.
    #[serde(skip)]
    pub restrainer: Restrainer,
}

/// The stacks out of `catalogue` that give `columns` what is asked for, the first by `ranking` first; of those for a
/// stiffness the ones without a displacement capacity last. The columns'
/// own restrainers, if any, are replaced.
///
/// # Errors
/// Limits and target must be finite and positive, the tolerance below 1, the tendon one that can be and the path one
/// that goes with the columns.
pub fn select(
    columns: &RestrainedColumns,
    catalogue: &[CatalogueDisc],
    target: Target,
    limits: &Limits,
    ranking: Ranking,
) -> Result<Vec<Candidate>, StaticsError> {
    check(target, limits)?;
    limits.path.checked(columns.geometry())?;
    let mut found = Vec::new();
    for disc in catalogue.iter().filter(|disc| fits(&disc.disc, limits)) {
        for parallel in 1..=limits.most_parallel {
            for series in 1..=limits.most_series {
                found.extend(candidate(columns, disc, (series, parallel), target, limits)?);
            }
        }
    }
    // where a force is to vanish, stacks that are flat before it does come last
    let by_stiffness = matches!(target, Target::Stiffness { .. });
    let ends = |candidate: &Candidate| by_stiffness && candidate.capacity_m.is_none();
    found
        .sort_by(|left, right| ends(left).cmp(&ends(right)).then(rank(left, ranking).total_cmp(&rank(right, ranking))));
    Ok(found)
}

fn check(target: Target, limits: &Limits) -> Result<(), StaticsError> {
    limits.tendon.checked()?;
    match target {
        Target::Stiffness { stiffness_n_m, at_m } => {
            positive("stiffness_n_m", stiffness_n_m, "N/m")?;
            positive("displacement_m", at_m, "m")?;
        }
        Target::Capacity { capacity_m } => {
            positive("capacity_m", capacity_m, "m")?;
        }
        Target::ZeroStiffness { at_m } | Target::PositiveStiffness { at_m } => {
            positive("displacement_m", at_m, "m")?;
        }
    }
    let Limits { tolerance, stroke_share, tendon_factor, most_parallel, most_series, .. } = *limits;
    require(tolerance > 0.0 && tolerance < 1.0, "tolerance", tolerance, "", "above 0 and below 1")?;
    positive("capacity_excess", limits.capacity_excess, "")?;
    require(stroke_share > 0.0 && stroke_share <= 1.0, "stroke_share", stroke_share, "", "above 0, at most 1")?;
    require(tendon_factor >= 1.0 && tendon_factor.is_finite(), "tendon_factor", tendon_factor, "", "at least 1")?;
    let (i, n) = (f64::from(most_parallel), f64::from(most_series));
    require((1..=MOST_PARALLEL).contains(&most_parallel), "parallel", i, "", "from 1 to 4")?;
    require((1..=MOST_SERIES).contains(&most_series), "springs", n, "", "from 1 to 100")?;
    for (key, value, unit) in [
        ("largest_force_n", limits.largest_force_n, "N"),
        ("largest_diameter_m", limits.largest_diameter_m, "m"),
        ("least_inner_diameter_m", limits.least_inner_diameter_m, "m"),
        ("largest_length_m", limits.largest_length_m, "m"),
    ] {
        if let Some(value) = value {
            positive(key, value, unit)?;
        }
    }
    Ok(())
}

fn fits(disc: &DiscSpring, limits: &Limits) -> bool {
    let dimensions = disc.dimensions();
    limits.largest_diameter_m.is_none_or(|most_m| dimensions.outer_diameter_m <= most_m)
        && limits.least_inner_diameter_m.is_none_or(|least_m| dimensions.inner_diameter_m >= least_m)
        // behind a tendon it would have no unique state
        && !disc.snaps_through()
}

/// The stack, if it meets target and limits.
fn candidate(
    columns: &RestrainedColumns,
    disc: &CatalogueDisc,
    (series, parallel): (u32, u32),
    target: Target,
    limits: &Limits,
) -> Result<Option<Candidate>, StaticsError> {
    let stack = DiscStack::new(disc.disc, series, parallel)?;
    let length_m = stack.free_height_m();
    if limits.largest_length_m.is_some_and(|most_m| length_m > most_m) || limits.prestress_n >= stack.flat_force_n() {
        return Ok(None);
    }
    let parts = Parts {
        tendon: Some(limits.tendon),
        prestress_n: limits.prestress_n,
        ..Parts::from_spring(Spring::Discs(stack))
    };
    let restrainer = Restrainer::new(parts)?;
    let held = columns.clone().with_restrainer(restrainer.clone(), limits.path)?;
    let capacity = held.capacity();
    let at_m = match target {
        Target::Capacity { .. } => match capacity {
            Some(capacity) => capacity.displacement_m,
            None => return Ok(None),
        },
        Target::Stiffness { at_m, .. } | Target::ZeroStiffness { at_m } | Target::PositiveStiffness { at_m } => at_m,
    };
    let state = held.at_displacement(at_m)?;
    let Some(spring_m) = state.spring_m else { return Ok(None) };
    let secant_n_m = (state.tendon_n - limits.prestress_n) / state.elongation_m;
    let linear = held.linear(secant_n_m)?;
    let critical_n_m = linear.critical_stiffness_n_m();
    let (miss, meets) = match target {
        Target::Stiffness { stiffness_n_m, .. } => within(secant_n_m / stiffness_n_m - 1.0, limits.tolerance),
        Target::ZeroStiffness { .. } => within(secant_n_m / critical_n_m - 1.0, limits.tolerance),
        Target::PositiveStiffness { .. } => (secant_n_m / critical_n_m - 1.0, secant_n_m >= critical_n_m),
        Target::Capacity { capacity_m } => {
            let excess = at_m / capacity_m - 1.0;
            (excess, (0.0..=limits.capacity_excess).contains(&excess))
        }
    };
    let stroke_share = spring_m / stack.flat_deformation_m();
    let tendon_utilisation = limits.tendon.yield_n.map(|yield_n| state.tendon_n / yield_n);
    let bears = tendon_utilisation.is_none_or(|share| share * limits.tendon_factor <= 1.0)
        && limits.largest_force_n.is_none_or(|most_n| state.tendon_n <= most_n);
    // pressed flat, the deformation is that of flat springs whatever the tendon does
    if !(meets && bears && stroke_share <= limits.stroke_share && spring_m < stack.flat_deformation_m()) {
        return Ok(None);
    }
    let breaks = [EventKind::SpringsFlat, EventKind::TendonYields, EventKind::TendonFails];
    let first = held.events().into_iter().find(|event| breaks.contains(&event.event));
    Ok(Some(Candidate {
        disc: disc.name.clone(),
        springs: series,
        parallel,
        miss,
        secant_n_m,
        at_m,
        tendon_n: state.tendon_n,
        spring_m,
        stroke_share,
        tendon_utilisation,
        capacity_m: capacity.map(|capacity| capacity.displacement_m),
        linear_capacity_m: linear.capacity_m(),
        first: first.map(|event| (event.event, event.state.displacement_m)),
        length_m,
        mass_kg: stack.discs() as f64 * disc.mass_kg,
        price: disc.price.map(|price| stack.discs() as f64 * price),
        restrainer,
    }))
}

fn within(miss: f64, tolerance: f64) -> (f64, bool) {
    (miss, miss.abs() <= tolerance)
}

fn rank(candidate: &Candidate, ranking: Ranking) -> f64 {
    match ranking {
        Ranking::Target => candidate.miss.abs(),
        Ranking::Mass => candidate.mass_kg,
        Ranking::Length => candidate.length_m,
        Ranking::Price => candidate.price.unwrap_or(f64::INFINITY),
    }
}

/// A stopper that protects its tendon: the largest force at which its rods may yield so that the tendon carries them
/// and the springs, `F_y ≤ T_y/FS − F_s(gap + F_y/k_st)` (Section 6.3.4), N; none where the springs alone are too much.
///
/// # Errors
/// Gap, stiffness and factor must be finite and positive, the factor at least 1; the tendon must have a yield force.
pub fn stopper_yield_force_n(
    restrainer: &Restrainer,
    gap_m: f64,
    stopper_stiffness_n_m: f64,
    tendon_factor: f64,
) -> Result<Option<f64>, StaticsError> {
    positive("gap_m", gap_m, "m")?;
    positive("stiffness_n_m", stopper_stiffness_n_m, "N/m")?;
    require(tendon_factor >= 1.0 && tendon_factor.is_finite(), "tendon_factor", tendon_factor, "", "at least 1")?;
    let parts = *restrainer.parts();
    let Some(tendon_n) = parts.tendon.and_then(|tendon| tendon.yield_n) else {
        return Err(StaticsError::Missing {
            key: "tendon_yield_n",
            kind: "disc-springs",
            advice: "a stopper protects a tendon up to its yield force; give it in N",
        });
    };
    let limit_n = tendon_n / tendon_factor;
    let with = |yield_n: f64| {
        let stopper = Some(Stopper { gap_m, stiffness_n_m: stopper_stiffness_n_m, yield_n: Some(yield_n) });
        Restrainer::new(Parts { stopper, ..parts })
    };
    let excess_n = |yield_n: f64| {
        let force_n = with(yield_n).ok().and_then(|law| {
            let elongation_m = law.elongation_at_m(Threshold::StopperYields)?;
            law.at(elongation_m).ok().map(|state| state.force_n)
        });
        // springs that are flat before the rods yield leave all to the tendon
        force_n.map_or(f64::INFINITY, |force_n| force_n - limit_n)
    };
    let least_n = 1e-9 * limit_n;
    with(least_n)?;
    if excess_n(least_n) > 0.0 {
        return Ok(None);
    }
    Ok(Some(crate::root::bisect(least_n, limit_n, excess_n)))
}
