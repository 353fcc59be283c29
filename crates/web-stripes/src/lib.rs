//! The stripes of a result with its hazard curves as one JSON object: `uplift export --web` writes it, and the page of
//! `make web` reads spectra off it as the program does.

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// What such a file is told by, and which version of it.
pub const FORMAT: &str = "uplift-web-1";

/// All of it.
#[derive(Debug, Serialize, Deserialize)]
pub struct WebStripes {
    /// [`FORMAT`].
    pub format: String,
    /// Program, time, file and records, in one line.
    pub provenance: String,
    /// The records, in words.
    pub record_set: String,
    /// Whether these are not real ones.
    pub synthetic: bool,
    /// Names of the records.
    pub records: Vec<String>,
    /// The study as TOML, without sites and without the place of its result.
    pub study: String,
    /// The sites.
    pub sites: Vec<WebSite>,
    /// The stripes.
    pub measures: Vec<WebMeasure>,
}

/// A site.
#[derive(Debug, Serialize, Deserialize)]
pub struct WebSite {
    /// Its name.
    pub name: String,
    /// Its hazard, a measure each.
    pub curves: Vec<WebCurve>,
}

/// The hazard curve of one measure at a site.
#[derive(Debug, Serialize, Deserialize)]
pub struct WebCurve {
    /// Key of the measure: `pgv`.
    pub im: String,
    /// Unit of the levels.
    pub unit: String,
    /// Where it is from.
    pub source: String,
    /// Its levels.
    pub levels: Vec<f64>,
    /// Mean annual frequency of exceeding each, 1/yr.
    pub maf_per_year: Vec<f64>,
    /// What the program warns of at the site by the measure, as `--json` prints it.
    pub alarms: Value,
}

/// The stripes of one measure.
#[derive(Debug, Serialize, Deserialize)]
pub struct WebMeasure {
    /// Its key: `pgv`.
    pub im: String,
    /// Its levels, in its own unit.
    pub levels: Vec<f64>,
    /// What a band takes for independent: `records` or `earthquakes`.
    pub band_of: String,
    /// The records of each.
    pub units: Vec<Vec<usize>>,
    /// Peaks `[record, strength, level]`, m; none where infinite.
    pub peaks_m: Vec<Option<f64>>,
}
