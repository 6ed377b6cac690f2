# Grooms: arrays in and out without copies that nobody needs, files, generators, numbers.
import gc
import sys

import numpy as np
import pytest

import ringlet


def two_strands():
    points = np.zeros((8, 3), np.float32)
    points[:, 1] = [0, -1, -2, -3, -4, 0, -1, -2]
    points[5:, 0] = 2
    return points


def test_points_and_strands_are_those_handed_over():
    points = two_strands()
    for groom in (ringlet.Groom(points, [0, 5, 8], metres_per_unit=0.5),
                  ringlet.Groom(points, np.array([0, 5, 8], np.uint32), metres_per_unit=0.5),
                  ringlet.Groom(points, counts=[5, 3], metres_per_unit=0.5),
                  ringlet.Groom(points, counts=np.array([5, 3], np.int64), metres_per_unit=0.5)):
        assert np.array_equal(groom.points, points)
        assert groom.points.dtype == np.float32 and groom.first_point.dtype == np.uint32
        assert groom.first_point.tolist() == [0, 5, 8] and groom.counts.tolist() == [5, 3]
        assert (groom.strand_count, groom.particle_count, groom.metres_per_unit, len(groom)) == (2, 8, 0.5, 2)
        assert np.array_equal(groom.strand(1), points[5:]) and np.array_equal(groom.strand(-2), points[:5])


def test_a_groom_does_not_change_with_the_array_it_was_made_of():
    points = two_strands()
    groom = ringlet.Groom(points, counts=[5, 3])
    points[:] = 7
    assert np.array_equal(groom.points, two_strands())


def test_points_with_strides_are_taken_as_they_are_seen():
    wide = np.zeros((8, 6), np.float32)
    wide[:, ::2] = two_strands()
    assert np.array_equal(ringlet.Groom(wide[:, ::2], counts=[5, 3]).points, two_strands())
    assert np.array_equal(ringlet.Groom(np.asfortranarray(two_strands()), counts=[5, 3]).points, two_strands())


def test_views_show_the_grooms_own_memory_and_keep_it_alive():
    groom = ringlet.Groom(two_strands(), counts=[5, 3])
    views = [groom.points, groom.first_point, groom.strand(1)]
    assert views[0].__array_interface__["data"] == groom.points.__array_interface__["data"]
    assert views[2].__array_interface__["data"][0] == views[0].__array_interface__["data"][0] + 5 * 12
    for view in views:
        assert view.base is groom
        with pytest.raises(ValueError):
            view[0] = 1
        with pytest.raises(ValueError):
            view.flags.writeable = True
    del view
    held = sys.getrefcount(groom)
    more = [groom.points for _ in range(10)]
    assert sys.getrefcount(groom) == held + len(more)
    del more, groom
    gc.collect()
    junk = [np.full((8, 3), 9, np.float32) for _ in range(1000)]  # would take freed memory
    assert np.array_equal(views[0], two_strands()) and views[1].tolist() == [0, 5, 8]
    del junk


@pytest.mark.parametrize("name", ["groom.obj", "groom.hair", "GROOM.HAIR"])
def test_what_is_written_is_read_with_the_same_bits(tmp_path, name):
    groom = ringlet.make_head(strands=20, particles=16)
    groom.write(tmp_path / name)
    again = ringlet.read_groom(str(tmp_path / name), metres_per_unit=groom.metres_per_unit)
    assert np.array_equal(again.points, groom.points) and np.array_equal(again.first_point, groom.first_point)
    assert again.warnings == []


def test_a_style_is_that_of_scene_files(tmp_path):
    groom = ringlet.make_styled_head("bob", strands=30, particles=16, seed=3)
    scene = tmp_path / "scene.toml"
    scene.write_text('[groom]\ngenerate = "head"\nstyle = "bob"\nstrands = 30\nparticles = 16\nseed = 3\n')
    assert np.array_equal(ringlet.Scene.load(scene).groom.points, groom.points)
    with pytest.raises(ValueError, match="style must be one of ringlets, .*, got 'bop'"):
        ringlet.make_styled_head("bop")


def test_other_points_of_the_same_strands(tmp_path):
    groom = ringlet.Groom(two_strands(), counts=[5, 3], metres_per_unit=0.25)
    moved = groom.with_points(two_strands() + 1)
    assert np.array_equal(moved.points, two_strands() + 1) and np.array_equal(groom.points, two_strands())
    assert moved.first_point.tolist() == [0, 5, 8] and moved.metres_per_unit == 0.25
    ringlet.write_obj(tmp_path / "frame.obj", groom, two_strands() + 1)
    assert np.array_equal(ringlet.read_groom(tmp_path / "frame.obj").points, two_strands() + 1)


