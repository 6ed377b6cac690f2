"""Strands as arrays: the points of all, one strand after another, and how many each has."""
from dataclasses import dataclass

import numpy as np

from .errors import RingletError


@dataclass
class Strands:
    points: np.ndarray  # (points, 3) float64, root first
    counts: np.ndarray  # (strands,) int, points of each

    def __post_init__(self):
        self.points = np.asarray(self.points, np.float64).reshape(-1, 3)
        self.counts = np.asarray(self.counts, np.int64)
        assert self.counts.sum() == len(self.points), "every point belongs to a strand"

    @property
    def roots(self):
        """(strands, 3): the first point of each."""
        return self.points[np.cumsum(self.counts) - self.counts]

    def check(self, name):
        """Raises RingletError where a strand cannot be simulated; `name` is whose strands these are."""
        if len(self.counts) == 0:
            raise RingletError(f"{name} has no curves")
        short = np.flatnonzero(self.counts < 2)
        if len(short):
            raise RingletError(
                f"{name}: curve {short[0]} has {self.counts[short[0]]} point(s), as have {len(short)} in all; "
                "a strand takes 2 or more. Delete these curves")
        if not np.isfinite(self.points).all():
            raise RingletError(f"{name}: a point has a coordinate that is not finite")


def joined(parts):
    """One after another."""
    return Strands(np.concatenate([part.points for part in parts]),
                   np.concatenate([part.counts for part in parts]))
