"""Compares two result files bit by bit: every array and axis (bytes, type, shape, dimensions) and every attribute.

    python compare_results.py OLD.h5 NEW.h5 [--ignore NAME]...

Attributes that tell of the run and not of its numbers are left out, on every group; --ignore leaves out more, by the
name of an attribute or by the path of an array or group. Differences are listed, and the exit code is then 1.
"""

import argparse
import sys

import h5py
import numpy as np

OF_THE_RUN = {"created", "wall_time_s", "seconds", "command", "commit", "version", "threads", "platform", "study_place"}
# the references of dimension scales are addresses in the file; what they say is compared as `dims`
OF_THE_FILE = {"DIMENSION_LIST", "REFERENCE_LIST"}


def objects(file, ignored):
    """Every group, array and axis by its path. A hard link to an axis stands there as the name of the axis."""
    found = {"/": file}

    def visit(group, place):
        for name in group:
            child, path, axis = group[name], f"{place}/{name}", f"/axes/{name}"
            if path in ignored:
                continue
            if place != "/axes" and axis in file and child == file[axis]:
                found[path] = f"link to {axis}"
                continue
            found[path] = child
            if isinstance(child, h5py.Group):
                visit(child, path)

    visit(file, "")
    return found


def topmost(paths):
    """Those paths that lie in none of the others."""
    return sorted(path for path in paths if path.rsplit("/", 1)[0] not in paths)


def bits(value):
    """What two values must share to be the same: type, shape and bytes."""
    if isinstance(value, h5py.Empty):
        return (str(value.dtype), None, None)
    array = np.asarray(value)
    if array.dtype.kind in "OSU":
        texts = [text.encode() if isinstance(text, str) else bytes(text) for text in array.ravel().tolist()]
        return ("text", array.shape, texts)
    return (array.dtype.str, array.shape, array.tobytes())


def dims(dataset):
    """The label of each dimension, and the name of the axis along it."""
    return [[dimension.label, *(scale.attrs["NAME"] for scale in dimension.values())] for dimension in dataset.dims]


def shown(value):
    text = str(value).replace("\n", "\\n")
    return text if len(text) <= 60 else text[:57] + "..."


def differences_of_arrays(path, old, new):
    if old.dtype != new.dtype:
        yield f"{path}: type {old.dtype} before, {new.dtype} now"
    elif old.shape != new.shape:
        yield f"{path}: shape {old.shape} before, {new.shape} now"
    elif (before := bits(old[()])) != (now := bits(new[()])):
        if before[0] == "text":
            count = sum(a != b for a, b in zip(before[2], now[2]))
        else:
            a, b = (np.ascontiguousarray(array[()]).reshape(-1).view(np.uint8) for array in (old, new))
            count = int((a != b).reshape(-1, old.dtype.itemsize).any(axis=1).sum())
        yield f"{path}: {count} of {old.size} values differ"
    if dims(old) != dims(new):
        yield f"{path}: dimensions {dims(old)} before, {dims(new)} now"
    for what in ("chunks", "compression", "compression_opts", "shuffle"):
        if getattr(old, what) != getattr(new, what):
            yield f"{path}: {what} {getattr(old, what)} before, {getattr(new, what)} now"


def differences_of_attributes(path, old, new, ignored):
    names = sorted((set(old) | set(new)) - ignored - OF_THE_FILE)
    for name in names:
        if name not in new:
            yield f"{path}: attribute {name} is gone"
        elif name not in old:
            yield f"{path}: attribute {name} is new"
        elif bits(old[name]) != bits(new[name]):
            yield f"{path}: attribute {name}: {shown(old[name])} before, {shown(new[name])} now"


def compare(old_path, new_path, ignored):
    """Everything in which the two files differ, and how many arrays and axes were compared."""
    found = []
    with h5py.File(old_path) as old_file, h5py.File(new_path) as new_file:
        old, new = objects(old_file, ignored), objects(new_file, ignored)
        found += [f"{path}: is gone" for path in topmost(set(old) - set(new))]
        found += [f"{path}: is new" for path in topmost(set(new) - set(old))]
        arrays = 0
        for path in sorted(set(old) & set(new)):
            if type(old[path]) is not type(new[path]):
                found.append(f"{path}: a group, an array or a link in one file, and something else in the other")
                continue
            if isinstance(old[path], str):
                continue
            if isinstance(old[path], h5py.Dataset):
                arrays += 1
                found += differences_of_arrays(path, old[path], new[path])
            found += differences_of_attributes(path, old[path].attrs, new[path].attrs, ignored | OF_THE_RUN)
    return found, arrays


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("old", help="result file before")
    parser.add_argument("new", help="result file after")
    parser.add_argument("--ignore", action="append", default=[], metavar="NAME", help="attribute, or path of an array")
    arguments = parser.parse_args()
    found, arrays = compare(arguments.old, arguments.new, set(arguments.ignore))
    for difference in found:
        print(difference)
    if found:
        sys.exit(1)
    print(f"{arrays} arrays and axes are the same bit by bit, and so are their attributes")


if __name__ == "__main__":
    main()
