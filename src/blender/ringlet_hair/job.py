"""One run: what is written for the program, the program at work, and what it leaves."""
import os
import shutil
import tempfile
import threading
from dataclasses import dataclass

import numpy as np

from .errors import RingletError
from .hair_file import write_hair
from .mesh_file import write_obj_mesh
from .point_cache import write_point_cache
from .program import Run, command_line
from .scene_text import SCENE_HEADING, Bending, Collider, Scalp, Scene, keys_of, scene_text
from .strands import joined
from .usd_points import usd_frames

OUR_FILES = ("scene.toml", "groom.hair", "head.obj", "head.pc2", "hair.pc2", "hair.pc2.partial")

FARTHEST_ROOT = 0.25  # from a head that bends, of its size; hair beyond is not this head's


@dataclass
class JobSettings:
    program: str
    folder: str             # the add-on's; what an earlier run left there is replaced
    first_frame: int        # written are the frames from here ...
    last_frame: int         # ... to here
    fps: float
    unit: float             # metres per Blender unit
    gravity: float
    pre_roll: int           # frames before the first
    material: str
    contacts: bool
    options: str            # of the command line

    @property
    def start_frame(self):
        """The frame at 0 s, in which hair has not yet moved but for the pre-roll."""
        return self.first_frame - 1

    @property
    def sampled_frames(self):
        return range(self.start_frame - self.pre_roll, self.last_frame + 1)


def check_folder(folder):
    """Raises RingletError where the folder holds files under the add-on's names that it did not write. A .blend
    names the folder, so it may be any."""
    scene = os.path.join(folder, "scene.toml")
    try:
        with open(scene, encoding="utf-8", errors="replace") as file:
            is_ours = file.readline().rstrip("\n") == SCENE_HEADING
    except FileNotFoundError:
        is_ours = False
    taken = [name for name in OUR_FILES if os.path.lexists(os.path.join(folder, name))]
    if taken and not is_ours:
        raise RingletError(f"{folder} holds {', '.join(taken)}, which this add-on did not write and would replace; "
                           "choose another folder, or move them away")


def write_inputs(settings, samples):
    """Fills the folder with the groom, the head and the scene file, whose path it returns. Raises
    RingletError, OSError."""
    check_folder(settings.folder)
    strands = joined(samples.strands)
    pivot = strands.roots.mean(axis=0)  # hair's coordinates are small where the head's origin is among it
    strands.points = strands.points - pivot
    os.makedirs(settings.folder, exist_ok=True)
    write_hair(os.path.join(settings.folder, "groom.hair"), strands)

    def keys(motion, about):
        return keys_of(motion, about, samples.frames, settings.start_frame, settings.fps, settings.unit)

    colliders, scalp = [], None
    if samples.head:
        head = samples.head
        size = np.ptp(head.points, axis=0).max()
        goes_along = head.motion.is_as(samples.motion, np.abs(head.points).max() + size)
        about = pivot if goes_along else head.points.mean(axis=0)
        own_way = None if goes_along else keys(head.motion, about)
        if head.bent:
            colliders.append(Collider(head.name, "head.obj", own_way, write_bending(settings, samples)))
            if head.carries:
                scalp = Scalp(head.name, FARTHEST_ROOT * size * settings.unit)
        else:
            write_obj_mesh(os.path.join(settings.folder, "head.obj"), head.points - about, head.triangles)
            colliders.append(Collider(head.name, "head.obj", own_way))
    scene = Scene(groom="groom.hair", unit=settings.unit, frames=settings.last_frame - settings.first_frame + 1,
                  fps=settings.fps, keys=keys(samples.motion, pivot), gravity=settings.gravity,
                  pre_roll=settings.pre_roll / settings.fps, material=settings.material,
                  contacts=settings.contacts, scalp=scalp, colliders=colliders)
    path = os.path.join(settings.folder, "scene.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(scene_text(scene))
    return path


def write_bending(settings, samples):
    """The head as it bends, from the bind frame on: hair is on it, or beside it, as it is there."""
    head, frames = samples.head, samples.head.bent[samples.bind:]
    write_obj_mesh(os.path.join(settings.folder, "head.obj"), frames[0], head.triangles)
    write_point_cache(os.path.join(settings.folder, "head.pc2"), frames, len(head.points))
    return Bending("head.pc2", (samples.frames[samples.bind] - settings.start_frame) / settings.fps)


class Job:
    """A run with its inputs written. Knows nothing of Blender; a thread does what takes time."""

    def __init__(self, settings, samples):
        self.settings = settings
        self.point_count = sum(len(part.points) for part in samples.strands)
        self.samples = samples
        self.cache = os.path.join(settings.folder, "hair.pc2")
        self.report = self.error = None
        scene = write_inputs(settings, samples)
        # A folder that nobody else has: it is removed with all that is in it.
        self._output = tempfile.mkdtemp(prefix="run-", dir=settings.folder)
        try:
            self.run = Run(command_line(settings.program, scene, self._output, settings.options))
        except RingletError:
            os.rmdir(self._output)
            raise
        self._thread = threading.Thread(target=self._work, daemon=True)
        self._thread.start()

    def is_over(self):
        return not self._thread.is_alive()

    def wait(self):
        self._thread.join()

    @property
    def warnings(self):
        return self.samples.warnings + (self.report["warnings"] if self.report else [])

    def progress(self):
        """A short line."""
        run = self.run
        if run.is_cancelled:
            return "ending"
        if run.frames == 0:
            return "starting"
        if run.frame == run.frames:
            return "reading"
        return f"frame {run.frame} of {run.frames}, {run.seconds_left:.0f} s left"

    def _work(self):
        try:
            self.run.wait()
            self.report = self.run.result()
            animation = os.path.join(self._output, "hair.usda")
            partial = self.cache + ".partial"
            if os.path.lexists(partial):
                os.remove(partial)  # a symbolic link of that name would be followed
            write_point_cache(partial, self._checked(usd_frames(animation)), self.point_count,
                              self.settings.first_frame)
            os.replace(partial, self.cache)
        except RingletError as error:
            self.error = str(error)
        except OSError as error:
            self.error = f"{error.filename or self.settings.folder}: {error.strerror}"
        finally:
            self._drop_output()

    def _drop_output(self):
        # After a run that ended the cache holds the same numbers; of one that failed the frames are kept.
        if self.error is None or self.run.is_cancelled or not os.listdir(self._output):
            shutil.rmtree(self._output, ignore_errors=True)

    def _checked(self, frames):
        for points in frames:
            if len(points) != self.point_count:
                raise RingletError(f"the result has {len(points)} points and the groom {self.point_count}")
            yield points
