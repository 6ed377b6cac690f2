"""A run that is killed at frame 20 and goes on from its checkpoint: PYTHONPATH=build/release/python python3 examples/resume_run.py [SCENE]"""
import os
import signal
import sys
from pathlib import Path

import ringlet

scene = ringlet.Scene.load(sys.argv[1] if sys.argv[1:] else Path(__file__).with_name("turning_head.toml"))


def run(leftovers, callback=None):
    return scene.run(callback, folder="resumed", checkpoint=5, leftovers=leftovers)


child = os.fork()  # before a device is opened
if child == 0:
    run("overwrite", lambda frame: frame.number < 20 or os.kill(os.getpid(), signal.SIGKILL))
os.waitpid(child, 0)
done = run("resume")
print(f"{done.frame_count} frames, from {done.resumed_from} on: {done.positions_hash}")
print(*done.outputs, sep="\n")  # resumed/sheet.png is the picture
