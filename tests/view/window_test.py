"""A scripted session of `ringlet view`: real input events (xdotool) in a display without a screen (Xvfb), ten pictures of
the window, and what must be seen in them. Usage: window_test.py RINGLET [FOLDER]. Exit status 77: skipped."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
import zlib
from pathlib import Path

SCENE = """
[groom]
generate = "head"
strands = 80
particles = 24
turns = 4

[simulation]
steps_per_frame = 8

[[body]]
shape = "sphere"
radius = 0.04
position = [0.2, -0.1, 0.1]
moves = "still"
"""
PATIENCE = 120  # seconds, on a busy machine


def skip(why):
    print(f"SKIPPED, NOTHING WAS TESTED: {why}")
    sys.exit(77)


def read_png(path):
    """Width, height and rows of bytes, red, green, blue."""
    data = path.read_bytes()
    at, packed, width, height = 8, b"", 0, 0
    while at < len(data):
        length, kind = int.from_bytes(data[at : at + 4], "big"), data[at + 4 : at + 8]
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            width, height = int.from_bytes(body[:4], "big"), int.from_bytes(body[4:8], "big")
            assert body[8:10] == b"\x08\x02", "8 bits of red, green, blue"
        if kind == b"IDAT":
            packed += body
        at += length + 12
    raw, stride = zlib.decompress(packed), 3 * width
    rows, above = [], bytearray(stride)
    for y in range(height):
        how, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
        for i in range(stride if how else 0):
            left, corner = (row[i - 3], above[i - 3]) if i >= 3 else (0, 0)
            if how == 4:
                guess = left + above[i] - corner
                near = sorted((abs(guess - v), k, v) for k, v in enumerate((left, above[i], corner)))[0][2]
            row[i] = (row[i] + (0, left, above[i], (left + above[i]) // 2, near if how == 4 else 0)[how]) & 255
        rows.append(bytes(row))
        above = row
    return width, height, rows


class Picture:
    def __init__(self, path, width):
        self.name, all_width, self.height, self.rows = path.name, *read_png(path)
        self.width = min(width, all_width)  # without the panel

    def pixels(self, first=0, last=None):
        for row in self.rows:
            yield row[3 * first : 3 * (last or self.width)]

    def differing(self, other):
        assert self.height == other.height
        count = 0
        for a, b in zip(self.pixels(), other.pixels()):
            count += sum(a[i : i + 3] != b[i : i + 3] for i in range(0, len(a), 3)) if a != b else 0
        return count

    def hair(self, first=0, last=None):
        """Number and mean column of pixels that have the colour of hair: far redder than blue."""
        count = columns = 0
        for row in self.pixels(first, last):
            for i in range(0, len(row), 3):
                if row[i] > row[i + 2] + 40:
                    count += 1
                    columns += i // 3
        return count, columns / max(count, 1)


class Session:
    def __init__(self, ringlet, folder):
        self.folder, self.shots = folder, folder / "shots"
        reading, writing = os.pipe()
        self.display = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1024x600x24", "-nolisten", "tcp"],
            pass_fds=[writing], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writing)
        number = os.read(reading, 16).decode().strip()
        assert number, "Xvfb does not start"
        # Not the user's cache, who may have tuned.
        cache = os.environ.get("RINGLET_CACHE_DIR", str(Path(ringlet).parent / "tests" / "cache"))
        self.environment = {**os.environ, "RINGLET_CACHE_DIR": cache, "DISPLAY": f":{number}", "RINGLET_VALIDATION": "1"}
        (folder / "scene.toml").write_text(SCENE)
        self.program = subprocess.Popen(
            [ringlet, "view", "scene.toml", "--paused", "--size", "480x360", "--widgets", "widgets.json", "--save",
             "saved.toml", "--screenshots", "shots", "--json"],
            cwd=folder, env=self.environment, stdout=(folder / "out.json").open("w"), stderr=(folder / "err.txt").open("w"))

    def end(self):
        for process in (self.program, self.display):
            if process.poll() is None:
                process.terminate()
                process.wait()

    def state(self):
        try:
            return json.loads((self.folder / "widgets.json").read_text())
        except FileNotFoundError:
            return {"frames": 0, "widgets": {}}

    def until(self, what, condition):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            assert self.program.poll() is None, f"it ended: {(self.folder / 'err.txt').read_text()}"
            state = self.state()
            if condition(state):
                return state
            time.sleep(0.02)
        raise AssertionError(f"in vain: {what}; {self.state()}")

    def frames(self, count):
        first = self.state()["frames"]
        return self.until(f"{count} frames", lambda s: s["frames"] >= first + count)

    def do(self, *words):
        subprocess.run(["xdotool", *map(str, words)], env=self.environment, check=True, stdout=subprocess.DEVNULL)

    def key(self, name):
        self.do("key", name)
        return self.frames(3)

    def drag(self, start, end, button=1):
        self.do("mousemove", *start)
        self.frames(2)
        self.do("mousedown", button)
        self.frames(2)
        for k in range(1, 5):
            self.do("mousemove", *(round(a + (b - a) * k / 4) for a, b in zip(start, end)))
            self.frames(1)
        self.do("mouseup", button)
        return self.frames(2)

    def place(self, widget, across=0.5):
        left, top, width, height = self.until(widget, lambda s: widget in s["widgets"])["widgets"][widget]
        return round(left + across * width), round(top + height / 2)

    def click(self, widget):
        self.do("mousemove", *self.place(widget))
        self.frames(2)
        self.do("mousedown", 1)
        self.frames(2)
        self.do("mouseup", 1)
        return self.frames(3)

    def slide(self, widget, start, end):
        return self.drag(self.place(widget, start), self.place(widget, end))

    def picture(self):
        count = len(list(self.shots.glob("*.png"))) if self.shots.exists() else 0
        path = self.shots / f"window.{count + 1:04}.png"
        self.do("key", "F12")
        state = self.until("a picture", lambda s: path.name in s["message"])
        return Picture(path, state["picture"][2])

    def saved(self):
        (self.folder / "saved.toml").unlink(missing_ok=True)
        self.do("key", "ctrl+s")
        self.until("a saved scene", lambda s: (self.folder / "saved.toml").exists())
        return tomllib.loads((self.folder / "saved.toml").read_text())


def look_and_drag(session):
    session.until("a window", lambda s: s["frames"] >= 3)
    session.do("mousemove", 240, 180)
    first = session.picture()
    assert first.hair()[0] > 2000, first.hair()
    eye = session.state()["eye"]
    turned = session.drag((100, 300), (220, 280))
    assert turned["eye"] != eye, "the camera goes around"
    assert session.picture().differing(first) > 5000
    session.key("h")
    assert session.picture().differing(first) == 0, "home again, the picture is the same to the bit"

    # The head goes where the mouse goes, and hair with it.
    assert session.key("space")["playing"]
    session.do("keydown", "ctrl")
    session.drag((230, 150), (290, 150))
    session.do("keyup", "ctrl")
    moved = session.frames(8)
    head = moved["head"]
    assert head[0] > 0.02 and abs(head[1]) < 0.005, head
    picture = session.picture()
    assert picture.hair()[1] > first.hair()[1] + 15, (picture.hair(), first.hair())
    assert not session.key("space")["playing"]
    session.key("r")
    assert session.picture().differing(first) == 0, "reset, the picture is the same to the bit"
    return first


def turn_dials(session):
    session.slide("material.dials.hold", 0.5, 0.02)
    hold = session.saved()["material"]["dials"]["hold"]
    assert hold < 0.7, hold
    session.key("ctrl+z")
    assert session.saved().get("material", {}).get("dials", {}).get("hold", 1) == 1
    session.key("ctrl+y")
    assert session.saved()["material"]["dials"]["hold"] == hold
    return hold


def blow(session, still):
    session.click("tab.air")
    session.key("w")
    session.slide("air.wind.x", 0.5, 0.75)
    session.key("space")
    session.frames(25)
    blown = session.picture()
    assert blown.hair()[1] > still.hair()[1] + 4, (blown.hair(), still.hair())
    air = session.saved()["air"]
    assert air.get("on", True) and air["wind"][0] > 5 and air["wind"][1:] == [0, 0], air
    return air["wind"][0]


def push_body(session):
    x, y, _ = session.state()["solids"][0]
    before = session.state()["solids"][0]
    session.do("keydown", "ctrl")
    session.do("mousemove", round(x), round(y))
    session.frames(2)
    session.do("mousedown", 1)
    assert session.frames(2)["dragged"] == "body 1", session.state()
    session.do("mousemove_relative", "--", -60, 0)
    session.frames(3)
    session.do("mouseup", 1, "keyup", "ctrl")
    after = session.frames(10)["solids"][0]
    assert before[0] - 75 < after[0] < before[0] - 45, (before, after)
    session.picture()


def compare(session):
    session.click("tab.hair")
    session.click("compare")
    session.click("B")
    session.slide("material.dials.hold", 0.05, 0.98)
    session.frames(20)
    both = session.picture()
    halves = both.hair(0, both.width // 2), both.hair(both.width // 2)
    assert min(count for count, _ in halves) > 500, halves
    assert abs(halves[0][1] - halves[1][1]) > 2, f"the firmer hair is blown less far: {halves}"
    session.click("A")
    session.click("compare")


def show_more(session):
    assert not session.key("space")["playing"]
    plain = session.picture()
    session.key("s")
    assert session.picture().differing(plain) > 1000, "strands have other colours"
    session.key("s")
    session.key("f")
    session.key("c")
    session.picture()
    state = session.key("Tab")
    assert state["picture"][2] == 800 and not state["widgets"], "without the panel the picture is wider"
    session.key("Tab")


def end(session, ringlet, hold, wind):
    session.do("key", "ctrl+q")
    assert session.program.wait(PATIENCE) == 0
    err = (session.folder / "err.txt").read_text()
    assert not any(word in err for word in ("VUID", "SYNC-", "UNASSIGNED")), err
    told = json.loads((session.folder / "out.json").read_text())
    assert told["frames"] > 100 and told["strands"] == 80, told
    assert len(list(session.shots.glob("*.png"))) >= 10
    saved = tomllib.loads((session.folder / "saved.toml").read_text())
    assert saved["material"]["dials"]["hold"] == hold and saved["air"]["wind"][0] == wind
    run = subprocess.run([ringlet, "simulate", "saved.toml", "--frames", "2", "-o", "run", "--quiet"],
                         cwd=session.folder, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    print(f"{told['frames']} frames, {told['cpu_ms_per_frame']:.0f} ms of CPU each")


def main():
    ringlet = str(Path(sys.argv[1]).absolute())
    for tool, package in (("Xvfb", "xvfb"), ("xdotool", "xdotool")):
        if not shutil.which(tool):
            skip(f"{tool} is not installed (Debian: {package})")
    with tempfile.TemporaryDirectory() as made:
        folder = Path(sys.argv[2] if len(sys.argv) > 2 else made).absolute()
        folder.mkdir(exist_ok=True)
        # Without a display the program says so.
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        (folder / "scene.toml").write_text(SCENE)
        without = subprocess.run([ringlet, "view", "scene.toml"], cwd=folder, env=environment, capture_output=True,
                                 text=True)
        if "built without a window" in without.stderr:
            skip(without.stderr.strip())
        assert without.returncode == 1 and "xvfb-run" in without.stderr, without
        session = Session(ringlet, folder)
        try:
            still = look_and_drag(session)
            hold = turn_dials(session)
            wind = blow(session, still)
            push_body(session)
            compare(session)
            show_more(session)
            end(session, ringlet, hold, wind)
        finally:
            session.end()


if __name__ == "__main__":
    main()
