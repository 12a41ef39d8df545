#include "allocations.hpp"

#include <gnomon/check/check.hpp>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> count{0};

void* allocate(std::size_t size) noexcept {
    ++count;
    return std::malloc(size == 0 ? 1 : size);
}

void* allocate(std::size_t size, std::align_val_t alignment) noexcept {
    ++count;
    auto const step = static_cast<std::size_t>(alignment);
    return std::aligned_alloc(step, (size + step - 1) / step * step);
}

void* checked(void* p) {
    if (p == nullptr) throw std::bad_alloc();
    return p;
}

}  // namespace

std::uint64_t allocations_made() noexcept { return count; }

[[gnu::noinline]] void* operator new(std::size_t size) { return checked(allocate(size)); }
[[gnu::noinline]] void* operator new(std::size_t size, std::nothrow_t const&) noexcept { return allocate(size); }
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
    return checked(allocate(size, alignment));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment, std::nothrow_t const&) noexcept {
    return allocate(size, alignment);
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

TEST_CASE("allocations are counted, aligned or not", "[raster][memory]") {
    // Called by name: a compiler may leave out the allocation of a new-expression whose result goes unused.
    std::uint64_t const before = allocations_made();
    void* const plain = ::operator new(12);
    std::uint64_t const after_plain = allocations_made();
    auto const line = std::align_val_t{64};
    void* const aligned = ::operator new(64, line);
    std::uint64_t const after_aligned = allocations_made();
    std::uint64_t const before_quiet = allocations_made();
    void* const quiet = ::operator new(64, line, std::nothrow);
    CHECK(allocations_made() == before_quiet + 1);
    ::operator delete(quiet, line);
    ::operator delete(plain);
    ::operator delete(aligned, line);
    CHECK(after_plain == before + 1);
    CHECK(after_aligned == before + 2);
}
