# Runs the tests of one file for ctest: run_pytest.py FILE [MODULE...], the modules that it needs besides NumPy. Ends with 77
# where something could not be tested, which ctest lists as skipped; what was skipped, and why, is printed.
import importlib
import sys

SKIPPED = 77

for needed in ("numpy", "pytest", *sys.argv[2:]):
    try:
        importlib.import_module(needed)
    except ImportError as error:
        print(f"SKIPPED, NOTHING WAS TESTED: {sys.executable} cannot import {needed}: {error}")
        sys.exit(SKIPPED)

import pytest  # noqa: E402


class Skips:
    count = 0

    def pytest_runtest_logreport(self, report):
        self.count += report.skipped


skips = Skips()
status = pytest.main(["-q", "-rs", "-p", "no:cacheprovider", sys.argv[1]], plugins=[skips])
sys.exit(SKIPPED if status == 0 and skips.count else int(status))
