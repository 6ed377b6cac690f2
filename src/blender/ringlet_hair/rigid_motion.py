"""Rigid motions: how an object or a mesh moves from frame to frame, as turns and shifts of the world."""
from dataclasses import dataclass

import numpy as np

from .errors import RingletError

LARGEST_SHEAR = 1e-4  # of a matrix whose columns should be of unit length and perpendicular


@dataclass
class RigidMotion:
    """x(frame) = rotations[frame] @ x(bind) + shifts[frame], x in the world."""
    rotations: np.ndarray  # (frames, 3, 3)
    shifts: np.ndarray     # (frames, 3)

    def is_still(self, size):
        """Whether points within `size` of the origin stay where they are, within 1e-6 of `size`."""
        turned = np.abs(self.rotations - np.eye(3)).max() * size
        return max(turned, np.abs(self.shifts).max()) <= 1e-6 * size

    def is_as(self, other, size):
        """Whether both take such points to the same places, within 1e-5 of `size`."""
        turned = np.abs(self.rotations - other.rotations).max() * size
        return max(turned, np.abs(self.shifts - other.shifts).max()) <= 1e-5 * size

    def positions_of(self, point):
        """(frames, 3): where a point of the bind frame goes."""
        return self.rotations @ point + self.shifts

    def quaternions(self):
        """(frames, 4), x y z w, neighbours on the same side of the sphere."""
        all_of_them = np.array([quaternion_of(rotation) for rotation in self.rotations])
        for i in range(1, len(all_of_them)):
            if all_of_them[i] @ all_of_them[i - 1] < 0:
                all_of_them[i] *= -1
        return all_of_them


def motion_of_matrices(matrices, bind, name):
    """From (frames, 4, 4) world matrices of an object, and the one of the bind frame. Raises RingletError
    where the object's scale changes on the way."""
    relative = np.asarray(matrices, np.float64) @ np.linalg.inv(np.asarray(bind, np.float64))
    rotations = relative[:, :3, :3]
    unit = rotations.transpose(0, 2, 1) @ rotations
    if np.abs(unit - np.eye(3)).max() > LARGEST_SHEAR:
        raise RingletError(f"the scale of {name} changes while it moves; hair can only follow what moves and "
                           "turns. Take the keys off the scale")
    return RigidMotion(rotations, relative[:, :3, 3])


def motion_of_points(frames, bind):
    """The nearest rigid motion (least squares; Kabsch 1976) of points, (frames, points, 3) and (points, 3);
    and how far a point is from it at most."""
    bind = np.asarray(bind, np.float64)
    centre = bind.mean(axis=0)
    rotations, shifts, off = [], [], 0.0
    for points in frames:
        points = np.asarray(points, np.float64)
        middle = points.mean(axis=0)
        u, _, vt = np.linalg.svd((points - middle).T @ (bind - centre))
        rotation = u @ np.diag([1, 1, np.sign(np.linalg.det(u @ vt))]) @ vt
        shift = middle - rotation @ centre
        off = max(off, np.linalg.norm(points - (bind @ rotation.T + shift), axis=1).max())
        rotations.append(rotation)
        shifts.append(shift)
    return RigidMotion(np.array(rotations), np.array(shifts)), off


def quaternion_of(m):
    """x y z w of a rotation matrix, by its largest component."""
    w, x, y, z = (1 + m[0, 0] + m[1, 1] + m[2, 2], 1 + m[0, 0] - m[1, 1] - m[2, 2],
                  1 - m[0, 0] + m[1, 1] - m[2, 2], 1 - m[0, 0] - m[1, 1] + m[2, 2])
    largest = int(np.argmax([x, y, z, w]))
    q = [np.array([x, m[0, 1] + m[1, 0], m[0, 2] + m[2, 0], m[2, 1] - m[1, 2]]),
         np.array([m[0, 1] + m[1, 0], y, m[1, 2] + m[2, 1], m[0, 2] - m[2, 0]]),
         np.array([m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], z, m[1, 0] - m[0, 1]]),
         np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], w])][largest]
    return q / np.linalg.norm(q)
