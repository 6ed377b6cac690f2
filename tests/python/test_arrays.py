# Arrays: what holds the numbers that are meant is taken, whatever its type and strides; what does not is refused.
import math

import numpy as np
import pytest

import ringlet

POINTS = np.float32([[0, 0, 0], [0.5, -1, 0], [0, -2, 0.25], [1, 0, 0], [1, -1, 0], [1, -2, 0]])


def wide(points):
    """The same rows, each second one of a wider array."""
    room = np.full((2 * len(points), 5), 7, points.dtype)
    room[::2, 1:4] = points
    return room[::2, 1:4]


# Each holds the same numbers.
SAME = {
    "float64": POINTS.astype(np.float64),
    "float16": POINTS.astype(np.float16),
    "long double": POINTS.astype(np.longdouble),
    "big endian": POINTS.astype(">f4"),
    "big endian float64": POINTS.astype(">f8"),
    "Fortran's order": np.asfortranarray(POINTS),
    "strided": wide(POINTS),
    "strided float64": wide(POINTS.astype(np.float64)),
    "backwards": POINTS[::-1].copy()[::-1],
    "masked without a mask": np.ma.array(POINTS),
    "masked with nothing masked": np.ma.array(POINTS, mask=False),
    "read only": np.frombuffer(POINTS.tobytes(), np.float32).reshape(-1, 3),
    "a subclass": POINTS.view(np.matrix),
}


@pytest.mark.parametrize("name", SAME)
def test_the_same_numbers_are_the_same_points(tmp_path, name):
    groom = ringlet.Groom(SAME[name], counts=[3, 3])
    assert np.array_equal(groom.points, POINTS)
    assert np.array_equal(groom.with_points(SAME[name]).points, POINTS)
    assert ringlet.positions_hash(SAME[name]) == ringlet.positions_hash(POINTS)
    with ringlet.AnimationWriter(tmp_path / "a.rgc", groom) as animation:
        animation.write_points(SAME[name])
    assert np.array_equal(next(iter(ringlet.AnimationReader(tmp_path / "a.rgc"))), POINTS)


def test_whole_numbers_are_points():
    groom = ringlet.Groom(np.round(POINTS).astype(np.int64), counts=[3, 3])
    assert np.array_equal(groom.points, np.round(POINTS))


def test_what_float32_does_not_hold_is_refused():
    for number in (1e39, -1e300):
        points = POINTS.astype(np.float64)
        points[4, 1] = number
        with pytest.raises(ValueError, match="particle 4 has .* float32 does not hold"):
            ringlet.Groom(points, counts=[3, 3])


# The names of arguments, how they are given, and whether they hold complex and masked ones as arrays do.
def test_every_argument_refuses_what_is_masked_or_complex(device, swatch):
    asset = ringlet.Asset(device, swatch, features=["bodies", "roots", "forces", "goals", "fields"])
    hair = ringlet.Hair(asset)
    count, strands = swatch.particle_count, swatch.strand_count
    steps = asset.settings.steps_per_frame
    places = np.zeros((count, 3), np.float32)
    poses = np.tile([0.0, 0, 0, 0, 0, 0, 1], (steps, 1))
    roots = np.tile([0.0, 0, 0, 0, 0, 0, 1], (steps, strands, 1))
    keys = np.tile([0.0, 0, 0, 0, 0, 0, 1], (3, 1))
    triangle = np.eye(3)
    calls = {
        "forces": (places, hair.set_forces),
        "places": (places, lambda a: hair.set_goals(a, 1)),
        "strengths": (np.ones(count), lambda a: hair.set_goals(places, a)),
        "positions": (places, lambda a: hair.set_state(a, places)),
        "velocities": (places, lambda a: hair.set_state(places, a)),
        "head": (poses, hair.step),
        "root_poses": (roots, lambda a: hair.step(poses, root_poses=a)),
        "root_shifts": (np.zeros((strands, 3)), lambda a: ringlet.Hair(asset, root_shifts=a)),
        "roots": (roots[0], lambda a: ringlet.Hair(asset, roots=a)),
        "keys": (keys, ringlet.Motion.keyframes),
        "times": (np.arange(3.0), lambda a: ringlet.Motion.keyframes(keys, a)),
        "rotation": (np.float64([0, 0, 0, 1]), lambda a: ringlet.Pose(rotation=a)),
        "position": (np.zeros(3), ringlet.Pose),
        "mesh": (triangle, lambda a: ringlet.Body.mesh(a, [[0, 1, 2]])),
        "grid": (np.zeros((2, 2, 2, 3)), lambda a: ringlet.Field(grid=a, drag=1)),
        "counts": (np.full(2, 3), lambda a: ringlet.Groom(POINTS, counts=a)),
        "first_point": (np.int64([0, 3, 6]), lambda a: ringlet.Groom(POINTS, a)),
    }
    for name, (good, call) in calls.items():
        if name != "mesh":  # one triangle closes nothing
            call(good)
        flat = np.zeros(good.shape, bool)
        flat[tuple(0 for _ in good.shape)] = True
        for wrong in (good.astype(complex), np.ma.array(good, mask=flat)):
            with pytest.raises((TypeError, ValueError)):
                call(wrong)
                pytest.fail(f"{name} takes {type(wrong).__name__} of {wrong.dtype}")


