//! Hazard curves as the engines export them.
//!
//! | written by | format | values | read by |
//! |---|---|---|---|
//! | `OpenQuake` engine | CSV, one row a site | probabilities in the investigation time | `openquake`, line by line |
//! | `OpenQuake` engine before version 3, EFEHR | NRML (XML) | probabilities in the investigation time | `nrml` |
//! | USGS hazard services (nshmp-haz) | JSON | annual frequencies | `usgs` |
//!
//! The format is recognised by the content, and gzip is unpacked. All become [`ExportedCurve`]s:
//!
//! - [`read_export`]: the curves of one site or of all ([`SiteSelection`]).
//! - [`ExportedCurves`]: the curves of a file one after the other; of `OpenQuake`'s CSV only one row is in memory.
//! - [`read_disaggregation`]: the earthquakes by which levels are exceeded ([`Disaggregation`]).
//! - [`read_realization_weights`]: the weights of `OpenQuake`'s logic tree realizations.

mod disaggregation;
mod entry;
mod measure;
mod nrml;
mod openquake;
mod realizations;
mod selection;
mod usgs;

use std::collections::HashMap;
use std::fmt;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, BufRead, Cursor, Read};
use std::path::Path;

use crate::curve::HazardCurve;
use crate::error::{HazardError, Place};
use crate::input::{self, Input, unreadable_because};
pub use disaggregation::{Disaggregation, read_disaggregation};
use entry::Entry;
pub use realizations::{RealizationWeight, read_realization_weights};
pub use selection::SiteSelection;

/// Largest NRML file, unpacked, bytes: it is read as a whole. `OpenQuake`'s CSV may have any size.
pub const MAX_NRML_BYTES: u64 = 64 << 20;
/// Largest JSON file, unpacked, bytes: the answer of a service for one site has less than one million.
pub const MAX_JSON_BYTES: u64 = 8 << 20;

/// Where a curve belongs.
#[derive(Debug, Clone, PartialEq)]
pub struct SitePlace {
    /// The engine's own name of the site (`OpenQuake`: `custom_site_id`).
    pub name: Option<String>,
    /// Longitude, degrees, east positive.
    pub longitude_deg: f64,
    /// Latitude, degrees, north positive.
    pub latitude_deg: f64,
}

impl SitePlace {
    /// Great-circle distance to a place given by longitude and latitude, degrees; km on a sphere of the
    /// earth's mean radius.
    pub fn distance_km(&self, longitude_deg: f64, latitude_deg: f64) -> f64 {
        selection::distance_km((self.longitude_deg, self.latitude_deg), (longitude_deg, latitude_deg))
    }
}

impl fmt::Display for SitePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(name) = &self.name {
            write!(f, "{} ", crate::text::excerpt(name))?;
        }
        write!(f, "({}, {})", self.longitude_deg, self.latitude_deg)
    }
}

/// What a curve is over the logic tree.
#[derive(Debug, Clone, PartialEq)]
pub enum Statistic {
    /// The weighted mean.
    Mean,
    /// A quantile, 0 to 1.
    Quantile(f64),
    /// One realization, by its number; [`read_realization_weights`] gives its weight.
    Realization(u32),
    /// One realization, by its path through the logic trees, as [`RealizationWeight::branch_path`] writes it.
    Branch(String),
    /// The file does not say.
    Unspecified,
}

impl fmt::Display for Statistic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mean => write!(f, "mean"),
            Self::Quantile(quantile) => write!(f, "quantile {quantile}"),
            Self::Realization(number) => write!(f, "realization {number}"),
            Self::Branch(path) => write!(f, "branch {path}"),
            Self::Unspecified => write!(f, "exported"),
        }
    }
}

/// One curve of an export.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportedCurve {
    /// The site.
    pub site: SitePlace,
    /// Great-circle distance from the place asked for, km; only for [`SiteSelection::Nearest`].
    pub distance_km: Option<f64>,
    /// What the curve is over the logic tree.
    pub kind: Statistic,
    /// Period of the probabilities that the rates were computed from, years; none where the file holds rates.
    pub investigation_years: Option<f64>,
    /// Mean shear-wave velocity of the upper 30 m, m/s, where the file says it.
    pub vs30_m_s: Option<f64>,
    /// The curve: annual rates, with measure, unit and source.
    pub curve: HazardCurve,
    /// Levels at the end with a rate or probability of zero.
    pub dropped_zeros: usize,
    /// Levels at the beginning with a probability of 1.
    pub dropped_certain: usize,
    /// Levels at the beginning with the rate of the one after them: so low that every earthquake exceeds them.
    pub dropped_alike: usize,
}

impl ExportedCurve {
    /// Levels of the export that the curve has not.
    pub fn dropped_levels(&self) -> usize {
        self.dropped_zeros + self.dropped_certain + self.dropped_alike
    }
}

/// A site as an export has it, with its curve or with what keeps it from having one: a site at sea has no hazard.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportedSite {
    /// The site.
    pub site: SitePlace,
    /// The intensity measure of its curve.
    pub measure: String,
    /// What the curve is over the logic tree.
    pub kind: Statistic,
    /// The curve, if its values make one.
    pub curve: Result<ExportedCurve, HazardError>,
}

/// Reads the curves of the selected site, all measures and statistics that the file has for it, or of all sites.
///
/// Only the curves of the selected site must be valid, and all of them; of other sites names and coordinates are read.
///
/// # Errors
/// [`HazardError::SiteNotFound`]; [`HazardError::DuplicateSite`] where the site has two curves of one measure and
/// statistic; else as [`ExportedCurves`].
pub fn read_export(path: &Path, selection: &SiteSelection) -> Result<Vec<ExportedCurve>, HazardError> {
    ExportedCurves::open(path)?.select(selection)
}

