//! Files of labelled arrays: HDF5 that reads as netCDF-4.
//!
//! Every array names its dimensions, and every dimension is an *axis*: a named list of values with a unit, stored once
//! as an HDF5 dimension scale in the group `/axes`. h5py, xarray (engines `netcdf4` and `h5netcdf`), netCDF4, pandas,
//! MATLAB and h5dump then show `u_m (site, poe, strength)` instead of three anonymous numbers.
//!
//! ```text
//! /axes/strength          dimension scale [strength], units, long_name
//! /urs/pgv/u_m            array [site, poe, strength], units, long_name
//! /urs/pgv/strength       hard link to /axes/strength
//! ```
//!
//! The hard links are there because a netCDF-4 dimension is visible in its own group and in the groups below it only:
//! scales that live in the sibling group `/axes` alone make the netCDF library refuse the file. A link costs a few
//! bytes, copies nothing, and gives every group its coordinates too, so that `xr.open_dataset(file, group="/urs/pgv")`
//! is complete. [`LabelledReader::children`] leaves the links out.
//!
//! Every array carries the SHA-256 of its values, and behind the end of the file, where no reader of HDF5 looks, stands
//! its seal: the SHA-256 of each part and of all bytes. [`LabelledReader`] reads nothing that has changed since it was
//! written, [`verify`] says what has.
//!
//! The layer knows nothing of the science, and it writes nothing that depends on the time or the machine: two files
//! with the same content are equal byte for byte.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! use uplift_labelled::{LabelledReader, LabelledWriter};
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("result.h5");
//!
//! let mut writer = LabelledWriter::create(&path)?;
//! writer.attribute("/", "program", "uplift")?;
//! writer.axis("strength", &[0.1, 0.2, 0.3], "1", "uplift strength over weight")?;
//! writer.array("/urs/pgv/u_m", &["strength"], &[0.4, 0.2, 0.1], "m", "displacement")?;
//! writer.finish()?;
//!
//! let reader = LabelledReader::open(&path)?;
//! assert_eq!(reader.array::<f64>("/urs/pgv/u_m")?.dims, ["strength"]);
//! # Ok(())
//! # }
//! ```

mod attribute;
mod checksum;
mod copy;
mod dimension_scale;
mod error;
mod growing;
mod native;
mod reader;
mod seal;
mod text;
mod verify;
mod writer;

pub use attribute::AttributeValue;
pub use checksum::hexadecimal;
pub use error::LabelledError;
pub use growing::GrowingArray;
pub use reader::{LabelledArray, LabelledReader, Number, Value};
pub use seal::Seal;
pub use verify::{Verdict, verify, verify_bytes};
pub use writer::LabelledWriter;

/// The group that holds every axis.
const AXES: &str = "/axes";
