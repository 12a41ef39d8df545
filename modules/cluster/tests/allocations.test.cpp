#include "allocations.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> allocation_count{0};

void* allocated(std::size_t bytes) noexcept {
    ++allocation_count;
    return std::malloc(bytes == 0 ? 1 : bytes);
}

void* allocated(std::size_t bytes, std::align_val_t alignment) noexcept {
    ++allocation_count;
    auto const step = static_cast<std::size_t>(alignment);
    return std::aligned_alloc(step, (bytes + step) / step * step);
}

}  // namespace

std::size_t allocations() { return allocation_count; }

// Counts every allocation of the test program. Not inlined: GCC would take `free` for the wrong counterpart of `new`.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
    if (void* const memory = allocated(bytes)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t bytes, std::align_val_t alignment) {
    if (void* const memory = allocated(bytes, alignment)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t bytes, std::nothrow_t const&) noexcept { return allocated(bytes); }
[[gnu::noinline]] void* operator new(std::size_t bytes, std::align_val_t alignment, std::nothrow_t const&) noexcept {
    return allocated(bytes, alignment);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::nothrow_t const&) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t, std::nothrow_t const&) noexcept { std::free(memory); }
