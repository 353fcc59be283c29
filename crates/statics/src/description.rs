//! A restrainer as written in a file: the table `[restrainer]` of a structure.
//!
//! # Keys
//! | kind | what it is | keys it needs |
//! |---|---|---|
//! | `none` | nothing | |
//! | `linear` | a spring of constant stiffness | `stiffness_n_m`, with the tendon's unless one is given |
//! | `tendon` | a bare tendon | the tendon's |
//! | `disc-springs` | a stack of disc springs | the disc's, and `springs`, how many in alternate sense |
//!
//! * a disc is `outer_diameter_m`, `inner_diameter_m`, `thickness_m`, and `cone_height_m` or `free_height_m`;
//! * disc springs may give a tendon behind them, `parallel` (1), `reduced_thickness_m` where they have
//!   contact flats, `young_modulus_pa` (206e9), `poisson` (0.3) and `when_flat` (`"tendon"` or `"stop"`);
//! * a tendon is `tendon_stiffness_n_m`, or `tendon_area_m2`, `tendon_length_m` and `tendon_young_modulus_pa`
//!   (190e9); it may have `tendon_yield_n`, `tendon_failure_n`;
//! * `anchorage` is `"column"`, `"foundation"`, or `"shifted"` with `duct_gap_m` and `tendon_length_m`;
//! * `prestress_n` or `slack_m`, 0 if left out; a table `stopper` with `gap_m`, `stiffness_n_m` and `yield_n`.
//!
//! ```
//! # let text = r#"
//! kind = "disc-springs"
//! outer_diameter_m = 0.125
//! inner_diameter_m = 0.061
//! thickness_m = 0.006
//! cone_height_m = 0.0036
//! springs = 10
//! tendon_area_m2 = 150e-6
//! tendon_length_m = 2.134
//! anchorage = "shifted"
//! duct_gap_m = 0.0087
//! stopper = { gap_m = 0.015, stiffness_n_m = 20e6, yield_n = 54e3 }
//! # "#;
//! # let text = serde_json::json!({"kind": "disc-springs", "outer_diameter_m": 0.125, "inner_diameter_m": 0.061,
//! #     "thickness_m": 0.006, "cone_height_m": 0.0036, "springs": 10, "tendon_area_m2": 150e-6,
//! #     "tendon_length_m": 2.134, "anchorage": "shifted", "duct_gap_m": 0.0087,
//! #     "stopper": {"gap_m": 0.015, "stiffness_n_m": 20e6, "yield_n": 54e3}});
//! # let description: uplift_statics::RestrainerDescription = serde_json::from_value(text)?;
//! # let (restrainer, _) = description.resolve().unwrap().unwrap();
//! # assert!((restrainer.parts().tendon.unwrap().stiffness_n_m / 13_355e3 - 1.0).abs() < 1e-4);
//! # Ok::<(), serde_json::Error>(())
//! ```

use serde::Deserialize;
use uplift_plausible::{
    DISC_DIAMETER, DISC_HEIGHT, LENGTH, Range, SPRING_GAP, TENDON_AREA, TENDON_FORCE, TENDON_STIFFNESS, YOUNG_MODULUS,
};

use crate::disc::{DiscDimensions, DiscSpring, SPRING_STEEL_YOUNG_MODULUS_PA, STEEL_POISSON};
use crate::error::{StaticsError, positive};
use crate::parts::{Parts, Spring, Stopper, Tendon, WhenFlat};
use crate::path::TendonPath;
use crate::restrainer::Restrainer;
use crate::stack::DiscStack;

/// Young's modulus of seven-wire strand, Pa: that of the dissertation's tendons.
const STRAND_YOUNG_MODULUS_PA: f64 = 190e9;

/// Kind of restrainer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RestrainerKind {
    /// None.
    #[default]
    None,
    /// A spring of constant stiffness.
    Linear,
    /// A bare tendon.
    Tendon,
    /// Disc springs, with a tendon behind them.
    DiscSprings,
}

impl RestrainerKind {
    /// Every kind.
    pub const ALL: [Self; 4] = [Self::None, Self::Linear, Self::Tendon, Self::DiscSprings];

    /// The kind as written.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Linear => "linear",
            Self::Tendon => "tendon",
            Self::DiscSprings => "disc-springs",
        }
    }
}

