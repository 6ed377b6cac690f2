# What ends while hair is at work: the interpreter, a process that forked, a writer that is dropped. In processes of their own.
import gc
import os
import subprocess
import sys
import warnings
from pathlib import Path

import pytest

import ringlet

MODULE = str(Path(ringlet.__file__).parent)
START = """
import os, sys, threading, time
sys.path.insert(0, {module!r})
import ringlet
asset = ringlet.Asset(ringlet.Device(), ringlet.make_swatch(columns=2, rows=2, particles=24))
hair = ringlet.Hair(asset)
hair.step()
"""


def run(code, seconds=120):
    environment = {k: v for k, v in os.environ.items() if k != "RINGLET_VALIDATION"}
    return subprocess.run([sys.executable, "-c", START.format(module=MODULE) + code], capture_output=True, text=True,
                          timeout=seconds, env=environment)


WORK = {
    "step": "[hair.step() for _ in range(10**5)]",
    "submit": "[(hair.submit(), hair.wait()) for _ in range(10**5)]",
    "positions": "[hair.positions() for _ in range(10**6)]",
    "checkpoint": "[hair.checkpoint() for _ in range(10**6)]",
    "writer": "[animation.write(hair.positions()) for _ in range(10**6)]",
    "scene": "ringlet.Scene.builtin('head_shake', strands=4).run(frames=10**5)",
    "build": "[ringlet.Asset(asset.device, asset.groom) for _ in range(10**5)]",
}


@pytest.mark.parametrize("what", WORK)
def test_a_daemon_thread_at_work_when_the_interpreter_ends(device, tmp_path, what):
    writer = (f"animation = ringlet.AnimationWriter({str(tmp_path / 'a.rgc')!r}, asset.groom, frames=10**6)\n"
              if what == "writer" else "")
    done = run(writer + f"threading.Thread(target=lambda: {WORK[what]}, daemon=True).start()\ntime.sleep(0.4)\n"
               "print('the end', flush=True)\n")
    assert (done.returncode, done.stdout) == (0, "the end\n"), done.stderr


# Every method of hair that is asked of its device, in the child of a fork.
ASKED = ["step()", "submit()", "wait()", "positions()", "points()", "velocities()",
         "set_state(hair_positions, hair_positions)", "set_settings(gravity=(0, -1, 0))",
         "set_material(bend_stiffness=2)", "set_bodies([])", "cut([(0, 5)])", "checkpoint()",
         "restore(checkpoint)", "report()", "contact_report()", "memory()", "stage_milliseconds()"]


def test_after_fork_hair_says_so(device):
    done = run("""
hair_positions, checkpoint = hair.positions(), hair.checkpoint()
asked = %r
child = os.fork()
if child == 0:
    import signal
    signal.alarm(60)
    for call in asked + ['__FOLLOW__', '__ASSET__', '__HAIR__', '__TOGETHER__']:
        try:
            if call == '__FOLLOW__':
                level = ringlet.LevelOfDetail(asset.groom, 1)
                ringlet.Followers(hair, level)
            elif call == '__ASSET__':
                ringlet.Asset(asset.device, asset.groom)
            elif call == '__HAIR__':
                ringlet.Hair(asset)
            elif call == '__TOGETHER__':
                ringlet.step_frames([(hair, ringlet.Pose())])
            else:
                eval('hair.' + call)
            print(call, 'is taken', flush=True)
        except ringlet.Error as error:
            if 'fork' not in str(error):
                print(call, error, flush=True)
    sys.stdout.flush()
    os._exit(0)
print(os.waitpid(child, 0)[1], flush=True)
hair.step()
print('the parent goes on', flush=True)
""" % ASKED)
    assert (done.returncode, done.stdout) == (0, "0\nthe parent goes on\n"), done.stdout + done.stderr


def test_a_child_that_opens_a_device_of_its_own_has_hair(device):
    done = run("""
expected = hair.positions()
child = os.fork()
if child == 0:
    import signal
    signal.alarm(60)
    own = ringlet.Hair(ringlet.Asset(ringlet.Device(), asset.groom))
    own.step()
    os._exit(0 if (own.positions() == expected).all() else 3)
print(os.waitpid(child, 0)[1])
""")
    assert (done.returncode, done.stdout) == (0, "0\n"), done.stderr


def test_a_writer_that_is_dropped_says_so(tmp_path, swatch):
    writer = ringlet.AnimationWriter(tmp_path / "dropped.rgc", swatch)
    writer.write_points(swatch.points)
    with pytest.warns(ResourceWarning, match=r"dropped.rgc was dropped without finish\(\) or close\(\)"):
        del writer
        gc.collect()
    assert (tmp_path / "dropped.rgc.partial").exists()
    with warnings.catch_warnings():
        warnings.simplefilter("error", ResourceWarning)
        for end in ("finish", "close"):
            writer = ringlet.AnimationWriter(tmp_path / (end + ".rgc"), swatch)
            writer.write_points(swatch.points)
            getattr(writer, end)()
            writer.close()  # again
            assert "closed" in repr(writer)
            del writer
        with pytest.raises(LookupError):
            with ringlet.AnimationWriter(tmp_path / "with.rgc", swatch) as writer:
                raise LookupError
        del writer
        gc.collect()
    assert (tmp_path / "finish.rgc").exists()
    assert (tmp_path / "close.rgc.partial").exists() and not (tmp_path / "close.rgc").exists()
    closed = ringlet.AnimationWriter(tmp_path / "c.rgc", swatch)
    closed.close()
    with pytest.raises(ringlet.Error, match="is closed"):
        closed.write_points(swatch.points)


# A device stays one: root may replace it.
@pytest.mark.parametrize("path", ["/dev/full", "/dev/null"])
def test_what_is_no_file_is_not_replaced(swatch, path):
    if not os.path.exists(path):
        pytest.skip("SKIPPED, NOTHING WAS TESTED: there is no " + path)
    before = os.stat(path)
    with pytest.raises(ringlet.Error):
        ringlet.write_obj(path, swatch, swatch.points)
    with pytest.raises(ringlet.Error):
        ringlet.Material().write(path)
    after = os.stat(path)
    assert (after.st_mode, after.st_ino) == (before.st_mode, before.st_ino)


def test_a_pipe_and_a_link_to_one_are_not_replaced(tmp_path, swatch):
    os.mkfifo(tmp_path / "pipe.obj")
    os.symlink("pipe.obj", tmp_path / "link.obj")
    for ending in ringlet.AnimationWriter.formats():
        os.mkfifo(tmp_path / ("pipe" + ending))
    calls = [lambda name=name: ringlet.write_obj(tmp_path / name, swatch, swatch.points) for name in ("pipe.obj", "link.obj")]
    calls += [lambda name=name: swatch.write(tmp_path / name) for name in ("pipe.obj", "link.obj")]
    calls += [lambda ending=ending: ringlet.AnimationWriter(tmp_path / ("pipe" + ending), swatch)
              for ending in ringlet.AnimationWriter.formats()]
    for call in calls:
        with pytest.raises(ringlet.Error, match="pipe|link"):
            call()
    assert all((tmp_path / name).is_fifo() for name in ("pipe.obj", "link.obj", "pipe.usda", "pipe.pc2"))
