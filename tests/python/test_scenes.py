# Whole scenes: the bits of `ringlet simulate` and `ringlet scene` in every kind of scene, and callbacks.
import json

import numpy as np
import pytest

import ringlet
from test_motion import BVH, gltf

SWATCH = """
[groom]
generate = "swatch"
columns = 3
rows = 2
particles = 32
[simulation]
frames = 5
steps_per_frame = 4
"""
SCENES = {
    "cut": SWATCH + '[motion]\nkind = "shake"\npre_roll = 0.1\n[[cut]]\nstrands = "1"\ntime = -0.05\nat = 0.7\n[[cut]]\n'
                    'time = 0.08\n[[key]]\ntime = 0\nmaterial.dials.hold = 1\n[[key]]\ntime = 0.15\n'
                    'material.dials.hold = 2\n',
    "shake": SWATCH + '[motion]\nkind = "shake"\n',
    "pre-roll": SWATCH + '[motion]\nkind = "nod"\npre_roll = 0.1\nstart = [0.5, 1, 0]\n',
    "keys": SWATCH + '[motion]\n[[motion.key]]\ntime = 0\n[[motion.key]]\ntime = 0.15\nposition = [0.05, 0, 0]\n',
    "material": SWATCH + '[motion]\nkind = "shake"\n[material]\npreset = "coil"\n'
                         '[material.dials]\nhold = 0.5\nbounce = 0.5\n',
    "air": SWATCH + '[motion]\nkind = "still"\n[air]\nwind = [3, 0, 0]\nturbulence = 0.5\ngust = 1\n',
    "contacts": SWATCH + '[motion]\nkind = "shake"\n[contacts]\nradius = 0.008\n',
    "bodies": SWATCH + '[motion]\nkind = "shake"\n[[body]]\nshape = "sphere"\nradius = 0.05\n'
                       'position = [0, -0.2, 0]\n[[body]]\nshape = "plane"\nposition = [0, -0.24, 0]\n'
                       'moves = { kind = "nod" }\n',
    "bvh": SWATCH + '[motion]\nfile = "walk.bvh"\nunit = 0.01\nstart = [0, 0, 1]\n',
    "jump": SWATCH + '[motion]\n[[motion.key]]\ntime = 0\n[[motion.key]]\ntime = 0.1\nposition = [9, 0, 0]\n',
    "length": SWATCH.replace("frames = 5\n", "") + '[motion]\n[[motion.key]]\ntime = 0\n[[motion.key]]\ntime = 0.3\n'
                                                  'position = [0.05, 0, 0]\n',
    "seconds": SWATCH.replace("frames = 5", "seconds = 0.15") + '[motion]\nkind = "nod"\n',
    "scalp": SWATCH + '[motion]\nkind = "shake"\n[scalp]\nfile = "walk.gltf"\nfarthest = 0.1\n',
    "gltf": SWATCH + '[motion]\nfile = "walk.gltf"\n[[body]]\nshape = "sphere"\nradius = 0.04\njoint = "Head"\n'
                     'position = [0, -0.2, 0]\n',
    "roots": SWATCH + '[motion]\nkind = "shake"\n[motion.roots]\nshift = [0.01, 0, 0]\nease = 0.1\n',
    "fields": SWATCH + '[motion]\nkind = "shake"\npre_roll = 0.1\n[[field]]\nname = "fan"\nkind = "vortex"\ndrag = 5\n'
                       'bind = "head"\n[[field]]\nkind = "grid"\nfile = "smoke.npy"\ncell = 0.3\n'
                       'position = [-1, -1, -1]\nstrength = 2\n[[key]]\ntime = 0\nfield.fan.strength = 0\n[[key]]\n'
                       'time = 0.2\nfield.fan.strength = 6\n',
    "holds": SWATCH + '[motion]\nkind = "shake"\n[goal]\nstrength = 0.1\n[[hold]]\nstrands = "0:3"\nbegin = 0.5\n'
                      'gather = 0.3\nbind = "world"\nrelease = 0.1\n',
    "paper": SWATCH.replace("steps_per_frame = 4", 'steps_per_frame = 30\nintegrator = "paper"') +
             '[motion]\nkind = "shake"\n',
    "steps": SWATCH.replace("steps_per_frame = 4\n", "max_stretch = 1.005\n") + '[motion]\nkind = "shake"\n',
    "placed": SWATCH.replace("particles = 32", "particles = 32\nscale = 0.5\nrotate_degrees = [0, 0, 30]\n"
                                               "offset = [0.1, 0, 0]\nup = \"Z\"") + '[motion]\nkind = "walk"\n',
}