/// Where a tendon is anchored, and whether it is held in the axis of its duct.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TendonAnchorage {
    /// At the column's foot, held in the axis.
    #[default]
    Column,
    /// In the foundation, held in the axis.
    Foundation,
    /// At the column's foot, free to shift in the duct.
    Shifted,
}

impl TendonAnchorage {
    /// Every anchorage.
    pub const ALL: [Self; 3] = [Self::Column, Self::Foundation, Self::Shifted];

    /// The anchorage as written.
    pub fn name(self) -> &'static str {
        match self {
            Self::Column => "column",
            Self::Foundation => "foundation",
            Self::Shifted => "shifted",
        }
    }
}

/// A stopper as written.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StopperDescription {
    /// Deformation of the springs at which it engages, m.
    pub gap_m: f64,
    /// Stiffness `EA/L` of all its rods, N/m.
    pub stiffness_n_m: f64,
    /// Force at which they yield, N.
    pub yield_n: Option<f64>,
}

/// A restrainer as written: which keys belong to which kind is listed in the [module documentation](self).
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RestrainerDescription {
    /// Kind.
    pub kind: RestrainerKind,
    /// Stiffness of a linear spring, N/m.
    pub stiffness_n_m: Option<f64>,
    /// Outer diameter of a disc, m.
    pub outer_diameter_m: Option<f64>,
    /// Inner diameter of a disc, m.
    pub inner_diameter_m: Option<f64>,
    /// Thickness of a disc, m.
    pub thickness_m: Option<f64>,
    /// Cone height `h0` of a disc, m.
    pub cone_height_m: Option<f64>,
    /// Free height `l0 = h0 + t` of a disc, m.
    pub free_height_m: Option<f64>,
    /// Thickness of a disc with contact flats, m.
    pub reduced_thickness_m: Option<f64>,
    /// Discs, or packets of them, in alternate sense.
    pub springs: Option<u32>,
    /// Discs in the same sense in each packet; 1 if left out.
    pub parallel: Option<u32>,
    /// Young's modulus of the discs, Pa; 206e9 if left out.
    pub young_modulus_pa: Option<f64>,
    /// Poisson's ratio of the discs; 0.3 if left out.
    pub poisson: Option<f64>,
    /// Stiffness `EA/L` of the tendon, N/m.
    pub tendon_stiffness_n_m: Option<f64>,
    /// Area of the tendon, m².
    pub tendon_area_m2: Option<f64>,
    /// Young's modulus of the tendon, Pa; 190e9 if left out.
    pub tendon_young_modulus_pa: Option<f64>,
    /// Length of the tendon, m.
    pub tendon_length_m: Option<f64>,
    /// Force at which the tendon yields, N.
    pub tendon_yield_n: Option<f64>,
    /// Force at which the tendon or its socket fails, N.
    pub tendon_failure_n: Option<f64>,
    /// Force of the tendon before the column tilts, N; 0 if left out.
    pub prestress_n: Option<f64>,
    /// Elongation that a loose nut lets pass, m; 0 if left out.
    pub slack_m: Option<f64>,
    /// What happens once the springs are flat; the tendon stretches on if left out.
    pub when_flat: Option<WhenFlat>,
    /// Where the tendon is anchored; at the column if left out.
    pub anchorage: Option<TendonAnchorage>,
    /// Distance by which a shifted tendon moves until it touches its duct, m.
    pub duct_gap_m: Option<f64>,
    /// Stopper beside the springs.
    pub stopper: Option<StopperDescription>,
}

/// Where a number of the description is.
type Number = fn(&RestrainerDescription) -> Option<f64>;

