//! The sites of an engine's export: found by their place, and their curves read one after the other.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;
use std::sync::Arc;

use uplift_hazard::{ExportedCurve, ExportedCurves, HazardCurve, HazardError, SitePlace, Statistic};
use uplift_job::JobError;
use uplift_motion::IntensityMeasure;
use uplift_study::{MeasurePlan, UniformRiskStudy, definition_of};

use super::super::curve_file::{by_the_records_definition, stripe_weights};
use super::super::hardly_possible::hardly_possible;
use super::places::ListedSite;
use crate::error::InputsError;

const MISTAKES_TOLD: usize = 8;
/// Reasons why sites of an export cannot be used that are kept for examples.
const REASONS_KEPT: usize = 1000;
/// Less than the length of a degree of latitude, km: so a difference in latitude bounds a distance from below.
const KM_PER_DEGREE: f64 = 111.0;

/// What an export is read for.
#[derive(Debug, Clone, Copy)]
pub(super) enum Read<'a> {
    /// The spectra of a measure that the study is analysed by.
    Analysed(&'a MeasurePlan),
    /// To be held against what the records bring of a measure.
    Compared(IntensityMeasure),
}

impl Read<'_> {
    pub(super) fn measure(self) -> IntensityMeasure {
        match self {
            Self::Analysed(plan) => plan.measure,
            Self::Compared(measure) => measure,
        }
    }
}

/// Where the sites of an export are, and whether their curves can be used.
pub(super) struct Index {
    rows: Vec<Row>,
    /// Positions in `rows` by latitude.
    by_latitude: Vec<u32>,
    /// Names, where they were asked for.
    names: Vec<Option<Box<str>>>,
    reasons: BTreeMap<u32, String>,
    pub(super) notes: Vec<String>,
}

/// A site of an export.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    longitude_deg: f64,
    latitude_deg: f64,
    pub(super) item: u32,
    pub(super) usable: bool,
}

/// What is counted while an export is read.
#[derive(Default)]
struct Tally {
    mistakes: Vec<String>,
    more: usize,
    kind: Option<Statistic>,
    other_measures: BTreeSet<String>,
    other_kind: bool,
    another_definition: bool,
    undefined: usize,
    shortened: usize,
    implausible_curves: usize,
    first_implausible: Option<String>,
}

impl Index {
    /// Goes through the export once.
    ///
    /// # Errors
    /// What is wrong with the file as a whole, a line each; a site without a usable curve is none of it.
    pub(super) fn read(
        study: &UniformRiskStudy,
        read: Read<'_>,
        path: &Path,
        with_names: bool,
    ) -> Result<Self, Vec<String>> {
        let label = read.measure().label();
        let fail = |reason: String| vec![format!("site table, {label}: {reason}")];
        let mut curves = ExportedCurves::open(path).map_err(|error| fail(error.to_string()))?;
        let (mut rows, mut names, mut reasons) = (Vec::new(), Vec::new(), BTreeMap::new());
        let mut tally = Tally::default();
        let mut next_item = 0_u32;
        while let Some(site) = curves.next_site() {
            let item = next_item;
            next_item = item.checked_add(1).ok_or_else(|| fail("more sites than can be counted".to_owned()))?;
            let site = match site {
                Ok(site) => site,
                Err(error) => {
                    tally.mistake(error.to_string());
                    continue;
                }
            };
            if site.measure != label {
                if tally.other_measures.len() < MISTAKES_TOLD {
                    tally.other_measures.insert(site.measure);
                }
                continue;
            }
            let kind = tally.kind.get_or_insert_with(|| site.kind.clone());
            if *kind != site.kind && !tally.other_kind {
                tally.other_kind = true;
                let reason = format!(
                    "{}: curves of {kind} and of {} in one file: export only one kind",
                    path.display(),
                    site.kind
                );
                tally.mistake(reason);
            }
            let used = site.curve.map_err(|error| reason_of(&error));
            let used = used.and_then(|curve| tally.weigh(study, read, path, &curve));
            let SitePlace { name, longitude_deg, latitude_deg } = site.site;
            rows.push(Row { longitude_deg, latitude_deg, item, usable: used.is_ok() });
            if with_names {
                names.push(name.map(Into::into));
            }
            if let (Err(reason), true) = (used, reasons.len() < REASONS_KEPT) {
                reasons.insert(item, reason);
            }
        }
        if rows.is_empty() && tally.mistakes.is_empty() {
            let found: Vec<String> = tally.other_measures.iter().cloned().collect();
            tally.mistake(format!("{}: has {}, but no {label}", path.display(), found.join(", ")));
        }
        if tally.more > 0 {
            tally.mistakes.push(format!("{}: {} more mistakes like these", path.display(), tally.more));
        }
        if !tally.mistakes.is_empty() {
            return Err(tally.mistakes.into_iter().flat_map(fail).collect());
        }
        let notes = tally.notes(study, label, path);
        Ok(Self { names, reasons, notes, ..Self::from_rows(rows) })
    }

