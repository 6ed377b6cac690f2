"""run_commands.py finds what fails, and nothing else."""
import contextlib
import io
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.dont_write_bytecode = True
import run_commands  # noqa: E402


class RunCommands(unittest.TestCase):
    def run_document(self, text):
        with tempfile.TemporaryDirectory() as name:
            source = Path(name) / "source"
            (source / "examples").mkdir(parents=True)
            (source / "examples" / "curl.obj").write_text("curl\n")
            (source / "page.md").write_text(text)
            build = Path(name) / "built"
            build.mkdir()
            (build / "ringlet").write_text("#!/bin/sh\necho it is $1\n")
            (build / "ringlet").chmod(0o755)
            said = io.StringIO()
            with contextlib.redirect_stdout(said):
                status = run_commands.run(source / "page.md", source, build)
            self.assertEqual((source / "examples" / "curl.obj").read_text(), "curl\n")
            return status, said.getvalue()

    def test_commands_share_a_shell_and_the_clone(self):
        status, said = self.run_document(
            "```sh\n# a comment\nringlet made | grep 'it is made'\nA=1\ncd build/release && ls ringlet\n```\n"
            "text\n```bash\ntest $A = 1\npwd | grep release\ncd ../..; echo x > examples/curl.obj\n"
            "for i in 1 2; do\n  test $i\ndone\ncat <<END > here\ntext\nEND\ntest \\\n  -f here\n```\n")
        self.assertEqual((status, "9 commands were run, 0 failed; 0 blocks" in said), (0, True), said)

    def test_what_fails_is_told_with_its_line_and_the_rest_is_run(self):
        status, said = self.run_document("one\n\n```sh\ntrue\n\nls nosuch\ntrue | false | true\necho on\n```\n")
        self.assertEqual(status, 1)
        self.assertIn("page.md:6: ls nosuch", said)
        self.assertIn("No such file", said)
        self.assertIn("page.md:7: true | false", said)
        self.assertIn("4 commands were run, 2 failed", said)

    def test_a_shell_that_ends_is_told(self):
        status, said = self.run_document("```sh\nexit 0\necho never\n```\n")
        self.assertEqual(status, 1)
        self.assertIn("echo never", said)

    def test_a_command_that_is_not_closed_is_told(self):
        self.assertEqual(self.run_document("```sh\nfor i in 1 2; do\n```\n")[0], 1)

    def test_a_named_block_of_toml_becomes_a_file(self):
        status, said = self.run_document(
            "```toml\n# a.toml\n[one]\n```\n```toml\n# a.toml, continued\n[two]\n```\n```toml\n[no_file]\n```\n"
            "```sh\ntest \"$(grep -c . a.toml)\" = 4\ngrep two a.toml\n```\n")
        self.assertEqual((status, "4 commands were run, 0 failed" in said), (0, True), said)

    def test_other_blocks_are_not_run(self):
        status, said = self.run_document("```console\nfalse\n```\n```python\nfalse\n```\n```\nfalse\n```\n")
        self.assertEqual(status, 0)
        self.assertIn("0 commands were run, 0 failed; 1 blocks are not for running", said)


if __name__ == "__main__":
    unittest.main()
