# Levels of detail: the strands that are simulated, and those that follow them.
import numpy as np
import pytest

import ringlet
from conftest import shaken


@pytest.fixture(scope="module")
def head():
    return ringlet.make_head(strands=60, locks=12, particles=24, turns=3)


def moved(device, groom, frames=4):
    hair = ringlet.Hair(ringlet.Asset(device, groom))
    for frame in range(frames):
        hair.step(shaken(frame, hair.settings.steps_per_frame))
    return hair


def test_a_level_is_a_share_of_the_strands(head):
    level = ringlet.LevelOfDetail(head, 0.25)
    assert level.guides.dtype == np.uint32 and level.guides.shape == (15,) and (np.diff(level.guides) > 0).all()
    assert level.groom.strand_count == 15 and level.whole is head
    for own, strand in enumerate(level.guides):
        assert np.array_equal(level.groom.strand(own), head.strand(int(strand)))
    with pytest.raises(ValueError):
        level.guides[0] = 1


def test_guides_are_counted_or_named(head):
    assert ringlet.LevelOfDetail(head, guides=7).groom.strand_count == 7
    assert list(ringlet.LevelOfDetail(head, guides=[50, 3, 20]).guides) == [3, 20, 50]
    assert list(ringlet.LevelOfDetail(head, guides=500).guides) == list(range(60))
    for wrong in 0, -1, [], [60], [-1], [3, 3]:
        with pytest.raises(ValueError, match="guides"):
            ringlet.LevelOfDetail(head, guides=wrong)
    for both in {}, {"share": 0.5, "guides": 5}:
        with pytest.raises(ValueError, match="share and guides"):
            ringlet.LevelOfDetail(head, **both)


def test_hairs_keep_their_own_points_at_rest(device):
    counts = [5, 24, 9, 40, 2, 17]
    points = np.concatenate([np.stack([np.full(n, 0.4 * s), -np.linspace(0, 8 + s, n), np.linspace(0, 1, n) ** 2],
                                      axis=1) for s, n in enumerate(counts)])
    groom = ringlet.Groom(points.astype(np.float32), counts=counts)
    level = ringlet.LevelOfDetail(groom, guides=[1, 3])
    followers = ringlet.Followers(ringlet.Hair(ringlet.Asset(device, level.groom)), level)
    followers.follow()
    assert list(np.diff(followers.first_point)) == counts
    assert followers.points() == pytest.approx(groom.points, abs=1e-4)


def test_all_strands_follow_those_that_are_simulated(device, head):
    whole = moved(device, head)
    rest = ringlet.Hair(whole.asset).positions()
    far = np.linalg.norm(whole.positions() - rest, axis=1).mean()
    for share, most in (1, 1e-4), (0.5, 0.4):
        level = ringlet.LevelOfDetail(head, share)
        hair = moved(device, level.groom)
        followers = ringlet.Followers(hair, level)
        followers.follow()
        positions = followers.positions()
        assert positions.dtype == np.float32 and positions.shape == (60 * 24, 3)
        assert np.array_equal(followers.first_point, head.first_point)
        off = np.linalg.norm(positions - whole.positions(), axis=1)
        assert off.mean() < most * far
        assert off[head.first_point[:-1]].max() < 1e-5  # roots


def test_points_are_in_the_world_where_they_followed(device, head):
    level = ringlet.LevelOfDetail(head, 0.5)
    hair = moved(device, level.groom)
    followers = ringlet.Followers(hair, level)
    followers.follow()
    place = np.array(hair.head.position, np.float32)
    assert np.abs(place).max() > 1e-3
    points = followers.points()
    assert points == pytest.approx((followers.positions() + place) / level.groom.metres_per_unit, abs=1e-3)
    hair.step(ringlet.Pose((1, 0, 0)))
    assert np.array_equal(followers.points(), points)


def test_what_does_not_fit_is_refused(device, head):
    for share in 0, -1, 2, float("nan"):
        with pytest.raises(ValueError, match="above 0 and at most 1"):
            ringlet.LevelOfDetail(head, share)
    level = ringlet.LevelOfDetail(head, 0.5)
    with pytest.raises(ValueError, match="level.groom"):
        ringlet.Followers(ringlet.Hair(ringlet.Asset(device, head)), level)
    with pytest.raises(TypeError):
        ringlet.Followers(None, level)
    still = ringlet.Groom(np.ones((6, 3), np.float32), counts=[3, 3])
    with pytest.raises(ringlet.Error, match="strand 1 of the groom has no length"):
        ringlet.LevelOfDetail(still, 0.5)
