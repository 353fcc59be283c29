//! What the page asks, and where it is answered.

use serde::Deserialize;
use serde_json::{Value, json};
use uplift_hazard::{probability_from_rate, rate_from_probability};
use uplift_plausible::RETURN_PERIOD;

use crate::analysis::Analysis;
use crate::curves::{Choice, DroppedCurve, Found};
use crate::motions::Motions;
use crate::stripes::Stripes;
use crate::structure::Peaks;

/// Why a question has no answer: the message of the crate that refused, or of the page's own.
pub(crate) type Answer<T> = Result<T, String>;

/// The message of an error.
#[expect(clippy::needless_pass_by_value, reason = "what `map_err` hands over")]
pub(crate) fn refused(error: impl ToString) -> String {
    error.to_string()
}

/// A question of the page.
#[derive(Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case")]
enum Question {
    /// Takes the stripes of a result, the file.
    Stripes,
    /// What the stripes hold.
    About,
    /// A spectrum, its band and the hazard curve.
    Spectrum(At),
    /// An ordinate and the fragility there.
    Point { at: At, strength: f64 },
    /// Reads hazard curves out of the file; `choice` says what a table does not say.
    Curves { name: String, choice: Option<Choice> },
    /// Adds a site with the curves of these numbers, which go on beyond their ends where `extrapolate` says so.
    Site { name: String, curves: Vec<usize>, extrapolate: bool },
    /// Reads a record file; `unit` and `step_s` are of one that does not name its own.
    Record { name: String, unit: Option<String>, step_s: Option<f64> },
    /// Forgets the record files.
    NoRecords,
    /// The names of the motions, and their measures.
    Motions,
    /// A structure held against the spectrum.
    Structure { text: String, at: Option<At>, safety_factor: f64 },
    /// The motion of a structure.
    Motion { text: String, motion: usize, measure: String, level: f64 },
    /// Begins the analysis of the dropped records.
    AnalyseRecords,
    /// The peaks of a structure under all motions at a level, against a demand on it: goes on by one record.
    Peaks { text: String, measure: String, level: f64, demand_m: f64 },
    /// Begins the analysis of a structure, and of the block that rotates as it does.
    AnalyseStructure { text: String, at: At, block: bool, safety_factor: f64 },
    /// Goes on with what was begun, by one record.
    Step,
    /// Ends what was begun.
    Stop,
    /// The study file with its hazard curves.
    Study(At),
}

/// A spectrum: where, by which measure, how rare.
#[derive(Debug, Clone, Deserialize)]
pub(crate) struct At {
    /// Name of the site.
    pub(crate) site: String,
    /// Key of the measure, `pgv`.
    pub(crate) measure: String,
    /// Return period, years; or the probability.
    return_period: Option<f64>,
    /// Probability of exceedance in `years`.
    poe: Option<f64>,
    /// Years that the probability refers to.
    years: Option<f64>,
}

/// How rare, as `uplift spectrum --return-period` and `--poe` take it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Risk {
    pub(crate) poe: f64,
    pub(crate) years: f64,
    /// Target rate, 1/yr (Eq. 4.8).
    pub(crate) per_year: f64,
}

impl At {
    /// How rare; `years` are those of the study.
    pub(crate) fn risk(&self, years: f64) -> Answer<Risk> {
        let years = self.years.unwrap_or(years);
        let poe = match (self.poe, self.return_period) {
            (Some(poe), _) => poe,
            (None, Some(period)) => {
                RETURN_PERIOD.check("return period", period).map_err(refused)?;
                let poe = probability_from_rate(1.0 / period, years).map_err(refused)?;
                if poe == 1.0 {
                    return Err(format!("a return period of {period} years is too short for {years} years"));
                }
                poe
            }
            (None, None) => return Err("give a return period or a probability".to_owned()),
        };
        Ok(Risk { poe, years, per_year: rate_from_probability(poe, years).map_err(refused)? })
    }
}

/// What the page has given, and what was begun.
#[derive(Default)]
pub struct Calculator {
    stripes: Option<Stripes>,
    curves: Vec<DroppedCurve>,
    motions: Motions,
    analysis: Option<Analysis>,
    peaks: Option<Peaks>,
}

impl Calculator {
    /// Without stripes.
    pub fn new() -> Self {
        Self::default()
    }

