#!/usr/bin/env bash
# Builds with warnings as errors and runs tests, GPU tests under the Vulkan validation layers.
#   bash scripts/test.sh            the quick form: all but the suites labelled long, which it names at its end
#   bash scripts/test.sh --all      every test; arguments after it are ctest's
#   bash scripts/test.sh ARGUMENTS  those of all tests that ctest takes for these arguments: -R kernels/StrandStep
set -euo pipefail
cd "$(dirname "$0")/.."

form=chosen
if [ $# = 0 ]; then
  form=quick
  set -- -LE long
elif [ "$1" = --all ]; then
  shift
fi

scripts/install_packages.sh
cmake --preset ci
cmake --build --preset ci

# Every driver package brings a device (lavapipe at least), so a test that finds none has failed.
export RINGLET_REQUIRE_GPU=1
# Two at a time: many tests keep one core busy only.
ctest --preset ci --parallel 2 --no-tests=error "$@"
if [ $form = quick ]; then
  echo "LEFT OUT of the quick form; bash scripts/test.sh --all runs them too:"
  ctest --preset ci --show-only -L long | sed -n 's/^ *Test *#[0-9]*: /  /p'
fi
