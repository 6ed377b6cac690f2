"""A run of the add-on from its inputs to its cache, and what it does to the folder, which a .blend names."""
import os

import numpy as np
import pytest

from ringlet_hair.errors import RingletError
from ringlet_hair.job import OUR_FILES, Job, JobSettings
from ringlet_hair.point_cache import PointCache
from ringlet_hair.rigid_motion import RigidMotion
from ringlet_hair.sampling import HeadMesh, Samples
from ringlet_hair.strands import Strands

PROGRAM = os.environ.get("RINGLET_PROGRAM", "")
pytestmark = pytest.mark.skipif(not os.path.exists(PROGRAM),
                                reason="SKIPPED, NOTHING WAS TESTED: the ringlet command was not built")

OPTIONS = "--backend reference"
OTHERS = ["out/notes.txt", "out/hair.usda", "out/renders/a.png", "run-mine/a.txt", "notes.txt"]


def still(frames):
    return RigidMotion(np.tile(np.eye(3), (frames, 1, 1)), np.zeros((frames, 3)))


def head_of(points, triangles, bent=None, carries=False):
    return HeadMesh("Head", np.array(points, float), np.array(triangles), still(3), bent, carries)


def tetrahedron(bent=None, carries=False):
    return head_of([[0, 0, 3], [1, 0, 3], [0, 1, 3], [0, 0, 4]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], bent, carries)


def ball(radius, rings=16, around=24):
    """A sphere about the origin."""
    down = np.pi * np.arange(1, rings) / rings
    turn = 2 * np.pi * np.arange(around) / around
    points = [(0, 0, radius)] + [(radius * np.sin(a) * np.cos(b), radius * np.sin(a) * np.sin(b), radius * np.cos(a))
                                 for a in down for b in turn] + [(0, 0, -radius)]
    at = lambda ring, k: 1 + ring * around + k % around
    last, triangles = len(points) - 1, []
    for k in range(around):
        triangles += [(0, at(0, k), at(0, k + 1)), (last, at(rings - 2, k + 1), at(rings - 2, k))]
        for ring in range(rings - 2):
            a, b, c, d = at(ring, k), at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1)
            triangles += [(a, c, d), (a, d, b)]
    return np.array(points), triangles


TWO_STRANDS = [[0, 0, -i] for i in range(8)] + [[1, 0, -i] for i in range(8)]


def job(folder, options=OPTIONS, program=PROGRAM, head=None, points=TWO_STRANDS):
    """Two frames of two strands beside a head, from which their roots are 3 away."""
    settings = JobSettings(program=program, folder=str(folder), first_frame=1, last_frame=2, fps=24, unit=0.01,
                           gravity=9.81, pre_roll=0, material="", contacts=False, options=options)
    frames = list(settings.sampled_frames)
    samples = Samples([], [Strands(np.array(points, float), [8, 8])], still(len(frames)), head or tetrahedron(), frames,
                      frames.index(1), [])
    return Job(settings, samples)


def files_in(folder):
    """Text of every file by its path."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def run(folder, **more):
    done = job(folder, **more)
    done.wait()
    return done


@pytest.fixture
def folder(tmp_path):
    """The add-on's, in which the user keeps files as well."""
    for name in OTHERS:
        path = tmp_path / "hair" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"my {name}")
    return tmp_path / "hair"


@pytest.mark.parametrize("times", [1, 2])
def test_files_of_the_user_stay(folder, times):
    before = files_in(folder)
    for _ in range(times):
        assert run(folder).error is None
    after = files_in(folder)
    assert {name: after.get(name) for name in OTHERS} == before
    assert set(after) - set(before) == {"scene.toml", "groom.hair", "head.obj", "hair.pc2"}
    assert {path.name for path in folder.iterdir()} == {"out", "run-mine", "notes.txt", *set(after) - set(before)}


def test_roots_follow_a_head_that_bends(tmp_path):
    """Its first point stays, below which the first root is; the second goes along X and takes the other root along."""
    rest = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 3], [0, 0, 4]], float)
    bent = [rest + np.array([[0, 0, 0], [0.5 * (frame - 1), 0, 0], [0, 0, 0], [0, 0, 0]]) for frame in range(3)]
    folder = tmp_path / "hair"
    folder.mkdir()
    done = run(folder, head=tetrahedron(bent, carries=True))
    assert done.error is None, done.error
    roots = np.array([PointCache(folder / "hair.pc2").frame(frame)[[0, 8]] for frame in range(2)])
    assert roots[:, 0] == pytest.approx(np.zeros((2, 3)), abs=1e-4)
    assert roots[:, 1] == pytest.approx(np.array([[1, 0, 0], [1.5, 0, 0]]), abs=1e-4)
    assert {path.name for path in folder.iterdir()} >= {"head.obj", "head.pc2"}


def test_hair_stays_out_of_a_head_that_bends(tmp_path):
    """Half of a ball bulges towards two strands that hang beside it."""
    rest, triangles = ball(3)
    bent = [rest + rest * ((rest[:, :1] > 0) * [0.5 * frame / 3, 0, 0]) for frame in range(3)]
    strands = [[3.6, y, 3 - i] for y in (0, 0.5) for i in range(8)]
    folder = tmp_path / "hair"
    folder.mkdir()
    depths = {}
    for name, frames in (("rigid", None), ("bends", bent)):
        done = run(folder, head=head_of(bent[1], triangles, frames), points=strands)
        assert done.error is None, done.error
        points = PointCache(folder / "hair.pc2").frame(1)
        depths[name] = 4 - np.linalg.norm(points * [1, 4 / 3, 4 / 3], axis=1).min()
    cell = 8 / 64  # of a grid about the ball and where hair comes to
    assert depths["rigid"] > 0.2, "the bulge must come to the hair"
    assert depths["bends"] < cell, "hair must be outside of it"


@pytest.mark.parametrize("name", OUR_FILES)
def test_files_of_others_are_not_replaced(folder, name):
    (folder / name).write_text("somebody else's")
    before = files_in(folder)
    with pytest.raises(RingletError, match=f"holds {name}, which this add-on did not write"):
        job(folder)
    assert files_in(folder) == before


@pytest.mark.parametrize("name", OUR_FILES)
def test_links_are_not_followed(folder, tmp_path, name):
    victim = tmp_path / "victim"
    victim.write_text("a secret")
    (folder / name).symlink_to(victim)
    with pytest.raises(RingletError, match="did not write"):
        job(folder)
    assert victim.read_text() == "a secret"


def test_what_fails_leaves_the_folder_as_it_was(folder):
    before = files_in(folder)
    with pytest.raises(RingletError, match="cannot be started"):
        job(folder, program="/nowhere/ringlet")
    failed = run(folder, options="--no-such-option")
    assert "no-such-option" in failed.error
    cancelled = job(folder, options=OPTIONS + " --frames 100000")
    while cancelled.run.frame == 0:
        assert not cancelled.is_over()
    cancelled.run.cancel()
    cancelled.wait()
    assert cancelled.error == "cancelled"
    after = files_in(folder)
    assert {name: after.get(name) for name in OTHERS} == before
    assert [path.name for path in folder.iterdir() if path.name.startswith("run-")] == ["run-mine"]
