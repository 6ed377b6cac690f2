"""The program as a child: found, started, watched, ended. A small script stands for it."""
import stat
import sys

import pytest

from ringlet_hair.errors import RingletError
from ringlet_hair.program import Run, command_line, find_program


@pytest.fixture
def program(tmp_path):
    """Makes a program of a Python text."""

    def make(text):
        path = tmp_path / "ringlet"
        path.write_text(f"#!{sys.executable}\nimport sys, time\n{text}")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return str(path)

    return make


def finished(path):
    run = Run([path])
    run.wait(60)
    return run


def test_programs_are_found(program, tmp_path, monkeypatch):
    path = program("")
    assert find_program(path) == path
    monkeypatch.setenv("PATH", str(tmp_path))
    assert find_program("") == path
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(RingletError, match="no program ringlet in PATH; name it in the add-on's preferences"):
        find_program("")
    with pytest.raises(RingletError, match="no program /nowhere/ringlet"):
        find_program("/nowhere/ringlet")


def test_command_lines():
    line = command_line("ringlet", "a b.toml", "out", "--hold 1.5 --device 'llvm pipe'")
    assert line[:5] == ["ringlet", "simulate", "a b.toml", "-o", "out"]
    assert {"--json", "--json-progress", "--overwrite", "--quiet"} < set(line)
    assert line[-4:] == ["--hold", "1.5", "--device", "llvm pipe"]
    with pytest.raises(RingletError, match="'--hold \"1' cannot be read"):
        command_line("ringlet", "a", "b", '--hold "1')


def test_progress_and_report(program):
    run = finished(program("""
print('{"frame": 1, "frames": 2, "seconds": 1, "seconds_left": 1.5}', flush=True)
print('{"frame": 2, "frames": 2, "seconds": 2, "seconds_left": 0}')
print('warning: of little weight', file=sys.stderr)
print('{\\n  "frames": 2,\\n  "warnings": ["a"]\\n}')"""))
    assert (run.frame, run.frames, run.seconds_left) == (2, 2, 0)
    assert run.result() == {"frames": 2, "warnings": ["a"]}


def test_what_a_program_says_went_wrong_stands_as_it_is(program):
    run = finished(program("sys.exit('ringlet simulate: a.hair: at byte 4: found 7; expected 8')"))
    with pytest.raises(RingletError, match="^ringlet simulate: a.hair: at byte 4: found 7; expected 8$"):
        run.result()


def test_a_program_that_says_nothing(program):
    with pytest.raises(RingletError, match="ended with status 7 and said nothing"):
        finished(program("sys.exit(7)")).result()
    with pytest.raises(RingletError, match="ended with status 0 and said nothing"):
        finished(program("")).result()


def test_particles_without_a_position_are_a_warning(program):
    run = finished(program("""print('{"warnings": [], "nonfinite": 5}'); sys.exit(3)"""))
    assert run.result()["warnings"] == ["5 particles have no finite position"]


def test_much_on_both_pipes_stops_nobody(program):
    run = finished(program("""
for _ in range(20000): print('x' * 30, file=sys.stderr)
for _ in range(20000): print(' ' * 30)
print('{"warnings": []}')"""))
    assert run.result() == {"warnings": []}


@pytest.mark.parametrize("end", ["cancel", "kill"])
def test_runs_are_ended(program, end):
    run = Run([program("print('{\"frame\": 1, \"frames\": 9, \"seconds\": 0, \"seconds_left\": 8}', flush=True)\n"
                       "time.sleep(600)")])
    while run.frame == 0:
        assert not run.is_over()
    getattr(run, end)()
    run.wait(60)
    with pytest.raises(RingletError, match="cancelled"):
        run.result()


def test_a_program_that_cannot_be_started(tmp_path):
    (tmp_path / "ringlet").write_text("no program")
    with pytest.raises(RingletError, match="cannot be started: Permission denied"):
        Run([str(tmp_path / "ringlet")])
