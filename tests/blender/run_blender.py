# Runs round_trip.py in Blender for ctest: run_blender.py ADD-ON.zip PROGRAM. Ends with 77, which ctest lists as skipped,
# where Blender is not installed. Blender's own settings are left alone.
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77

addon, program = sys.argv[1:]
blender = shutil.which("blender")
if not blender:
    print("SKIPPED, NOTHING WAS TESTED: Blender is not installed (Debian: blender, 630 MB with what it needs)")
    sys.exit(SKIPPED)
with tempfile.TemporaryDirectory() as folder:
    user = {name: folder for name in ("BLENDER_USER_CONFIG", "BLENDER_USER_SCRIPTS", "BLENDER_USER_DATAFILES")}
    script = pathlib.Path(__file__).with_name("round_trip.py")
    done = subprocess.run([blender, "-b", "--factory-startup", "--python-exit-code", "1", "--python", str(script), "--",
                           addon, program, folder], env={**os.environ, **user}, text=True, capture_output=True)
print(done.stdout, done.stderr)
sys.exit(done.returncode if "all is well" in done.stdout else done.returncode or 1)
