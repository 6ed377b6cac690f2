"""Hair in Blender, of each kind it has: Curves, particle systems, and the older Curve objects."""
from dataclasses import dataclass

import numpy as np

from .errors import RingletError
from .strands import Strands

KINDS = "hair curves (Curves), meshes with a hair particle system, and Curve objects"


@dataclass
class HairSource:
    """Hair of one object; of a mesh, of one of its particle systems."""
    object: object             # bpy.types.Object
    particle_system: str = ""  # its name; "" for curves

    @property
    def name(self):
        return self.particle_system or self.object.name

    @property
    def is_curves(self):
        return self.object.type == "CURVES"

    def strands(self, depsgraph):
        """In the world, as the scene stands at its frame [Blender unit]. Raises RingletError."""
        evaluated = self.object.evaluated_get(depsgraph)
        if self.particle_system:
            strands = particle_strands(evaluated, self.particle_system)
        elif self.is_curves:
            strands = curves_strands(self.object, evaluated)
        else:
            strands = curve_strands(self.object)
        strands.check(self.name)
        matrix = np.array(evaluated.matrix_world)
        strands.points = strands.points @ matrix[:3, :3].T + matrix[:3, 3]
        return strands

    def material(self):
        """The material hair is drawn with, or None."""
        slots = self.object.material_slots
        index = 0
        if self.particle_system:
            index = self.object.particle_systems[self.particle_system].settings.material - 1
        return slots[index].material if index < len(slots) else None


def sources_among(objects):
    """A HairSource for all hair of the objects, in their order; simulated hair stands for its groom, other
    objects are left aside. Raises RingletError where none has hair."""
    sources = []
    for candidate in objects:
        if is_simulated(candidate):
            if candidate.ringlet.groom is None:
                raise RingletError(f"{candidate.name} is simulated hair, whose groom is not there any more")
            found = [HairSource(candidate.ringlet.groom, candidate.ringlet.particle_system)]
        elif candidate.type in ("CURVES", "CURVE"):
            found = [HairSource(candidate)]
        else:
            found = [HairSource(candidate, system.name) for system in candidate.particle_systems
                     if system.settings.type == "HAIR"]
        sources += [source for source in found if source not in sources]
    if not sources:
        raise RingletError(f"nothing that is selected has hair; {KINDS} have")
    return sources


def is_simulated(candidate):
    """Whether an object is hair that the add-on moves."""
    return candidate.type == "CURVES" and candidate.ringlet.cache != ""


def curves_strands(source, evaluated):
    """The points of a Curves object, which for hair curves lie on the hair. Modifiers count where they leave
    as many points as there are: they move guides; those that make more hair of them do not."""
    data = source.data
    if evaluated.type == "CURVES" and len(evaluated.data.points) == len(data.points):
        data = evaluated.data
    points = np.empty(3 * len(data.points), np.float32)
    data.position_data.foreach_get("vector", points)
    offsets = np.empty(len(data.curve_offset_data), np.int32)
    data.curve_offset_data.foreach_get("value", offsets)
    return Strands(points, np.diff(offsets))


def curve_strands(source):
    """The points of a Curve object's splines, as a USD file is imported before Blender 3.5."""
    parts, counts = [], []
    for spline in source.data.splines:
        points = spline.bezier_points if spline.type == "BEZIER" else spline.points
        width = 3 if spline.type == "BEZIER" else 4
        coordinates = np.empty(width * len(points), np.float32)
        points.foreach_get("co", coordinates)
        parts.append(coordinates.reshape(-1, width)[:, :3])
        counts.append(len(points))
    return Strands(np.concatenate(parts) if parts else np.empty((0, 3)), counts)


def particle_strands(evaluated, name):
    """The keys of a particle system's own hair, without its children."""
    system = evaluated.particle_systems[name]
    modifier = next(m for m in evaluated.modifiers
                    if m.type == "PARTICLE_SYSTEM" and m.particle_system.name == name)
    points, counts = [], []
    for particle in system.particles:
        keys = particle.hair_keys
        points += [tuple(key.co_object(evaluated, modifier, particle)) for key in keys]
        counts.append(len(keys))
    return Strands(np.array(points), counts)
