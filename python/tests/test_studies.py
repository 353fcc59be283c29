"""Studies run from Python are those of the program, and results come back as they stand in the file."""

import json
import os
import signal
import subprocess
import sys
import time
import tracemalloc

import h5py
import numpy as np
import pytest
import xarray
from test_program import NEAR

import uplift_urs as uplift

STUDY = {
    "title": "small",
    "records": {"first": 6},
    "strengths": {"values": [0.05, 0.1, 0.2, 0.4]},
    "pgv": {"levels_cm_s": [1, 5, 10, 20, 40, 80]},
    "pga": {"levels_g": [0.02, 0.1, 0.3, 1.0]},
    "sites": [{"name": name, "pgv": "here.csv", "pga": "pga.csv"} for name in ("Here", "Thérè")],
}


@pytest.fixture(scope="module")
def folder(program, tmp_path_factory):
    at = tmp_path_factory.mktemp("studies")
    (at / "here.csv").write_text(NEAR)
    (at / "pga.csv").write_text("pga_g,maf\n0.001,1.5\n0.01,0.4\n0.1,0.01\n1,1e-5\n3,1e-7\n")
    (at / "study.toml").write_text(uplift._toml.document(STUDY))
    return at


@pytest.fixture(scope="module")
def result(folder):
    return uplift.run(folder / "study.toml", output=folder / "result.h5")


@pytest.fixture
def here(folder, monkeypatch):
    monkeypatch.chdir(folder)
    return folder


def test_a_study_and_its_dict_are_the_run_of_the_program(here, program, result):
    program(here, "run", "study.toml", "-o", "program.h5", "--set", "records.first=5")
    of_file = uplift.run("study.toml", output="file.h5", records={"first": 5})
    of_dict = uplift.run(STUDY, output="dict.h5", **{"records.first": 5})
    for name in ("ida/pgv/edp_m", "ida/pga/edp_m", "urs/pgv/u_m", "urs/pgv/flag", "regression/pgv/c0_m"):
        with h5py.File("program.h5") as file:
            expected = file[name][()]
        for ours in (of_file, of_dict):
            group, array = name.rsplit("/", 1)
            np.testing.assert_array_equal(ours[group][array].values, expected, strict=True)
    assert of_file.ida.sizes == {"record": 5, "strength": 4, "pgv_level": 6}
    assert result.ida.sizes["record"] == 6
    # the study is kept with the result, and is the same however it was given
    assert of_dict.attributes["title"] == "small"
    plan = uplift.check(STUDY)
    assert plan["analyses"] == 6 * 4 * (6 + 4)


def test_displacements_are_those_of_the_spectrum(here, program, result):
    rows = result.displacement(strength=0.13, return_period=475)
    assert [row["site"] for row in rows] == ["Here", "Thérè"]
    for row in rows:
        assert row["strength"] == 0.13
        assert row["return_period_years"] == pytest.approx(475)
        assert row["poe"] == pytest.approx(-np.expm1(-row["years"] / 475))
        lower, upper = row["band_m"]
        assert 0 < lower <= row["u_m"] <= upper
    told = program(here, "spectrum", "result.h5", "--strength", "0.13", "--return-period", "475", "--json")
    assert rows == json.loads(told)["displacements"]


def test_values_of_python_are_those_of_the_study(here):
    changed = uplift.run(
        "study.toml", output="changed.h5", strengths={"values": np.array([0.1, 0.3])}, risk={"poe": (0.1, 0.02)},
        oscillator={"free_vibration": False, "restitution": np.float64(0.9)}, title='a "quoted" \\ title\n\u00e9',
    )  # fmt: skip
    assert changed.attributes["title"] == 'a "quoted" \\ title\n\u00e9'
    assert changed.urs.strength.values.tolist() == [0.1, 0.3]
    assert sorted(changed.urs.poe.values) == [0.02, 0.1]
    assert "restitution = 0.9\n" in changed.attributes["study_toml"]
    with pytest.raises(TypeError, match="NoneType"):
        uplift.run("study.toml", title=None)


