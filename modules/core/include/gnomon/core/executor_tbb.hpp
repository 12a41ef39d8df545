#pragma once
// Adapter: an executor on oneTBB. Needs TBB; no other header of the library includes it.

#include <gnomon/core/executor.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <memory>

namespace gnomon::core {

/// Runs on `threads` threads of its own task arena.
class TbbExecutor {
public:
    /// `threads` at least 1; 0 takes all of the machine's.
    explicit TbbExecutor(int threads = 0)
        : arena_(std::make_unique<tbb::task_arena>(threads > 0 ? threads : int{tbb::task_arena::automatic})) {}

    template <class F>
    void parallel_for(std::size_t n, std::size_t grain, F&& f) const {
        if (n == 0) return;
        std::size_t const step = std::max<std::size_t>(grain, 1);
        arena_->execute([&] {
            tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, step),
                              [&](tbb::blocked_range<std::size_t> const& range) { f(range.begin(), range.end()); });
        });
    }

    [[nodiscard]] int threads() const { return arena_->max_concurrency(); }

private:
    std::unique_ptr<tbb::task_arena> arena_;
};

static_assert(Executor<TbbExecutor const>);

}  // namespace gnomon::core
