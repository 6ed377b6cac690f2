"""The Ringlet add-on of Blender: simulates selected hair with the `ringlet` program (docs/blender.md)."""
bl_info = {
    "name": "Ringlet",
    "description": "Simulates curly hair with the ringlet program",
    "author": "Ringlet's authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Ringlet",
    "category": "Physics",
}

try:
    import bpy  # noqa: F401
except ImportError:  # the files and the command line are tested without Blender
    PARTS = ()
else:
    from . import operators, panel, playback, properties

    PARTS = (properties, playback, operators, panel)


def register():
    for part in PARTS:
        part.register()


def unregister():
    for part in reversed(PARTS):
        part.unregister()
