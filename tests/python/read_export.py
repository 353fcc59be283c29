"""Reads the exports of a result and checks that they hold what the result holds.

    python read_export.py RESULT.h5 RESULT.spectra.csv RESULT.json RESULT.mat

Needs h5py, numpy, pandas and scipy.
"""

import json
import sys

import h5py
import numpy as np
import pandas as pd
from scipy.io import loadmat

result, table, text, matlab = sys.argv[1:]
with h5py.File(result) as file:
    u_m = {im: file[f"/urs/{im}/u_m"][()] for im in ("pgv", "pga")}
    names = ("flag", "lower_tail_share", "upper_tail_share")
    of_ordinates = {im: {name: file[f"/urs/{im}/{name}"][()] for name in names} for im in u_m}
    c0_m = file["/regression/pgv/c0_m"][()]
    sites = list(file["/axes/site"].asstr())
    poe, strength = file["/axes/poe"][()], file["/axes/strength"][()]

with open(table, encoding="utf-8") as lines:
    assert lines.readline().startswith("# uplift ")
tidy = pd.read_csv(table, skiprows=1)
shares = ["lower_tail_share", "upper_tail_share"]
assert list(tidy.columns) == ["site", "im", "poe", "years", "strength", "u_m", "fit_m", "flag", *shares]
for im in ("pgv", "pga"):
    own = tidy[tidy.im == im.upper()].u_m.to_numpy().reshape(len(sites), len(poe), len(strength))
    assert np.array_equal(own, u_m[im])

tree = json.load(open(text, encoding="utf-8"))
assert tree["strength"] == list(strength)
first = tree["spectra"][0]
assert first["site"] == sites[0] and first["u_m"] == list(u_m["pgv"][0, 0])
assert set(first["flag"]) <= {"regular", "no exceedance", "censored"} and len(tree["alarms"]) > 0

file = loadmat(matlab)
assert [str(name[0]) for name in file["site"][:, 0]] == sites
assert np.array_equal(file["strength"][:, 0], strength) and np.array_equal(file["poe"][:, 0], poe)
for im in ("pgv", "pga"):
    assert np.array_equal(file[f"u_{im}_m"], u_m[im].transpose(2, 1, 0))
    for share in ("flag", *shares):
        assert np.array_equal(file[f"{share}_{im}"], of_ordinates[im][share].transpose(2, 1, 0))
assert np.array_equal(file["c0_pgv_m"], c0_m.T, equal_nan=True)
assert str(file["provenance"][0]).startswith("uplift ")
print("same numbers")
