//! What consistency is asked of: the records, the stripes, and the hazard of every measure at every site.

use std::collections::{BTreeMap, BTreeSet};

use uplift_consistency::{LevelSets, Powers, RecordSet as ScaledSet, Seismology, SetRecord};
use uplift_hazard::{Extrapolation, HazardCurve};
use uplift_inputs::at_level::relative_factors;
use uplift_inputs::{BranchHazard, OtherHazard, RecordSet, SiteHazard};
use uplift_motion::IntensityMeasure;
use uplift_result::{ResultFile, StoredBranch};
use uplift_study::{Consistency, UniformRiskStudy};

use crate::error::UniformRiskError;

/// The branches of every measure and site that has some.
type WeightedCurves = BTreeMap<(IntensityMeasure, usize), Vec<StoredBranch>>;

#[derive(Debug, Clone)]
pub(crate) struct UnscaledRecord {
    /// Its name.
    pub(crate) id: String,
    /// The pair that it is a component of.
    pair: usize,
    /// Its earthquake, by its position among their names; none where it is not known.
    event: Option<usize>,
    /// Its measures, in their units.
    intensities: Intensities,
    seismology: Seismology,
}

/// Measures of an unscaled pair, in their units.
type Intensities = BTreeMap<IntensityMeasure, f64>;

impl UnscaledRecord {
    /// A number that the records of its earthquake share; of its pair alone where the earthquake is not known.
    pub(crate) fn earthquake(&self) -> usize {
        self.event.map_or(2 * self.pair, |event| 2 * event + 1)
    }

    /// A measure, in its unit; NaN where it is not known.
    fn intensity(&self, measure: IntensityMeasure) -> f64 {
        self.intensities.get(&measure).copied().unwrap_or(f64::NAN)
    }
}

/// What consistency is asked of.
#[derive(Debug, Clone)]
pub struct Question {
    /// What the study says of it.
    pub settings: Consistency,
    /// What happens to a stripe outside its curve.
    pub(crate) extrapolation: Extrapolation,
    /// Probabilities of exceedance.
    pub(crate) poes: Vec<f64>,
    /// Years that they refer to.
    pub(crate) years: f64,
    /// Their rates, 1/yr (Eq. 4.8).
    pub(crate) targets_per_year: Vec<f64>,
    /// Names of the sites.
    pub sites: Vec<String>,
    pub(crate) records: Vec<UnscaledRecord>,
    /// Whether these are synthetic.
    pub(super) synthetic: bool,
    /// Names of the earthquakes.
    pub(crate) events: Vec<String>,
    /// The measures that the records are scaled to, with their levels.
    pub(crate) analyses: Vec<(IntensityMeasure, Vec<f64>)>,
    /// The records of each level, where these are its own; of the one measure that there is then.
    level_sets: Option<LevelSets>,
    /// The hazard of every measure that a site has a curve of, `[measure][site]`.
    curves: BTreeMap<IntensityMeasure, Vec<Option<HazardCurve>>>,
    /// Weighted alternatives to them.
    pub(super) branches: WeightedCurves,
}

impl Question {
    /// What a study asks, with its records and hazard `[measure][site]`, that of measures which it is not analysed by
    /// in `other`.
    pub(crate) fn from_study(
        study: &UniformRiskStudy,
        records: &RecordSet,
        hazard: &[Vec<SiteHazard>],
        other: &[OtherHazard],
    ) -> Result<Self, UniformRiskError> {
        let targets_per_year = targets(&study.risk.poe, study.risk.years)?;
        let sites: Vec<String> = study.sites.iter().map(|site| site.name.clone()).collect();
        let mut curves: BTreeMap<IntensityMeasure, Vec<Option<HazardCurve>>> = BTreeMap::new();
        let known = hazard.iter().flatten().map(|site| (site.measure, &site.site, &site.curve.curve));
        for (measure, name, curve) in known.chain(other.iter().map(|other| (other.measure, &other.site, &other.curve)))
        {
            if let Some(site) = sites.iter().position(|site| site == name) {
                curves.entry(measure).or_insert_with(|| vec![None; sites.len()])[site] = Some(curve.clone());
            }
        }
        let mut branches = WeightedCurves::new();
        for (site, of) in hazard.iter().flat_map(|sites| sites.iter().enumerate()) {
            if !of.branches.is_empty() {
                let weighted = |branch: &BranchHazard| StoredBranch {
                    name: branch.name.clone(),
                    weight: branch.weight,
                    curve: branch.input.curve.clone(),
                };
                branches.insert((of.measure, site), of.branches.iter().map(weighted).collect());
            }
        }
        let rows = records.records.iter().map(|record| RawRecord {
            id: record.id.clone(),
            event: record.metadata.get("event").cloned().unwrap_or_default(),
            intensities: known_measures(record.further.keys().copied(), |measure| record.intensity(measure)),
            magnitude: record.number("magnitude"),
            rrup_km: record.number("rrup_km"),
            vs30: record.number("vs30"),
        });
        let level_sets = match (&records.at_level, study.measures.first()) {
            (Some(of), Some(plan)) => {
                let relative = of.relative_factors(&records.records, plan);
                Some(LevelSets::new(records.records.len(), relative, of.shares.clone())?)
            }
            _ => None,
        };
        let synthetic = records.synthetic;
        let (records, events) = unscaled_records(rows, study);
        Ok(Self {
            synthetic,
            settings: study.consistency.clone(),
            extrapolation: study.risk.extrapolate,
            poes: study.risk.poe.clone(),
            years: study.risk.years,
            targets_per_year,
            sites,
            records,
            events,
            level_sets,
            analyses: study.measures.iter().map(|plan| (plan.measure, plan.levels.to_vec())).collect(),
            curves,
            branches,
        })
    }

