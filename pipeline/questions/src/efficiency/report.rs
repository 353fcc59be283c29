//! The report on efficiency and sufficiency.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Serialize;
use uplift_job::text::finite;
use uplift_result::{StoredConsistency, StoredEfficiency, StoredTrend};
use uplift_uniform_risk::StoredStripes;
use uplift_uniform_risk::consistency::{Verdict, times_in_words};

use super::measure_efficiency::{Covariate, MeasureEfficiency, rank};
use super::write::efficiency_path;

/// The report on efficiency and sufficiency.
#[derive(Debug, Clone, Serialize)]
#[serde(transparent)]
pub struct EfficiencyReport {
    /// One a measure and strength, in this order.
    pub rows: Vec<EfficiencyRow>,
    /// The result, whose file holds all of it now.
    #[serde(skip)]
    pub stored: StoredStripes,
    /// What is known of the records, in order: the keys of [`EfficiencyRow::trends`].
    #[serde(skip)]
    pub covariates: Vec<&'static str>,
    /// The largest displacement at which measures are compared, m, of each strength; none where there is none.
    #[serde(skip)]
    pub up_to_m: Vec<Option<f64>>,
    /// The table beside it.
    #[serde(skip)]
    pub table: PathBuf,
}

/// Where the records scaled to a measure miss the site's hazard of the other one most.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Miss {
    /// The other measure, `PGA`.
    pub other: &'static str,
    /// The site.
    pub site: String,
    /// How many times the site's level the scaled records have, mean over the rates compared.
    pub bias: f64,
    /// The same in words: `1.6`, or at the rates compared, `0.5 to 2.1`.
    pub times: String,
    /// Whether a repair was tried.
    #[serde(skip)]
    pub is_tried: bool,
    /// Whether weights repair it.
    #[serde(rename = "repaired")]
    pub is_repaired: bool,
}

impl Miss {
    /// That of records scaled to one measure; none where they are inconsistent at none of the `sites`.
    fn worst(of: &StoredConsistency, sites: &[String]) -> Option<Self> {
        let missed = (0..sites.len()).filter(|&site| of.verdict[site] == Verdict::Inconsistent.key());
        let worst = missed.max_by(|&a, &b| of.max[a].total_cmp(&of.max[b]))?;
        Some(Self {
            other: of.other.label(),
            site: sites[worst].clone(),
            bias: of.bias[worst],
            times: times_in_words(of, worst, of.bias[worst]),
            is_tried: of.u_m.is_some(),
            is_repaired: of.is_repaired(worst),
        })
    }
}

/// Efficiency and sufficiency of one measure at one strength; NaN where there is no such number.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EfficiencyRow {
    /// The measure, `PGV`, `SA(1.0)`.
    pub im: &'static str,
    /// The measure that the records of the runs were scaled to.
    pub scaled_to: &'static str,
    /// Uplift strength.
    pub strength: f64,
    /// Logarithmic scatter of the level at which records bring the structure to a displacement.
    pub dispersion_level: f64,
    /// The place of this scatter among those of all measures at the strength, the smallest first; none where there is
    /// no such number.
    pub rank: Option<u32>,
    /// Logarithmic scatter of the displacement at a given level once the structure rocks.
    pub dispersion_rocking: f64,
    /// Share of the stripes that rock whose scatter does not exist because too many runs overturn, 0 to 1.
    pub undefined_share: f64,
    /// Logarithmic scatter of the level at which the structure begins to rock.
    pub dispersion_initiation: f64,
    /// The trend of a record's mean residual with what the record is.
    pub trends: BTreeMap<&'static str, Trend>,
    /// Where the records of the runs miss the site's hazard most; none where they do not, or are scaled to another
    /// measure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub misses: Option<Miss>,
}

impl EfficiencyRow {
    /// Whether the runs were scaled to another measure.
    pub fn is_told(&self) -> bool {
        self.im != self.scaled_to
    }
}

/// A trend; none where there are too few records or stripes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Trend {
    /// Change of the residual with it.
    pub slope: Option<f64>,
    /// Probability of such a slope if there were none, 0 to 1.
    pub p_value: Option<f64>,
    /// Share of the variance explained, 0 to 1.
    pub r_squared: Option<f64>,
}

fn trend_at(trend: &StoredTrend, index: usize) -> Trend {
    let [slope, p_value, r_squared] = [&trend.slope, &trend.p_value, &trend.r_squared].map(|of| finite(of[index]));
    Trend { slope, p_value, r_squared }
}

impl EfficiencyReport {
    pub(super) fn new(
        stored: StoredStripes,
        covariates: &[Covariate],
        measures: &[MeasureEfficiency],
        up_to_m: Vec<Option<f64>>,
        consistency: &[StoredConsistency],
    ) -> Self {
        let missed = |of: &StoredEfficiency| {
            let own = consistency.iter().find(|own| own.scaled_to == of.measure && own.scaled_to == of.scaled_to)?;
            Miss::worst(own, &stored.sites)
        };
        let row = |MeasureEfficiency { own: of, .. }: &MeasureEfficiency, index: usize| EfficiencyRow {
            im: of.measure.label(),
            scaled_to: of.scaled_to.label(),
            strength: stored.strengths[index],
            dispersion_level: of.reaching[index],
            rank: rank(measures, of, index),
            dispersion_rocking: of.rocking[index],
            undefined_share: of.undefined[index],
            dispersion_initiation: of.initiation[index],
            trends: covariates.iter().zip(&of.trends).map(|(of, trend)| (of.key, trend_at(trend, index))).collect(),
            misses: missed(of),
        };
        Self {
            rows: measures
                .iter()
                .flat_map(|of| (0..stored.strengths.len()).map(|index| row(of, index)).collect::<Vec<_>>())
                .collect(),
            covariates: covariates.iter().map(|covariate| covariate.key).collect(),
            up_to_m,
            table: efficiency_path(&stored.path),
            stored,
        }
    }
}