/// What the numbers of a description may be.
const RANGES: [(&str, Range, Number); 19] = [
    ("stiffness_n_m", TENDON_STIFFNESS, |of| of.stiffness_n_m),
    ("outer_diameter_m", DISC_DIAMETER, |of| of.outer_diameter_m),
    ("inner_diameter_m", DISC_DIAMETER, |of| of.inner_diameter_m),
    ("thickness_m", DISC_HEIGHT, |of| of.thickness_m),
    ("cone_height_m", DISC_HEIGHT, |of| of.cone_height_m),
    ("free_height_m", DISC_HEIGHT, |of| of.free_height_m),
    ("reduced_thickness_m", DISC_HEIGHT, |of| of.reduced_thickness_m),
    ("young_modulus_pa", YOUNG_MODULUS, |of| of.young_modulus_pa),
    ("tendon_stiffness_n_m", TENDON_STIFFNESS, |of| of.tendon_stiffness_n_m),
    ("tendon_area_m2", TENDON_AREA, |of| of.tendon_area_m2),
    ("tendon_young_modulus_pa", YOUNG_MODULUS, |of| of.tendon_young_modulus_pa),
    ("tendon_length_m", LENGTH, |of| of.tendon_length_m),
    ("tendon_yield_n", TENDON_FORCE, |of| of.tendon_yield_n),
    ("tendon_failure_n", TENDON_FORCE, |of| of.tendon_failure_n),
    ("prestress_n", TENDON_FORCE, |of| of.prestress_n),
    ("slack_m", SPRING_GAP, |of| of.slack_m),
    ("duct_gap_m", SPRING_GAP, |of| of.duct_gap_m),
    ("gap_m", SPRING_GAP, |of| of.stopper.map(|stopper| stopper.gap_m)),
    ("yield_n", TENDON_FORCE, |of| of.stopper.and_then(|stopper| stopper.yield_n)),
];

impl RestrainerDescription {
    /// The restrainer and its path, or every mistake of the description; nothing for the kind `none`.
    ///
    /// Keys that are missing, foreign to the kind or given twice are listed together; what several correct numbers
    /// show, such as prestress beyond flat springs, is found once those are mended.
    ///
    /// # Errors
    /// At least one mistake, each with key, value, unit and what to do.
    pub fn resolve(&self) -> Result<Option<(Restrainer, TendonPath)>, Vec<StaticsError>> {
        let implausible = self.implausible();
        let mut mistakes = self.misplaced();
        let mut keep = |found: Result<Option<Spring>, Vec<StaticsError>>| match found {
            Ok(spring) => spring,
            Err(found) => {
                mistakes.extend(found);
                None
            }
        };
        let spring = keep(self.spring());
        let tendon = self.tendon().map_err(|mistake| mistakes.push(mistake)).ok().flatten();
        let path = self.path().map_err(|mistake| mistakes.push(mistake)).ok();
        let stopper = self.stopper.map(|StopperDescription { gap_m, stiffness_n_m, yield_n }| {
            Stopper { gap_m, stiffness_n_m, yield_n }.checked().map_err(|mistake| mistakes.push(mistake))
        });
        // of a number that cannot be it is said once, with its range
        let told = |mistake: &StaticsError| {
            implausible.iter().any(|found| mistake.keys().iter().any(|key| found.keys().contains(key)))
        };
        mistakes.retain(|mistake| !told(mistake));
        mistakes.extend(implausible);
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        let (Some(spring), Some(path)) = (spring, path) else { return Ok(None) };
        let parts = Parts {
            spring,
            stopper: stopper.and_then(Result::ok),
            tendon,
            prestress_n: self.prestress_n.unwrap_or(0.0),
            slack_m: self.slack_m.unwrap_or(0.0),
            when_flat: self.when_flat.unwrap_or_default(),
        };
        Restrainer::new(parts).map(|restrainer| Some((restrainer, path))).map_err(|mistake| vec![mistake])
    }