/// The curves of an export in file order.
///
/// `OpenQuake`'s CSV is read while the iterator goes, so that memory does not grow with the sites but for some twenty
/// bytes each by which repeated ones are found. An item may be an error (a site at sea has no hazard, for example) and
/// the next one a curve again.
///
/// # Errors
/// Each item: [`HazardError::File`] for what cannot be read at all, which ends the iteration;
/// [`HazardError::DuplicateSite`]; errors naming file, line and level for values that are not a hazard curve.
pub struct ExportedCurves {
    name: String,
    entries: Entries,
    /// Line of each curve met, by a hash of what distinguishes it from others.
    met: HashMap<u64, Option<usize>>,
}

enum Entries {
    OpenQuake(openquake::Rows),
    Loaded(std::vec::IntoIter<Entry>),
}

impl Iterator for Entries {
    type Item = Result<Entry, HazardError>;

    fn next(&mut self) -> Option<Self::Item> {
        match self {
            Self::OpenQuake(rows) => rows.next(),
            Self::Loaded(entries) => entries.next().map(Ok),
        }
    }
}

impl ExportedCurves {
    /// Opens a file.
    ///
    /// # Errors
    /// [`HazardError::File`] for a file that is missing, empty or of no known format; errors of its header.
    pub fn open(path: &Path) -> Result<Self, HazardError> {
        Self::from_input(input::open(path)?, path.display().to_string())
    }

    /// The same for bytes from elsewhere; `name` is the file's name for messages.
    ///
    /// # Errors
    /// As [`ExportedCurves::open`].
    pub fn from_reader(reader: impl BufRead + Send + 'static, name: &str) -> Result<Self, HazardError> {
        let input = input::unpacked(reader).map_err(|error| unreadable(name, &error))?;
        Self::from_input(input, name.to_owned())
    }

    fn from_input(mut input: Input, name: String) -> Result<Self, HazardError> {
        let head = input::peek(&mut input, 1024).map_err(|error| unreadable(&name, &error))?;
        let begin = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&head).trim_ascii_start().first().copied();
        let input: Input = Box::new(Cursor::new(head).chain(input));
        let whole = |input, limit| input::text(input, &name, limit, "export fewer sites, or OpenQuake's CSV");
        let entries = match begin {
            None => {
                let reason = "empty; export the hazard curves again".to_owned();
                return Err(HazardError::File { file: name, reason });
            }
            Some(b'<') => Entries::Loaded(nrml::entries(&whole(input, MAX_NRML_BYTES)?, &name)?.into_iter()),
            Some(b'{' | b'[') => Entries::Loaded(usgs::entries(&whole(input, MAX_JSON_BYTES)?, &name)?.into_iter()),
            Some(_) => Entries::OpenQuake(openquake::Rows::new(input, &name)?),
        };
        Ok(Self { name, entries, met: HashMap::new() })
    }

    /// The curves of the selected site, or of all; see [`read_export`].
    ///
    /// # Errors
    /// As [`read_export`].
    pub fn select(self, selection: &SiteSelection) -> Result<Vec<ExportedCurve>, HazardError> {
        match selection {
            SiteSelection::All => self.collect(),
            SiteSelection::Name(wanted) => selection::by_name(self.entries, wanted, &self.name),
            &SiteSelection::Nearest { longitude_deg, latitude_deg } => {
                selection::nearest(self.entries, longitude_deg, latitude_deg)
            }
        }
    }

    /// The next site, whether or not its values make a curve: to go through many sites, of which some have no hazard.
    ///
    /// # Errors
    /// As the iterator's items, but for errors of the values, which stand in [`ExportedSite::curve`].
    pub fn next_site(&mut self) -> Option<Result<ExportedSite, HazardError>> {
        let entry = match self.entries.next()? {
            Ok(entry) => entry,
            Err(error) => return Some(Err(error)),
        };
        let mut hasher = DefaultHasher::new();
        entry.head.measure.hash(&mut hasher);
        entry.head.kind.to_string().hash(&mut hasher);
        entry.site.name.hash(&mut hasher);
        // Adding 0 makes one zero of two.
        [entry.site.longitude_deg, entry.site.latitude_deg].map(|x| (x + 0.0).to_bits()).hash(&mut hasher);
        Some(match self.met.insert(hasher.finish(), entry.line) {
            Some(earlier) => Err(entry.duplicate(earlier)),
            None => Ok(entry.exported()),
        })
    }
}

impl Iterator for ExportedCurves {
    type Item = Result<ExportedCurve, HazardError>;

    fn next(&mut self) -> Option<Self::Item> {
        Some(self.next_site()?.and_then(|site| site.curve))
    }
}

fn unreadable(name: &str, error: &io::Error) -> HazardError {
    HazardError::File { file: name.to_owned(), reason: unreadable_because(error) }
}

/// Coordinates that can be ones.
fn coordinates(
    longitude_deg: f64,
    latitude_deg: f64,
    place: impl FnOnce() -> Place,
) -> Result<(f64, f64), HazardError> {
    if (-180.0..=360.0).contains(&longitude_deg) && (-90.0..=90.0).contains(&latitude_deg) {
        return Ok((longitude_deg, latitude_deg));
    }
    let reason = format!(
        "longitude {longitude_deg}, latitude {latitude_deg} is not a place on earth; give degrees, longitude first"
    );
    Err(HazardError::Row { place: place(), reason })
}