@pytest.mark.parametrize("name", SCENES)
def test_a_scene_file_has_the_bits_of_the_program(device, program, name):
    (program.folder / "walk.bvh").write_text(BVH)
    gltf(program.folder / "walk.gltf")
    np.save(program.folder / "smoke.npy", np.random.default_rng(1).normal(size=(8, 7, 6, 3)).astype(np.float32))
    (program.folder / "scene.toml").write_text(SCENES[name])
    told = program("simulate", "scene.toml", "-o", "out", "--untuned", "--quiet")
    scene = ringlet.Scene.load(program.folder / "scene.toml")
    numbers = []
    run = scene.run(lambda frame: numbers.append((frame.number, ringlet.positions_hash(frame.positions),
                                                   frame.points())), device=device)
    assert [number for number, _, _ in numbers] == list(range(1, told["frames"] + 1))
    assert numbers[-1][1] == told["positions_hash"] == run.positions_hash
    assert run.report["kernel"] == told["kernel"] and scene.settings.steps_per_frame == told["steps_per_frame"]
    assert set(told["warnings"]) >= set(scene.warnings)
    # Every frame, as the files have it.
    frames = list(ringlet.AnimationReader(program.folder / "out/hair.usda"))
    assert len(frames) == len(numbers)
    for points, (_, _, seen) in zip(frames, numbers):
        assert np.array_equal(points, seen)
    last = ringlet.read_groom(program.folder / "out/last.obj", scene.groom.metres_per_unit)
    assert np.array_equal(last.points, run.points())


# Every kind of value, of tables that the file has, has in a list, and lacks.
def test_changes_are_those_of_a_sweep(device, program):
    (program.folder / "scene.toml").write_text(SCENES["bodies"])
    scene = program.folder / "scene.toml"
    changes = {"material.dials.hold": 2, "body.1.radius": np.float64(0.06), "simulation.steps_per_frame": np.int64(3),
               "contacts.on": np.bool_(True), "contacts.radius": 0.02, "material.preset": "coil", "air.wind": (2, 0.5, 0),
               "air.gust": 0.5}
    texts = ["2,1", "0.06", "3", "true", "0.02", "coil", "[2, 0.5, 0]", "0.5"]
    others = [1, 0.05, 2, False, 0.015, "ringlet", [0, 0, 1], 0.25]  # each makes a difference
    program("sweep", "scene.toml", *(f"--vary={key}={text}" for key, text in zip(changes, texts)), "-o", "sweep",
            "--untuned", "--quiet", "--last-only", tells=False)

    def hash_of(changes):
        return ringlet.Scene.load(scene, changes=changes).run(device=device).positions_hash

    told = [json.loads((program.folder / f"sweep/run-000{run}/run.json").read_text())["positions_hash"] for run in (1, 2)]
    assert hash_of(changes) == told[0]
    assert hash_of(changes | {"material.dials.hold": 1}) == told[1]
    for key, other in zip(changes, others):
        assert hash_of(changes | {key: other}) != told[0], key
    with pytest.raises(TypeError, match="a key of a scene is a text, got 1"):
        ringlet.Scene.load(scene, changes={1: 2})
    parsed = ringlet.Scene.parse(scene.read_text(), changes=changes)
    assert parsed.run(device=device).positions_hash == told[0]
    with pytest.raises(ringlet.Error, match="no_such_key"):
        ringlet.Scene.load(scene, changes={"material.no_such_key": 1})
    for wrong in (None, {1: 2}, object(), b"coil"):
        with pytest.raises(TypeError, match="a change is a number, a bool, a text or a list of these"):
            ringlet.Scene.load(scene, changes={"material.preset": wrong})


@pytest.mark.parametrize("name", ["hanging_curl", "two_curls", "walk_head", "bust"])
def test_a_built_in_scene_has_the_bits_of_the_program(device, program, name):
    small = {} if name == "two_curls" else {"strands": 4}
    told = program("scene", name, "--untuned", "--quiet", "--seconds", "0.2", "--particles", "16", "--contacts", "off",
                   *(["--strands", "4"] if small else []))
    scene = ringlet.Scene.builtin(name, seconds=0.2, particles=16, contacts=False, **small)
    assert scene.frame_count == told["frames"]
    assert ringlet.positions_hash(scene.run(device=device).positions()) == told["positions_hash"]