def test_datasets_are_those_of_the_file(result):
    for group in result.groups:
        ours = result[group]
        theirs = xarray.open_dataset(result.path, group=group, engine="h5netcdf", decode_timedelta=False)
        assert set(ours.variables) == set(theirs.variables), group
        for name, variable in theirs.variables.items():
            assert ours[name].dims == variable.dims, (group, name)
            np.testing.assert_array_equal(ours[name].values, variable.values)
            assert ours[name].attrs.get("units") == variable.attrs.get("units")
            assert ours[name].attrs["long_name"] == variable.attrs["long_name"]
        assert set(ours.attrs) == set(theirs.attrs), group
        theirs.close()
    assert result.urs.u_m.sel(site="Thérè", poe=0.02).shape == (4,)
    assert result.of("pga").ida.edp_m.shape == (6, 4, 4)
    assert list(result.hazard) == result.sites == ["Here", "Thérè"]
    assert result.ida.edp_m[2:4, [0, 2], ::2].values.shape == (2, 2, 3)


def test_tables(result):
    table, csv = result.to_pandas(), (result.path.with_suffix(".urs.csv")).read_text().splitlines()
    rows = [line.split(",") for line in csv[1:] if ",PGV," in line]
    place = csv[0].split(",").index("u_m")
    assert table.u_m.tolist() == [float(row[place]) for row in rows]
    assert result.to_polars()["site"].to_list() == [row[0] for row in rows]
    records = result.to_pandas("records")
    assert len(records) == 6 and records.record.tolist() == result.records.record.values.tolist()


