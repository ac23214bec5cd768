#!/usr/bin/env bash
# Called by tests/run.sh --long: runs every test and the claims in full (label long), one by one.
# A test that passed at this commit is skipped, so an interrupted run goes on where it stopped.
# Counts and dates go to docs/long-runs.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
commit=$(git rev-parse --short HEAD 2>/dev/null || echo none)
git diff --quiet HEAD -- . ':!docs/long-runs.md' 2>/dev/null || commit=$commit+changes
done_file=build/long-$commit.passed
[ "${commit%+changes}" = "$commit" ] || rm -f "$done_file"
touch "$done_file"
export OSGKITS_REQUIRE_GL=1
mapfile -t tests < <(ctest --test-dir build -N "$@" | sed -n 's/^ *Test *#[0-9]*: //p')
((${#tests[@]})) || { echo "tests/run.sh --long: no test matches $*" >&2; exit 1; }
passed=0 failed=0 skipped=0 start=$SECONDS
for test in "${tests[@]}"; do
    if grep -qxF "$test" "$done_file"; then
        skipped=$((skipped + 1))
        continue
    fi
    echo "[$((passed + failed + skipped + 1))/${#tests[@]}] $test"
    if ctest --test-dir build -R "^${test//./\\.}\$" --output-on-failure >build/long.log 2>&1; then
        passed=$((passed + 1))
        echo "$test" >>"$done_file"
    else
        failed=$((failed + 1))
        cat build/long.log
    fi
done
{
    [ -s docs/long-runs.md ] || printf '# Long runs\n\nWritten by `tests/run.sh --long`.\n\n| date | commit | passed | failed | passed before | seconds |\n|---|---|---|---|---|---|\n'
    printf '| %s | %s | %d | %d | %d | %d |\n' "$(date -u +%F)" "$commit" "$passed" "$failed" "$skipped" "$((SECONDS - start))"
} >>docs/long-runs.md
echo "$((passed + skipped)) passed, $failed failed, $skipped of them passed before, in $((SECONDS - start)) s"
((failed == 0))