def test_scenes_have_names_and_parts():
    assert "hanging_curl" in ringlet.Scene.names()
    scene = ringlet.Scene.builtin("walk_head", strands=10)
    assert scene.groom.strand_count == 10 and [body.shape for body in scene.bodies] == ["mesh"]
    assert scene.motion.kind == "walk" and scene.summary == ringlet.Scene.names()["walk_head"]
    shifts = ringlet.Scene.builtin("two_curls").root_shifts
    assert shifts.shape == (2, 3) and np.array_equal(shifts[0], -shifts[1])
    assert ringlet.Scene.parse(SCENES["pre-roll"]).pre_roll_seconds == 0.1


def test_a_scene_of_a_wrong_unit_says_so():
    (sentence,) = ringlet.Scene.parse(SWATCH.replace("[simulation]", "scale = 0.01\n[simulation]")).warnings
    assert "strands are " in sentence and "mm long on average" in sentence
    assert ringlet.Scene.parse(SWATCH).warnings == []


def test_placement_is_checked_with_bodies_and_head():
    groom = ringlet.make_head(strands=20)
    assert ringlet.check_placement(groom) == []
    beside = ringlet.Body.sphere(0.05, name="beside", position=(3, 0, 0))
    (sentence,) = ringlet.check_placement(groom, [beside], ringlet.Pose((0, 1, 0)))
    assert "beside" in sentence


def test_a_scene_stepped_by_hand_has_the_bits_of_its_run(device):
    scene = ringlet.Scene.parse(SCENES["bodies"])
    expected = scene.run(device=device).positions()
    hair = scene.start(device)
    for frame in range(scene.frame_count):
        head, bodies, roots = scene.frame_poses(frame)
        assert head.shape == (4, 8) and bodies.shape == (4, 2, 7) and roots is None
        hair.step(head, body_poses=bodies)
    assert np.array_equal(hair.positions(), expected)


def ball(share):
    """Points and triangles of an octahedron of 6 cm that swells by half."""
    points = np.concatenate([np.eye(3), -np.eye(3)]) * 0.03 * (1 + 0.5 * share) - (0, 0.1, 0)
    corners = [[a, b + 1, c + 2] for a in (0, 3) for b in (0, 3) for c in (0, 3)]
    return points, [t if sum(i > 2 for i in t) % 2 == 0 else t[::-1] for t in corners]


def test_a_scene_with_a_body_that_bends_has_the_bits_of_its_run(device, tmp_path):
    triangles = "".join("f {} {} {}\n".format(*(i + 1 for i in t)) for t in ball(0)[1])
    for k in range(4):
        vertices = "".join("v {:.9g} {:.9g} {:.9g}\n".format(*p) for p in ball(k / 3)[0])
        (tmp_path / f"ball.{k}.obj").write_text(vertices + triangles)
    scene = ringlet.Scene.parse(
        "[groom]\ngenerate = 'swatch'\ncolumns = 2\nrows = 2\nparticles = 12\n"
        "[simulation]\nframes = 3\nfps = 30\nsteps_per_frame = 4\n"
        "[[body]]\nname = 'ball'\nshape = 'mesh'\nfile = 'ball.#.obj'\nunit = 1\ncells = 16\ndeforms = true\n", tmp_path)
    expected = scene.run(device=device).positions()
    by_scene, by_hand, rigid = (scene.start(device) for _ in range(3))
    for frame in range(3):
        scene.step(by_scene, frame)
        head, bodies, _ = scene.frame_poses(frame)
        (points,) = scene.frame_points(frame)
        assert points.shape == (4, 6, 3)
        by_hand.step(head, body_poses=bodies, body_points=[points])
        rigid.step(head, body_poses=bodies)
    assert np.array_equal(by_scene.positions(), expected)
    assert np.array_equal(by_hand.positions(), expected)
    assert not np.array_equal(rigid.positions(), expected)


