# What the tests of the Python module share: the device, small grooms, the program.
import json
import os
import subprocess

import numpy as np
import pytest

os.environ["RINGLET_VALIDATION"] = "1"  # before a device opens

import ringlet  # noqa: E402


@pytest.fixture(scope="session")
def device():
    """The session's device, under the validation layer, which must have nothing to say."""
    try:
        opened = ringlet.Device()
    except ringlet.Error as error:
        if os.environ.get("RINGLET_REQUIRE_GPU") == "1":
            pytest.fail(f"RINGLET_REQUIRE_GPU=1, but: {error}")
        pytest.skip(f"SKIPPED, NOTHING WAS TESTED: {error}")
    yield opened
    assert opened.validation_messages() == []


@pytest.fixture(scope="session")
def swatch():
    """Six strands of 32 particles."""
    return ringlet.make_swatch(columns=3, rows=2, particles=32)


@pytest.fixture(scope="session")
def asset(device, swatch):
    return ringlet.Asset(device, swatch, settings=ringlet.Settings(steps_per_frame=4))


@pytest.fixture
def hair(asset):
    return ringlet.Hair(asset)


@pytest.fixture
def program(tmp_path):
    """Runs the ringlet command in a folder of its own; gives what it tells with --json."""
    path = os.environ.get("RINGLET_PROGRAM", "")
    if not os.path.exists(path):
        pytest.skip("SKIPPED, NOTHING WAS TESTED: the ringlet command was not built")

    def run(*arguments, tells=True):
        done = subprocess.run([path, *map(str, arguments), *(["--json"] if tells else [])], cwd=tmp_path,
                              capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout) if tells else None

    run.folder = tmp_path
    return run


def shaken(frame, steps):
    """Where a head that is shaken is at the end of each step of a frame, (steps, 7)."""
    poses = np.zeros((steps, 7))
    poses[:, 6] = 1
    poses[:, 0] = 0.03 * np.sin(0.7 * (frame + (np.arange(steps) + 1) / steps))
    return poses
