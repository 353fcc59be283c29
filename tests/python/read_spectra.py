"""Opens a result file as docs/hdf5-layout.md tells users to, with h5py and both engines of xarray.

    python read_spectra.py RESULT.h5
"""

import sys

import h5py
import numpy as np
import xarray as xr

path = sys.argv[1]

with h5py.File(path) as file:
    u_m = file["urs/pgv/u_m"]
    dims = [dimension.label for dimension in u_m.dims]
    assert dims == ["site", "poe", "strength"], dims
    assert u_m.attrs["units"] == "m"
    assert file.attrs["program"] == "uplift"
    expected = u_m[:]
    sites = list(file["axes/site"].asstr()[:])
    strengths = file["axes/strength"][:]

for engine in ("netcdf4", "h5netcdf"):
    with xr.open_dataset(path, group="/urs/pgv", engine=engine) as spectra:
        assert spectra.u_m.dims == ("site", "poe", "strength"), spectra.u_m.dims
        assert np.array_equal(spectra.u_m.values, expected)
        one = spectra.u_m.sel(site=sites[0], poe=0.02)
        assert np.array_equal(one.strength.values, strengths)
        assert spectra.u_m.attrs["units"] == "m"
    with xr.open_dataset(path, group="/ida/pga", engine=engine) as stripes:
        assert stripes.edp_m.dims == ("record", "strength", "pga_level"), stripes.edp_m.dims
    with xr.open_dataset(path, group="/regression/pgv", engine=engine) as fits:
        frame = fits.to_dataframe()
        assert {"c0_m", "c1", "c2_m"} <= set(frame.columns), frame.columns

print("h5py, xarray with netcdf4 and with h5netcdf: the same spectra")