def test_a_mesh_that_deforms_takes_its_points_from_each_frame(device):
    groom = ringlet.make_swatch(columns=2, rows=2, particles=12)
    grid = ((-0.2, -0.3, -0.2), (0.2, 0.1, 0.2))
    body = ringlet.Body.mesh(*ball(0), deforms=True, grid=grid, cells=16, name="ball")
    assert body.warnings == []
    asset = ringlet.Asset(device, groom)
    one, together, still = (ringlet.Hair(asset, bodies=[body]) for _ in range(3))
    for frame in range(3):
        points = np.stack([ball((frame + share) / 3)[0] for share in (0.5, 1)])
        one.step(body_points=[points])
        ringlet.step_frames([(together, None, None, None, [points])])
        still.step()
    assert np.array_equal(one.positions(), together.positions())
    assert not np.array_equal(one.positions(), still.positions())
    for points, part in (([points, points], "points of 2 bodies, and 1"), ([points[0, :5]], "5 points of bending body 0"),
                         ([points[:, :, :2]], "body_points"), ([points * np.nan], "body_points")):
        with pytest.raises(ValueError, match=part):
            one.step(body_points=points)
    with pytest.raises(TypeError, match="a list with an array for each body"):
        one.step(body_points=points[0])
    for wrong, part in ({"grid": grid[::-1]}, "without room"), ({"cells": 4}, "8 to 256"), ({"grid": [1, 2, 3]}, "two corners"):
        with pytest.raises((ValueError, ringlet.Error), match=part):
            ringlet.Body.mesh(*ball(0), **{"deforms": True, "cells": 16, **wrong})
    for wrong, part in ({"grid": grid}, "deforms=True"), ({"sides": "both"}, "deforms=True"), ({"sides": "in"}, "out or both"):
        with pytest.raises(ValueError, match=part):
            ringlet.Body.mesh(*ball(0), cells=16, **wrong)


def test_cloth_holds_hair_off_both_of_its_sides(device):
    groom = ringlet.make_swatch(columns=2, rows=2, particles=12)
    low, high = groom.points.min(0), groom.points.max(0)
    corners = np.array([[x, 0, z] for z in (low[2] - 1, high[2] + 1) for x in (low[0] - 1, high[0] + 1)])
    triangles = [(0, 2, 1), (1, 2, 3)]
    asset = ringlet.Asset(device, groom)
    for side, start, sweep in (1, low[1] - 0.01, 0.03), (-1, high[1] + 0.01, -0.03):
        sheet = corners + [0, start, 0]
        body = ringlet.Body.mesh(sheet, triangles, deforms=True, sides="both", name="cloth")
        hair = ringlet.Hair(asset, bodies=[body])
        for frame in range(5):  # it goes through half of the strands' length and beyond their tips
            hair.step(body_points=[(sheet + [0, sweep * (frame + 1) / 5, 0])[None]])
        heights = hair.positions()[:, 1].reshape(4, 12)[:, 2:]
        assert (side * (heights - (start + sweep)) > 0.0004).all()


@pytest.mark.parametrize("name", ["cut", "fields", "pre-roll"])
def test_step_does_what_keys_fields_and_cuts_say(device, name, tmp_path):
    smoke = np.zeros((4, 4, 4, 3), np.float32)
    smoke[..., 1] = 1
    np.save(tmp_path / "smoke.npy", smoke)
    scene = ringlet.Scene.parse(SCENES[name], tmp_path)
    expected = scene.run(device=device).positions()
    hair = scene.start(device)
    for frame in range(scene.frame_count):
        scene.step(hair, frame)
    assert np.array_equal(hair.positions(), expected)
    with pytest.raises(ValueError, match="another scene"):
        scene.step(ringlet.Scene.builtin("head_shake", strands=3).start(device), 0)


def test_hair_that_is_cut_falls(device):
    scene = ringlet.Scene.parse(SWATCH + '[motion]\nkind = "still"\n')
    whole, hair = scene.start(device), scene.start(device)
    before = hair.positions()
    hair.cut([(1, 5)])
    for _ in range(6):
        hair.step(ringlet.Pose())
        whole.step(ringlet.Pose())
    first = scene.groom.first_point
    moved = hair.positions() - before
    assert (moved[first[1] + 5:first[2], 1] < -0.2).all() and (moved[first[1]:first[1] + 5, 1] > -0.02).all()
    assert np.array_equal(hair.positions()[:first[1]], whole.positions()[:first[1]])
    with pytest.raises(ringlet.Error, match="strand 1 has 5 particles"):
        hair.cut([(1, 5)])
    hair.submit(ringlet.Pose())
    with pytest.raises(ringlet.Error, match="wait"):
        hair.cut([(0, 5)])
    hair.wait()


