#!/bin/sh
# Makes sure of what a build needs: setup.sh demo|test|ci
# Debian: installs the packages that are missing, as root or by sudo. Elsewhere: says what is missing.
set -eu
. "$(dirname "$0")/steps.sh"

demo_packages="ca-certificates cmake g++ ninja-build libglm-dev libtinygltf-dev libtbb-dev libcli11-dev libfmt-dev libstb-dev libwebp-dev nlohmann-json3-dev libvulkan-dev glslc"
test_packages="$demo_packages mesa-vulkan-drivers vulkan-validationlayers libembree-dev libbenchmark-dev libopenmesh-dev"
ci_packages="$test_packages ccache catch2 clang-16 libclang-rt-16-dev"

missing_packages() {
    for package in "$@"; do
        state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) || state=
        [ "$state" = installed ] || printf '%s ' "$package"
    done
}

as_root() {
    if [ "$(id -u)" = 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        echo "setup: need root or sudo for: $*" >&2
        return 1
    fi
}

apt_update() {
    for attempt in 1 2 3; do
        quietly as_root apt-get -q -o Acquire::Retries=3 update && return 0
        echo "setup: apt-get update failed (attempt $attempt)" >&2
        sleep $((attempt * 3))
    done
    return 1
}

apt_install() {
    quietly as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o Acquire::Retries=3 install --no-install-recommends "$@"
}

# Anywhere but on Debian: the tools must be there already.
check_tools() {
    for tool in cmake ninja c++; do
        if ! command -v "$tool" >/dev/null; then
            echo "setup: $tool is missing. This is no Debian; install the counterparts of: $1" >&2
            return 1
        fi
    done
}

main() {
    case "${1:-}" in
        demo) packages=$demo_packages ;;
        test) packages=$test_packages ;;
        ci) packages=$ci_packages ;;
        *) echo "usage: setup.sh demo|test|ci" >&2; return 2 ;;
    esac
    if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
        check_tools "$packages"
        return
    fi
    # shellcheck disable=SC2086 # a list of words
    missing=$(missing_packages $packages)
    [ -n "$missing" ] || return 0
    echo "setup: installing ${missing% }"
    apt_update
    # shellcheck disable=SC2086
    apt_install $missing
}

main "$@"
