# Hair on the device: the bits of the program's, views, frames in flight, several heads, what changes while it moves.
import gc
import threading
import time

import numpy as np
import pytest

import ringlet
from conftest import shaken


def moved(hair, frames=3):
    """Positions after some frames of a shaken head."""
    steps = hair.settings.steps_per_frame
    for frame in range(frames):
        hair.step(shaken(frame, steps))
    return hair.positions()


def test_a_step_moves_hair_and_leaves_roots_on_the_head(hair, swatch):
    rest = hair.positions()
    assert rest.dtype == np.float32 and rest.shape == (192, 3)
    assert rest == pytest.approx(swatch.points * np.float32(swatch.metres_per_unit), abs=1e-6)
    hair.step(ringlet.Pose((0.02, 0, 0)))
    now = hair.positions()
    roots = swatch.first_point[:-1]
    assert now[roots] == pytest.approx(rest[roots], abs=1e-6)  # seen from the head
    assert np.abs(now - rest).max() > 1e-3
    assert hair.points()[roots] == pytest.approx(swatch.points[roots] + [2, 0, 0], abs=1e-3)
    assert hair.head == ringlet.Pose((0.02, 0, 0))
    assert hair.report()["nonfinite"] == 0 and hair.report()["max_edge_stretch"] > 1


def test_the_same_run_has_the_same_bits(asset):
    assert np.array_equal(moved(ringlet.Hair(asset)), moved(ringlet.Hair(asset)))


def test_positions_go_into_an_array_of_the_callers(hair):
    moved(hair, 1)
    out = np.zeros((192, 3), np.float32)
    assert hair.positions(out=out) is out and np.array_equal(out, hair.positions())
    part = np.zeros((400, 3), np.float32)
    assert np.array_equal(hair.positions(out=part[100:292]), out)
    assert np.array_equal(part[100:292], out) and not part[:100].any() and not part[292:].any()
    assert hair.points(out=out) is out and hair.velocities(out=out) is out
    assert np.array_equal(out, hair.velocities())


def test_arrays_outlive_the_hair(asset):
    hair = ringlet.Hair(asset)
    positions = moved(hair)
    kept = positions.copy()
    del hair
    gc.collect()
    junk = [np.full((192, 3), 9, np.float32) for _ in range(1000)]
    assert np.array_equal(positions, kept) and positions.flags.writeable
    del junk


def test_everything_keeps_what_it_needs_alive(swatch):
    def make():
        groom = swatch.with_points(swatch.points)
        return ringlet.Hair(ringlet.Asset(ringlet.Device(), groom))

    hair = make()
    gc.collect()
    hair.step(ringlet.Pose((0.01, 0, 0)))
    assert np.isfinite(hair.positions()).all() and hair.asset.groom.strand_count == 6


def test_frames_in_flight_have_the_bits_of_one_by_one(asset):
    one, two = ringlet.Hair(asset), ringlet.Hair(asset)
    expected = []
    for frame in range(4):
        one.step(shaken(frame, 4))
        expected.append(one.positions())
    two.submit(shaken(0, 4))
    for frame in range(1, 4):
        two.submit(shaken(frame, 4))
        two.wait()
        assert np.array_equal(two.positions(), expected[frame - 1])
    two.wait()
    assert np.array_equal(two.positions(), expected[3])


def test_two_heads_in_one_submission_have_the_bits_of_each_alone(asset):
    alone = [ringlet.Hair(asset) for _ in range(2)]
    together = [ringlet.Hair(asset, head=ringlet.Pose()) for _ in range(2)]
    for frame in range(3):
        ways = [shaken(frame, 4), shaken(frame + 5, 4)]
        for hair, way in zip(alone, ways):
            hair.step(way)
        ringlet.step_frames(zip(together, ways))
    for a, b in zip(alone, together):
        assert np.array_equal(a.positions(), b.positions())
    assert not np.array_equal(together[0].positions(), together[1].positions())
    ringlet.step_frames([])


