//! What there is of each site of a table: the declared quantities of its arrays, tables and map, and their values.

use uplift_inputs::SiteList;
use uplift_result::declared::{Group, Names, Quantity};
use uplift_result::layout::axis::STRENGTH;
use uplift_result::{
    BandKind, FRACTILES, Fit, REPAIRED_SITE_NAMES, SITE_BANDS, SITE_CONSISTENCY, SITE_FITS, SITE_NAMES, SITE_PROBLEMS,
    SITE_SPECTRA, SITE_SPREADS, SiteConsistency, SiteSpectrum,
};
use uplift_study::{Repair, UniformRiskStudy};
use uplift_uniform_risk::SiteSpectra;

use super::repair::RepairedSite;

/// The array and the column that say why there is no spectrum or no fit.
pub(in crate::uniform_risk) const PROBLEM: &str = SITE_PROBLEMS.quantities[0].name;

const NO_EXPONENTIAL: &str = "the spectrum is not a decaying exponential: its coefficients mean nothing one by one";

/// What there is of each site.
#[derive(Clone)]
pub(super) struct Shape {
    pub(super) measures: usize,
    pub(super) poes: usize,
    /// Positions of the strengths that are written among those of the study.
    pub(super) strengths: Vec<usize>,
    has_bands: bool,
    /// Whether there are means and fractiles over weighted hazard curves.
    has_spread: bool,
    /// Whether there are repaired spectra beside the plain ones.
    pub(super) is_repaired: bool,
    /// Every array of floats over the strengths.
    pub(super) ordinates: Vec<SpectrumArray>,
}

/// A quantity of plain or repaired spectra.
#[derive(Clone, Copy)]
pub(super) struct SpectrumArray {
    kind: BandKind,
    pub(super) group: &'static Group<SiteSpectrum>,
    pub(super) quantity: &'static Quantity<SiteSpectrum>,
}

/// What is known of one site; spectra by measure, then probability.
pub(super) struct SiteValues<'a> {
    pub(super) plain: Vec<Option<SiteSpectrum>>,
    /// None in a table without repair.
    repaired: Vec<Option<SiteSpectrum>>,
    /// Why there is no spectrum or no fit; empty where there are both.
    pub(super) problems: Vec<String>,
    /// Why there is no repaired spectrum or no fit to it.
    pub(super) no_repair: Vec<String>,
    /// By measure; none in a table without repair.
    pub(super) consistency: Vec<&'a SiteConsistency>,
}

impl Shape {
    pub(super) fn new(study: &UniformRiskStudy, list: &SiteList, strengths: Vec<usize>) -> Self {
        let mut shape = Self {
            measures: list.exports.len(),
            poes: study.risk.poe.len(),
            strengths,
            has_bands: study.site_table.as_ref().is_some_and(|table| table.bands),
            has_spread: !list.branches.is_empty(),
            is_repaired: study.consistency.repair == Repair::Weights,
            ordinates: Vec::new(),
        };
        // the spread is of the plain spectra alone
        let spreads = SpectrumArray::all(BandKind::PLAIN, &SITE_SPREADS).filter(|_| shape.has_spread);
        shape.ordinates = shape.kinds().flat_map(|kind| shape.spectra(kind)).chain(spreads).collect();
        shape
    }

    /// The kinds of spectra.
    pub(super) fn kinds(&self) -> impl Iterator<Item = BandKind> {
        [BandKind::PLAIN, BandKind::REPAIRED].into_iter().take(1 + usize::from(self.is_repaired))
    }

    /// Displacements of a kind, and the limits of their bands.
    pub(super) fn spectra(&self, kind: BandKind) -> impl Iterator<Item = SpectrumArray> {
        SpectrumArray::all(kind, &SITE_SPECTRA).chain(SpectrumArray::all(kind, &SITE_BANDS).filter(|_| self.has_bands))
    }

    /// The coefficients of a kind.
    pub(super) fn fits(kind: BandKind) -> impl Iterator<Item = SpectrumArray> {
        SpectrumArray::all(kind, &SITE_FITS)
    }

    /// Every array of floats of the spectra.
    pub(super) fn floats(&self) -> impl Iterator<Item = SpectrumArray> {
        self.ordinates.iter().copied().chain(self.kinds().flat_map(Self::fits))
    }

