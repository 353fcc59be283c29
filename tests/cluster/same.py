"""Whether two results hold the same numbers: same.py A.h5 B.h5.

Every array of both is read and compared bit by bit, with its units and names; of the attributes of the file those that
tell what was computed, not when, how long and by which command.
"""

import sys

import h5py

WHAT = ["version", "commit", "title", "record_set", "input_checksums", "warnings"]


def arrays(path):
    found = {}
    with h5py.File(path) as file:
        def visit(name, item):
            if isinstance(item, h5py.Dataset):
                value = item[()]
                content = value.tobytes() if value.dtype.kind != "O" else repr(value.tolist())
                found[name] = (str(item.dtype), item.shape, content, item.attrs.get("units"), item.attrs.get("sha256"))
        file.visititems(visit)
        for name in WHAT:
            found[f"attribute {name}"] = repr(file.attrs[name])
    return found


first, second = (arrays(path) for path in sys.argv[1:3])
different = sorted(name for name in first.keys() | second.keys() if first.get(name) != second.get(name))
if different or not any(name.startswith("ida/") for name in first):
    sys.exit(f"{sys.argv[2]} differs from {sys.argv[1]}: {', '.join(different)}")
print(f"{sys.argv[2]}: the {len(first) - len(WHAT)} arrays of the undisturbed run, to the bit")
