#!/bin/sh
# Sets up, builds the `gnomon` command and lets it compare one shadow map with exact rays: sh cmake/demo.sh [FOLDER]
# FOLDER (default: demo) gets the pictures, results.json and index.html.
set -eu
cd "$(dirname "$0")/.."
. cmake/steps.sh

out=${1:-demo}
set_up demo
configure demo
build demo
say "compare"
build/demo/bin/gnomon compare city --techniques shadow-map,ray --sun -0.45,-0.8,-0.4 --size 1024x1024 \
    --param shadow-map.resolution=512,1024,2048,4096 --out "$out"
say "the pictures are in $out; open $out/index.html"
