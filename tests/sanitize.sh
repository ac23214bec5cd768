#!/usr/bin/env bash
# tests/sanitize.sh [sanitizers]: the tests that need no GL, a random flight through paged textures
# and windows over virtual ones, under sanitizers, by default address,undefined; "thread" is
# another. Builds in build-<sanitizers>/. OSGKITS_FLY_SECONDS is how long the flight takes (4).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
case ${1:-} in -h | --help) sed -n '2,4s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;; esac
sanitizers=${1:-address,undefined}
folder=build-${sanitizers//,/-}
OSGKITS_TARGETS=osgMultiRender ./setup.sh
cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DOSGKITS_SANITIZE="$sanitizers" >/dev/null
targets=(osgMultiRender.{GlslToken,GlslSource,GlslWrap,SurfaceKey,SurfaceState,PseudoLoader}Test
    osgShadowVolume.{LightReach,LightGrid}Test
    osgPagedTexture.{ImageFile,ImageFileError,DamagedJpeg,ChainCache,SourceIndex,WorkerPool,ChainLoader,ChainLoaderFailure,EyeMotion,UploadPace,RandomFlyGL}Test
    osgPagedTexture.{PageTable,PageSlots,PageSelection,PageTexels,PageLoader}Test
    osgPagedTexture.VirtualPager{,Switch,Fault,Random}Test
    osgPagedTexture.VirtualWindowsGLTest
    precision.PrecisionTest osgdb_egl)
NINJA_STATUS="[%f/%t] " cmake --build "$folder" --target "${targets[@]}"
# OSG keeps its registries until the end, so leaks are looked for in the GLSL model alone (tests/fuzz).
export ASAN_OPTIONS=detect_leaks=0 TSAN_OPTIONS=suppressions=$PWD/tests/thread-suppressions.txt
regex=$(IFS='|'; echo "^(${targets[*]})\$")
ctest --test-dir "$folder" -R "${regex//./\\.}" --output-on-failure
