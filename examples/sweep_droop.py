#!/usr/bin/env python3
"""How far does a curl droop, by how firm it is? Sweeps a number of the material and plots the droop of a swatch.

    PYTHONPATH=build/release/python python3 examples/sweep_droop.py
    PYTHONPATH=build/release/python python3 examples/sweep_droop.py --number core_stiffness --from 5 --to 500

Every value is a head of its own: all of them step together, in one submission a frame. Without matplotlib, or with
--table, the numbers are printed.
"""
import argparse

import numpy as np

import ringlet


def droops(device, groom, number, values, seconds):
    """The mean droop [m] of the swatch at the end of every frame, (values, frames), let go from its rest shape."""
    # Nothing of gravity is balanced at rest, so that the hair falls as far as it would.
    settings = ringlet.Settings(preload=0)
    asset = ringlet.Asset(device, groom, ringlet.Material.preset("ringlet"), settings, heads=len(values))
    heads = [ringlet.Hair(asset) for _ in values]
    for hair, value in zip(heads, values):
        hair.set_material(**{number: value})  # live: the heads share all that they have in common

    frames = max(1, round(seconds * settings.fps))
    droop = np.zeros((len(values), frames))
    for frame in range(frames):
        ringlet.step_frames([(hair, None) for hair in heads])
        for head, hair in enumerate(heads):
            shape = ringlet.measure_shape(groom, hair.positions(), head_rotation=hair.head, metres_per_unit=1)
            droop[head, frame] = shape["droop"].mean()
    return droop, settings.fps


def show_table(number, values, droop):
    print(f"{number:>20}  droop at the end [mm]  greatest [mm]")
    for value, row in zip(values, droop * 1000):
        print(f"{value:20.4g}  {row[-1]:21.2f}  {row.max():13.2f}")


def show_plot(number, values, droop, fps, path):
    import matplotlib
    matplotlib.use("Agg")  # into a file
    from matplotlib import pyplot

    figure, (over_time, at_end) = pyplot.subplots(1, 2, figsize=(11, 4), layout="constrained")
    seconds = (np.arange(droop.shape[1]) + 1) / fps
    for value, row in zip(values, droop * 1000):
        over_time.plot(seconds, row, label=f"{value:.3g}")
    over_time.set(xlabel="time [s]", ylabel="droop [mm]", title="let go at rest")
    over_time.legend(title=number, loc="upper right")
    at_end.semilogx(values, droop[:, -1] * 1000, "o-")
    at_end.set(xlabel=number, ylabel="droop [mm]", title=f"after {seconds[-1]:.3g} s")
    figure.savefig(path)
    print(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--number", default="bend_stiffness", help="of the material (default bend_stiffness)")
    parser.add_argument("--from", dest="low", type=float, default=1, help="least value (default 1)")
    parser.add_argument("--to", dest="high", type=float, default=100, help="greatest value (default 100)")
    parser.add_argument("--count", type=int, default=8, help="how many values (default 8)")
    parser.add_argument("--seconds", type=float, default=4, help="how long hair hangs (default 4)")
    parser.add_argument("--strands", type=int, default=25, help="of the swatch, about (default 25)")
    parser.add_argument("--device", help="by index or part of its name (default: the best)")
    parser.add_argument("--output", default="droop.png", help="the picture (default droop.png)")
    parser.add_argument("--table", action="store_true", help="print numbers, whether or not matplotlib is there")
    typed = parser.parse_args()

    side = max(1, round(typed.strands**0.5))
    groom = ringlet.make_swatch(columns=side, rows=side)
    values = np.geomspace(typed.low, typed.high, typed.count)
    droop, fps = droops(ringlet.Device(typed.device), groom, typed.number, values, typed.seconds)
    try:
        if not typed.table:
            return show_plot(typed.number, values, droop, fps, typed.output)
    except ImportError:
        print("matplotlib is not installed, so here are the numbers:")
    show_table(typed.number, values, droop)


if __name__ == "__main__":
    main()
