"""Hazard curves, fragility, risk, spectra, fits: by hand."""

import math

import numpy as np
import pytest
from conftest import REPOSITORY

import uplift_urs as uplift

SAMPLES = REPOSITORY / "crates/hazard/tests/samples"
LEVELS = [1.0, 10.0, 100.0]
# two records; the example of the crates
EDP = np.array([[0.0, 0.1, 0.8], [0.0, 0.2, 0.6]])
HAZARD = uplift.HazardCurve([0.5, 10, 100], [0.5, 0.1, 0.001])


def test_a_curve_between_its_points_and_outside():
    curve = uplift.HazardCurve([1, 10, 100], [1e-1, 1e-3, 1e-5])
    np.testing.assert_allclose(curve.rate_at([[1, 10], [math.sqrt(10), 100]]), [[1e-1, 1e-3], [1e-2, 1e-5]], rtol=1e-14)
    assert curve.im_at_rate(1e-2) == pytest.approx(math.sqrt(10), rel=1e-14)
    with pytest.raises(ValueError, match="outside"):
        curve.rate_at(1000)
    assert curve.rate_at(1000, extrapolate="loglog") == pytest.approx(1e-7, rel=1e-12)
    np.testing.assert_array_equal(curve.im, [1, 10, 100])
    assert (curve.measure, curve.unit, len(curve)) == ("PGV", "cm/s", 3)
    assert curve == uplift.HazardCurve(curve.im, curve.maf_per_year) != HAZARD


@pytest.mark.parametrize(
    ("im", "maf", "options", "words"),
    [
        ([1], [1], {}, "at least 2"),
        ([1, 2], [1], {}, "2 intensity levels but 1"),
        ([2, 1], [1, 0.1], {}, "does not exceed"),
        ([1, 2], [0.1, 1], {}, "not below"),
        ([1, np.nan], [1, 0.1], {}, "NaN"),
        ([1, 2], [1, 0], {}, "above 0"),
        ([1, 2], [1, 0.1], {"unit": "g"}, "PGV cannot be in"),
        ([1, 2], [1, 0.1], {"measure": "mine"}, "unknown intensity measure"),
        ([1, 2], [1, 0.1], {"component": "diagonal"}, "component"),
    ],
)
def test_what_is_no_curve(im, maf, options, words):
    with pytest.raises(ValueError, match=words):
        uplift.HazardCurve(im, maf, **options)


def test_units_and_files(tmp_path):
    curve = uplift.HazardCurve([0.01, 0.1], [0.1, 0.01], unit="m/s", component="RotD50")
    np.testing.assert_array_equal(curve.in_unit("cm/s").im, [1, 10])
    file = tmp_path / "curve.csv"
    file.write_text(curve.to_csv())
    again = uplift.HazardCurve.read(file)
    assert (again.component, again.unit) == ("RotD50", "m/s")
    np.testing.assert_array_equal(again.im, curve.im)
    np.testing.assert_array_equal(again.maf_per_year, curve.maf_per_year)
    with pytest.raises(ValueError, match="PGA"):
        uplift.HazardCurve.read(file, measure="pga")
    (tmp_path / "bare.txt").write_text("1 0.1\n10 0.001\n")
    assert uplift.HazardCurve.read(tmp_path / "bare.txt", measure="pgv", kind="maf").rate_at(1) == 0.1
    with pytest.raises(ValueError, match="measure"):
        uplift.HazardCurve.read(tmp_path / "bare.txt")
    with pytest.raises(FileNotFoundError):
        uplift.HazardCurve.read(tmp_path / "nowhere.csv", measure="pgv")
    with pytest.raises(OSError):
        uplift.HazardCurve.read(tmp_path, measure="pgv")


