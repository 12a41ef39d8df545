# The steps that cmake/test.sh, cmake/demo.sh and CI share; read by them from the top of the checkout.
# Each is quiet unless it fails or takes a while.

say() {
    printf '== %s\n' "$*"
}

# Runs a command; its output is shown only if it fails.
quietly() {
    log=$(mktemp)
    if "$@" >"$log" 2>&1; then
        rm -f "$log"
    else
        code=$?
        # What went well, ninja's "[1/9] Building ...", is left out.
        grep -v '^\[[0-9]*/[0-9]*\] ' "$log" | tail -n 200 >&2 || true
        rm -f "$log"
        return "$code"
    fi
}

set_up() {
    say "set up ($1)"
    sh cmake/setup.sh "$1"
}

# configure PRESET [cmake options]
configure() {
    say "configure ($*)"
    preset=$1
    shift
    quietly cmake --preset "$preset" "$@"
}

# build PRESET [options of cmake --build]
build() {
    say "build ($*)"
    preset=$1
    shift
    quietly cmake --build --preset "$preset" "$@"
}

# run_tests PRESET [ctest options]
run_tests() {
    say "test ($*)"
    preset=$1
    shift
    ctest --preset "$preset" --no-label-summary -j "$(nproc)" "$@" | summary
}

# The lines of ctest that tell something: failures with their output, and the end.
summary() {
    awk '/^[[:space:]]*Start +[0-9]+:/ { next }
         /^[[:space:]]*[0-9]+\/[0-9]+ +Test +#[0-9]+: .* Passed / { if ($(NF-1) >= 5) print; next }
         { print }
         /tests passed/ { passed = 1; if ($0 ~ /, 0 tests failed/) good = 1 }
         END { exit !(passed && good) }'
}
