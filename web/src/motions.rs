//! The motions that shake structures: the embedded records, which are made here to the same bits as by `uplift`, or
//! record files that were dropped.

use serde_json::{Value, json};
use uplift_motion::synthetic::{Pairs, SyntheticSetOptions};
use uplift_motion::{
    Accelerogram, Combination, Component, Horizontal, IntensityMeasure, MotionError, ReadOptions, RecordPair,
    read_record,
};
use uplift_study::RecordSource;

use crate::calculator::{Answer, refused};
use crate::stripes::Stripes;

/// Most records that are dropped at once: some minutes of analysis.
const MOST_DROPPED: usize = 200;

/// What the page asks for, by its labels.
const UNKNOWN_UNIT: &str = "unit: choose “Unit of records without one”";
const UNKNOWN_STEP: &str = "time step: give “Time step of records without one”";

/// A motion with the measure that it is scaled by.
pub(crate) enum Motion {
    /// A component of a pair, whose measure is that of both.
    OfPair(Box<RecordPair>, Horizontal),
    /// A component alone, whose measure is its own, with its name and its row of a manifest.
    Alone(String, Accelerogram, String),
}

impl Motion {
    /// Its name.
    pub(crate) fn id(&self) -> &str {
        match self {
            Self::OfPair(pair, _) => &pair.id,
            Self::Alone(id, ..) => id,
        }
    }

    /// Its row of the manifest of dropped records.
    pub(crate) fn row(&self) -> &str {
        match self {
            Self::OfPair(..) => "",
            Self::Alone(.., row) => row,
        }
    }

    /// What shakes.
    pub(crate) fn accelerogram(&self) -> &Accelerogram {
        match self {
            Self::OfPair(pair, which) => pair.component(*which),
            Self::Alone(_, accelerogram, _) => accelerogram,
        }
    }

    /// Its measure, unscaled, in the unit of the measure.
    pub(crate) fn intensity(&self, measure: IntensityMeasure, gravity_m_s2: f64) -> f64 {
        match self {
            Self::OfPair(pair, _) => measure.pair_value(pair, gravity_m_s2),
            Self::Alone(_, accelerogram, _) => measure.component_value(accelerogram, gravity_m_s2),
        }
    }
}

/// The motions of the stripes, or those that were dropped.
#[derive(Default)]
pub(crate) struct Motions {
    /// How the embedded records are made, which component shakes, and those of them that the stripes have; none where
    /// the records of the stripes are files.
    recipe: Option<(SyntheticSetOptions, Horizontal, Vec<String>)>,
    made: Vec<Motion>,
    dropped: Vec<Motion>,
    gravity_m_s2: f64,
}

impl Motions {
    /// Those that `stripes` were made with, as far as they can be made.
    pub(crate) fn from_stripes(stripes: &Stripes) -> Self {
        let of = &stripes.study.records;
        let which = match of.component {
            Component::H1 => Some(Horizontal::H1),
            Component::H2 => Some(Horizontal::H2),
            _ => None,
        };
        let recipe = match (&of.source, which) {
            // others are scaled by what no pair tells
            (&RecordSource::Synthetic { pairs, seed }, Some(which)) if of.intensity == Combination::GeometricMean => {
                let pairs = usize::try_from(pairs).unwrap_or(usize::MAX);
                let options = SyntheticSetOptions { pairs, seed, ..SyntheticSetOptions::default() };
                Some((options, which, stripes.records.clone()))
            }
            _ => None,
        };
        Self { recipe, gravity_m_s2: stripes.study.gravity_m_s2, ..Self::default() }
    }

