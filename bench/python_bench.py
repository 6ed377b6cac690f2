#!/usr/bin/env python3
"""What a callback a frame costs: a scene run by the Python module, its positions read, beside `ringlet simulate`.

    PYTHONPATH=build/release/python python3 bench/python_bench.py build/release/ringlet

Both run the same head, in turn, and write nothing; the best of the rounds counts. On a quiet machine the module should take at
most 10 % longer.
"""
import argparse
import json
import subprocess
import tempfile
import time
from pathlib import Path

import ringlet

SCENE = """
[groom]
generate = "head"
strands = {strands}
particles = {particles}
[motion]
kind = "shake"
[simulation]
frames = {frames}
steps_per_frame = 8
[output]
files = []
"""


def by_program(program, folder):
    done = subprocess.run([program, "simulate", "scene.toml", "-o", "out", "--json", "--untuned", "--quiet"], cwd=folder,
                          capture_output=True, text=True, check=True)
    told = json.loads(done.stdout)
    return 1000 * told["wall_s"]["frames"] / told["frames"], told["positions_hash"]


def by_module(device, folder):
    scene = ringlet.Scene.load(folder / "scene.toml")
    times = []

    def callback(frame):
        float(frame.positions[:, 1].min())
        times.append(time.perf_counter())

    run = scene.run(callback, device=device)
    return 1000 * (times[-1] - times[0]) / (len(times) - 1), run.positions_hash


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="the ringlet command")
    parser.add_argument("--strands", type=int, default=1000)
    parser.add_argument("--particles", type=int, default=64)
    parser.add_argument("--frames", type=int, default=100)
    parser.add_argument("--rounds", type=int, default=5)
    typed = parser.parse_args()
    device = ringlet.Device()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "scene.toml").write_text(SCENE.format(**vars(typed)))
        rounds = [(by_program(typed.program.resolve(), folder), by_module(device, folder)) for _ in range(typed.rounds)]
    assert len({hashed for both in rounds for _, hashed in both}) == 1, "they did not compute the same"
    program, module = (min(both[which][0] for both in rounds) for which in (0, 1))
    print(f"{device.name}: {typed.strands} x {typed.particles}, ms a frame: program {program:.3f}, module {module:.3f}, "
          f"{100 * (module / program - 1):+.1f} %")


if __name__ == "__main__":
    main()
