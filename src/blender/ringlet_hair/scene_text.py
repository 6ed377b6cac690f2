"""The scene file of a run: TOML text, whose keys `ringlet scene --keys` lists."""
from dataclasses import dataclass, field
from typing import Optional

import numpy as np

from .rigid_motion import RigidMotion

# The first line of every scene file of the add-on, by which it knows its folders.
SCENE_HEADING = "# Written by the Ringlet add-on of Blender; `ringlet simulate` runs it by itself, too."


@dataclass
class Keys:
    """Poses over time of what moves rigidly, about a pivot: where the pivot is, and the turn."""
    seconds: np.ndarray      # (keys,)
    positions: np.ndarray    # (keys, 3) [m]
    quaternions: np.ndarray  # (keys, 4) x y z w


@dataclass
class Bending:
    """The points of a mesh that bends, in the world, in every frame."""
    cache: str        # PC2
    start: float      # of its first frame [s]


@dataclass
class Collider:
    name: str
    file: str                          # OBJ, in the frame of what carries it; of one that bends in the world
    keys: Optional[Keys] = None        # its own way; none: it goes with the hair
    bending: Optional[Bending] = None


@dataclass
class Scalp:
    body: str         # the name of a collider that bends
    farthest: float   # from it, of a root [m]


@dataclass
class Scene:
    groom: str                     # .hair, in the frame of `keys`
    unit: float                    # metres per Blender unit
    frames: int
    fps: float
    keys: Keys
    gravity: float = 9.81          # downwards, along -Z [m/s^2]
    pre_roll: float = 0            # [s]
    material: str = ""             # a preset, or the path of a material file
    contacts: bool = False
    scalp: Optional[Scalp] = None  # that roots follow
    colliders: list = field(default_factory=list)
    files: tuple = ("hair.usda",)  # that the run writes


def keys_of(motion: RigidMotion, pivot, frames, first_frame, fps, unit):
    """Keys at each of `frames`, at 0 s in `first_frame`; `pivot` is a point of the bind frame [Blender unit]."""
    seconds = (np.asarray(frames, np.float64) - first_frame) / fps
    return Keys(seconds, motion.positions_of(np.asarray(pivot)) * unit, motion.quaternions())


def scene_text(scene: Scene):
    """The whole file. Paths stand in it as they are given: relative to where it will be."""
    lines = [SCENE_HEADING,
             "[groom]", f"file = {quoted(scene.groom)}", f"unit = {scene.unit!r}", 'up = "Z"', ""]
    if scene.material:
        key = "file" if scene.material.endswith(".toml") else "preset"
        lines += ["[material]", f"{key} = {quoted(scene.material)}", ""]
    lines += ["[motion]", f"pre_roll = {scene.pre_roll!r}", ""]
    lines += key_lines("motion.key", scene.keys)
    if scene.scalp:
        lines += ["[scalp]", f"body = {quoted(scene.scalp.body)}", f"farthest = {scene.scalp.farthest!r}", ""]
    lines += ["[simulation]", f"fps = {scene.fps!r}", f"frames = {scene.frames}", f"gravity = {scene.gravity!r}", ""]
    if scene.contacts:
        lines += ["[contacts]", ""]
    for collider in scene.colliders:
        lines += ["[[body]]", f"name = {quoted(collider.name)}", 'shape = "mesh"', f"file = {quoted(collider.file)}",
                  f"unit = {scene.unit!r}"]
        if collider.bending:
            lines += ["deforms = true", f"cache = {quoted(collider.bending.cache)}",
                      f"start = {collider.bending.start!r}"]
        lines += [""]
        if collider.keys:
            lines += key_lines("body.moves.key", collider.keys)
    lines += ["[output]", "files = [" + ", ".join(quoted(file) for file in scene.files) + "]", ""]
    return "\n".join(lines)


def key_lines(table, keys):
    lines = []
    for second, position, quaternion in zip(keys.seconds, keys.positions, keys.quaternions):
        lines += [f"[[{table}]]", f"time = {float(second)!r}", f"position = {numbers(position)}",
                  f"quaternion = {numbers(quaternion)}", ""]
    return lines


def numbers(values):
    return "[" + ", ".join(repr(float(value)) for value in values) + "]"


def quoted(text):
    """A TOML string: quotes, backslashes and control characters escaped."""
    escaped = "".join({'"': '\\"', "\\": "\\\\"}.get(c, c if ord(c) >= 32 and ord(c) != 127 else "\\u%04x" % ord(c))
                      for c in text)
    return f'"{escaped}"'
