#pragma once
// Adapter: an executor on plain threads, with nothing but the standard library. No other header includes it.
//
// Threads are started for each call, some 20 us each, so the work should be worth it; a program that has a pool adapts
// its own in five lines. All synchronization is the standard library's, which the thread sanitizer understands.

#include <gnomon/core/contract.hpp>
#include <gnomon/core/executor.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace gnomon::core {

/// Runs on `count` threads, the caller's among them, which take ranges of `grain` items in turn.
class ThreadExecutor {
public:
    /// expects: `count` at least 1.
    explicit ThreadExecutor(int count) : count_(count) { GNOMON_EXPECT(count >= 1); }

    template <class F>
    void parallel_for(std::size_t n, std::size_t grain, F&& f) const {
        std::size_t const step = std::max<std::size_t>(grain, 1);
        std::atomic<std::size_t> next{0};
        auto const work = [&] {
            for (std::size_t begin = next.fetch_add(step); begin < n; begin = next.fetch_add(step))
                f(begin, std::min(n, begin + step));
        };
        std::vector<std::thread> others;
        for (int i = 1; i < count_; ++i) others.emplace_back(work);
        work();
        for (std::thread& other : others) other.join();
    }

    [[nodiscard]] int threads() const noexcept { return count_; }

private:
    int count_;
};

static_assert(Executor<ThreadExecutor const>);

}  // namespace gnomon::core
