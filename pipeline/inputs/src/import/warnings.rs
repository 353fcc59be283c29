//! What deserves a look before a record is trusted, and the remarks of an import, kind by kind.

use std::fmt;

use serde::Serialize;
use uplift_job::text::one_line;
use uplift_motion::{Accelerogram, Orientation, RecordPair, RecordingDescription};

use super::measured::PairMeasures;

/// A remark about a record or a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// What kind of thing it is, in a few words; remarks of a kind are shown together.
    pub kind: &'static str,
    /// The remark, with the name of the record or file first.
    pub text: String,
}

/// Velocity at the end that a sound baseline does not leave, as a share of the PGV.
const ODD_RESIDUAL_SHARE: f64 = 0.1;
/// How far sampling rates are whole numbers, relative.
const WHOLE_RATE: f64 = 1e-4;
/// How far the peak of a file may be from what its head states, relative: heads print three digits.
const STATED_PEAK: f64 = 0.02;
/// How far two components may be from a right angle, degrees.
const RIGHT_ANGLE_DEG: f64 = 5.0;
/// How many times as long or short a significant duration may be as the search results state it: they take one of the
/// components, or both together.
const ODD_DURATION_RATIO: f64 = 1.5;
/// Peaks beyond which the unit is probably not what it is taken for, g: nobody feels less than 0.001 g, and a file in g
/// read as cm/s2 is below it up to a true PGA of 1 g; the strongest one recorded has about 4 g.
const USUAL_PGA_G: [f64; 2] = [1e-3, 3.0];
/// Velocity beyond which unit or baseline are probably not what they are taken for, cm/s: the largest recorded is about
/// 300.
const USUAL_PGV_CM_S: f64 = 400.0;
/// Ratio of the peaks of two components beyond which they are hardly in one unit: it is below some 5 where the ground
/// moved, and g taken for cm/s2 multiplies one of them by 981.
const USUAL_PGA_RATIO: f64 = 20.0;

/// What to say of the largest accelerations \[g\] and velocities \[cm/s\] of the components of a record, which the
/// ground hardly has; of several components it says which.
pub(crate) fn unusual_peaks(pga_g: &[f64], pgv_cm_s: &[f64]) -> Option<String> {
    let [least, largest] = USUAL_PGA_G;
    let name = |at: usize| if pga_g.len() > 1 { format!("h{} ", at + 1) } else { String::new() };
    if let Some(at) = pga_g.iter().position(|&pga_g| pga_g >= largest || pga_g.is_nan()) {
        let (name, strong) = (name(at), pga_g[at]);
        return Some(format!("mistake? {name}PGA {strong:.3} g: is its unit right, cm/s2 perhaps?"));
    }
    if let Some(at) = pgv_cm_s.iter().position(|&pgv_cm_s| pgv_cm_s > USUAL_PGV_CM_S) {
        let (name, fast) = (name(at), pgv_cm_s[at]);
        return Some(format!("mistake? {name}PGV {fast:.0} cm/s: are its unit (m/s2 perhaps) and its baseline right?"));
    }
    let weakest = pga_g.iter().copied().fold(f64::INFINITY, f64::min);
    let strongest = pga_g.iter().copied().fold(0.0, f64::max);
    let question = "is the file in g? Check the unit in its head";
    if let Some(at) = pga_g.iter().position(|&pga_g| pga_g == weakest).filter(|_| weakest < least) {
        let name = name(at);
        return Some(format!("mistake? {name}PGA {weakest:.3e} g: {question}"));
    }
    (strongest > USUAL_PGA_RATIO * weakest)
        .then(|| format!("mistake? PGA {weakest:.3e} g of one component, {strongest:.3} g of the other: {question}"))
}