    fn from_rows(rows: Vec<Row>) -> Self {
        let latitude = |position: u32| rows[position as usize].latitude_deg;
        let mut by_latitude: Vec<u32> = (0..).take(rows.len()).collect();
        by_latitude.sort_by(|&a, &b| latitude(a).total_cmp(&latitude(b)));
        Self { rows, by_latitude, names: Vec::new(), reasons: BTreeMap::new(), notes: Vec::new() }
    }

    /// All sites, in the order of the export.
    pub(super) fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// The sites themselves as a list, by number where they have no name.
    pub(super) fn sites(&self) -> Vec<ListedSite> {
        let named = |(position, row): (usize, &Row)| ListedSite {
            name: self
                .names
                .get(position)
                .cloned()
                .flatten()
                .unwrap_or_else(|| (position + 1).to_string().into_boxed_str()),
            longitude_deg: row.longitude_deg,
            latitude_deg: row.latitude_deg,
            carried: "".into(),
        };
        self.rows.iter().enumerate().map(named).collect()
    }

    /// Why a site cannot be used, if it is one of the first ones.
    pub(super) fn reason(&self, row: &Row) -> Option<&str> {
        self.reasons.get(&row.item).map(String::as_str)
    }

    /// The site nearest to a place and its distance, km, among those at most `within_km` away; the first one of several
    /// equally near.
    pub(super) fn nearest(&self, longitude_deg: f64, latitude_deg: f64, within_km: f64) -> Option<(&Row, f64)> {
        let place = SitePlace { name: None, longitude_deg, latitude_deg };
        let row = |position: &u32| &self.rows[*position as usize];
        let start = self.by_latitude.partition_point(|position| row(position).latitude_deg < latitude_deg);
        let (south, north) = self.by_latitude.split_at(start);
        let mut best: Option<(&Row, f64)> = None;
        let mut reach_km = within_km;
        let mut look = |candidates: &mut dyn Iterator<Item = &u32>| {
            for candidate in candidates.map(row) {
                if (candidate.latitude_deg - latitude_deg).abs() * KM_PER_DEGREE > reach_km {
                    break;
                }
                let km = place.distance_km(candidate.longitude_deg, candidate.latitude_deg);
                let nearer = best.is_none_or(|(row, least)| km < least || (km == least && candidate.item < row.item));
                if km <= within_km && nearer {
                    best = Some((candidate, km));
                    reach_km = km;
                }
            }
        };
        look(&mut north.iter());
        look(&mut south.iter().rev());
        best
    }
}

impl Tally {
    fn mistake(&mut self, reason: String) {
        if self.mistakes.len() < MISTAKES_TOLD {
            self.mistakes.push(reason);
        } else {
            self.more += 1;
        }
    }

    /// Whether the curve can be used; what holds for all curves of the export is a mistake of the whole.
    fn weigh(
        &mut self,
        study: &UniformRiskStudy,
        read: Read<'_>,
        path: &Path,
        exported: &ExportedCurve,
    ) -> Result<(), String> {
        self.shortened += usize::from(exported.dropped_levels() > 0);
        let curve = exported.curve.in_field_units(study.gravity_m_s2).map_err(|error| reason_of(&error))?;
        let curve = match by_the_records_definition(study, read.measure(), &curve) {
            Ok(Some(curve)) => curve,
            Ok(None) => {
                self.undefined += 1;
                curve
            }
            Err(reason) => {
                if !self.another_definition {
                    self.another_definition = true;
                    self.mistake(format!("{}: {reason}", path.display()));
                }
                return Err(reason);
            }
        };
        if let Some(reason) = hardly_possible(&curve, read.measure()) {
            self.implausible_curves += 1;
            self.first_implausible.get_or_insert_with(|| format!("{}: {reason}", exported.site));
        }
        match read {
            Read::Analysed(plan) => stripe_weights(study, plan, &curve).map(|_| ()),
            Read::Compared(_) => Ok(()),
        }
    }

    fn notes(&self, study: &UniformRiskStudy, label: &str, path: &Path) -> Vec<String> {
        let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
        let mut notes = Vec::new();
        if self.undefined > 0 {
            notes.push(format!(
                "site table, {label}: {name} does not say how horizontal components are combined: taken as {}. Set \
                 hazard.component",
                definition_of(study.records.intensity)
            ));
        }
        if let Some(kind) = self.kind.as_ref().filter(|kind| !matches!(kind, Statistic::Mean | Statistic::Unspecified))
        {
            notes.push(format!("site table, {label}: {name} holds {kind} curves, not those of the mean hazard"));
        }
        if self.shortened > 0 {
            notes.push(format!(
                "site table, {label}: {} curves of {name} end in zeros or begin with probabilities of 1: such levels \
                 were dropped: they give no annual rate. Probabilities in 1 year are seldom 1",
                self.shortened
            ));
        }
        if let Some(first) = &self.first_implausible {
            notes.push(format!(
                "site table, {label}: {} curves of {name} are doubtful: {first}",
                self.implausible_curves
            ));
        }
        notes
    }
}

