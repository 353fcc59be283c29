"""Cases in 50-digit arithmetic: those of the solver's own tests."""

import json
import math

import pytest
from conftest import REPOSITORY

import uplift_urs as uplift

CASES = json.loads((REPOSITORY / "crates/oscillator/tests/data/nsbe_cases.json").read_text())


@pytest.mark.parametrize("case", CASES["cases"], ids=lambda case: case["id"])
def test_case(case):
    record = uplift.Record.from_array(CASES["records"][case["record"]], dt_s=case["dt"], unit="m/s2")
    oscillator = {
        "uplift_displacement_m": case["u_up"],
        "capacity_m": case["u_cap"],
        "restitution": case["r_c"],
        "gravity_m_s2": case["g"],
        "free_vibration_s": case["t_free"],
        "scale": case["scale"],
    }
    found, expected = uplift.respond(record, case["eta"], **oscillator), case["expected"]
    assert found.overturned == expected["collapsed"]
    assert (found.status == "overturned") == expected["collapsed"]
    if expected["collapsed"]:
        assert found.peak_displacement_m == math.inf
    else:
        assert found.peak_displacement_m == pytest.approx(expected["u_max"], rel=case["suggested_rel_tol"], abs=0)
    if case["n_impacts_comparable"]:
        assert (found.impacts, found.uplifts) == (expected["n_impacts"], expected["n_uplifts"])
