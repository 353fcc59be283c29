"""Fragilities for other programs, read and used by these: OpenQuake and pelicun."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas
import pytest

import uplift_urs as uplift
from conftest import skip_or_fail

TESTS = Path(__file__).parent
PELICUN = TESTS.parent / "target" / "pelicun"
LIMIT_S = 240
STUDY = """title = "small"
[records.synthetic]
pairs = 20
[strengths]
values = [0.1, 0.2]
[pgv]
levels_cm_s = [1, 3, 10, 30, 60, 100]
[regression]
strength_above = 0
[[sites]]
name = "Here"
pgv = "pgv.csv"
"""


@pytest.fixture(scope="module")
def result(program, tmp_path_factory):
    """A folder with a result `r.h5`."""
    folder = tmp_path_factory.mktemp("fragility")
    (folder / "study.toml").write_text(STUDY, encoding="utf-8")
    (folder / "pgv.csv").write_text("iml,maf\n0.5,0.8\n2,0.05\n20,5e-4\n300,2.2e-6\n", encoding="utf-8")
    (folder / "block.toml").write_text('kind = "block"\nwidth_m = 0.4\nheight_m = 3\nmass_kg = 1000\n')
    program(folder, "run", "study.toml", "-o", "r.h5", "-q")
    return folder


def test_the_curves_are_the_counts_of_the_result(program, result):
    h5py = pytest.importorskip("h5py")
    asked = ["--displacement-m", "0.02,0.1", "--strength", "0.1,0.2"]
    program(result, "export", "r.h5", "--fragility", "csv", *asked, "-q")
    table = pandas.read_csv(result / "r.fragility.csv")
    with h5py.File(result / "r.h5") as file:
        edp_m = file["/ida/pgv/edp_m"][:]  # record, strength, level
    for strength, name in enumerate(["strength_0p1_pgv", "strength_0p2_pgv"]):
        for state, displacement_m in [("u_20mm", 0.02), ("u_100mm", 0.1)]:
            rows = table[(table.id == name) & (table.limit_state == state)]
            np.testing.assert_array_equal(rows.exceeding, (edp_m[:, strength] > displacement_m).sum(axis=0))
            np.testing.assert_array_equal(rows.share, rows.exceeding / rows.records)
    fits = pandas.read_csv(result / "r.fragility.fits.csv")
    assert len(fits) == 4
    normal = pytest.importorskip("scipy.stats").norm
    for fit in fits.itertuples():
        rows = table[(table.id == fit.id) & (table.limit_state == fit.limit_state)]
        if np.isfinite(fit.theta):
            expected = normal.cdf(np.log(rows.level / fit.theta) / fit.beta)
            np.testing.assert_allclose(rows.lognormal, expected, atol=1e-12)
            assert np.abs(rows.lognormal - rows.share).max() == pytest.approx(fit.largest_error, abs=1e-12)
        if np.isfinite(fit.theta_beyond):
            factors = [
                normal.cdf(np.log(rows.level / theta) / beta)
                for theta, beta in [(fit.theta_uplift, fit.beta_uplift), (fit.theta_beyond, fit.beta_beyond)]
            ]
            np.testing.assert_allclose(rows.zero_inflated, factors[0] * factors[1], atol=1e-12)
    assert np.isfinite(fits.theta).any() and np.isfinite(fits.theta_beyond).any(), fits
    assert np.isfinite(fits.log_theta_standard_error).any(), fits


def test_openquake_reads_the_model_and_its_damage_is_our_risk(program, openquake, tmp_path):
    found = os.environ.get("UPLIFT_PROGRAM") or str(uplift.find_program())
    command = [sys.executable, TESTS / "openquake_damage.py", tmp_path, found]
    done = subprocess.run(command, env=openquake, capture_output=True, text=True, timeout=LIMIT_S)
    assert done.returncode == 0, done.stderr


def pelicun_damage(folder, table, asked):
    """What pelicun computes of a fragility table in `folder`, see pelicun_damage.py."""
    if not (PELICUN / "pelicun").is_dir():
        install = "pip install --no-deps --target python/target/pelicun -r python/tests/requirements-pelicun.txt"
        skip_or_fail("pelicun", install)
    done = subprocess.run(
        [sys.executable, TESTS / "pelicun_damage.py", folder / table],
        input=json.dumps(asked),
        env=os.environ | {"PYTHONPATH": str(PELICUN)},
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=LIMIT_S,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_pelicun_loads_the_table_and_its_damage_is_our_curve(program, result):
    for form in ("csv", "pelicun"):
        program(result, "export", "r.h5", "--fragility", form, "--structure", "block.toml", "--force", "-q")
    table = pandas.read_csv(result / "r.fragility.csv")
    levels = sorted(set(table.level))
    found = pelicun_damage(result, "r.pelicun.csv", {"cm_s": levels, "samples": 4000})
    assert {"block_oscillator_pgv", "block_block_pgv"} <= set(found), found
    for component, shares in found.items():
        curves = table[table.id == component.removesuffix("_lognormal")]
        states = list(dict.fromkeys(curves.limit_state))
        assert states == ["uplift", "capacity_50pct", "capacity", "overturning"]
        column = "lognormal" if component.endswith("_lognormal") else "share"
        for place, state in enumerate(states):
            expected = curves[curves.limit_state == state][column].to_numpy()
            # pelicun takes curves that rise
            if column == "share" and (np.diff(expected) < 0).any():
                continue
            # stratified samples of one capacity are nearly exact, and all limit states share it
            np.testing.assert_allclose(np.array(shares)[:, place], expected, atol=0.03, err_msg=f"{component} {state}")


def test_pelicun_loads_a_library_and_its_damage_is_the_share_of_motions(program, tmp_path):
    (tmp_path / "library.toml").write_text(
        "[block]\nsize_m = 1\nslenderness_rad = 0.15\n[levels]\npga = [0.5, 2, 4]\npgv = [0.2, 0.4, 0.8]\n"
        "[records.synthetic]\npairs = 10\n"
    )
    program(tmp_path, "library", "library.toml", "-o", "out", "-q")
    levels = pandas.read_csv(tmp_path / "out" / "levels.csv").query("im == 'pgv'")
    table = pandas.read_csv(tmp_path / "out" / "pelicun.csv", index_col="ID")
    [component] = [name for name in table.index if name.endswith("_pgv")]
    # p PGV/(g tan α) = 1 in cm/s
    unit = 100 * levels.uplift_acceleration_g.iloc[0] * 9.80665 / levels.p_rad_s.iloc[0]
    asked = {"cm_s": list(unit * levels.level), "samples": 4000, "components": [component]}
    found = np.array(pelicun_damage(tmp_path / "out", "pelicun.csv", asked)[component])
    expected = levels[["share_rocking", "share_overturning"]].to_numpy()
    assert 0 < expected[1, 0] < 1, expected
    np.testing.assert_allclose(found, expected, atol=0.03)


def test_pelicun_loads_the_demands_and_finds_the_records_that_exceed_a_joint(program, result):
    h5py = pytest.importorskip("h5py")
    # 1e-3 a year lies between 2 and 20 cm/s of the curve
    program(result, "export", "r.h5", "--demand", "Here", "--return-period", "1000", "--strength", "0.1,0.2", "-q")
    demands = pandas.read_csv(result / "r.demand.csv", index_col="record")
    level = float(demands["1-PGV-0-1"].iloc[1])
    assert level == pytest.approx(2 * 10 ** (np.log(50) / np.log(100)), rel=1e-12)
    with h5py.File(result / "r.h5") as file:
        edp_m = file["/ida/pgv/edp_m"][:]  # record, strength, level
    levels = [1, 3, 10, 30, 60, 100]
    for strength, location in enumerate(["1", "2"]):
        expected_m = [np.interp(level, levels, curve) for curve in edp_m[:, strength]]
        found_m = demands[f"1-DEC-{location}-1"]
        assert found_m["Units"] == "m"
        np.testing.assert_allclose(found_m.iloc[1:].astype(float), expected_m, rtol=1e-12)
        # a joint that every displacement above the third largest breaks
        threshold_m = np.sort(expected_m)[-3:-1].mean()
        (result / "joint.csv").write_text(
            "ID,Incomplete,Demand-Type,Demand-Unit,Demand-Offset,Demand-Directional,LS1-Family,LS1-Theta_0,LS1-Theta_1,"
            f"LS1-DamageStateWeights\njoint,0,Peak Deck Displacement,m,0,1,,{threshold_m},,\n"
        )
        found = pelicun_damage(result, "joint.csv", {"demands": "r.demand.csv", "location": location})
        assert found == {"joint": [[2 / 20]]}
