//! What all formats are taken apart into, before anything about hazard is checked.

use std::sync::Arc;

use super::{ExportedCurve, ExportedSite, SitePlace, Statistic};
use crate::component::ComponentDefinition;
use crate::curve::HazardCurve;
use crate::declaration::SecondColumn;
use crate::error::{HazardError, Place};
use crate::rates::{AnnualRates, Row, annual_rates};

/// What several curves of a file have in common.
#[derive(Debug)]
pub(super) struct Head {
    pub(super) file: String,
    pub(super) measure: String,
    pub(super) unit: &'static str,
    pub(super) kind: Statistic,
    /// Rates or probabilities.
    pub(super) content: SecondColumn,
    /// Period of the probabilities, years.
    pub(super) years: Option<f64>,
    pub(super) levels: Vec<f64>,
    pub(super) source: String,
    pub(super) component: Option<ComponentDefinition>,
}

/// One curve as it stands in the file.
#[derive(Debug)]
pub(super) struct Entry {
    pub(super) head: Arc<Head>,
    /// Line, where the format has lines.
    pub(super) line: Option<usize>,
    pub(super) site: SitePlace,
    pub(super) vs30_m_s: Option<f64>,
    /// One value a level; what is wrong with them matters only where the site is wanted.
    pub(super) values: Result<Vec<f64>, HazardError>,
}

impl Head {
    /// Where the level of an index stands.
    pub(super) fn place(&self, line: Option<usize>, index: usize) -> Place {
        let level = self.levels.get(index).copied().unwrap_or(f64::NAN);
        Place::Level(match line {
            Some(line) => format!("{}, line {line}, at {} = {level} {}", self.file, self.measure, self.unit),
            None => format!("{}, at {} = {level} {}", self.file, self.measure, self.unit),
        })
    }

    /// The file, and the line where there are lines, else the measure.
    fn name(&self, line: Option<usize>) -> String {
        match line {
            Some(line) => format!("{}, line {line}", self.file),
            None => format!("{}, {}", self.file, self.measure),
        }
    }
}

impl Entry {
    /// Whether the other is another curve of the same kind, so that one of them is too many.
    pub(super) fn repeats(&self, other: &Self) -> bool {
        self.head.measure == other.head.measure && self.head.kind == other.head.kind
    }

    pub(super) fn duplicate(&self, earlier: Option<usize>) -> HazardError {
        let (kind, measure, site) = (&self.head.kind, &self.head.measure, &self.site);
        HazardError::DuplicateSite {
            place: Place::Level(self.head.name(self.line)),
            curve: format!("{kind} curve of {measure} at {site}"),
            earlier: earlier.map(|line| format!(", before in line {line}")).unwrap_or_default(),
        }
    }

    /// The site with its curve, or what keeps it from having one.
    pub(super) fn exported(self) -> ExportedSite {
        let (site, measure, kind) = (self.site.clone(), self.head.measure.clone(), self.head.kind.clone());
        ExportedSite { site, measure, kind, curve: self.curve() }
    }

    /// The curve, if the values make one.
    pub(super) fn curve(self) -> Result<ExportedCurve, HazardError> {
        let Self { head, line, site, vs30_m_s, values } = self;
        let place = |index| head.place(line, index);
        let name = head.name(line);
        let levels = head.levels.iter().copied();
        let rows = levels.zip(values?).enumerate().map(|(at, (im, value))| Row { at, im, value }).collect();
        let AnnualRates { mut rows, dropped_zeros, dropped_certain } =
            annual_rates(rows, head.content, head.years, &name, place)?;
        // levels so low that every earthquake exceeds them have one rate, which belongs to the highest of them
        let dropped_alike = rows.windows(2).take_while(|pair| pair[0].value == pair[1].value).count();
        rows.drain(..dropped_alike);
        let (im, maf) = rows.iter().map(|row| (row.im, row.value)).unzip();
        let (measure, unit, source) = (head.measure.clone(), head.unit.to_owned(), head.source.clone());
        let curve = HazardCurve::new_at(measure, unit, source, im, maf, |index| place(rows[index].at))?;
        Ok(ExportedCurve {
            site,
            distance_km: None,
            kind: head.kind.clone(),
            investigation_years: head.years,
            vs30_m_s,
            curve: curve.with_component(head.component),
            dropped_zeros,
            dropped_certain,
            dropped_alike,
        })
    }
}
