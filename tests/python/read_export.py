"""Reads the exports of a result as a reader would, and checks that they hold what the result holds.

    python read_export.py RESULT.h5 RESULT.spectra.csv RESULT.json RESULT.mat RESULT.xlsx

Needs h5py, numpy, openpyxl, pandas and scipy. The result has bands.
"""

import json
import sys

import h5py
import numpy as np
import openpyxl
import pandas as pd
from scipy.io import loadmat

result, table, text, matlab, book = sys.argv[1:]
measures = ("pgv", "pga")
limits = ("u05", "u50", "u95")
beyond = ("truth_lower", "truth_upper", "prediction_lower", "prediction_upper")
flags = ("regular", "no exceedance", "censored")
with h5py.File(result) as file:
    u_m = {im: file[f"/urs/{im}/u_m"][()] for im in measures}
    flag = {im: file[f"/urs/{im}/flag"][()] for im in measures}
    bands = {(im, name): file[f"/bootstrap/{im}/{name}_m"][()] for im in measures
             for name in limits + beyond}
    e_median = {im: file[f"/bootstrap/{im}/e_median"][()] for im in measures}
    coefficients = {im: {name: file[f"/regression/{im}/{name}"][()] for name in ("c0_m", "c1", "c2_m", "rmse_m")}
                    for im in measures}
    bias = {im: file[f"/consistency/{im}/{other}_bias"][()] for im, other in (("pgv", "pga"), ("pga", "pgv"))}
    sites = list(file["/axes/site"].asstr())
    poe, strength = file["/axes/poe"][()], file["/axes/strength"][()]
    sizes = file["/axes/sample_size"][()]
    years = float(file.attrs["poe_years"])
    created, study = file.attrs["created"], file.attrs["study_toml"].splitlines()
    maf = {(site, im): file[f"/hazard/{site}/{im}/maf_per_year"][()] for site in sites for im in measures}
period = -years / np.log1p(-poe)
shape = (len(sites), len(poe), len(strength))

# a table is nothing but a table, whatever its sites are called
tidy = pd.read_csv(table)
names = [f"{name}_n{size}_m" for of in (limits, beyond) for size in sizes for name in of]
assert list(tidy.columns) == ["site", "im", "poe", "years", "strength", "u_m", "lower_m", "upper_m", "fit_m",
                              "return_period_years", "flag", "lower_tail_share", "upper_tail_share", *names]
for im in measures:
    own = tidy[tidy.im == im.upper()]
    assert np.array_equal(own.u_m.to_numpy().reshape(shape), u_m[im])
    assert list(own.flag) == [flags[number] for number in flag[im].ravel()]
    for index, size in enumerate(sizes):
        for name in limits + beyond:
            values = own[f"{name}_n{size}_m"].to_numpy().reshape(shape)
            assert np.array_equal(values, bands[im, name][:, :, index])
assert np.allclose(np.sort(tidy.return_period_years.unique()), np.sort(period), rtol=1e-12)
for beside in (table, table.replace(".spectra.csv", ".urs.csv"), table.replace(".spectra.csv", ".bands.csv")):
    columns = list(pd.read_csv(beside).columns)
    metadata = json.load(open(f"{beside}-metadata.json", encoding="utf-8"))
    assert metadata["@context"] == "http://www.w3.org/ns/csvw" and metadata["dc:provenance"].startswith("uplift ")
    assert [column["titles"] for column in metadata["tableSchema"]["columns"]] == columns

tree = json.load(open(text, encoding="utf-8"))
assert tree["strength"] == list(strength) and len(tree["alarms"]) > 1
assert list(tree)[0] == "provenance", "what a file is of stands first"
alarms = [alarm["what"] for alarm in tree["alarms"]]
first = tree["spectra"][0]
finite = [value if np.isfinite(value) else None for value in u_m["pgv"][0, 0]]
assert first["site"] == sites[0] and first["u_m"] == finite
assert first["flag"] == [flags[number] for number in flag["pgv"][0, 0]]
assert [band["sample_size"] for band in first["bands"]] == list(sizes)
lower = bands["pgv", "u05"][0, 0, -1]
assert first["bands"][-1]["u05_m"] == [value if np.isfinite(value) else None for value in lower]
for name in beyond:
    values = bands["pgv", name][0, 0, -1]
    assert first["bands"][-1][f"{name}_m"] == [value if np.isfinite(value) else None for value in values]

file = loadmat(matlab)
assert [str(name[0]) for name in file["site"][:, 0]] == sites
said = [str(line[0]) for line in file["warnings"][:, 0]]
words = {"mistake": "mistake?", "caution": "caution", "note": "note"}
assert len(said) == len(alarms)
for line, alarm in zip(said, tree["alarms"]):
    assert line.startswith(words[alarm["severity"]] + ": ") and line.endswith(alarm["what"]), line
assert np.array_equal(file["strength"][:, 0], strength) and np.array_equal(file["poe"][:, 0], poe)
assert np.array_equal(file["sample_size"][:, 0], sizes)
for im in measures:
    assert np.array_equal(file[f"u_{im}_m"], u_m[im].transpose(2, 1, 0))
    assert np.array_equal(file[f"flag_{im}"], flag[im].transpose(2, 1, 0))
    for name in limits + beyond:
        assert np.array_equal(file[f"{name}_{im}_m"], bands[im, name].transpose(3, 2, 1, 0))
    assert np.array_equal(file[f"e_median_{im}_pct"], e_median[im].transpose(2, 1, 0), equal_nan=True)
    assert np.array_equal(file[f"consistency_bias_{im}"][:, 0], bias[im], equal_nan=True)
assert np.array_equal(file["c0_pgv_m"], coefficients["pgv"]["c0_m"].T, equal_nan=True)
assert str(file["provenance"][0]).startswith("uplift ")