    /// The arrays of consistency.
    pub(super) fn consistency(&self) -> impl Iterator<Item = &'static Quantity<SiteConsistency>> {
        SITE_CONSISTENCY.quantities.iter().filter(|_| self.is_repaired)
    }

    /// The spectra of a site by one measure.
    fn values(&self, spectra: Option<&SiteSpectra>) -> Vec<Option<SiteSpectrum>> {
        let Some(spectra) = spectra else { return vec![None; self.poes] };
        let at_poe = |poe: usize| {
            let (ordinates, bands_m) = spectra.at_poe(poe);
            let mut spread_m = spectra.spread_at_poe(poe).to_vec();
            if self.has_spread {
                // unknown where a realization has no curve
                spread_m.resize(self.strengths.len(), [f64::NAN; 1 + FRACTILES.len()]);
            }
            Some(SiteSpectrum {
                u_m: self.strengths.iter().map(|&own| ordinates[own].displacement_m).collect(),
                flags: self.strengths.iter().map(|&own| ordinates[own].flag).collect(),
                bands_m: bands_m.to_vec(),
                spread_m,
                fit: Fit::from_exponential(spectra.fits[poe].as_ref().ok()),
            })
        };
        (0..self.poes).map(at_poe).collect()
    }
}

impl SpectrumArray {
    fn all(kind: BandKind, group: &'static Group<SiteSpectrum>) -> impl Iterator<Item = Self> {
        group.quantities.iter().map(move |quantity| Self { kind, group, quantity })
    }

    /// Its name in a table.
    pub(super) fn column(&self) -> String {
        self.kind.column(&self.name())
    }

    /// Its name in the file.
    pub(super) fn name(&self) -> String {
        self.quantity.name(self.names())
    }

    /// What stands for the names in its declaration.
    pub(super) fn names(&self) -> Names<'static> {
        if self.kind.is_repaired { &REPAIRED_SITE_NAMES } else { &SITE_NAMES }
    }

    /// Its spectra among those of a site.
    fn spectra<'a>(&self, site: &'a SiteValues<'_>) -> &'a [Option<SiteSpectrum>] {
        if self.kind.is_repaired { &site.repaired } else { &site.plain }
    }

    /// Its value in the spectrum at a position among those of a site, at the place of a strength.
    pub(super) fn value(&self, site: &SiteValues<'_>, spectrum: usize, place: usize) -> Option<f64> {
        self.quantity.number(self.spectra(site)[spectrum].as_ref()?, place)
    }

    /// All its values of a site; NaN where there is no spectrum.
    pub(super) fn values(&self, site: &SiteValues<'_>, shape: &Shape) -> Vec<f64> {
        let places = if self.quantity.axes.contains(&STRENGTH.name) { shape.strengths.len() } else { 1 };
        let all = |spectrum| (0..places).map(move |place| self.value(site, spectrum, place).unwrap_or(f64::NAN));
        (0..self.spectra(site).len()).flat_map(all).collect()
    }
}

impl<'a> SiteValues<'a> {
    /// A site with its spectra in each export, or why it has none, and with its repair by each.
    pub(super) fn new(shape: &Shape, spectra: &[Result<SiteSpectra, String>], repaired: &'a [RepairedSite]) -> Self {
        let why = |of: &Result<SiteSpectra, String>, poe: usize| match of.as_ref().map(|own| own.fits[poe].as_ref()) {
            Err(reason) => reason.clone(),
            Ok(Err(reason)) => format!("no fit: {reason}"),
            Ok(Ok(_)) => String::new(),
        };
        let problem = |of: &Result<SiteSpectra, String>, poe: usize| match of.as_ref().map(|own| own.fits[poe].as_ref())
        {
            Ok(Ok(fit)) if fit.at_search_limit => NO_EXPONENTIAL.to_owned(),
            _ => why(of, poe),
        };
        let poes = || 0..shape.poes;
        Self {
            plain: spectra.iter().flat_map(|own| shape.values(own.as_ref().ok())).collect(),
            repaired: repaired.iter().flat_map(|own| shape.values(own.spectra.as_ref().ok())).collect(),
            problems: spectra.iter().flat_map(|own| poes().map(move |poe| problem(own, poe))).collect(),
            no_repair: repaired.iter().flat_map(|own| poes().map(move |poe| why(&own.spectra, poe))).collect(),
            consistency: repaired.iter().map(|own| &own.consistency).collect(),
        }
    }
}
