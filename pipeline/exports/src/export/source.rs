//! What is exported of a result, as every format takes it.

use std::ops::Range;

use uplift_alarms::alarms;
use uplift_hazard::return_period_from_probability;
use uplift_job::alarm::Alarm;
use uplift_job::text::typed_path;
use uplift_result::declared::Quantity;
use uplift_result::{
    BandKind, CONSISTENCY, Fit, Head, MeasureSpectra, ResultFile, Spectrum, SpreadOver, StoredBands, StoredConsistency,
    StoredFinding, StoredHazard, StoredSpectra, StoredSpread,
};
use uplift_studies::uniform_risk::quoted_bands_m;
use uplift_study::UniformRiskStudy;
use uplift_uniform_risk::consistency::least_effective;
use uplift_uniform_risk::{BandOf, QuotedUnits};

use super::added::{Added, Influence};
use crate::error::ExportsError;

/// The spectra, bands and coefficients of a result, and where they come from.
pub struct Export {
    pub(super) head: Head,
    pub(super) study: UniformRiskStudy,
    pub(super) spectra: StoredSpectra,
    /// Limits of the quoted band of every ordinate, m, by measure, site, probability, then strength; none for a single
    /// record.
    pub(super) quoted_m: Vec<Option<[f64; 2]>>,
    /// What they take for independent, by measure.
    band_of: Vec<BandOf>,
    /// The same of the repaired spectra; none without repair.
    repaired_quoted_m: Vec<Option<[f64; 2]>>,
    pub(super) bands: Option<StoredBands>,
    /// Spreads over what is not known.
    pub(super) spreads: Vec<StoredSpread>,
    pub(super) hazard: Vec<StoredHazard>,
    /// Return periods of the probabilities, years (Eq. 4.8).
    pub(super) return_periods: Vec<f64>,
    /// What to know before using them, the worst first.
    pub(super) alarms: Vec<Alarm>,
    /// What was added to it after the run.
    pub(super) added: Added,
    /// What structures were asked under it.
    pub(super) findings: Vec<StoredFinding>,
    /// Whether its records bring the site's hazard of the other measure.
    pub(super) consistency: Vec<StoredConsistency>,
    /// [`least_effective`] records of each of these.
    pub(super) least_effective: Vec<Option<Vec<f64>>>,
    pub(super) records: usize,
    /// Name of the result file.
    pub(super) file: String,
    /// The file as a command names it.
    pub(super) typed: String,
    /// One line: program, time, file, records.
    provenance: String,
}

/// A spectrum with its place `[site, poe]` and all that goes with it over the strengths.
pub(super) struct Row<'a> {
    pub(super) at: [usize; 2],
    /// All spectra of its measure.
    pub(super) of_measure: &'a MeasureSpectra,
    pub(super) spectrum: Spectrum<'a>,
    /// [`Export::quoted_m`] over the strengths.
    quoted_m: &'a [Option<[f64; 2]>],
    repaired_quoted_m: &'a [Option<[f64; 2]>],
    /// What these bands take for independent.
    pub(super) band_of: BandOf,
    /// Years.
    pub(super) return_period: f64,
}

impl Row<'_> {
    /// Lower and upper limit of the quoted band of a kind of spectrum over the strengths, m; NaN where there is none.
    pub(super) fn quoted_m(&self, kind: BandKind) -> [Vec<f64>; 2] {
        let quoted_m = if kind.is_repaired { self.repaired_quoted_m } else { self.quoted_m };
        [0, 1].map(|limit| quoted_m.iter().map(|band_m| band_m.map_or(f64::NAN, |band_m| band_m[limit])).collect())
    }
}

impl Export {
    /// Read `file`, at the risks that it was asked for.
    ///
    /// # Errors
    /// A file that is damaged, or no result of uniform risk spectra.
    pub fn from_file(file: &ResultFile) -> Result<Self, ExportsError> {
        let path = file.path();
        let spectra = file.spectra()?;
        if spectra.measures.is_empty() {
            return Err(file.without_spectra().into());
        }
        let head = file.head()?;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let provenance = provenance_of(&head, &name);
        let return_period = |&poe: &f64| Ok(return_period_from_probability(poe, spectra.years)?);
        let consistency = file.consistency()?;
        Ok(Self {
            return_periods: spectra.poes.iter().map(return_period).collect::<Result<_, ExportsError>>()?,
            study: file.stored_study()?,
            quoted_m: quoted_bands_m(file, &spectra, false)?,
            repaired_quoted_m: quoted_bands_m(file, &spectra, true)?,
            band_of: QuotedUnits::from_file(file)?.iter().map(|units| units.of).collect(),
            bands: file.bands()?,
            spreads: file.spreads()?,
            hazard: file.hazard()?,
            alarms: alarms(file)?,
            added: Added::read(file)?,
            findings: file.findings()?,
            least_effective: consistency.iter().map(|of| least_effective(file, of)).collect::<Result<_, _>>()?,
            consistency,
            records: file.axes()?.records.len(),
            head,
            spectra,
            file: name,
            typed: typed_path(path),
            provenance,
        })
    }