workbook = openpyxl.load_workbook(book)
assert workbook.sheetnames == ["About", "Spectra", "Bands", "Table 4.1", "Flags and tails", "Coefficients",
                               "Consistency", "Hazard", "Study"]
assert all(cell.data_type != "f" for sheet in workbook for row in sheet.iter_rows() for cell in row), "no formula"
assert workbook.properties.created.strftime("%Y-%m-%dT%H:%M:%SZ") == created
assert workbook.properties.description.startswith("uplift ")


def number(value):
    """A number of a cell; a censored ordinate is a word."""
    return np.inf if value == "censored" else float(value)


def block(sheet, head, value):
    """The columns of a sheet by what stands at their head; `value` is the unit above the numbers."""
    rows = list(workbook[sheet].iter_rows(values_only=True))
    assert workbook[sheet].freeze_panes == f"B{head + 1}"
    assert [row[0] for row in rows[head:]] == list(strength)
    assert set(rows[head - 1][1:]) == {value}
    return {tuple(row[column] for row in rows[: head - 1]): [number(row[column]) for row in rows[head:]]
            for column in range(1, len(rows[0]))}


spectra = block("Spectra", 6, "u, m")
assert len(spectra) == 3 * 2 * len(sites) * len(poe)
band = block("Bands", 7, "u, m")
for im in measures:
    for i, site in enumerate(sites):
        for j, probability in enumerate(poe):
            found = [key for key in spectra if key[:3] == (site, im.upper(), probability)]
            assert [key[4] for key in found] == ["best estimate", "90 % band, lower", "90 % band, upper"]
            assert abs(found[0][3] / period[j] - 1) < 1e-12
            assert spectra[found[0]] == list(u_m[im][i, j])
            quoted = [[limit if np.isfinite(limit) else None for limit in spectra[key]] for key in found[1:]]
            own = tree["spectra"][(measures.index(im) * len(sites) + i) * len(poe) + j]
            assert quoted == [own["lower_m"], own["upper_m"]]
            assert np.array_equal(file[f"lower_{im}_m"][:, j, i], spectra[found[1]])
            assert all(low <= high for low, high in zip(*(spectra[key] for key in found[1:])))
            for index, size in enumerate(sizes):
                for word, name in zip(("resamples, 5 %", "resamples, median", "resamples, 95 %"), limits):
                    assert band[(*found[0][:4], size, word)] == list(bands[im, name][i, j, index])
                words = [f"90 % {of}, {limit}" for of in ("band", "of another set") for limit in ("lower", "upper")]
                for word, name in zip(words, beyond):
                    assert band[(*found[0][:4], size, word)] == list(bands[im, name][i, j, index])
rows = list(workbook["Flags and tails"].iter_rows(values_only=True))
heads = [tuple(row[column] for row in rows[:3]) + (rows[4][column],) for column in range(1, len(rows[0]))]
column = 1 + heads.index((sites[0], "PGV", poe[0], "flag"))
assert [row[column] for row in rows[5:]] == [flags[number] for number in flag["pgv"][0, 0]]
assert rows[4][column + 1:column + 3] == ("share from below", "share from above")
assert workbook["Flags and tails"].cell(6, column + 2).number_format == "0.00%"
# a heading with % is of numbers in per cent, whose cells have no sign that would multiply them once more
for sheet in workbook.worksheets:
    headed = [cell for row in sheet.iter_rows(max_row=6) for cell in row if str(cell.value).endswith(", %")]
    for heading in headed:
        below = sheet.iter_cols(heading.column, heading.column, heading.row + 1)
        assert all("%" not in cell.number_format for column in below for cell in column), (sheet.title, heading.value)
cell = workbook["Spectra"]["B3"]
assert cell.number_format == "0.00%" and workbook["Spectra"]["B7"].number_format == "0.0000"

fits = pd.read_excel(book, sheet_name="Coefficients")
for im in measures:
    own = fits[fits.measure == im.upper()]
    for name, column in (("c0_m", "c0, m"), ("c1", "c1, -"), ("c2_m", "c2, m"), ("rmse_m", "RMSE, m")):
        expected = coefficients[im][name].ravel()
        assert np.array_equal(own[column].to_numpy(dtype=float), expected, equal_nan=True), (im, name)
figures = pd.read_excel(book, sheet_name="Table 4.1")
own = figures[figures.measure == "PGV"]["error of the median, %"].to_numpy(dtype=float)
assert np.array_equal(own, e_median["pgv"].ravel(), equal_nan=True)
found = pd.read_excel(book, sheet_name="Consistency")
assert list(found.site) == 2 * sites and list(found["scaled to"]) == 2 * ["PGV"] + 2 * ["PGA"]
assert list(found.verdict) == [row["verdict"] or "no verdict" for row in tree["consistency"]]
assert np.array_equal(found.bias.to_numpy(dtype=float), np.concatenate([bias[im] for im in measures]), equal_nan=True)
curves = list(workbook["Hazard"].iter_rows(values_only=True))
assert curves[0][0] == sites[0] and curves[1][:2] == ("PGV, cm/s", "rate, 1/yr")
assert [row[1] for row in curves[2:] if row[1] is not None] == list(maf[sites[0], "pgv"])
about = {row[0]: row[1] for row in workbook["About"].iter_rows(values_only=True)}
assert about["Made"] == created and about["Study digest"] == tree["study_digest"]
said = [row[1] for row in workbook["About"].iter_rows(values_only=True)][-len(alarms):]
assert all(what in line for line, what in zip(said, alarms))
assert [row[0] for row in workbook["Study"].iter_rows(values_only=True)][1:] == [line or None for line in study]
print("same numbers")
