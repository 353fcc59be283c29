//! The two things the safe binding of HDF5 cannot do.
#![allow(unsafe_code)]
// 1. Dimension scales are recognised by a fixed-length, NULL-TERMINATED text attribute; the binding only makes
//    null-padded ones, which HDF5's own `H5DSis_scale` (and with it h5py and netCDF4) rejects.
// 2. A compound type for `REFERENCE_LIST`: implementing the binding's trait for it is `unsafe` by declaration.

use std::ffi::c_int;

use hdf5::types::FixedAscii;
use hdf5::{Datatype, H5Type, ObjectReference1};

/// `H5T_STR_NULLTERM` of the HDF5 headers.
const NULL_TERMINATED: c_int = 0;

// Part of the HDF5 library that the binding links; both check the identifier and the value they are given.
unsafe extern "C" {
    safe fn H5Tset_size(datatype: i64, bytes: usize) -> c_int;
    safe fn H5Tset_strpad(datatype: i64, padding: c_int) -> c_int;
}

/// The type of a null-terminated ASCII text of `length` characters.
pub(super) fn null_terminated_text(length: usize) -> hdf5::Result<Datatype> {
    let datatype = Datatype::from_type::<FixedAscii<1>>()?;
    // The library is not thread-safe: the binding's own lock is held over both calls.
    hdf5::sync::sync(|| {
        hdf5::h5check(H5Tset_size(datatype.id(), length + 1))?;
        hdf5::h5check(H5Tset_strpad(datatype.id(), NULL_TERMINATED))
    })?;
    Ok(datatype)
}

/// One entry of a scale's `REFERENCE_LIST`: dimension `dimension` of `dataset` runs along the scale.
///
/// Packed, so that no undefined padding byte reaches the file.
#[derive(Clone, Copy, H5Type)]
#[repr(C, packed)]
pub(super) struct ScaleUse {
    pub(super) dataset: ObjectReference1,
    pub(super) dimension: i32,
}