    /// Adds the components of a record file, each a record of its own.
    pub(crate) fn add(
        &mut self,
        (file, name): (&[u8], &str),
        (unit, dt_s): (Option<String>, Option<f64>),
    ) -> Answer<Value> {
        let known_unit = unit.as_deref().map(str::parse).transpose().map_err(refused)?;
        let options = ReadOptions { gravity_m_s2: self.gravity_m_s2, unit: known_unit, dt_s, ..ReadOptions::default() };
        let read = read_record(file, name, &options).map_err(|error| match error {
            MotionError::MissingUnit { name, .. } => format!("{name}: the file names no {UNKNOWN_UNIT}"),
            MotionError::MissingTimeStep { name } => format!("{name}: the file names no {UNKNOWN_STEP}"),
            MotionError::MissingUnitAndTimeStep { name } => {
                format!("{name}: the file names no {UNKNOWN_UNIT}; and no {UNKNOWN_STEP}")
            }
            error => refused(error),
        })?;
        let is_horizontal = |own: &uplift_motion::Recording| {
            own.description.orientation.is_none_or(uplift_motion::Orientation::is_horizontal)
        };
        let several = read.recordings.iter().filter(|own| is_horizontal(own)).count() > 1;
        let horizontal = read.recordings.into_iter().enumerate().filter(|(_, own)| is_horizontal(own));
        let added: Vec<Motion> = horizontal
            .map(|(place, own)| {
                let number = several.then_some(place + 1);
                let id = number.map_or_else(|| name.to_owned(), |number| format!("{name}:{number}"));
                let quoted = |text: &str| format!("\"{}\"", text.replace('"', "\"\""));
                // twice, since a manifest has pairs
                let component = format!("{},{}", quoted(name), number.map_or_else(String::new, |own| own.to_string()));
                let named = [unit.clone().unwrap_or_default(), dt_s.map_or_else(String::new, |own| own.to_string())];
                let row = format!("{},{component},{component},{}\n", quoted(&id), named.join(","));
                Motion::Alone(id, own.accelerogram, row)
            })
            .collect();
        if added.is_empty() {
            return Err(format!("{name}: holds no horizontal component"));
        }
        if let Some(again) = added.iter().find(|own| self.dropped.iter().any(|known| known.id() == own.id())) {
            return Err(format!("{}: a record of this name was dropped before", again.id()));
        }
        if self.dropped.len() + added.len() > MOST_DROPPED {
            return Err(format!("{name}: the page takes {MOST_DROPPED} records at most: run the saved study"));
        }
        self.dropped.extend(added);
        Ok(json!({ "format": read.format.key(), "records": self.dropped.len() }))
    }

    /// Forgets what was dropped.
    pub(crate) fn forget(&mut self) {
        self.dropped.clear();
    }

    /// Refuses records that were dropped and are not those of the stripes: what is said of them would stand beside a
    /// spectrum of others.
    pub(crate) fn are_those_of(&self, stripes: &Stripes) -> Answer<()> {
        let are_others = if stripes.manifest.is_some() {
            self.dropped.len() != stripes.records.len()
        } else {
            self.recipe.is_some() && !self.dropped.is_empty()
        };
        if are_others { Err("analyse the dropped records first, or forget them".to_owned()) } else { Ok(()) }
    }

    /// Those that were dropped.
    pub(crate) fn dropped(&self) -> &[Motion] {
        &self.dropped
    }

    /// Those that were dropped, else those of the stripes, which are made when they are first needed.
    pub(crate) fn all(&mut self) -> Answer<&[Motion]> {
        if !self.dropped.is_empty() {
            return Ok(&self.dropped);
        }
        if self.made.is_empty() {
            let no_records =
                "the records of this result are not in the page: drop them here to analyse the structure itself";
            let (options, which, wanted) = self.recipe.as_ref().ok_or(no_records)?;
            let pairs: Vec<RecordPair> =
                Pairs::from_options(options).and_then(Iterator::collect::<Result<_, MotionError>>).map_err(refused)?;
            let chosen = pairs.into_iter().filter(|pair| wanted.contains(&pair.id));
            self.made = chosen.map(|pair| Motion::OfPair(Box::new(pair), *which)).collect();
        }
        Ok(&self.made)
    }

    /// Those of [`all`](Self::all), if they are there.
    pub(crate) fn known(&self) -> &[Motion] {
        if self.dropped.is_empty() { &self.made } else { &self.dropped }
    }

    /// Names and measures.
    pub(crate) fn about(&mut self) -> Answer<Value> {
        let gravity_m_s2 = self.gravity_m_s2;
        let about = |own: &Motion| {
            json!({
                "id": own.id(),
                "pgv_cm_s": own.intensity(IntensityMeasure::Pgv, gravity_m_s2),
                "pga_g": own.intensity(IntensityMeasure::Pga, gravity_m_s2),
                "duration_s": own.accelerogram().duration_s(),
            })
        };
        Ok(self.all()?.iter().map(about).collect())
    }

    /// One of [`all`](Self::all), scaled to a level of a measure.
    pub(crate) fn scaled(&mut self, motion: usize, measure: &str, level: f64) -> Answer<Accelerogram> {
        let (measure, gravity_m_s2): (IntensityMeasure, f64) = (measure.parse().map_err(refused)?, self.gravity_m_s2);
        let own = self.all()?.get(motion).ok_or("there is no such record")?;
        let factor = level / own.intensity(measure, gravity_m_s2);
        own.accelerogram().scaled(factor).map_err(refused)
    }
}
