#!/usr/bin/env bash
# Before a commit: whether what is staged is formatted, and includes only what it may. To have git run it:
#   ln -s ../../scripts/pre_commit.sh .git/hooks/pre-commit
set -euo pipefail
cd "$(git rev-parse --show-toplevel)"
mapfile -t files < <(git diff --cached --name-only --diff-filter=ACMR -- '*.cpp' '*.h' ':!shaders')
if ((${#files[@]})) && clang-format --version 2> /dev/null | grep -q 'version 14\.'; then
  clang-format --dry-run -Werror "${files[@]}"
fi
bash scripts/check_format.sh shaders
git diff --cached --check
# The rules of includes, sentences and links, where they are built.
tests=build/ci/tests/package_tests
if [[ -x $tests ]]; then
  "$tests" --gtest_brief=1 --gtest_filter='IncludeRules.*:Docs.*'
fi
