"""Grooms as .hair files (Cem Yuksel's format), which `ringlet simulate` reads."""
import struct

import numpy as np

from .errors import RingletError

MOST_POINTS = 65536  # of a strand: the format counts edges in 16 bits
SEGMENTS, POINTS = 1, 2  # bits of the flags: which arrays there are


def write_hair(path, strands):
    """Writes a Strands to `path`, points as float32, little-endian; 12 bytes a point. Raises RingletError
    for a strand of more points than the format counts, OSError where the file cannot be written."""
    longest = int(strands.counts.max())
    if longest > MOST_POINTS:
        raise RingletError(f"a curve has {longest} points; at most {MOST_POINTS} can be sent. Resample it")
    header = struct.pack("<4sIIIIff3f88s", b"HAIR", len(strands.counts), len(strands.points),
                         SEGMENTS | POINTS, 0, 1.0, 0.0, 1.0, 1.0, 1.0, b"Blender")
    with open(path, "wb") as file:
        file.write(header)
        file.write((strands.counts - 1).astype("<u2").tobytes())
        file.write(strands.points.astype("<f4").tobytes())
