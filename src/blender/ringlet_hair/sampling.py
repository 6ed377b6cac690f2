"""What of Blender's scene a run needs: the hair at one frame, and how it and the head move in all."""
from dataclasses import dataclass

import numpy as np

from .errors import RingletError
from .rigid_motion import RigidMotion, motion_of_matrices, motion_of_points


FEWEST_POINTS = 4  # by which a motion is known


@dataclass
class HeadMesh:
    name: str
    points: np.ndarray      # (n, 3) in the world at the bind frame [Blender unit]
    triangles: np.ndarray   # (m, 3)
    motion: RigidMotion     # of one that bends as the skin below the hair moves
    bent: list = None       # (n, 3) in the world at each frame, where it bends
    carries: bool = False   # it carries the hair


@dataclass
class Samples:
    sources: list           # HairSource
    strands: list           # Strands of each, in the world at the bind frame
    motion: RigidMotion     # of the hair
    head: HeadMesh          # or None
    frames: list            # of the motions
    bind: int               # into frames
    warnings: list


def sample(context, sources, head, frames, bind_frame):
    """Plays the scene's `frames` once; its frame is afterwards what it was. Raises RingletError."""
    scene = context.scene
    frame_before, subframe_before = scene.frame_current, scene.frame_subframe
    matrices = {source.object.name: [] for source in sources}
    head_points = []
    try:
        for frame in frames:
            scene.frame_set(frame)
            depsgraph = context.evaluated_depsgraph_get()
            for source in {source.object.name: source for source in sources}.values():
                matrices[source.object.name].append(np.array(source.object.evaluated_get(depsgraph).matrix_world))
            if head:
                head_points.append(mesh_points(head, depsgraph))
            if frame == bind_frame:
                strands = [source.strands(depsgraph) for source in sources]
                triangles = mesh_triangles(head, depsgraph) if head else None
    finally:
        scene.frame_set(frame_before, subframe=subframe_before)
    bind = list(frames).index(bind_frame)
    return combined(sources, strands, matrices, head, head_points, triangles, frames, bind)


def combined(sources, strands, matrices, head, head_points, triangles, frames, bind):
    """The motions of what was seen."""
    size = max(float(np.ptp(part.points, axis=0).max() + np.abs(part.points).max()) for part in strands)
    motions = [motion_of_matrices(matrices[source.object.name], matrices[source.object.name][bind], source.name)
               for source in sources]
    for source, motion in zip(sources, motions):
        if not motion.is_as(motions[0], size):
            raise RingletError(f"{sources[0].name} and {source.name} move differently; simulate one after the other")
    motion, mesh, warnings = motions[0], None, []
    if head:
        if len({len(points) for points in head_points}) > 1:
            raise RingletError(f"the mesh {head.name} has another count of points from frame to frame; "
                               "take the modifier that changes it off")
        head_motion, off = motion_of_points(head_points, head_points[bind])
        is_bent = off > 1e-3 * np.ptp(head_points[bind], axis=0).max()
        if is_bent:
            near = nearest_points(head_points[bind], np.concatenate([part.roots for part in strands]))
            if len(near) >= FEWEST_POINTS:
                head_motion, _ = motion_of_points([points[near] for points in head_points], head_points[bind][near])
        is_carried = motion.is_still(size)
        if is_carried:
            motion = head_motion
        elif is_bent:
            warnings.append(f"{head.name} bends, and {sources[0].name} moves by itself: roots go as it does, not with "
                            f"the skin of {head.name}")
        mesh = HeadMesh(head.name, head_points[bind], triangles, head_motion, head_points if is_bent else None, is_carried)
    return Samples(sources, strands, motion, mesh, list(frames), bind, warnings)


def nearest_points(points, roots):
    """Indices, each once, of the points nearest to the roots, of which a thousand count."""
    chosen = roots[np.linspace(0, len(roots) - 1, min(len(roots), 1000)).astype(int)]
    nearest = [int(np.argmin(((points - root) ** 2).sum(axis=1))) for root in chosen]
    return np.unique(nearest)


def mesh_points(head, depsgraph):
    evaluated = head.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    points = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", points)
    evaluated.to_mesh_clear()
    matrix = np.array(evaluated.matrix_world)
    return points.reshape(-1, 3).astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]


def mesh_triangles(head, depsgraph):
    evaluated = head.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    mesh.calc_loop_triangles()
    triangles = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    evaluated.to_mesh_clear()
    if len(triangles) == 0:
        raise RingletError(f"the mesh {head.name} has no faces; hair cannot stay out of it")
    triangles = triangles.reshape(-1, 3)
    if np.linalg.det(np.array(evaluated.matrix_world)[:3, :3]) < 0:
        triangles = triangles[:, ::-1]  # a mirrored object turns its faces inside out
    return triangles