def test_a_callback_may_end_the_run(device):
    scene = ringlet.Scene.parse(SCENES["shake"])
    seen = []

    def stop(frame):
        seen.append((frame.number, frame.seconds, frame.head))
        return frame.number < 2

    scene.run(stop, device=device, frames=5)
    assert [number for number, _, _ in seen] == [1, 2]
    assert seen[1][1] == pytest.approx(2 / 24) and seen[1][2] == scene.motion.pose_at(2 / 24)

    def fail(frame):
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        scene.run(fail, device=device)
    scene.run(lambda frame: seen.append(0), device=device, frames=0)
    assert len(seen) == 2


def test_every_frame_has_an_array_of_its_own(device):
    scene = ringlet.Scene.parse(SCENES["shake"])
    kept, copies = [], []
    scene.run(lambda frame: (kept.append(frame.positions), copies.append(frame.positions.copy())), device=device)
    assert all(np.array_equal(a, b) for a, b in zip(kept, copies))
    assert not np.array_equal(kept[0], kept[-1])


def test_a_broken_scene_is_told_with_file_and_line(tmp_path):
    (tmp_path / "scene.toml").write_text('[groom]\ngenerate = "curl"\n[simulation]\nfraems = 3\n')
    with pytest.raises(ringlet.Error, match=r"scene.toml.*4.*did you mean simulation.frames"):
        ringlet.Scene.load(tmp_path / "scene.toml")
    (tmp_path / "scene.toml").write_text('[groom]\nfile = "missing.obj"\n')
    with pytest.raises(ringlet.Error, match="missing.obj") as error:
        ringlet.Scene.load(tmp_path / "scene.toml")
    assert error.value.fault == "input"


GROOM = '[groom]\nfile = "groom.obj"\n'
# A table, one of several tables, and where a run writes; tests/scene/scene_paths_test.cpp tries every key.
PATHS = {
    "groom.file": '[groom]\nfile = "PATH"\n',
    "body.file": GROOM + '[[body]]\nshape = "mesh"\nfile = "PATH"\n',
    "output.folder": GROOM + '[output]\nfolder = "PATH"\n',
}


@pytest.mark.parametrize("key", PATHS)
def test_a_confined_scene_names_nothing_outside_its_folder(tmp_path, key):
    folder = tmp_path / "scene"
    (folder / "below").mkdir(parents=True)
    for path in (tmp_path / "m.toml", folder / "below/m.toml"):
        path.write_text("line_density = 1e-5\n")
    (folder / "groom.obj").write_text("v 0 0 0\nv 0 -1 0\nl 1 2\n")
    (folder / "link.toml").symlink_to("../m.toml")

    def refusal(path, **confined):
        text = PATHS[key].replace("PATH", str(path))
        (folder / "scene.toml").write_text(text)
        sentences = []
        for read in (lambda: ringlet.Scene.load(folder / "scene.toml", **confined),
                     lambda: ringlet.Scene.parse(text, folder, **confined)):
            try:
                read()
                sentences.append("")
            except ringlet.Error as error:
                sentences.append(str(error))
        return sentences

    for outside in ("../m.toml", tmp_path / "m.toml", "below/../../m.toml", "link.toml", "/etc/passwd"):
        for sentence in refusal(outside, confined=True):
            assert key in sentence and "to which it is confined" in sentence
        for sentence in refusal(outside) + refusal(outside, confined=False):
            assert "it is confined" not in sentence
    for sentence in refusal("below/m.toml", confined=True):  # wrong perhaps, and in its place
        assert "it is confined" not in sentence


def test_a_confined_scene_runs_as_it_is(tmp_path, device):
    (tmp_path / "groom.obj").write_text("v 0 0 0\nv 0 -1 0\nv 0 -2 0\nl 1 2 3\n")
    (tmp_path / "scene.toml").write_text(GROOM + '[simulation]\nframes = 2\nsteps_per_frame = 4\n')
    hairs = [ringlet.Scene.load(tmp_path / "scene.toml", confined=confined).run(device=device) for confined in (False, True)]
    assert np.array_equal(hairs[0].positions(), hairs[1].positions())
    for wrong in ("yes", None, 1, 2.5):
        with pytest.raises(TypeError):
            ringlet.Scene.load(tmp_path / "scene.toml", confined=wrong)