def test_live_settings_change_the_motion(asset):
    still, weightless = ringlet.Hair(asset), ringlet.Hair(asset)
    weightless.set_settings(gravity=(0, 0, 0))
    assert weightless.settings.gravity == (0, 0, 0) and still.settings.gravity == (0, -9.81, 0)
    for hair in (still, weightless):
        for _ in range(3):
            hair.step()
    assert (weightless.positions()[:, 1] - still.positions()[:, 1]).mean() > 1e-3
    settings = weightless.settings
    settings.steps_per_frame = 2
    settings.fps = 48
    weightless.set_settings(settings)
    weightless.step(shaken(0, 2))
    with pytest.raises(ValueError, match="each of its 2 steps, got 4"):
        weightless.step(shaken(0, 4))


def test_what_is_not_live_is_refused_by_name_and_nothing_changes(hair):
    for row in ringlet.Settings.fields():
        if row["live"] or row["key"] == "integrator":
            continue
        settings, default = hair.settings, row["default"]
        settings[row["key"]] = (not default if isinstance(default, bool) else row["choices"][-1] if row["choices"]
                                else 0.5 * (row["low"] + row["high"]) if isinstance(default, float) or default is None
                                else int(row["high"]))
        with pytest.raises(ringlet.Error, match=row["key"]):
            hair.set_settings(settings)
        assert hair.settings[row["key"]] == default
    hair.step()


def test_a_live_material_changes_the_motion(asset):
    firm, soft = ringlet.Hair(asset), ringlet.Hair(asset)
    soft.set_material(bend_stiffness=0.5)
    assert soft.material.bend_stiffness == 0.5 and firm.material.bend_stiffness == 5
    assert np.abs(moved(firm) - moved(soft)).max() > 1e-4
    soft.set_material(asset.material)
    assert soft.material == firm.material
    with pytest.raises(ringlet.Error, match="line_density"):
        soft.set_material(line_density=1)
    with pytest.raises(KeyError, match="did you mean bend_stiffness"):
        soft.set_material(bend_stifness=1)


def test_dials_work_into_the_material(device, swatch):
    material = ringlet.Material(**{"dials.hold": 2, "dials.bounce": 0.25})
    asset = ringlet.Asset(device, swatch, material)
    assert asset.material.bend_stiffness == 10 and asset.material.inertia_factor == 0.25
    assert asset.settings == ringlet.Settings()
    assert ringlet.Asset(device, swatch).settings == ringlet.Settings()


def test_bodies_keep_hair_out_and_may_change(device, swatch):
    # A floor that comes up to the middle of the hair.
    asset = ringlet.Asset(device, swatch, settings=ringlet.Settings(steps_per_frame=4), features=["bodies"])
    floor = ringlet.Body.plane(friction=0)
    free = ringlet.Hair(asset)
    kept = ringlet.Hair(asset, bodies=[floor], body_places=[ringlet.Pose((0, -0.3, 0))])
    for frame in range(16):
        free.step()
        rows = np.zeros((4, 1, 7))
        rows[:, 0, 6] = 1
        rows[:, 0, 1] = -0.3 + 0.15 * np.minimum((frame + (np.arange(4) + 1) / 4) / 12, 1)
        kept.step(body_poses=rows)
    assert free.positions()[:, 1].min() < -0.2
    assert kept.positions()[:, 1].min() > -0.151
    kept.set_bodies([])
    for _ in range(6):
        kept.step()
    assert kept.positions()[:, 1].min() < -0.16
    ball = ringlet.Body.sphere(0.05)
    kept.set_bodies([floor, ball], places=[ringlet.Pose((0, -0.5, 0)), ringlet.Pose((1, 0, 0))])
    kept.step(body_poses=np.tile([[0, -0.5, 0, 0, 0, 0, 1], [1, 0, 0, 0, 0, 0, 1]], (4, 1, 1)))
    later = ringlet.Hair(ringlet.Asset(device, swatch))
    later.prepare(["bodies"])
    at_once = ringlet.Hair(ringlet.Asset(device, swatch, features=["bodies"]))
    for one in (later, at_once):
        one.set_bodies([ball])
        one.step()
    assert np.array_equal(later.positions(), at_once.positions())


