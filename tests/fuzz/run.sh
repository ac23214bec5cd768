#!/usr/bin/env bash
# tests/fuzz/run.sh [seconds]: builds the fuzz targets with clang in build-fuzz/ and runs each,
# 60 seconds if not told. Ends non-zero on a finding, whose input lies in build-fuzz/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
seconds=${1:-60}

command -v clang++ >/dev/null || { echo "tests/fuzz/run.sh: no clang++: install the package clang" >&2; exit 1; }
if [ ! -f build-fuzz/build.ninja ]; then
    cmake -S . -B build-fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=None \
        -DOSGKITS_BUILD_FUZZERS=ON -DOSGKITS_BUILD_TESTS=OFF -DOSGKITS_BUILD_EXAMPLES=OFF >/dev/null
fi
cmake --build build-fuzz --target {GlslSource,Merger,GlslPair,MixFile,Jpeg,ChainFile,AtlasLayout,MapLabels,Font}{Fuzz,Corpus}

# run <name> [flag]: <name>Fuzz on what <name>Corpus writes.
run() {
    local fuzzer writer log=build-fuzz/$1Fuzz.log corpus=build-fuzz/corpus-$1
    fuzzer=$(find build-fuzz -name "$1Fuzz" -type f -perm -u+x | head -n 1)
    writer=$(find build-fuzz -name "$1Corpus" -type f -perm -u+x | head -n 1)
    mkdir -p "$corpus"
    "$writer" "$corpus"
    "$fuzzer" "$corpus" -max_total_time="$seconds" -timeout=2 \
        -max_len=16384 -rss_limit_mb=4096 -artifact_prefix=build-fuzz/ -print_final_stats=1 \
        -verbosity=1 "${@:2}" >"$log" 2>&1 || {
        tail -n 40 "$log" >&2
        echo "tests/fuzz/run.sh: $1Fuzz found something: $log" >&2
        exit 1
    }
    grep -E 'stat::number_of_executed_units|stat::average_exec' "$log"
    grep -E 'cov:' "$log" | tail -n 1
    echo "$1Fuzz: clean for $seconds s"
}
run GlslSource -dict=tests/fuzz/glsl.dict
run Merger -dict=tests/fuzz/glsl.dict
run GlslPair -dict=tests/fuzz/glsl.dict
run MixFile
run Jpeg
run ChainFile
run AtlasLayout
run MapLabels
run Font -max_len=65536 -timeout=10
