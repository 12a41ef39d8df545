#!/bin/sh
# Sets up, builds everything and runs every test: sh cmake/test.sh [ctest options, e.g. -R math]
# GNOMON_PRESET picks another preset (see `cmake --list-presets`); release is the default.
set -eu
cd "$(dirname "$0")/.."
. cmake/steps.sh

preset=${GNOMON_PRESET:-release}
set_up "${GNOMON_SETUP:-test}"
configure "$preset"
build "$preset"
run_tests "$preset" "$@"