def test_roots_of_their_own(device, swatch):
    settings = ringlet.Settings(steps_per_frame=4)
    asset = ringlet.Asset(device, swatch, settings=settings, features=["roots"])
    start = np.zeros((6, 7))
    start[:, 6] = 1
    hair = ringlet.Hair(asset, roots=start)
    poses = np.tile(start, (4, 1, 1))
    poses[:, 2, 0] = np.linspace(0.0025, 0.01, 4)
    before = hair.positions()
    hair.step(root_poses=poses)
    went = (hair.positions() - before)[swatch.first_point[:-1], 0]
    assert went == pytest.approx([0, 0, 0.01, 0, 0, 0], abs=1e-6)
    shifts = np.zeros((6, 3))
    shifts[1, 2] = 0.02
    hair = ringlet.Hair(asset, root_shifts=shifts)
    hair.step(ringlet.Pose(shift=0.5))
    went = (hair.positions() - before)[swatch.first_point[:-1], 2]
    assert went == pytest.approx([0, 0.01, 0, 0, 0, 0], abs=1e-6)


def test_a_checkpoint_goes_on_with_the_same_bits(asset):
    first = ringlet.Hair(asset)
    moved(first, 2)
    checkpoint = first.checkpoint()
    assert isinstance(checkpoint, bytes)
    second = ringlet.Hair(asset)
    second.restore(checkpoint)
    for hair in (first, second):
        hair.step(shaken(2, 4))
    assert np.array_equal(first.positions(), second.positions())


