#!/usr/bin/env python3
"""Writes docs/command-line.md, docs/scene-keys.md and docs/material-numbers.md from what the program says of itself.

reference_pages.py RINGLET [FOLDER]   writes the pages into FOLDER (default: docs)
reference_pages.py RINGLET --check    exits with 1 and names the pages of docs that are out of date
"""
import json
import re
import subprocess
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1] / "docs"
NOTE = "This page is generated: `scripts/reference_pages.py build/release/ringlet`. Do not edit it.\n\n"


def said(ringlet, *arguments):
    return subprocess.run([ringlet, *arguments], check=True, capture_output=True, text=True).stdout


def cell(text):
    return str(text).replace("|", "\\|")


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(cell(entry) for entry in row) + " |" for row in rows]) + "\n"


def command_line(ringlet):
    """The help of every command."""
    return "# Command line\n\n" + NOTE + helps(ringlet, [])


def helps(ringlet, command):
    """The help of a command and of those below it."""
    text = said(ringlet, *command, "--help").rstrip()
    page = f"## {' '.join(['ringlet', *command])}\n\n```text\n{text}\n```\n"
    below = text.partition("Subcommands:")[2]
    return page + "".join("\n" + helps(ringlet, [*command, name]) for name in re.findall(r"^  ([a-z]+)  ", below, re.M))


def scene_keys(ringlet):
    """Every key of a scene file, a table of each table."""
    keys = json.loads(said(ringlet, "scene", "--keys", "--json"))["keys"]
    page = "# Keys of scene files\n\n" + NOTE + "[scene-files.md](scene-files.md) says how they go together.\n"
    for name in dict.fromkeys(key["table"] for key in keys):
        rows = []
        for key in (key for key in keys if key["table"] == name):
            kind = " ".join(filter(None, [key["type"], key["range"]]))
            only = f" Only with {key['only_with']}." if key["only_with"] else ""
            rows.append([f"`{key['key']}`", kind, key["default"], key["effect"] + only])
        page += f"\n## {name}\n\n" + table(["key", "value", "default", "meaning"], rows)
    return page


def material_numbers(ringlet):
    """Presets, and every number of a material."""
    listed = json.loads(said(ringlet, "material", "--list", "--json"))
    page = "# Numbers of materials\n\n" + NOTE
    page += "[art-direction.md](art-direction.md) says which of them changes what you see. The unit w is a strand's own weight.\n\n"
    page += "## Presets\n\n" + table(["preset", "hair"], [[f"`{p['name']}`", p["summary"]] for p in listed["presets"]])
    for name in (name for name in listed if isinstance(listed[name], list) and name != "presets"):
        page += f"\n## {name.capitalize()}\n\n"
        page += table(["key", "unit", "default", "usual", "allowed", "effect"],
                      [[f"`{number['key']}`", number["unit"],
                        default(number["default"]),
                        span(number, "usual_low", "usual_high"), span(number, "low", "high"), number["effect"]]
                       for number in listed[name]])
    return page


def default(value):
    if value is None:
        return "measured on the groom"
    return f"{value:g}" if isinstance(value, (int, float)) else json.dumps(value)


def span(number, low, high):
    return f"{number[low]:g} to {number[high]:g}"


PAGES = {"command-line.md": command_line, "scene-keys.md": scene_keys, "material-numbers.md": material_numbers}


def main():
    ringlet, where = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else str(DOCS)
    stale = []
    for name, page in PAGES.items():
        text = page(ringlet)
        if where != "--check":
            (Path(where) / name).write_text(text)
        elif not (DOCS / name).exists() or (DOCS / name).read_text() != text:
            stale.append(name)
    if stale:
        sys.exit(f"out of date in docs: {', '.join(stale)}; run scripts/reference_pages.py {ringlet}")


if __name__ == "__main__":
    main()
