"""What the tests share: the repository, its program, and records that need no file."""

import os
import subprocess
import sys
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import numpy as np
import pytest

import uplift_urs as uplift

REPOSITORY = Path(__file__).resolve().parents[2]


def noise(seed, samples=1500, amplitude_m_s2=4.0):
    """Noise in an envelope: a record with many uplifts and impacts."""
    random = np.random.default_rng(seed)
    return amplitude_m_s2 * random.uniform(-1, 1, samples) * np.sin(np.pi * np.arange(samples) / samples)


def skip_or_fail(what, install):
    """Without the other program a test is skipped; not in CI, where its wheels are."""
    if "CI" in os.environ and (3, 11) <= sys.version_info < (3, 14):
        pytest.fail(f"CI needs {what}: {install}")
    pytest.skip(f"skipped: no {what}: {install}")


@pytest.fixture
def openquake(tmp_path):
    """The environment of a calculation of OpenQuake within `tmp_path`: one process, no server, no workers."""
    try:
        version("openquake.engine")
    except PackageNotFoundError:
        skip_or_fail("OpenQuake", "pip install --no-deps -r python/tests/requirements-openquake.txt")
    (tmp_path / "openquake.cfg").write_text(f"[dbserver]\nhost = 127.0.0.1\nfile = {tmp_path / 'jobs.sqlite3'}\n")
    return os.environ | {
        "OQ_CONFIG_FILE": str(tmp_path / "openquake.cfg"),
        "OQ_DATABASE": "127.0.0.1",
        "OQ_DATADIR": str(tmp_path),
        "OQ_DISTRIBUTE": "no",
        # numba would compile first, which takes two minutes in a fresh environment; a calculation takes less than a
        # second without it
        "NUMBA_DISABLE_JIT": "1",
    }


@pytest.fixture(scope="session")
def records():
    return [uplift.Record.from_array(noise(seed), dt_s=0.01, unit="m/s2", name=f"noise {seed}") for seed in range(4)]


@pytest.fixture(scope="session")
def record(records):
    return records[0]


@pytest.fixture(scope="session")
def program():
    """Calls the program that the package finds, or one that is built in the repository, which it then takes too."""
    try:
        found = uplift.find_program()
    except FileNotFoundError:
        built = [REPOSITORY / "target" / profile / "uplift" for profile in ("release", "debug")]
        found = next((path for path in built if path.is_file()), None)
        if not found:
            pytest.skip("skipped: no program uplift: make build, or set UPLIFT_PROGRAM")
        os.environ["UPLIFT_PROGRAM"] = str(found)

    def call(at, *arguments):
        done = subprocess.run([found, *map(str, arguments)], cwd=at, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return call
