#pragma once
// Clocks and medians of the benchmarks that interleave what they compare.

#include <algorithm>
#include <ctime>
#include <vector>

namespace bench {

inline double now_ms(clockid_t clock) {
    timespec t{};
    clock_gettime(clock, &t);
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

inline double median(std::vector<double> v) {
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
}

/// CPU time of the whole process and wall-clock time of each run.
struct Times {
    std::vector<double> cpu, wall;
    template <class F>
    void measure(F&& f) {
        double const wall_start = now_ms(CLOCK_MONOTONIC);
        double const cpu_start = now_ms(CLOCK_PROCESS_CPUTIME_ID);
        f();
        cpu.push_back(now_ms(CLOCK_PROCESS_CPUTIME_ID) - cpu_start);
        wall.push_back(now_ms(CLOCK_MONOTONIC) - wall_start);
    }
};

}  // namespace bench