/// Remarks about `pair`, whose files say the `descriptions` of its components; `gravity_m_s2` as in its `measures`.
pub fn pair_warnings(
    pair: &RecordPair,
    descriptions: [&RecordingDescription; 2],
    measures: &PairMeasures,
    gravity_m_s2: f64,
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let mut add = |kind: &'static str, text: String| {
        warnings.push(Warning { kind, text: format!("{}: {text}", pair.id) });
    };
    let motions = [&pair.h1, &pair.h2];
    synchronisation(motions, descriptions, &mut add);
    if let [Some(Orientation::Azimuth(a)), Some(Orientation::Azimuth(b))] = descriptions.map(|d| d.orientation) {
        let angle = (a - b).rem_euclid(180.0);
        if (angle - 90.0).abs() > RIGHT_ANGLE_DEG {
            add("not at right angles", format!("its components point to {a}° and {b}°, not at right angles"));
        }
    }
    if descriptions.iter().any(|description| description.unprocessed) {
        add("unprocessed", "raw data without filter or baseline correction; the program does neither".to_owned());
    }
    if measures.residual_velocity_share > ODD_RESIDUAL_SHARE {
        let share = 100.0 * measures.residual_velocity_share;
        add("odd baseline", format!("a velocity of {share:.0} % of the PGV is left at the end: its baseline is odd"));
    }
    let pga_g = motions.map(|motion| motion.pga_m_s2() / gravity_m_s2);
    if let Some(text) = unusual_peaks(&pga_g, &motions.map(|motion| 100.0 * motion.pgv_m_s())) {
        add("unusual peak", text);
    }
    for (motion, description) in motions.iter().zip(descriptions) {
        if let Some(stated) = description.stated_pga_m_s2.filter(|stated| stated.abs() > 0.0) {
            let found = motion.pga_m_s2();
            if (found / stated.abs() - 1.0).abs() > STATED_PEAK {
                add(
                    "peak differs",
                    format!("its head states a PGA of {:.4} m/s2, the samples have {found:.4} m/s2", stated.abs()),
                );
            }
        }
        let rate = 1.0 / motion.dt_s();
        if (rate - rate.round()).abs() > WHOLE_RATE * rate {
            add(
                "rounded time step",
                format!(
                    "a time step of {} s makes no whole number of samples a second and is probably rounded, by up to \
                     {:.1} %: look up the sampling rate",
                    motion.dt_s(),
                    100.0 * last_digit(motion.dt_s()) / motion.dt_s()
                ),
            );
        }
    }
    warnings.dedup();
    warnings
}

/// A remark where the significant duration D5-95 found, s, is not the one `stated_s` by the search results: the time
/// step of the files is wrong, or they are another record's.
pub(super) fn duration_warning(pair: &RecordPair, found_s: f64, stated_s: f64) -> Option<Warning> {
    let is_odd = stated_s > 0.0 && !(1.0 / ODD_DURATION_RATIO..=ODD_DURATION_RATIO).contains(&(found_s / stated_s));
    is_odd.then(|| Warning {
        kind: "duration differs",
        text: format!(
            "{}: D5-95 is {found_s:.2} s, and {stated_s} s by the search results: is the time step of {} s right, and \
             is this that record?",
            pair.id,
            pair.h1.dt_s()
        ),
    })
}

/// Whether two components begin at the same time, as far as their files say so; `dt_s` is the time step.
pub(super) fn are_together([one, other]: [&RecordingDescription; 2], dt_s: f64) -> bool {
    match (one.start_time_s, other.start_time_s) {
        (Some(start_s), Some(other_s)) => (start_s - other_s).abs() <= 0.5 * dt_s,
        _ => true,
    }
}

/// One unit in the last digit that a number is written with.
fn last_digit(value: f64) -> f64 {
    let text = value.to_string();
    let decimals = text.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    10_f64.powi(-i32::try_from(decimals).unwrap_or(i32::MAX))
}

