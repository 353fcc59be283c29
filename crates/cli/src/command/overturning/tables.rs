//! Collapse fragility and risk as CSV.

use std::path::{Path, PathBuf};

use polars::prelude::Column;

use super::Overturning;
use crate::error::CommandError;
use crate::show::shown_path;
use uplift::result::write_table;

/// The table of risks beside that of the fragility.
pub(super) fn risk_path(fragility: &Path) -> PathBuf {
    fragility.with_extension("risk.csv")
}

impl Overturning<'_> {
    /// Writes the fragility to `path`, and the risk beside it.
    pub(super) fn write(&self, path: &Path) -> Result<(), CommandError> {
        let line = format!(
            "uplift {} ({}); overturning of {} ({}); result {}; records: {}",
            uplift::VERSION,
            uplift::COMMIT,
            self.structure.name(),
            self.structure.description.kind.name(),
            shown_path(&self.source.path).display(),
            self.source.record_set
        )
        .replace(['\n', '\r'], " ");
        write_table(path, &line, self.fragility())?;
        Ok(write_table(&risk_path(path), &line, self.risk())?)
    }

    /// A row a measure, model and level.
    fn fragility(&self) -> Vec<Column> {
        let (mut im, mut unit, mut level, mut model, mut restitution) = (vec![], vec![], vec![], vec![], vec![]);
        let (mut overturned, mut records, mut share, mut fitted) = (vec![], vec![], vec![], vec![]);
        for (measure, found) in &self.found {
            for (found, (of, _)) in found.iter().zip(&self.models) {
                for count in &found.counts {
                    im.push(measure.measure().label());
                    unit.push(measure.measure().unit());
                    level.push(count.level);
                    model.push(of.name());
                    restitution.push(of.restitution());
                    overturned.push(count.exceedances);
                    records.push(count.trials);
                    share.push(f64::from(count.exceedances) / f64::from(count.trials));
                    fitted.push(found.fit.as_ref().ok().map(|fit| fit.fragility.probability(count.level)));
                }
            }
        }
        vec![
            Column::new("im".into(), im),
            Column::new("unit".into(), unit),
            Column::new("level".into(), level),
            Column::new("model".into(), model),
            Column::new("restitution".into(), restitution),
            Column::new("overturned".into(), overturned),
            Column::new("records".into(), records),
            Column::new("share".into(), share),
            Column::new("lognormal".into(), fitted),
        ]
    }

    /// A row a site, measure and model.
    fn risk(&self) -> Vec<Column> {
        let (mut site, mut im, mut model) = (vec![], vec![], vec![]);
        let (mut theta, mut beta, mut by_fit) = (vec![], vec![], vec![]);
        let mut risks = vec![];
        for (index, &of_site) in self.sites.iter().enumerate() {
            for (measure, found) in &self.found {
                for (found, (of, _)) in found.iter().zip(&self.models) {
                    let fit = found.fit.as_ref().ok();
                    site.push(self.source.sites[of_site].as_str());
                    im.push(measure.measure().label());
                    model.push(of.name());
                    risks.push(found.risks[index]);
                    theta.push(fit.map(|fit| fit.fragility.median()));
                    beta.push(fit.map(|fit| fit.fragility.dispersion()));
                    by_fit.push(found.fitted.as_ref().map(|fitted| fitted[index].per_year));
                }
            }
        }
        let years = vec![self.source.study.risk.years; site.len()];
        let of = |value: fn(&uplift::structure::EventRisk) -> f64| -> Vec<f64> { risks.iter().map(value).collect() };
        vec![
            Column::new("site".into(), site),
            Column::new("im".into(), im),
            Column::new("model".into(), model),
            Column::new("maf_per_year".into(), of(|risk| risk.per_year)),
            Column::new("years".into(), years),
            Column::new("probability".into(), of(|risk| risk.probability)),
            Column::new("lower_tail_share".into(), of(|risk| risk.lower_tail_share)),
            Column::new("upper_tail_share".into(), of(|risk| risk.upper_tail_share)),
            Column::new("theta".into(), theta),
            Column::new("beta".into(), beta),
            Column::new("maf_lognormal_per_year".into(), by_fit),
        ]
    }
}
