"""What other packages have, handed over: streams of ObsPy, OpenQuake's datastore, tables of pandas."""

import math
import os
import re
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pandas
import pytest

import uplift_urs as uplift
from conftest import REPOSITORY, skip_or_fail

YEARS = 50.0
# of a calculation of OpenQuake, which takes about ten: nothing is to hang where it waits for something
LIMIT_S = 120


def test_a_stream_of_obspy():
    obspy = pytest.importorskip("obspy")
    header = {"delta": 0.01, "network": "XX", "station": "ABC", "channel": "HNE"}
    samples = np.sin(np.arange(300) / 10).astype(np.float32)
    stream = obspy.Stream([obspy.Trace(samples, header)])
    record = uplift.Record.from_obspy(stream, unit="cm/s2")
    assert record.name == "XX.ABC..HNE" and record.dt_s == 0.01
    np.testing.assert_allclose(record.acceleration_m_s2, samples.astype(float) * 0.01, rtol=1e-15)
    assert uplift.respond(record, 1e-4).peak_displacement_m > 0
    with pytest.raises(ValueError, match="2 traces"):
        uplift.Record.from_obspy(stream + stream, unit="g")
    late = obspy.Trace(samples, header | {"starttime": stream[0].stats.endtime + 1})
    with pytest.raises(ValueError, match="masked"):
        uplift.Record.from_obspy((stream + obspy.Stream([late])).merge(), unit="g")


def peaks():
    """Peaks of three records, two strengths and five levels; the levels, in cm/s."""
    shaking = [np.sin(np.arange(400) / steps) for steps in (6.0, 8.0, 10.0)]
    records = [uplift.Record.from_array(samples, dt_s=0.02, unit="m/s2") for samples in shaking]
    levels = [1.0, 3.0, 10.0, 30.0, 100.0]
    return uplift.ida(records, [0.02, 0.1], levels), levels


def spectra_of(curves):
    return uplift.urs(*peaks(), curves, extrapolate="loglog").u_m


def test_the_map_of_many_sites_is_geoparquet(program, tmp_path, monkeypatch):
    try:
        import geopandas
    except ImportError:
        skip_or_fail("geopandas", "pip install --no-deps -r python/tests/requirements-openquake.txt")
    levels = [0.5, 2, 20, 300]
    head = "#,,\"generated_by='OpenQuake engine 3.26.2', kind='mean', investigation_time=1.0, imt='PGV'\"\n"
    head += "custom_site_id,lon,lat,depth," + ",".join(f"poe-{level:.7f}" for level in levels) + "\n"
    places = {"sea": (-11.5, 45.25, 0.0), "hill": (12.0, 45.5, 0.1)}
    rows = [
        ",".join([name, str(longitude), str(latitude), "0", *(repr(-math.expm1(-k0 / level**2)) for level in levels)])
        for name, (longitude, latitude, k0) in places.items()
    ]
    (tmp_path / "pgv.csv").write_text(head + "\n".join(rows) + "\n")
    study = "[records.synthetic]\npairs = 3\n[strengths]\nvalues = [0.05, 0.1, 0.2, 0.4]\n"
    (tmp_path / "many.toml").write_text(study + '[pgv]\nlevels_cm_s = [1, 5, 20, 60]\n[site_table]\npgv = "pgv.csv"\n')
    program(tmp_path, "run", "many.toml", "-q")
    monkeypatch.chdir(tmp_path)
    page = (REPOSITORY / "docs" / "many-sites.md").read_text(encoding="utf-8")
    (block,) = (block for block in re.findall(r"```python\n(.*?)```", page, re.DOTALL) if "to_parquet" in block)
    exec(block, {})
    found = geopandas.read_parquet("many.parquet").set_index("name")
    assert {name: (point.x, point.y) for name, point in found.geometry.items()} == {
        name: place[:2] for name, place in places.items()
    }
    assert found.crs.is_geographic and "no hazard" in found.loc["sea", "problem"]
    (ordinate,) = (name for name in found.columns if name.startswith("pgv_2pct") and name.endswith("u_m_at_0.2"))
    table = pandas.read_csv("results/many.sites.csv")
    same = table[(table.site == "hill") & (table.poe == 0.02) & (table.strength == 0.2)]
    assert found.loc["hill", ordinate] == pytest.approx(same.u_m.item(), rel=1e-4)


def test_a_table_of_a_hundred_sites():
    # a row each site and level, as a data frame comes
    levels = np.geomspace(0.1, 300, 12)
    names = [f"site {number:03}" for number in range(100)]
    rows = [(name, level, 0.3 * (1 + 0.01 * i) * level**-2.0) for i, name in enumerate(names) for level in levels]
    table = pandas.DataFrame(rows, columns=["site", "pgv_cm_s", "maf"])
    curves = {name: uplift.HazardCurve(rows.pgv_cm_s, rows.maf) for name, rows in table.groupby("site")}
    u_m = spectra_of(list(curves.values()))
    assert u_m.shape == (100, 3, 2)
    index = pandas.MultiIndex.from_product([list(curves), [0.02, 0.1, 0.5]], names=["site", "poe"])
    spectra = pandas.DataFrame(u_m.reshape(300, 2), index=index, columns=[0.02, 0.1])
    assert spectra.loc[("site 099", 0.02), 0.02] >= spectra.loc[("site 000", 0.02), 0.02] > 0


def curves_of(poes, levels, measure="pgv"):
    """Curves of annual rates from OpenQuake's probabilities, `[site, level]`; those of 1 and 0 have no rate."""
    curves = []
    for poe in np.asarray(poes, float):
        known = (poe > 0) & (poe < 1)
        curves.append(uplift.HazardCurve(levels[known], -np.log1p(-poe[known]) / YEARS, measure=measure))
    return curves


def test_arrays_as_a_datastore_of_openquake_has_them(tmp_path):
    """In the layout of a calculation's file, without OpenQuake."""
    levels = np.geomspace(0.1, 300, 12)
    poes = -np.expm1(-YEARS * 0.3 * np.array([[1.0], [1.3]]) * levels**-2.0)
    with h5py.File(tmp_path / "calc_1.hdf5", "w") as file:
        # site, statistic, measure, level; in single precision
        file["hcurves-stats"] = poes.astype(np.float32)[:, None, None, :]
    with h5py.File(tmp_path / "calc_1.hdf5", "r") as file:
        read = file["hcurves-stats"][:, 0, 0, :]
    curves = curves_of(read, levels)
    np.testing.assert_allclose(curves[0].maf_per_year, 0.3 * curves[0].im**-2.0, rtol=1e-3)
    assert spectra_of(curves).shape == (2, 3, 2)


def test_a_calculation_of_openquake(openquake, tmp_path):
    """Calculated, exported and read by OpenQuake itself, its arrays and its export handed over and compared."""
    program = [sys.executable, Path(__file__).with_name("openquake_handover.py"), tmp_path]
    done = subprocess.run(program, env=openquake, capture_output=True, text=True, timeout=LIMIT_S)
    assert done.returncode == 0, done.stderr