    /// The answer to a question in JSON, with the `file` that belongs to it; JSON.
    pub fn reply(&mut self, question: &[u8], file: &[u8]) -> String {
        let answer = serde_json::from_slice(question).map_err(refused).and_then(|question| self.answer(question, file));
        match answer {
            Ok(answer) => json!({ "answer": answer }),
            Err(error) => json!({ "error": error }),
        }
        .to_string()
    }

    fn answer(&mut self, question: Question, file: &[u8]) -> Answer<Value> {
        match question {
            Question::Stripes => {
                let stripes = Stripes::read(file)?;
                self.motions = Motions::from_stripes(&stripes);
                (self.analysis, self.peaks) = (None, None);
                let about = stripes.about();
                self.stripes = Some(stripes);
                Ok(about)
            }
            Question::About => Ok(self.stripes()?.about()),
            Question::Spectrum(at) => self.stripes()?.spectrum(&at),
            Question::Point { at, strength } => self.stripes()?.point(&at, strength),
            Question::Curves { name, choice } => {
                let found = Found::read(file, &name, choice.as_ref())?;
                let told = found.about(self.curves.len());
                if let Found::Curves(curves) = found {
                    self.curves.extend(curves);
                }
                Ok(told)
            }
            Question::Site { name, curves, extrapolate } => {
                let chosen: Option<Vec<_>> = curves.iter().map(|&place| self.curves.get(place)).collect();
                let chosen = chosen.ok_or("there is no such curve")?;
                let chosen = chosen.into_iter().map(|own| own.curve.clone()).collect();
                self.stripes.as_mut().ok_or(NO_STRIPES)?.add_site(&name, chosen, extrapolate)
            }
            Question::Record { name, unit, step_s } => {
                self.peaks = None;
                self.motions.add((file, &name), (unit, step_s))
            }
            Question::NoRecords => {
                self.peaks = None;
                self.motions.forget();
                Ok(Value::Null)
            }
            Question::Motions => self.motions.about(),
            Question::Structure { text, at, safety_factor } => {
                crate::structure::design(self.stripes.as_mut(), &text, at.as_ref(), safety_factor)
            }
            Question::Motion { text, motion, measure, level } => {
                crate::structure::motion(&text, &self.motions.scaled(motion, &measure, level)?)
            }
            Question::AnalyseRecords => {
                let stripes = self.stripes.as_ref().ok_or(NO_STRIPES)?;
                let analysis = Analysis::from_records(stripes, &self.motions)?;
                Ok(self.begin(analysis))
            }
            Question::Peaks { text, measure, level, demand_m } => {
                self.motions.are_those_of(self.stripes.as_ref().ok_or(NO_STRIPES)?)?;
                let peaks = Peaks::new(self.peaks.take(), text, measure, level);
                self.peaks.insert(peaks).step(&mut self.motions, demand_m)
            }
            Question::AnalyseStructure { text, at, block, safety_factor } => {
                let stripes = self.stripes.as_mut().ok_or(NO_STRIPES)?;
                self.motions.are_those_of(stripes)?;
                stripes.risk(&at)?;
                let asked = (&text[..], block, safety_factor);
                let analysis = Analysis::from_structure(stripes, &mut self.motions, asked, &at)?;
                Ok(self.begin(analysis))
            }
            Question::Step => {
                let analysis = self.analysis.as_mut().ok_or(NO_ANALYSIS)?;
                if analysis.step(&self.motions)? {
                    return Ok(json!({ "done": analysis.done, "of": analysis.records }));
                }
                let analysis = self.analysis.take().ok_or(NO_ANALYSIS)?;
                let stripes = self.stripes.as_mut().ok_or(NO_STRIPES)?;
                Ok(json!({ "finished": analysis.finish(stripes, &self.motions)? }))
            }
            Question::Stop => {
                self.analysis = None;
                Ok(Value::Null)
            }
            Question::Study(at) => {
                self.motions.are_those_of(self.stripes.as_ref().ok_or(NO_STRIPES)?)?;
                crate::studies::files(self.stripes()?, &at)
            }
        }
    }

    fn begin(&mut self, analysis: Analysis) -> Value {
        let of = analysis.records;
        self.analysis = Some(analysis);
        json!({ "done": 0, "of": of })
    }

    fn stripes(&mut self) -> Answer<&mut Stripes> {
        self.stripes.as_mut().ok_or_else(|| NO_STRIPES.to_owned())
    }
}

const NO_STRIPES: &str = "no stripes were given";
const NO_ANALYSIS: &str = "the analysis was ended by another question: begin again";
