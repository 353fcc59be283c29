"""Responses: shapes, arguments, interruption."""

import os
import signal
import threading
import time

import numpy as np
import pytest
from conftest import noise

import uplift_urs as uplift

FIELDS = ("peak_displacement_m", "time_of_peak_s", "impacts", "uplifts", "overturned", "end_displacement_m")


def test_arrays_broadcast_and_have_the_numbers_of_scalars(record):
    strengths, scales = np.array([[0.05], [0.1], [0.4]]), np.array([0.5, 1, 2, 8])
    many = uplift.respond(record, strengths, scale=scales, capacity_m=[0.1, 0.2, 0.3, 0.1])
    assert many.peak_displacement_m.shape == (3, 4)
    assert many.overturned.any() and not many.overturned.all()
    for i, strength in enumerate(strengths[:, 0]):
        for j, (scale, capacity_m) in enumerate(zip(scales, [0.1, 0.2, 0.3, 0.1])):
            one = uplift.respond(record, strength, scale=scale, capacity_m=capacity_m)
            for name in FIELDS:
                assert getattr(many, name)[i, j] == getattr(one, name), name


def test_shapes(record):
    shape = lambda *arguments, **options: uplift.respond(record, *arguments, **options).impacts.shape
    assert shape([0.1]) == (1,)
    assert shape(np.zeros((0, 3)) + 0.1) == (0, 3)
    assert shape(0.1, scale=np.ones((2, 1, 3))) == (2, 1, 3)
    assert shape([0.1, 0.2], restitution=[[0.5], [0.9], [1.0]]) == (3, 2)
    for scalar in (0.1, np.float32(0.1), np.array(0.1), 1):
        assert isinstance(uplift.respond(record, scalar), uplift.Response)
    with pytest.raises(ValueError, match="broadcast|mismatch"):
        uplift.respond(record, [0.1, 0.2], scale=[1, 2, 3])


def test_the_free_peak_counts_unless_told_otherwise():
    push = uplift.Record.from_array([-3.0, -3.0], dt_s=0.3, unit="m/s2")
    peak = lambda **options: uplift.respond(push, 0.1, **options).peak_displacement_m
    assert peak() > 2 * peak(free_vibration=False) == 2 * peak(free_vibration_s=0)
    assert peak(free_vibration_s=60) == pytest.approx(peak(), rel=1e-12)


def test_history(record):
    run = uplift.respond(record, 0.1, history=True)
    history = run.history
    assert np.abs(history.displacement_m).max() <= run.peak_displacement_m
    assert history.time_s.shape == history.velocity_m_s.shape == (len(record),)
    assert history.event_is_impact.sum() == run.impacts > 10
    after, before = history.event_velocity_after_m_s, history.event_velocity_before_m_s
    np.testing.assert_allclose(after[history.event_is_impact], 0.95 * before[history.event_is_impact], rtol=1e-15)
    assert uplift.respond(record, 0.1).history is None
    with pytest.raises(ValueError, match="scalars"):
        uplift.respond(record, [0.1], history=True)


def test_all_mistakes_of_an_oscillator_at_once(record):
    with pytest.raises(ValueError) as raised:
        uplift.respond(record, -0.1, restitution=95, uplift_displacement_m=0.5e-7)
    for words in ("strength is -0.1", "restitution is 95", "uplift_displacement_m is 5e-8 m: it must be from 1e-6 to"):
        assert words in str(raised.value)
    for options in (
        {"strength": np.nan},
        {"strength": 0.1, "scale": np.inf},
        {"strength": 0.1, "capacity_m": 0.0001},
        {"strength": 0.1, "capacity_m": 0.2, "post_uplift_stiffness_per_s2": 1},
        {"strength": 0.1, "gravity_m_s2": 9810},
        {"strength": 0.1, "free_vibration_s": -1},
        {"strength": 10**400},
    ):
        with pytest.raises(ValueError):
            uplift.respond(record, **options)
    block = uplift.Block(width_m=1, height_m=4)
    for shake in (lambda: uplift.respond(record, 0.1, scale=-1e7), lambda: block.respond(record, scale=-1e7)):
        with pytest.raises(ValueError, match="scale is -1.*from -1e6 to 1e6"):
            shake()


def test_what_is_no_number_is_a_type_error(record):
    for strength in ("0.1", None, True, [None], ["0.1"], np.array([1j]), np.array([True]), object(), {}):
        with pytest.raises(TypeError):
            uplift.respond(record, strength)
    with pytest.raises(ValueError, match="masked"):
        uplift.respond(record, np.ma.array([0.1, 0.2], mask=[False, True]))
    with pytest.raises(TypeError):
        uplift.respond(np.zeros(3), 0.1)


def test_a_run_without_end_is_refused(record):
    with pytest.raises(ValueError, match="steps"):
        uplift.respond(record, 100, uplift_displacement_m=1e-6, free_vibration_s=3600)


def test_more_than_fits_the_memory_is_a_memory_error(record):
    many = np.broadcast_to(0.1, (2**40,))
    with pytest.raises(MemoryError):
        uplift.respond(record, many)
    side = np.full(2**21, 0.1)
    with pytest.raises(MemoryError):
        uplift.respond(record, side, scale=side[:, None])


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="skipped: no timer of signals here")
@pytest.mark.parametrize("work", ["respond", "ida"])
def test_an_interruption_ends_it(work):
    class Interrupted(Exception):
        pass

    def interrupt(*_):
        raise Interrupted

    long = uplift.Record.from_array(noise(7, 20_000), dt_s=0.01, unit="m/s2")
    before = signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    # the work itself would take hours
    try:
        with pytest.raises(Interrupted):
            if work == "respond":
                uplift.respond(long, 0.05, scale=np.linspace(1, 2, 1_000_000))
            else:
                uplift.ida([long] * 1000, np.linspace(0.01, 1, 300), np.linspace(1, 100, 80))
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_other_threads_of_python_go_on(record):
    scales = np.linspace(1, 2, 400)
    worker = threading.Thread(target=uplift.respond, args=(record, 0.05), kwargs={"scale": scales})
    worker.start()
    steps = 0
    while worker.is_alive():
        steps += 1
    worker.join()
    assert steps > 100


@pytest.mark.skipif(not hasattr(os, "fork"), reason="skipped: no fork here")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_process_that_forks_after_a_call_can_call_again(record):
    scales = np.linspace(1, 2, 8)
    here = uplift.respond(record, 0.1, scale=scales).peak_displacement_m
    child = os.fork()
    if child == 0:
        there = uplift.respond(record, 0.1, scale=scales).peak_displacement_m
        os._exit(0 if (here == there).all() else 1)
    deadline = time.monotonic() + 60
    while (ended := os.waitpid(child, os.WNOHANG)) == (0, 0) and time.monotonic() < deadline:
        time.sleep(0.01)
    if ended == (0, 0):
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
    assert ended[0] == child and os.waitstatus_to_exitcode(ended[1]) == 0
