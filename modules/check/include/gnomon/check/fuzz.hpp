#pragma once
// Fuzz targets that run as ordinary tests too.
//
//     void run(std::span<std::uint8_t const> bytes);  // GNOMON_FUZZ_CHECK(condition) what must hold
//     void seeds(gnomon::check::FuzzSeeds& out);      // out.add("name", bytes)
//     GNOMON_FUZZ_TARGET(run, seeds)
//
// makes libFuzzer's entry point where GNOMON_FUZZ_LIBFUZZER is defined, and else a program that runs the seeds and a
// fixed number of mutations of them (fuzz_driver.hpp).

#include <gnomon/check/fuzz_input.hpp>

#ifndef GNOMON_FUZZ_LIBFUZZER
#include <gnomon/check/fuzz_driver.hpp>
#endif

#include <cstdio>
#include <cstdlib>

/// Ends the process when the condition is false, as fuzzers expect it. Checked in every build.
#define GNOMON_FUZZ_CHECK(...)               \
    (static_cast<bool>(__VA_ARGS__) ? void() \
                                    : ::gnomon::check::detail::fuzz_check_failed(#__VA_ARGS__, __FILE__, __LINE__))

namespace gnomon::check::detail {

[[noreturn]] inline void fuzz_check_failed(char const* condition, char const* file, int line) {
    std::fprintf(stderr, "%s:%d: %s does not hold\n", file, line, condition);
    std::abort();
}

}  // namespace gnomon::check::detail

#ifdef GNOMON_FUZZ_LIBFUZZER
#define GNOMON_FUZZ_TARGET(run, seeds)                                                  \
    extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size);  \
    extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) { \
        static_cast<void>(seeds);                                                       \
        run(std::span<std::uint8_t const>(data, size));                                 \
        return 0;                                                                       \
    }
#else
#define GNOMON_FUZZ_TARGET(run, seeds)                                                                          \
    int main(int argc, char** argv) {                                                                           \
        ::gnomon::check::FuzzSeeds all;                                                                         \
        seeds(all);                                                                                             \
        return ::gnomon::check::detail::fuzz_main(::gnomon::check::detail::fuzz_options(argc, argv), run, all); \
    }
#endif
