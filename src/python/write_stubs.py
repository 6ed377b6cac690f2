"""Writes the module's type stubs: ringlet.pyi, with the attributes of settings and materials filled in from the
module's tables.

write_stubs.py FOLDER_OF_THE_MODULE RINGLET_PYI OUTPUT
"""
import sys
from pathlib import Path

PLACE = "    # attributes of the table\n"


def attributes(module):
    """Of each class with a table: the lines of its attributes."""
    lines = {name: "" for name in ("Material", "ContactSettings", "AirSettings", "GoalSettings", "Settings")}
    tables = {"contacts": "ContactSettings", "air": "AirSettings", "goal": "GoalSettings", "": "Settings"}
    for row in module.Settings.fields():
        table, _, key = row["key"].rpartition(".")
        if key != "integrator":  # ringlet.pyi has it
            lines[tables[table]] += f"    {key}: {row['type']}\n"
    for row in module.Material.parameters():
        if "." not in row["key"]:
            lines["Material"] += f"    {row['key']}: {'float' if row['default'] is not None else 'float | None'}\n"
    return lines


def main(folder, template, output):
    sys.path.insert(0, folder)
    import ringlet

    text = Path(template).read_text()
    for name, lines in attributes(ringlet).items():
        head, found, rest = text.partition(f"class {name}:\n")
        before, place, after = rest.partition(PLACE)
        if not found or not place or "\nclass " in before:
            sys.exit(f"{template}: class {name} has no line '{PLACE.strip()}'")
        text = head + found + before + lines + after
    Path(output).parent.mkdir(parents=True, exist_ok=True)
    Path(output).write_text(text)


main(*sys.argv[1:])
