"""Whatever is handed over: an answer or one of Python's own exceptions, never a panic."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as st_numpy

import uplift_urs as uplift

# a panic would be a PanicException, which derives from BaseException alone
REFUSALS = (ValueError, TypeError, OverflowError, MemoryError)
DTYPES = st.one_of(
    st_numpy.floating_dtypes(),
    st_numpy.integer_dtypes(),
    st_numpy.boolean_dtypes(),
    st_numpy.complex_number_dtypes(),
    st_numpy.unicode_string_dtypes(),
    st_numpy.datetime64_dtypes(),
)


@st.composite
def layouts(draw, arrays):
    """The same values with other strides, or read-only."""
    array = draw(arrays)
    if array.ndim and draw(st.booleans()):
        array = array[:: draw(st.sampled_from([1, -1, 2, -3]))]
    if draw(st.booleans()):
        array = array.T
    array.setflags(write=draw(st.booleans()) and array.flags.writeable)
    return array


SHAPES = st_numpy.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4)
NUMBERS = st.one_of(st.floats(), st.floats(0, 2), st.integers())
ANY_ARRAY = layouts(DTYPES.flatmap(lambda dtype: st_numpy.arrays(dtype, SHAPES)))
FLOATS = layouts(st_numpy.arrays(np.float64, SHAPES, elements=st.floats(0, 2, width=32)))
ANYTHING = st.one_of(NUMBERS, ANY_ARRAY, FLOATS, st.none(), st.text(), st.lists(NUMBERS), st.binary())
RECORD = uplift.Record.from_array([0.0, 1.0, -2.0, 3.0, -1.0, 0.0], dt_s=0.05, unit="m/s2")
HAZARD = uplift.HazardCurve([0.01, 1, 100], [10, 0.1, 1e-4])


def answers(function, *arguments, **options):
    with np.errstate(all="ignore"):
        try:
            return function(*arguments, **options)
        except REFUSALS as refusal:
            assert str(refusal) or isinstance(refusal, MemoryError)
            return None


@given(ANYTHING, NUMBERS, st.sampled_from(["g", "gal", "m/s2", "", "ft"]))
def test_records(values, dt_s, unit):
    record = answers(uplift.Record.from_array, values, dt_s=dt_s, unit=unit)
    if record is not None:
        assert np.isfinite(record.acceleration_m_s2).all() and record.pgv_cm_s >= 0


@settings(deadline=None)
@given(ANYTHING, ANYTHING, st.one_of(st.none(), ANYTHING), st.one_of(st.none(), NUMBERS))
def test_responses(strength, scale, capacity_m, free_vibration_s):
    found = answers(
        uplift.respond, RECORD, strength, scale=scale, capacity_m=capacity_m, free_vibration_s=free_vibration_s
    )
    if isinstance(found, uplift.Responses):
        others = [np.asarray(given) for given in (strength, scale, capacity_m) if given is not None]
        assert found.impacts.shape == np.broadcast_shapes(*(other.shape for other in others))
        assert not np.isnan(found.peak_displacement_m).any()


@settings(deadline=None)
@given(ANYTHING, ANYTHING, st.sampled_from(["pgv", "pga", "sa_1s", "d5_75", "x"]))
def test_analyses(strengths, levels, measure):
    found = answers(uplift.ida, [RECORD, (RECORD, RECORD)], strengths, levels, measure)
    if found is not None:
        assert found.shape[0] == 2 and not np.isnan(found).any()


@settings(deadline=None)
@given(st.one_of(FLOATS, ANYTHING), st.one_of(st.just([0.5, 1.0, 2.0]), ANYTHING), ANYTHING)
def test_risk(edp_m, levels, given_too):
    answers(uplift.fragility, edp_m, levels, given_too)
    answers(uplift.risk_curve, edp_m, levels, HAZARD, given_too)
    spectra = answers(uplift.urs, edp_m, levels, [HAZARD], given_too)
    if spectra is not None:
        assert not np.isnan(spectra.u_m).any()
    answers(uplift.fit, edp_m, levels)
    bands = answers(uplift.bootstrap, edp_m, levels, [HAZARD], given_too, sizes=[1, 3], replicates=4, interval="bca")
    assert (bands is None) == (spectra is None)


@given(ANYTHING, ANYTHING, st.one_of(st.none(), st.text()))
def test_curves(im, maf, unit):
    curve = answers(uplift.HazardCurve, im, maf, unit=unit)
    answers(HAZARD.rate_at, im, extrapolate="loglog")
    answers(HAZARD.im_at_rate, maf, extrapolate="loglog")
    if curve is not None:
        assert (np.diff(curve.maf_per_year) < 0).all()


@settings(deadline=None)
@given(ANYTHING, ANYTHING, ANYTHING, st.booleans())
def test_consistency(scaled_to, other, levels, repair):
    pga = uplift.HazardCurve([1e-4, 0.01, 1], [10, 0.1, 1e-4], measure="pga")
    found = answers(uplift.consistency, scaled_to, other, levels, HAZARD, pga, extrapolate="loglog", repair=repair)
    if found is not None:
        assert found.verdict in ("consistent", "off", "inconsistent", None)
        assert (np.abs(found.weights.sum(axis=1) - 1) < 1e-9).all()


@settings(deadline=None)
@given(NUMBERS, NUMBERS, st.one_of(st.none(), NUMBERS), ANYTHING, NUMBERS)
def test_blocks(width_m, height_m, restitution, scale, free_vibration_s):
    block = answers(uplift.Block, width_m=width_m, height_m=height_m, restitution=restitution)
    if block is not None:
        # a second at most: long motions are computed, and take as long as they take
        answers(block.respond, RECORD, scale=scale, free_vibration_s=min(free_vibration_s, 1))


VALUES = st.recursive(
    st.one_of(st.text(), st.integers(), st.floats(), st.booleans()),
    lambda inner: st.one_of(st.lists(inner, max_size=3), st.dictionaries(st.text(), inner, max_size=3)),
    max_leaves=6,
)
KEYS = st.sampled_from(
    ["kind", "width_m", "height_m", "mass_kg", "columns", "deck_mass_kg", "column_mass_kg", "slenderness_rad", "size_m",
     "restitution", "uplift_displacement_m", "restrainer", "tendon_stiffness_n_m", "tendon_anchorage", "gravity_m_s2"]
)  # fmt: skip
KINDS = st.sampled_from(["block", "frame", "restrained-frame", "point-mass", "body", "curved-frame", "x"])
PLAUSIBLE = {
    "kind": KINDS, "width_m": st.floats(0.1, 5), "height_m": st.floats(1, 20), "columns": st.integers(1, 8),
    "deck_mass_kg": st.floats(1e3, 1e6), "column_mass_kg": st.floats(1e3, 1e5), "mass_kg": st.floats(1e3, 1e5),
    "tendon_anchorage": st.sampled_from(["column", "foundation"]), "tendon_stiffness_n_m": st.floats(0, 1e8),
}  # fmt: skip


@settings(deadline=None)
@given(st.one_of(st.dictionaries(KEYS, VALUES), st.fixed_dictionaries({}, optional=PLAUSIBLE)), ANYTHING, NUMBERS)
def test_structures(keys, displacement_m, ordinate_m):
    structure = answers(uplift.structure, **keys)
    if structure is not None:
        answers(structure.pushover, displacement_m)
        answers(uplift.design, structure, ordinate_m)
        answers(structure.restoring_force_n, displacement_m)
        answers(uplift.respond_frame, structure, RECORD, scale=ordinate_m)


@settings(deadline=None)
@given(st.one_of(FLOATS, ANYTHING), st.one_of(st.just([0.5, 1.0, 2.0]), ANYTHING), ANYTHING)
def test_overturning_and_validation(edp_m, levels, given_too):
    answers(uplift.overturning, edp_m, levels, HAZARD)
    answers(uplift.validate, edp_m, given_too)


@given(st.dictionaries(st.text(), VALUES))
def test_studies_are_toml(study):
    text = answers(uplift._toml.document, study)
    if text is not None:
        tomllib = pytest.importorskip("tomllib")
        read = tomllib.loads(text)
        assert set(read) == set(study)
        for key, value in study.items():
            assert repr(read[key]) == repr(value)
