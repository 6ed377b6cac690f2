"""A hair.usda that `ringlet simulate` wrote: its strands, and a line of points for each frame."""
import re
from dataclasses import dataclass

import numpy as np

from .errors import RingletError

SAMPLES = "point3f[] points.timeSamples = {"
COUNTS = re.compile(r"int\[\] curveVertexCounts = \[([0-9, \n]*)\]")
STATED = re.compile(r'(metersPerUnit|timeCodesPerSecond|upAxis) = "?([^"\s]+)')
BETWEEN = str.maketrans("(),", "   ")


@dataclass
class UsdHair:
    counts: np.ndarray            # (strands,) points of each
    metres_per_unit: float = 0.01  # what USD means where nothing is stated
    up: str = "Y"
    frames_per_second: float = 24.0


def read_usd_hair(path):
    """What stands before the frames. Raises RingletError for a file that is no animation of ringlet's."""
    stated, counts = {}, None
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            if line.strip() == SAMPLES:
                break
            for key, value in STATED.findall(line):
                stated[key] = value
            if "int[] curveVertexCounts = [" in line:
                while "]" not in line.partition("[] ")[2] and (more := file.readline()):
                    line += more
            if found := COUNTS.search(line):
                if counts is not None:
                    raise no_animation(path)
                counts = np.array(found.group(1).split(","), np.int64)
        else:
            raise no_animation(path)
    if counts is None:
        raise no_animation(path)
    return UsdHair(counts, float(stated.get("metersPerUnit", 0.01)), stated.get("upAxis", "Y"),
                   float(stated.get("timeCodesPerSecond", 24)))


def usd_frames(path):
    """Yields (points, 3) float32 arrays, in order. One frame of text is in memory at a time: 33 bytes a point.
    Raises RingletError for a file that is no animation of ringlet's, or ends too early."""
    with open(path, encoding="utf-8", errors="replace") as file:
        if not any(line.strip() == SAMPLES for line in file):
            raise no_animation(path)
        for line in file:
            _, _, rest = line.partition("[")
            text, _, end = rest.partition("]")
            if text:
                numbers = np.fromstring(text.translate(BETWEEN), np.float32, sep=" ")
                if numbers.size == 0 or numbers.size % 3:
                    raise RingletError(f"{path} holds a frame that is no list of points")
                yield numbers.reshape(-1, 3)
            if "}" in (end if text else line):
                return
    raise RingletError(f"{path} ends in the middle of its frames")


def no_animation(path):
    return RingletError(f"{path} is no animation of one groom, as `ringlet simulate` writes it: "
                        "choose the hair.usda of a run")
