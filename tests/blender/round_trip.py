# The add-on in Blender, from hair to moving hair: blender -b --factory-startup --python-exit-code 1
# --python round_trip.py -- ADD-ON.zip PROGRAM FOLDER
import os
import subprocess
import sys

import bpy
import numpy as np

ZIP, PROGRAM, FOLDER = sys.argv[sys.argv.index("--") + 1:]
FIRST, LAST = 5, 12
MODULE = "ringlet_hair"


def install():
    bpy.ops.preferences.addon_install(filepath=ZIP, overwrite=True)
    bpy.ops.preferences.addon_enable(module=MODULE)
    bpy.context.preferences.addons[MODULE].preferences.program = PROGRAM


def empty_scene(unit, name):
    """A new file, saved, with the frames of the test and nothing else."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=False)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = FIRST, LAST
    scene.unit_settings.scale_length = unit
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(FOLDER, name + ".blend"))
    return scene


def curls(count, particles, size):
    """(count, particles, 3): curls that hang, roots on a circle."""
    t = np.linspace(0, 1, particles)
    strands = []
    for angle in np.arange(count) * (2 * np.pi / count):
        root = 0.08 * np.array([np.cos(angle), np.sin(angle), 0])
        strands.append(root + np.stack([0.008 * np.cos(12 * t) - 0.008, 0.008 * np.sin(12 * t), -0.15 * t], axis=1))
    return np.array(strands) * size


def new_hair(name, points):
    from ringlet_hair import playback
    data = playback.new_curves(bpy.context, name, [points.shape[1]] * len(points))
    data.position_data.foreach_set("vector", points.astype(np.float32).ravel())
    hair = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(hair)
    return hair


def new_sphere(name, radius):
    bpy.ops.mesh.primitive_uv_sphere_add(radius=radius)
    sphere = bpy.context.view_layer.objects.active
    sphere.name = name
    return sphere


def select(*objects):
    bpy.ops.object.select_all(action="DESELECT")
    for each in objects:
        each.select_set(True)
        bpy.context.view_layer.objects.active = each


def animate(mover, size):
    """Turns and goes, so that a wrong axis, unit or frame shows."""
    for frame, place, turn in ((FIRST - 3, (0, 0, 0), 0), (LAST, (0.3 * size, 0.1 * size, 0.2 * size), 0.9)):
        mover.location, mover.rotation_euler = place, (turn, 0.3 * turn, -turn)
        mover.keyframe_insert("location", frame=frame)
        mover.keyframe_insert("rotation_euler", frame=frame)


def shown(name):
    """The evaluated points of simulated hair, in the world."""
    hair = bpy.data.objects[name].evaluated_get(bpy.context.evaluated_depsgraph_get())
    points = np.empty(3 * len(hair.data.points), np.float32)
    hair.data.position_data.foreach_get("vector", points)
    matrix = np.array(hair.matrix_world)
    return points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def frames_of(name):
    every = []
    for frame in range(FIRST, LAST + 1):
        bpy.context.scene.frame_set(frame)
        every.append(shown(name))
    return np.array(every)


def check(is_so, what):
    if not is_so:
        raise AssertionError(what)
    print("well:", what)


def check_curves(unit):
    size = 1 / unit
    scene = empty_scene(unit, f"curves_{unit}")
    hair = new_hair("Hair", curls(12, 24, size / 2))
    hair.scale = (2, 2, 2)
    animate(hair, size)
    select(hair)
    scene.frame_set(9)
    check(bpy.ops.ringlet.simulate() == {"FINISHED"}, f"curves are simulated, {unit} m a unit")
    check(scene.frame_current == 9, "the frame is what it was")
    frames = frames_of("Hair simulated")
    for index, frame in enumerate(range(FIRST, LAST + 1)):
        scene.frame_set(frame)
        matrix = np.array(hair.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world)
        roots = curls(12, 24, size / 2)[:, 0] @ matrix[:3, :3].T + matrix[:3, 3]
        off = np.abs(frames[index].reshape(12, 24, 3)[:, 0] - roots).max()
        if off > 2e-6 * size:
            raise AssertionError(f"roots in frame {frame} are {off} from where the object has them")
    strands = frames.reshape(len(frames), 12, 24, 3)
    lengths = np.linalg.norm(np.diff(strands, axis=2), axis=-1).sum(axis=2)
    rest = np.linalg.norm(np.diff(curls(12, 24, size), axis=1), axis=-1).sum(axis=1)
    check(np.abs(lengths / rest - 1).max() < 0.1, "strands keep their lengths")
    check(np.ptp(strands[:, :, -1] - strands[:, :, 0], axis=0).max() > 0.005 * size, "hair swings")

    with open(os.path.join(FOLDER, "ringlet", "Hair", "hair.pc2"), "rb") as file:
        raw = np.frombuffer(file.read(), "<f4", offset=32).reshape(frames.shape)
    check((raw == frames).all(), "Blender shows the file's numbers")
    scene.frame_set(FIRST, subframe=0.25)
    check(np.allclose(shown("Hair simulated"), raw[0] + (raw[1] - raw[0]) / 4, atol=1e-6 * size), "between frames")
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=bpy.data.filepath)
    check((frames_of("Hair simulated") == frames).all(), "a file that is opened again shows them")


def check_carried_by_head():
    scene = empty_scene(1.0, "head")
    head = new_sphere("Head", 0.08)
    animate(head, 1)
    hair = new_hair("Hair", curls(6, 16, 1.5))
    scene.ringlet.head = head
    scene.ringlet.contacts = True
    scene.ringlet.pre_roll = 2
    select(hair)
    scene.frame_set(FIRST)
    bind = np.array(head.matrix_world)
    hair.location = bind[:3, 3]  # about the head, in the first frame
    roots = curls(6, 16, 1.5)[:, 0] + bind[:3, 3]
    check(bpy.ops.ringlet.simulate() == {"FINISHED"}, "hair that does not move goes with the head")
    for index, frame in enumerate(range(FIRST, LAST + 1)):
        scene.frame_set(frame)
        relative = np.array(head.matrix_world) @ np.linalg.inv(bind)
        off = np.abs(shown("Hair simulated").reshape(6, 16, 3)[:, 0] - roots @ relative[:3, :3].T - relative[:3, 3]).max()
        if off > 5e-6:
            raise AssertionError(f"roots in frame {frame} are {off} m from where the head has them")
        inside = np.linalg.norm(shown("Hair simulated") - np.array(head.matrix_world)[:3, 3], axis=1).min()
        if inside < 0.079:
            raise AssertionError(f"hair is {0.08 - inside} m inside of the head")
    select(bpy.data.objects["Hair simulated"])
    bpy.ops.ringlet.simulate()
    check([o.name for o in scene.objects if o.type == "CURVES"] == ["Hair", "Hair simulated"],
          "simulated hair stands for its groom, and a second result takes the first one's place")


def vertices(mesh):
    """Of the evaluated mesh, in the world."""
    evaluated = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
    points = np.empty(3 * len(evaluated.data.vertices), np.float32)
    evaluated.data.vertices.foreach_get("co", points)
    matrix = np.array(evaluated.matrix_world)
    return points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def check_head_that_bends():
    scene = empty_scene(1.0, "bends")
    head = new_sphere("Head", 0.08)
    animate(head, 1)
    head.shape_key_add(name="Basis")
    shape = head.shape_key_add(name="Bent")
    for vertex, place in zip(head.data.vertices, shape.data):
        x, y, z = vertex.co
        place.co = (x * (1 + 4 * z), y, z + 3 * x * x)
    for frame, value in ((FIRST - 3, 0), (LAST, 1)):
        shape.value = value
        shape.keyframe_insert("value", frame=frame)
    scene.frame_set(FIRST)
    chosen = np.arange(40, 400, 60)
    outward = np.linspace(0, 0.1, 12)[None, :, None] * np.array([0, 0, -1])
    hair = new_hair("Hair", vertices(head)[chosen][:, None] + outward)
    scene.ringlet.head = head
    select(hair)
    check(bpy.ops.ringlet.simulate() == {"FINISHED"}, "hair goes with a head that bends")
    expected = []
    for frame in range(FIRST, LAST + 1):
        scene.frame_set(frame)
        expected.append(vertices(head)[chosen])
    found = frames_of("Hair simulated").reshape(LAST - FIRST + 1, len(chosen), 12, 3)[:, :, 0]
    off = np.abs(found - np.array(expected)).max()
    rigid = np.linalg.norm(np.diff(expected, axis=1), axis=-1)
    check(np.ptp(rigid, axis=0).max() > 0.005, f"it bends: distances of roots change by {np.ptp(rigid, axis=0).max():.3f} m")
    check(off < 1e-5, f"roots are within {off:.1e} m of the points they are on")

    # The same mesh as Blender's own exporters write it: faces from an OBJ with Y up, points from an MDD with Z up.
    folder = os.path.join(FOLDER, "ringlet", "Hair")
    select(head)
    scene.frame_set(FIRST)
    bpy.ops.wm.obj_export(filepath=os.path.join(folder, "own.obj"), export_selected_objects=True, export_uv=False,
                          export_normals=False, export_materials=False)
    bpy.ops.preferences.addon_enable(module="io_shape_mdd")
    bpy.ops.export_shape.mdd(filepath=os.path.join(folder, "own.mdd"), fps=scene.render.fps, frame_start=FIRST,
                             frame_end=LAST, use_rest_frame=False)
    with open(os.path.join(folder, "scene.toml"), encoding="utf-8") as file:
        text = file.read()
    with open(os.path.join(folder, "own.toml"), "w", encoding="utf-8") as file:
        file.write(text.replace("head.obj", "own.obj").replace("head.pc2", "own.mdd"))
    done = subprocess.run([PROGRAM, "simulate", "own.toml", "-o", "own"], cwd=folder, capture_output=True, text=True)
    check(done.returncode == 0, f"the program reads Blender's OBJ and MDD: {done.stderr}")
    subprocess.run([PROGRAM, "convert", "own/hair.usda", "own/hair.pc2"], cwd=folder, check=True, capture_output=True)
    with open(os.path.join(folder, "own", "hair.pc2"), "rb") as file:
        raw = np.frombuffer(file.read(), "<f4", offset=32).reshape(LAST - FIRST + 1, len(chosen), 12, 3)
    off = np.abs(raw[:, :, 0] - np.array(expected)).max()
    check(off < 2e-5, f"roots are on it within {off:.1e} m")


def check_older_kinds():
    scene = empty_scene(1.0, "older")
    mesh = new_sphere("Scalp", 0.08)
    bpy.ops.object.particle_system_add()
    system = mesh.particle_systems[0]
    system.name = "Fur"
    system.settings.type, system.settings.count, system.settings.hair_length = "HAIR", 7, 0.2
    older = bpy.data.curves.new("Older", "CURVE")
    older.dimensions = "3D"
    for strand in curls(3, 10, 1):
        spline = older.splines.new("POLY")
        spline.points.add(9)
        spline.points.foreach_set("co", np.c_[strand, np.ones(10)].ravel())
    other = bpy.data.objects.new("Older", older)
    bpy.context.collection.objects.link(other)
    select(other, mesh)
    check(bpy.ops.ringlet.simulate() == {"FINISHED"}, "particles and older curves are simulated together")
    check(len(bpy.data.objects["Older simulated"].data.curves) == 3, "older curves are curves")
    check(len(bpy.data.objects["Fur simulated"].data.curves) == 7, "particles are curves")
    fur = frames_of("Fur simulated").reshape(LAST - FIRST + 1, 7, -1, 3)
    check(np.allclose(np.linalg.norm(fur[:, :, 0], axis=-1), 0.08, atol=2e-3), "roots of particles are on the mesh")
    check(np.abs(frames_of("Older simulated")[:, ::10] - curls(3, 10, 1)[:, 0]).max() < 1e-6, "roots of older curves stay")
    check(not mesh.hide_render and other.hide_render, "the groom is hidden, the head is not")


def refused(words, what):
    try:
        bpy.ops.ringlet.simulate()
    except RuntimeError as error:
        check(words in str(error), f"{what}: {str(error).strip()}")
        return
    raise AssertionError(f"{what} is not refused")


def check_errors():
    scene = empty_scene(1.0, "errors")
    cube = new_sphere("Bald", 1)
    select(cube)
    refused("nothing that is selected has hair", "a mesh without hair")
    hair = new_hair("Hair", curls(2, 8, 1))
    select(hair)
    scene.ringlet.options = "--gravity strong"
    refused("--gravity", "the program's own words")
    scene.ringlet.options = ""
    hair.scale = (1, 1, 1)
    hair.keyframe_insert("scale", frame=FIRST)
    hair.scale = (2, 1, 1)
    hair.keyframe_insert("scale", frame=LAST)
    refused("the scale of Hair changes", "a scale that changes")
    hair.animation_data_clear()
    preferences = bpy.context.preferences.addons[MODULE].preferences
    preferences.program = "/nowhere/ringlet"
    refused("/nowhere/ringlet", "a program that is not there")
    preferences.program = PROGRAM
    bpy.ops.ringlet.simulate()
    cache = os.path.join(FOLDER, "ringlet", "Hair", "hair.pc2")
    os.truncate(cache, 100)
    scene.frame_set(LAST)
    from ringlet_hair import playback
    check("100 bytes" in playback.complaints["Hair simulated"], "a torn cache is said")
    bpy.data.objects.remove(hair)
    select(bpy.data.objects["Hair simulated"])
    refused("whose groom is not there", "simulated hair without its groom")


def check_cancel():
    scene = empty_scene(1.0, "cancel")
    scene.frame_end = 100000
    from ringlet_hair import job, operators
    hair = new_hair("Hair", curls(4, 16, 1))
    select(hair)
    settings = operators.settings_of(bpy.context, "Hair")
    from ringlet_hair.hair_source import sources_among
    from ringlet_hair.sampling import sample
    samples = sample(bpy.context, sources_among([hair]), None, range(FIRST - 1, FIRST + 2), FIRST)
    run = job.Job(settings, samples)
    while run.run.frame < 3 and not run.is_over():
        pass
    check(run.progress().startswith("frame "), run.progress())
    run.run.cancel()
    run.wait()
    check(run.error == "cancelled" and run.run.frame < 100000, "a run is cancelled")


def ringlet(*arguments):
    subprocess.run([PROGRAM, *arguments], cwd=FOLDER, check=True, capture_output=True)


def obj_points(path):
    """As Blender's own importer reads them, axes left as they are. The older one: 3.4's newer takes two points of a line."""
    bpy.ops.import_scene.obj(filepath=path, axis_forward="Y", axis_up="Z")
    mesh = bpy.context.selected_objects[0]
    points = np.array([vertex.co for vertex in mesh.data.vertices], np.float32)
    return mesh, points


def turned(points):
    """From Y up to Z up."""
    return np.stack([points[..., 0], -points[..., 2], points[..., 1]], axis=-1)


def check_outputs():
    """What the program writes, read by Blender's importers and shown by the add-on: the same numbers."""
    scene = empty_scene(1.0, "outputs")
    ringlet("make", "swatch", "--columns", "4", "--rows", "3", "--particles", "20", "-o", "swatch.hair")
    ringlet("simulate", "swatch.hair", "--motion", "shake", "--frames", "5", "-o", "swatch")
    ringlet("convert", "swatch/hair.usda", "swatch/frames")
    objects = [obj_points(os.path.join(FOLDER, "swatch", "frames", f"hair.{frame:04}.obj")) for frame in range(1, 6)]
    expected = np.array([points for _, points in objects])
    check(expected.shape == (5, 240, 3) and np.ptp(expected, axis=0).max() > 1, "OBJ files are imported")
    check(all(len(mesh.data.edges) == 12 * 19 for mesh, _ in objects), "an edge from each point to the next")
    bpy.ops.ringlet.load(filepath=os.path.join(FOLDER, "swatch", "hair.usda"), first_frame=3)
    hair = bpy.data.objects["hair"]
    check([len(curve.points) for curve in hair.data.curves] == [20] * 12, "USD's strands are curves")
    for index in range(5):
        scene.frame_set(3 + index)
        off = np.abs(shown("hair") - turned(expected[index]) * 0.01).max()
        if off > 1e-8:
            raise AssertionError(f"frame {index + 1} of the USD is {off} m from the OBJ")
    check(True, "USD text and OBJ hold the same numbers")
    mesh = objects[0][0]
    modifier = mesh.modifiers.new("Cache", "MESH_CACHE")
    modifier.cache_format, modifier.filepath = "PC2", os.path.join(FOLDER, "swatch", "hair.usda.pc2")
    modifier.frame_start = 3
    for index in range(5):
        scene.frame_set(3 + index)
        evaluated = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
        points = np.array([vertex.co for vertex in evaluated.data.vertices], np.float32)
        off = np.abs(points - turned(expected[index]) * np.float32(0.01)).max()
        if off > 1e-8:
            raise AssertionError(f"frame {index + 1} of the PC2 is {off} m from the OBJ")
    check(True, "Blender's own reader of PC2 finds them in the cache")
    try:
        bpy.ops.ringlet.load(filepath=os.path.join(FOLDER, "swatch", "last.obj"))
    except RuntimeError as error:
        check("is no animation" in str(error), f"another file: {str(error).strip()}")


install()
check_curves(1.0)
check_curves(0.01)
check_carried_by_head()
check_head_that_bends()
check_older_kinds()
check_errors()
check_cancel()
check_outputs()
print("all is well")