    /// The disc that is described.
    ///
    /// # Errors
    /// Every key that a disc lacks, or the first number that cannot be.
    pub fn disc(&self) -> Result<DiscSpring, Vec<StaticsError>> {
        let mut missing = Vec::new();
        let mut need = |key, value: Option<f64>, advice| {
            if value.is_none() {
                missing.push(StaticsError::Missing { key, kind: "disc-springs", advice });
            }
            value.unwrap_or(f64::NAN)
        };
        let outer_diameter_m = need("outer_diameter_m", self.outer_diameter_m, "give it in m");
        let inner_diameter_m = need("inner_diameter_m", self.inner_diameter_m, "give it in m");
        let thickness_m = need("thickness_m", self.thickness_m, "give it in m");
        let height_m = self.cone_height_m.or(self.free_height_m);
        need("cone_height_m", height_m, "give it in m, or free_height_m, the height of the unloaded disc");
        if !missing.is_empty() {
            return Err(missing);
        }
        let cone_height_m = match (self.cone_height_m, self.free_height_m) {
            (Some(_), Some(_)) => {
                return Err(vec![StaticsError::Twice { key: "cone_height_m", other: "free_height_m" }]);
            }
            (None, Some(free_height_m)) if free_height_m <= thickness_m => {
                return Err(vec![StaticsError::FreeHeight { free_height_m, thickness_m }]);
            }
            (cone_height_m, free_height_m) => {
                cone_height_m.or(free_height_m.map(|free_m| free_m - thickness_m)).unwrap_or(f64::NAN)
            }
        };
        let dimensions = DiscDimensions {
            outer_diameter_m,
            inner_diameter_m,
            thickness_m,
            cone_height_m,
            reduced_thickness_m: self.reduced_thickness_m,
        };
        let young_modulus_pa = self.young_modulus_pa.unwrap_or(SPRING_STEEL_YOUNG_MODULUS_PA);
        DiscSpring::from_material(dimensions, young_modulus_pa, self.poisson.unwrap_or(STEEL_POISSON))
            .map_err(|mistake| vec![mistake])
    }

    fn spring(&self) -> Result<Option<Spring>, Vec<StaticsError>> {
        let missing = |key, advice| vec![StaticsError::Missing { key, kind: self.kind.name(), advice }];
        match self.kind {
            RestrainerKind::None => Ok(None),
            RestrainerKind::Linear => match self.stiffness_n_m {
                Some(stiffness_n_m) => Ok(Some(Spring::Linear { stiffness_n_m })),
                None => Err(missing("stiffness_n_m", "give it in N/m")),
            },
            RestrainerKind::Tendon => Ok(Some(Spring::Rigid)),
            RestrainerKind::DiscSprings => {
                let springs = self.springs.ok_or_else(|| missing("springs", "give the number in alternate sense"));
                let disc = self.disc();
                match (disc, springs) {
                    (Ok(disc), Ok(springs)) => DiscStack::new(disc, springs, self.parallel.unwrap_or(1))
                        .map(|stack| Some(Spring::Discs(stack)))
                        .map_err(|mistake| vec![mistake]),
                    (disc, springs) => Err([disc.err(), springs.err()].into_iter().flatten().flatten().collect()),
                }
            }
        }
    }

    fn tendon(&self) -> Result<Option<Tendon>, StaticsError> {
        let (yield_n, failure_n) = (self.tendon_yield_n, self.tendon_failure_n);
        let stiffness_n_m = match (self.tendon_stiffness_n_m, self.tendon_area_m2) {
            (Some(_), Some(_)) => {
                return Err(StaticsError::Twice { key: "tendon_stiffness_n_m", other: "tendon_area_m2" });
            }
            (Some(stiffness_n_m), None) => stiffness_n_m,
            (None, Some(area_m2)) => {
                let area_m2 = positive("tendon_area_m2", area_m2, "m²")?;
                let length_m = self.tendon_length_m.ok_or(StaticsError::Missing {
                    key: "tendon_length_m",
                    kind: self.kind.name(),
                    advice: "with tendon_area_m2 the tendon's length gives its stiffness; give it in m",
                })?;
                let modulus_pa = self.tendon_young_modulus_pa.unwrap_or(STRAND_YOUNG_MODULUS_PA);
                let modulus_pa = positive("tendon_young_modulus_pa", modulus_pa, "Pa")?;
                modulus_pa * area_m2 / positive("tendon_length_m", length_m, "m")?
            }
            (None, None) if self.kind == RestrainerKind::Tendon => {
                return Err(StaticsError::Missing {
                    key: "tendon_stiffness_n_m",
                    kind: "tendon",
                    advice: "give EA/L in N/m, or tendon_area_m2 and tendon_length_m",
                });
            }
            (None, None) => return Ok(None),
        };
        Tendon { stiffness_n_m, yield_n, failure_n }.checked().map(Some)
    }

