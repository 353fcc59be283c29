"""Reads a result file with every Python library a user may choose and checks that all of them see the same thing.

    python read_result.py RESULT.h5

Needs h5py, xarray, netCDF4, h5netcdf and pandas. Prints one line of JSON for each array: path, type, names of the
dimensions, shape, unit and, for numbers, the sum of the finite values. Exits with an error at the first difference.
"""

import json
import sys
import warnings

import h5py
import netCDF4
import numpy as np
import xarray as xr

AXES = "/axes"
ENGINES = ("netcdf4", "h5netcdf")


def arrays_and_axes(file):
    """Paths of all arrays and of all axes; links to an axis outside /axes count as neither."""
    arrays, axes = {}, {}

    def visit(group, path):
        for name, item in group.items():
            here = f"{path}/{name}"
            if isinstance(item, h5py.Group):
                visit(item, here)
            elif item.is_scale:
                if path == AXES:
                    axes[name] = item
                else:
                    assert item == file[f"{AXES}/{name}"], f"{here} is a scale, but not the axis {name}"
            else:
                arrays[here] = item

    visit(file, "")
    return arrays, axes


def values_of(dataset):
    """Values with texts as str."""
    return dataset.asstr()[()] if h5py.check_string_dtype(dataset.dtype) else dataset[()]


def same(a, b):
    a, b = np.asarray(a), np.asarray(b)
    if a.shape != b.shape:
        return False
    if a.dtype.kind == "f":
        return a.dtype == b.dtype and np.array_equal(a, b, equal_nan=True)
    return a.astype(object).tolist() == b.astype(object).tolist()


def check_h5py(path, array, axes):
    """Named dimensions with their scales, unit and description; returns the names of the dimensions."""
    dims = []
    for dimension in array.dims:
        assert len(dimension) == 1, f"{path}: {len(dimension)} scales on one dimension"
        name = dimension.label
        assert dimension[0] == axes[name], f"{path}: the scale of {name} is another"
        assert array.shape[len(dims)] == axes[name].shape[0], f"{path}: length of {name}"
        dims.append(name)
    check_attributes(path, array)
    return dims


def check_attributes(path, dataset):
    needed = ["long_name"] if h5py.check_string_dtype(dataset.dtype) else ["long_name", "units"]
    for name in needed:
        assert isinstance(dataset.attrs.get(name), str), f"{path}: attribute {name} is {dataset.attrs.get(name)!r}"


def check_dataset(path, variable, dims, expected, file, where):
    """One variable of xarray against h5py: dimensions, coordinates, values, attributes."""
    where = f"{path} by {where}"
    assert list(variable.dims) == dims, f"{where}: dimensions {variable.dims}, not {dims}"
    for dim in dims:
        assert dim in variable.coords, f"{where}: no coordinate {dim}"
        assert same(variable[dim].values, values_of(file[f"{AXES}/{dim}"])), f"{where}: coordinate {dim}"
    assert same(variable.values, expected), f"{where}: values"
    for attribute in ("units", "long_name"):
        assert variable.attrs.get(attribute) == file[path].attrs.get(attribute), f"{where}: {attribute}"
    frame = variable.rename(None).to_series() if dims else None
    if frame is not None:
        assert list(frame.index.names) == dims and len(frame) == variable.size, f"{where}: pandas series"


def main(result):
    with h5py.File(result, "r") as file:
        arrays, axes = arrays_and_axes(file)
        assert arrays and axes, "no arrays or no axes"
        for name, axis in axes.items():
            assert axis.ndim == 1 and axis.is_scale, f"{AXES}/{name} is no dimension scale"
            check_attributes(f"{AXES}/{name}", axis)
        for group in sorted({path.rpartition("/")[0] for path in arrays}):
            members = [path for path in arrays if path.rpartition("/")[0] == group]
            opened = {e: xr.open_dataset(result, group=group or None, engine=e) for e in ENGINES}
            for path in members:
                dims, expected = check_h5py(path, arrays[path], axes), values_of(arrays[path])
                name = path.rpartition("/")[2]
                for engine, dataset in opened.items():
                    check_dataset(path, dataset[name], dims, expected, file, f"xarray, {engine}")
            for dataset in opened.values():
                assert set(dataset.data_vars) == {path.rpartition("/")[2] for path in members}
                dataset.close()
        for engine in ENGINES:
            with xr.open_datatree(result, engine=engine) as tree:
                for path, array in arrays.items():
                    assert same(tree[path].values, values_of(array)), f"{path} by datatree, {engine}"
        with netCDF4.Dataset(result) as dataset:
            dataset.set_auto_mask(False)
            for path, array in arrays.items():
                assert dataset[path].dimensions == tuple(d.label for d in array.dims), f"{path} by netCDF4"
                assert same(dataset[path][...], values_of(array)), f"{path} by netCDF4"
            assert set(dataset.ncattrs()) == set(file.attrs), "attributes of the root by netCDF4"
        for path, array in sorted(arrays.items()):
            values = values_of(array)
            number = values.dtype.kind in "fiu" if isinstance(values, np.ndarray) else True
            line = {
                "path": path,
                "type": str(array.dtype) if number else "text",
                "dims": [dimension.label for dimension in array.dims],
                "shape": list(array.shape),
                "units": array.attrs.get("units"),
            }
            if number:
                line["sum"] = float(np.sum(values, where=np.isfinite(values), dtype=float))
            print(json.dumps(line, ensure_ascii=False))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    warnings.simplefilter("error")
    main(sys.argv[1])
