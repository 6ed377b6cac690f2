"""What the add-on writes and reads: grooms, meshes, point caches, animations."""
import json
import os
import subprocess

import numpy as np
import pytest

from ringlet_hair.errors import RingletError
from ringlet_hair.hair_file import write_hair
from ringlet_hair.mesh_file import write_obj_mesh
from ringlet_hair.point_cache import PointCache, write_point_cache
from ringlet_hair.strands import Strands, joined
from ringlet_hair.usd_points import read_usd_hair, usd_frames

PROGRAM = os.environ.get("RINGLET_PROGRAM", "")
needs_program = pytest.mark.skipif(not os.path.exists(PROGRAM),
                                   reason="SKIPPED, NOTHING WAS TESTED: the ringlet command was not built")


def strands_of(counts, seed=1):
    points = np.random.default_rng(seed).uniform(-1, 1, (sum(counts), 3)).astype(np.float32)
    return Strands(points, counts)


def test_roots_are_the_first_points():
    strands = joined([strands_of([2, 5], 1), strands_of([3], 2)])
    assert strands.counts.tolist() == [2, 5, 3]
    assert (strands.roots == strands.points[[0, 2, 7]]).all()


@pytest.mark.parametrize("counts, spoil, words", [
    ([], None, "Hair has no curves"),
    ([3, 1, 0], None, "Hair: curve 1 has 1 point(s), as have 2 in all"),
    ([3, 4], np.nan, "not finite"),
    ([3, 4], np.inf, "not finite"),
])
def test_strands_that_cannot_be_simulated_are_refused(counts, spoil, words):
    strands = strands_of(counts) if counts else Strands(np.empty((0, 3)), [])
    if spoil is not None:
        strands.points[4, 1] = spoil
    with pytest.raises(RingletError, match=words.replace("(", r"\(").replace(")", r"\)")):
        strands.check("Hair")


@needs_program
def test_the_program_reads_the_groom_as_it_was(tmp_path):
    strands = strands_of([7, 4, 65536])
    write_hair(tmp_path / "groom.hair", strands)
    told = json.loads(subprocess.run([PROGRAM, "info", tmp_path / "groom.hair", "--json"], capture_output=True,
                                     check=True).stdout)
    assert (told["strands"], told["particles"]) == (3, len(strands.points))
    subprocess.run([PROGRAM, "convert", tmp_path / "groom.hair", tmp_path / "groom.obj"], capture_output=True, check=True)
    lines = (tmp_path / "groom.obj").read_text().splitlines()
    points = np.array([line.split()[1:] for line in lines if line.startswith("v ")], np.float32)
    assert (points == strands.points.astype(np.float32)).all()
    assert [len(line.split()) - 1 for line in lines if line.startswith("l ")] == [7, 4, 65536]


def test_a_strand_of_too_many_points_is_refused(tmp_path):
    with pytest.raises(RingletError, match="65537 points; at most 65536"):
        write_hair(tmp_path / "groom.hair", strands_of([65537]))


def test_meshes_keep_their_numbers(tmp_path):
    points = np.random.default_rng(3).uniform(-1e3, 1e3, (5, 3)).astype(np.float32)
    write_obj_mesh(tmp_path / "mesh.obj", points, [[0, 1, 2], [2, 3, 4]])
    lines = (tmp_path / "mesh.obj").read_text().splitlines()
    assert (np.array([line.split()[1:] for line in lines[:5]], np.float32) == points).all()
    assert lines[5:] == ["f 1 2 3", "f 3 4 5"]


def test_point_caches_give_back_their_bits_and_lines_between(tmp_path):
    frames = np.random.default_rng(4).uniform(-1, 1, (3, 6, 3)).astype(np.float32)
    assert write_point_cache(tmp_path / "a.pc2", frames, 6, 5) == 3
    cache = PointCache(tmp_path / "a.pc2")
    assert (cache.points, cache.frames, cache.first_frame) == (6, 3, 5)
    for index in range(3):
        assert (cache.at(index) == frames[index]).all()
    assert (cache.at(-4) == frames[0]).all() and (cache.at(9.5) == frames[2]).all()
    assert np.allclose(cache.at(1.25), 0.75 * frames[1] + 0.25 * frames[2])


def test_point_caches_that_are_torn_are_refused(tmp_path):
    path = tmp_path / "a.pc2"
    write_point_cache(path, np.zeros((3, 6, 3), np.float32), 6)
    whole = path.read_bytes()
    for length in range(len(whole)):
        path.write_bytes(whole[:length])
        with pytest.raises(RingletError, match="a.pc2.*simulate again"):
            PointCache(path)
    path.write_bytes(whole + b"x")
    with pytest.raises(RingletError, match="has 249 bytes where 3 frames of 6 points take 248"):
        PointCache(path)
    path.write_bytes(b"x" + whole[1:])
    with pytest.raises(RingletError, match="no PC2 file"):
        PointCache(path)
    with pytest.raises(RingletError, match="No such file"):
        PointCache(tmp_path / "b.pc2")


def test_a_cache_that_was_left_in_the_middle_says_so(tmp_path):
    def frames():
        yield np.zeros((2, 3), np.float32)
        raise RingletError("torn")

    with pytest.raises(RingletError, match="torn"):
        write_point_cache(tmp_path / "a.pc2", frames(), 2)
    with pytest.raises(RingletError, match="simulate again"):
        PointCache(tmp_path / "a.pc2")


@needs_program
def test_animations_are_read_as_the_program_wrote_them(tmp_path):
    def run(*arguments):
        subprocess.run([PROGRAM, *arguments], cwd=tmp_path, capture_output=True, check=True)

    run("make", "swatch", "--columns", "2", "--rows", "2", "--particles", "9", "-o", "a.hair")
    run("simulate", "a.hair", "--frames", "4", "--backend", "reference", "-o", "out")
    run("convert", "out/hair.usda", "frames")
    seen = list(usd_frames(tmp_path / "out" / "hair.usda"))
    assert len(seen) == 4
    for index, points in enumerate(seen):
        lines = (tmp_path / "frames" / f"hair.{index + 1:04}.obj").read_text().splitlines()
        assert (points == np.array([line.split()[1:] for line in lines if line.startswith("v ")], np.float32)).all()


@needs_program
def test_lists_may_have_several_lines(tmp_path):
    for arguments in (["make", "swatch", "--columns", "20", "--rows", "10", "--particles", "12", "-o", "groom.obj"],
                      ["simulate", "groom.obj", "--motion", "nod", "--frames", "2", "--quiet", "-o", "out"]):
        subprocess.run([PROGRAM, *arguments], cwd=tmp_path, check=True, capture_output=True)
    path = tmp_path / "out" / "hair.usda"
    assert read_usd_hair(path).counts.tolist() == [12] * 200
    assert [len(points) for points in usd_frames(path)] == [2400, 2400]


def test_animations_that_are_none_or_torn_are_refused(tmp_path):
    path = tmp_path / "a.usda"
    head = "#usda 1.0\n    point3f[] points.timeSamples = {\n"
    for text, words in (("", "no animation"), ("#usda 1.0\n", "no animation"),
                        (head + "  1: [(1,2,3)],\n", "in the middle"), (head + "  1: [(1,2)], }\n", "no list of points"),
                        (head, "in the middle")):
        path.write_text(text)
        with pytest.raises(RingletError, match=words):
            list(usd_frames(path))
    path.write_text(head + "  1: [(1,2,3)],\n  2: [(-1e-3,2.5,3)], };}\n")
    assert [points.tolist() for points in usd_frames(path)] == [[[1, 2, 3]], [[np.float32(-1e-3), 2.5, 3]]]
