//! What is exported of a result, as every format takes it.

use std::path::Path;

use uplift_alarms::alarms;
use uplift_hazard::rate_from_probability;
use uplift_job::alarm::Alarm;
use uplift_job::{Array, JobError};
use uplift_result::{
    Fit, Head, InferredBands, MeasureBands, MeasureSpectra, ResultFile, Spectrum, SpreadOver, StoredBands,
    StoredConsistency, StoredFinding, StoredHazard, StoredJointBands, StoredRepairedBands, StoredSpectra,
    StoredSpectraBands, StoredSpread,
};
use uplift_study::UniformRiskStudy;

use super::added::Added;
use crate::error::ExportsError;

/// The spectra, bands and coefficients of a result, and where they come from.
pub struct Export {
    pub(super) head: Head,
    pub(super) study: UniformRiskStudy,
    pub(super) spectra: StoredSpectra,
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
    pub(super) records: usize,
    /// Name of the result file.
    pub(super) file: String,
    /// One line: program, time, file, records.
    provenance: String,
}

/// A spectrum with its place `[site, poe]` and all that goes with it over the strengths.
pub(super) struct Row<'a> {
    pub(super) at: [usize; 2],
    /// All spectra of its measure.
    pub(super) of_measure: &'a MeasureSpectra,
    pub(super) spectrum: Spectrum<'a>,
    /// Years.
    pub(super) return_period: f64,
}

impl Export {
    /// Read the result at `path`.
    ///
    /// # Errors
    /// A file that is missing, damaged or no result of uniform risk spectra.
    pub fn read(path: &Path) -> Result<Self, ExportsError> {
        Self::from_file(&ResultFile::open(path)?)
    }

    /// Read `file`, at the risks that it was asked for.
    ///
    /// # Errors
    /// A file that is damaged, or no result of uniform risk spectra.
    pub fn from_file(file: &ResultFile) -> Result<Self, ExportsError> {
        let path = file.path();
        let spectra = file.spectra()?;
        if spectra.measures.is_empty() {
            return Err(JobError::input(format!("{}: has no spectra: the study has no sites", path.display())).into());
        }
        let head = file.head()?;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let provenance = provenance_of(&head, &name);
        let return_period = |&poe: &f64| Ok(1.0 / rate_from_probability(poe, spectra.years)?);
        Ok(Self {
            return_periods: spectra.poes.iter().map(return_period).collect::<Result<_, ExportsError>>()?,
            study: file.stored_study()?,
            bands: file.bands()?,
            spreads: file.spreads()?,
            hazard: file.hazard()?,
            alarms: alarms(file)?,
            added: Added::read(file)?,
            findings: file.findings()?,
            consistency: file.consistency()?,
            records: file.axes()?.records.len(),
            head,
            spectra,
            file: name,
            provenance,
        })
    }

    /// One line of provenance.
    pub fn provenance(&self) -> &str {
        &self.provenance
    }

