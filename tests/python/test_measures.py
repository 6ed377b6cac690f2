# Measures: closed forms, and the numbers of the program.
import numpy as np
import pytest

import ringlet


def helix(turns=6.0, radius=0.01, length=0.3):
    return ringlet.make_curl(turns=turns, radius=radius, length=length, particles=200, metres_per_unit=1)


def test_a_shape_beside_itself_and_moved_down():
    groom = helix()
    same = ringlet.measure_shape(groom, groom.points)
    assert same["droop"] == pytest.approx([0], abs=1e-9) and same["core_elongation"] == pytest.approx([1])
    assert same["turns"] == pytest.approx([6], rel=0.03) and same["mean_radius"] == pytest.approx([0.01], rel=0.02)
    longer = groom.points * np.float32([1, 1.5, 1])
    assert ringlet.measure_shape(groom, longer)["droop"] == pytest.approx([0.15], rel=1e-3)
    assert ringlet.measure_shape(groom, longer, up=(0, -1, 0))["droop"] == pytest.approx([-0.15], rel=1e-3)
    half = ringlet.measure_shape(groom, groom.points * 2, metres_per_unit=0.5)
    assert half["droop"] == pytest.approx([0], abs=1e-6)


def test_a_turned_head_turns_what_is_at_rest():
    groom = ringlet.make_swatch(columns=3, rows=3, particles=64, metres_per_unit=1)
    turn = ringlet.Pose.turned((0.5, 0, 0))
    c, s = np.cos(0.5), np.sin(0.5)
    turned = (groom.points @ np.float32([[1, 0, 0], [0, c, s], [0, -s, c]])).astype(np.float32)
    for rotation in (turn, turn.rotation, None):  # None: from the roots
        assert ringlet.measure_shape(groom, turned, head_rotation=rotation)["droop"] == pytest.approx([0] * 9, abs=1e-5)
    assert np.abs(ringlet.measure_shape(groom, turned, head_rotation=ringlet.Pose())["droop"]).min() > 0.01


def test_distances_of_shapes():
    groom = helix()
    same = ringlet.shape_distance(groom, groom.points, groom.points)
    assert all(abs(values[0]) < 1e-9 for values in same.values())
    moved = ringlet.shape_distance(groom, groom.points, groom.points * np.float32([1, 0.9, 1]))
    assert moved["tip"][0] == pytest.approx(0.03 / np.hypot(0.3, 2 * np.pi * 0.06), rel=0.02)


def test_crossings_are_counted():
    points = np.float32([[-1, 0, 0], [1, 0, 0], [0, -1, 1], [0, 1, 1]])
    groom = ringlet.Groom(points, counts=[2, 2])
    through = points.copy()
    through[2:, 2] = -1
    assert ringlet.count_crossings(groom, points, through) == 1
    assert ringlet.count_crossings(groom, points, points) == 0


def test_a_motion_is_measured_as_the_program_measures_it(device, program):
    scene = ringlet.Scene.builtin("bounce", seconds=1.0, particles=32)
    told = program("scene", "bounce", "--untuned", "--quiet", "--seconds", "1", "--particles", "32")
    measure = ringlet.MotionMeasure(scene.groom, fps=scene.settings.fps, line_density=scene.material.line_density)
    measure.add_frame(scene.groom.points, head_rotation=ringlet.Pose())
    scene.run(lambda frame: measure.add_frame(frame.points(), head_rotation=frame.head), device=device)
    report = measure.report()
    assert measure.frame_count == report["frames"] == told["frames"] + 1
    known = {"core_elongation", "turns", "handedness_kept", "arc_drift", "tip_rotation_deg", "bounce_hz", "sway_hz",
             "energy_ratio", "worst_core_elongation", "worst_tip_rotation_deg"} & set(told)
    assert len(known) >= 8
    for key in known:
        assert report[key] == (pytest.approx(told[key], rel=1e-9) if told[key] is not None else None), key
    assert measure.strands()["droop"].shape == (1,)


def test_contacts_are_watched():
    way = np.linspace(-1, 1, 41, dtype=np.float32)
    zero = np.zeros(41, np.float32)
    points = np.concatenate([np.stack([way, zero, zero], 1), np.stack([zero, way, zero + 1], 1)])
    groom = ringlet.Groom(points, counts=[41, 41], metres_per_unit=1)
    watch = ringlet.ContactWatch(groom, settings=ringlet.Settings(contacts={"radius": 0.1}))
    watch.add_step(points)
    through = points.copy()
    for z in (0.5, 0.05, -0.5):
        through[41:, 2] = z
        watch.add_step(through)
        watch.end_frame()
    assert watch.numbers()["crossings"] == 1
    # Spheres stand 0.15 m apart from the roots on, the nearest 0.05 m off along each axis; two radii are 0.2 m.
    assert watch.numbers()["deepest_overlap"] == pytest.approx(1 - np.sqrt(3 * 0.05**2) / 0.2, abs=1e-5)


def test_bodies_are_watched():
    points = np.float32([[0, 1, 0], [0, 0.5, 0], [0, 0.25, 0]])
    groom = ringlet.Groom(points, counts=[3], metres_per_unit=1)
    watch = ringlet.BodyWatch(groom, [ringlet.Body.plane()])
    watch.look(points)
    sunk = points.copy()
    sunk[2, 1] = -0.125
    watch.look(sunk)
    assert watch.numbers() == {"deepest": 0.125, "strand": 0, "particle": 2, "frame": 1, "inside": 0}
    watch.look(points, body_poses=[ringlet.Pose((0, 0.375, 0))])
    watch.look(points, head=ringlet.Pose((0, -1, 0)), body_poses=[ringlet.Pose((0, 0, 0))])
    assert watch.numbers()["deepest"] == pytest.approx(0.75) and watch.numbers()["frame"] == 3
