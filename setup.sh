#!/usr/bin/env bash
# Installs what is missing from Debian packages, configures and builds in build/.
# Sourced or called by tests/run.sh and examples/gallery.sh; a second run installs and builds nothing.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

packages=(
    # compiler and build
    g++ cmake ninja-build
    # libraries
    libopenscenegraph-dev libglm-dev libeigen3-dev libopenimageio-dev openimageio-tools libosmesa6-dev libegl-dev
    libgl-dev
    libfreetype-dev libharfbuzz-dev libcsv-dev pkg-config
    libjpeg-dev libpng-dev libxxhash-dev
    nlohmann-json3-dev libpugixml-dev libcli11-dev libgtest-dev libbenchmark-dev libcoin-dev libembree-dev
    # run time: the viewer, software GL, models, plots, a real X11 window for the tests
    openscenegraph libgl1-mesa-dri libegl-mesa0 libosmesa6 inventor-data fonts-dejavu-core gnuplot-nox xvfb xauth
    # tests: a second GLSL compiler, real projects of ShaderDesigner, the shaders of OSG's examples
    glslang-tools meshlab openscenegraph-examples
    # sweeps: other encoders of texture blocks
    libstb-dev libsquish-dev libmagickwand-6.q16-dev
    # tests: a peer that writes Deep Zoom
    libvips-tools
)

missing=()
for package in "${packages[@]}"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' || missing+=("$package")
done
if ((${#missing[@]})); then
    echo "Installing from Debian: ${missing[*]}"
    sudo=()
    if ((EUID != 0)); then
        command -v sudo >/dev/null || { echo "setup.sh: not root and no sudo: install the packages above, then run again" >&2; exit 1; }
        sudo=(sudo)
    fi
    "${sudo[@]}" apt-get update -qq
    "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

if [ ! -f build/build.ninja ]; then
    echo "Configuring in build/"
    cmake -S . -B build -G Ninja "$@" >build.log 2>&1 || { cat build.log >&2; rm -f build.log; exit 1; }
    mv build.log build/configure.log
fi
echo "Building in build/"
# OSGKITS_TARGETS: only these, "osgrender osgdb_egl …"; all when it is not set.
read -r -d '' -a targets <<<"${OSGKITS_TARGETS:-all}" || true # of any number of lines
NINJA_STATUS="[%f/%t %es] " cmake --build build --target "${targets[@]}"
