# Animations: what is written is read with the same points, is the file of the program, and is whole at every moment.
import numpy as np
import pytest

import ringlet
from test_scenes import SCENES


def frames_of(groom, count=3):
    return [(groom.points + np.float32(k)) for k in range(count)]


@pytest.mark.parametrize("name", ["hair.usda", "hair.usdc", "hair.abc", "hair.rgc"])
def test_points_are_read_as_they_were_written(tmp_path, swatch, name):
    with ringlet.AnimationWriter(tmp_path / name, swatch, fps=30, frames=5, up="Z", width=0.001) as animation:
        for points in frames_of(swatch):
            animation.write_points(points)
        animation.sync()
        assert animation.frame_count == 3 and animation.error_bound in (None, 0)
        assert (tmp_path / (name + ".partial")).exists() and not (tmp_path / name).exists()
    assert (tmp_path / name).exists() and not (tmp_path / (name + ".partial")).exists()
    reader = ringlet.AnimationReader(tmp_path / name)
    assert (len(reader), reader.frame_count, reader.fps, reader.up) == (3, 3, 30, "Z")
    assert reader.metres_per_unit == swatch.metres_per_unit and reader.width == pytest.approx(0.001)
    assert reader.counts.tolist() == swatch.counts.tolist() and reader.warnings == []
    for read, written in zip(list(reader), frames_of(swatch)):
        assert np.array_equal(read, written)
    assert list(reader) == []  # it goes through once


def test_every_format_is_listed_and_written(tmp_path, swatch):
    assert {".usda", ".usdc", ".abc", ".rgc", ".pc2"} <= set(ringlet.AnimationWriter.formats())
    for ending in ringlet.AnimationWriter.formats():
        with ringlet.AnimationWriter(tmp_path / ("hair" + ending), swatch) as animation:
            animation.write_points(swatch.points)
        assert (tmp_path / ("hair" + ending)).stat().st_size > 2 * len(swatch.points), ending


def test_16_bits_are_as_near_as_they_say(tmp_path, swatch):
    with ringlet.AnimationWriter(tmp_path / "hair.rgc", swatch, precision="16bit") as animation:
        for points in frames_of(swatch):
            animation.write_points(points)
    bound = animation.error_bound
    assert 0 < bound < 1e-4
    for read, written in zip(ringlet.AnimationReader(tmp_path / "hair.rgc"), frames_of(swatch)):
        assert 0 < np.abs(read - written).max() * swatch.metres_per_unit <= bound


def test_positions_seen_from_a_head_are_the_programs_file(device, program):
    (program.folder / "scene.toml").write_text(SCENES["pre-roll"])
    told = program("simulate", "scene.toml", "-o", "out", "--untuned", "--quiet", "--usdc", "--also", "hair.abc", "--cache", "float32")
    scene = ringlet.Scene.load(program.folder / "scene.toml")
    for name in ("hair.usda", "hair.usdc", "hair.abc", "hair.rgc"):
        with ringlet.AnimationWriter(program.folder / name, scene.groom, frames=told["frames"]) as animation:
            scene.run(lambda frame: animation.write(frame.positions, frame.head), device=device)
        assert (program.folder / name).read_bytes() == (program.folder / "out" / name).read_bytes(), name


# The same choices, as the program's options and as the writer's.
USD_CHOICES = {
    "values": ("hair.usdc", ["--usd-values", "id,rest,velocities", "--tip-width", "0.0001"],
               {"values": ["id", "rest", "velocities"], "tip_width": 0.0001}),
    "transform": ("hair.usdc", ["--head", "transform"], {"head": "transform"}),
    "values of Alembic": ("hair.abc", ["--usd-values", "id,rest,velocities", "--tip-width", "0.0001"],
                          {"values": ["id", "rest", "velocities"], "tip_width": 0.0001}),
    "transform of Alembic": ("hair.abc", ["--head", "transform"], {"head": "transform"}),
    "no head": ("hair.usdc", ["--head", "none"], {"head": "none"}),
    "clips": ("hair.usda", ["--clips", "3", "--usd-values", "velocities"], {"clip_frames": 3, "values": ["velocities"]}),
}


@pytest.mark.parametrize("choice", USD_CHOICES)
def test_what_usd_holds_beside_points_is_the_programs(device, program, choice):
    name, options, arguments = USD_CHOICES[choice]
    (program.folder / "scene.toml").write_text(SCENES["pre-roll"])
    told = program("simulate", "scene.toml", "-o", "out", "--untuned", "--quiet", "--usdc", "--also", "hair.abc", *options)
    scene = ringlet.Scene.load(program.folder / "scene.toml")
    with ringlet.AnimationWriter(program.folder / name, scene.groom, frames=told["frames"], **arguments) as animation:
        scene.run(lambda frame: animation.write(frame.positions, frame.head), device=device)
    assert (program.folder / name).read_bytes() == (program.folder / "out" / name).read_bytes()
    clips = sorted(path.name for path in (program.folder / "out").glob("hair_clips/*"))
    assert bool(clips) == (choice == "clips")
    for clip in clips:
        mine, theirs = (folder / "hair_clips" / clip for folder in (program.folder, program.folder / "out"))
        assert mine.read_bytes() == theirs.read_bytes(), clip


def test_after_an_exception_the_frames_so_far_are_kept(tmp_path, swatch):
    with pytest.raises(LookupError):
        with ringlet.AnimationWriter(tmp_path / "hair.rgc", swatch) as animation:
            animation.write_points(swatch.points)
            raise LookupError
    assert not (tmp_path / "hair.rgc").exists()
    assert len(ringlet.AnimationReader(tmp_path / "hair.rgc.partial")) == 1
    with pytest.raises(LookupError):
        with ringlet.AnimationWriter(tmp_path / "empty.usda", swatch):
            raise LookupError
    assert not (tmp_path / "empty.usda.partial").exists()


def test_a_partial_file_is_read_as_far_as_it_goes(tmp_path, swatch):
    for name in ("hair.usda", "hair.usdc", "hair.abc", "hair.rgc"):
        animation = ringlet.AnimationWriter(tmp_path / name, swatch, frames=9)
        for points in frames_of(swatch):
            animation.write_points(points)
        del animation
        assert len(list(ringlet.AnimationReader(tmp_path / (name + ".partial")))) == 3


def test_what_a_writer_cannot_do_is_told(tmp_path, swatch):
    animation = ringlet.AnimationWriter(tmp_path / "hair.usda", swatch, frames=1)
    with pytest.raises(ringlet.Error, match="no frame"):
        animation.finish()
    animation.write_points(swatch.points)
    with pytest.raises(ringlet.Error, match="made for 1 frames"):
        animation.write_points(swatch.points)
    animation.finish()
    for again in (animation.finish, animation.sync, lambda: animation.write_points(swatch.points)):
        with pytest.raises(ringlet.Error, match="is closed"):
            again()
    with pytest.raises(ringlet.Error, match="no frame"):
        with ringlet.AnimationWriter(tmp_path / "none.rgc", swatch):
            pass
    with pytest.raises(ringlet.Error) as error:
        ringlet.AnimationWriter(tmp_path / "missing" / "hair.rgc", swatch)
    assert error.value.fault == "output"
    with pytest.raises(ringlet.Error):
        ringlet.AnimationReader(tmp_path / "missing.usda")
    (tmp_path / "broken.rgc").write_bytes(b"x" * 100)
    with pytest.raises(ringlet.Error, match="broken.rgc"):
        ringlet.AnimationReader(tmp_path / "broken.rgc")
