"""Opens the result of a study of displacement spectra as docs/hdf5-layout.md tells users to, and finds its percentiles
with numpy.

    python read_displacements.py RESULT.h5
"""

import sys

import h5py
import numpy as np
import xarray as xr

path = sys.argv[1]

with h5py.File(path) as file:
    assert file.attrs["kind"] == "displacement spectra"
    line = {"oscillator": ["uplift_displacement", "capacity"], "block": ["height"]}[file.attrs["structure"]]
    abscissa = {"oscillator": "strength", "block": "slenderness"}[file.attrs["structure"]]
    u_m = file["spectra/u_m"]
    dims = [dimension.label for dimension in u_m.dims]
    assert dims == ["record_set", "scaling", "scaled_by", *line, "percentile", abscissa], dims
    assert u_m.attrs["units"] == "m"
    percentiles = file["axes/percentile"][:]
    abscissae = file["axes/" + abscissa][:]
    for index, name in enumerate(file["axes/record_set"].asstr()[:]):
        group = file["sets"][name]
        motions = group["u_m"][:]  # …, abscissa, motion
        assert motions.shape[-1] == 2 * group.attrs["records"]
        assert not np.isnan(motions).any()
        expected = np.moveaxis(percentile := np.empty((len(percentiles), *motions.shape[:-1])), 0, -2)
        sample = np.sort(motions, axis=-1)
        for place, percent in enumerate(percentiles):
            # linear between order statistics; numpy's own makes NaN of two infinite neighbours
            position = percent / 100 * (sample.shape[-1] - 1)
            below, above = sample[..., int(np.floor(position))], sample[..., int(np.ceil(position))]
            weight = position - np.floor(position)
            with np.errstate(invalid="ignore"):
                between = np.where(weight == 0, below, below + weight * (above - below))
            percentile[place] = np.where(np.isinf(below), np.inf, between)
            finite = np.isfinite(motions).all(axis=-1)
            assert np.allclose(percentile[place][finite], np.percentile(motions, percent, axis=-1)[finite], rtol=1e-12)
        ours = u_m[index]
        assert ((ours == expected) | (np.abs(ours - expected) <= 1e-12 * expected)).all()
        assert np.allclose(file["spectra/overturned"][index], np.isinf(motions).mean(axis=-1))
        critical = np.where(np.isinf(expected), abscissae, -np.inf).max(axis=-1)
        critical = np.where(np.isinf(critical), np.nan, critical)
        assert np.array_equal(file["spectra/critical"][index], critical, equal_nan=True)
    overturned = np.isinf(u_m[:]).sum()

for engine in ("netcdf4", "h5netcdf"):
    with xr.open_dataset(path, group="/spectra", engine=engine) as spectra:
        one = spectra.u_m.isel(record_set=0, percentile=0).sel(scaling="unscaled")
        # what is not scaled stands under each of the ways
        assert (one == one.isel(scaled_by=0)).all()
        assert spectra[abscissa].attrs["units"] == "1"
    with xr.open_dataset(path, group="/design", engine=engine) as design:
        value = design.error.sel(bound="value")
        assert (value >= design.error.sel(bound="lowest")).where(value.notnull(), True).all()

print(f"percentiles, shares and critical abscissae as numpy finds them; {overturned} ordinates infinite")
