"""Runs the shell commands of a document as a reader would: run_commands.py DOCUMENT SOURCE BUILD

Blocks headed ```sh or ```bash are run, in order, in one shell, in a new folder that looks like a clone which was built:
what the source tree holds is there (examples as a copy), build/release and build/ci are the build, `ringlet` is in
PATH. A block headed ```toml that begins with "# NAME.toml" becomes that file, and with ", continued" is added to it.
Blocks headed ```console are for the reader only: they fetch, compile, or take long. Prints how many commands
were run and how many blocks were not; ends with 1 where a command failed, with what it said.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

BLOCK = re.compile(r"^```(\w*)[^\n]*\n(.*?)^```", re.MULTILINE | re.DOTALL)
RUN, NOT_RUN = ("sh", "bash"), ("console",)
MARK = "@@command "


def blocks_of(text):
    """(language, line, text) of each block."""
    return [(found[1], text.count("\n", 0, found.start()) + 2, found[2]) for found in BLOCK.finditer(text)]


def is_whole(lines):
    # Of a here-document that is not ended bash only warns.
    parsed = subprocess.run(["bash", "-n", "-c", "\n".join(lines)], capture_output=True)
    return parsed.returncode == 0 and not parsed.stderr


def commands_of(block, line):
    """(line, text) of each command; one may go over several lines."""
    commands, open_lines = [], []
    for number, text in enumerate(block.splitlines(), line):
        if not open_lines and (not text.strip() or text.lstrip().startswith("#")):
            continue
        open_lines.append(text)
        if not text.rstrip().endswith("\\") and is_whole(open_lines):
            commands.append((number - len(open_lines) + 1, "\n".join(open_lines)))
            open_lines = []
    if open_lines:
        commands.append((line, "\n".join(open_lines)))
    return commands


NAMED = re.compile(r"# (\S+\.toml)(, continued)?\n")


def file_of(block, line):
    """The command that writes a block of TOML whose first line names its file; none where it names none."""
    named = NAMED.match(block)
    return [(line, f"cat {'>>' if named[2] else '>'} {named[1]} <<'END'\n{block}END")] if named else []


def clone_in(folder, source, build):
    for entry in source.iterdir():
        if entry.name == "examples":
            shutil.copytree(entry, folder / entry.name)
        elif entry.name not in ("build", "out", ".git"):
            (folder / entry.name).symlink_to(entry)
    (folder / "build").mkdir()
    for preset in ("release", "ci"):
        (folder / "build" / preset).symlink_to(build)


def script_of(commands):
    """Each command after a mark; its failure is told, and the next is run."""
    parts = ["set -o pipefail"]
    for number, (_, text) in enumerate(commands):
        run = text if is_whole([text]) else "echo 'this is no whole command'; false"
        parts.append(f'echo "{MARK}{number}"\n{{ {run}\n}} 2>&1 || echo "{MARK}{number} failed: $?"')
    return "\n".join(parts) + "\n"


def failures_of(output, commands):
    """(line, command, what it said) of those that failed."""
    failures = []
    said = output.split(MARK)
    for before, part in zip(said, said[1:]):
        failed = re.match(r"(\d+) failed: (\d+)", part)
        if failed:
            line, command = commands[int(failed[1])]
            failures.append((line, command, before.split("\n", 1)[-1].strip() + f"\n(exit status {failed[2]})"))
    return failures


def run(document, source, build):
    blocks = blocks_of(document.read_text())
    commands = [command for language, line, text in blocks for command in
                (commands_of(text, line) if language in RUN else file_of(text, line) if language == "toml" else [])]
    not_run = sum(language in NOT_RUN for language, _, _ in blocks)
    with tempfile.TemporaryDirectory(prefix="ringlet-docs-") as name:
        folder = Path(name) / "clone"
        folder.mkdir()
        clone_in(folder, source, build)
        environment = {**os.environ, "PATH": f"{build}:{os.environ['PATH']}", "HOME": name,
                       "RINGLET_CACHE_DIR": str(build / "tests" / "cache"), "PYTHONDONTWRITEBYTECODE": "1",
                       "MESA_SHADER_CACHE_DIR": os.path.expanduser("~/.cache")}  # lavapipe's own: HOME is another
        done = subprocess.run(["bash", "-c", script_of(commands)], cwd=folder, env=environment, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    started = len(re.findall(f"^{MARK}\\d+$", done.stdout, re.MULTILINE))
    failures = failures_of(done.stdout, commands)
    if started < len(commands):
        failures.append((commands[started][0], commands[started][1], "was not reached:\n" + done.stdout[-2000:]))
    for line, command, said in failures:
        print(f"{document}:{line}: {command}\n    " + said.replace("\n", "\n    "))
    print(f"{document.name}: {started} commands were run, {len(failures)} failed; {not_run} blocks are not for running")
    return 1 if failures else 0


def has_device(build):
    return subprocess.run([build / "ringlet", "devices"], capture_output=True).returncode == 0


if __name__ == "__main__":
    if not has_device(Path(sys.argv[3])) and os.environ.get("RINGLET_REQUIRE_GPU") != "1":
        print("SKIPPED, NOTHING WAS TESTED: no Vulkan device")
        sys.exit(77)
    sys.exit(run(*(Path(argument).resolve() for argument in sys.argv[1:4])))
