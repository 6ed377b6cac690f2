"""The panel in the 3D view's sidebar."""
import textwrap

import bpy

from .hair_source import is_simulated
from .operators import State
from .playback import complaints

WIDTH = 44  # of a line of text, in letters


class RINGLET_PT_panel(bpy.types.Panel):
    bl_idname = "RINGLET_PT_panel"
    bl_label = "Ringlet"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Ringlet"

    def draw(self, context):
        stated, layout = context.scene.ringlet, self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(stated, "head")
        layout.prop(stated, "material")
        if stated.material == "file":
            layout.prop(stated, "material_file")
        for name in ("contacts", "pre_roll", "options", "folder", "hides_groom"):
            layout.prop(stated, name)
        if State.job:
            layout.label(text=State.job.progress(), icon="TIME")
            layout.operator("ringlet.cancel", icon="CANCEL")
        else:
            layout.operator("ringlet.simulate", icon="PLAY")
            layout.operator("ringlet.load", icon="FILE_FOLDER")
        write(layout, State.error, "ERROR")
        for warning in State.warnings:
            write(layout, warning, "INFO")
        shown = context.object
        if shown and is_simulated(shown):
            layout.prop(shown.ringlet, "cache")
            layout.prop(shown.ringlet, "first_frame")
            write(layout, complaints.get(shown.name, ""), "ERROR")


def write(layout, sentence, icon):
    column = layout.column(align=True)
    for number, line in enumerate(textwrap.wrap(sentence, WIDTH)):
        column.label(text=line, icon=icon if number == 0 else "BLANK1")


def register():
    bpy.utils.register_class(RINGLET_PT_panel)


def unregister():
    bpy.utils.unregister_class(RINGLET_PT_panel)
