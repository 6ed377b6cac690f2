#!/usr/bin/env python3
"""Prints the table of docs/art-direction.md: what each dial does at half and at double, as factors on the scene
without it. Usage: scripts/dial_table.py RINGLET (the program)."""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

SCENES = {
    "hanging_curl": (["--preload", "0"], ("droop", "core", "Hz", "settle")),
    "bounce": (["--seconds", "12"], ("worst", "core", "Hz", "settle")),
    "walk_head": (["--strands", "60", "--contacts", "off"], ("worst", "core")),
}
DIALS = [(name, (0.5, 2)) for name in ("bounce", "weight", "hold", "spring-back", "curl-keep", "root-hold", "tip-hold")]
DIALS.append(("wet", (0.5, 1)))


def measured(scene, extra):
    run = subprocess.run([sys.argv[1], "scene", scene, "--json", *SCENES[scene][0], *extra], capture_output=True,
                         text=True, check=True)
    found = json.loads(run.stdout)
    return {"droop": found["droop_mm"], "worst": abs(found["worst"]["droop_mm"]),
            "core": found["worst"]["core_elongation"] - 1, "Hz": found["bounce_hz"], "settle": found["settle_s"]}


def heights(obj):
    return [float(line.split()[2]) for line in obj.read_text().splitlines() if line.startswith("v ")]


def quarters(folder, extra):
    """By how much the first and the last quarter of hanging_curl lengthen downwards."""
    scene = folder / "curl.toml"
    if not scene.exists():
        subprocess.run([sys.argv[1], "scene", "hanging_curl", "--preload", "0", "--write", scene], check=True,
                       stdout=subprocess.DEVNULL)
    subprocess.run([sys.argv[1], "simulate", scene, "-o", folder / "out", "--overwrite", "--no-usd", "--no-sheet",
                    "--quiet", *extra], check=True)
    rest, now = heights(folder / "curl-groom.obj"), heights(folder / "out/last.obj")
    droop = [before - after for before, after in zip(rest, now)]
    last = len(droop) - 1
    return {"first quarter": droop[last // 4] - droop[0], "last quarter": droop[last] - droop[last - last // 4]}


def main():
    with tempfile.TemporaryDirectory() as folder:
        write_table(Path(folder))


def write_table(folder):
    plain = {scene: measured(scene, []) for scene in SCENES}
    plain_quarters = quarters(folder, [])
    columns = [f"{scene}: {column}" for scene, (_, names) in SCENES.items() for column in names]
    columns += [f"hanging_curl: {name}" for name in plain_quarters]
    print("| dial | " + " | ".join(columns) + " |")
    print("|---" * (len(columns) + 1) + "|")
    for dial, values in DIALS:
        for value in values:
            cells = []
            for scene, (_, names) in SCENES.items():
                found = measured(scene, [f"--{dial}", str(value)])
                cells += [f"{found[name] / plain[scene][name]:.2f}" for name in names]
            cells += [f"{share / plain_quarters[name]:.2f}"
                      for name, share in quarters(folder, [f"--{dial}", str(value)]).items()]
            print(f"| `--{dial} {value}` | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