/// Why a site has no curve, in words for a table.
pub(super) fn reason_of(error: &HazardError) -> String {
    match error {
        HazardError::TooFewPoints { found, .. } => {
            format!("no hazard: {found} levels of its curve have a positive rate")
        }
        other => other.to_string(),
    }
}

/// A curve that several sites may share, or why there is none.
pub type SharedCurve = Arc<Result<HazardCurve, String>>;

/// The curves of an export in the order in which they are asked for.
///
/// Those that stand before the one asked for and will be asked for later are held. So where the sites are in the order
/// of the export hardly any is.
pub(super) struct Stream {
    curves: ExportedCurves,
    path: String,
    next_item: u32,
    /// How often each curve will be asked for.
    uses: HashMap<u32, u32>,
    held: HashMap<u32, SharedCurve>,
}

impl Stream {
    /// `items` are the curves that will be asked for.
    pub(super) fn open(path: &Path, items: impl Iterator<Item = u32>) -> Result<Self, InputsError> {
        let curves = ExportedCurves::open(path).map_err(|error| JobError::input(error.to_string()))?;
        let mut uses = HashMap::new();
        for item in items {
            *uses.entry(item).or_insert(0) += 1;
        }
        Ok(Self { curves, path: path.display().to_string(), next_item: 0, uses, held: HashMap::new() })
    }

    pub(super) fn take(&mut self, item: u32) -> Result<SharedCurve, InputsError> {
        while !self.held.contains_key(&item) {
            let site = match self.curves.next_site() {
                Some(Ok(site)) => site,
                Some(Err(error)) => return Err(JobError::input(error.to_string()).into()),
                None => return Err(JobError::input(format!("{}: was changed while it was read", self.path)).into()),
            };
            if self.uses.contains_key(&self.next_item) {
                let curve = site.curve.map(|exported| exported.curve).map_err(|error| reason_of(&error));
                self.held.insert(self.next_item, Arc::new(curve));
            }
            self.next_item += 1;
        }
        let left = self.uses.get(&item).copied().unwrap_or(1) - 1;
        let curve = if left == 0 {
            self.uses.remove(&item);
            self.held.remove(&item)
        } else {
            self.uses.insert(item, left);
            self.held.get(&item).cloned()
        };
        Ok(curve.ok_or_else(|| JobError::input(format!("{}: a curve is missing", self.path)))?)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn index(places: &[(f64, f64)]) -> Index {
        let row = |(item, &(longitude_deg, latitude_deg)): (u32, &(f64, f64))| Row {
            longitude_deg,
            latitude_deg,
            item,
            usable: true,
        };
        let rows: Vec<Row> = (0..).zip(places).map(row).collect();
        Index::from_rows(rows)
    }

    #[test]
    fn nearest_by_hand() {
        let index = index(&[(179.9, 0.0), (0.0, 89.9), (10.0, 45.0), (10.0, 45.0)]);
        let nearest = |longitude, latitude, within| index.nearest(longitude, latitude, within).map(|(row, _)| row.item);
        // across the date line, over the pole, the first of two at one place
        assert_eq!(nearest(-179.9, 0.0, 30.0), Some(0));
        assert_eq!(nearest(180.1, 0.0, 22.0), None);
        assert_eq!(nearest(180.0, 89.9, 30.0), Some(1));
        assert_eq!(nearest(10.0, 45.0, 0.001), Some(2));
        assert_eq!(nearest(10.02, 45.0, 1.0), None);
    }

    proptest! {
        #[test]
        fn nearest_is_that_of_a_search_through_all(
            // coarse, so that distances tie
            places in prop::collection::vec((-18..36_i32, -9..=9_i32), 1..60),
            (longitude, latitude) in (-180.0..360.0_f64, -90.0..=90.0_f64),
            within_km in prop_oneof![Just(f64::INFINITY), 1.0..5000.0_f64],
        ) {
            let places: Vec<(f64, f64)> =
                places.iter().map(|&(x, y)| (10.0 * f64::from(x), 10.0 * f64::from(y))).collect();
            let index = index(&places);
            let here = SitePlace { name: None, longitude_deg: longitude, latitude_deg: latitude };
            let mut expected: Option<(u32, f64)> = None;
            for (item, &(x, y)) in (0..).zip(&places) {
                let km = here.distance_km(x, y);
                if km <= within_km && expected.is_none_or(|(_, least)| km < least) {
                    expected = Some((item, km));
                }
            }
            prop_assert_eq!(index.nearest(longitude, latitude, within_km).map(|(row, km)| (row.item, km)), expected);
        }
    }
}