    /// What the result `file` is asked of its motions, each once, whatever structures they shake.
    ///
    /// # Errors
    /// As [`from_result`](Self::from_result).
    pub fn from_motions(file: &ResultFile) -> Result<Self, UniformRiskError> {
        let structures = file.stored_study()?.structures_of_a_motion();
        let mut question = Self::from_result(file)?;
        question.records = question.records.into_iter().step_by(structures).collect();
        Ok(question)
    }

    /// The same at other probabilities.
    pub(super) fn at(&self, poes: &[f64], years: f64) -> Result<Self, UniformRiskError> {
        Ok(Self { poes: poes.to_vec(), years, targets_per_year: targets(poes, years)?, ..self.clone() })
    }

    /// What the result `file` is asked, at the probabilities of its study: the range of rates and the weights are of
    /// these, whatever else spectra are read at.
    ///
    /// # Errors
    /// Records and hazard that cannot be held against each other.
    pub fn from_result(file: &ResultFile) -> Result<Self, UniformRiskError> {
        let study = file.stored_study()?;
        let axes = file.stored_axes()?;
        let stored = file.records()?;
        let analyses = file.levels()?;
        let mut curves = BTreeMap::new();
        for measure in IntensityMeasure::OF_CHAPTER_4.into_iter().chain(stored.further.keys().copied()) {
            let of_sites =
                axes.sites.iter().map(|site| file.mean_curve(site, measure)).collect::<Result<Vec<_>, _>>()?;
            if of_sites.iter().any(Option::is_some) {
                curves.insert(measure, of_sites);
            }
        }
        let mut branches = WeightedCurves::new();
        for (measure, _) in &analyses {
            for (site, name) in axes.sites.iter().enumerate() {
                let own = file.branches(name, *measure)?;
                if !own.is_empty() {
                    branches.insert((*measure, site), own);
                }
            }
        }
        let rows = (0..stored.ids.len()).map(|record| RawRecord {
            id: stored.ids[record].clone(),
            event: stored.event[record].clone(),
            intensities: known_measures(stored.further.keys().copied(), |measure| {
                stored.intensities(measure).map_or(f64::NAN, |values| values[record])
            }),
            magnitude: stored.magnitude[record],
            rrup_km: stored.rrup_km[record],
            vs30: stored.vs30[record],
        });
        let mut level_sets = None;
        for (measure, levels) in &analyses {
            if let Some(sets) = file.sets_of_levels(stored.ids.len(), *measure, levels.len())? {
                let intensities = stored.intensities(*measure).unwrap_or_default();
                let relative = relative_factors(&sets.factors, *measure, levels, intensities);
                level_sets = Some(LevelSets::new(stored.ids.len(), relative, sets.shares)?);
            }
        }
        let (records, events) = unscaled_records(rows, &study);
        Ok(Self {
            synthetic: file.is_synthetic()?,
            level_sets,
            settings: study.consistency,
            extrapolation: study.risk.extrapolate,
            targets_per_year: targets(&axes.poes, axes.years)?,
            poes: axes.poes,
            years: axes.years,
            sites: axes.sites,
            records,
            events,
            analyses,
            curves,
            branches,
        })
    }

    /// The earthquake of each record, `[record]`, as a number that its records share.
    pub fn event_of(&self) -> Vec<usize> {
        self.records.iter().map(UnscaledRecord::earthquake).collect()
    }

    /// The pair of each record, `[record]`, as a number that its components share.
    pub fn pair_of(&self) -> Vec<usize> {
        self.records.iter().map(|record| record.pair).collect()
    }

    /// Whether two pairs are known to be of one earthquake.
    pub fn shares_earthquakes(&self) -> bool {
        let mut pair_of = BTreeMap::new();
        let mut known = self.records.iter().filter_map(|record| Some((record.event?, record.pair)));
        known.any(|(event, pair)| *pair_of.entry(event).or_insert(pair) != pair)
    }

    /// How many earthquakes the records are of, those that are not known one for each pair; none where none is known.
    pub fn earthquakes(&self) -> Option<usize> {
        let all: BTreeSet<usize> = self.event_of().into_iter().collect();
        self.records.iter().any(|record| record.event.is_some()).then_some(all.len())
    }

