"""What the tests share: the repository, its program, and records that need no file."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import uplift_urs as uplift

REPOSITORY = Path(__file__).resolve().parents[2]


def noise(seed, samples=1500, amplitude_m_s2=4.0):
    """Noise in an envelope: a record with many uplifts and impacts."""
    random = np.random.default_rng(seed)
    return amplitude_m_s2 * random.uniform(-1, 1, samples) * np.sin(np.pi * np.arange(samples) / samples)


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
