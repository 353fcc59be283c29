//! What alarms are raised from: the spectra of a result with all that the file knows of them.

use uplift_hazard::{HazardCurve, rate_from_probability};
use uplift_job::text::{risk_in_words, risk_name};
use uplift_motion::IntensityMeasure;
use uplift_result::{MeasureSpectra, ResultFile, StoredBands, StoredConsistency, StoredHazard, StoredSpectra};
use uplift_study::UniformRiskStudy;
use uplift_uniform_risk::consistency::least_effective;

use crate::error::AlarmsError;

/// The spectra of a result, its study, hazard and bands.
#[derive(Debug, Clone)]
pub struct Evidence {
    pub(crate) study: UniformRiskStudy,
    pub(crate) spectra: StoredSpectra,
    /// By measure, as the spectra; weighted curves of the sites alone that are asked about.
    pub(crate) hazard: Vec<StoredHazard>,
    /// Curves of measures that the study is not analysed by, with the position of the site.
    pub(crate) other_curves: Vec<(usize, IntensityMeasure, HazardCurve)>,
    pub(crate) bands: Option<StoredBands>,
    /// Position of each probability of the spectra among those of the bands.
    pub(super) poes_of_bands: Vec<Option<usize>>,
    /// By the measure that records are scaled to.
    pub(crate) consistency: Vec<StoredConsistency>,
    /// [`least_effective`] records of each of these, `[site]`.
    pub(super) least_effective: Vec<Option<Vec<f64>>>,
}

/// Which of the spectra are asked about; all where nothing is said.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Scope {
    /// Position of the site.
    pub site: Option<usize>,
    /// The measure.
    pub measure: Option<IntensityMeasure>,
    /// Position of the probability.
    pub poe: Option<usize>,
    /// The strengths between which the spectra are read, both included.
    pub strengths: Option<(f64, f64)>,
    /// Whether it is asked by repaired spectra, so that what is wrong with the plain ones is of no account; of rates of
    /// structures, whether those by repaired weights are told.
    pub repaired: bool,
    /// Whether a design asks, which takes repaired spectra itself.
    pub for_design: bool,
}

impl Scope {
    pub(super) fn holds_site(&self, site: usize) -> bool {
        self.site.is_none_or(|wanted| wanted == site)
    }

    pub(super) fn holds(&self, site: usize, measure: IntensityMeasure) -> bool {
        self.holds_site(site) && self.measure.is_none_or(|wanted| wanted == measure)
    }

    pub(super) fn holds_poe(&self, poe: usize) -> bool {
        self.poe.is_none_or(|wanted| wanted == poe)
    }

    pub(super) fn holds_strength(&self, strength: f64) -> bool {
        self.strengths.is_none_or(|(a, b)| (a..=b).contains(&strength))
    }
}

/// `Athens, PGV, 2 %`.
pub fn spectrum_name(site: &str, measure: IntensityMeasure, risk: &str) -> String {
    format!("{site}, {}, {risk}", measure.label())
}

/// One spectrum within a scope.
pub(super) struct Place<'a> {
    pub(super) of_measure: &'a MeasureSpectra,
    pub(super) curve: &'a HazardCurve,
    pub(super) site: usize,
    pub(super) poe: usize,
    /// Positions of the strengths that are asked about.
    pub(super) strengths: Vec<usize>,
    /// `Athens, PGV, 2 %`.
    pub(super) name: String,
}

impl Evidence {
    /// Reads what is asked about within `scope`.
    ///
    /// # Errors
    /// A file that is damaged, of another kind, or without sites.
    pub(crate) fn read(file: &ResultFile, scope: &Scope) -> Result<Self, AlarmsError> {
        let (study, spectra) = (file.stored_study()?, file.spectra()?);
        let is_analysed = |measure| spectra.measures.iter().any(|of| of.measure == measure);
        let mut other_curves = Vec::new();
        for (site, name) in spectra.sites.iter().enumerate().filter(|(site, _)| scope.holds_site(*site)) {
            let listed = study.sites.iter().find(|listed| listed.name == *name);
            let measures = listed.iter().flat_map(|listed| listed.curves.iter().map(|file| file.measure));
            for measure in measures.filter(|measure| !is_analysed(*measure)) {
                other_curves.extend(file.mean_curve(name, measure)?.map(|curve| (site, measure, curve)));
            }
        }
        let all = || (0..spectra.poes.len()).map(Some).collect();
        let (bands, poes_of_bands) = match file.bands()? {
            None if file.is_at_target_risks() => (file.stored_bands()?, stored_poes(file, &spectra)?),
            bands => (bands, all()),
        };
        let consistency = file.consistency()?;
        Ok(Self {
            study,
            spectra,
            other_curves,
            hazard: file.hazard_with_branches(|site| scope.holds_site(site))?,
            bands,
            poes_of_bands,
            least_effective: consistency.iter().map(|of| least_effective(file, of)).collect::<Result<_, _>>()?,
            consistency,
        })
    }

    /// Every spectrum within `scope`.
    pub(super) fn places(&self, scope: &Scope) -> Vec<Place<'_>> {
        let spectra = &self.spectra;
        let strengths: Vec<usize> = (0..spectra.strengths.len())
            .filter(|&strength| scope.holds_strength(spectra.strengths[strength]))
            .collect();
        let mut places = Vec::new();
        for (of_measure, hazard) in spectra.measures.iter().zip(&self.hazard) {
            for (site, curves) in hazard.sites.iter().enumerate() {
                for poe in 0..spectra.poes.len() {
                    if scope.holds(site, of_measure.measure) && scope.holds_poe(poe) && !strengths.is_empty() {
                        let curve = &curves.curve;
                        let name = self.name(site, of_measure.measure, poe);
                        places.push(Place { of_measure, curve, site, poe, strengths: strengths.clone(), name });
                    }
                }
            }
        }
        places
    }

    /// `Athens, PGV, 2 %`.
    pub(super) fn name(&self, site: usize, measure: IntensityMeasure, poe: usize) -> String {
        spectrum_name(&self.spectra.sites[site], measure, &self.risk(poe))
    }

    /// `2 %`, or `2 % in 100 years` where other years are asked for than those of the study.
    pub(super) fn risk(&self, poe: usize) -> String {
        let (probability, years) = (self.spectra.poes[poe], self.spectra.years);
        let are_of_study = years.to_bits() == self.study.risk.years.to_bits();
        if are_of_study { risk_name(probability, years) } else { risk_in_words(probability, years) }
    }

    /// Target rate of a probability, 1/yr (Eq. 4.8).
    pub(super) fn target_per_year(&self, poe: usize) -> Result<f64, AlarmsError> {
        Ok(rate_from_probability(self.spectra.poes[poe], self.spectra.years)?)
    }
}

/// Position of each probability of `spectra` among those of the study of a result.
fn stored_poes(file: &ResultFile, spectra: &StoredSpectra) -> Result<Vec<Option<usize>>, AlarmsError> {
    let stored = file.stored_axes()?;
    let is_same = |a: f64, b: f64| a.to_bits() == b.to_bits();
    let place =
        |poe: &f64| stored.poes.iter().position(|own| is_same(*own, *poe) && is_same(stored.years, spectra.years));
    Ok(spectra.poes.iter().map(place).collect())
}
