"""Groups of a result file as xarray has them, read when they are looked at; or as arrays of numpy."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ._optional import optional
from ._sealed import SealedFile

if TYPE_CHECKING:
    import xarray

# what HDF5 and netCDF keep for themselves
_INTERNAL = ("CLASS", "NAME", "DIMENSION_LIST", "DIMENSION_LABELS", "REFERENCE_LIST")


def attributes(of: Any) -> dict[str, Any]:
    """The attributes of a group or an array, without those of HDF5 itself."""
    named = {name: value for name, value in of.attrs.items() if not name.startswith(("_Netcdf4", "_NC"))}
    kept = {name: value for name, value in named.items() if name not in _INTERNAL}
    return {name: value.item() if isinstance(value, np.generic) else value for name, value in kept.items()}


def _dimensions(array: Any) -> tuple[str, ...]:
    return tuple(dimension.label for dimension in array.dims)


class Array:
    """An array of a file, which is not kept open."""

    def __init__(self, file: SealedFile, array: Any) -> None:
        self.file, self.name = file, array.name
        self.attributes = attributes(array)
        self.is_text = array.dtype.kind == "O"
        # a scale of the axes names no dimension: it is its own
        self.dimensions = _dimensions(array)
        if not any(self.dimensions):
            self.dimensions = (array.name.rpartition("/")[2],) * array.ndim
        self.shape = array.shape
        self.dtype = array.dtype

    def read(self, key: Any = ()) -> np.ndarray[Any, Any]:
        """The values at `key`, straight from the file."""
        with self.file.open() as file:
            array = file.get(self.name)
            if array is None or array.attrs.get("sha256") != self.attributes.get("sha256"):
                raise OSError(f"{self.file.path}: {self.name} has changed since it was opened: open the result again")
            return np.asarray((array.asstr() if self.is_text else array)[key])


class Arrays(Mapping[str, np.ndarray[Any, Any]]):
    """A group without xarray: its arrays by name, axes included, each read when it is asked for.

    Attributes
    ----------
    attrs : dict
        Attributes of the group.
    dims : dict
        Names of the axes of each array, in order.
    units : dict
        Unit of each array of numbers.
    arrays : dict
        The arrays of the file, unread.
    """

    def __init__(self, arrays: dict[str, Array], attrs: dict[str, Any]) -> None:
        self.arrays = arrays
        self.attrs = attrs
        self.dims = {name: array.dimensions for name, array in arrays.items()}
        self.units = {name: array.attributes["units"] for name, array in arrays.items() if "units" in array.attributes}

    def __getitem__(self, name: str) -> np.ndarray[Any, Any]:
        return self.arrays[name].read()

    def __iter__(self) -> Iterator[str]:
        return iter(self.arrays)

    def __len__(self) -> int:
        return len(self.arrays)

    def __repr__(self) -> str:
        return "\n".join(f"{name} {dimensions} {self.units.get(name, '')}" for name, dimensions in self.dims.items())


def read_group(of: SealedFile, group: Any) -> Arrays:
    """The arrays of an open group; none of them is read."""
    h5py = optional("h5py", "results")
    arrays = {name: Array(of, item) for name, item in group.items() if isinstance(item, h5py.Dataset)}
    return Arrays(arrays, attributes(group))


def dataset(of: Arrays) -> xarray.Dataset | Arrays:
    """The group as xarray has it, where xarray is installed."""
    try:
        from . import _lazy
    except ImportError:
        return of
    return _lazy.dataset(of)


def columns(of: Arrays) -> dict[str, np.ndarray[Any, Any]]:
    """The group as a table: a row for each combination of its axes, a column for each axis and array."""
    sizes = {name: size for array in of.arrays.values() for name, size in zip(array.dimensions, array.shape)}
    axes, shape = list(sizes), tuple(sizes.values())

    def column(name: str, dimensions: tuple[str, ...]) -> np.ndarray[Any, Any]:
        # in the order of the table, then stretched over the axes that it lacks
        values = of[name].transpose([dimensions.index(axis) for axis in axes if axis in dimensions])
        values = values.reshape([sizes[axis] if axis in dimensions else 1 for axis in axes])
        return np.broadcast_to(values, shape).reshape(-1)

    ordered = [name for name in axes if name in of] + [name for name in of if name not in sizes]
    return {name: column(name, of.dims[name]) for name in ordered}
