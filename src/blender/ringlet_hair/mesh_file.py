"""Meshes as OBJ text, which `ringlet simulate` reads as bodies."""
import numpy as np


def write_obj_mesh(path, points, triangles):
    """`points` (n, 3), `triangles` (m, 3) with indices from 0. Coordinates keep float32's nine digits."""
    with open(path, "w", encoding="ascii") as file:
        file.write("".join("v %.9g %.9g %.9g\n" % tuple(point) for point in np.asarray(points).tolist()))
        file.write("".join("f %d %d %d\n" % tuple(face) for face in (np.asarray(triangles) + 1).tolist()))