    /// The influence on a spectrum, where there is some.
    pub(super) fn influence_on(&self, row: &Row<'_>) -> Option<&Influence> {
        self.added.influence_by(row.spectrum.measure)
    }

    /// One line of provenance.
    pub fn provenance(&self) -> &str {
        &self.provenance
    }

    /// Places of the ordinates of a spectrum in the arrays of its measure.
    pub(super) fn places(&self, row: &Row<'_>) -> Range<usize> {
        let ([site, poe], strengths) = (row.at, self.spectra.strengths.len());
        let first = (site * self.spectra.poes.len() + poe) * strengths;
        first..first + strengths
    }

    /// Every spectrum, by measure, then site, then probability.
    pub(super) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        let measures = self.spectra.measures.iter().zip(&self.band_of);
        let places = measures.flat_map(|(of, band_of)| of.fits.blocks::<2>().map(move |(at, _)| (at, of, *band_of)));
        places.zip(self.spectra.rows()).enumerate().map(|(index, ((at, of_measure, band_of), spectrum))| {
            let strengths = self.spectra.strengths.len();
            let ordinates = index * strengths..(index + 1) * strengths;
            Row {
                at,
                of_measure,
                spectrum,
                quoted_m: &self.quoted_m[ordinates.clone()],
                repaired_quoted_m: &self.repaired_quoted_m[ordinates],
                band_of,
                return_period: self.return_periods[at[1]],
            }
        })
    }

    /// What there are spreads over.
    pub(super) fn spread_over(&self) -> impl Iterator<Item = SpreadOver> + '_ {
        SpreadOver::ALL.into_iter().filter(|over| self.spreads.iter().any(|spread| spread.over == *over))
    }

    /// Mean and fractiles of a spectrum over the strengths, m, as [`StoredSpread::names`] names them; none where it has
    /// no such spread.
    pub(super) fn spread_of(&self, row: &Row<'_>, over: SpreadOver) -> Option<[&[f64]; 6]> {
        let [site, poe] = row.at;
        let is_of = |of: &&StoredSpread| of.over == over && of.site == site && of.measure == row.spectrum.measure;
        self.spreads.iter().find(is_of).map(|of| of.limits_m(poe))
    }
}

/// One line: program, time, file, records.
pub(super) fn provenance_of(head: &Head, file: &str) -> String {
    format!(
        "uplift {} ({}), {}; result {file}; study digest {}; records: {}",
        head.version,
        head.commit,
        head.created,
        head.study_digest(),
        head.record_set
    )
    .replace(['\n', '\r'], " ")
}

/// What the records scaled to one measure bring at a site.
pub(super) struct ConsistencyOf<'a> {
    pub(super) of: &'a StoredConsistency,
    at: usize,
    pub(super) site: &'a str,
    /// Level that the records bring over the site's, by the probabilities of the study.
    pub(super) ratio: &'a [f64],
    /// Nothing where there is none.
    pub(super) verdict: Option<&'a str>,
    /// None before a repair; NaN where it failed.
    pub(super) least_effective: Option<f64>,
}

impl ConsistencyOf<'_> {
    /// The exported numbers of the site; NaN without a verdict.
    pub(super) fn figures(&self) -> impl Iterator<Item = (&'static Quantity<StoredConsistency>, f64)> + '_ {
        CONSISTENCY.exported().filter_map(|figure| Some((figure, figure.number(self.of, self.at)?)))
    }
}

impl Export {
    /// What was found, by the measure that records are scaled to, then site; sites without two hazard curves are left
    /// out.
    pub(super) fn consistencies(&self) -> impl Iterator<Item = ConsistencyOf<'_>> {
        let of_measure = |of| self.spectra.sites.iter().enumerate().filter_map(move |at| consistency_of(of, at));
        self.consistency.iter().zip(&self.least_effective).flat_map(of_measure)
    }

    /// Whether any spectrum has one of weighted records beside it.
    pub(super) fn has_repaired(&self) -> bool {
        self.rows().any(|row| self.repaired(&row).is_some())
    }

    /// The displacements of weighted records over the strengths, m, and their coefficients; none without a repair.
    pub(super) fn repaired(&self, row: &Row<'_>) -> Option<(&[f64], &Fit)> {
        let is_beside = |of: &&StoredConsistency| of.scaled_to == row.spectrum.measure;
        let of = self.consistency.iter().filter(is_beside).find(|of| of.is_repaired(row.at[0]))?;
        Some((of.u_m.as_ref()?.block(row.at), &of.fits.as_ref()?[row.at]))
    }
}

fn consistency_of<'a>(
    (of, least): (&'a StoredConsistency, &Option<Vec<f64>>),
    (at, site): (usize, &'a String),
) -> Option<ConsistencyOf<'a>> {
    let is_known = of.rate_per_year.block([at]).iter().any(|rate| !rate.is_nan());
    is_known.then(|| ConsistencyOf {
        of,
        at,
        site,
        ratio: of.ratio.block([at]),
        verdict: Some(of.verdict[at].as_str()).filter(|verdict| !verdict.is_empty()),
        least_effective: least.as_ref().map(|least| least[at]),
    })
}