    /// The levels that records are scaled to by a measure; none where it is not analysed by it.
    pub fn levels(&self, measure: IntensityMeasure) -> &[f64] {
        self.analyses.iter().find(|(own, _)| *own == measure).map_or(&[], |(_, levels)| levels)
    }

    pub(crate) fn curve(&self, measure: IntensityMeasure, site: usize) -> Option<&HazardCurve> {
        self.curves.get(&measure)?.get(site)?.as_ref()
    }

    /// The measure that a set scaled to `scaled_to` is asked about: the one that the study names, else the first with a
    /// curve, PGV before PGA; none where no site has a curve of another.
    pub(crate) fn other(&self, scaled_to: IntensityMeasure) -> Option<IntensityMeasure> {
        let measures: Vec<IntensityMeasure> = self.curves.keys().copied().collect();
        self.other_among(&measures, scaled_to)
    }

    /// The same where hazard is known of `measures`, in their order.
    pub fn other_among(&self, measures: &[IntensityMeasure], scaled_to: IntensityMeasure) -> Option<IntensityMeasure> {
        let is_other = |measure: &IntensityMeasure| *measure != scaled_to && measures.contains(measure);
        let named = self.settings.against.filter(is_other);
        named.or_else(|| measures.iter().copied().find(is_other))
    }

    /// Whether any site has curves of two measures.
    pub fn can_be_asked(&self) -> bool {
        let has_both = |site: usize| self.curves.values().filter(|curves| curves[site].is_some()).count() > 1;
        (0..self.sites.len()).any(has_both)
    }

    /// Whether each level has records of its own.
    pub(super) fn has_level_sets(&self) -> bool {
        self.level_sets.is_some()
    }

    /// How many records the stripe at `level` has.
    pub(super) fn records_at(&self, level: usize) -> usize {
        let all = self.records.len();
        let shares = self.level_sets.as_ref().and_then(LevelSets::shares);
        shares.map_or(all, |shares| shares[level * all..][..all].iter().filter(|share| **share > 0.0).count())
    }

    /// The records with the measure that they are scaled to and the other one.
    ///
    /// # Errors
    /// Records and hazard that cannot be held against each other.
    pub fn set(&self, scaled_to: IntensityMeasure, other: IntensityMeasure) -> Result<ScaledSet, UniformRiskError> {
        let row = |record: &UnscaledRecord| SetRecord {
            scaled_to: record.intensity(scaled_to),
            other: record.intensity(other),
            pair: record.pair,
            event: record.event,
            seismology: record.seismology,
        };
        let power = |measure: IntensityMeasure| f64::from(measure.power());
        let powers = Powers { scaled_to: power(scaled_to), other: power(other) };
        let set = ScaledSet::with_powers(self.records.iter().map(row).collect(), powers)?;
        Ok(match &self.level_sets {
            Some(own) => set.at_level(own.clone())?,
            None => set,
        })
    }
}

/// Target rates of probabilities, 1/yr (Eq. 4.8).
fn targets(poes: &[f64], years: f64) -> Result<Vec<f64>, UniformRiskError> {
    let rate = |&poe: &f64| Ok(uplift_hazard::rate_from_probability(poe, years)?);
    poes.iter().map(rate).collect()
}

/// The measures of Chapter 4 and `further` ones, each with its value.
fn known_measures(
    further: impl Iterator<Item = IntensityMeasure>,
    value: impl Fn(IntensityMeasure) -> f64,
) -> Intensities {
    IntensityMeasure::OF_CHAPTER_4.into_iter().chain(further).map(|measure| (measure, value(measure))).collect()
}

/// A record as a study or a result has it; NaN where a number is not known, empty where the earthquake is not.
struct RawRecord {
    id: String,
    event: String,
    intensities: Intensities,
    magnitude: f64,
    rrup_km: f64,
    vs30: f64,
}

/// The records, and the names of their earthquakes.
fn unscaled_records(
    rows: impl Iterator<Item = RawRecord>,
    study: &UniformRiskStudy,
) -> (Vec<UnscaledRecord>, Vec<String>) {
    let (mut pairs, mut events): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    let position = |known: &mut Vec<String>, name: &str| {
        known.iter().position(|known| known == name).unwrap_or_else(|| {
            known.push(name.to_owned());
            known.len() - 1
        })
    };
    let records = rows
        .map(|row| {
            let pair = position(&mut pairs, study.pair_of_record(&row.id));
            // what the program made is of no earthquake
            let known = !row.event.is_empty() && !row.event.to_lowercase().starts_with("synthetic");
            let number = |value: f64| value.is_finite().then_some(value);
            UnscaledRecord {
                pair,
                event: known.then(|| position(&mut events, &row.event)),
                intensities: row.intensities,
                seismology: Seismology {
                    magnitude: number(row.magnitude),
                    distance_km: number(row.rrup_km),
                    vs30_m_s: number(row.vs30),
                },
                id: row.id,
            }
        })
        .collect();
    (records, events)
}
