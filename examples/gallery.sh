#!/usr/bin/env bash
# examples/gallery.sh: builds what is missing and renders the gallery to build/gallery/index.html.
#   --plain    without the kits: OpenSceneGraph's own rendering
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

lit='.(shadows=off,lighting=pixel).shadowvolume'
shadowed=.shadowvolume mask='.(show=mask,light=0).shadowvolume'
volumes='.(show=volumes,light=0).shadowvolume' maps='.(shadows=map).shadowvolume'
measuring=measuring labels=labels maplabels=maplabels mixed=mixed paged=paged virtual=virtual # have no plain form
while (($#)); do
    case $1 in
        --plain) lit= shadowed= mask= volumes= maps= measuring= labels= maplabels= mixed= paged= virtual=; shift ;;
        -h|--help) sed -n '2,3s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
        *) echo "examples/gallery.sh: unknown argument '$1'; see --help" >&2; exit 2 ;;
    esac
done

start=$SECONDS
models=/usr/share/inventor/data/models out=build/gallery formats=build/gallery/models
scenes=build/gallery/scenes
trap 'status=$?; ((status == 0)) || echo "gallery FAILED after $((SECONDS - start)) s" >&2' EXIT
# Not the tests, which take most of the building time.
OSGKITS_TARGETS="osgrender osgdb_egl osgdb_osmesa osgdb_shadowvolume osgrefinery osgdb_labels
    osgdb_serializers_osglabels osgdb_multirender
    osgphotocity osgdb_pagedtexture osgtilestore osgdb_virtualtexture osgdb_serializers_osgpagedtexture" ./setup.sh
mkdir -p "$formats"

# Other formats, made from Inventor models by stock osgconv.
for name in wheel.osg torus.osgt vehicles/f16.ive; do
    target=$formats/${name##*/}
    [ -s "$target" ] && continue
    echo "Converting to $target"
    osgconv "$models/${name%.*}.iv" "$target" >"$out/osgconv.log" 2>&1 && [ -s "$target" ] ||
        { cat "$out/osgconv.log" >&2; exit 1; }
done

# Scenes that name the models that they show.
mkdir -p "$scenes"
cp examples/scenes/*.iv examples/scenes/*.wrl examples/scenes/*.osgt examples/scenes/*.csv examples/scenes/*.glsl "$scenes"
ln -sfn "$models" "$scenes/models"
for refinery in "3000 refinery.osgb" "3000 refinery.iv" "60000 refinery60000.osgb"; do
    OSG_LIBRARY_PATH=build/lib build/bin/osgrefinery --objects "${refinery% *}" "$scenes/${refinery#* }" >"$out/osgrefinery.log"
done

build/bin/osgphotocity --textures 40 "$scenes/photos.osgb" >"$out/osgphotocity.log"
# The same photographs as a tile store, in blocks because some have alpha.
(
    cd "$scenes"
    export OSG_LIBRARY_PATH=$OLDPWD/build/lib
    "$OLDPWD/build/bin/osgtilestore" layout photos.osgb photos.layout.json
    "$OLDPWD/build/bin/osgtilestore" build photos.layout.json --store photos.tiles --format bc7
    "$OLDPWD/build/bin/osgtilestore" atlas photos.osgb photos.layout.json photos.tiles atlas.osgb
) >"$out/osgtilestore.log" 2>&1 || { cat "$out/osgtilestore.log" >&2; exit 1; }

scripts=()
for script in shadows $labels $maplabels $mixed $paged $virtual $measuring chess machines robots scenes vehicles household formats; do
    scripts+=("@examples/scenes/$script.txt")
done
echo "Rendering to $out (Coin will miss the chess board that chesschairs.iv names and Debian lacks)"
status=0
build/bin/osgrender --samples 4 --clear-color 0.2,0.22,0.26 -D MODELS=$models -D FORMATS=$formats -D SCENES=$scenes -D PICTURES=docs/pictures \
    -D SHADERS=/usr/share/meshlab/shaders \
    -D LIT="$lit" -D SHADOWED="$shadowed" -D MASK="$mask" -D VOLUMES="$volumes" -D MAPS="$maps" \
    -D OUT=$out "${scripts[@]}" --html "$out/index.html" >"$out/summary.log" || status=$?
summary=$(tail -n 1 "$out/summary.log")
((status == 0)) || { echo "${summary:-osgrender ended with status $status}" >&2; exit $status; }
echo "gallery: ${summary#osgrender: }, $((SECONDS - start)) s in all: $out/index.html"
