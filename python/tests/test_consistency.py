"""Consistency in memory is that of the result file, to the bit, with its weights and spectra."""

import h5py
import numpy as np
import pytest

import uplift_urs as uplift

STUDY = {
    "records": {"synthetic": {"pairs": 40}},
    "strengths": {"values": [0.05, 0.1, 0.2, 0.4]},
    "pgv": {"levels_cm_s": [0.5, 1, 2, 4, 8, 15, 30, 60, 120]},
    "pga": {"levels_g": [0.01, 0.02, 0.04, 0.08, 0.15, 0.3, 0.6, 1.2]},
    "risk": {"maf_surface": False},
    "regression": {"strength_above": 0},
    "consistency": {"repair": "weights"},
}


@pytest.fixture(scope="module")
def result(program, tmp_path_factory):
    at = tmp_path_factory.mktemp("consistency")
    found = uplift.run(STUDY, output=at / "plain.h5")
    ratio = np.exp(np.log(found.records.pga_g.values / found.records.pgv_cm_s.values).mean())
    pgv = np.array([0.05 * 1.3**step for step in range(40)])
    for name, im in (("pgv", pgv), ("pga", pgv * ratio * 1.15)):
        maf = 0.2 * (pgv / 0.5) ** -2.0
        rows = (f"{level!r},{rate!r}\n" for level, rate in zip(im.tolist(), maf.tolist()))
        (at / f"{name}.csv").write_text("iml,maf\n" + "".join(rows))
    sites = [{"name": "Here", "pgv": str(at / "pgv.csv"), "pga": str(at / "pga.csv")}]
    result = uplift.run(STUDY | {"sites": sites}, output=at / "repaired.h5")
    result.compute_consistency(repair=True, keep_weights=True)
    return result


def test_weights_and_spectra_of_the_program(result):
    records, own = result.records, result.consistency
    of = lambda name, unit: uplift.HazardCurve.read(result.path.with_name(f"{name}.csv"), measure=name, unit=unit)
    levels = result.ida.pgv_level.values
    found = uplift.consistency(
        records.pgv_cm_s.values, records.pga_g.values, levels, of("pgv", "cm/s"), of("pga", "g"), repair=True
    )
    assert found.verdict is not None and found.repaired is not None, found.no_repair
    assert found.repaired.verdict == "consistent" and found.no_repair is None
    for ours, theirs in (("bias", "pga_bias"), ("rms", "pga_rms"), ("max", "pga_max")):
        assert getattr(found, ours) == own[theirs].values[0], ours
    np.testing.assert_array_equal(found.implied_level, own.pga_implied.values[0])
    np.testing.assert_array_equal(found.repaired.implied_level, own.pga_repaired.values[0])
    np.testing.assert_array_equal(found.ratio, own.pga_ratio.values[0])
    np.testing.assert_array_equal(found.repaired.weights, own.weight.values[0])
    np.testing.assert_array_equal(found.repaired.exponents, own.exponent.values[0])
    np.testing.assert_array_equal(found.repaired.effective_records, own.effective_records.values[0])
    spectra = uplift.urs(result.ida.edp_m.values, levels, of("pgv", "cm/s"), weights=found.repaired.weights)
    np.testing.assert_array_equal(spectra.u_m, own.u_m.values[0], strict=True)
    plain = uplift.urs(result.ida.edp_m.values, levels, of("pgv", "cm/s"), weights=found.weights)
    np.testing.assert_allclose(plain.u_m, result.urs.u_m.values[0], rtol=1e-12)
    assert not np.array_equal(plain.u_m, spectra.u_m)


def test_what_cannot_be_repaired_is_told():
    hazard = uplift.HazardCurve([0.5, 2, 10, 100], [0.5, 0.01, 1e-4, 1e-7])
    pga = uplift.HazardCurve([0.005, 0.02, 0.1, 1.0], [0.5, 0.01, 1e-4, 1e-7], measure="pga")
    none = uplift.consistency([1.0] * 5, [0.05] * 5, [1, 3, 5, 40], hazard, pga, [0.3, 0.03], repair=True)
    assert none.repaired is None and "add records with PGA below" in none.no_repair
    assert none.verdict == "inconsistent" and none.bias > 2
    with pytest.raises(ValueError, match="one for each record"):
        uplift.consistency([1.0], [0.05, 1], [1, 3], hazard, pga)
    with pytest.raises(ValueError, match="shape"):
        uplift.urs([[0.1, 0.2]], [1, 3], hazard, weights=[[1.0]])
