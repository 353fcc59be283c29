//! What a design says in words: how the structure and the study differ, and what could not be done.

use uplift_job::JobError;
use uplift_job::text::rounded;
use uplift_oscillator::PostUplift;
use uplift_study::Structure;
use uplift_uniform_risk::StudyOfResult;

use crate::error::DesignError;
use crate::own_structure::OwnReport;
use crate::spectrum::SpectrumDemand;

/// The rules start from the ZSBE system: a spectrum of another says nothing to them.
pub(super) fn require_zero_stiffness(source: &StudyOfResult) -> Result<(), DesignError> {
    let (what, key) = match source.study.oscillator.post_uplift {
        PostUplift::Zero => return Ok(()),
        PostUplift::Negative { capacity_m } => (format!("negative stiffness (capacity {capacity_m} m)"), "capacity_m"),
        PostUplift::Positive { stiffness_per_s2 } => {
            (format!("positive stiffness ({stiffness_per_s2} 1/s2 after uplift)"), "post_uplift_stiffness_per_s2")
        }
    };
    Err(JobError::input(format!(
        "{}: its oscillator has {what}, but the rules start from zero stiffness (ZSBE): run the study without \
         oscillator.{key}",
        source.path.display()
    ))
    .into())
}

/// Why the structures that it may be are not analysed.
pub(crate) fn without_uncertainty(is_repaired: bool, source: &StudyOfResult) -> String {
    let reason = if is_repaired {
        "their risk is not computed with repaired weights (leave --repaired out)"
    } else if source.study.records.at_level.is_some() {
        "their risk is not computed with records of their own at each level (records.at_level)"
    } else {
        "the structure itself is not analysed"
    };
    format!("[uncertainty]: all numbers are of the structure as described, without its uncertainty: {reason}")
}

/// What the repaired spectrum has beside the plain one.
pub(super) fn beside(plain: Option<SpectrumDemand>, repaired: Option<SpectrumDemand>) -> Option<String> {
    let [plain_m, repaired_m] = [plain?, repaired?].map(|demand| demand.zero_stiffness_demand_m);
    Some(format!(
        "the repaired spectrum has {repaired_m:.4} m with zero stiffness, the plain one {plain_m:.4} m: --repaired \
         designs by it"
    ))
}

/// Why the spectrum cannot be read.
pub(super) fn beyond_spectrum(structure: &Structure, source: &StudyOfResult) -> String {
    let strengths = &source.study.strengths;
    let (first, last) = (strengths[0], strengths[strengths.len() - 1]);
    let strength = structure.system.spectral_strength_at(source.study.gravity_m_s2);
    let why = if (first..=last).contains(&strength) {
        "an ordinate beside it is censored".to_owned()
    } else {
        format!("its strengths go from {first} to {last}; widen strengths.values and run the study again")
    };
    format!("the spectrum has no value at strength {strength:.4}: {why}")
}

/// `restitution 0.95`, where the structure's file does not say so, and likewise; where the structure itself moves in a
/// plane, `restitution 0.907 of the planar frame, 0.95 of its oscillator`.
pub(super) fn assumed(structure: &Structure, restitution: f64, itself: Option<&OwnReport>) -> Vec<String> {
    let description = &structure.description;
    let uplift_mm = rounded(1e3 * structure.system.conditions().uplift_displacement_m(), 4);
    let uplift = description.assumes_uplift_displacement().then(|| format!("uplift displacement {uplift_mm} mm"));
    let in_words = || match itself.filter(|own| !own.wobbles()).map(OwnReport::decisive) {
        Some(own) => {
            format!("restitution {} of the {}, {restitution} of its oscillator", rounded(own.restitution, 3), own.model)
        }
        None => format!("restitution {restitution}"),
    };
    let restitution = description.restitution.is_none().then(in_words);
    uplift.into_iter().chain(restitution).collect()
}

/// What the structure and the study's oscillator do not have in common, and the options with which they would.
pub(super) fn differences(
    structure: &Structure,
    source: &StudyOfResult,
    restitution: f64,
) -> (Vec<String>, Option<String>) {
    let (system, oscillator) = (&structure.system, &source.study.oscillator);
    let apart = |a: f64, b: f64| (a - b).abs() > 1e-9 * a.abs().max(b.abs());
    let (mut notes, mut settings) = (Vec::new(), Vec::new());
    if source.study.uncertainty.is_some() {
        notes.push(
            "the spectrum is of uncertain oscillators ([uncertainty] of its study); the structure is compared with \
             the one that the study describes"
                .to_owned(),
        );
    }
    if !system.is_of_uplift_displacement(oscillator.uplift_displacement_m) {
        let own_m = system.spectral_uplift_displacement_m();
        notes.push(format!(
            "The spectrum is of another oscillator: its uplift displacement is {} mm; this structure's is {} mm ({} mm \
             divided by Γ)",
            rounded(1e3 * oscillator.uplift_displacement_m, 4),
            rounded(1e3 * own_m, 3),
            rounded(1e3 * system.conditions().uplift_displacement_m(), 4)
        ));
        settings.push(format!("--set oscillator.uplift_displacement_m={}", rounded(own_m, 4)));
    }
    if apart(restitution, oscillator.restitution) {
        notes.push(format!(
            "The spectrum is of another oscillator: its restitution is {}; this structure's is {restitution}",
            oscillator.restitution
        ));
        settings.push(format!("--set oscillator.restitution={restitution}"));
    }
    let gravity_m_s2 = system.conditions().gravity_m_s2();
    if apart(gravity_m_s2, source.study.gravity_m_s2) {
        notes.push(format!(
            "the spectrum is of a gravity of {} m/s2, the structure's is {gravity_m_s2} m/s2",
            source.study.gravity_m_s2
        ));
        settings.push(format!("--set gravity_m_s2={gravity_m_s2}"));
    }
    (notes, (!settings.is_empty()).then(|| settings.join(" ")))
}
