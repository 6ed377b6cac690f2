"""The `ringlet` program as a child process: found, started, watched, ended."""
import json
import os
import shlex
import shutil
import subprocess
import threading

from .errors import RingletError

INTERRUPTED = 130  # the program's exit status after SIGTERM


def find_program(stated):
    """The path of the program: `stated` where it says one, else the one in PATH. Raises RingletError."""
    found = shutil.which(os.path.expanduser(stated) if stated else "ringlet")
    if found:
        return found
    where = f"there is no program {stated}" if stated else "there is no program ringlet in PATH"
    raise RingletError(f"{where}; name it in the add-on's preferences (Edit > Preferences > Add-ons > Ringlet)")


def command_line(program, scene, folder, options=""):
    """The arguments of a run; `options` as typed in a shell, put behind. Raises RingletError where those have
    an open quote."""
    try:
        extra = shlex.split(options)
    except ValueError as error:
        raise RingletError(f"the options {options!r} cannot be read: {error}") from error
    return [program, "simulate", scene, "-o", folder, "--json", "--json-progress", "--quiet", "--overwrite", *extra]


class Run:
    """A started program. Nothing here waits but wait(): threads read what the child says."""

    def __init__(self, arguments):
        """Raises RingletError where the program cannot be started."""
        self.frame = self.frames = 0  # finished, and in all
        self.seconds_left = None
        self._report, self._complaints = [], []
        self.is_cancelled = False
        try:
            self._child = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                           stderr=subprocess.PIPE, text=True, encoding="utf-8", errors="replace")
        except OSError as error:
            raise RingletError(f"{arguments[0]} cannot be started: {error.strerror}") from error
        self._readers = [threading.Thread(target=read, daemon=True) for read in (self._read_report, self._read_errors)]
        for reader in self._readers:
            reader.start()

    def is_over(self):
        return self._child.poll() is not None

    def cancel(self):
        """Asks the program to end; it does so after the frame it is at."""
        self.is_cancelled = True
        if not self.is_over():
            self._child.terminate()

    def kill(self):
        """Ends it at once, for when nobody will be there to wait."""
        self.is_cancelled = True
        if not self.is_over():
            self._child.kill()
        self._child.wait()

    def wait(self, timeout=None):
        """Until it is over, and all it said is read. Raises subprocess.TimeoutExpired."""
        self._child.wait(timeout)
        for reader in self._readers:
            reader.join()

    def result(self):
        """After wait(): the program's report, of its --json. Raises RingletError with what the program says
        went wrong; its own words stand as they are."""
        status = self._child.returncode
        if self.is_cancelled:
            raise RingletError("cancelled")
        try:
            report = json.loads("".join(self._report))
        except ValueError:
            report = None
        # 3: all frames are there, but some particles have no finite position.
        if status not in (0, 3) or report is None:
            words = "".join(self._complaints).strip()
            raise RingletError(words or f"{self._child.args[0]} ended with status {status} and said nothing")
        if status == 3:
            report["warnings"].append(f"{report['nonfinite']} particles have no finite position")
        return report

    def _read_report(self):
        for line in self._child.stdout:
            if line.startswith('{"frame"'):
                told = json.loads(line)
                self.frame, self.frames, self.seconds_left = told["frame"], told["frames"], told["seconds_left"]
            else:
                self._report.append(line)

    def _read_errors(self):
        for line in self._child.stderr:
            self._complaints.append(line)
