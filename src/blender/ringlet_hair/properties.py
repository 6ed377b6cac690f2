"""What the add-on keeps in a .blend, and in Blender's preferences."""
import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, PointerProperty, StringProperty

PACKAGE = __package__

MATERIALS = [("default", "Default", "The material of the library's defaults"),
             ("straight", "Straight", ""), ("wavy", "Wavy", ""), ("loose_curl", "Loose curl", ""),
             ("ringlet", "Ringlet", ""), ("coil", "Coil", ""),
             ("file", "File", "A material file, as `ringlet material` writes it")]


class RingletPreferences(bpy.types.AddonPreferences):
    bl_idname = PACKAGE
    program: StringProperty(name="Program", subtype="FILE_PATH",
                            description="The ringlet program; empty: the one in PATH")

    def draw(self, _context):
        self.layout.prop(self, "program")


class RingletScene(bpy.types.PropertyGroup):
    """How hair of a scene is simulated."""
    head: PointerProperty(name="Head", type=bpy.types.Object, poll=lambda _, candidate: candidate.type == "MESH",
                          description="A mesh that hair stays out of. Hair that does not move by itself goes with it")
    material: EnumProperty(name="Material", items=MATERIALS)
    material_file: StringProperty(name="File", subtype="FILE_PATH")
    contacts: BoolProperty(name="Hair meets hair", description="Contacts between hairs: 10 to 300 times slower")
    pre_roll: IntProperty(name="Pre-roll", min=0, max=10000,
                          description="Frames that hair moves before the first, so that it begins settled")
    options: StringProperty(name="Options", description="More options of `ringlet simulate`, as typed in a shell")
    folder: StringProperty(name="Folder", subtype="DIR_PATH", default="//ringlet",
                           description="Where the motion is kept; simulated hair reads it from there")
    hides_groom: BoolProperty(name="Hide the groom", default=True,
                              description="Hide what was simulated, in views and renders, where the result stands")


class RingletObject(bpy.types.PropertyGroup):
    """Simulated hair: where its motion is."""
    cache: StringProperty(name="Motion", subtype="FILE_PATH",
                          description="A PC2 file with the points of every frame, in the world")
    groom: PointerProperty(name="Groom", type=bpy.types.Object, description="What it was made of")
    particle_system: StringProperty(name="Particle system", description="Of the groom, where it is a mesh")
    first_point: IntProperty(description="Of the file's points, the first that is this object's")
    first_frame: IntProperty(name="First frame", description="Of the scene: where the file's first frame is shown")


CLASSES = (RingletPreferences, RingletScene, RingletObject)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.ringlet = PointerProperty(type=RingletScene)
    bpy.types.Object.ringlet = PointerProperty(type=RingletObject)


def unregister():
    del bpy.types.Object.ringlet, bpy.types.Scene.ringlet
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
