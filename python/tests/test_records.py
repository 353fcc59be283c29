"""Records: files of every format, arrays of every kind."""

import gzip

import numpy as np
import pytest
from conftest import REPOSITORY, noise

import uplift_urs as uplift

SAMPLES = REPOSITORY / "crates/motion/tests/samples"


def test_from_array_in_every_unit():
    by_hand = {"m/s2": [0.0, 3.0, -6.0], "cm/s2": [0.0, 300.0, -600.0], "g": [0.0, 0.3, -0.6]}
    for unit, values in by_hand.items():
        record = uplift.Record.from_array(values, dt_s=0.5, unit=unit, gravity_m_s2=10)
        np.testing.assert_allclose(record.acceleration_m_s2, [0, 3, -6], rtol=1e-15)
        # velocities 0, 0.75, 0 m/s by the trapezoid rule
        assert (record.pga_g, record.dt_s, record.duration_s, len(record)) == (0.6, 0.5, 1.0, 3)
        assert record.pgv_cm_s == pytest.approx(75, rel=1e-15)
        assert record.measure("pga") == record.pga_g
        np.testing.assert_array_equal(record.time_s, [0, 0.5, 1])


@pytest.mark.parametrize("dtype", ["f2", "f4", ">f8", "i2", "u1", "longdouble"])
def test_dtypes_strides_and_read_only_arrays(dtype):
    values = np.array([0, 1, 2, 3, 4, 5, 0], dtype=dtype)
    expected = values.astype(float)
    views = {"plain": values, "reversed": values[::-1], "every other": values[::2], "list": values.tolist()}
    views["field"] = np.zeros(7, [("x", "u1"), ("a", values.dtype)])["a"]
    views["field"][...] = values
    for name, view in views.items():
        if isinstance(view, np.ndarray):
            view.setflags(write=False)
        record = uplift.Record.from_array(view, dt_s=0.01, unit="m/s2")
        np.testing.assert_array_equal(record.acceleration_m_s2, np.array(view, float), err_msg=name)
    assert expected.sum() == 15


def test_a_record_does_not_change_with_the_array():
    values = noise(1, 100)
    record = uplift.Record.from_array(values, dt_s=0.01, unit="m/s2")
    before = values.copy()
    values[:] = 0
    record.acceleration_m_s2[:] = 0
    np.testing.assert_array_equal(record.acceleration_m_s2, before)
    with pytest.raises(AttributeError):
        record.dt_s = 1


@pytest.mark.parametrize(
    ("values", "dt_s", "unit", "words"),
    [
        ([1.0], 0.01, "g", "at least 2"),
        ([], 0.01, "g", "at least 2"),
        ([0, np.nan], 0.01, "g", "sample 1"),
        ([0, np.inf], 0.01, "g", "sample 1"),
        ([0, 1], 0, "g", "dt_s is 0"),
        ([0, 1], 5, "ft/s2", "ft/s2"),
        ([0, 1e6], 0.01, "g", "acceleration"),
        ([[0, 1], [2, 3]], 0.01, "g", "one dimension"),
    ],
)
def test_what_is_no_record(values, dt_s, unit, words):
    with pytest.raises(ValueError, match=words):
        uplift.Record.from_array(values, dt_s=dt_s, unit=unit)


@pytest.mark.parametrize(
    ("file", "components"), [("sample.esm", 1), ("sample.knet", 1), ("sample.cosmos", 2), ("sample.csmip", 2)]
)
def test_files_of_formats(file, components):
    records = uplift.read_records(SAMPLES / file)
    assert len(records) == components
    for number, record in enumerate(records, 1):
        again = uplift.read_record(str(SAMPLES / file), channel=number)
        np.testing.assert_array_equal(again.acceleration_m_s2, record.acceleration_m_s2)
        assert record.pga_g > 0 and record.description
    if components > 1:
        with pytest.raises(ValueError, match="channel"):
            uplift.read_record(SAMPLES / file)


def test_text_and_gzip(tmp_path):
    file = tmp_path / "own.txt"
    file.write_text("0.0\n0.1\n-0.2\n")
    with pytest.raises(ValueError, match="time step"):
        uplift.read_record(file, unit="g")
    with pytest.raises(ValueError, match="unit"):
        uplift.read_record(file, dt_s=0.01)
    plain = uplift.read_record(file, unit="g", dt_s=0.01)
    packed = tmp_path / "own.txt.gz"
    packed.write_bytes(gzip.compress(file.read_bytes()))
    np.testing.assert_array_equal(
        uplift.read_record(packed, unit="g", dt_s=0.01).acceleration_m_s2, plain.acceleration_m_s2
    )
    assert plain.pga_g == 0.2
    with pytest.raises(ValueError, match="record format"):
        uplift.read_record(file, format="smc")


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(FileNotFoundError, match="nowhere.AT2"):
        uplift.read_record(tmp_path / "nowhere.AT2")
    with pytest.raises(OSError):
        uplift.read_record(tmp_path)
    damaged = tmp_path / "damaged.AT2"
    damaged.write_text("PEER\nA\nACCELERATION IN UNITS OF G\nNPTS= 5, DT= .0100 SEC\n 0.1 0.2 0.3\n")
    with pytest.raises(ValueError, match="damaged.AT2.*5 points.*3"):
        uplift.read_record(damaged)
