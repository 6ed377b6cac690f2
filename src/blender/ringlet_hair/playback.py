"""Simulated hair in Blender: Curves objects whose points a handler sets on every change of frame, from the
point cache on disk."""
import bpy
import numpy as np
from bpy.app.handlers import persistent

from .errors import RingletError
from .hair_source import is_simulated
from .point_cache import PointCache

complaints = {}  # of objects by name: why they do not move; the panel shows them


def play(context, name, data, cache, first_frame, first_point=0):
    """A Curves object that plays the points [first_point, first_point + its own) of a cache."""
    result = bpy.data.objects.new(name, data)
    context.collection.objects.link(result)
    result.ringlet.cache = bpy.path.relpath(cache) if bpy.data.is_saved else cache
    result.ringlet.first_point = first_point
    result.ringlet.first_frame = first_frame
    show_frame_of(result, context.scene)
    return result


def make_result(context, source, strands, job, first_point):
    """What became of a source: it takes the place of an earlier result."""
    remove_result(source)
    name = f"{source.name} simulated"
    if source.is_curves:
        data = source.object.data.copy()
        data.name = name
        scale_radii(data, source.object.matrix_world)
    else:
        data = new_curves(context, name, strands.counts)
        if material := source.material():
            data.materials.append(material)
    result = play(context, name, data, job.cache, job.settings.first_frame, first_point)
    result.ringlet.groom = source.object
    result.ringlet.particle_system = source.particle_system
    return result


def remove_result(source):
    for earlier in [o for o in bpy.data.objects if is_simulated(o) and o.ringlet.groom == source.object
                    and o.ringlet.particle_system == source.particle_system]:
        data = earlier.data
        bpy.data.objects.remove(earlier)
        if data.users == 0:
            bpy.data.hair_curves.remove(data)


def new_curves(context, name, counts, radius=0.00025):
    """Hair curves with so many points each, all at the origin."""
    if hasattr(bpy.types.Curves, "add_curves"):  # Blender 4.1 and newer
        data = bpy.data.hair_curves.new(name)
        data.add_curves([int(count) for count in counts])
        return data
    # Before that, Python cannot make them; the operator that converts Curve objects can.
    older = bpy.data.curves.new(name, "CURVE")
    older.dimensions = "3D"
    for count in counts:
        spline = older.splines.new("POLY")
        spline.points.add(int(count) - 1)
        spline.points.foreach_set("radius", np.full(int(count), radius, np.float32))
    carrier = bpy.data.objects.new(name, older)
    context.collection.objects.link(carrier)
    layer = context.view_layer
    selected, active = list(layer.objects.selected), layer.objects.active
    for other in selected:
        other.select_set(False)
    carrier.select_set(True)
    layer.objects.active = carrier
    bpy.ops.object.convert(target="CURVES")
    data = carrier.data
    bpy.data.objects.remove(carrier)
    older.user_clear()  # 3.4 counts the conversion's own
    bpy.data.curves.remove(older)
    for other in selected:
        other.select_set(True)
    layer.objects.active = active
    return data


def scale_radii(data, matrix):
    """The result stands in the world without a scale of its own, so radii take it."""
    scale = sum(matrix.to_scale()) / 3
    radii = data.attributes.get("radius")
    if radii and abs(scale - 1) > 1e-6:
        values = np.empty(len(radii.data), np.float32)
        radii.data.foreach_get("value", values)
        radii.data.foreach_set("value", values * np.float32(abs(scale)))


def show_frame_of(result, scene):
    """Sets the points to those of the scene's frame, between frames on straight lines (motion blur)."""
    try:
        cache = PointCache(bpy.path.abspath(result.ringlet.cache))
        first, count = result.ringlet.first_point, len(result.data.points)
        if first + count > cache.points:
            raise RingletError(f"{cache.path} has {cache.points} points, too few for {result.name}; simulate again")
        points = cache.at(scene.frame_current_final - result.ringlet.first_frame)[first:first + count]
    except RingletError as error:
        if complaints.get(result.name) != str(error):
            print(f"Ringlet: {result.name}: {error}")
        complaints[result.name] = str(error)
        return
    complaints.pop(result.name, None)
    result.data.position_data.foreach_set("vector", np.ascontiguousarray(points).ravel())
    result.data.update_tag()


@persistent
def show_frame(scene, _depsgraph=None):
    for candidate in scene.objects:
        if is_simulated(candidate):
            show_frame_of(candidate, scene)


@persistent
def show_after_load(_path, *_):
    complaints.clear()
    for scene in bpy.data.scenes:
        show_frame(scene)


def register():
    bpy.app.handlers.frame_change_pre.append(show_frame)
    bpy.app.handlers.load_post.append(show_after_load)


def unregister():
    bpy.app.handlers.frame_change_pre.remove(show_frame)
    bpy.app.handlers.load_post.remove(show_after_load)
