"""Rigid motions, and the scene file they go into."""
import tomllib
from types import SimpleNamespace

import numpy as np
import pytest

from ringlet_hair.errors import RingletError
from ringlet_hair.rigid_motion import RigidMotion, motion_of_matrices, motion_of_points, quaternion_of
from ringlet_hair.sampling import combined
from ringlet_hair.scene_text import Bending, Collider, Keys, Scalp, Scene, keys_of, scene_text
from ringlet_hair.strands import Strands


def turn(axis, angle):
    """Rodrigues' formula."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


AXES = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 2, 3), (-1, 1, 0.1)]


@pytest.mark.parametrize("axis", AXES)
def test_quaternions_are_half_the_angle_about_the_axis(axis):
    unit = np.array(axis) / np.linalg.norm(axis)
    for angle in np.linspace(0, np.pi, 13):
        q = quaternion_of(turn(axis, angle))
        expected = np.append(np.sin(angle / 2) * unit, np.cos(angle / 2))
        assert min(np.abs(q - expected).max(), np.abs(q + expected).max()) < 1e-7


def matrix(rotation, shift, scale):
    m = np.eye(4)
    m[:3, :3], m[:3, 3] = rotation @ np.diag(scale), shift
    return m


def test_scaled_objects_move_rigidly():
    scale = (2, 0.5, 3)
    frames = [matrix(turn((1, 2, 3), 0.2 * k), (k, -k, 2), scale) for k in range(4)]
    motion = motion_of_matrices(frames, frames[1], "Hair")
    point = np.array([0.3, -0.2, 0.5])  # of the object
    at_bind = frames[1][:3, :3] @ point + frames[1][:3, 3]
    assert np.allclose(motion.positions_of(at_bind), [m[:3, :3] @ point + m[:3, 3] for m in frames])
    assert motion_of_matrices(frames[:1], frames[0], "Hair").is_still(1)
    assert not motion.is_still(1)
    with pytest.raises(RingletError, match="the scale of Hair changes"):
        motion_of_matrices(frames + [matrix(np.eye(3), (0, 0, 0), (2, 0.5, 3.01))], frames[1], "Hair")


def test_the_nearest_rigid_motion_of_points():
    rng = np.random.default_rng(5)
    bind = rng.uniform(-1, 1, (50, 3))
    frames = [bind @ turn((1, 2, 3), 0.5 * k).T + (k, 0, -k) for k in range(8)]
    motion, off = motion_of_points(frames, bind)
    assert off < 1e-12
    assert np.allclose(motion.rotations[3], turn((1, 2, 3), 1.5))
    bent = [bind, bind + np.where(bind[:, :1] > 0, (0, 0, 0.02), (0, 0, -0.02)) * (bind[:, 1:2] > 0)]
    motion, off = motion_of_points(bent, bind)
    assert 0.005 < off < 0.04
    assert np.allclose(np.linalg.det(motion.rotations), 1)
    flat = bind * (1, 1, 0)
    motion, off = motion_of_points([flat @ turn((0, 1, 0), 3).T], flat)
    assert off < 1e-12 and np.allclose(motion.rotations[0], turn((0, 1, 0), 3))


def test_neighbouring_quaternions_are_on_one_side():
    motion = RigidMotion(np.array([turn((0, 0, 1), angle) for angle in np.linspace(0, 12, 40)]), np.zeros((40, 3)))
    quaternions = motion.quaternions()
    assert (np.sum(quaternions[1:] * quaternions[:-1], axis=1) > 0.9).all()


def test_scene_files_say_all():
    motion = RigidMotion(np.array([turn((1, 0, 0), 0.1 * k) for k in range(3)]), np.arange(9.0).reshape(3, 3))
    keys = keys_of(motion, (1, 0, 0), [9, 10, 11], 10, 24, 0.01)
    assert np.allclose(keys.seconds, [-1 / 24, 0, 1 / 24])
    assert np.allclose(keys.positions, (np.arange(9).reshape(3, 3) + (1, 0, 0)) * 0.01)
    name = 'a "head"\\\n\x7f'
    own = Keys(np.array([0.0]), np.array([[1.0, 2, 3]]), np.array([[0.0, 0, 0, 1]]))
    scene = Scene("groom.hair", 0.01, 3, 24.0, keys, 9.0, 0.5, "coil", True, Scalp("other", 0.02),
                  [Collider(name, "head.obj"), Collider("other", "b.obj", own, Bending("b.pc2", -0.25))])
    read = tomllib.loads(scene_text(scene))
    assert read["groom"] == {"file": "groom.hair", "unit": 0.01, "up": "Z"}
    assert read["material"] == {"preset": "coil"}
    assert read["motion"]["pre_roll"] == 0.5
    assert [key["time"] for key in read["motion"]["key"]] == keys.seconds.tolist()
    assert [key["position"] for key in read["motion"]["key"]] == keys.positions.tolist()
    assert [key["quaternion"] for key in read["motion"]["key"]] == keys.quaternions.tolist()
    assert read["simulation"] == {"fps": 24.0, "frames": 3, "gravity": 9.0}
    assert "contacts" in read
    assert read["scalp"] == {"body": "other", "farthest": 0.02}
    assert read["body"][0] == {"name": name, "shape": "mesh", "file": "head.obj", "unit": 0.01}
    bending = {key: read["body"][1][key] for key in ("file", "unit", "deforms", "cache", "start")}
    assert bending == {"file": "b.obj", "unit": 0.01, "deforms": True, "cache": "b.pc2", "start": -0.25}
    assert read["body"][1]["moves"]["key"] == [{"time": 0.0, "position": [1, 2, 3], "quaternion": [0, 0, 0, 1]}]
    plain = tomllib.loads(scene_text(Scene("groom.hair", 1.0, 3, 24.0, keys, material="/a/b.toml")))
    assert plain["material"] == {"file": "/a/b.toml"} and not {"contacts", "body", "scalp"} & set(plain)


def test_a_head_that_bends_moves_as_where_hair_grows():
    """The upper half of a body nods about its middle and the lower stays: hair on top goes with the upper."""
    rng = np.random.default_rng(3)
    rest = rng.uniform((-1, -1, -2), (1, 1, 2), (400, 3))
    nods = [turn((1, 0, 0), 0.3 * k) for k in range(4)]
    frames = [np.where(rest[:, 2:] > 0, rest @ nod.T, rest) for nod in nods]
    object = SimpleNamespace(name="Hair")
    source = SimpleNamespace(name="Hair", object=object)
    top = rest[rest[:, 2] > 1.2][:20]
    strands = Strands(np.repeat(top, 2, axis=0) + np.tile([[0, 0, 0], [0, 0, 0.1]], (20, 1)), [2] * 20)
    still = {"Hair": [np.eye(4)] * 4}
    samples = combined([source], [strands], still, SimpleNamespace(name="Body"), frames, np.zeros((1, 3), int), range(4), 0)
    assert np.allclose(samples.motion.rotations, nods) and np.allclose(samples.head.motion.rotations, nods)
    assert samples.head.bent is frames and samples.head.carries and not samples.warnings
    own = {"Hair": [np.eye(4) + np.diag([0.1 * k], 3) for k in range(4)]}
    samples = combined([source], [strands], own, SimpleNamespace(name="Body"), frames, np.zeros((1, 3), int), range(4), 0)
    assert samples.head.bent is frames and not samples.head.carries
    assert "Body bends" in samples.warnings[0] and "Hair moves by itself" in samples.warnings[0]
    rigid = [rest @ nod.T for nod in nods]
    samples = combined([source], [strands], still, SimpleNamespace(name="Body"), rigid, np.zeros((1, 3), int), range(4), 0)
    assert samples.head.bent is None and not samples.warnings
