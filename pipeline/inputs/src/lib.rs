//! Records and hazard curves, read and checked before anything is computed.

pub mod at_level;
mod cache;
mod checksums;
mod curve_file;
mod default_levels;
mod drawn_structure;
mod duplicates;
mod error;
mod file_options;
mod hardly_possible;
mod hazard;
pub mod hazard_curves;
pub mod import;
mod levelling_off;
mod made;
pub mod manifest;
mod other_unit;
pub mod pairs;
mod record;
mod record_set;
mod record_sets;
pub mod records;
mod rocking_frame;
pub mod selection;
mod shaken_structures;
mod site_table;
mod third_component;

pub use at_level::AtLevel;
pub use checksums::{input_checksums, motion_keys};
pub use default_levels::{load_study, load_uniform_risk};
pub use drawn_structure::DrawnStructure;
pub use error::InputsError;
pub use file_options::FileOptions;
pub use hardly_possible::hardly_possible;
pub use hazard::{BranchHazard, HazardInput, OtherHazard, SiteHazard, read_hazard, read_other_hazard};
pub use levelling_off::levelling_off;
pub(crate) use made::made_pairs;
pub use other_unit::{
    POE, curve_line, file_of, unit_of_branch, unit_that_covers, unit_that_explains, units_that_make_possible,
};
pub use record::Record;
pub use record_set::{RecordSet, read_measured, read_records, read_with_pairs};
pub use record_sets::{NamedSet, RecordSets, SetRecord, is_numbered, read_record_sets, read_sets};
pub use rocking_frame::{TORSION, model_of, rocking_frame};
pub use site_table::{
    BatchSite, ListedSite, SharedCurve, SiteCurves, SiteExport, SiteList, read_site_list, site_table_checksums,
};
pub use third_component::Vertical;
