#pragma once
// How often a test program asks for memory, to show that a frame after the first does not.
//
//     GNOMON_COUNT_ALLOCATIONS   // in one source file of the program, at file scope
//
//     std::uint64_t const before = gnomon::check::allocations_made();
//     frame();
//     CHECK(gnomon::check::allocations_made() == before);
//
// Counts every `operator new` of the program, drivers and libraries that use it included; malloc is not counted. A
// compiler may leave out a new-expression whose result goes unused: call `::operator new` by name to count on it.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace gnomon::check {

namespace detail {

inline std::atomic<std::uint64_t> allocation_count{0};

[[nodiscard]] inline void* counted(std::size_t size) noexcept {
    allocation_count.fetch_add(1, std::memory_order_relaxed);
    return std::malloc(size == 0 ? 1 : size);
}

[[nodiscard]] inline void* counted(std::size_t size, std::align_val_t alignment) noexcept {
    allocation_count.fetch_add(1, std::memory_order_relaxed);
    auto const step = static_cast<std::size_t>(alignment);
    return std::aligned_alloc(step, (size + step - 1) / step * step);
}

/// Ends the program where memory has run out: a test has nothing better to do.
[[nodiscard]] inline void* there(void* memory) noexcept {
    if (memory == nullptr) std::abort();
    return memory;
}

}  // namespace detail

/// Calls of `operator new` so far, by any thread; 0 in a program without GNOMON_COUNT_ALLOCATIONS.
[[nodiscard]] inline std::uint64_t allocations_made() noexcept { return detail::allocation_count.load(); }

}  // namespace gnomon::check

// Not inlined: GCC would take `free` for the wrong counterpart of `new`.
#define GNOMON_COUNT_ALLOCATIONS                                                                                        \
    [[gnu::noinline]] void* operator new(std::size_t n) {                                                               \
        return ::gnomon::check::detail::there(::gnomon::check::detail::counted(n));                                     \
    }                                                                                                                   \
    [[gnu::noinline]] void* operator new(std::size_t n, std::align_val_t a) {                                           \
        return ::gnomon::check::detail::there(::gnomon::check::detail::counted(n, a));                                  \
    }                                                                                                                   \
    [[gnu::noinline]] void* operator new(std::size_t n, std::nothrow_t const&) noexcept {                               \
        return ::gnomon::check::detail::counted(n);                                                                     \
    }                                                                                                                   \
    [[gnu::noinline]] void* operator new(std::size_t n, std::align_val_t a, std::nothrow_t const&) noexcept {           \
        return ::gnomon::check::detail::counted(n, a);                                                                  \
    }                                                                                                                   \
    [[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }                                          \
    [[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }                             \
    [[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }                        \
    [[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }           \
    [[gnu::noinline]] void operator delete(void* p, std::nothrow_t const&) noexcept { std::free(p); }                   \
    [[gnu::noinline]] void operator delete(void* p, std::align_val_t, std::nothrow_t const&) noexcept { std::free(p); } \
    static_assert(true)
