#include "allocations.hpp"

#include <gnomon/check/check.hpp>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> allocation_count{0};

void* counted(void* p) {
    ++allocation_count;
    if (p == nullptr) throw std::bad_alloc();
    return p;
}

}  // namespace

std::uint64_t allocations_made() noexcept { return allocation_count; }

[[gnu::noinline]] void* operator new(std::size_t size) { return counted(std::malloc(size == 0 ? 1 : size)); }
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    auto const step = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::nothrow_t const&) noexcept {
    ++allocation_count;
    return std::malloc(size == 0 ? 1 : size);
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment, std::nothrow_t const&) noexcept {
    auto const step = static_cast<std::size_t>(alignment);
    ++allocation_count;
    return std::aligned_alloc(step, (size + step - 1) / step * step);
}
[[gnu::noinline]] void operator delete(void* p, std::nothrow_t const&) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t, std::nothrow_t const&) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

TEST_CASE("allocations are counted, aligned or not", "[bvh][memory]") {
    // Called by name: a compiler may leave out the allocation of a new-expression whose result goes unused.
    std::uint64_t const before = allocations_made();
    void* const plain = ::operator new(12);
    std::uint64_t const after_plain = allocations_made();
    auto const line = std::align_val_t{64};
    void* const aligned = ::operator new(64, line);
    std::uint64_t const after_aligned = allocations_made();
    ::operator delete(plain);
    ::operator delete(aligned, line);
    CHECK(after_plain == before + 1);
    CHECK(after_aligned == before + 2);
}