    /// Every spectrum, by measure, then site, then probability.
    pub(super) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        let places = self.spectra.measures.iter().flat_map(|of| of.fits.blocks::<2>().map(move |(at, _)| (at, of)));
        places.zip(self.spectra.rows()).map(|((at, of_measure), spectrum)| Row {
            at,
            of_measure,
            spectrum,
            return_period: self.return_periods[at[1]],
        })
    }

    /// The bands of a spectrum, by size of the sample: the number of records and lower limit, median and upper limit
    /// over the strengths, m.
    pub(super) fn bands_of(&self, row: &Row<'_>) -> Vec<BandOf<'_>> {
        self.bands_of_measure(row)
            .map(|of| self.by_size(&of.plain, (of.inferred.as_ref(), None), row.at))
            .unwrap_or_default()
    }

    /// The same of the repaired spectrum; none where it has none.
    pub(super) fn repaired_bands_of(&self, row: &Row<'_>) -> Vec<BandOf<'_>> {
        let is_whole = |of: &&StoredRepairedBands| of.failed.block([row.at[0]]).iter().all(|share| !share.is_nan());
        let repaired = self.bands_of_measure(row).and_then(|of| of.repaired.as_ref()).filter(is_whole);
        repaired.map(|of| self.by_size(&of.bands, (None, Some(&of.failed)), row.at)).unwrap_or_default()
    }

    /// The bands of the plain spectrum over records and weighted hazard curves together; none where the site has no
    /// such curves.
    pub(super) fn joint_bands_of(&self, row: &Row<'_>) -> Vec<BandOf<'_>> {
        let joint = self.bands_of_measure(row).and_then(|of| of.plain.joint.as_ref());
        joint.map(|of| self.joint_by_size(of, row.at)).unwrap_or_default()
    }

    /// The same of the repaired spectrum; none either where one of the curves has no repair.
    pub(super) fn repaired_joint_bands_of(&self, row: &Row<'_>) -> Vec<BandOf<'_>> {
        let joint = self.bands_of_measure(row).and_then(|of| of.repaired.as_ref()?.bands.joint.as_ref());
        joint.map(|of| self.joint_by_size(of, row.at)).unwrap_or_default()
    }

    /// Those of the plain spectrum, then those of the repaired one, with what the weights of their records are and
    /// whether weighted hazard curves are drawn too.
    pub(super) fn all_bands_of(&self, row: &Row<'_>) -> impl Iterator<Item = (&'static str, BandOf<'_>)> {
        let named = [
            ("alike", self.bands_of(row)),
            ("alike, with hazard curves", self.joint_bands_of(row)),
            ("repaired", self.repaired_bands_of(row)),
            ("repaired, with hazard curves", self.repaired_joint_bands_of(row)),
        ];
        named.into_iter().flat_map(|(name, bands)| bands.into_iter().map(move |band| (name, band)))
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

    fn bands_of_measure(&self, row: &Row<'_>) -> Option<&MeasureBands> {
        self.bands.as_ref()?.of(row.spectrum.measure)
    }

    fn by_size<'a>(
        &self,
        of: &'a StoredSpectraBands,
        (inferred, failed): (Option<&'a InferredBands>, Option<&Array<2>>),
        [site, poe]: [usize; 2],
    ) -> Vec<BandOf<'a>> {
        let of_size = |(size, &records): (usize, &u32)| BandOf {
            records,
            limits_m: of.limits_m.each_ref().map(|limits| limits.block([site, poe, size])),
            inferred_m: inferred.map(|of| of.limits_m().map(|limits| limits.block([site, poe, size]))),
            error_of_median_pct: of.error_of_median[[site, poe, size]],
            range_of_interval_pct: of.range_of_interval[[site, poe, size]],
            failed_share: failed.map(|failed| failed[[site, size]]),
        };
        self.bands.iter().flat_map(|bands| bands.sizes.iter().enumerate()).map(of_size).collect()
    }

    /// Joint bands, by size of the sample; none at a site that has none.
    fn joint_by_size<'a>(&self, of: &'a StoredJointBands, [site, poe]: [usize; 2]) -> Vec<BandOf<'a>> {
        let of_size = |(size, &records): (usize, &u32)| BandOf {
            records,
            limits_m: of.limits_m.each_ref().map(|limits| limits.block([site, poe, size])),
            inferred_m: None,
            error_of_median_pct: f64::NAN,
            range_of_interval_pct: of.range_of_interval[[site, poe, size]],
            failed_share: of.failed.as_ref().map(|failed| failed[[site, size]]),
        };
        let is_there = |band: &BandOf<'_>| !band.limits_m[1].iter().all(|u_m| u_m.is_nan());
        let sizes = self.bands.iter().flat_map(|bands| bands.sizes.iter().enumerate());
        sizes.map(of_size).filter(is_there).collect()
    }

    /// Whether there are bands beyond the set.
    pub(super) fn has_inferred_bands(&self) -> bool {
        self.bands.iter().flat_map(|bands| &bands.measures).any(|of| of.inferred.is_some())
    }

    /// Whether there are bands of repaired spectra.
    pub(super) fn has_repaired_bands(&self) -> bool {
        self.bands.iter().flat_map(|bands| &bands.measures).any(|of| of.repaired.is_some())
    }

    /// Whether there are joint bands of plain spectra, and of repaired ones.
    pub(super) fn has_joint_bands(&self) -> [bool; 2] {
        let any =
            |is_there: fn(&MeasureBands) -> bool| self.bands.iter().flat_map(|bands| &bands.measures).any(is_there);
        [
            any(|of| of.plain.joint.is_some()),
            any(|of| of.repaired.as_ref().is_some_and(|own| own.bands.joint.is_some())),
        ]
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

/// The band of a spectrum for one size of the sample.
pub(super) struct BandOf<'a> {
    pub(super) records: u32,
    /// Lower limit, median and upper limit over the strengths, m.
    pub(super) limits_m: [&'a [f64]; 3],
    /// Limits of the spectra of all records there could be, and of another set, as
    /// [`INFERRED_BANDS`](uplift_result::INFERRED_BANDS) names them, m; none of repaired spectra, and in results of
    /// before.
    pub(super) inferred_m: Option<[&'a [f64]; 4]>,
    /// Error of the median (Eq. 4.9), %; NaN where there is none, as of joint bands.
    pub(super) error_of_median_pct: f64,
    /// Width of the interval (Eq. 4.10), %; NaN where there is none.
    pub(super) range_of_interval_pct: f64,
    /// Share of the samples whose weights miss the site's hazard; of repaired spectra alone.
    pub(super) failed_share: Option<f64>,
}

/// What the records scaled to one measure bring at a site.
pub(super) struct ConsistencyOf<'a> {
    pub(super) of: &'a StoredConsistency,
    pub(super) site: &'a str,
    /// Level that the records bring over the site's, by the probabilities of the study.
    pub(super) ratio: &'a [f64],
    /// Its mean over the rates compared; NaN without a verdict.
    pub(super) bias: f64,
    /// Largest |ln(implied/site)|; NaN without a verdict.
    pub(super) max: f64,
    /// Nothing where there is none.
    pub(super) verdict: Option<&'a str>,
    /// None before a repair; NaN where it failed.
    pub(super) least_effective: Option<f64>,
}

impl Export {
    /// What was found, by the measure that records are scaled to, then site; sites without two hazard curves are left
    /// out.
    pub(super) fn consistencies(&self) -> impl Iterator<Item = ConsistencyOf<'_>> {
        let of_measure = |of| self.spectra.sites.iter().enumerate().filter_map(move |at| consistency_of(of, at));
        self.consistency.iter().flat_map(of_measure)
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

fn consistency_of<'a>(of: &'a StoredConsistency, (at, site): (usize, &'a String)) -> Option<ConsistencyOf<'a>> {
    let is_known = of.rate_per_year.block([at]).iter().any(|rate| !rate.is_nan());
    is_known.then(|| ConsistencyOf {
        of,
        site,
        ratio: of.ratio.block([at]),
        bias: of.bias[at],
        max: of.max[at],
        verdict: Some(of.verdict[at].as_str()).filter(|verdict| !verdict.is_empty()),
        least_effective: of.least_effective.as_ref().map(|least| least[at]),
    })
}
