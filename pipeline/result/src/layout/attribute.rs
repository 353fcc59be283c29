//! The attributes of the groups of a result that this program reads again, each declared once: writing, reading and the
//! tables of `docs/hdf5-layout.md` follow from it.

use std::marker::PhantomData;

use uplift_labelled::{AttributeValue, LabelledError, LabelledReader, LabelledWriter, Value};

use super::names::{Names, named};

/// An attribute of the type `V`. What stands in angle brackets in the path of its group is replaced by [`Names`].
pub struct Attribute<V> {
    /// The path of its group.
    pub group: &'static str,
    /// Its name.
    pub name: &'static str,
    value: PhantomData<V>,
}

/// Groups of attributes: a module, the path, and a row for each attribute: constant, type, name, and what
/// `docs/hdf5-layout.md` says of it, which may be nothing.
macro_rules! attributes {
    ($($module:ident $group:literal { $($constant:ident $type:ident $name:literal $note:literal;)+ })+) => {
        $(
            #[doc = concat!("Attributes of `", $group, "`.")]
            pub mod $module {
                use super::{Attribute, PhantomData};

                $(
                    #[doc = concat!("The attribute `", $name, "` of `", $group, "`.")]
                    pub const $constant: Attribute<$type> =
                        Attribute { group: $group, name: $name, value: PhantomData };
                )+
            }
        )+
        /// All of them: the path of a group, and name, type and note of each.
        pub const ALL: &[(&str, &[[&str; 3]])] = &[$(($group, &[$([$name, stringify!($type), $note]),+])),+];
    };
}

