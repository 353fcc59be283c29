"""What other packages have, handed over: streams of ObsPy, OpenQuake's datastore, tables of pandas."""

import h5py
import numpy as np
import pandas
import pytest

import uplift_urs as uplift

YEARS = 50.0


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


def spectra_of(curves):
    record = uplift.Record.from_array(np.sin(np.arange(400) / 8.0), dt_s=0.02, unit="m/s2")
    levels = [1.0, 3.0, 10.0, 30.0, 100.0]
    edp_m = uplift.ida([record] * 3, [0.02, 0.1], levels)
    return uplift.urs(edp_m, levels, curves, extrapolate="loglog").u_m


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


def curves_of(poes, levels):
    """Curves of annual rates from OpenQuake's probabilities, `[site, level]`; those of 1 and 0 have no rate."""
    curves = []
    for poe in poes:
        known = (poe > 0) & (poe < 1)
        curves.append(uplift.HazardCurve(levels[known], -np.log1p(-poe[known]) / YEARS))
    return curves


def test_arrays_as_a_datastore_of_openquake_has_them(tmp_path):
    """In the layout of a calculation's file, read by OpenQuake's own class where that is installed, else as HDF5."""
    levels = np.geomspace(0.1, 300, 12)
    poes = -np.expm1(-YEARS * 0.3 * np.array([[1.0], [1.3]]) * levels**-2.0)
    with h5py.File(tmp_path / "calc_1.hdf5", "w") as file:
        # site, statistic, measure, level; in single precision
        file["hcurves-stats"] = poes.astype(np.float32)[:, None, None, :]
    try:
        from openquake.baselib.hdf5 import File
    except ImportError:
        from h5py import File
    with File(str(tmp_path / "calc_1.hdf5"), "r") as file:
        read = file["hcurves-stats"][:, 0, 0, :].astype(float)
    curves = curves_of(read, levels)
    np.testing.assert_allclose(curves[0].maf_per_year, 0.3 * curves[0].im**-2.0, rtol=1e-3)
    assert spectra_of(curves).shape == (2, 3, 2)
