//! Records and hazard curves, read and checked before anything is computed.

pub(crate) mod at_level;
mod cache;
mod drawn_structures;
mod file_options;
mod hardly_possible;
mod hazard;
mod made;
pub mod manifest;
mod motion_keys;
mod other_unit;
pub mod pairs;
mod record_set;
mod record_sets;
pub mod selection;
mod site_table;
pub(crate) mod text_table;
mod third_component;

pub use at_level::AtLevel;
pub use drawn_structures::DrawnStructure;
pub use file_options::FileOptions;
pub(crate) use hardly_possible::hardly_possible;
pub use hazard::{BranchHazard, HazardInput, OtherHazard, SiteHazard, read_hazard, read_other_hazard};
pub(crate) use made::made_pairs;
pub(crate) use motion_keys::motion_keys;
pub(crate) use other_unit::{POE, curve_line, file_of, unit_of_branch, unit_that_explains, units_that_make_possible};
pub use record_set::{Record, RecordSet, read_records};
pub(crate) use record_set::{read_measured, read_with_pairs};
pub use record_sets::{NamedSet, RecordSets, SetRecord, read_record_sets};
pub(crate) use record_sets::{is_numbered, read_sets};
pub use site_table::{BatchSite, ListedSite, SharedCurve, SiteCurves, SiteExport, SiteList, read_site_list};
pub use third_component::Vertical;
