#pragma once
// The one way in for parallelism: an executor splits [0, n) into ranges and runs them, in any order, on any thread.

#include <concepts>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace gnomon::core {

/// Runs `f(begin, end)` over disjoint ranges that cover [0, n), each of about `grain` items; returns when all ran.
///
/// Results must not depend on the ranges' order or size; every component of the library is written so.
template <class E>
concept Executor = requires(E& executor, void (*f)(std::size_t, std::size_t)) {
    executor.parallel_for(std::size_t{}, std::size_t{}, f);
};

/// Runs everything at once on the calling thread. The default everywhere.
struct SerialExecutor {
    template <class F>
    void parallel_for(std::size_t n, std::size_t /*grain*/, F&& f) const {
        if (n != 0) f(std::size_t{0}, n);
    }
};

/// A reference to any executor, for compiled code that cannot be a template. Two pointers; owns nothing.
///
/// expects: the executor outlives the reference.
class ExecutorRef {
public:
    template <Executor E>
        requires(!std::same_as<std::remove_cvref_t<E>, ExecutorRef>)
    ExecutorRef(E& executor) noexcept  // NOLINT: a reference type converts implicitly, as string_view does
        : executor_(const_cast<void*>(static_cast<void const*>(std::addressof(executor)))), run_(&run_on<E>) {}

    template <class F>
    void parallel_for(std::size_t n, std::size_t grain, F&& f) const {
        using Function = std::remove_reference_t<F>;
        Body const body{const_cast<void*>(static_cast<void const*>(std::addressof(f))),
                        [](void* context, std::size_t begin, std::size_t end) {
                            (*static_cast<Function*>(context))(begin, end);
                        }};
        run_(executor_, n, grain, body);
    }

private:
    struct Body {
        void* context;
        void (*call)(void*, std::size_t, std::size_t);
        void operator()(std::size_t begin, std::size_t end) const { call(context, begin, end); }
    };

    template <class E>
    static void run_on(void* executor, std::size_t n, std::size_t grain, Body const& body) {
        static_cast<E*>(executor)->parallel_for(n, grain, body);
    }

    void* executor_;
    void (*run_)(void*, std::size_t, std::size_t, Body const&);
};

static_assert(Executor<SerialExecutor> && Executor<SerialExecutor const> && Executor<ExecutorRef>);

}  // namespace gnomon::core