def test_the_numbers_of_a_helix_are_those_it_was_made_with():
    radius, turns, length = 0.013, 6.0, 0.3
    groom = ringlet.make_curl(radius=radius, turns=turns, length=length, particles=240, metres_per_unit=0.001)
    info = groom.info()
    arc = np.hypot(length, 2 * np.pi * radius * turns)
    assert info["strands"] == info["curled"] == info["right_handed"] == 1 and info["left_handed"] == 0
    assert info["particles"] == 240 and info["particles_per_strand"] == {"mean": 240, "min": 240, "max": 240}
    assert info["radius"]["mean"] == pytest.approx(radius, rel=0.01)
    assert info["turns"]["mean"] == pytest.approx(turns, rel=0.02)
    assert info["length"]["mean"] == pytest.approx(arc, rel=0.01)
    curls = groom.curls()
    assert curls["pitch"][0] == pytest.approx(length / turns, rel=0.01)
    assert curls["turn_length"][0] == pytest.approx(arc / turns, rel=0.01)
    assert curls["handedness"].tolist() == [1] and curls["perversions"].tolist() == [0]
    left = ringlet.make_curl(handedness=-1).curls()
    assert left["handedness"].tolist() == [-1]
    straight = ringlet.make_curl(turns=0).info()
    assert straight["curled"] == 0 and straight["turns"] == {"mean": 0, "min": 0, "max": 0}


def test_generators_make_what_the_program_makes(program):
    made = {
        "curl": ringlet.make_curl(turns=5, particles=40),
        "swatch": ringlet.make_swatch(columns=3, rows=2, particles=20, seed=7),
        "head": ringlet.make_head(strands=30, locks=5, particles=24, left_handed_share=0.25),
    }
    options = {
        "curl": ["--turns", 5, "--particles", 40],
        "swatch": ["--columns", 3, "--rows", 2, "--particles", 20, "--seed", 7],
        "head": ["--strands", 30, "--locks", 5, "--particles", 24, "--other-hand", 0.25],
    }
    for kind, groom in made.items():
        program("make", kind, *options[kind], "-o", f"{kind}.hair", tells=False)
        assert np.array_equal(ringlet.read_groom(program.folder / f"{kind}.hair").points, groom.points), kind


def test_a_curl_that_is_cut_too_coarsely_is_warned_of():
    assert any("particles" in sentence for sentence in ringlet.make_curl(turns=30, particles=32).warnings)
    assert ringlet.make_curl().warnings == []


def test_read_groom_takes_the_files_unit_and_how_it_is_read(tmp_path):
    inches = tmp_path / "inches.usda"
    inches.write_text('#usda 1.0\n(\n metersPerUnit = 0.0254\n upAxis = "Z"\n)\ndef BasisCurves "Hair" { uniform token '
                      'type = "linear" int[] curveVertexCounts = [2, 2] point3f[] points = '
                      '[(0, 0, 0), (0, 1, -9), (1, 0, 0), (1, 1, -9)] }\n')
    assert ringlet.read_groom(inches).metres_per_unit == 0.0254
    assert ringlet.read_groom(inches, 0.5).metres_per_unit == 0.5
    assert np.array_equal(ringlet.read_groom(inches).points[1], np.float32([0, -9, -1]))
    assert np.array_equal(ringlet.read_groom(inches, up="Z").points[1], np.float32([0, 1, -9]))
    points = tmp_path / "points.obj"
    points.write_text("".join(f"v {i // 4} {-(i % 4)} 0\n" for i in range(8)))
    with pytest.raises(ringlet.Error, match="points_per_strand"):
        ringlet.read_groom(points)
    with pytest.raises(ringlet.Error, match="8 points.*3 points"):
        ringlet.read_groom(points, points_per_strand=3)
    cut = ringlet.read_groom(points, points_per_strand=4)
    assert cut.counts.tolist() == [4, 4] and cut.metres_per_unit == 0.01
    turned = ringlet.read_groom(points, points_per_strand=4, root_end="last")
    assert np.array_equal(turned.strand(1), cut.strand(1)[::-1])
    for wrong in ({"points_per_strand": 1}, {"points_per_strand": -4}, {"root_end": "tip"}, {"up": "X"}):
        with pytest.raises(ValueError, match=next(iter(wrong))):
            ringlet.read_groom(points, **wrong)


def test_read_groom_says_what_seems_wrong(tmp_path):
    head = ringlet.make_head(strands=60)
    strands = [head.strand(s) for s in range(60)]

    def warnings(strands, **reading):
        counts = [len(strand) for strand in strands]
        ringlet.Groom(np.concatenate(strands).astype(np.float32), counts=counts).write(tmp_path / "a.hair")
        return ringlet.read_groom(tmp_path / "a.hair", **reading).warnings

    assert warnings(strands) == []
    (tips,) = warnings([strand[::-1] for strand in strands])
    assert "60 of 60" in tips and "tip to root" in tips
    assert "tip to root" not in " ".join(warnings([strand[::-1] for strand in strands], root_end="last"))
    (strays,) = warnings([np.append(strand, np.zeros((1, 3)), 0) for strand in strands])
    assert "60 particles stand far off" in strays
    (sideways,) = warnings([strand[:, [0, 2, 1]] * [1, -1, 1] for strand in strands])
    assert 'takes up="Z"' in sideways


def test_placement_tells_tips_from_roots():
    head = ringlet.make_head(strands=60)
    skin = ringlet.Body.sphere(0.09, name="skin")
    turned = ringlet.Groom(np.concatenate([head.strand(s)[::-1] for s in range(60)]), counts=head.counts)
    assert ringlet.check_placement(head, [skin]) == []
    (doubt,) = ringlet.check_placement(turned, [skin])
    assert "60 of 60 strands have their last point on the body skin" in doubt and 'root_end="last"' in doubt