# A number: Python's, NumPy's, an array of no dimension; none that is more than a number, or less.
def test_numbers():
    for good in (1, 1.0, np.float32(1), np.int64(1), np.array(1.0), np.float16(1)):
        assert ringlet.Settings(gravity=(0, good, 0)).gravity == (0, 1, 0)
        assert ringlet.Material(bend_stiffness=good).bend_stiffness == 1
    for wrong in (1j, np.complex64(1), np.array(1j), True, np.bool_(True), "1", b"1", None, np.ma.masked,
                  np.ma.array(1.0, mask=True), [1], np.ones(1, complex)):
        for call in (lambda: ringlet.Settings(gravity=(0, wrong, 0)), lambda: ringlet.Material(bend_stiffness=wrong),
                     lambda: ringlet.Material({"variation.seed": wrong})):
            with pytest.raises((TypeError, ValueError)):
                call()


# Every number that hair takes: what is not finite, and what float32 makes nothing of, is refused, or hair stays somewhere.
def test_numbers_that_hair_cannot_have(device, swatch):
    asset = ringlet.Asset(device, swatch, features=["bodies", "roots", "forces", "goals", "fields"])
    count, strands, steps = swatch.particle_count, swatch.strand_count, asset.settings.steps_per_frame
    turned = np.float64([0, 0, 0, 0, 0, 0, 1])

    def array(*shape, value, fill=0.0):
        made = np.full(shape, fill)
        made[(-1,) * len(shape)] = value
        return made

    def pose(value, *shape):
        made = np.tile(turned, (*shape, 1))
        made[(-1,) * len(shape) + (1,)] = value
        return made

    def goals(hair, places=0.0, strengths=1.0, damping=1.0):
        hair.set_goals(array(count, 3, value=places), array(count, value=strengths, fill=1.0), damping)

    calls = {
        "forces": lambda hair, v: hair.set_forces(array(count, 3, value=v)),
        "places": lambda hair, v: goals(hair, places=v),
        "strengths": lambda hair, v: goals(hair, strengths=v),
        "damping": lambda hair, v: goals(hair, damping=v),
        "positions": lambda hair, v: hair.set_state(array(count, 3, value=v), array(count, 3, value=0)),
        "velocities": lambda hair, v: hair.set_state(hair.positions(), array(count, 3, value=v)),
        "head": lambda hair, v: hair.step(ringlet.Pose((v, 0, 0))),
        "shift": lambda hair, v: hair.step(ringlet.Pose(shift=v)),
        "poses": lambda hair, v: hair.step(pose(v, steps)),
        "root_poses": lambda hair, v: hair.step(root_poses=pose(v, steps, strands)),
        "body place": lambda hair, v: hair.set_bodies([ringlet.Body.sphere(0.01, position=(v, 0, 0))]),
        "body radius": lambda hair, v: hair.set_bodies([ringlet.Body.sphere(v)]),
        "friction": lambda hair, v: hair.set_bodies([ringlet.Body.sphere(0.01, friction=v)]),
        "field place": lambda hair, v: hair.set_fields([ringlet.Field(position=(v, 0, 0), radial=1)]),
        "field force": lambda hair, v: hair.set_fields([ringlet.Field(radial=v)]),
        "field drag": lambda hair, v: hair.set_fields([ringlet.Field(axial=1, drag=v)]),
        "field grid": lambda hair, v: hair.set_fields([ringlet.Field(grid=array(2, 2, 2, 3, value=v), drag=1)]),
        "gravity": lambda hair, v: hair.set_settings(gravity=(0, v, 0)),
        "fps": lambda hair, v: hair.set_settings(fps=v),
        "bend_stiffness": lambda hair, v: hair.set_material(bend_stiffness=v),
        "seed": lambda hair, v: hair.set_material(**{"variation.seed": v}),
    }
    for name, call in calls.items():
        for value in (math.nan, math.inf, -math.inf, -1.0, 1e6, 1e30, 3e38, 1e300):
            hair = ringlet.Hair(asset)
            try:
                call(hair, value)
            except (ValueError, TypeError, ringlet.Error):
                continue
            assert math.isfinite(value), f"{name} takes {value}"
            hair.step()
            assert hair.report()["nonfinite"] == 0, f"{name} takes {value}, and hair is nowhere"