fn synchronisation(
    [h1, h2]: [&Accelerogram; 2],
    [one, other]: [&RecordingDescription; 2],
    add: &mut impl FnMut(&'static str, String),
) {
    const KIND: &str = "not synchronised";
    if h1.dt_s() != h2.dt_s() {
        add(KIND, format!("its components have time steps of {} s and {} s", h1.dt_s(), h2.dt_s()));
    }
    if let (Some(start), Some(other_start)) = (one.start_time_s, other.start_time_s) {
        if !are_together([one, other], h1.dt_s()) {
            let apart_s = (start - other_start).abs();
            add(KIND, format!("its components begin {apart_s:.3} s apart: not for RotD50, RotD100 and azimuths"));
        }
    } else if h1.len() != h2.len() {
        add(
            KIND,
            format!(
                "its components have {} and {} points and no start times: check them before you use RotD50, RotD100 \
                 or azimuths",
                h1.len(),
                h2.len()
            ),
        );
    }
}

/// Remarks of one kind.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Remarks {
    /// What kind of thing it is, in a few words.
    pub kind: &'static str,
    /// The remarks, each with the name of the record or file first.
    pub texts: Vec<String>,
}

impl Remarks {
    /// Those of an import: the lines about files that were not read first, the `warnings` in their order.
    pub(super) fn from_import(not_read: &[String], warnings: &[Warning]) -> Vec<Self> {
        let mut kinds: Vec<Self> = Vec::new();
        if !not_read.is_empty() {
            kinds.push(Self { kind: "not read", texts: not_read.to_owned() });
        }
        for warning in warnings {
            match kinds.iter_mut().find(|kind| kind.kind == warning.kind) {
                Some(kind) => kind.texts.push(warning.text.clone()),
                None => kinds.push(Self { kind: warning.kind, texts: vec![warning.text.clone()] }),
            }
        }
        kinds
    }
}

impl fmt::Display for Remarks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} ({}):", self.kind, self.texts.len())?;
        self.texts.iter().try_for_each(|text| writeln!(f, "  - {}", one_line(text)))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn peaks_of_another_unit() {
        for usual in [[0.1, 0.2], [0.002, 0.01], [1.0, 2.9]] {
            assert_eq!(unusual_peaks(&usual, &[300.0, 20.0]), None);
        }
        // 0.3 g read as cm/s2; 1.3 g read so beside 0.9 g; 30 cm/s2 read as g
        for (pga_g, words) in [
            ([3.06e-4, 3.0e-4], "h2 PGA 3.000e-4 g: is the file in g?"),
            ([1.3e-3, 0.9], "PGA 1.300e-3 g of one component, 0.900 g of the other: is the file in g?"),
            ([30.0, 0.1], "h1 PGA 30.000 g: is its unit right, cm/s2 perhaps?"),
            ([0.0, 0.1], "h1 PGA 0.000e0 g"),
        ] {
            let told = unusual_peaks(&pga_g, &[20.0]).unwrap();
            assert!(told.starts_with(&format!("mistake? {words}")), "{told}");
        }
        // 50 cm/s and 0.2 g read as g in place of m/s2
        let told = unusual_peaks(&[1.96, 1.5], &[490.0, 380.0]).unwrap();
        assert!(
            told.starts_with("mistake? h1 PGV 490 cm/s: are its unit (m/s2 perhaps) and its baseline right?"),
            "{told}"
        );
        // of one component alone there is nothing to tell apart
        assert!(unusual_peaks(&[30.0], &[20.0]).unwrap().starts_with("mistake? PGA 30.000 g"));
    }

    #[test]
    fn a_duration_that_is_not_the_one_of_the_search() {
        let motion = Accelerogram::new(0.02, vec![0.0, 1.0, -1.0, 0.0]).unwrap();
        let pair = RecordPair { id: "RSN1_A".into(), h1: motion.clone(), h2: motion, metadata: BTreeMap::new() };
        assert!(duration_warning(&pair, 12.0, 10.0).is_none() && duration_warning(&pair, 8.0, 10.0).is_none());
        // the step of 0.01 s was taken for 0.02 s
        let warning = duration_warning(&pair, 20.0, 10.0).unwrap();
        assert!(
            warning.text.starts_with("RSN1_A: D5-95 is 20.00 s, and 10 s by the search results"),
            "{}",
            warning.text
        );
        assert!(warning.text.contains("time step of 0.02 s right"), "{}", warning.text);
    }
}
