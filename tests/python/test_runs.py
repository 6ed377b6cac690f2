# Scene.run is `ringlet simulate`: the same files, checkpoints and refusals.
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import ringlet

MODULE = Path(ringlet.__file__).parent
SWATCH = ('[groom]\ngenerate = "swatch"\ncolumns = 3\nrows = 2\nparticles = 20\nturns = 3\n[motion]\nkind = "shake"\n'
          '[simulation]\nframes = 8\nsteps_per_frame = 4\n')
SCENES = {
    "plain": SWATCH,
    "output": SWATCH + '[output]\nfiles = ["hair.usda", "hair.usdc", "last.obj"]\ncache = "16bit"\nwidth = 0.001\n'
                       'values = ["id", "rest"]\n',
    "changes": SWATCH + '[[cut]]\ntime = 0.1\nat = 0.5\n[[key]]\ntime = 0\nair.wind = [0, 0, 0]\n[[key]]\ntime = 0.2\n'
                        'air.wind = [3, 0, 1]\n',
}


@pytest.fixture
def scene(tmp_path):
    (tmp_path / "scene.toml").write_text(SWATCH)
    return ringlet.Scene.load(tmp_path / "scene.toml")


def files_of(folder):
    return {path.name: path.read_bytes() for path in sorted(Path(folder).iterdir())}


@pytest.mark.parametrize("name", SCENES)
def test_files_are_those_of_simulate(device, program, name):
    (program.folder / "scene.toml").write_text(SCENES[name])
    told = program("simulate", "scene.toml", "-o", "by_program", "--untuned", "--quiet")
    run = ringlet.Scene.load(program.folder / "scene.toml").run(device=device, folder=program.folder / "by_module")
    assert files_of(program.folder / "by_module") == files_of(program.folder / "by_program")
    assert [path.name for path in run.outputs] == [Path(path).name for path in told["outputs"]]
    timed = {key for key in told if key.endswith(("ms", "_s", "ms_per_frame", "share")) or key == "outputs"}
    assert {k: v for k, v in run.report.items() if k not in timed | {"velocity_residual"}} == \
        {k: v for k, v in told.items() if k not in timed | {"velocity_residual"}}
    assert (run.frame_count, run.interrupted, run.can_resume, run.resumed_from) == (8, False, False, 0)


def test_files_are_chosen_by_name(device, scene, tmp_path):
    for files in (["hair.usdc"], ["hair.rgc", "sheet.png"], []):
        run = scene.run(device=device, folder=tmp_path / "out", files=files, leftovers="overwrite")
        assert sorted(path.name for path in run.outputs) == sorted(files)
        assert all(path.stat().st_size for path in run.outputs)
    with pytest.raises(ValueError, match="no file 'hair.fbx'; it can write .*hair.usda"):
        scene.run(device=device, folder=tmp_path / "out", files=["hair.fbx"])


@pytest.mark.parametrize("body", ["", '[[body]]\nshape = "sphere"\nradius = 0.05\nposition = [0, -0.1, 0.02]\n'])
def test_full_hair_is_that_of_simulate(device, program, body):
    (program.folder / "scene.toml").write_text(SWATCH + body)
    program("simulate", "scene.toml", "-o", "by_program", "--untuned", "--quiet", "--overwrite", "--hairs", "300")
    scene = ringlet.Scene.load(program.folder / "scene.toml")
    scene.run(device=device, folder=program.folder / "by_module", hairs=300, leftovers="overwrite")
    unit = scene.groom.metres_per_unit
    frames = [list(ringlet.AnimationReader(program.folder / by / "hair.usda")) for by in ("by_program", "by_module")]
    assert len(frames[0]) == len(frames[1]) == 8 and len(frames[0][0]) == 300 * 20
    for a, b in zip(*frames):
        assert np.abs(a - b).max() * unit < 2e-6  # moved in double precision, and on the device in single


def test_several_devices_have_the_bits_of_one(device, scene):
    assert scene.run(devices=[device, device]).positions_hash == scene.run(device=device).positions_hash


# A checkpoint reaches the disk while later frames compute: the signal waits for the one of frame 2, which is larger
# than the first, of no frame.
KILL = """
import os, pathlib, signal, sys, time
sys.path.insert(0, {module!r})
import ringlet
checkpoint, sizes = pathlib.Path("out/checkpoint.rgk"), []
def kill(frame):
    sizes.append(checkpoint.stat().st_size)
    if frame.number < 6:
        return
    while checkpoint.stat().st_size == sizes[0]:
        time.sleep(0.01)
    os.kill(os.getpid(), signal.{how})
ringlet.Scene.load("scene.toml").run(kill, folder="out", checkpoint=2)
"""


