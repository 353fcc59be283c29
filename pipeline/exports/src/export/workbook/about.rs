//! The sheets that say where the numbers come from: the result in short, and the study in full.

use rust_xlsxwriter::XlsxError;
use uplift_job::text::{per_cent, risk_in_words};
use uplift_oscillator::PostUplift;
use uplift_uniform_risk::CONFIDENCE;

use super::sheet::Sheet;
use crate::export::Export;

impl Export {
    /// What the workbook is of, and what to know before using it.
    pub(super) fn about(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        let head = &self.head;
        let study = &self.study;
        let oscillator = &study.oscillator;
        let post_uplift = match oscillator.post_uplift {
            PostUplift::Zero => "zero stiffness".to_owned(),
            PostUplift::Negative { capacity_m } => format!("negative stiffness, capacity {capacity_m} m"),
            PostUplift::Positive { stiffness_per_s2 } => format!("positive stiffness, {stiffness_per_s2} 1/s2"),
        };
        let years = self.spectra.years;
        let risks: Vec<String> = self.spectra.poes.iter().map(|&poe| risk_in_words(poe, years)).collect();
        let bands = self.bands.as_ref().map(|bands| {
            let sizes: Vec<String> = bands.sizes.iter().map(u32::to_string).collect();
            format!("{} over {}, samples of {}", per_cent(bands.confidence), bands.drawn_words(), sizes.join(", "))
        });
        let quoted = if self.quoted_m.iter().any(Option::is_some) {
            format!("{}, beside each spectrum", per_cent(CONFIDENCE))
        } else {
            "none: a single record".to_owned()
        };
        let facts = [
            ("Uniform risk spectra", head.title.clone()),
            ("Result file", self.file.clone()),
            ("Made", head.created.clone()),
            ("Program", format!("uplift {} ({})", head.version, head.commit)),
            ("Command", head.command.clone()),
            ("Study file", head.study_file.clone()),
            ("Study digest", self.head.study_digest()),
            ("Records", format!("{}: {}", self.records, head.record_set)),
            ("Synthetic records", ["no", "yes: not for design"][usize::from(head.synthetic)].to_owned()),
            ("Uplift displacement", format!("{} m", oscillator.uplift_displacement_m)),
            ("Restitution", oscillator.restitution.to_string()),
            ("After uplift", post_uplift),
            ("Probabilities", risks.join(", ")),
            ("Ordinates", study.risk.contour.key().to_owned()),
            ("Confidence bands", quoted),
            ("Percentiles of resamples", bands.unwrap_or_else(|| "none: `uplift bootstrap` makes them".to_owned())),
            ("Coefficients", "u = c0 exp(c1 strength) + c2, c2 not negative (Eq. 4.11)".to_owned()),
            ("Fitted", format!("strengths above {}", study.regression.strength_above)),
            ("Units", "displacements u in m; strength is f_up/(m g); censored: larger than any analysed".to_owned()),
        ];
        let mut line = 0;
        for (name, value) in &facts {
            sheet.heading((line, 0), name, false)?;
            sheet.long_text((line, 1), value)?;
            line += 1;
        }
        for (index, alarm) in self.alarms.iter().enumerate() {
            if index == 0 {
                sheet.heading((line, 0), "Before you use these numbers", false)?;
            }
            let remedy = alarm.remedy(&self.typed);
            let what_to_do = if remedy.is_empty() { String::new() } else { format!(": {remedy}") };
            sheet.long_text((line, 1), &format!("{}: {alarm}{what_to_do}", alarm.severity.word()))?;
            line += 1;
        }
        sheet.finish((0, 1), &[30.0, 110.0])
    }

    /// The study with every default filled in, a line each.
    pub(super) fn study_sheet(&self, sheet: &mut Sheet<'_>) -> Result<(), XlsxError> {
        super::study_lines(&self.head.study_toml, sheet)
    }
}
