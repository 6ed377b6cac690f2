#!/usr/bin/env python3
"""Prints the table of docs/art-direction.md: what each dial does at half and at double, as factors on the scene
without it. Usage: scripts/dial_table.py RINGLET (the program)."""
import json
import subprocess
import sys

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


def main():
    plain = {scene: measured(scene, []) for scene in SCENES}
    columns = [f"{scene}: {column}" for scene, (_, names) in SCENES.items() for column in names]
    print("| dial | " + " | ".join(columns) + " |")
    print("|---" * (len(columns) + 1) + "|")
    for dial, values in DIALS:
        for value in values:
            cells = []
            for scene, (_, names) in SCENES.items():
                found = measured(scene, [f"--{dial}", str(value)])
                cells += [f"{found[name] / plain[scene][name]:.2f}" for name in names]
            print(f"| `--{dial} {value}` | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