def test_a_damaged_or_foreign_checkpoint_is_refused_and_the_hair_goes_on(device, swatch, asset):
    hair = ringlet.Hair(asset)
    moved(hair, 2)
    checkpoint = hair.checkpoint()
    other = ringlet.Hair(ringlet.Asset(device, swatch, ringlet.Material(bend_stiffness=6), asset.settings))
    wrong = [b"", b"x", checkpoint[:-1], checkpoint + b"x", checkpoint[1:], other.checkpoint()]
    for at in range(0, len(checkpoint), max(1, len(checkpoint) // 50)):
        wrong.append(checkpoint[:at] + bytes([checkpoint[at] ^ 0x40]) + checkpoint[at + 1:])
    positions = hair.positions()
    for each in wrong:
        with pytest.raises(ringlet.Error, match="checkpoint"):
            hair.restore(each)
        assert np.array_equal(hair.positions(), positions)
    hair.restore(checkpoint)


def test_a_state_is_put_back(asset):
    hair = ringlet.Hair(asset)
    moved(hair, 2)
    positions, velocities = hair.positions(), hair.velocities()
    assert np.abs(velocities).max() > 0.01
    hair.step()
    hair.set_state(positions, velocities)
    assert np.array_equal(hair.positions(), positions) and np.array_equal(hair.velocities(), velocities)


def test_contacts_are_reported(device, swatch):
    settings = ringlet.Settings(steps_per_frame=4, contacts={"on": True, "method": "explicit", "radius": 0.01})
    hair = ringlet.Hair(ringlet.Asset(device, swatch, settings=settings))
    moved(hair)
    report = hair.contact_report()
    assert report["contact_particles"] > 0 and report["listed"] > 0 and report["pair_tests"] > 0
    assert hair.memory()["contacts"] > 0
    assert hair.memory()["total"] == sum(v for k, v in hair.memory().items() if k not in ("total", "shared"))


def test_what_a_hair_tells_of_itself(hair, asset, swatch):
    moved(hair, 1)
    assert "subgroup" in hair.kernel and hair.compile_milliseconds >= 0
    assert sum(hair.stage_milliseconds().values()) > 0
    assert hair.asset is asset and asset.groom is swatch
    assert (asset.strand_count, asset.particle_count, asset.rigid_strand_count) == (6, 192, 0)
    assert any("core spring" in sentence for sentence in asset.warnings)  # 4 steps a frame are few
    assert "serial" in ringlet.Hair(ringlet.Asset(asset.device, swatch, kernel="serial")).kernel


def test_threads_may_use_one_hair_and_hairs_of_one_device(asset):
    shared = ringlet.Hair(asset)
    own = [ringlet.Hair(asset) for _ in range(3)]
    faults = []

    def work(hair):
        try:
            for frame in range(10):
                hair.step(shaken(frame, 4))
                shared.step()
                shared.positions()
        except Exception as error:  # the test's thread tells it
            faults.append(error)

    threads = [threading.Thread(target=work, args=(hair,)) for hair in own]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert faults == []
    alone = ringlet.Hair(asset)
    expected = moved(alone, 10)
    for hair in own:
        assert np.array_equal(hair.positions(), expected)


def test_other_threads_run_while_the_device_works(device):
    groom = ringlet.make_swatch(columns=20, rows=20, particles=64)
    hair = ringlet.Hair(ringlet.Asset(device, groom, settings=ringlet.Settings(steps_per_frame=340)))
    done, longest = threading.Event(), [0.0]

    def watch():
        last = time.perf_counter()
        while not done.is_set():
            now = time.perf_counter()
            longest[0], last = max(longest[0], now - last), now

    thread = threading.Thread(target=watch)
    thread.start()
    try:
        shares = []  # of a frame, in which the other thread stood still
        for _ in range(3):  # a busy machine may hold it up, too
            longest[0] = 0
            start = time.perf_counter()
            hair.step()
            shares.append(longest[0] / (time.perf_counter() - start))
    finally:
        done.set()
        thread.join()
    assert min(shares) < 0.5, shares


def test_forces_that_are_the_same_everywhere_are_another_gravity(device, swatch):
    settings = ringlet.Settings(steps_per_frame=4)
    pulled = ringlet.Hair(ringlet.Asset(device, swatch, settings=settings, features=["forces"]))
    falls = ringlet.Hair(ringlet.Asset(device, swatch, settings=settings))
    pulled.set_settings(gravity=(0, -6, 0))
    pulled.set_forces(np.tile(np.float32([1, -2, 0.5]), (swatch.particle_count, 1)))
    falls.set_settings(gravity=(1, -8, 0.5))
    still = falls.positions()
    for frame in range(3):
        for hair in (pulled, falls):
            hair.step(shaken(frame, 4))
    assert np.array_equal(pulled.positions(), falls.positions())
    assert not np.array_equal(falls.positions(), still)


def places_of(groom):
    """Its points in metres, rounded as the library rounds them."""
    return (groom.points.astype(float) * groom.metres_per_unit).astype(np.float32)


def test_goals_hold_hair_to_a_pose(device, swatch):
    settings = ringlet.Settings(steps_per_frame=8)
    rest = places_of(swatch)
    held = ringlet.Hair(ringlet.Asset(device, swatch, settings=settings, features=["goals"]))
    free = ringlet.Hair(ringlet.Asset(device, swatch, settings=settings))
    held.set_goals(rest, 1000)
    for frame in range(6):
        for hair in (held, free):
            hair.step(shaken(frame, 8))
    def off(hair):
        return np.abs(hair.positions() - rest).max()
    assert off(free) > 0.01 > 10 * off(held)

    # One end is let go, and another pose is taken.
    lifted = rest + np.float32([0, 0.02, 0])
    held.set_goals(lifted, np.where(np.arange(len(rest)) % 2, 1000, 0), damping=2)
    for frame in range(24):
        held.step(shaken(6, 8))
    assert np.abs(held.positions() - lifted)[1::2].max() < 0.02


def test_the_goal_of_settings_is_the_groom(device, swatch):
    rest = places_of(swatch)
    by_hand = ringlet.Hair(ringlet.Asset(device, swatch, features=["goals"]))
    by_hand.set_goals(rest, 5)
    settings = ringlet.Settings(goal={"on": True, "strength": 5})
    by_settings = ringlet.Hair(ringlet.Asset(device, swatch, settings=settings))
    for frame in range(4):
        for hair in (by_hand, by_settings):
            hair.step(shaken(frame, 8))
    assert np.array_equal(by_hand.positions(), by_settings.positions())
    by_settings.set_settings(goal={"strength": 0.5})
    by_hand.set_goals(rest, 0.5)
    for hair in (by_hand, by_settings):
        hair.step(shaken(4, 8))
    assert np.array_equal(by_hand.positions(), by_settings.positions())


def test_goals_that_do_not_fit_are_refused(device, swatch):
    count = swatch.particle_count
    rest = np.zeros((count, 3), np.float32)
    held = ringlet.Hair(ringlet.Asset(device, swatch, features=["goals"]))
    for places, strengths, damping in ((rest[1:], 1, 1), (rest, np.ones(count - 1), 1), (rest, -1, 1), (rest, 1, -1),
                                       (rest, np.nan, 1), (rest, 1, np.nan), (rest * np.nan, 1, 1)):
        with pytest.raises(ValueError):
            held.set_goals(places, strengths, damping)
    for places, strengths in ((rest.astype(complex), 1), (rest, "much"), (None, 1), (rest, 1j), (rest, np.array(1j)),
                              (rest, np.ones(count, complex)), (rest, np.ones(count, bool))):
        with pytest.raises(TypeError):
            held.set_goals(places, strengths)


def test_forces_that_do_not_fit_are_refused(device, swatch):
    count = swatch.particle_count
    pulled = ringlet.Hair(ringlet.Asset(device, swatch, features=["forces"]))
    with pytest.raises(ValueError):
        pulled.set_forces(np.zeros((count - 1, 3), np.float32))
    with pytest.raises(TypeError):
        pulled.set_forces(np.zeros((count, 3), complex))
    with pytest.raises(ValueError):
        pulled.set_forces(np.full((count, 3), np.nan, np.float32))


def test_fields_act_on_hair(device, swatch):
    def after(*fields, come_from=()):
        hair = ringlet.Hair(ringlet.Asset(device, swatch, features=["fields"]))
        hair.set_fields(list(fields), list(come_from))
        for frame in range(6):
            hair.step()
        return hair.positions()

    still = after()
    along = after(ringlet.Field(axis=(1, 0, 0), axial=5))
    assert (along - still)[:, 0].max() > 0.01
    # A grid of one velocity, drawn along as air: what the same air without a grid does.
    air = ringlet.Field(axis=(1, 0, 0), axial=2, drag=4)
    grid = np.zeros((3, 4, 5, 3))
    grid[..., 0] = 1
    box = ringlet.Field(position=(-2, -3, -4), grid=grid, cell=2, grid_share=2, drag=4, name="box")
    assert np.abs(after(box) - after(air)).max() < 1e-5
    assert not np.array_equal(after(air), still)
    # They change evenly from where they come from.
    nothing = ringlet.Field(axis=(1, 0, 0), axial=0)
    rising = after(ringlet.Field(axis=(1, 0, 0), axial=5), come_from=[nothing])
    assert not np.array_equal(rising, along)
    assert box.name == "box" and "box at (-2, -3, -4)" in repr(box)


def test_fields_that_do_not_fit_are_refused(device, swatch):
    windy = ringlet.Hair(ringlet.Asset(device, swatch, features=["fields"]))
    with pytest.raises(ValueError, match="1 fields, and 2"):
        windy.set_fields([ringlet.Field()], [ringlet.Field(), ringlet.Field()])
    with pytest.raises(ringlet.Error, match="at most 64"):
        windy.set_fields([ringlet.Field()] * 65)
    with pytest.raises(TypeError):
        windy.set_fields([1])
    with pytest.raises(ringlet.Error, match="length of the axis"):
        ringlet.Field(axis=(0, 0, 0))
    with pytest.raises(TypeError, match="did you mean drag"):
        ringlet.Field(darg=1)
    for numbers in ({"drag": -1}, {"core": 1e9}, {"axial": 1e9}):
        with pytest.raises(ValueError, match="must be from"):
            ringlet.Field(**numbers)
    for numbers in ({"grid": np.zeros((2, 2, 3))}, {"grid": np.zeros((2, 2, 1, 3))}, {"position": (1, 2)},
                    {"axial": np.nan, "grid": np.full((2, 2, 2, 3), np.nan)}):
        with pytest.raises(ValueError):
            ringlet.Field(**numbers)
