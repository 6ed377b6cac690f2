"""The motion of points as a PC2 file: a header and the float32 positions of every frame, so that any frame is
read at once."""
import os
import struct

import numpy as np

from .errors import RingletError

MAGIC = b"POINTCACHE2\0"
HEADER = struct.Struct("<12siiffi")  # magic, version 1, points, first frame, frames a sample, samples


class PointCache:
    """Reads a PC2 file. Errors are RingletError with the file's name."""

    def __init__(self, path):
        self.path = path
        try:
            with open(path, "rb") as file:
                header = file.read(HEADER.size)
            size = os.path.getsize(path)
        except OSError as error:
            raise RingletError(f"cannot read the motion {path}: {error.strerror}; simulate again") from error
        if len(header) < HEADER.size or not header.startswith(MAGIC):
            raise RingletError(f"{path} is no PC2 file; simulate again")
        _, version, self.points, self.first_frame, self.step, self.frames = HEADER.unpack(header)
        whole = HEADER.size + 12 * self.points * self.frames
        if version != 1 or self.points < 1 or self.frames < 1 or size != whole:
            raise RingletError(f"{path} has {size} bytes where {self.frames} frames of {self.points} points take "
                               f"{whole}; simulate again")

    def frame(self, index):
        """(points, 3) float32 of frame `index` from 0."""
        with open(self.path, "rb") as file:
            file.seek(HEADER.size + 12 * self.points * index)
            return np.fromfile(file, "<f4", 3 * self.points).reshape(-1, 3)

    def at(self, place):
        """Between frames on a straight line; before the first and after the last what these hold."""
        place = min(max(float(place), 0.0), self.frames - 1.0)
        before = int(place)
        share = np.float32(place - before)
        points = self.frame(before)
        if share == 0:
            return points
        return points + (self.frame(before + 1) - points) * share


def write_point_cache(path, frames, point_count, first_frame=1.0):
    """From an iterable of (points, 3) arrays. The count of frames is written last, so that a file that was
    left in the middle says that it has none."""
    count = 0
    with open(path, "wb") as file:
        file.write(HEADER.pack(MAGIC, 1, point_count, first_frame, 1.0, 0))
        for points in frames:
            assert points.shape == (point_count, 3), "every frame has all points"
            file.write(np.ascontiguousarray(points, "<f4").tobytes())
            count += 1
        file.seek(0)
        file.write(HEADER.pack(MAGIC, 1, point_count, first_frame, 1.0, count))
    return count
