"""The same numbers as the program, to the bit."""

import json

import h5py
import numpy as np
import pytest

import uplift_urs as uplift

STUDY = """
[records]
manifest = "manifest.csv"
[strengths]
values = [0.02, 0.05, "0.1:0.1:0.6"]
[pgv]
levels_cm_s = [1, 5, 10, 20, 40, 80]
[risk]
thresholds_m = [0, 0.001, 0.01, 0.1]
[bootstrap]
confidence = 0.8
[[sites]]
name = "Near"
pgv = "near.csv"
[[sites]]
name = "Far"
pgv = { file = "far.csv", unit = "m/s", kind = "poe", years = 50 }
"""
NEAR = "pgv_cm_s,maf\n0.1,1.5\n1,0.4\n10,0.01\n100,1e-5\n300,1e-7\n"
FAR = "iml,poe\n0.001,0.999\n0.01,0.6\n0.1,0.05\n1,1e-4\n3,1e-6\n"
OTHER_STUDY = """
gravity_m_s2 = 9.81
[records]
manifest = "manifest.csv"
intensity = "rotd50"
[oscillator]
uplift_displacement_m = 0.001
restitution = 0.8
capacity_m = 0.25
free_vibration = false
[strengths]
values = [0.05, 0.2]
[measures.arias]
levels_cm_s = [1, 50, 500]
[measures.sa_0p5s]
levels_g = [0.1, 0.5, 2]
"""


@pytest.fixture(scope="module")
def folder(program, tmp_path_factory):
    """Records as files with a manifest, and two studies run."""
    at = tmp_path_factory.mktemp("studies")
    program(at, "records", "synthesize", "-o", "downloads", "--count", "4")
    program(at, "records", "import", "downloads", "-o", "manifest.csv")
    for name, text in {"near.csv": NEAR, "far.csv": FAR, "study.toml": STUDY, "other.toml": OTHER_STUDY}.items():
        (at / name).write_text(text)
    program(at, "run", "study.toml", "-o", "study.h5")
    program(at, "run", "other.toml", "-o", "other.h5")
    return at


def pairs(folder, **options):
    files = sorted((folder / "downloads").glob("SYN*_H1.AT2"))
    read = lambda path: uplift.read_record(path, **options)
    return [(read(path), read(path.with_name(path.name.replace("_H1", "_H2")))) for path in files]


def test_spectra_from_records_to_coefficients(folder):
    with h5py.File(folder / "study.h5") as result:
        of = lambda name: result[name][()]
        strengths, levels = of("axes/strength"), of("axes/pgv_level")
        edp_m = uplift.ida(pairs(folder), strengths, levels)
        np.testing.assert_array_equal(edp_m, of("ida/pgv/edp_m"), strict=True)
        sites = [
            uplift.HazardCurve.read(folder / "near.csv"),
            uplift.HazardCurve.read(folder / "far.csv", measure="pgv", unit="m/s", years=50),
        ]
        spectra = uplift.urs(edp_m, levels, sites)
        for name in ("u_m", "flag", "lower_tail_share", "upper_tail_share"):
            np.testing.assert_array_equal(getattr(spectra, name), of(f"urs/pgv/{name}"), strict=True)
        maf = uplift.risk_curve(edp_m, levels, sites, of("axes/threshold"))
        np.testing.assert_array_equal(maf, of("risk/pgv/maf_per_year"), strict=True)
        for site in range(2):
            for poe in range(3):
                found = uplift.fit(strengths, spectra.u_m[site, poe])
                for name in ("c0_m", "c1", "c2_m", "rmse_m", "rmse_plain_m", "max_abs_residual_m", "points"):
                    assert getattr(found, name) == of(f"regression/pgv/{name}")[site, poe], name


