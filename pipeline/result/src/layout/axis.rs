//! The axes of a result, each declared once: writing and the tables of `docs/hdf5-layout.md` follow from it.

use std::collections::BTreeSet;

use uplift_labelled::{LabelledError, LabelledWriter, Number};
use uplift_motion::IntensityMeasure;

use super::names::{Names, measure_names, named};
use super::{axis_part, unique_axis};

/// An axis of a result. What stands in angle brackets is replaced by [`Names`].
#[derive(Debug, Clone, Copy)]
pub struct Axis {
    /// Its name.
    pub name: &'static str,
    /// Its unit: `1` where it has none, `text` of identifiers.
    pub unit: &'static str,
    /// Its attribute `long_name`.
    pub long_name: &'static str,
    /// What `docs/hdf5-layout.md` says of it; empty where that is its `long_name`.
    pub note: &'static str,
}

/// Axes, a row each: constant, name, unit, long name, and in brackets the note where it is another.
macro_rules! axes {
    ($($axis:ident $name:literal $unit:literal $long_name:literal $(($note:literal))?;)+) => {
        $(
            #[doc = concat!("The axis `", $name, "`: `", $long_name, "`.")]
            pub const $axis: Axis =
                Axis { name: $name, unit: $unit, long_name: $long_name, note: concat!($($note)?) };
        )+
        /// All of them.
        pub const ALL: &[Axis] = &[$($axis),+];
    };
}

axes! {
    // Of uniform risk.
    RECORD "record" "text" "ground motion record"
        ("identifiers; followed by `:h1`, `:h2` (`component = \"both\"`), `:30deg` (azimuths), `:s1`, `:s2`, … \
          (sampled structures)");
    STRENGTH "strength" "1" "uplift strength f_up/(m g)" ("η = f_up/(m g)");
    STRIPE_LEVEL "<im>_level" "<unit>" "stripe level of <measure>, <combination>" ("levels of the measure");
    COMMON_LEVEL "<im>_common_level" "<unit>" "level of <measure> that every record is brought to"
        ("levels of a measure that no record was scaled to; only with `/efficiency`");
    STRUCTURE "structure" "text" "possible structure" ("numbers of the sampled structures; only with `/uncertainty`");
    THRESHOLD "threshold" "m" "displacement threshold" ("thresholds; only with `/risk`");
    SITE "site" "text" "site" ("names; only if the study has sites");
    POE "poe" "1" "probability of exceedance in <years> years" ("probabilities of exceedance in `poe_years`");
    SAMPLE_SIZE "sample_size" "1" "records drawn in a replicate" ("records in a sample; only with `/bootstrap`");
    REPLICATE "replicate" "1" "number of the replicate" ("number of a replicate; only with `/bootstrap`");
    BIN "<im>_bin" "<unit>" "<label> from which a bin reaches up to the next, the last without end"
        ("level from which a bin reaches up to the next one: 0, then the levels, the last without end; only with \
          `/disaggregation`");
    RATE "rate_number" "1" "annual rate at which hazards are compared, the most frequent first"
        ("rate at which two hazards are compared, 1 to 21, the most frequent first");
    KNOT "knot_number" "1" "knot of the weights' exponent" ("knot of the weights' exponent, 1 to 4");
    BRANCH "<branches>" "text" "branch of the hazard"
        ("names of the weighted hazard curves; only for sites that have some");
    FINDING "finding_<key>" "1" "number of an answer" ("numbers of one answer, from 1");
    HAZARD "<axis>" "<unit>" "<label> of the hazard curve"
        ("levels of one hazard curve. The site's name is in lower case, at most 40 characters, `_` for other \
          characters, `x` added to tell two apart");
    MEASURE "measure" "text" "intensity measure that the records are scaled by";
    // Of displacement spectra.
    RECORD_SET "record_set" "text" "record set" ("names of the sets");
    SCALING "scaling" "text" "what motions are scaled to, a multiple of the set's median peak"
        ("`unscaled`, `0.5 PGA`, `1 PGV`: multiples of the set's median (Eq. 2.16, 2.17)");
    SCALED_BY "scaled_by" "text" "whose peak is scaled" ("whose peak meets it: `component` or `record`");
    PERCENTILE "percentile" "%" "percentile over the motions of a set";
    UPLIFT_DISPLACEMENT "uplift_displacement" "m" "displacement at uplift u_up" ("u_up; oscillators");
    CAPACITY "capacity" "m" "displacement capacity u_cap, infinite for zero post-uplift stiffness"
        ("u_cap, `inf` for zero post-uplift stiffness; oscillators");
    HEIGHT "height" "m" "height 2H of the block" ("2H; blocks");
    SLENDERNESS "slenderness" "1" "slenderness tan(alpha)" ("tan α; blocks");
    MOTION "<motion>" "text" "component of a record"
        ("`<record> h1`, `<record> h2`: one axis for each set, named as those of sites");
    RULE "rule" "text" "design rule" ("`equal displacement`, `equal energy`; oscillators with a design");
    PRINTED_STRENGTH "printed_strength" "1" "strength at which a run prints its spectra"
        ("strengths nearest to 0.1, 0.2 and 0.4; oscillators");
    PRINTED_SLENDERNESS "printed_slenderness" "1" "slenderness at which a run prints its spectra"
        ("the same of slendernesses; blocks");
    BOUND "bound" "text" "a value, and its range over a small sweep"
        ("`value`, `lowest`, `highest`: a value and its range over the sweep around it");
    // Of shaking tables.
    LEVEL "level" "text" "level of shaking" ("names of the levels");
    EXCITATION "excitation" "text" "excitation" ("what the excitations are called");
    DIRECTION "direction" "text" "horizontal component" ("`x`, `y`: first and second component");
    PERIOD "period" "s" "natural period in the time of the table" ("natural periods in the time of the table");
}

impl Axis {
    /// Writes it with these numbers.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write<V: Number>(
        &self,
        writer: &mut LabelledWriter,
        names: Names<'_>,
        values: &[V],
    ) -> Result<(), LabelledError> {
        writer.axis(&named(self.name, names), values, &named(self.unit, names), &named(self.long_name, names))
    }

    /// Writes it with these identifiers.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write_texts(
        &self,
        writer: &mut LabelledWriter,
        names: Names<'_>,
        values: &[String],
    ) -> Result<(), LabelledError> {
        writer.axis_text(&named(self.name, names), values, self.long_name)
    }

    /// Its name for a measure.
    pub fn for_measure(&self, measure: IntensityMeasure) -> String {
        named(self.name, &measure_names(measure)).into_owned()
    }
}

/// Rows of the answer to the question of this key.
pub fn finding(key: &str) -> String {
    named(FINDING.name, &[("<key>", key)]).into_owned()
}

/// The path of an axis.
pub fn path(name: &str) -> String {
    format!("/axes/{name}")
}

/// Levels of the hazard curve of a site.
pub fn hazard(site: &str, measure: IntensityMeasure, taken: &mut BTreeSet<String>) -> String {
    unique_axis(format!("hazard_{}_{}", axis_part(site), measure.key()), taken)
}

/// Weighted hazard curves of a site.
pub fn branch(site: &str, measure: IntensityMeasure, taken: &mut BTreeSet<String>) -> String {
    unique_axis(format!("branch_{}_{}", axis_part(site), measure.key()), taken)
}

/// Motions of a record set.
pub fn motion(set: &str, taken: &mut BTreeSet<String>) -> String {
    unique_axis(format!("motion_{}", axis_part(set)), taken)
}
