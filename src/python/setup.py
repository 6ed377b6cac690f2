# Has CMake build the module, for pip. Nothing is written beside the sources.
#   RINGLET_BUILD_DIR            keeps the build there, so that the next takes seconds; else it is in a temporary folder
#   CMAKE_ARGS                   more options for CMake
#   CMAKE_BUILD_PARALLEL_LEVEL   how many files are compiled at once
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]
VERSION = re.search(r"project\(ringlet VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
OPTIONS = {
    "CMAKE_BUILD_TYPE": "Release",
    "BUILD_SHARED_LIBS": "OFF",
    "RINGLET_BUILD_PROGRAM": "OFF",
    "RINGLET_BUILD_TESTS": "OFF",
    "RINGLET_BUILD_BENCHMARKS": "OFF",
    "RINGLET_BUILD_PYTHON": "ON",
    "RINGLET_PYTHON_REQUIRED": "ON",
    "RINGLET_PYTHON": sys.executable,
    "RINGLET_PYTHON_DIR": ".",
}


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        kept = os.environ.get("RINGLET_BUILD_DIR")
        folder = Path(kept) if kept else Path(tempfile.mkdtemp(prefix="ringlet-build-"))
        try:
            generator = ["-G", "Ninja"] if shutil.which("ninja") and not (folder / "CMakeCache.txt").exists() else []
            self.cmake("-S", ROOT, "-B", folder, *generator, *(f"-D{key}={value}" for key, value in OPTIONS.items()),
                       *shlex.split(os.environ.get("CMAKE_ARGS", "")))
            self.cmake("--build", folder, "--target", "ringlet_python_stubs")
            self.cmake("--install", folder, "--component", "python", "--prefix", Path(self.build_lib).resolve())
        finally:
            if not kept:
                shutil.rmtree(folder, ignore_errors=True)

    def cmake(self, *arguments):
        subprocess.run(["cmake", *map(str, arguments)], check=True)


scratch = tempfile.mkdtemp(prefix="ringlet-pip-")
try:
    setup(version=VERSION, ext_modules=[Extension("ringlet", [])], cmdclass={"build_ext": CMakeBuild},
          options={"build": {"build_base": scratch}, "egg_info": {"egg_base": scratch}})
finally:
    shutil.rmtree(scratch, ignore_errors=True)
