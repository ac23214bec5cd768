#!/usr/bin/env bash
# tests/run.sh [-R regex] [--long]: builds what is missing and runs the tests.
#   -R regex   only tests whose name matches (passed on to ctest)
#   --long     every claim in full (minutes to hours). Resumable: what passed at this commit is
#              skipped; counts and dates go to docs/long-runs.md
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

filter=() long=0
while (($#)); do
    case $1 in
        -R) filter=(-R "${2:?tests/run.sh: -R needs a regex}"); shift 2 ;;
        --long) long=1; shift ;;
        -h|--help) sed -n '2,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
        *) echo "tests/run.sh: unknown argument '$1'; see --help" >&2; exit 2 ;;
    esac
done

./setup.sh
start=$SECONDS
if ((long)); then
    exec tests/long.sh "${filter[@]}"
fi
# GL that is missing is a failure here, not a skip: see tests/support/HeadlessViewer.h.
export OSGKITS_REQUIRE_GL=1
: >build/tests.log
status=0
ctest --test-dir build -LE long -j "$(nproc)" --output-on-failure "${filter[@]}" >build/tests.log 2>&1 &
pid=$!
# progress: one line a finished test
tail -n +1 -f --pid=$pid build/tests.log | grep --line-buffered -E '^ *[0-9]+/[0-9]+ Test|\[  FAILED|Failure|error:|tests passed|No tests' || true
wait $pid || status=$?
passed=$(grep -cE 'Test +#[0-9]+:.* Passed ' build/tests.log || true)
total=$(grep -cE 'Test +#[0-9]+:.*(Passed|Failed|\*\*\*)' build/tests.log || true)
skipped=$(grep -cE 'Test +#[0-9]+:.*\*\*\*Skipped' build/tests.log || true)
if ((status)); then
    sed -n '/The following tests FAILED/,$p' build/tests.log
    echo "log: build/tests.log"
fi
if ((total == 0)); then
    echo "tests/run.sh: no test matches ${filter[*]:-}" >&2
    exit 1
fi
echo "tests took $((SECONDS - start)) s; log: build/tests.log"
echo "$passed passed, $((total - passed - skipped)) failed, $skipped skipped"
exit $status