attributes! {
    root "/" {
        PROGRAM String "program" "`uplift`";
        VERSION String "version" "of the program";
        COMMIT String "commit" "of the program; `unknown` if it is not known";
        LAYOUT i64 "layout" "version of this layout, 1";
        NUMERICS i64 "numerics" "version of the solver's numbers; 3 where absent";
        CREATED String "created" "time, UTC, `2026-01-31T12:00:00Z`";
        COMMAND String "command" "the command line";
        TITLE String "title" "of the study";
        STUDY_FILE String "study_file" "the study file as given";
        OVERRIDES String "overrides" "changes by `--set`, a line each; absent in older results";
        STUDY_PLACE String "study_place" "SHA-256 of its path; absent in older results";
        STUDY_TOML String "study_toml"
            "the resolved study, every default filled in: a study file that gives the same numbers again";
        KIND String "kind" "what the study is of; absent for uniform risk";
        STRUCTURE String "structure" "`oscillator` or `block`; only for displacement spectra";
        SEED u64 "seed" "of the study; only for uniform risk";
        POE_YEARS f64 "poe_years" "years that the probabilities refer to; only for uniform risk";
        CONTOUR String "contour"
            "`exact` or `grid`: how the ordinates of `/urs` and `/epistemic` were read; all others are exact; only for \
             uniform risk";
        GRAVITY_M_S2 f64 "gravity_m_s2" "m/s²";
        RECORD_SET String "record_set" "the records in a line; says `synthetic` if they are";
        SYNTHETIC i64 "synthetic" "1 if the records are synthetic, 0 if not";
        INPUT_CHECKSUMS String "input_checksums"
            "JSON object: `record <id>`, `hazard <site> <PGV or PGA>`, `site table` and `site table <PGV or PGA>` → \
             SHA-256";
        WARNINGS String "warnings"
            "what was noticed about the inputs, a line each; other [warnings](warnings.md) are derived from the arrays";
        THREADS i64 "threads" "threads used; the numbers do not depend on it";
        WALL_TIME_S f64 "wall_time_s" "s, up to the writing of the file";
        PLATFORM String "platform" "operating system and architecture";
    }
    signature "<group>" {
        CREATED String "created" "";
        VERSION String "version" "";
        COMMIT String "commit" "";
    }
    structure "/structures/<structure>" {
        STRUCTURE_SHA256 String "structure_sha256" "of the structure file when it was last asked";
    }
    answer "/structures/<structure>/<command>/<key>" {
        STRUCTURE_FILE String "structure_file" "";
        STRUCTURE_SHA256 String "structure_sha256" "";
        STRUCTURE_TOML String "structure_toml" "";
        STUDY_DIGEST String "study_digest" "";
        REQUEST String "request" "JSON";
        DOCUMENT String "document"
            "JSON: what `--json` prints; `design` without `--details`, `--json` or `--report` leaves out neighbouring \
             strengths";
    }
    stripes "/ida/<im>" {
        OSCILLATOR_KEY String "oscillator_key" "see [checksums](#checksums)";
        ANALYSES u64 "analyses" "nonlinear time histories";
        SECONDS f64 "seconds" "wall time";
    }
    precision "/urs/<im>" {
        PRECISION String "precision" "a sentence";
        HALF_WIDTH f64 "half_width"
            "half of the 90 % confidence band over the ordinate, median of sites and three strengths";
        HALF_WIDTH_BY_EVENT f64 "half_width_by_event" "by earthquake; may be infinite";
    }
    bootstrap "/bootstrap" {
        PLAN String "plan" "source of the draws";
        UNIT String "unit" "`record`, `pair` or `event`; absent in older results, which drew records";
        CONFIDENCE f64 "confidence" "";
        INTERVAL String "interval" "";
        STRENGTH_ABOVE f64 "strength_above" "";
    }
    efficiency "/efficiency/<im>" {
        SCALED_TO String "scaled_to" "the measure that the records were scaled to; absent in older results";
    }
    curve "/hazard/<curve>" {
        SOURCE String "source" "comment lines of the file";
        FILE String "file" "empty for the mean of branches";
        UNIT String "unit" "";
        NAME String "name" "of `branches/<n>` alone";
        WEIGHT f64 "weight" "of `branches/<n>` alone";
    }
    sites "<sites>" {
        PROVENANCE String "provenance" "where the numbers come from";
        YEARS f64 "years" "that the probabilities refer to";
        FINDINGS String "findings" "how many sites deserve which warning, JSON";
        TABLES String "tables" "of a slice: SHA-256 of each of its tables and of its map";
    }
    spectra "/spectra" {
        ANALYSES u64 "analyses" "";
        SECONDS f64 "seconds" "wall time";
    }
    set "/sets/<set>" {
        RECORDS u64 "records" "";
        TAG String "tag" "empty for all rows";
        MEDIAN_PGA_G f64 "median_pga_g" "Eq. 2.16";
        MEDIAN_PGV_CM_S f64 "median_pgv_cm_s" "Eq. 2.17";
    }
    design "/design" {
        SAFETY_FACTOR f64 "safety_factor" "";
        PERCENTILE f64 "percentile" "";
        NOISE_RELATIVE f64 "noise_relative" "";
        NOISE_POINTS u64 "noise_points" "";
        STRENGTH f64 "strength" "oscillators";
        UPLIFT_DISPLACEMENT_M f64 "uplift_displacement_m" "oscillators";
        LEAST_CAPACITY_M f64 "least_capacity_m" "oscillators";
        HEIGHT_M f64 "height_m" "blocks";
        ENDLESS_HEIGHT_M f64 "endless_height_m" "blocks";
    }
    shake_table "/shake_table" {
        STRUCTURE String "structure" "the structure file";
        LENGTH_SCALE f64 "length_scale" "prototype over model";
        ANALYSES u64 "analyses" "tests";
        SECONDS f64 "seconds" "wall time";
    }
}

impl<V: Value + Into<AttributeValue>> Attribute<V> {
    /// Writes it to its group, which must exist.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write(
        &self,
        writer: &mut LabelledWriter,
        names: Names<'_>,
        value: impl Into<V>,
    ) -> Result<(), LabelledError> {
        writer.attribute(&named(self.group, names), self.name, value.into())
    }

    /// Reads it.
    ///
    /// # Errors
    /// A file without it, or that is damaged.
    pub fn read(&self, reader: &LabelledReader, names: Names<'_>) -> Result<V, LabelledError> {
        reader.attribute(&named(self.group, names), self.name)
    }
}

/// Note on the group `group` what made it, and when.
///
/// # Errors
/// A file that cannot be written.
pub fn sign(writer: &mut LabelledWriter, group: &str) -> Result<(), LabelledError> {
    writer.group(group)?;
    let names = [("<group>", group)];
    signature::CREATED.write(writer, &names, uplift_job::now())?;
    signature::VERSION.write(writer, &names, uplift_job::VERSION)?;
    signature::COMMIT.write(writer, &names, uplift_job::COMMIT)
}
