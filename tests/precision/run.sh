#!/usr/bin/env bash
# tests/precision/run.sh [sweep...] [--list] [--rounds N] [--warm-ups N] [--help]
# Builds and runs the work-precision sweeps, all of them or those named. The diagrams and their
# data go to build/precision/<sweep>.svg and .csv, a table to the terminal.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
case " $* " in
    *" -h "* | *" --help "*) sed -n '2,4s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
esac
./setup.sh >&2
export OSG_LIBRARY_PATH=$PWD/build/lib
exec build/bin/precision --output build/precision "$@"