@pytest.mark.parametrize("interval", ["percentile", "bca"])
def test_bands(folder, program, interval):
    result = folder / f"{interval}.h5"
    result.write_bytes((folder / "study.h5").read_bytes())
    options = ["--sizes=3,4", "--replicates=200", "--seed=7"]
    program(folder, "bootstrap", result, *options, f"--interval={interval}")
    with h5py.File(result) as file:
        of = lambda name: file[name][()]
        sites = [
            uplift.HazardCurve.read(folder / "near.csv"),
            uplift.HazardCurve.read(folder / "far.csv", measure="pgv", unit="m/s", years=50),
        ]
        bands = uplift.bootstrap(
            of("ida/pgv/edp_m"), of("axes/pgv_level"), sites,
            sizes=[3, 4], replicates=200, confidence=0.8, interval=interval, seed=7,
        )  # fmt: skip
        for ours, name in (("lower_m", "u10_m"), ("median_m", "u50_m"), ("upper_m", "u90_m")):
            np.testing.assert_array_equal(getattr(bands, ours), of(f"bootstrap/pgv/{name}"), strict=True)
        assert (bands.lower_m < bands.upper_m).any()


@pytest.mark.parametrize("measure", ["arias", "sa_0p5s"])
def test_any_measure_oscillator_and_combination(folder, measure):
    with h5py.File(folder / "other.h5") as result:
        edp_m = uplift.ida(
            pairs(folder, gravity_m_s2=9.81),
            result["axes/strength"][()],
            result[f"axes/{measure}_level"][()],
            measure,
            uplift_displacement_m=0.001,
            restitution=0.8,
            capacity_m=0.25,
            free_vibration=False,
            intensity="rotd50",
            gravity_m_s2=9.81,
        )
        np.testing.assert_array_equal(edp_m, result[f"ida/{measure}/edp_m"][()], strict=True)
        assert np.isinf(edp_m).any() and np.isfinite(edp_m).any()


@pytest.mark.parametrize("seconds", [0, 2.5])
@pytest.mark.parametrize("options", [{}, {"capacity_m": 0.2}, {"post_uplift_stiffness_per_s2": 3.0}])
def test_one_response(folder, program, seconds, options):
    file = folder / "downloads" / "SYN002_H1.AT2"
    arguments = [f"--{name.replace('_', '-')}={value}" for name, value in options.items()]
    told = json.loads(
        program(
            folder, "response", file, "--strength=0.15", "--scale=1.7", f"--free-vibration-s={seconds}",
            "--restitution=0.9", "--json", *arguments,
        )
    )  # fmt: skip
    record = uplift.read_record(file)
    found = uplift.respond(record, 0.15, scale=1.7, restitution=0.9, free_vibration_s=seconds, **options)
    peaks = (told["scale"] * record.pga_g, told["scale"] * record.pgv_cm_s)
    assert peaks == pytest.approx((told["pga_g"], told["pgv_cm_s"]), rel=1e-15)
    for name in ("impacts", "uplifts", "overturned", "end_displacement_m", "end_velocity_m_s"):
        assert getattr(found, name) == told[name], name
    if not found.overturned:
        assert found.peak_displacement_m == told["peak_displacement_m"]
        assert found.time_of_peak_s == told["time_of_peak_s"]


def test_a_history(folder, program):
    file = folder / "downloads" / "SYN001_H1.AT2"
    program(folder, "response", file, "--strength=0.1", "--history=history.csv", "--force")
    rows = (folder / "history.csv").read_text().splitlines()
    lines = [line for line in rows if not line.startswith("#")]
    names, *rows = [line.split(",") for line in lines]
    table = {name: [row[place] for row in rows] for place, name in enumerate(names)}
    found = uplift.respond(uplift.read_record(file), 0.1, free_vibration_s=0, history=True).history
    samples = [place for place, event in enumerate(table["event"]) if not event]
    for name in ("time_s", "displacement_m", "velocity_m_s"):
        told = [float(table[name][place]) for place in samples]
        np.testing.assert_array_equal(getattr(found, name), told)
    assert len(found.event_time_s) > 10
    before = [place for place, event in enumerate(table["event"]) if event == "before impact"]
    is_impact = found.event_is_impact
    for name in ("time_s", "displacement_m"):
        told = [float(table[name][place]) for place in before]
        np.testing.assert_array_equal(getattr(found, f"event_{name}")[is_impact], told)
    told = [float(table["velocity_m_s"][place]) for place in before]
    np.testing.assert_array_equal(found.event_velocity_before_m_s[is_impact], told)