@pytest.mark.parametrize("how", ["SIGKILL", "SIGINT"])
def test_a_killed_run_goes_on(device, scene, tmp_path, how):
    scene.run(device=device, folder=tmp_path / "whole")
    done = subprocess.run([sys.executable, "-c", KILL.format(module=str(MODULE), how=how)], cwd=tmp_path,
                          capture_output=True, text=True)
    assert done.returncode == -getattr(signal, how), done.stderr
    assert "checkpoint.rgk" in files_of(tmp_path / "out") and "hair.usda" not in files_of(tmp_path / "out")
    with pytest.raises(ringlet.Error, match='leftovers="resume" goes on with it; leftovers="overwrite" begins anew'):
        scene.run(device=device, folder=tmp_path / "out")
    run = scene.run(device=device, folder=tmp_path / "out", leftovers="resume")
    assert run.resumed_from in (2, 4, 6, 7) and run.frame_count == 8 and not run.interrupted
    assert files_of(tmp_path / "out") == files_of(tmp_path / "whole")


def test_what_a_callback_raises_leaves_a_checkpoint(device, scene, tmp_path):
    def fail(frame):
        if frame.number == 3:
            raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        scene.run(fail, device=device, folder=tmp_path / "out", checkpoint=100)
    seen = []
    run = scene.run(lambda frame: seen.append(frame.number), device=device, folder=tmp_path / "out", leftovers="resume")
    assert run.resumed_from == 4 and seen == [5, 6, 7, 8]
    stopped = scene.run(lambda frame: frame.number < 3, device=device, folder=tmp_path / "stopped")
    assert stopped.interrupted and not stopped.can_resume and stopped.frame_count == 4
    assert len(list(ringlet.AnimationReader(tmp_path / "stopped/hair.usda"))) == 4


def test_a_resumed_run_is_of_the_same_scene(device, scene, tmp_path):
    scene.run(lambda frame: frame.number < 3, device=device, folder=tmp_path / "out", checkpoint=1)
    other = ringlet.Scene.parse(SWATCH.replace("turns = 3", "turns = 4"))
    with pytest.raises(ringlet.Error, match='groom.* turns.*leftovers="overwrite"'):
        other.run(device=device, folder=tmp_path / "out", leftovers="resume")
    shorter = ringlet.Scene.builtin("hanging_curl", particles=8, seconds=0.2)
    shorter.run(lambda frame: frame.number < 2, device=device, folder=tmp_path / "built_in", checkpoint=1)
    for values in ({"particles": 8, "seconds": 0.2, "bend_stiffness": 1}, {"particles": 9, "seconds": 0.2}):
        with pytest.raises(ringlet.Error, match="is of another run"):
            ringlet.Scene.builtin("hanging_curl", **values).run(device=device, folder=tmp_path / "built_in",
                                                               leftovers="resume")
    assert shorter.run(device=device, folder=tmp_path / "built_in", leftovers="resume").positions_hash == \
        shorter.run(device=device).positions_hash


def test_finished_files_and_the_scenes_own_are_not_replaced(device, scene, tmp_path):
    scene.run(device=device, folder=tmp_path / "out")
    with pytest.raises(ringlet.Error, match='leftovers="overwrite" replaces them; choose another folder') as caught:
        scene.run(device=device, folder=tmp_path / "out")
    assert caught.value.fault == "output"
    ringlet.write_obj(tmp_path / "last.obj", scene.groom, scene.groom.points)
    (tmp_path / "own.toml").write_text('[groom]\nfile = "last.obj"\n[simulation]\nframes = 2\n')
    with pytest.raises(ringlet.Error, match="would be overwritten by it"):
        ringlet.Scene.load(tmp_path / "own.toml").run(device=device, folder=tmp_path, leftovers="overwrite")


def test_wrong_arguments_are_named(device, scene, tmp_path):
    folder = {"device": device, "folder": tmp_path / "out"}
    for values in ({"checkpoint": 2}, {"files": ["hair.usda"]}, {"hairs": 3}, {"leftovers": "resume"}):
        with pytest.raises(ValueError, match="give a folder"):
            scene.run(device=device, **values)
    with pytest.raises(ValueError, match="did you mean overwrite"):
        scene.run(**folder, leftovers="overwrit")
    for values in ({"checkpoint": -1}, {"hairs": -1}, {"devices": [device]}):
        with pytest.raises(ValueError):
            scene.run(**folder, **values)
    with pytest.raises(ValueError, match="empty"):
        scene.run(devices=[])
    with pytest.raises(ringlet.Error, match="7 devices are more than the groom's 6 strands"):
        scene.run(devices=[device] * 7)
    assert not (tmp_path / "out").exists()


def test_errors_name_what_a_script_can_change(device, scene, tmp_path):
    ringlet.write_obj(tmp_path / "groom.obj", scene.groom, scene.groom.points)
    text = '[groom]\nfile = "groom.obj"\n[output]\nfiles = ["hair.usdc"]\nprims = "groom"\n'
    with pytest.raises(ringlet.Error, match=r'prims = "groom" of \[output\] would change') as caught:
        ringlet.Scene.parse(text, tmp_path).run(device=device, folder=tmp_path / "out")
    assert "--" not in str(caught.value)