def test_exports_of_engines(tmp_path):
    athens = uplift.read_hazard_export(SAMPLES / "openquake.csv", site="Athens")
    assert [(curve.site, curve.statistic, curve.investigation_years) for curve in athens] == [
        ("Athens", "quantile 0.15", 50.0)
    ]
    np.testing.assert_allclose(athens[0].curve.maf_per_year[0], -math.log1p(-0.5) / 50, rtol=1e-15)
    near = uplift.read_hazard_export(SAMPLES / "openquake.csv", near=(23.8, 38.0))
    assert near[0].curve == athens[0].curve and near[0].distance_km < 10
    for file in ("curves.xml", "service.json"):
        assert all(len(found.curve) >= 2 for found in uplift.read_hazard_export(SAMPLES / file)), file
    with pytest.raises(ValueError, match="Rome"):
        uplift.read_hazard_export(SAMPLES / "openquake.csv", site="Rome")
    with pytest.raises(ValueError, match="longitude first"):
        uplift.read_hazard_export(SAMPLES / "openquake.csv", near=(38, 123))
    with pytest.raises(FileNotFoundError):
        uplift.read_hazard_export(tmp_path / "nowhere.csv")


def test_fragility_by_hand():
    np.testing.assert_array_equal(uplift.fragility(EDP, LEVELS, 0.15), [0, 0.5, 1])
    np.testing.assert_array_equal(uplift.fragility(EDP, LEVELS, [[0.15], [0.7]]), [[[0, 0.5, 1]], [[0, 0, 0.5]]])
    stacked = np.stack([EDP, 2 * EDP], axis=1)
    np.testing.assert_array_equal(
        uplift.fragility(stacked, LEVELS, [0.15]), [[[0, 0.5, 1]], [[0, 1, 1]]], strict=True
    )


def test_risk_by_hand():
    # trapezoids of Eq. 4.4: weights (0.5 - 0.1)/2 + …; the rate at 1 cm/s by log-log interpolation
    first = float(HAZARD.rate_at(1))
    weights = np.array([(0.5 + first) / 2 - (first + 0.1) / 2, (first - 0.001) / 2, (0.1 - 0.001) / 2 + 0.001])
    thresholds = np.array([0.5, 0.0, 0.15])
    expected = [weights @ (EDP > threshold).mean(axis=0) for threshold in thresholds]
    np.testing.assert_allclose(uplift.risk_curve(EDP, LEVELS, HAZARD, thresholds), expected, rtol=1e-12)
    assert uplift.risk_curve(EDP, LEVELS, HAZARD).shape == (3002,)
    in_m_s = HAZARD.in_unit("m/s")
    sites = uplift.risk_curve(EDP[:, None, :], LEVELS, [HAZARD, in_m_s], thresholds)
    assert sites.shape == (2, 1, 3)
    np.testing.assert_allclose(sites[1, 0], expected, rtol=1e-12)


def test_spectra_by_hand():
    # the ordinate is the smallest displacement whose rate meets the target
    spectra = uplift.urs(np.stack([EDP, 0 * EDP], axis=1), LEVELS, HAZARD, poe=[0.99, 1e-9], years=50)
    displacements = np.unique(EDP)
    rates = uplift.risk_curve(EDP, LEVELS, HAZARD, displacements)
    target = -math.log1p(-0.99) / 50
    assert spectra.u_m.shape == (2, 2)
    assert spectra.u_m[0, 0] == displacements[rates <= target].min() > 0
    np.testing.assert_array_equal(spectra.u_m[:, 1], 0)
    np.testing.assert_array_equal(spectra.flag, [[0, 1], [0, 1]])
    overturned = uplift.urs(np.full((2, 3), np.inf), LEVELS, HAZARD, poe=0.5)
    assert overturned.u_m == np.inf and overturned.flag == 2 and overturned.u_m.shape == ()
    assert uplift.urs(EDP, LEVELS, [HAZARD] * 4).u_m.shape == (4, 3)
    assert uplift.urs(EDP, LEVELS, []).u_m.shape == (0, 3)
    grid = uplift.urs(EDP, LEVELS, HAZARD, poe=0.99, contour="grid").u_m
    assert abs(grid - spectra.u_m[0, 0]) <= 0.001


def test_bands_of_records_that_are_alike_have_no_width():
    bands = uplift.bootstrap(EDP[[0, 0, 0]], LEVELS, HAZARD, poe=0.99, replicates=20)
    assert bands.sample_size == [3] and bands.median_m.shape == (1,)
    assert bands.lower_m == bands.median_m == bands.upper_m == uplift.urs(EDP[[0, 0, 0]], LEVELS, HAZARD, poe=0.99).u_m
    many = np.tile(EDP[:, None, :], (15, 2, 1))
    sizes = uplift.bootstrap(many, LEVELS, [HAZARD], replicates=5)
    assert sizes.sample_size == [20, 30] and sizes.lower_m.shape == (1, 3, 2, 2)
    for options in (
        {"sizes": []},
        {"sizes": [0]},
        {"sizes": [2, 2]},
        {"replicates": 0},
        {"replicates": 2**32 - 1},
        {"confidence": 1},
        {"confidence": np.nan},
        {"interval": "normal"},
    ):
        with pytest.raises(ValueError):
            uplift.bootstrap(EDP, LEVELS, HAZARD, **options)


