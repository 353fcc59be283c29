"""Structures, blocks and frames: the numbers of the program, and of the dissertation."""

import json

import numpy as np
import pytest
from conftest import REPOSITORY

import uplift_urs as uplift

STRUCTURES = REPOSITORY / "configs" / "structures"


@pytest.fixture(scope="module")
def downloads(program, tmp_path_factory):
    at = tmp_path_factory.mktemp("records")
    program(at, "records", "synthesize", "-o", ".", "--count", "3")
    return at


def test_keys_are_those_of_the_file():
    keys = {
        "kind": "block", "width_m": 0.8, "height_m": 4.0, "mass_kg": 5e3, "uplift_displacement_m": 5e-4,
    }  # fmt: skip
    block = uplift.structure(**keys)
    text = "\n".join(f"{key} = {json.dumps(value)}" for key, value in keys.items())
    assert block.capacity_m == uplift.Structure.parse(text).capacity_m
    # a rigid structure uplifts at alpha g
    assert block.spectral_strength == pytest.approx(np.arctan(0.2), rel=1e-15)
    with pytest.raises(uplift.StudyError) as raised:
        uplift.structure(kind="block", width_m=-1, hight_m=4, mass_kg=1)
    assert len(raised.value.mistakes) >= 2 and "hight_m" in str(raised.value)
    with pytest.raises(FileNotFoundError):
        uplift.Structure.read("absent.toml")


def test_a_design_of_the_dissertation():
    # Table 3.5, near-field pulse-like, 1.0 PGA: 0.472 m on the oscillator of zero stiffness, 0.576 m with 1.60 m
    pier = uplift.Structure.read(STRUCTURES / "pier.toml")
    checked = uplift.design(pier, 0.472 / pier.participation)
    assert checked.zero_stiffness_demand_m == pytest.approx(0.472, rel=1e-15)
    assert checked.required_capacity_m > 2.5 * 0.472 and checked.is_satisfied == (checked.margin_m >= 0)
    zero = uplift.design(pier, 0.0)
    assert zero.demand_m == 0 and zero.is_satisfied
    with pytest.raises(ValueError, match="rule"):
        uplift.design(pier, 0.1, rule="x")
    with pytest.raises(ValueError, match="safety"):
        uplift.design(pier, 0.1, safety_factor=0.5)


def test_the_oscillator_of_a_structure(record):
    pier = uplift.Structure.read(STRUCTURES / "pier.toml")
    own = pier.oscillator()
    assert own["strength"] == pier.spectral_strength
    assert uplift.respond(record, **own).peak_displacement_m > 0
    force = pier.restoring_force_n([0, pier.uplift_displacement_m, pier.capacity_m])
    assert force[0] == 0 and force[1] == pytest.approx(pier.uplift_force_n, rel=1e-14)
    assert abs(force[2]) < 1e-6 * force[1]


@pytest.mark.parametrize(
    ("options", "numbers"),
    [
        (["--width-m=0.8", "--height-m=4"], {"width_m": 0.8, "height_m": 4}),
        (["--size-m=2", "--slenderness=0.2", "--restitution=0.9"],
         {"size_m": 2, "slenderness_rad": 0.2, "restitution": 0.9}),
    ],
)  # fmt: skip
def test_a_block_is_that_of_the_program(downloads, program, options, numbers):
    file = downloads / "SYN002_H1.AT2"
    told = json.loads(program(downloads, "response", file, "--block", *options, "--scale=2.5", "--json"))
    block = uplift.Block(**numbers)
    assert block.width_m == told["width_m"] and block.restitution == told["restitution"]
    run = block.respond(uplift.read_record(file), scale=[1.0, 2.5])
    assert run.peak_displacement_m[1] == told["peak_displacement_m"] or told["overturned"]
    assert run.impacts[1] == told["impacts"] and run.overturned[1] == told["overturned"]
    assert run.peak_rotation_rad.shape == (2,)
    with pytest.raises(ValueError, match="two numbers"):
        uplift.Block(width_m=1)


