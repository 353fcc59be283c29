"""Groups as datasets of xarray, whose arrays are read when they are looked at; imported where xarray is."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray
from xarray.backends import BackendArray
from xarray.core import indexing

from ._groups import Array, Arrays


class LazyArray(BackendArray):
    """An array of a file, for xarray."""

    def __init__(self, array: Array) -> None:
        self.array, self.shape = array, array.shape
        self.dtype = np.dtype(object) if array.is_text else array.dtype

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        support = indexing.IndexingSupport.OUTER_1VECTOR
        return indexing.explicit_indexing_adapter(key, self.shape, support, self.array.read)


def dataset(of: Arrays) -> xarray.Dataset:
    """The group with names, units and attributes of the file."""
    return xarray.Dataset({name: _variable(array) for name, array in of.arrays.items()}, attrs=of.attrs)


def _variable(array: Array) -> xarray.Variable:
    # axes are small, and xarray looks up in them
    is_axis = array.dimensions == (array.name.rpartition("/")[2],)
    values = array.read() if is_axis else indexing.LazilyIndexedArray(LazyArray(array))
    return xarray.Variable(array.dimensions, values, array.attributes)
