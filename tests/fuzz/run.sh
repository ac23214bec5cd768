#!/usr/bin/env bash
# tests/fuzz/run.sh [seconds]: builds the fuzz targets with clang in build-fuzz/ and runs them,
# 60 seconds if not told. Ends non-zero on a finding, whose input lies in build-fuzz/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
seconds=${1:-60}

command -v clang++ >/dev/null || { echo "tests/fuzz/run.sh: no clang++: install the package clang" >&2; exit 1; }
if [ ! -f build-fuzz/build.ninja ]; then
    cmake -S . -B build-fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=None \
        -DOSGKITS_BUILD_FUZZERS=ON -DOSGKITS_BUILD_TESTS=OFF -DOSGKITS_BUILD_EXAMPLES=OFF >/dev/null
fi
cmake --build build-fuzz --target GlslSourceFuzz GlslSourceCorpus
fuzzer=$(find build-fuzz -name GlslSourceFuzz -type f -perm -u+x | head -n 1)
writer=$(find build-fuzz -name GlslSourceCorpus -type f -perm -u+x | head -n 1)
mkdir -p build-fuzz/corpus
"$writer" build-fuzz/corpus
"$fuzzer" build-fuzz/corpus -dict=tests/fuzz/glsl.dict -max_total_time="$seconds" -timeout=2 \
    -max_len=16384 -rss_limit_mb=4096 -artifact_prefix=build-fuzz/ -print_final_stats=1 \
    -verbosity=1 >build-fuzz/GlslSourceFuzz.log 2>&1 || {
    tail -n 40 build-fuzz/GlslSourceFuzz.log >&2
    echo "tests/fuzz/run.sh: GlslSourceFuzz found something: build-fuzz/GlslSourceFuzz.log" >&2
    exit 1
}
grep -E 'stat::number_of_executed_units|stat::average_exec' build-fuzz/GlslSourceFuzz.log
grep -E 'cov:' build-fuzz/GlslSourceFuzz.log | tail -n 1
echo "GlslSourceFuzz: clean for $seconds s"
