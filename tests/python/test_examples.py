# The examples do what they say, with small numbers.
import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import ringlet

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def sweep(folder, *arguments):
    done = subprocess.run([sys.executable, EXAMPLES / "sweep_droop.py", "--count", "3", "--seconds", "0.5",
                           "--strands", "4", *arguments], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


def test_firmer_curls_droop_less(device, tmp_path):
    lines = sweep(tmp_path, "--table")
    rows = [[float(number) for number in line.split()] for line in lines[1:]]
    assert [row[0] for row in rows] == [1, 10, 100]
    assert rows[0][2] > rows[1][2] > rows[2][2] > 0


def test_the_droop_is_plotted_where_it_can_be(device, tmp_path):
    lines = sweep(tmp_path, "--number", "core_stiffness")
    if importlib.util.find_spec("matplotlib"):
        assert lines == ["droop.png"]
        assert (tmp_path / "droop.png").read_bytes().startswith(b"\x89PNG")
    else:
        assert lines[0].startswith("matplotlib is not installed") and len(lines) == 5


def test_a_wrong_number_is_named_with_the_nearest(device, tmp_path):
    done = subprocess.run([sys.executable, EXAMPLES / "sweep_droop.py", "--number", "bend_stifness", "--count", "1"],
                          cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode != 0 and "did you mean bend_stiffness" in done.stderr


@pytest.mark.parametrize("page", ["README.md", "docs/python.md"])
def test_what_the_pages_show_runs(device, tmp_path, monkeypatch, capsys, page):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", (EXAMPLES.parent / page).read_text(), re.S)
    assert blocks
    names = {}
    for block in blocks:
        exec(compile(block, page, "exec"), names)
    assert np.isfinite(names["hair"].positions()).all() and capsys.readouterr().out


def test_every_example_says_what_it_does():
    for path in EXAMPLES.glob("*.py"):
        source = path.read_text()
        assert '"""' in source and compile(source, str(path), "exec")
    assert ringlet.__doc__


def test_a_killed_run_goes_on(device, tmp_path):
    scene = tmp_path / "scene.toml"
    scene.write_text('[groom]\ngenerate = "swatch"\ncolumns = 2\nrows = 2\nparticles = 20\nturns = 3\n'
                     '[motion]\nkind = "shake"\n[simulation]\nframes = 24\nsteps_per_frame = 4\n')
    done = subprocess.run([sys.executable, EXAMPLES / "resume_run.py", scene], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    first, *files = done.stdout.splitlines()
    told = re.fullmatch(r"24 frames, from (5|10|15|20) on: (\w+)", first)
    assert told and told[2] == ringlet.Scene.load(scene).run(device=device).positions_hash, first
    assert sorted(Path(name).name for name in files) == ["hair.usda", "last.obj", "sheet.png"]
    assert all((tmp_path / name).stat().st_size for name in files)