def test_arrays_that_do_not_fit_together():
    for edp, levels, words in [
        (EDP, [1, 2], "with 2 levels"),
        (EDP[0], LEVELS, "with 3 levels"),
        (np.zeros((2, 0, 3)), LEVELS, "no strength"),
        (np.zeros((0, 3)), LEVELS, "0 records"),
        (np.zeros((2, 0)), [], "0 levels"),
        (-EDP, LEVELS, "record 0"),
        (EDP * np.nan, LEVELS, "NaN"),
        (EDP, [1, 1, 2], "level 1"),
        (EDP, [10, 100, 1000], "outside"),
    ]:
        with pytest.raises(ValueError, match=words):
            uplift.urs(edp, levels, HAZARD)
    for thresholds in (-1, np.nan, [0, np.inf]):
        with pytest.raises(ValueError, match="threshold"):
            uplift.risk_curve(EDP, LEVELS, HAZARD, thresholds)
    for options in ({"poe": 0}, {"poe": 1}, {"years": 0}, {"contour": "coarse"}, {"extrapolate": "yes"}):
        with pytest.raises(ValueError):
            uplift.urs(EDP, LEVELS, HAZARD, **options)
    for hazard in (None, [1.0], "curve", EDP):
        with pytest.raises(TypeError, match="HazardCurve"):
            uplift.urs(EDP, LEVELS, hazard)


def test_fit_of_an_exact_curve():
    strengths = np.arange(301) / 300
    u_m = 0.2022 * np.exp(-12.598 * strengths) + 0.0009
    found = uplift.fit(strengths, u_m)
    assert (found.c0_m, found.c1, found.c2_m) == pytest.approx((0.2022, -12.598, 0.0009), rel=1e-9)
    assert found.points == 285 and not found.bound_active
    np.testing.assert_allclose(found.at([0.1, 0.2]), u_m[[30, 60]], rtol=1e-9)
    u_m[:10] = np.inf
    assert uplift.fit(strengths, u_m).points == 285
    with pytest.raises(ValueError, match="censored at strength 0"):
        uplift.fit(strengths, u_m, strength_above=-1)
    with pytest.raises(ValueError, match="3 strengths but 2"):
        uplift.fit([1, 2, 3], [1, 2])
    with pytest.raises(ValueError, match="nan|NaN"):
        uplift.fit([0.1, 0.2, 0.3, np.nan, 0.5], [5, 4, 3, 2, 1])


def test_analyses(records):
    edp_m = uplift.ida(records, [0.1, 0.3], [5, 20])
    assert edp_m.shape == (4, 2, 2) and (edp_m > 0).all()
    pair = uplift.ida([(records[0], records[1])], [0.1], [20])
    alone = [record.pgv_cm_s for record in records[:2]]
    scale = 20 / math.sqrt(alone[0] * alone[1])
    assert pair[0, 0, 0] == pytest.approx(uplift.respond(records[0], 0.1, scale=scale).peak_displacement_m, rel=1e-6)
    for options in (
        {"measure": "d5_75"},
        {"measure": "sa"},
        {"intensity": "rotd50"},
        {"capacity_m": 1e-5},
        {"levels": [20, 5]},
        {"levels": []},
        {"strengths": []},
        {"records": []},
    ):
        with pytest.raises(ValueError):
            uplift.ida(**({"records": records, "strengths": [0.1], "levels": [5]} | options))
    for wrong in (records[0], [1], [None], None, [(records[0],)], [[records[0]] * 3]):
        with pytest.raises(TypeError):
            uplift.ida(wrong, [0.1], [5])
    with pytest.raises(TypeError, match=r"one pair of records: give a list, \[\(h1, h2\)\]"):
        uplift.ida((records[0], records[1]), [0.1], [5])