    /// The path of the tendon; whether it goes with a column is judged with the column.
    fn path(&self) -> Result<TendonPath, StaticsError> {
        let missing = |key, advice| StaticsError::MissingForPath { key, advice };
        match self.anchorage.unwrap_or_default() {
            TendonAnchorage::Column => Ok(TendonPath::Column),
            TendonAnchorage::Foundation => Ok(TendonPath::Foundation),
            TendonAnchorage::Shifted => Ok(TendonPath::Shifted {
                duct_gap_m: self
                    .duct_gap_m
                    .ok_or_else(|| missing("duct_gap_m", "give half of what the duct is wider, in m"))?,
                tendon_length_m: self.tendon_length_m.ok_or_else(|| missing("tendon_length_m", "give it in m"))?,
            }),
        }
    }

    /// Numbers that no restrainer has: mistakes of unit, mostly.
    fn implausible(&self) -> Vec<StaticsError> {
        let check = |(key, range, value): &(&'static str, Range, Number)| {
            range.check(key, value(self)?).err().map(StaticsError::Implausible)
        };
        RANGES.iter().filter_map(check).collect()
    }

    /// What the number of this `key`, of the restrainer or its stopper, may be; none where that depends on others.
    pub fn range(key: &str) -> Option<Range> {
        RANGES.iter().find(|(known, ..)| *known == key).map(|(_, range, _)| *range)
    }

    /// Keys that mean nothing for the kind, the anchorage or the tendon given.
    fn misplaced(&self) -> Vec<StaticsError> {
        let kind = || format!("a restrainer of kind \"{}\"", self.kind.name());
        let (discs, none) = (self.kind == RestrainerKind::DiscSprings, self.kind == RestrainerKind::None);
        let tendon = self.tendon_stiffness_n_m.is_some() || self.tendon_area_m2.is_some();
        let shifted = self.anchorage == Some(TendonAnchorage::Shifted);
        let without_tendon = || "a restrainer without tendon_stiffness_n_m or tendon_area_m2".to_owned();
        let mut found = Vec::new();
        let mut check = |key, given: bool, belongs: bool, what: &dyn Fn() -> String| {
            if given && !belongs {
                found.push(StaticsError::Foreign { key, what: what() });
            }
        };
        check("stiffness_n_m", self.stiffness_n_m.is_some(), self.kind == RestrainerKind::Linear, &kind);
        for (key, given) in [
            ("outer_diameter_m", self.outer_diameter_m.is_some()),
            ("inner_diameter_m", self.inner_diameter_m.is_some()),
            ("thickness_m", self.thickness_m.is_some()),
            ("cone_height_m", self.cone_height_m.is_some()),
            ("free_height_m", self.free_height_m.is_some()),
            ("reduced_thickness_m", self.reduced_thickness_m.is_some()),
            ("springs", self.springs.is_some()),
            ("parallel", self.parallel.is_some()),
            ("young_modulus_pa", self.young_modulus_pa.is_some()),
            ("poisson", self.poisson.is_some()),
            ("when_flat", self.when_flat.is_some()),
        ] {
            check(key, given, discs, &kind);
        }
        for (key, given) in [
            ("tendon_stiffness_n_m", self.tendon_stiffness_n_m.is_some()),
            ("tendon_area_m2", self.tendon_area_m2.is_some()),
            ("anchorage", self.anchorage.is_some()),
            ("prestress_n", self.prestress_n.is_some()),
            ("slack_m", self.slack_m.is_some()),
            ("stopper", self.stopper.is_some()),
        ] {
            check(key, given, !none, &kind);
        }
        check("stopper", self.stopper.is_some(), self.kind != RestrainerKind::Tendon, &|| {
            "a tendon without springs".to_owned()
        });
        let by_area = self.tendon_area_m2.is_some();
        check("tendon_young_modulus_pa", self.tendon_young_modulus_pa.is_some(), by_area, &|| {
            "a restrainer without tendon_area_m2".to_owned()
        });
        for (key, given) in
            [("tendon_yield_n", self.tendon_yield_n.is_some()), ("tendon_failure_n", self.tendon_failure_n.is_some())]
        {
            check(key, given, tendon, &without_tendon);
        }
        check("duct_gap_m", self.duct_gap_m.is_some(), shifted, &|| "an anchorage other than \"shifted\"".to_owned());
        check("tendon_length_m", self.tendon_length_m.is_some(), shifted || by_area, &|| {
            "a restrainer that neither is shifted nor has tendon_area_m2".to_owned()
        });
        found
    }
}
