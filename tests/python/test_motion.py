# Poses, motions and bodies.
import json
import math

import numpy as np
import pytest

import ringlet

BVH = """HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Head
  {
    OFFSET 0 10 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 2 0
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.5
0 0 0 0 0 0 0 0 0
1 0 0 0 0 0 0 0 0
2 0 0 0 0 0 90 0 0
"""


def gltf(path):
    """A node Head that goes 1 m along X in a second, and with it a square of 2 m at its feet."""
    square = np.float32([[-1, 0, -1], [-1, 0, 1], [1, 0, 1], [1, 0, -1]])
    data = (np.concatenate([np.float32([0, 1]), np.float32([0, 0, 0, 1, 0, 0]), square.reshape(-1)]).tobytes() +
            np.uint16([0, 1, 2, 0, 2, 3]).tobytes())
    path.with_suffix(".bin").write_bytes(data)
    path.write_text(json.dumps({
        "asset": {"version": "2.0"},
        "nodes": [{"name": "Head", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 2}, "indices": 3}]}],
        "scenes": [{"nodes": [0]}],
        "buffers": [{"uri": path.with_suffix(".bin").name, "byteLength": len(data)}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 8},
                        {"buffer": 0, "byteOffset": 8, "byteLength": 24},
                        {"buffer": 0, "byteOffset": 32, "byteLength": 48},
                        {"buffer": 0, "byteOffset": 80, "byteLength": 12}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
                      {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3"},
                      {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, 0, -1],
                       "max": [1, 0, 1]},
                      {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}],
        "animations": [{"samplers": [{"input": 0, "output": 1}],
                        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
    }))
    return path


def test_a_pose_has_a_rotation_of_length_one():
    pose = ringlet.Pose((1, 2, 3), (0, 0, 2, 2), shift=0.5)
    assert pose.position == (1, 2, 3) and pose.shift == 0.5
    assert pose.rotation == pytest.approx((0, 0, math.sqrt(0.5), math.sqrt(0.5)))
    assert eval(repr(pose)) == pose and pose != ringlet.Pose()
    turned = ringlet.Pose.turned((0, math.pi / 2, 0), (1, 0, 0))
    assert turned.rotation == pytest.approx((0, math.sqrt(0.5), 0, math.sqrt(0.5))) and turned.position == (1, 0, 0)
    with pytest.raises(AttributeError):
        pose.shift = 1


def test_built_in_motions_and_their_frames():
    assert "shake" in ringlet.Motion.kinds()
    shake = ringlet.Motion("shake", amplitude=0.05, frequency=2, ease_seconds=0, axis=(0, 0, 2), start=(1, 0, 0))
    for t in (0.0, 0.1, 0.3):
        assert shake.pose_at(t).position == pytest.approx((1, 0, 0.05 * math.sin(2 * math.pi * 2 * t)), abs=1e-12)
    settings = ringlet.Settings(fps=10, steps_per_frame=4)
    poses = shake.frame_poses(3, settings)
    assert poses.shape == (4, 8) and poses[-1, :3] == pytest.approx(shake.pose_at(0.4).position)
    assert poses[0, :3] == pytest.approx(shake.pose_at(0.325).position)
    assert shake.kind == "shake" and shake.seconds is None


def test_motions_by_keys():
    poses = [ringlet.Pose((x, 0, 0)) for x in (0, 1, 3)]
    linear = ringlet.Motion.keyframes(poses, [0, 1, 2], interpolation="linear")
    assert linear.pose_at(1.5).position == pytest.approx((2, 0, 0)) and linear.seconds == 2
    rows = np.zeros((3, 7))
    rows[:, 0], rows[:, 6] = (0, 1, 3), 1
    evenly = ringlet.Motion.keyframes(rows, seconds_per_key=0.5)
    assert evenly.pose_at(0.5).position == pytest.approx((1, 0, 0)) and evenly.kind == "keyframes"


def test_motions_from_files(tmp_path):
    (tmp_path / "walk.bvh").write_text(BVH)
    motion = ringlet.Motion.load(tmp_path / "walk.bvh", metres_per_unit=0.01)
    assert motion.seconds == 1 and motion.warnings == []
    assert motion.pose_at(0.5).position == pytest.approx((0.01, 0.1, 0))
    assert motion.pose_at(1).rotation == pytest.approx((0, 0, math.sqrt(0.5), math.sqrt(0.5)))
    assert "1.7 m tall" in ringlet.Motion.load(tmp_path / "walk.bvh").warnings[0]
    upright = ringlet.Motion.load(tmp_path / "walk.bvh", metres_per_unit=0.01, up="Z")
    assert upright.pose_at(0.5).position == pytest.approx((0.01, 0, 0.1))
    # An axis that is stated is turned to the world's.
    turned = ringlet.Motion.load(tmp_path / "walk.bvh", metres_per_unit=0.01, file_up="Z")
    assert turned.pose_at(0.5).position == pytest.approx((0.01, 0, -0.1)) and turned.warnings == []
    assert ringlet.Motion.load(gltf(tmp_path / "walk.gltf")).pose_at(0.5).position == pytest.approx((0.5, 0, 0))
    with pytest.raises(ringlet.Error, match="did you mean Head"):
        ringlet.Motion.load(tmp_path / "walk.bvh", joint="Haed")


def test_bodies_know_how_far_points_are():
    points = np.float32([[0, 0.5, 0], [0, 0, 0], [2, 0, 0]])
    sphere = ringlet.Body.sphere(0.25, name="ball", position=(0, 0.5, 0))
    assert sphere.distances(points) == pytest.approx([-0.25, 0.25, math.hypot(2, 0.5) - 0.25])
    assert sphere.distances(points, ringlet.Pose()) == pytest.approx([0.25, -0.25, 1.75])
    assert (sphere.name, sphere.shape) == ("ball", "sphere")
    assert ringlet.Body.plane().distances(points) == pytest.approx([0.5, 0, 0])
    assert ringlet.Body.box((1, 1, 1), thickness=0.5).distances(points) == pytest.approx([-1, -1.5, 0.5])
    assert ringlet.Body.capsule(0.5, 2).distances(points) == pytest.approx([-0.5, -0.5, 1.5])


def test_meshes_made_and_read(tmp_path):
    points, triangles = ringlet.make_head_mesh()
    assert points.shape[1] == triangles.shape[1] == 3 and triangles.max() == len(points) - 1
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6],
             [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    with open(tmp_path / "box.obj", "w") as file:
        file.writelines("v {} {} {}\n".format(*corner) for corner in corners)
        file.writelines("f {} {} {}\n".format(*(i + 1 for i in face)) for face in faces)
    read_points, read_triangles = ringlet.read_mesh(tmp_path / "box.obj", metres_per_unit=0.5)
    assert np.array_equal(read_points, corners / 2) and np.array_equal(read_triangles, faces)
    box = ringlet.Body.mesh(read_points, read_triangles, cells=16)
    assert box.shape == "mesh" and box.warnings == []
    assert box.distances(np.float32([[0, 0, 0.25], [0, 0, 0.625]])) == pytest.approx([-0.25, 0.125], abs=0.02)
    assert ringlet.Body.mesh(read_points, read_triangles[:-1], cells=16).warnings  # it has a hole
