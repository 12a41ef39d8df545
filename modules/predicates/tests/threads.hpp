#pragma once
// An executor of plain threads for tests: unlike a pool's, its synchronization is visible to the thread sanitizer.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace hard {

struct Threads {
    int count;

    template <class F>
    void parallel_for(std::size_t n, std::size_t grain, F&& f) const {
        std::size_t const step = std::max<std::size_t>(grain, 1);
        std::atomic<std::size_t> next{0};
        auto const work = [&] {
            for (std::size_t begin = next.fetch_add(step); begin < n; begin = next.fetch_add(step))
                f(begin, std::min(n, begin + step));
        };
        std::vector<std::thread> threads;
        for (int i = 1; i < count; ++i) threads.emplace_back(work);
        work();
        for (std::thread& thread : threads) thread.join();
    }
};

}  // namespace hard
