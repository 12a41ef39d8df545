#include <gnomon/check/check.hpp>
#include <gnomon/core/executor.hpp>
#include <gnomon/core/executor_tbb.hpp>
#include <gnomon/core/executor_threads.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using namespace gnomon::core;

/// Runs [0, n) from the back in pieces of one: the most different order there is.
struct BackwardExecutor {
    template <class F>
    void parallel_for(std::size_t n, std::size_t /*grain*/, F&& f) const {
        for (std::size_t i = n; i-- > 0;) f(i, i + 1);
    }
};

/// How often each index of [0, n) was visited.
template <class E>
std::vector<int> visits(E const& executor, std::size_t n, std::size_t grain) {
    std::vector<std::atomic<int>> count(n);
    executor.parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++count[i];
    });
    return {count.begin(), count.end()};
}

}  // namespace

TEST_CASE("every executor visits each index exactly once", "[core][executor]") {
    ThreadExecutor const three(3);
    BackwardExecutor const backward;
    SerialExecutor const serial;
    ExecutorRef const erased(backward);
    for (std::size_t const n : {0U, 1U, 7U, 1000U})
        for (std::size_t const grain : {0U, 1U, 64U, 5000U}) {
            std::vector<int> const once(n, 1);
            CHECK(visits(serial, n, grain) == once);
            CHECK(visits(backward, n, grain) == once);
            CHECK(visits(erased, n, grain) == once);
            CHECK(visits(three, n, grain) == once);
            CHECK(visits(ExecutorRef(three), n, grain) == once);
        }
}

// Debian's oneTBB is not instrumented: the thread sanitizer does not see the order that it keeps.
#if !defined(__SANITIZE_THREAD__)
TEST_CASE("the TBB executor visits each index exactly once, on its number of threads", "[core][executor]") {
    TbbExecutor const two(2);
    for (std::size_t const n : {0U, 1U, 7U, 1000U})
        for (std::size_t const grain : {0U, 1U, 64U, 5000U})
            CHECK(visits(ExecutorRef(two), n, grain) == std::vector<int>(n, 1));
    CHECK(TbbExecutor(1).threads() == 1);
    CHECK(TbbExecutor(7).threads() == 7);
}
#endif
