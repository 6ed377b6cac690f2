# The parts of the add-on that know nothing of Blender are imported from the sources.
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "src" / "blender"))