@pytest.mark.parametrize("model", ["planar", "wobbling"])
def test_a_frame_is_that_of_the_program(downloads, program, model):
    files = [downloads / f"SYN001_H{number}.AT2" for number in (1, 2)]
    structure = STRUCTURES / "shake-table.toml"
    given = ["--h1", files[0]] + (["--h2", files[1]] if model == "wobbling" else [])
    told = json.loads(program(downloads, "response", "--structure", structure, *given, "--model", model, "--scale=2",
                              "--json"))["runs"][0]  # fmt: skip
    records = [uplift.read_record(file, gravity_m_s2=uplift.Structure.read(structure).gravity_m_s2) for file in files]
    shaken = records if model == "wobbling" else records[:1]
    run = uplift.respond_frame(uplift.Structure.read(structure), *shaken, model=model, scale=2, history=True)
    for name in ("peak_rotation_rad", "peak_displacement_m", "peak_base_shear_n", "peak_tendon_n", "impacts", "rests"):
        assert getattr(run, name) == told[name], name
    assert run.model == model and len(run.history) > 100
    assert np.hypot(run.history.displacement_x_m, run.history.displacement_y_m).max() <= run.peak_displacement_m
    with pytest.raises(ValueError, match="shakes"):
        uplift.respond_frame(uplift.Structure.read(structure))


def test_a_pushover_is_that_of_the_program(program, downloads):
    column = uplift.Structure.read(STRUCTURES / "column-j.toml")
    program(downloads, "pushover", STRUCTURES / "column-j.toml", "-o", "rows.csv", "--force")
    lines = [line for line in (downloads / "rows.csv").read_text().splitlines() if not line.startswith("#")]
    names, *rows = [line.split(",") for line in lines]
    table = {name: [row[place] for row in rows] for place, name in enumerate(names)}
    told = {name: np.array(values, dtype=float) for name, values in table.items()}
    pushed = column.pushover(told["displacement_m"])
    # the program goes from rotations to displacements, and we come back
    for name in ("rotation_rad", "force_n", "elongation_m", "tendon_n", "spring_m", "base_axial_n", "energy_j"):
        np.testing.assert_allclose(getattr(pushed, name), told[name], rtol=1e-11, atol=1e-9, err_msg=name)
    with pytest.raises(ValueError, match="no columns"):
        mass = {"kind": "point-mass", "width_m": 1, "centre_height_m": 2, "mass_kg": 1e4}
        uplift.structure(**mass).pushover(0.1)


def test_overturning(records):
    levels = [2.0, 5.0, 10.0, 20.0, 40.0, 80.0, 160.0]
    hazard = uplift.HazardCurve([0.1, 1, 10, 100, 300], [1.5, 0.4, 0.01, 1e-5, 1e-7])
    edp_m = uplift.ida(records, [0.02, 0.1], levels, capacity_m=0.1)
    found = uplift.overturning(edp_m, levels, [hazard, hazard])
    np.testing.assert_array_equal(found.overturned, np.isinf(edp_m).mean(axis=0))
    # the same as the risk of exceeding what nothing stands
    largest = np.nextafter(np.inf, 0)
    rates = uplift.risk_curve(edp_m, levels, [hazard, hazard], [largest])[..., 0]
    np.testing.assert_array_equal(found.maf_per_year, rates)
    assert found.maf_per_year.shape == (2, 2) and (found.maf_per_year[:, 0] >= found.maf_per_year[:, 1]).all()
    np.testing.assert_allclose(found.probability, -np.expm1(-50 * found.maf_per_year), rtol=1e-14)


def test_measured_and_computed_peaks():
    scipy_stats = pytest.importorskip("scipy.stats")
    random = np.random.default_rng(3)
    measured, computed = random.lognormal(0, 0.5, 30), random.lognormal(0.2, 0.5, 25)
    found = uplift.validate(measured, computed)
    expected = scipy_stats.ks_2samp(measured, computed, method="exact")
    assert found.ks_distance == pytest.approx(expected.statistic, rel=1e-13)
    assert found.ks_p == pytest.approx(expected.pvalue, rel=1e-9)
    assert found.log_bias is None
    many = np.arange(200_000.0)
    found = uplift.validate(many, many + 800.5)
    assert not found.ks_p_is_exact and found.ks_p == pytest.approx(found.ks_p_kstest2, rel=0.02)
    assert uplift.validate(measured, measured * 2).log_bias == pytest.approx(np.log(2))
    assert uplift.validate([1, np.inf], [2, 3]).wasserstein_distance is None
    with pytest.raises(ValueError):
        uplift.validate([], [1])