def test_without_xarray_there_are_arrays(result, monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    monkeypatch.delitem(sys.modules, "uplift_urs._lazy", raising=False)
    monkeypatch.delattr(uplift, "_lazy", raising=False)
    plain = result.urs
    assert isinstance(plain, uplift.Arrays)
    with h5py.File(result.path) as file:
        np.testing.assert_array_equal(plain["u_m"], file["urs/pgv/u_m"][()], strict=True)
        assert plain["site"].tolist() == ["Here", "Thérè"]
    assert plain.dims["u_m"] == ("site", "poe", "strength") and plain.units["u_m"] == "m"
    assert set(plain) == {"site", "poe", "strength", "u_m", "flag", "lower_tail_share", "upper_tail_share"}
    monkeypatch.setitem(sys.modules, "h5py", None)
    with pytest.raises(ImportError, match="pip install h5py"):
        uplift.open_result(result.path)
    with pytest.raises(ImportError, match="pip install h5py"):
        uplift.run("absent.toml")


def test_the_peaks_are_read_without_a_copy(folder):
    values = np.random.default_rng(1).random((400, 100, 26))
    path = folder / "large.h5"
    with h5py.File(path, "w") as file:
        file.attrs["program"] = "uplift"
        axes = {"record": 400, "strength": 100, "pgv_level": 26}
        for name, size in axes.items():
            file[f"axes/{name}"] = np.arange(float(size))
            file[f"axes/{name}"].make_scale(name)
        peaks = file.create_dataset("ida/pgv/edp_m", data=values, chunks=(10, 100, 26), compression=1, shuffle=True)
        for place, name in enumerate(axes):
            peaks.dims[place].label = name
            peaks.dims[place].attach_scale(file[f"axes/{name}"])
    opened = uplift.open_result(path, verify=False)
    tracemalloc.start()
    read = opened.ida.edp_m.values
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    np.testing.assert_array_equal(read, values)
    assert values.nbytes <= peak < 1.3 * values.nbytes


def test_what_changes_under_a_dataset_is_told(folder):
    uplift.run(folder / "study.toml", output=folder / "again.h5")
    spectra = uplift.open_result(folder / "again.h5").urs
    with pytest.raises(uplift.StudyError, match=r"another name \(output=\), or force=True"):
        uplift.run(folder / "study.toml", output=folder / "again.h5", oscillator={"restitution": 0.5})
    uplift.run(folder / "study.toml", output=folder / "again.h5", force=True, oscillator={"restitution": 0.5})
    with pytest.raises(OSError, match="open the result again"):
        spectra.u_m.values.sum()


def test_commands_add_to_the_result(folder, program):
    result = uplift.run(folder / "study.toml", output=folder / "added.h5")
    with pytest.raises(ValueError, match=r"compute_bootstrap\(\) adds it"):
        result.bootstrap
    events = []
    rows = result.compute_bootstrap(sizes=[3, 6], replicates=50, seed=3, interval="bca", progress=events.append)
    assert {row["sample_size"] for row in rows} == {3, 6}
    assert [event.kind for event in events].count("end") >= 1
    assert result.bootstrap.u50_m.dims == ("site", "poe", "sample_size", "strength")
    assert "bootstrap/pgv" in result.groups
    result.compute_influence()
    assert (result.disaggregation.share.sum("pgv_bin") - 1 < 1e-12).all() and "record" in result.influence.dims
    result.compute_measures()
    assert result.sufficiency and "strength" in result.efficiency.dims
    result.export("xlsx", "csv", return_period=[475, 2475.5])
    assert result.path.with_suffix(".xlsx").is_file() and result.path.with_suffix(".spectra.csv").is_file()
    result.report(folder / "page.html")
    assert "<html" in (folder / "page.html").read_text()
    result.verify()
    damaged = folder / "damaged.h5"
    data = bytearray(result.path.read_bytes())
    data[len(data) // 2] ^= 1
    damaged.write_bytes(data)
    with pytest.raises(ValueError, match="damaged"):
        uplift.open_result(damaged, verify=False).verify()


def test_no_byte_that_changed_is_read(folder, result):
    whole = result.path.read_bytes()
    copy = folder / "copy.h5"
    copy.write_bytes(whole)
    opened = uplift.open_result(copy)
    spectra = opened.urs
    for place in (100, len(whole) // 2, len(whole) - 200, len(whole) - 70):
        copy.write_bytes(whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :])
        for read in (lambda: uplift.open_result(copy), lambda: opened.urs, lambda: spectra.u_m.values):
            with pytest.raises(OSError, match="has changed|checksum at its end is missing"):
                read()
    for part in (whole[:-1], whole[: len(whole) // 2], whole[:20]):
        copy.write_bytes(part)
        with pytest.raises(OSError, match="checksum at its end is missing"):
            uplift.open_result(copy)
    copy.write_bytes(b"")
    with pytest.raises(OSError, match="not an HDF5 file"):
        uplift.open_result(copy)
    copy.write_bytes(whole)
    assert uplift.open_result(copy).urs.u_m.equals(result.urs.u_m)
    assert opened.of("pga").urs.u_m.equals(result.of("pga").urs.u_m)


def test_nothing_hangs_on_a_file(folder, result):
    # a heap of texts whose first object is none, and of no length: HDF5 looks for the next one for ever
    damaged = bytearray(result.path.read_bytes())
    heap = damaged.index(b"GCOL")
    damaged[heap + 16 : heap + 32] = bytes(16)
    (folder / "heap.h5").write_bytes(damaged)
    os.mkfifo(folder / "pipe.h5")
    for name, words in (("heap.h5", "has changed since"), ("pipe.h5", "is not a file")):
        code = f"import uplift_urs; uplift_urs.open_result({str(folder / name)!r})"
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, cwd=folder)
        assert done.returncode == 1 and words in done.stderr, done.stderr


def test_figures_and_pages_for_notebooks(result):
    figure = result.plot("urs")
    assert figure._repr_svg_().startswith("<svg") or figure.svg.lstrip().startswith("<?xml")
    assert set(result.figures("urs")) == {"urs-sites", "urs-pgv", "urs-pga"}
    assert result.of("pga").plot().svg != figure.svg
    assert "<table>" in result._repr_html_() and "small" in result._repr_html_()
    with pytest.raises(ValueError, match="nothing"):
        result.plot("nothing")
    assert "6 synthetic pairs" in repr(result)


def test_mistakes_come_all_at_once(here):
    with pytest.raises(uplift.StudyError, match="2 mistakes") as raised:
        uplift.run("study.toml", records={"first": -3}, risk={"poe": [2]})
    assert isinstance(raised.value, ValueError)
    assert [mistake.key for mistake in raised.value.mistakes] == ["records.first", "risk.poe[0]"]
    assert raised.value.mistakes[0].override == "records.first=-3"
    assert "1 or above" in str(raised.value)
    with pytest.raises(ValueError, match="threads"):
        uplift.run("study.toml", threads=0)
    with pytest.raises(FileNotFoundError):
        uplift.run("absent.toml")
    with pytest.raises(ValueError, match="pgv"):
        uplift.run({"pgv": {"x": 1}})
    with pytest.raises(OSError):
        uplift.open_result("absent.h5")
    with h5py.File("other.h5", "w"):
        pass
    with pytest.raises(OSError, match="checksum at its end is missing"):
        uplift.open_result("other.h5")
    with pytest.raises(ValueError, match="not a result"):
        uplift.open_result("other.h5", verify=False)
    with pytest.raises(ValueError, match="measure"):
        uplift.open_result("result.h5", measure="sa_1s")


LONG = {"records": {"first": 60}, "strengths": {"values": "0:1/300:1"}, "sites": []}


def test_progress_and_cancellation(here):
    events = []

    def stop(event):
        events.append(event)
        return sum(one.kind == "advance" for one in events) < 3

    with pytest.raises(uplift.Cancelled, match="checkpoint"):
        uplift.run("study.toml", output="long.h5", progress=stop, **LONG)
    begin = next(event for event in events if event.kind == "begin")
    assert begin.label == "PGV" and begin.unit == "analyses" and begin.total == 60 * 301 * 6
    done = [event.done for event in events if event.kind == "advance"]
    assert done == sorted(done) and 0 < done[-1] < begin.total
    assert not os.path.exists("long.h5") and os.path.exists("long.h5.part")

    def fail(event):
        raise ZeroDivisionError("of the callback")

    with pytest.raises(ZeroDivisionError, match="of the callback"):
        uplift.run("study.toml", output="long.h5", progress=fail, **LONG)
    # the same call goes on
    more = []
    with pytest.raises(uplift.Cancelled):
        uplift.run("study.toml", output="long.h5", progress=lambda event: more.append(event) or event.done == 0, **LONG)
    assert next(event.done for event in more if event.kind in ("advance", "end")) >= 0


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize("to_group", [True, False], ids=["as a terminal does", "to Python alone"])
def test_ctrl_c_stops_and_keeps(here, to_group):
    code = f"""
import uplift_urs as uplift
try:
    uplift.run("study.toml", output="stopped-{to_group}.h5", progress=lambda event: print(event.kind, flush=True),
               **{LONG!r})
except KeyboardInterrupt as stopped:
    print("stopped:", stopped)
"""
    child = subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, start_new_session=True, cwd=here
    )
    for line in child.stdout:
        if line == "advance\n":
            break
    start = time.monotonic()
    (os.killpg if to_group else os.kill)(child.pid, signal.SIGINT)
    rest = child.stdout.read()
    assert child.wait() == 0, rest
    assert "stopped: interrupted" in rest and "checkpoint" in rest
    assert time.monotonic() - start < 20  # it comes to an end by itself


def test_the_program_is_found_or_asked_for(monkeypatch, tmp_path, program):
    monkeypatch.setenv("UPLIFT_PROGRAM", str(tmp_path / "none"))
    with pytest.raises(FileNotFoundError, match="UPLIFT_PROGRAM"):
        uplift.find_program()
    monkeypatch.delenv("UPLIFT_PROGRAM")
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr("sysconfig.get_path", lambda *_: str(tmp_path))
    with pytest.raises(FileNotFoundError, match="make build"):
        uplift.find_program()
    own = tmp_path / "uplift"
    own.write_text("#!/bin/sh\necho killed >&2\nkill -9 $$\n")
    own.chmod(0o755)
    assert uplift.find_program() == own.resolve()
    with pytest.raises(RuntimeError, match="signal 9: killed"):
        uplift.run({})


def test_the_module_is_the_program(program, tmp_path):
    # from another folder: here are the sources of the package, without its extension
    command = [sys.executable, "-m", "uplift_urs", "--version"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0 and done.stdout.startswith("uplift ")
