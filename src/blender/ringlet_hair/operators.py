"""The operators: simulate, cancel, load."""
import os

import bpy
import numpy as np
from bpy.props import IntProperty, StringProperty

from . import playback
from .errors import RingletError
from .hair_source import sources_among
from .job import Job, JobSettings
from .point_cache import write_point_cache
from .program import find_program
from .properties import PACKAGE
from .sampling import sample
from .usd_points import read_usd_hair, usd_frames


class State:
    """What the panel shows."""
    job = None
    warnings = []
    error = ""


def settings_of(context, name):
    """Raises RingletError for what cannot be run."""
    scene, stated = context.scene, context.scene.ringlet
    folder = bpy.path.abspath(stated.folder or "//ringlet")
    if not bpy.data.is_saved and (stated.folder or "//").startswith("//"):
        raise RingletError("the motion is kept beside the .blend file; save that first, or choose a folder elsewhere")
    material = "" if stated.material == "default" else stated.material
    if material == "file":
        material = bpy.path.abspath(stated.material_file)
        if not os.path.isfile(material) or not material.endswith(".toml"):
            raise RingletError(f"the material file {material or '(none)'} is no .toml file")
    preferences = context.preferences.addons.get(PACKAGE)
    return JobSettings(
        program=find_program(bpy.path.abspath(preferences.preferences.program) if preferences else ""),
        folder=os.path.join(folder, bpy.path.clean_name(name)), first_frame=scene.frame_start,
        last_frame=scene.frame_end, fps=scene.render.fps / scene.render.fps_base,
        unit=metres_per_unit(scene),
        gravity=-scene.gravity.z if scene.use_gravity else 0.0, pre_roll=stated.pre_roll, material=material,
        contacts=stated.contacts, options=stated.options)


def metres_per_unit(scene):
    units = scene.unit_settings
    return 1.0 if units.system == "NONE" else units.scale_length


def start(context):
    """Samples the scene and starts the program. Raises RingletError."""
    sources = sources_among(context.view_layer.objects.selected)
    settings = settings_of(context, sources[0].name)
    for source in sources:
        source.object.hide_set(False)  # what is hidden is not evaluated
    head = context.scene.ringlet.head
    samples = sample(context, sources, head, settings.sampled_frames, settings.first_frame)
    try:
        return Job(settings, samples)
    except OSError as error:
        raise RingletError(f"cannot write into {settings.folder}: {error.strerror}") from error


def load(context, job):
    """Makes the Curves objects of a job that is over and well; they are selected in place of their grooms."""
    first = 0
    for source, strands in zip(job.samples.sources, job.samples.strands):
        result = playback.make_result(context, source, strands, job, first)
        first += len(strands.points)
        source.object.select_set(False)
        if context.scene.ringlet.hides_groom and not source.particle_system:
            source.object.hide_set(True)
            source.object.hide_render = True
        result.select_set(True)
        context.view_layer.objects.active = result


class RINGLET_OT_simulate(bpy.types.Operator):
    """Simulate the selected hair over the scene's frames, and show the result as Curves"""
    bl_idname = "ringlet.simulate"
    bl_label = "Simulate"

    @classmethod
    def poll(cls, context):
        return State.job is None and context.mode == "OBJECT"

    def invoke(self, context, _event):
        if not self._start(context):
            return {"CANCELLED"}
        self._timer = context.window_manager.event_timer_add(0.2, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        """For scripts: waits until it is over."""
        if not self._start(context):
            return {"CANCELLED"}
        State.job.wait()
        return self._finish(context)

    def modal(self, context, event):
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        redraw(context)
        if not State.job.is_over():
            return {"PASS_THROUGH"}
        context.window_manager.event_timer_remove(self._timer)
        return self._finish(context)

    def cancel(self, context):
        """Blender ends, or opens another file."""
        context.window_manager.event_timer_remove(self._timer)
        if State.job:
            State.job.run.kill()
            State.job = None

    def _start(self, context):
        State.warnings, State.error = [], ""
        try:
            State.job = start(context)
            return True
        except RingletError as error:
            return self._fail(str(error))

    def _finish(self, context):
        job, State.job = State.job, None
        redraw(context)
        if job.error:
            self._fail(job.error)
            return {"CANCELLED"}
        load(context, job)
        State.warnings = job.warnings
        for warning in job.warnings:
            self.report({"WARNING"}, warning)
        self.report({"INFO"}, f"simulated {job.report['strands']} strands, {job.report['frames']} frames")
        return {"FINISHED"}

    def _fail(self, sentence):
        State.error = sentence
        # In scripts an error that is reported becomes an exception, with this text.
        self.report({"WARNING"} if sentence == "cancelled" else {"ERROR"}, sentence)
        return False


class RINGLET_OT_cancel(bpy.types.Operator):
    """End the simulation that is under way"""
    bl_idname = "ringlet.cancel"
    bl_label = "Cancel"

    @classmethod
    def poll(cls, _context):
        return State.job is not None

    def execute(self, _context):
        State.job.run.cancel()
        return {"FINISHED"}


class RINGLET_OT_load(bpy.types.Operator):
    """Show an animation that the ringlet program wrote (hair.usda) as Curves"""
    bl_idname = "ringlet.load"
    bl_label = "Load an animation"
    bl_options = {"UNDO"}
    filepath: StringProperty(subtype="FILE_PATH")
    filter_glob: StringProperty(default="*.usda", options={"HIDDEN"})
    first_frame: IntProperty(name="First frame", default=1, description="Of the scene: where the first one is shown")

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            hair = read_usd_hair(self.filepath)
            cache = self.filepath + ".pc2"
            factor = hair.metres_per_unit / metres_per_unit(context.scene)
            frames = (in_blender(points, factor, hair.up) for points in usd_frames(self.filepath))
            count = write_point_cache(cache, frames, int(hair.counts.sum()), self.first_frame)
        except (RingletError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        name = bpy.path.display_name_from_filepath(self.filepath)
        data = playback.new_curves(context, name, hair.counts)
        playback.play(context, name, data, cache, self.first_frame)
        self.report({"INFO"}, f"{len(hair.counts)} strands, {count} frames")
        return {"FINISHED"}


def in_blender(points, factor, up):
    """In the scene's unit; Blender's world is Z up."""
    if up == "Y":
        points = points[:, [0, 2, 1]] * np.array([1, -1, 1], np.float32)
    return points if factor == 1 else points * np.float32(factor)


def redraw(context):
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


CLASSES = (RINGLET_OT_simulate, RINGLET_OT_cancel, RINGLET_OT_load)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)


def unregister():
    if State.job:
        State.job.run.kill()
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
